#include <gmock/gmock.h>

#include <boost/math/distributions/students_t.hpp>
#include <cmath>
#include <set>
#include <sstream>

#include "cli/command.hpp"

namespace soilbin::cli::test {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;

constexpr const char* cmu = R"(format: soilbin-case/1
name: cmu
tire: cmu-smooth
soil: cmu-sand
study:
  models: [bekker_wong, {model: bekker_wong, effects: [slip_sinkage]}]
  conditions: {load: 24 N, slip: [-20 %, 0 %, 23 %, 50 %, 75 %], speed: 0.02 m/s}
)";

/// Standard errors that a normal (freedom null: known) or Student's t passes as seldom as a normal passes 2.
double counted_from(const nlohmann::json& freedom) {
  if (freedom.is_null()) return 2.0;
  const boost::math::students_t t(freedom.get<double>());
  return boost::math::quantile(boost::math::complement(t, std::erfc(std::sqrt(2.0)) / 2));
}

TEST(Compare, HoldsModelsAgainstMeasurementsRowByRow) {
  const Scratch scratch;
  const std::string study = "'" + scratch.write("case.yaml", cmu).string() + "'";
  const Outcome r = soilbin("compare " + study + " --measured cmu-smooth --no-loop --json");
  ASSERT_EQ(r.status, 0) << r.err;
  const nlohmann::json document = r.json();
  EXPECT_EQ(document["format"], "soilbin-compare/1");
  ASSERT_EQ(document["sides"].size(), 3U);
  EXPECT_EQ(document["sides"][2]["kind"], "measured");
  ASSERT_GT(document["rows"].size(), 8U);
  for (const auto& row : document["rows"]) {
    const double value = row["value"]["value"], reference = row["reference_value"]["value"];
    EXPECT_NEAR(row["difference"].get<double>(), value - reference, 1e-9 * (std::abs(value) + std::abs(reference)));
    const double size = std::abs(row["difference"].get<double>()), error = row["std_error"], scatter = row["scatter"];
    EXPECT_EQ(row["finding"] == "difference", size > scatter && size > counted_from(row["freedom"]) * error);
  }
  for (const auto& clause : document["summary"])
    EXPECT_TRUE(!clause["rows"].empty() || !clause["evidence"].empty() || clause["about"] == "not compared");
}

// Base, one effect, two together: three sides, each pair of them compared; grains of the study are left out on request.
TEST(Compare, SetsAnalyticModelsAgainstEachOther) {
  const Outcome r = soilbin(
      "compare paper-straight --load 4kN --slip 20% --effect slip_sinkage --effect slip_sinkage+bulldozing "
      "--model bekker_wong --json");
  ASSERT_EQ(r.status, 0) << r.err;
  const nlohmann::json document = r.json();
  ASSERT_EQ(document["sides"].size(), 3U);
  EXPECT_EQ(document["sides"][2]["label"], "bekker_wong + slip_sinkage + bulldozing");
  std::set<std::pair<std::string, std::string>> pairs;
  for (const auto& row : document["rows"]) pairs.emplace(row["side"], row["reference"]);
  EXPECT_EQ(pairs, (std::set<std::pair<std::string, std::string>>{
                       {"bekker_wong + slip_sinkage", "bekker_wong"},
                       {"bekker_wong + slip_sinkage + bulldozing", "bekker_wong"},
                       {"bekker_wong + slip_sinkage + bulldozing", "bekker_wong + slip_sinkage"}}));
}

