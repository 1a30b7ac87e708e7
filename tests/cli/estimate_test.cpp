#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <numbers>
#include <sstream>

#include "cli/command.hpp"

namespace soilbin::cli::test {
namespace {

using testing::AllOf;
using testing::ContainsRegex;
using testing::HasSubstr;
using testing::StartsWith;

const std::string wheel = "--soil dry-sand --radius 110mm --width 100mm --load 80N ";

TEST(Estimate, FlagsAloneAnswerWithUnitsAndErrors) {
  const Outcome r = soilbin("estimate " + wheel + "--slip 0.2");
  EXPECT_EQ(r.status, 0) << r.err;
  for (const char* word :
       {"Drawbar pull", "Torque", "Sinkage", "N m", "mm", "±", "shear thrust", "load 80 N", "slip 20 %"})
    EXPECT_THAT(r.out, HasSubstr(word));
  EXPECT_EQ(r.err, "");
}

// M w with w = v/(r (1 - s)); on level ground the efficiency is the pull over the energy a metre.
TEST(Estimate, PowerAndEnergyAreThoseOfTorqueAndRotation) {
  const std::string asked = "estimate " + wheel + "--slip 40% --speed 0.5m/s";
  const nlohmann::json row = soilbin(asked + " --json").json()["rows"][0];
  const double energy = row["torque"].get<double>() / (0.11 * (1 - 0.4));
  EXPECT_NEAR(row["energy_per_metre"].get<double>(), energy, 1e-12 * energy);
  EXPECT_NEAR(row["power"].get<double>(), 0.5 * energy, 1e-12 * energy);
  EXPECT_NEAR(row["tractive_efficiency"].get<double>(), row["drawbar_pull"].get<double>() / energy, 1e-12);
  EXPECT_THAT(soilbin(asked).out, ContainsRegex("Power +[0-9.]+ ± [0-9.]+ W at 0.500 m/s, [0-9.]+ ± [0-9.]+ J/m"));
  EXPECT_THAT(soilbin("estimate " + wheel + "--slip 100%").out, testing::Not(HasSubstr("Power")));
}

// A belt without losses has too high an efficiency; a rigid wheel has nothing to lose.
TEST(Estimate, SaysOnceThatACarcassLosesNothing) {
  const std::string asked = "estimate --soil sandy-loam --tire 14.00R20 --load 20kN --slip 10%,20% ",
                    said = "What a tire loses in flexing is not in the model";
  const std::string flexible = soilbin(asked).out;
  EXPECT_NE(flexible.find(said), std::string::npos);
  EXPECT_EQ(flexible.find(said), flexible.rfind(said));
  EXPECT_THAT(soilbin(asked + "--rigid").out, testing::Not(HasSubstr(said)));
}

// Cullinan sand has beds of 1390, 1511 and 1538 kg/m^3; its file asks about the middle one.
TEST(Estimate, ADensityPicksTheBedOfASoilThatHasSeveral) {
  const std::string sand = "estimate --soil cullinan-sand --radius 600mm --width 350mm --load 20kN --slip 20% --json ";
  const auto sinkage = [&](const std::string& flags) {
    const Outcome run = soilbin(sand + flags);
    EXPECT_EQ(run.status, 0) << run.err;
    EXPECT_THAT(run.err, testing::Not(HasSubstr("density is ignored")));
    return run.json().at("rows").at(0).at("sinkage").get<double>();
  };
  EXPECT_EQ(sinkage(""), sinkage("--density 1511kg/m^3"));
  EXPECT_GT(sinkage("--density 1390kg/m^3"), sinkage("--density 1450kg/m^3"));
  EXPECT_GT(sinkage("--density 1450kg/m^3"), sinkage("--density 1511kg/m^3"));
  const Outcome beyond = soilbin(sand + "--density 1600kg/m^3");
  EXPECT_THAT(beyond.err, HasSubstr("1600 kg/m^3 lies beyond the beds that were tested, 1390 to 1538 kg/m^3"));
  EXPECT_EQ(beyond.json().at("soil"), "cullinan-sand at 1600 kg/m^3");
  EXPECT_THAT(soilbin(sand + "--density 1900kg/m^3"), Refuses(HasSubstr("--density: 1900 kg/m^3 is out of reach")));
}

// A value that is typed beside the density goes before the bed's.
TEST(Estimate, ValuesBesideADensityStandInTheBed) {
  const Outcome run = soilbin(
      "estimate --soil cullinan-sand --radius 600mm --width 350mm --load 20kN --slip 20% --json --density 1450kg/m^3 "
      "--friction-angle 35deg");
  EXPECT_EQ(run.json().at("soil"), "cullinan-sand at 1450 kg/m^3, changed");
  EXPECT_THAT(run.json().at("case").get<std::string>(), HasSubstr("friction_angle: {value: 35 deg"));
}

// Readers expect 0 there; a wheel at v = r w still makes a rut.
TEST(Estimate, SaysWhyThePullWithoutSlipIsNotZero) {
  constexpr const char* why = "At 0 % slip (v = r ω) the soil is still compacted";
  EXPECT_THAT(soilbin("estimate " + wheel + "--slip 0%").out, HasSubstr(why));
  EXPECT_THAT(soilbin("run rover-slip").out, HasSubstr(why));
  EXPECT_THAT(soilbin("estimate " + wheel + "--slip 1%").out, testing::Not(HasSubstr(why)));
}

// Errors that hold a part of the doubt alone mislead: the second line of an answer says which part.
TEST(Estimate, TheFirstLinesSayWhatTheErrorsHold) {
  const std::string table = soilbin("estimate " + wheel + "--slip 0.2").out;
  EXPECT_THAT(table, HasSubstr("on dry-sand\n± is one standard error from the standard deviations of K, c1, c2 "
                               "(declared) and k_c, k_phi, c, phi (assumed: 10 %, no source); n counts as exact.\n"));
  const std::string off = "estimate " + wheel + "--slip 0.2 --no-assumed-sd";
  EXPECT_THAT(soilbin(off).out,
              HasSubstr("from the standard deviations of K, c1, c2; n, k_c, k_phi, c, phi count as exact."));
  const nlohmann::json with = soilbin("estimate " + wheel + "--slip 0.2 --json").json()["rows"][0],
                       without = soilbin(off + " --json").json()["rows"][0];
  EXPECT_EQ(with["sinkage"], without["sinkage"]) << "no value moves";
  EXPECT_GT(with["std_error"]["sinkage"], without["std_error"]["sinkage"]);
  const Scratch scratch;
  const fs::path soil = scratch.write("s.yaml",
                                      "format: soilbin-soil/1\nsemi_empirical: {exponent: 1, k_c: 1 kN/m^(n+1), "
                                      "k_phi: 2000 kN/m^(n+2), cohesion: 1 kPa, friction_angle: 30 deg, "
                                      "shear_modulus: 20 mm, stress_angle_c1: 0.3, stress_angle_c2: 0.2}\n");
  EXPECT_THAT(soilbin("estimate --soil '" + soil.string() + "' --radius 110mm --width 100mm --load 80N --slip 0.2").out,
              HasSubstr("No ±: all values of the soil count as exact."));
}

TEST(Estimate, ASoilWithoutC1AndC2SaysWhatIsTaken) {
  const Scratch scratch;
  const fs::path soil = scratch.write("s.yaml",
                                      "format: soilbin-soil/1\nsemi_empirical: {exponent: 1, k_c: 1 kN/m^(n+1), "
                                      "k_phi: 2000 kN/m^(n+2), cohesion: 1 kPa, friction_angle: 30 deg, "
                                      "shear_modulus: 20 mm}\n");
  const Outcome r = soilbin("check '" + soil.string() + "'");
  EXPECT_EQ(r.status, 0) << r.err;
  EXPECT_THAT(r.out, AllOf(HasSubstr("the soil declares no c1: 0.3 with a standard deviation of 0.15 is taken"),
                           HasSubstr("the soil declares no c2: 0.25")));
}

TEST(Estimate, JsonHasTheContractsNamesAndABudgetThatAddsUp) {
  const Outcome r = soilbin("estimate " + wheel + "--slip 20% --yaw 5deg --longitudinal-incline 3deg --json");
  ASSERT_EQ(r.status, 0) << r.err;
  const nlohmann::json row = r.json()["rows"].at(0);
  for (const char* key : {"drawbar_pull", "torque", "sinkage", "lateral_force", "theta_1"})
    EXPECT_TRUE(row.at(key).is_number()) << key;
  double sum = 0.0;
  for (const auto& part : row["budget"]) sum += part["force"].get<double>();
  EXPECT_NEAR(sum, row["drawbar_pull"].get<double>(), 1e-9);
  EXPECT_GT(row["std_error"]["drawbar_pull"].get<double>(), 0.0);
  EXPECT_NEAR(row["yaw"].get<double>(), 5 * std::acos(-1.0) / 180, 1e-12);
}

// What was asked, flags and all, as a case that answers the same.
TEST(Estimate, JsonHoldsItsCase) {
  const nlohmann::json asked =
      soilbin("estimate " + wheel + "--slip 0.2 --friction-angle 35deg --effect lug_thrust:passive_blade,a=1 --json")
          .json();
  const auto file = std::filesystem::path(testing::TempDir()) / "asked.yaml";
  std::ofstream(file) << asked["case"].get<std::string>();
  const nlohmann::json again = soilbin("estimate '" + file.string() + "' --json").json();
  EXPECT_EQ(again["rows"][0]["drawbar_pull"], asked["rows"][0]["drawbar_pull"]);
  EXPECT_THAT(asked["case"].get<std::string>(), AllOf(HasSubstr("form: passive_blade"), HasSubstr("35 deg")));
}

// Typed values that change nothing, or half of what belongs together.
TEST(Estimate, DoubtsWhatWasTyped) {
  const std::string point = "estimate " + wheel + "--slip 0.2 ";
  EXPECT_THAT(soilbin(point + "--gravity 1.62m/s^2").err, HasSubstr("gravity is ignored"));
  EXPECT_EQ(soilbin(point + "--gravity 1.62m/s^2 --effect bulldozing").err, "");
  EXPECT_THAT(soilbin(point + "--exponent 0.9").err, HasSubstr("n was changed and k_phi was not"));
  EXPECT_EQ(soilbin(point + "--exponent 1.1+-0.05").err, "") << "dry-sand's own n";
}

TEST(Estimate, SeveralSlipsGiveATableAndAPlotWithoutAFile) {
  const Scratch scratch;
  const std::string asked = "estimate --tire rover-wheel --soil dry-sand --load 65N --slip 0%..60%",
                    plot = (scratch / "slip.svg").string(), csv = (scratch / "slip.csv").string();
  const Outcome r = soilbin(asked + " --plot '" + plot + "' --csv '" + csv + "'");
  ASSERT_EQ(r.status, 0) << r.err;
  EXPECT_THAT(r.out, AllOf(HasSubstr("\nload 65 N\n"), HasSubstr("slip [%]  drawbar pull [N]")));
  EXPECT_THAT(text_of(plot), AllOf(HasSubstr("<svg"), HasSubstr("rover-wheel on dry-sand, load 65 N")));
  const std::string table = text_of(csv);
  EXPECT_EQ(std::ranges::count(table, '\n'), 1 + 7) << "a header and seven slips";
  std::vector<double> slips;
  const nlohmann::json document = soilbin(asked + " --json").json();
  for (const auto& row : document["rows"]) slips.push_back(row["slip"]);
  EXPECT_THAT(slips, testing::ElementsAre(0.0, 0.1, 0.2, 0.3, 0.4, 0.5, 0.6));
}

// A table's rows tell what differs; its title tells the slope on which all of it stands, in each form of the answer.
TEST(Estimate, ATableSaysWhatItsRowsShare) {
  const Scratch scratch;
  const std::string page = (scratch / "page.html").string(), folder = (scratch / "text").string(),
                    shared = "load 65 N, uphill 10°, yaw 5°";
  const Outcome r = soilbin(
      "estimate --tire rover-wheel --soil dry-sand --load 65N --slip 10%,20% --longitudinal-incline 10deg --yaw 5deg "
      "--report '" +
      page + "' --markdown '" + folder + "'");
  EXPECT_THAT(r.out, HasSubstr("\n" + shared + "\n"));
  EXPECT_THAT(text_of(page), HasSubstr("<h1>rover-wheel on dry-sand, " + shared + "</h1>"));
  EXPECT_THAT(text_of(std::filesystem::path(folder) / "report.md"), HasSubstr("rover-wheel on dry-sand, " + shared));
  EXPECT_THAT(soilbin("limits --tire rover-wheel --soil dry-sand --load 65N --transverse-incline 10deg").out,
              HasSubstr("\nanalytic wheel, load 65 N, cross slope 10°\n"));
  EXPECT_THAT(soilbin("run rover-slip --yaw 5deg").out, HasSubstr("yaw 5°\n"));
}

/// Load [N] and slip of each row of an answer.
std::vector<std::pair<double, double>> loads_and_slips(const std::string& arguments) {
  std::vector<std::pair<double, double>> all;
  const Outcome r = soilbin(arguments + " --json");
  EXPECT_EQ(r.status, 0) << r.err;
  const nlohmann::json document = r.status == 0 ? r.json() : nlohmann::json{{"rows", {}}};
  for (const auto& row : document["rows"]) all.emplace_back(row["load"], row["slip"]);
  return all;
}

// At one slip curves run over what else varies, one for each pass.
TEST(Estimate, ThePlotRunsOverLoadWhereSlipStays) {
  const Scratch scratch;
  const std::string plot = (scratch / "load.svg").string();
  const Outcome r = soilbin(
      "estimate --tire rover-wheel --soil dry-sand --slip 20% --load 40N..80N --pass 1,2,3 "
      "--effect multipass --plot '" +
      plot + "'");
  ASSERT_EQ(r.status, 0) << r.err;
  EXPECT_THAT(text_of(plot),
              AllOf(HasSubstr("load [N]"), HasSubstr("pass 2"), HasSubstr("slip 20 %"), Not(HasSubstr("slip [%]"))));
}

TEST(Estimate, ListsAndStepsSpanAGridSlipFastest) {
  using testing::ElementsAre;
  using testing::Pair;
  const std::string asked = "estimate --tire rover-wheel --soil dry-sand ";
  const auto grid = ElementsAre(Pair(40, 0.1), Pair(40, 0.2), Pair(60, 0.1), Pair(60, 0.2));
  EXPECT_THAT(loads_and_slips(asked + "--slip 10%,20% --load 40N,60N"), grid);
  EXPECT_THAT(loads_and_slips(asked + "--slip 10%..20%:10% --load 40N..60N:20N"), grid);
  EXPECT_THAT(loads_and_slips(asked + "--slip 0.1,0.2 --load 40N,60N"), grid);
  EXPECT_THAT(loads_and_slips(asked + "--slip 10% --load 40,50,60N"),
              ElementsAre(Pair(40, 0.1), Pair(50, 0.1), Pair(60, 0.1)))
      << "the last one's unit is that of all";
  EXPECT_THAT(loads_and_slips(asked + "--slip 10% --load 100,120N"), ElementsAre(Pair(100, 0.1), Pair(120, 0.1)))
      << "nobody writes a third decimal of 0";
}

TEST(Estimate, RefusesTwoValuesThatMayBeOneWithADecimalComma) {
  for (const auto& [condition, hint] : {std::pair{"--load 80N --slip 0,1", "'0.0,1.0' are two, '0.1' is one"},
                                        {"--slip 20% --load 80,5N", "'80N,5N' are two, '80.5N' is one"},
                                        {"--slip 20% --load 1,500N", "'1N,500N' are two, '1.500N' is one"},
                                        {"--slip 20% --load 80,50N", "'80N,50N' are two, '80.50N' is one"},
                                        {"--slip 20% --load 1,5kN", "'1kN,5kN' are two, '1.5kN' is one"}}) {
    EXPECT_THAT(soilbin(std::string("estimate --tire rover-wheel --soil dry-sand ") + condition),
                Refuses(HasSubstr(hint)));
  }
}

// The study has 65 N alone, at 0 to 60 % slip.
TEST(Estimate, SeveralValuesPickAndOverrideACase) {
  using testing::ElementsAre;
  using testing::Pair;
  EXPECT_THAT(loads_and_slips("estimate paper-straight --effect none --load 4kN --slip 10%,20%"),
              ElementsAre(Pair(4000, 0.1), Pair(4000, 0.2)));
  EXPECT_THAT(loads_and_slips("run paper-straight --load 4kN --slip 10%,11%"),
              ElementsAre(Pair(4000, 0.1), Pair(4000, 0.11), Pair(4000, 0.1), Pair(4000, 0.11)))
      << "one that the study has, and one that it doesn't have; by each of its two models";
}

TEST(Estimate, ARangeThatIsNoneIsRefusedByItsFlag) {
  const std::pair<const char*, const char*> refused[] = {
      {"--slip 0%..60%..80%", "--slip: expected a list or a range, not '0%..60%..80%'"},
      {"--slip 0%..", "hint: such as 0,10,20%, or 0%..60%, or in steps 0%..60%:5%"},
      {"--slip ,", "--slip: expected a list or a range, not ','"},
      {"--slip 20% --yaw 0deg,", "hint: such as 1,2,5deg, or 1..5deg, or in steps 1..5:0.5deg"},
      {"--slip 0%..60%:-10%", "--slip 0%..60%:-10%: the step doesn't lead from one end of the range to the other"},
      {"--slip 0..0.6:10%", "--slip 0..0.6:10%: the range holds one value alone"},
      {"--slip 10%,300%", "--slip: "},
      {"--slip 20% --pass 1..3", "--pass: expected a whole number from 1 to 1000000000, not '1..3'"},
      {"--slip 0..1:0.0001 --yaw 0deg..1deg:0.01deg", "more than 100000 conditions"},
      {"--slip 20% --plot a.svg", "--plot draws curves: it takes several values of slip or of another condition"}};
  for (const auto& [flags, said] : refused) EXPECT_THAT(soilbin("estimate " + wheel + flags), Refuses(HasSubstr(said)));
}

// Braked, F_DP v/(M w) is what the brakes take: no efficiency. The text says "none"; files and bindings say nothing.
TEST(Estimate, AWheelThatDoesNotPullHasNoEfficiency) {
  const Scratch scratch;
  const std::string csv = (scratch / "t.csv").string();
  for (const char* slip : {"-30%", "-5%", "0%"}) {
    const std::string at = std::string(" rover-slip --slip=") + slip;
    const Outcome r = soilbin("estimate" + at + " --json");
    ASSERT_EQ(r.status, 0) << r.err;
    const nlohmann::json document = r.json();
    for (const auto& row : document["rows"]) {
      EXPECT_TRUE(row["torque"] < 0.0 || row["drawbar_pull"] < 0.0) << slip;
      EXPECT_TRUE(row["tractive_efficiency"].is_null()) << slip;
    }
    ASSERT_EQ(soilbin("run" + at + " --csv '" + csv + "'").status, 0);
    std::istringstream lines(text_of(csv));
    std::string header, line;
    std::getline(lines, header);
    const auto before = std::count(header.begin(), header.begin() + static_cast<long>(header.find("tractive")), ',');
    while (std::getline(lines, line)) {
      std::size_t cell = 0;
      for (long i = 0; i < before; ++i) cell = line.find(',', cell) + 1;
      EXPECT_EQ(line[cell], ',') << "empty: " << line;
    }
  }
  const nlohmann::json pulling = soilbin("estimate paper-straight --load 4kN --slip 20% --json").json()["rows"][0];
  EXPECT_NEAR(pulling["tractive_efficiency"].get<double>(),
              pulling["drawbar_pull"].get<double>() * 0.496 * 0.8 / pulling["torque"].get<double>(), 1e-12)
      << "F_DP r (1 - s)/M";
}

// Reece's h s/(1 - s) at 90 % is 9 h = 90 mm on top of the balance: past 0.9 r = 99 mm.
TEST(Estimate, AWheelSettledDeeperThanTheModelIsMeantForIsTold) {
  const std::string deep = "estimate " + wheel + "--slip 90% --effect slip_sinkage:reece ";
  const Outcome text = soilbin(deep), json = soilbin(deep + "--json");
  EXPECT_EQ(text.status, 0);
  EXPECT_THAT(text.err, AllOf(HasSubstr("warning: the wheel settles to 103 % of its radius"), HasSubstr("90 %")));
  EXPECT_GT(json.json()["rows"][0]["sinkage"].get<double>(), 0.9 * 0.11);
  ASSERT_EQ(json.json()["warnings"].size(), 1U);
  EXPECT_FALSE(soilbin("estimate " + wheel + "--slip 20% --json").json().contains("warnings"));
}

// A clay without friction and a sand without cohesion, both in doubt: admissible, so they have an answer and its error.
TEST(Estimate, ASoilAtABoundHasItsErrors) {
  const Scratch scratch;
  for (const char* strength : {"cohesion: 20 kPa, friction_angle: {value: 0 deg, sd: 3 deg}",
                               "cohesion: {value: 0 kPa, sd: 0.5 kPa}, friction_angle: 30 deg"}) {
    const fs::path soil = scratch.write(
        "soil.yaml", std::string("format: soilbin-soil/1\nsemi_empirical: {exponent: 1, k_c: 0 kN/m^(n+1), "
                                 "k_phi: 2000 kN/m^(n+2), shear_modulus: 20 mm, stress_angle_c1: 0.2, "
                                 "stress_angle_c2: 0.3, ") +
                         strength + "}\n");
    const Outcome r =
        soilbin("estimate --soil '" + soil.string() + "' --radius 110mm --width 100mm --load 80N --slip 20% --json");
    ASSERT_EQ(r.status, 0) << r.err;
    EXPECT_GT(r.json()["rows"][0]["std_error"]["drawbar_pull"].get<double>(), 0.0) << strength;
  }
}

TEST(Estimate, WhatIsGivenAndChangesNothingIsTold) {
  const std::string base = "estimate " + wheel + "--slip 20% ";
  const struct {
    const char* more;
    const char* told;
  } cases[] = {{"--lug-height 10mm --effect none", "effect lug_thrust"},
               {"--inflation-pressure 100kPa --effect none", "effect tire_flexibility"},
               {"--pass 3", "effect multipass"},
               {"--moisture 5%", "effect moisture"},
               {"--effect multipass", "no condition has a 'pass'"},
               {"--effect drift", "no condition has a 'run'"}};
  const std::string plain = soilbin(base + "--json").json()["rows"][0]["budget"].dump();
  for (const auto& c : cases) {
    const Outcome r = soilbin(base + c.more + " --json");
    EXPECT_EQ(r.status, 0);
    EXPECT_THAT(r.err, AllOf(StartsWith("warning: "), HasSubstr(c.told))) << c.more;
    EXPECT_EQ(r.json()["rows"][0]["budget"].dump(), plain) << c.more << " changes no digit";
  }
  for (const char* heard : {"--lug-height 10mm --effect lug_thrust", "--pass 3 --effect multipass:rut_power"})
    EXPECT_EQ(soilbin(base + heard).err, "") << heard;
}

// A crushed tire is no weak soil: 0.3 bar under 34 kN on hard ground, where the rigid wheel sinks 5.7 mm.
TEST(Estimate, ATireThatCarriesNoMoreIsNoWeakSoil) {
  const Scratch scratch;
  const std::string hard = scratch
                               .write("hard.yaml",
                                      "format: soilbin-soil/1\nname: hard\nsemi_empirical: {exponent: 1, k_c: 0 "
                                      "kN/m^2, k_phi: 200000 kN/m^3, cohesion: 10 kPa, friction_angle: 30 deg, "
                                      "shear_modulus: 25 mm, stress_angle_c1: 0.4, stress_angle_c2: 0.2}\n")
                               .string();
  const std::string tire = " --radius 801mm --width 600mm --load 34335N --slip 20% --effect tire_flexibility ";
  const Outcome crushed = soilbin("estimate --soil '" + hard + "'" + tire + "--inflation-pressure 30kPa");
  EXPECT_EQ(crushed.status, 1);
  EXPECT_THAT(crushed.err, AllOf(HasSubstr("the tire is crushed"), HasSubstr("of 34.34 kN"),
                                 HasSubstr("Raise the inflation pressure"), Not(HasSubstr("the soil carries"))));
  const Outcome soft = soilbin("estimate --soil upland-sandy-loam" + tire + "--inflation-pressure 40kPa");
  EXPECT_EQ(soft.status, 0);
  EXPECT_THAT(soft.err, AllOf(HasSubstr("the tire deflects by "), HasSubstr("% of its radius")));
  EXPECT_THAT(soilbin("estimate --soil upland-sandy-loam" + tire + "--inflation-pressure 240kPa").err,
              Not(HasSubstr("the tire deflects by ")));
}

// A tire asked as a rigid wheel: told where that changes the answer, and with the file's own pressures.
TEST(Estimate, ATireThatFlattensAndIsAskedAsRigidIsTold) {
  const Scratch scratch;
  const auto truck = [&](const std::string& inflation) {
    return "--radius 670mm --width 430mm --carcass-pressure 20kPa --load 37.5kN --slip 20% --inflation-pressure " +
           inflation + " ";
  };
  const Outcome rigid = soilbin("estimate --soil dry-sand --effect none " + truck("300kPa"));
  EXPECT_THAT(rigid.err,
              AllOf(HasSubstr("the tire flattens at load 37.5 kN"), HasSubstr("inflation 300 kPa and carcass 20"),
                    HasSubstr("with --effect tire_flexibility")));
  EXPECT_THAT(soilbin("estimate --soil dry-sand --effect none " + truck("3000kPa")).err,
              Not(HasSubstr("the tire flattens")));
  const std::string flexible = soilbin("explain --soil sandy-loam --effect tire_flexibility " + truck("150kPa")).out;
  EXPECT_THAT(flexible, AllOf(HasSubstr("inflation 150 kPa and carcass 20 kPa give 170 kPa"),
                              HasSubstr("the flexible tire presses with"), Not(HasSubstr("add --effect"))));
}

TEST(Estimate, ASoilOfGrainsAloneIsBadInput) {
  EXPECT_THAT(soilbin("estimate --soil nakanishi-sand --radius 110mm --width 100mm --load 80N --slip 20%"),
              Refuses(AllOf(HasSubstr("no semi_empirical values"), HasSubstr("dry-sand"))));
}

TEST(Estimate, ABuriedWheelIsAnErrorWithStatusOne) {
  const Outcome text = soilbin("estimate " + wheel + "--load 80kN --slip 0.2");
  EXPECT_EQ(text.status, 2) << "a flag given twice is bad input";
  const Outcome r = soilbin("estimate --soil dry-sand --radius 110mm --width 100mm --load 80kN --slip 0.2 --json");
  EXPECT_EQ(r.status, 1);
  EXPECT_THAT(r.json()["rows"].at(0)["error"].get<std::string>(), HasSubstr("sink deeper"));
  EXPECT_THAT(r.err, HasSubstr("no solution"));
}

TEST(Estimate, BadInputNamesTheFlagAndTheNearestWord) {
  const struct {
    const char* arguments;
    const char* expected;
  } cases[] = {
      {"estimte", "did you mean 'estimate'?"},
      {"estimate --soill dry-sand", "did you mean '--soil'?"},
      {"estimate --soil dry-sand --radius 110mm --width 100kPa --load 80N --slip 0.2", "--width"},
      {"estimate --soil dry-sand --radius 110mm --width 100mm --load 80N --slip 1.2", "--slip"},
      {"estimate --soil dry-sand --radius 110mm --width 100mm --slip 0.2", "--load"},
      {"estimate --soil dry-sand --load 80N --slip 0.2", "--radius"},
      {"estimate --radius 110mm --width 100mm --load 80N --slip 0.2",
       "which soil? --soil NAME or a file\n  hint: such as dry-sand, sandy-loam, clayey-soil, snow, lunar-regolith; "
       "soilbin list soils has them all\n"},
      {"estimate --soil dry-sand --load 80N --slip 0.2",
       "hint: such as 14.00R20, 18.4-38, hmmwv, passenger-205-55r16, curiosity; soilbin list tires has them all\n"},
      {"estimate --soil dry-sand --tire rover-whel --load 80N --slip 0.2", "did you mean 'rover-wheel'?"},
      {"estimate --soil dry-sand --tire rover-wheel --load 80N --slip 0.2 --pass 1.5", "whole number"},
      {"estimate --soil dry-sand --tire rover-wheel --load 80N --slip 0.2 --slip-by travel", "travel_speed"},
      {"estimate --soil dry-sand --tire rover-wheel --load 80N --slip 0.2 --effect slip_sinkge", "slip_sinkage"},
      {"estimate --soil dry-sand --tire rover-wheel --load 80N --slip 0.2 --effect slip_sinkage:lyasco", "'lyasko'"},
      {"estimate --soil dry-sand --tire rover-wheel --load 80N --slip 0.2 --effect slip_sinkage,b=1",
       "no parameter 'b'"},
      {"estimate --soil dry-sand --tire rover-wheel --load 80N --slip 0.2 --effect slip_sinkage,a=99", "a:"},
      {"estimate --soil dry-sand --tire rover-wheel --load 80N --slip 0.2 --effect slip_sinkage --effect "
       "slip_sinkage:ding",
       "given twice"},
      {"estimate --soil dry-sand --tire rover-wheel --load 80N --slip 20", "did you mean '20%'?"},
      {"estimate --soil dry-sand --tire rover-wheel --load '18 lbs' --slip 0.2", "did you mean 'lbf'?"},
      {"estimate --soil dry-sand --tire rover-wheel --weight 80N --slip 0.2", "did you mean '--load'?"},
      {"estimate no-such-case.yaml", "no such file"},
  };
  for (const auto& c : cases) EXPECT_THAT(soilbin(c.arguments), Refuses(HasSubstr(c.expected))) << c.arguments;
}

TEST(Estimate, ACaseAnswersAllOrOneOfItsConditions) {
  EXPECT_EQ(soilbin("estimate paper-straight --json").json()["rows"].size(), 2U * 28U);
  const nlohmann::json one = soilbin("estimate paper-straight --load 4kN --slip 20% --json").json()["rows"];
  ASSERT_EQ(one.size(), 2U);
  EXPECT_EQ(one.at(0)["load"], 4000.0);
  EXPECT_NEAR(one.at(0)["speed"].get<double>(), 0.496 * 10 * 2 * std::acos(-1.0) / 60 * 0.8, 1e-9)
      << "the study's rotation stays";
}

TEST(Estimate, NoneSwitchesTheCasesEffectsOff) {
  const std::string point = "estimate rover-slip --slip 20% --json ";  // its models: the base, and with slip sinkage
  const auto both = soilbin(point).json()["rows"], base = soilbin(point + "--effect none").json()["rows"];
  ASSERT_EQ(both.size(), 2U);
  ASSERT_EQ(base.size(), 1U);
  EXPECT_EQ(base[0], both[0]);
  EXPECT_THAT(soilbin(point + "--effect none --effect slip_sinkage"),
              Refuses(HasSubstr("--effect none excludes all others")));
}

TEST(Explain, ShowsTheBudgetAndTheCrossChecks) {
  const std::string question = "explain " + wheel + "--slip 0.2 --effect bulldozing ";
  const Outcome text = soilbin(question);
  EXPECT_EQ(text.status, 0) << text.err;
  for (const char* word : {"Budget", "sum", "theta_1", "Bekker's static sinkage", "critical ground pressure"})
    EXPECT_THAT(text.out, HasSubstr(word));
  EXPECT_THAT(soilbin("explain --tire paper-lugged --soil paper-sand --load 4kN --slip 20%").out,
              AllOf(HasSubstr("Eq. 5"), HasSubstr("faulty")));
  const nlohmann::json row = soilbin(question + "--json").json()["rows"].at(0);
  EXPECT_EQ(row["effects"].size(), 1U);
}

const nlohmann::json& step_named(const nlohmann::json& row, const std::string& name) {
  for (const nlohmann::json& step : row["steps"])
    if (step["name"] == name) return step;
  throw std::runtime_error("no step " + name);
}

// An effect that settles the wheel moves it after the balance: the angle of the balance is that of the wheel without
// the effect, and the settled one fits the sinkage that is reported.
TEST(Explain, ASettledWheelHasTheAngleOfItsBalanceAndTheOneWhereItStands) {
  const std::string question = "explain --json --tire rover-wheel --soil dry-sand --load 65N --slip 60% ";
  const nlohmann::json plain = soilbin(question).json()["rows"].at(0);
  const nlohmann::json settled = soilbin(question + "--effect slip_sinkage:reece").json()["rows"].at(0);
  EXPECT_NEAR(step_named(settled, "entry angle")["value"].get<double>(),
              step_named(plain, "entry angle")["value"].get<double>(), 1e-9);
  const double angle = step_named(settled, "entry angle after settling")["value"].get<double>();
  EXPECT_NEAR(0.09 * (1 - std::cos(angle * std::numbers::pi / 180)), settled["sinkage"].get<double>(), 1e-9);
  EXPECT_THROW(step_named(plain, "entry angle after settling"), std::runtime_error);
  const double share = step_named(settled, "share of the soil's stresses there")["value"].get<double>();
  EXPECT_GT(share, 0.1);
  EXPECT_LT(share, 1.0) << "a deeper wheel asks less of the soil";
}

// What a compacted rut does to the soil's values is in the equations; what stands behind an equals sign is the value.
TEST(Explain, TheEquationsTakeTheSoilThatEffectsLeave) {
  const std::string question = "explain --json --tire rover-wheel --soil dry-sand --load 65N --slip 20% --pass 2 ";
  const nlohmann::json plain = soilbin(question).json()["rows"].at(0);
  const nlohmann::json second = soilbin(question + "--effect multipass:stiffer").json()["rows"].at(0);
  const auto value = [](const nlohmann::json& row, const char* step) {
    return step_named(row, step)["value"].get<double>();
  };
  EXPECT_NEAR(value(second, "soil's stiffness") / value(plain, "soil's stiffness"), 1 + 0.5 * (1 - std::exp(-1.0)),
              1e-9);
  EXPECT_GT(value(second, "normal stress there"), value(plain, "normal stress there"));
  const std::string j = step_named(plain, "shear displacement there")["numbers"];  // "0.09 m (0.2 - 0.8 * 0.1)"
  double r = 0, turned = 0, ratio = 0, sines = 0;
  ASSERT_EQ(std::sscanf(j.c_str(), "%lf m (%lf - %lf * %lf)", &r, &turned, &ratio, &sines), 4) << j;
  EXPECT_NEAR(1000 * r * (turned - ratio * sines), value(plain, "shear displacement there"), 0.05);
}

// A torque's equation names what has a part in it, and the parts add up.
TEST(Explain, TheTorqueOfLugsIsThatOfTheShearAndTheFaces) {
  const nlohmann::json row = soilbin(
                                 "explain --json --tire rover-wheel --soil dry-sand --load 65N --slip 40% "
                                 "--effect lug_thrust:passive_blade")
                                 .json()["rows"]
                                 .at(0);
  const nlohmann::json& torque = step_named(row, "torque");
  EXPECT_THAT(torque["equation"].get<std::string>(), HasSubstr("Int tau d theta + that of lug thrust"));
  const std::string sum = torque["numbers"].get<std::string>();
  const double shear = std::stod(sum), faces = std::stod(sum.substr(sum.find('+') + 1));
  EXPECT_NEAR(shear + faces, torque["value"].get<double>(), 1e-5);
}

// Shear brakes a locked wheel, as its torque does; a wheel at yaw is sheared along both axes, and its side force stands
// among the equations.
TEST(Explain, ShearHasTheSignOfTheTorqueAndAtYawBothItsParts) {
  const std::string question = "explain --json --tire rover-wheel --soil dry-sand --load 65N ";
  const nlohmann::json locked = soilbin(question + "--slip -100%").json()["rows"].at(0);
  EXPECT_LT(locked["torque"].get<double>(), 0.0);
  EXPECT_LT(step_named(locked, "shear stress there")["value"].get<double>(), 0.0);
  for (const char* frame : {"travel", "wheel"}) {
    const nlohmann::json yawed =
        soilbin(question + "--slip 20% --yaw 10deg --longitudinal-incline 4deg --transverse-incline 3deg " +
                "--force-frame " + frame)
            .json()["rows"]
            .at(0);
    const double along = step_named(yawed, "shear displacement in the wheel's plane")["value"];
    const double across = step_named(yawed, "shear displacement across it")["value"];
    EXPECT_NEAR(step_named(yawed, "shear displacement there")["value"].get<double>(), std::hypot(along, across), 1e-9);
    const nlohmann::json side = step_named(yawed, "lateral force");
    EXPECT_EQ(side["value"], yawed["lateral_force"]);
    double sum = 0.0, factor = 1.0, sign = 1.0;  // "1.2 N * 0.17 + 3.4 N * 0.98 - 5.6 N"
    std::istringstream words(side["numbers"].get<std::string>());
    for (std::string word; words >> word;) {
      if (word == "+" || word == "-") {
        sum += sign * factor, factor = 1.0, sign = word == "+" ? 1.0 : -1.0;
      } else if (word != "N" && word != "*") {
        factor *= std::stod(word);
      }
    }
    EXPECT_NEAR(sum + sign * factor, yawed["lateral_force"].get<double>(), 0.01) << side["numbers"];
  }
}

TEST(Explain, EndsWithTheSourceOfEachValue) {
  const std::string question = "explain --tire rover-wheel --soil dry-sand --radius 95mm --load 80N --slip 0.2 ";
  const Outcome text = soilbin(question);
  const std::string sources = text.out.substr(text.out.find("Where the values come from"));
  EXPECT_THAT(sources, ContainsRegex("tire: radius +95 mm +given on the command line"));
  EXPECT_THAT(sources, ContainsRegex("tire: width +110 mm +Ishigami"));
  EXPECT_THAT(sources, ContainsRegex("soil: cohesion c +1.04 ± 0.10 kPa \\(± assumed\\) +Wong"));
  EXPECT_THAT(sources, ContainsRegex("soil: shear modulus K +20.0 ± 6.0 mm +chosen"));
  const nlohmann::json all = soilbin(question + "--json").json()["sources"];
  ASSERT_EQ(all.size(), 2U + 8U + 1U);  // wheel, soil, its density
  EXPECT_EQ(all[0], (nlohmann::json{{"of", "tire"},
                                    {"name", "radius"},
                                    {"value", 0.095},
                                    {"std_error", 0.0},
                                    {"assumed_sd", false},
                                    {"source", "given on the command line"}}));
}

/// A truck tire of 270 kPa on soft soil.
const std::string truck = "--tire truck-335-65r22 --soil upland-sandy-loam --load 20kN --slip 20% ";

TEST(Estimate, AnswersAtSeveralInflationPressures) {
  const Outcome r = soilbin("estimate " + truck + "--inflation-pressure 100,200,300kPa --json");
  ASSERT_EQ(r.status, 0) << r.err;
  const nlohmann::json rows = r.json()["rows"];
  ASSERT_EQ(rows.size(), 3U);
  for (std::size_t i = 0; i < rows.size(); ++i)
    EXPECT_DOUBLE_EQ(rows[i]["inflation_pressure"], 1e5 * static_cast<double>(i + 1));
  EXPECT_LT(rows[0]["sinkage"], rows[1]["sinkage"]) << "softer is shallower";
  EXPECT_LT(rows[1]["sinkage"], rows[2]["sinkage"]);
  const Scratch scratch;
  const std::string plot = (scratch / "pressure.svg").string(), csv = (scratch / "pressure.csv").string();
  const Outcome drawn =
      soilbin("estimate " + truck + "--inflation-pressure 100..300kPa --plot '" + plot + "' --csv '" + csv + "'");
  ASSERT_EQ(drawn.status, 0) << drawn.err;
  EXPECT_THAT(text_of(plot), HasSubstr("inflation pressure [kPa]"));
  EXPECT_THAT(text_of(csv), HasSubstr("inflation_pressure_kPa"));
  // Where the tire declares the pressure, the condition that tells the same changes nothing.
  const nlohmann::json own = soilbin("estimate " + truck + "--json").json()["rows"][0],
                       told = soilbin("estimate " + truck + "--inflation-pressure 270kPa --json").json()["rows"][0];
  EXPECT_EQ(own["drawbar_pull"], told["drawbar_pull"]);
}

// A tire with a declared pressure is flexible where it flattens, and the answer says so; --rigid: the rigid wheel.
TEST(Estimate, ATireWithAPressureIsFlexibleWhereItFlattens) {
  const std::string soft = truck + "--inflation-pressure 100kPa ";
  for (const char* command : {"estimate ", "limits ", "explain "}) {
    std::string flags = soft;
    if (std::string(command) == "limits ") flags.replace(flags.find("--slip 20% "), 11, "");
    const Outcome r = soilbin(command + flags);
    ASSERT_EQ(r.status, 0) << r.err;
    EXPECT_THAT(r.err, HasSubstr("flexible where the soil presses with more than its 100 kPa")) << command;
    EXPECT_THAT(r.err, HasSubstr("tire_flexibility")) << command;
  }
  const auto row = [](const std::string& flags) { return soilbin("estimate " + flags + "--json").json()["rows"][0]; };
  const nlohmann::json flexible = row(soft), named = row(soft + "--effect tire_flexibility "),
                       rigid = row(truck + "--rigid "), none = row(soft + "--effect none ");
  EXPECT_EQ(flexible["drawbar_pull"], named["drawbar_pull"]);
  EXPECT_GT(rigid["sinkage"], flexible["sinkage"]);
  EXPECT_EQ(rigid["drawbar_pull"], none["drawbar_pull"]);
  EXPECT_THAT(soilbin("estimate " + truck + "--rigid").err, testing::Not(HasSubstr("flexible")));
  EXPECT_EQ(soilbin("estimate " + soft + "--rigid").status, 2);
  EXPECT_EQ(soilbin("estimate " + truck + "--rigid --effect tire_flexibility").status, 2);
}

// A maker's load-deflection table: the form that reads it is taken, what it gives is told, and what it does not reach.
TEST(Estimate, ATireIsAsStiffAsItsMakersTable) {
  const Scratch scratch;
  scratch.write("table.csv",
                "load_kN,pressure_kPa,deflection_mm\n10,150,32.5\n20,150,61\n30,150,88\n10,250,22.5\n"
                "20,250,43\n30,250,63.5\n");
  const std::string tire = " --tire '" +
                           scratch
                               .write("tire.yaml",
                                      "format: soilbin-tire/1\nradius: 670 mm\nwidth: 430 mm\n"
                                      "inflation_pressure: 150 kPa\ndeflection: table.csv\n")
                               .string() +
                           "' --soil sandy-loam --slip 20% ";
  const Outcome r = soilbin("explain" + tire + "--load 20kN");
  ASSERT_EQ(r.status, 0) << r.err;
  EXPECT_THAT(r.err,
              HasSubstr("flexible, by its load-deflection table (effect tire_flexibility, form carcass_spring)"));
  EXPECT_THAT(r.out, HasSubstr("(6 rows, 10 .. 30 kN, 150 .. 250 kPa) 61 mm on firm ground under 20 kN at 150 kPa"));
  EXPECT_THAT(r.out, testing::ContainsRegex("load-deflection table +6 rows +table.csv"));
  const auto sinkage = [](const std::string& asked) {
    return soilbin("estimate" + asked + " --json").json()["rows"][0]["sinkage"].get<double>();
  };
  const double own = sinkage(tire + "--load 20kN"), harder = sinkage(tire + "--load 20kN --inflation-pressure 250kPa"),
               rigid = sinkage(tire + "--load 20kN --rigid");
  EXPECT_LT(own, harder);
  EXPECT_LT(harder, rigid);
  EXPECT_THAT(soilbin("estimate" + tire + "--load 40kN").err,
              HasSubstr("40 kN at 150 kPa lie outside the tire's load-deflection table (6 rows"));
  EXPECT_THAT(soilbin("estimate" + tire + "--load 20kN --effect tire_flexibility:flat_section").err,
              HasSubstr("the load-deflection table is ignored: add --effect tire_flexibility:carcass_spring or "
                        "tire_flexibility:substitute_circle"));
  EXPECT_THAT(soilbin("check '" + (scratch / "tire.yaml").string() + "'").out,
              HasSubstr("load-deflection table of 6 rows"));
  // The resolved case holds the rows.
  scratch.write("case.yaml",
                "format: soilbin-case/1\nname: c\ntire: tire.yaml\nsoil: sandy-loam\nstudy:\n  conditions: "
                "{load: 20 kN, slip: 20 %}\n");
  const std::string folder = "'" + (scratch / "out").string() + "'";
  ASSERT_EQ(soilbin("run '" + (scratch / "case.yaml").string() + "' --output " + folder).status, 0);
  fs::remove(scratch / "table.csv");
  const Outcome again = soilbin("run '" + (scratch / "out/case.yaml").string() + "' --json");
  ASSERT_EQ(again.status, 0) << again.err;
  EXPECT_EQ(again.json()["rows"][0]["sinkage"], own);
  EXPECT_THAT(text_of(scratch / "out/case.yaml"), HasSubstr("source: \"table.csv\""));
}

// A tire with lugs has their thrust, and the answer says by which form; --no-lugs: the smooth wheel, of which no more
// is told. A wheel whose effects are named keeps to them.
TEST(Estimate, ATireWithLugsHasThem) {
  const std::string large = "--soil dry-sand --radius 250mm --width 100mm --load 400N ";
  const std::string lugged = large + "--lug-height 8mm --lug-count 24 ", slip = "--slip 20% ";
  for (const char* command : {"estimate ", "limits ", "explain "}) {
    const Outcome r = soilbin(command + lugged + (std::string(command) == "limits " ? "" : slip));
    ASSERT_EQ(r.status, 0) << r.err;
    EXPECT_THAT(r.err, HasSubstr("taken with its lugs (effect lug_thrust, form passive_blade); --no-lugs")) << command;
  }
  const auto row = [](const std::string& flags) { return soilbin("estimate " + flags + "--json").json()["rows"][0]; };
  const nlohmann::json with = row(lugged + slip), named = row(lugged + slip + "--effect lug_thrust:passive_blade "),
                       without = row(lugged + slip + "--no-lugs "), smooth = row(large + slip);
  EXPECT_EQ(with["drawbar_pull"], named["drawbar_pull"]);
  EXPECT_EQ(without["drawbar_pull"], smooth["drawbar_pull"]);
  EXPECT_GT(with["drawbar_pull"], without["drawbar_pull"]);
  EXPECT_EQ(row(lugged + slip + "--effect none ")["drawbar_pull"], smooth["drawbar_pull"]);
  const Outcome bare = soilbin("estimate " + lugged + slip + "--no-lugs");
  EXPECT_EQ(bare.err, "");
  EXPECT_THAT(bare.out, HasSubstr("b 100 mm, smooth)"));
  EXPECT_THAT(soilbin("estimate " + large + slip + "--no-lugs").err, HasSubstr("--no-lugs is ignored"));
  EXPECT_EQ(soilbin("estimate " + lugged + slip + "--no-lugs --effect lug_thrust").status, 2);
  EXPECT_THAT(soilbin("run paper-straight --recorded --no-lugs --load 4kN --slip 20%"),
              Refuses(HasSubstr("grains meet the tire with its lugs\n  hint: --model bekker_wong")));
}

// The bound that explain shows and the thrust beside it do not contradict each other, however many lugs there are.
TEST(Estimate, ExplainsALargestThrustThatHolds) {
  for (const char* lugged : {"--radius 250mm --width 100mm --load 400N --lug-height 30mm --lug-count 150 ",
                             "--tire 16.00R20 --load 36kN ", "--tire 18.4-38 --load 20kN --inflation-pressure 60kPa "})
    for (const char* form :
         {"passive_blade,a=1", "free_blade,a=10", "level_blade,a=10", "side_factors,a=10", "shear_radius,lambda_s=4"}) {
      const Outcome r = soilbin(std::string("explain --soil upland-sandy-loam --slip 60% --json ") + lugged +
                                "--effect lug_thrust:" + form);
      ASSERT_EQ(r.status, 0) << r.err;
      const nlohmann::json row = r.json()["rows"][0];
      double thrust = 0.0, most = 0.0;
      for (const auto& part : row["budget"])
        if (part["name"] == "shear_thrust" || part["name"] == "lug_thrust") thrust += part["force"].get<double>();
      for (const auto& check : row["cross_checks"])
        if (check["name"] == "largest thrust of this soil") {
          most = check["value"];
          EXPECT_THAT(check["remark"].get<std::string>(), testing::Not(HasSubstr("more, as an effect")));
        }
      EXPECT_GT(thrust, 0.0);
      EXPECT_LE(thrust, most * (1 + 1e-12)) << lugged << form;
    }
}

TEST(Estimate, TakesATireByItsSize) {
  const std::string asked = " --soil upland-sandy-loam --load 15kN --slip 15%";
  const Outcome sized = soilbin("estimate --tire 540/65R30" + asked),
                stored = soilbin("estimate --tire 16.00r20" + asked);
  ASSERT_EQ(sized.status, 0) << sized.err;
  EXPECT_THAT(sized.out, HasSubstr("540/65R30 (r 732 mm, b 540 mm, smooth)"));
  EXPECT_THAT(sized.err, HasSubstr("tire 540/65R30 is known by its size alone: 540 mm wide"));
  EXPECT_THAT(stored.out, HasSubstr("16.00R20 (r 650 mm, b 406.4 mm, 36 lugs of 20 mm, 250 kPa)"));
  EXPECT_THAT(stored.err, testing::Not(HasSubstr("size alone")));
  EXPECT_THAT(soilbin("estimate --tire 540/650R30" + asked),
              Refuses(HasSubstr("tire size '540/650R30': sides of 650 %")));
}

// A large wheel on soil with a K of 20 mm: even without slip it shears the soil by far more.
TEST(Estimate, DoubtsAPullWithoutSlip) {
  const std::string heavy = "estimate --soil upland-sandy-loam --radius 670mm --width 430mm --load 30kN --slip ";
  EXPECT_THAT(soilbin(heavy + "0%").err, HasSubstr("of its load at load 30 kN, slip 0 %: even there the model shears"));
  EXPECT_THAT(soilbin(heavy + "10%").err, testing::Not(HasSubstr("even there")));
  EXPECT_EQ(soilbin("estimate --soil dry-sand --tire rover-wheel --load 65N --slip 0%").err, "");
}

// Beyond that a driven wheel needs no slip at all to carry itself, which no driven wheel does.
TEST(Estimate, DoubtsADrivenWheelThatNeedsNoSlip) {
  const std::string heavy = "estimate --soil upland-sandy-loam --radius 670mm --width 430mm --load 30kN --slip ";
  const char* words = "a driven wheel needs no slip";
  EXPECT_THAT(soilbin(heavy + "-2%").err, HasSubstr(words));
  EXPECT_THAT(soilbin(heavy + "5%").err, testing::Not(HasSubstr(words)));
  EXPECT_THAT(soilbin(heavy + "-40%").err, testing::Not(HasSubstr(words))) << "braked";
  EXPECT_THAT(soilbin("limits --soil upland-sandy-loam --radius 670mm --width 430mm --load 30kN").err,
              HasSubstr(words));
}

TEST(Estimate, DoubtsASlopeOnWhichTheSoilItselfSlides) {
  const std::string slope = "estimate --radius 650mm --width 400mm --load 5kN --slip 20% --longitudinal-incline ";
  const char* words = "on this soil slides by itself";
  EXPECT_THAT(soilbin(slope + "-60deg --soil dry-sand").err, HasSubstr(words));
  EXPECT_THAT(soilbin(slope + "10deg --soil dry-sand").err, testing::Not(HasSubstr(words)));
  EXPECT_THAT(soilbin(slope + "10deg --soil heavy-clay").err, testing::Not(HasSubstr(words)))
      << "6 deg of friction, and 20 kPa of cohesion hold it";
}

}  // namespace
}  // namespace soilbin::cli::test
