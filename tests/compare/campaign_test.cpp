// The measured campaign's contract: what is read, and how each bad input is refused.
#include "compare/measured/campaign.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <numbers>

#include "bekker_wong/effect_vocabulary.hpp"
#include "compare/measured/run_columns.hpp"
#include "scenario/case.hpp"
#include "scenario/csv.hpp"
#include "scenario/library.hpp"
#include "scenario/soil_parameters.hpp"
#include "scenario/unit.hpp"
#include "tests/folder.hpp"
#include "tests/scenario/fake_vocabulary.hpp"
#include "tests/scenario/refusal.hpp"

namespace soilbin::compare {
namespace {

using test::FakeVocabulary;
using test::refusal;
using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::StartsWith;

const std::string good_yaml = R"(format: soilbin-campaign/1
name: c042
wheel:
  radius: 0.25 m
  width: 0.10 m
  lugs: {height: 8 mm}
soil:
  exponent:       {value: 1.10, sd: 0.05}
  k_c:            {value: 0.99 kN/m^(n+1), sd: 0.30 kN/m^(n+1)}
  k_phi:          {value: 1528 kN/m^(n+2), sd: 150 kN/m^(n+2)}
  cohesion:       1.04 kPa
  friction_angle: 28 deg
  shear_modulus:  20 mm
  stress_angle_c1: 0.18
  stress_angle_c2: 0.32
  density: 1600 kg/m^3
bin: {depth: 0.5 m, width: 1.0 m}
model: {effects: []}
data: runs.csv
columns: {}
force_frame: wheel
slip_by: travel_speed
)";

const std::string good_csv =
    "run,setpoint,load_N,slip,pass,moisture_percent,yaw_deg,drawbar_pull_N,torque_Nm\n"
    "1,a,1000,0.1,1,3.81,15,120,30\n"
    "2,a,1000,0.1,2,,0,122,\n"
    "3,b,2000,-1,1,4,0,-300,-80\n";

Campaign parse(const std::string& yaml, const std::string& csv) {
  const auto open = [&](const std::string& name) { return make_source_text(csv, name); };
  return parse_campaign(make_source_text(yaml, "campaign.yaml"), open, Library(), FakeVocabulary());
}

std::string refused(const std::string& yaml, const std::string& csv) {
  return refusal([&] { parse(yaml, csv); });
}

std::string replaced(std::string text, const std::string& old_text, const std::string& new_text) {
  const std::size_t at = text.find(old_text);
  if (at == std::string::npos) ADD_FAILURE() << "no '" << old_text << "' in the example";
  return text.replace(at, old_text.size(), new_text);
}

std::string refused_yaml(const std::string& old_text, const std::string& new_text) {
  return refused(replaced(good_yaml, old_text, new_text), good_csv);
}

std::string refused_csv(const std::string& old_text, const std::string& new_text) {
  return refused(good_yaml, replaced(good_csv, old_text, new_text));
}

TEST(Campaign, IsReadInSi) {
  const Campaign c = parse(good_yaml, good_csv);
  EXPECT_EQ(c.name, "c042");
  EXPECT_EQ(c.wheel.lugs.height, 0.008);
  EXPECT_FALSE(c.wheel.lugs.count) << "lugs may have a height and no count";
  EXPECT_EQ(c.soil.k_c.std_error, 300.0);
  EXPECT_EQ(c.bin->width, 1.0);
  ASSERT_EQ(c.runs.size(), 3u);
  EXPECT_EQ(c.runs[0].at.load, 1000.0);
  EXPECT_EQ(c.runs[0].at.run, 1);
  EXPECT_EQ(c.runs[0].at.moisture, 0.0381);
  EXPECT_DOUBLE_EQ(c.runs[0].at.yaw, 15 * degree);
  EXPECT_EQ(c.runs[0].at.force_frame, ForceFrame::wheel);
  EXPECT_EQ(c.runs[0].at.slip_by, SlipBy::travel_speed);
  EXPECT_EQ(c.runs[1].setpoint, "a");
  EXPECT_EQ(c.runs[1].at.pass, 2);
  EXPECT_FALSE(c.runs[1].at.moisture) << "a cell may be empty";
  EXPECT_FALSE(c.runs[1].torque);
  EXPECT_EQ(c.runs[2].drawbar_pull, -300.0);
  EXPECT_FALSE(c.runs[2].sinkage) << "a column may be absent";
  EXPECT_EQ(c.runs[2].csv_line, 4);
}

TEST(Campaign, EffectsOfTheAnalystsModel) {
  const Campaign plain = parse(replaced(good_yaml, "effects: []", "effects: [slip_sinkage]"), good_csv);
  ASSERT_EQ(plain.effects.size(), 1u);
  EXPECT_EQ(plain.effects[0].form, "lyasko");
  EXPECT_THAT(refused_yaml("effects: []", "effects: [slip_snkage]"), HasSubstr("did you mean 'slip_sinkage'?"));
}

TEST(Campaign, ColumnsMayHaveOtherNamesAndUnits) {
  const std::string columns = "columns: {Fx_kN: {quantity: drawbar_pull, unit: kN}, i: {quantity: slip, unit: '%'}}";
  const Campaign c = parse(replaced(good_yaml, "columns: {}", columns),
                           "load_N,i,Fx_kN,sinkage_m\n1000,10,0.12,0.01\n1000,20,0.2,0.01\n1000,30,0.3,0.02\n");
  EXPECT_EQ(c.runs[0].at.slip, 0.1);
  EXPECT_EQ(c.runs[0].drawbar_pull, 120.0);
  EXPECT_EQ(c.columns.at("drawbar_pull").header, "Fx_kN");
  EXPECT_EQ(c.columns.at("drawbar_pull").unit, "kN");
  EXPECT_EQ(c.columns.at("drawbar_pull").at.column, 10);
  EXPECT_EQ(c.columns.at("load").unit, "N");
}

// What an operator keeps beside the numbers: neither read nor refused, whatever its cells hold.
TEST(Campaign, ColumnsMayBeIgnored) {
  const std::string csv = "Operator,load_N,slip,sinkage_m,Date\nEva,80,0.1,0.01,3 May\n,80,0.2,0.02,#N/A\n";
  const auto ignoring = [](const std::string& list) { return replaced(good_yaml, "columns: {}", "ignored: " + list); };
  const Campaign c = parse(ignoring("[Operator, Date]"), csv);
  ASSERT_EQ(c.runs.size(), 2U);
  EXPECT_EQ(c.runs[1].sinkage, 0.02);
  EXPECT_FALSE(c.columns.contains("Date"));
  EXPECT_THAT(refused(ignoring("[Operator]"), csv), HasSubstr("or leave it aside: ignored: [Date]"));
  EXPECT_THAT(refused(ignoring("[Operatr, Date]"), csv), HasSubstr("unknown column 'Operator'"));
  EXPECT_THAT(refused(ignoring("Date"), csv), HasSubstr("expected a list of column names"));
}

// v = r w (1 - s) of a driven wheel: at 30 rpm and 20 % slip on a level bed.
TEST(Campaign, TheRotationTellsTheSpeed) {
  const std::string csv = "load_N,slip,rotation_rpm,sinkage_m\n80,0.2,30,0.01\n80,0.4,,0.02\n";
  const Campaign c = parse(good_yaml, csv);
  EXPECT_NEAR(c.runs[0].at.speed, c.wheel.radius * 30 * 2 * std::numbers::pi / 60 * 0.8, 1e-12);
  EXPECT_EQ(c.runs[1].at.speed, OperatingCondition().speed) << "an empty cell: the usual speed";
  EXPECT_THAT(refused(good_yaml, "load_N,slip,speed_m_s,rotation_rpm,sinkage_m\n80,0.2,0.1,30,0.01\n"),
              StartsWith("runs.csv:1:23: columns 'speed_m_s' and 'rotation_rpm' both give the speed"));
}

// A locked wheel does not turn, however fast it is dragged; a wheel that turns is not locked.
TEST(Campaign, ARotationOfZeroIsThatOfALockedWheel) {
  const std::string header = "load_N,slip,rotation_rpm,sinkage_m\n80,0.2,30,0.01\n";
  const Campaign c = parse(good_yaml, header + "80,-1,0,0.02\n");
  EXPECT_EQ(c.runs[1].at.speed, OperatingCondition().speed) << "the usual speed, as without the cell";
  EXPECT_THAT(refused(good_yaml, header + "80,-1,3,0.02\n"), HasSubstr("it has no speed of rotation"));
}

TEST(Campaign, ALogIsToldFromRuns) {
  std::string csv = "load_N,slip,sinkage_m\n";
  for (std::size_t i = 0; i <= most_csv_rows; ++i) csv += "80,0.2,0.01\n";
  EXPECT_THAT(refused(good_yaml, csv),
              AllOf(HasSubstr("more than 100000 rows"), HasSubstr("hint: this is a log"),
                    HasSubstr("means of its steady part"), HasSubstr("NR % 10 == 0' 'runs.csv' > fewer.csv")));
}

TEST(Campaign, RealFilesHaveQuotesCarriageReturnsMarksAndBlankLines) {
  const Campaign c = parse(good_yaml,
                           "\xEF\xBB\xBF\"load_N\",slip, torque_Nm ,setpoint\r\n"
                           "1000,0.1,30,\"a, \"\"wet\"\"\nbed\"\r\n"
                           "\r\n"
                           ",, ,\r\n"
                           " 1000 ,\"0.2\",3e1,\r\n"
                           "1000,0.3,30.5,x");
  ASSERT_EQ(c.runs.size(), 3u);
  EXPECT_EQ(c.runs[0].setpoint, "a, \"wet\"\nbed");
  EXPECT_EQ(c.runs[1].at.slip, 0.2);
  EXPECT_FALSE(c.runs[1].setpoint);
  EXPECT_EQ(c.runs[1].csv_line, 6) << "a quoted line feed, a blank line and a row of empty cells count";
}

TEST(CampaignRefuses, MissingFiles) {
  EXPECT_THAT(refusal([] { read_campaign("no/such/folder", Library(), FakeVocabulary()); }),
              HasSubstr("no/such/folder: no such file"));
  EXPECT_THAT(refusal([] { read_campaign(SOILBIN_SOURCE_DIR "/cases", Library(), FakeVocabulary()); }),
              AllOf(HasSubstr("campaign.yaml: no such file"), HasSubstr("hint: soilbin init --campaign '")));
}

TEST(CampaignRefuses, UnknownColumns) {
  EXPECT_THAT(refused_csv("torque_Nm", "torqe_Nm"),
              AllOf(StartsWith("runs.csv:1:71: unknown column 'torqe_Nm', did you mean 'torque_Nm'?"),
                    HasSubstr("known without that: run, setpoint, load_N")));
  EXPECT_THAT(refused_csv("torque_Nm", "drawbar_pull_N"), HasSubstr("column 'drawbar_pull_N' appears twice"));
  EXPECT_THAT(refused_csv("torque_Nm", ""), HasSubstr("a spreadsheet writes its empty columns too"));
  EXPECT_THAT(refused_csv("torque_Nm", "torque_Nm;x"), HasSubstr("by commas or, all of them, by semicolons"));
}

// The line to write holds the header's own unit: pasted as it is, it must not read millimetres as metres.
TEST(CampaignRefuses, UnknownColumnsWithTheLineToWrite) {
  const std::vector<std::pair<std::string, std::string>> hints = {
      {"R2", "columns: {R2: {quantity: QUANTITY, unit: UNIT}}"},
      {"my own", "columns: {my own: {quantity: QUANTITY, unit: UNIT}}"},
      {"sinkage_max_mm", "{sinkage_max_mm: {quantity: sinkage, unit: mm}}"},
      {"Depth mm", "{Depth mm: {quantity: sinkage, unit: mm}}"},
      {"torqu_kNm", "{torqu_kNm: {quantity: torque, unit: kNm}}"},
      {"drawbar_pull", "{drawbar_pull: {quantity: drawbar_pull, unit: UNIT}}"},
      {"drawbar_pull_sd", "{drawbar_pull_sd: {quantity: drawbar_pull_sd, unit: UNIT}}"},
  };
  for (const auto& [header, hint] : hints) EXPECT_THAT(refused_csv("torque_Nm", header), HasSubstr(hint)) << header;
}

// A spreadsheet's remarks are told all at once, with the lines that campaign.yaml needs.
TEST(CampaignRefuses, AllUnknownColumnsAtOnce) {
  EXPECT_THAT(refused(good_yaml, "Date,load_N,slip,Pull kN,Operator\n3 May,80,0.1,0.01,Eva\n"),
              AllOf(StartsWith("runs.csv:1:1: unknown column 'Date'"), HasSubstr("unknown too: 'Pull kN', 'Operator'"),
                    HasSubstr("columns: {Pull kN: {quantity: drawbar_pull, unit: kN}}"),
                    HasSubstr("ignored: [Date, Operator]")));
}

// A heading that is a quantity with its unit says all that `columns:` could; what is not one stays unknown.
TEST(Campaign, HeadingsMayHoldTheirUnits) {
  const auto read = [](const std::string& header, const std::string& row) {
    return parse(good_yaml, header + "\n" + row + "\n").runs.front();
  };
  const auto plain = read("run,load_N,slip,speed_m_s,drawbar_pull_N,torque_Nm,sinkage_m", "3,2000,0.2,1.5,300,40,0.02");
  const std::pair<const char*, const char*> alike[] = {
      {"run,load_kN,slip_percent,speed_km_h,drawbar_pull_kN,torque_kNm,sinkage_mm", "3,2,20,5.4,0.3,0.04,20"},
      {"Run,Load [kN],Slip [%],Speed [m/s],Drawbar pull [N],Torque (N m),Sinkage [cm]", "3,2,20,1.5,300,40,2"},
      {"RUN,Load kN,Slip,speed_mm_s,Drawbar-pull_N,Torque Nm,SINKAGE_mm", "3,2,0.2,1500,300,40,20"},
  };
  for (const auto& [header, row] : alike) {
    SCOPED_TRACE(header);
    const auto run = read(header, row);
    EXPECT_EQ(run.at.run, plain.at.run);
    EXPECT_DOUBLE_EQ(run.at.load, plain.at.load);
    EXPECT_DOUBLE_EQ(run.at.slip, plain.at.slip);
    EXPECT_DOUBLE_EQ(run.at.speed, plain.at.speed);
    EXPECT_DOUBLE_EQ(*run.drawbar_pull, *plain.drawbar_pull);
    EXPECT_DOUBLE_EQ(*run.torque, *plain.torque);
    EXPECT_DOUBLE_EQ(*run.sinkage, *plain.sinkage);
  }
  for (const char* unlike : {"load_kg", "load", "slip_max_percent", "loads_kN", "load_kN_set", "load [kPa]"})
    EXPECT_THAT(refused(good_yaml, std::string("load_N,slip,torque_Nm,") + unlike + "\n1,0,1,1\n"),
                HasSubstr(std::string("unknown column '") + unlike + "'"));
  EXPECT_THAT(refused(good_yaml, "load_N,load_kN,slip,torque_Nm\n1,1,0,1\n"), HasSubstr("both hold 'load'"));
}

/// "Weight N: load [N]" of each column of a table, as they are guessed.
std::vector<std::string> guesses(const std::string& csv) {
  std::vector<std::string> all;
  for (const LikelyColumn& one : likely_columns(parse_csv(make_source_text(csv, "runs.csv"))))
    all.push_back(one.header + (one.column ? ": " + one.column->quantity + " [" + one.unit + "]" : ""));
  return all;
}

TEST(LikelyColumns, AreThoseThatSpreadsheetsCallSo) {
  EXPECT_THAT(guesses("Test no.,Test point,Weight N,Slip %,Pull N,Torque Nm,Depth mm,Remarks\n1,a,1,5,1,1,1,wet\n"),
              ElementsAre("Test no.: run []", "Test point: setpoint []", "Weight N: load [N]", "Slip %: slip [%]",
                          "Pull N: drawbar_pull [N]", "Torque Nm: torque [Nm]", "Depth mm: sinkage [mm]", "Remarks"));
  EXPECT_THAT(guesses("Fz [kN],Slip ratio,Fx [kN],Date\n1,0.2,1,3 May\n"),
              ElementsAre("Fz [kN]: load [kN]", "Slip ratio: slip [-]", "Fx [kN]: drawbar_pull [kN]", "Date"));
}

TEST(LikelyColumns, GoByTheirCellsToo) {
  EXPECT_THAT(guesses("Slip ratio\n0.2\n20\n"), ElementsAre("Slip ratio: slip [%]")) << "no share is above 1";
  EXPECT_THAT(guesses("Test\nA1\nA2\n"), ElementsAre("Test")) << "a run's number is a number";
  EXPECT_THAT(guesses("Weight kg\n80\n"), ElementsAre("Weight kg: load [kgf]")) << "a mass on a wheel is a weight";
  EXPECT_THAT(guesses("Depth of rut mm\n80\n"), ElementsAre("Depth of rut mm")) << "another depth";
  EXPECT_THAT(guesses("Weight\n80\n"), ElementsAre("Weight: load []")) << "only its author knows";
  EXPECT_THAT(guesses("Weight N,load_N\n1,1\n"), ElementsAre("Weight N", "load_N: load [N]")) << "our name first";
}

// Semicolons and decimal commas are read (DecimalCommas); tabs are not, and the commas in such rows are no cells.
TEST(CampaignRefuses, TabsBetweenCells) {
  EXPECT_THAT(
      refusal([] { parse_csv(make_source_text("load_N\tslip\n22,5\t0,1\n", "runs.csv")); }),
      AllOf(StartsWith("runs.csv:1:1: "), HasSubstr("parted by commas or, all of them, by semicolons, not by tabs")));
}

TEST(CampaignRefuses, TextInANumber) {
  EXPECT_THAT(refused_csv("122,", "abc,"),
              StartsWith("runs.csv:3:19: column 'drawbar_pull_N': expected a finite number, not 'abc'"));
  EXPECT_THAT(refused_csv("122,", "122 N,"),
              HasSubstr("hint: write 122: the unit of the whole column (N) stands in its name or in campaign.yaml"));
  for (const char* broken : {"#DIV/0!", "#REF!", "#N/A"})
    EXPECT_THAT(refused_csv("122,", std::string(broken) + ","),
                AllOf(StartsWith("runs.csv:3:19: column 'drawbar_pull_N': expected a finite number, not '#"),
                      HasSubstr("hint: the spreadsheet could not compute this cell: mend its formula, or leave")));
  const std::pair<const char*, const char*> told[] = {
      {"\"1,5\",", "hint: write 1.5: a decimal point is '.'"},
      {"\"1,400\",", "hint: this may be 1400 or 1.4: write it without the comma"},
      {"\"1,400,000\",", "hint: write 1400000: thousands are not separated"},
      {"\"1,400.5\",", "hint: write 1400.5: thousands are not separated"},
      {"03. Apr,", "a number such as 3.4 for a date: set the column's format to Number"},
      {"4-May,", "a number such as 3.4 for a date"},
      {"3/4/2026,", "a number such as 3.4 for a date"},
  };
  for (const auto& [cell, hint] : told) EXPECT_THAT(refused_csv("122,", cell), HasSubstr(hint)) << cell;
  std::string endless = "\"1";
  for (int i = 0; i < 200'000; ++i) endless += ",000";
  EXPECT_THAT(refused_csv("122,", endless + "\","), HasSubstr("a decimal point is '.'"));
  EXPECT_THAT(refused_csv("2,a,1000", "two,a,1000"), StartsWith("runs.csv:3:1: column 'run'"));
  EXPECT_THAT(refused_csv("0.1,2,", "0.1,1.5,"), HasSubstr("column 'pass': expected a whole number, not '1.5'"));
}

TEST(CampaignRefuses, NumbersThatAreNotFinite) {
  for (const char* text : {"nan", "NaN", "inf", "-Infinity", "1e999", "#N/A", "-"})
    EXPECT_THAT(refused_csv("122,", std::string(text) + ","),
                HasSubstr("column 'drawbar_pull_N': expected a finite number"));
}

TEST(CampaignRefuses, ValuesOutOfRange) {
  EXPECT_THAT(refused_csv("-1,1,4", "-1.01,1,4"),
              StartsWith("runs.csv:4:10: column 'slip': '-1.01' is out of range: must be -1 .. 1"));
  EXPECT_THAT(refused_csv("1000,0.1", "0,0.1"), HasSubstr("column 'load_N': '0 N' is out of range: must be above 0 N"));
  EXPECT_THAT(refused_csv("1000,0.1", "-1000,0.1"), HasSubstr("must be above 0 N"));
  EXPECT_THAT(refused_csv("0.1,2,", "0.1,0,"), HasSubstr("column 'pass'"));
  EXPECT_THAT(refused_csv("3.81", "381"), HasSubstr("must be 0 % .. 100 %"));
  EXPECT_THAT(refused_csv(",15,", ",150,"), HasSubstr("must be -90 deg .. 90 deg"));
}

TEST(CampaignRefuses, MissingConditionsAndChannels) {
  EXPECT_THAT(refused(good_yaml, "slip,torque_Nm\n0.1,1\n0.1,1\n0.1,1\n"), HasSubstr("column 'load_N' is missing"));
  EXPECT_THAT(refused(good_yaml, "load_N,torque_Nm\n1,1\n1,1\n1,1\n"), HasSubstr("column 'slip' is missing"));
  EXPECT_THAT(refused(good_yaml, "load_N,slip\n1,0\n1,0\n1,0\n"), StartsWith("runs.csv:1:1: no measured channel"));
  EXPECT_THAT(refused(good_yaml, "load_N,slip,torque_Nm\n1,0,\n1,0,\n1,0,\n"), HasSubstr("no measured channel"));
  EXPECT_THAT(refused_csv("2,a,1000", "2,a,"), StartsWith("runs.csv:3:5: column 'load_N': empty"));
}

std::string refused_fit(const std::string& csv) {
  return refusal([&] {
    const auto open = [&](const std::string& name) { return make_source_text(csv, name); };
    parse_campaign(make_source_text(good_yaml, "campaign.yaml"), open, Library(), FakeVocabulary(), CampaignUse::fit);
  });
}

TEST(CampaignRefuses, FewerRowsThanParametersOfAFit) {
  EXPECT_EQ(free_parameters(parse(good_yaml, good_csv).soil), 3) << "exponent, k_c and k_phi have an sd";
  EXPECT_THAT(
      refused_fit("load_N,slip,torque_Nm\n1000,0,1\n1000,0.1,2\n"),
      StartsWith("runs.csv:1:1: 2 rows with a measured value are fewer than the 3 free parameters of the soil"));
  EXPECT_THAT(refused_fit("load_N,slip,torque_Nm\n1000,0,1\n1000,0.1,2\n1000,0.2,\n"), HasSubstr("2 rows"));
  EXPECT_EQ(parse(good_yaml, "load_N,slip,torque_Nm\n1000,0,1\n").runs.size(), 1U) << "a prediction fits nothing";
  EXPECT_THAT(refused(good_yaml, "load_N,slip,torque_Nm\n"), HasSubstr("no row holds a measured value"));
}

TEST(CampaignRefuses, BrokenTables) {
  EXPECT_THAT(refused(good_yaml, ""), HasSubstr("the file is empty: a header line is expected"));
  EXPECT_THAT(refused_csv("122,\n", "122\n"), StartsWith("runs.csv:3:1: a row of 8 cells under a header of 9"));
  EXPECT_THAT(refused_csv("122,\n", "122,,\n"), HasSubstr("runs.csv:3:24: more cells in a row than the 9 expected"));
  EXPECT_THAT(refused_csv("122,", "\"122,"), StartsWith("runs.csv:3:19: a quote is opened here and never closed"));
  EXPECT_THAT(refused_csv("122,", "\"122\"x,"), HasSubstr("text behind a closing quote"));
  EXPECT_THAT(refused_csv("122,", "\xff,"), HasSubstr("byte 0xff is no text"));
  EXPECT_THAT(refused_csv("1,a", "# a comment\n1,a"), HasSubstr("a row of 1 cells")) << "there are no comments";
}

TEST(CampaignRefuses, UnitsOfAWrongDimension) {
  EXPECT_THAT(refused_yaml("0.25 m", "0.25 kg"), StartsWith("campaign.yaml:4:11: expected a length"));
  EXPECT_THAT(refused_yaml("0.25 m", "0.25"), HasSubstr("it has no unit"));
  EXPECT_THAT(refused_yaml("sd: 150 kN/m^(n+2)", "sd: 150 kPa"),
              StartsWith("campaign.yaml:10:48: expected a frictional modulus"));
  EXPECT_THAT(
      refused_yaml("columns: {}", "columns: {Fx: {quantity: drawbar_pull, unit: kPa}}"),
      StartsWith(
          "campaign.yaml:20:46: the unit of 'drawbar_pull' must be that of a force, such as 'N'; 'kPa' is a pressure"));
  EXPECT_THAT(refused_yaml("columns: {}", "columns: {Fx: {quantity: drawbar_pull}}"),
              HasSubstr("key 'unit' is missing"));
}

TEST(CampaignRefuses, MistakesInColumns) {
  EXPECT_THAT(refused_yaml("columns: {}", "columns: {Fx: {quantity: drawbar_pul, unit: N}}"),
              HasSubstr("did you mean 'drawbar_pull'?"));
  EXPECT_THAT(refused_yaml("columns: {}", "columns: {Fx: {quantity: sinkage, unit: mm}}"),
              HasSubstr("'runs.csv' has no column 'Fx'"));
  EXPECT_THAT(refused_yaml("columns: {}", "columns: {torque_Nm: {quantity: drawbar_pull, unit: N}}"),
              HasSubstr("columns 'drawbar_pull_N' and 'torque_Nm' both hold 'drawbar_pull'"));
  EXPECT_THAT(refused_yaml("columns: {}", "columns: [a]"), HasSubstr("expected a mapping of column names"));
}

TEST(CampaignRefuses, MistakesInTheYaml) {
  EXPECT_THAT(refused_yaml("force_frame: wheel", "force_fram: wheel"),
              StartsWith("campaign.yaml:21:1: unknown key 'force_fram', did you mean 'force_frame'?"));
  EXPECT_THAT(refused_yaml("force_frame: wheel", "force_frame: wheels"), HasSubstr("did you mean 'wheel'?"));
  EXPECT_THAT(refused_yaml("wheel:\n", "tire:\n"), HasSubstr("unknown key 'tire', did you mean 'wheel'?"));
  EXPECT_THAT(refused_yaml("cohesion: ", "cohesoin: "), HasSubstr("did you mean 'cohesion'?"));
  EXPECT_THAT(refused_yaml("format: soilbin-campaign/1", "format: soilbin-case/1"), HasSubstr("unknown format"));
  EXPECT_THAT(refused_yaml("  shear_modulus:  20 mm\n", ""), HasSubstr("key 'shear_modulus' is missing"));
  EXPECT_THAT(refused_yaml("1.10, sd", "nan, sd"), HasSubstr("must be finite"));
  EXPECT_THAT(refused_yaml("28 deg", "95 deg"), HasSubstr("out of range"));
}

class CampaignFolder : public testing::Test {
 protected:
  const test::Folder scratch_;
  const std::filesystem::path folder_ = scratch_.path();
};

TEST_F(CampaignFolder, IsWrittenAndReadBack) {
  Campaign c = parse(replaced(good_yaml, "effects: []", "effects: [lug_thrust]"), good_csv);
  c.runs[1].setpoint = "a, \"wet\"";
  write_campaign(folder_ / "new", c, FakeVocabulary());
  const Campaign by_folder = read_campaign(folder_ / "new", Library(), FakeVocabulary());
  const Campaign by_file = read_campaign(folder_ / "new" / "campaign.yaml", Library(), FakeVocabulary());
  EXPECT_EQ(by_folder.effects.at(0).parameters, c.effects.at(0).parameters);
  EXPECT_EQ(by_file.soil.k_phi.std_error, c.soil.k_phi.std_error);
  EXPECT_EQ(by_file.force_frame, c.force_frame);
  ASSERT_EQ(by_folder.runs.size(), c.runs.size());
  for (std::size_t i = 0; i < c.runs.size(); ++i) {
    EXPECT_EQ(by_folder.runs[i].setpoint, c.runs[i].setpoint);
    EXPECT_EQ(by_folder.runs[i].at.moisture, c.runs[i].at.moisture);
    EXPECT_EQ(by_folder.runs[i].at.yaw, c.runs[i].at.yaw);
    EXPECT_EQ(by_folder.runs[i].at.pass, c.runs[i].at.pass);
    EXPECT_EQ(by_folder.runs[i].torque, c.runs[i].torque);
  }
}

// What the library's files say of a name is what the campaign has; the rest of it is as written out.
TEST(Campaign, MayNameAWheelAndASoil) {
  const Library library({SOILBIN_SOURCE_DIR "/cases"});
  const auto named = [&](const std::string& wheel, const std::string& soil) {
    const auto open = [&](const std::string& name) { return make_source_text(good_csv, name); };
    const std::string yaml = "format: soilbin-campaign/1\nname: c\nwheel: " + wheel + "\nsoil: " + soil + "\n";
    return parse_campaign(make_source_text(yaml, "campaign.yaml"), open, library, FakeVocabulary());
  };
  const Campaign c = named("ding2011-lugged", "upland-sandy-loam");
  const Tire tire = find_tire("ding2011-lugged", library);
  const Soil soil = find_soil("upland-sandy-loam", library);
  EXPECT_EQ(c.wheel.radius, tire.radius);
  EXPECT_EQ(c.wheel.lugs.count, tire.lugs.count);
  for (const SoilParameter& p : soil_parameters) {
    EXPECT_EQ((c.soil.*p.value).value, ((*soil.semi_empirical).*p.value).value) << p.name;
    EXPECT_EQ((c.soil.*p.value).std_error, ((*soil.semi_empirical).*p.value).std_error) << p.name;
  }
  EXPECT_THAT(refusal([&] { named("ding2011-luged", "dry-sand"); }),
              AllOf(StartsWith("campaign.yaml:3:8: no tire"), HasSubstr("did you mean 'ding2011-lugged'?")));
  EXPECT_THAT(refusal([&] { named("ding2011-lugged", "dry-sant"); }),
              AllOf(StartsWith("campaign.yaml:4:7: no soil"), HasSubstr("did you mean 'dry-sand'?")));
  EXPECT_THAT(refusal([&] { named("ding2011-lugged", "nakanishi-sand"); }),
              HasSubstr("a campaign needs a soil with a 'semi_empirical' section"));
}

// Nobody measures c1 and c2 with plates: left out they are usual values, wide and told.
TEST(Campaign, WithoutStressAnglesTakesUsualOnes) {
  const std::string without =
      replaced(replaced(good_yaml, "  stress_angle_c1: 0.18\n", ""), "  stress_angle_c2: 0.32\n", "");
  const Campaign c = parse(without, good_csv);
  EXPECT_EQ(c.soil.stress_angle_c1.value, usual_stress_angle_c1.value);
  EXPECT_EQ(c.soil.stress_angle_c1.std_error, usual_stress_angle_c1.std_error);
  EXPECT_EQ(c.soil.stress_angle_c2.value, usual_stress_angle_c2.value);
  EXPECT_EQ(c.soil.sources.at("stress_angle_c2"), usual_stress_angle_source);
  EXPECT_EQ(parse(good_yaml, good_csv).soil.sources.count("stress_angle_c2"), 0u);
  EXPECT_EQ(free_parameters(c.soil), free_parameters(parse(good_yaml, good_csv).soil) + 2);
}

TEST(Campaign, EveryMeasuredOneIsRead) {
  const Library library({SOILBIN_SOURCE_DIR "/cases"});
  const std::vector<std::string> names = library.names(Shelf::measured);
  EXPECT_GE(names.size(), 4u);
  for (const std::string& name : names) {
    const Campaign c = read_campaign(*library.find(Shelf::measured, name), library, bekker_wong::CatalogueVocabulary());
    EXPECT_EQ(c.name, name);
    EXPECT_GE(static_cast<int>(c.runs.size()), free_parameters(c.soil)) << name;
  }
}

// A tire's pressure in each run, and what its carcass carries with what is not known of it; written, they are read
// again.
TEST(Campaign, HoldsInflationPressures) {
  const std::string yaml = replaced(good_yaml, "model: {effects: []}", "model: {effects: []}");
  const std::string csv =
      "load_N,slip,inflation_pressure_kPa,drawbar_pull_N,torque_Nm\n"
      "1000,0.1,150,120,30\n1000,0.2,300,122,31\n2000,0.3,,130,35\n2000,0.4,450,140,36\n";
  Campaign c = parse(yaml, csv);
  EXPECT_EQ(c.runs[0].at.inflation_pressure, 150e3);
  EXPECT_FALSE(c.runs[2].at.inflation_pressure);
  const std::string written = write_runs(c.runs);
  EXPECT_THAT(written, testing::HasSubstr("inflation_pressure_kPa"));
  const Campaign again = parse(yaml, written);
  for (std::size_t i = 0; i < c.runs.size(); ++i) EXPECT_EQ(again.runs[i].at, c.runs[i].at);
  EXPECT_THAT(refused(yaml, replaced(csv, "150", "-150")), testing::HasSubstr("out of range"));
}

}  // namespace
}  // namespace soilbin::compare