// The same two in the other order are no other side; each of these ends, with a message.
TEST(Compare, RefusesWhatIsNoEffectAndWhatIsThereAlready) {
  const std::string ask = "compare paper-straight --load 4kN --slip 20% --model bekker_wong ";
  const Outcome twice = soilbin(ask + "--effect slip_sinkage+bulldozing --effect bulldozing+slip_sinkage --json");
  EXPECT_EQ(twice.json()["sides"].size(), 3U) << "base, slip sinkage of the study, both";
  EXPECT_THAT(twice.err, HasSubstr("--effect bulldozing+slip_sinkage: is compared already"));
  for (const auto& [effect, why] : {std::pair{"slip_sinkage+", "expected id"},
                                    {"slip_sinkage+slip_sinkage:linear", "is given twice"},
                                    {"1", "unknown effect '1'"},
                                    {"' slip_sinkage'", "unknown effect ' slip_sinkage'"},
                                    {"2+bulldozing", "unknown effect '2'"}}) {
    EXPECT_THAT(soilbin(ask + "--effect " + effect), Refuses(HasSubstr(why))) << effect;
  }
  EXPECT_THAT(soilbin(ask + "--recorded").err, HasSubstr("--recorded asks for them"));
}

// With values of another soil the first line and the page's title name both.
TEST(Compare, NamesTheSoilWhoseValuesItTakes) {
  const std::string ask = "compare paper-straight --load 4kN --slip 20% --no-loop --soil paper-sand-virtual ";
  EXPECT_THAT(soilbin(ask + "--recorded").out, HasSubstr(" on paper-sand, analytic values of paper-sand-virtual\n"));
  EXPECT_THAT(soilbin(ask + "--model bekker_wong").out, HasSubstr(" on paper-sand-virtual\n"));
}

// The same numbers in the page, in Markdown and as CSV; the page loads nothing and tells how to make it again.
TEST(Compare, WritesThePageMarkdownAndData) {
  const Scratch scratch;
  const std::string study = "'" + scratch.write("case.yaml", cmu).string() + "'";
  const fs::path page = scratch / "page.html", folder = scratch / "md", csv = scratch / "rows.csv";
  const Outcome r = soilbin("compare " + study + " --measured cmu-smooth --no-loop --report '" + page.string() +
                            "' --markdown '" + folder.string() + "' --csv '" + csv.string() + "'");
  ASSERT_EQ(r.status, 0) << r.err;
  const std::string html = text_of(page);
  for (const char* part :
       {"soilbin compare", "The resolved case", "class=\"summary\"", "id=\"figures\"", "svg class=\"plot"})
    EXPECT_THAT(html, HasSubstr(part));
  for (const char* loads : {"<link", "<img", "src=", "@import"})
    EXPECT_THAT(html.substr(0, html.find("<script")), Not(HasSubstr(loads)));
  const std::string markdown = text_of(folder / "report.md");
  EXPECT_THAT(markdown, AllOf(HasSubstr("!["), HasSubstr("analytic wheel"))) << "drawings, names";
  std::size_t tables = 0;  // of a document that pandoc makes of it
  for (std::size_t at = markdown.find("\n|:--|"); at != std::string::npos; at = markdown.find("\n|:--|", at + 1))
    ++tables;
  EXPECT_EQ(tables, 1U);
  EXPECT_EQ(text_of(folder / "differences.csv"), text_of(csv));
  EXPECT_THAT(text_of(csv), StartsWith("side,reference,channel,unit,"));
  EXPECT_THAT(text_of(csv), HasSubstr(",drawbar_pull,N,"));
  EXPECT_THAT(text_of(csv), HasSubstr(",sinkage,m,"));
  EXPECT_EQ(soilbin("run '" + (folder / "case.yaml").string() + "' --json").status, 0) << "the resolved case runs";
  EXPECT_EQ(nlohmann::json::parse(text_of(folder / "comparison.json"))["format"], "soilbin-compare/1");
}

// What the loop will need is asked before grains are run for it.
TEST(Compare, RefusesASoilWithoutAnalyticValuesBeforeGrainsAreRun) {
  const Scratch scratch;
  const std::string study = "'" +
                            scratch
                                .write("case.yaml", R"(format: soilbin-case/1
name: grains-only
tire: {radius: 100 mm, width: 50 mm}
soil:
  name: glass-beads
  granular:
    radius_min: 9 mm
    radius_max: 11 mm
    grain_density: 2500 kg/m^3
    youngs_modulus: 5 MPa
    poisson_ratio: 0.2
    grain_grain: {restitution: 0.5, sliding_friction: 0.5, rolling_friction: 0.1}
    grain_tire: {restitution: 0.5, sliding_friction: 0.5, rolling_friction: 0.1}
study: {models: [dem], conditions: {load: [80 N], slip: [20 %]}}
)")
                                .string() +
                            "'";
  EXPECT_THAT(soilbin("compare " + study),
              Refuses(AllOf(HasSubstr("'glass-beads' has no semi_empirical values"), HasSubstr("--no-loop"))));
}

// A table of words and figures is folded to the width of a terminal; figures stay whole.
TEST(Compare, ItsTableFitsATerminalOf120Columns) {
  const std::string asked = "paper-straight --recorded --load 4kN --slip 20% ";
  const nlohmann::json row = soilbin("run --model dem --json " + asked).json()["rows"][0];
  EXPECT_EQ(row["packings"], 3);
  EXPECT_EQ(row["steady"], false);
  EXPECT_GT(row["drift"], 3.0);
  EXPECT_THAT(row["remark"], HasSubstr("2 of 3 runs not steady"));
  const Outcome r = soilbin("compare --no-loop " + asked);
  ASSERT_EQ(r.status, 0) << r.err;
  const std::size_t begin = r.out.find("channel "), end = r.out.find("\n\n", begin);
  ASSERT_NE(end, std::string::npos) << r.out;
  std::istringstream table(r.out.substr(begin, end - begin));
  for (std::string line; std::getline(table, line);) EXPECT_LE(line.size(), 120U) << line;
  EXPECT_THAT(r.out, HasSubstr("sinkage"));
}

// docs/lab/failure-maps.md on the heavy lugged tire: at every condition the analytic pull is farther off than the
// grains' own error of resolution, two of its standard errors included, so the difference is the model's. With what it
// lacks, no difference of pull or torque is left, level, uphill, across the slope and at yaw.
TEST(Compare, JudgesAHeavyLuggedTireBeyondTheErrorOfItsGrains) {
  const nlohmann::json comparison = soilbin("compare heavy-lugged-incline --recorded --no-loop --json").json();
  const auto& points = comparison["sides"].back()["points"];
  ASSERT_EQ(points.size(), 8U);
  int judged = 0;
  for (const auto& row : comparison["rows"]) {
    if (row["side"].get<std::string>().find("shear_hump") != std::string::npos) {
      if (row["channel"] == "drawbar_pull" || row["channel"] == "torque") {
        EXPECT_NE(row["finding"], "difference");
      }
      continue;
    }
    if (row["channel"] != "drawbar_pull") continue;
    const auto& error = points.at(row["condition"].get<std::size_t>())["resolution_error"];
    EXPECT_EQ(error["from"], "twin");
    EXPECT_GT(row["difference"].get<double>(),
              error["drawbar_pull"]["value"].get<double>() + 2 * error["drawbar_pull"]["std_error"].get<double>());
    ++judged;
  }
  EXPECT_EQ(judged, 16) << "the analytic wheel without and with lug_thrust";
}

// It wrote an empty page and exited with 0.
TEST(Compare, RefusesACaseThatAsksForADriveAlone) {
  EXPECT_THAT(soilbin("compare drive-in-grains"), Refuses(HasSubstr("the case has no study, it asks for a drive")));
}

TEST(Compare, NamesWhatIsWrong) {
  EXPECT_THAT(soilbin("compare paper-straight --model den"), Refuses(HasSubstr("did you mean 'dem'?")));
  EXPECT_THAT(soilbin("compare paper-straight --measured cmu-smooth").err, HasSubstr("measured a wheel (r 58 mm"));
  EXPECT_THAT(soilbin("compare paper-straight --replay no-such").err, HasSubstr("no-such: no such file"));
  EXPECT_EQ(soilbin("compare paper-straight --recorded no-such.json").status, 2);
  for (const char* command : {"compare", "run"})
    EXPECT_THAT(soilbin(std::string(command) + " paper-straight --recorded --bed-length 1m").err,
                HasSubstr("--bed-length has no effect on recorded runs"));
}

}  // namespace
}  // namespace soilbin::cli::test
