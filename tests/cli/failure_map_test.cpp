// soilbin failure-map on the runs that come with the project, and soilbin campaign on what is no record.
#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>

#include "cli/command.hpp"

namespace soilbin::cli::test {
namespace {

using testing::HasSubstr;

/// The command of docs/lab/failure-maps.md, from the runs in the store alone.
std::string stored(const std::string& more) {
  return "failure-map '" SOILBIN_SOURCE_DIR
         "/bench/dem_nature/studies/dem-lugs.yaml' --incline longitudinal --load 40N..100N --lug-height 0mm..15mm "
         "--angle 0deg..15deg --slip 5%..40% --boundary 0 --rounds 0 --settling-friction 0.2 --bed-length 0.5m "
         "--behind 0.12m --ahead 0.12m --lowering 0.2s --resting 0.1s --starting 0.1s --tilting 0.2s --sleep 0 "
         "--stored --store '" SOILBIN_SOURCE_DIR "/bench/dem_nature/failure_maps/dem-nature-longitudinal.json' " +
         more;
}

TEST(SlowFailureMapCommand, LearnsFromTheStoredRuns) {
  const Scratch scratch;
  const fs::path page = scratch / "map.html";
  const Outcome r = soilbin(stored("--json --report '" + page.string() + "'"));
  ASSERT_EQ(r.status, 0) << r.err;
  const nlohmann::json map = r.json();
  EXPECT_EQ(map["format"], "soilbin-failure-map/1");
  EXPECT_EQ(map["rows"].size(), 24U);
  int answered = 0;
  for (const auto& row : map["rows"]) {
    if (row["difference"].is_null()) continue;
    ++answered;
    EXPECT_LT(std::abs(row["difference"]["value"].get<double>()), 1.0);
    EXPECT_GT(row["difference"]["std_error"].get<double>(), 0.0);
  }
  EXPECT_GT(answered, 12);
  EXPECT_THAT(text_of(page), HasSubstr("Cross-validated error of the map"));
  EXPECT_THAT(text_of(page), HasSubstr("the grains are coarse for this wheel"));
  EXPECT_THAT(text_of(page), HasSubstr("<summary>All 24 conditions run</summary>"));
  EXPECT_THAT(map["warning_kinds"].dump(), HasSubstr("coarse_grains"));
}

// docs/lab/failure-maps.md on the paper's tire: by load and slip, hardly by slope; and five runs that the map had not
// seen.
TEST(SlowFailureMapCommand, TellsWhereThePapersTireParts) {
  const Scratch scratch;
  const fs::path page = scratch / "map.html";
  const Outcome r = soilbin(
      "failure-map paper-longitudinal --soil paper-sand-virtual --incline longitudinal --load 2kN..8kN --lug-height "
      "0mm..30mm --angle 0deg..15deg --slip 5%..50% --first 20 --boundary 20 --rounds 2 --check 5 --settling-friction "
      "0 --json --stored --store '" SOILBIN_SOURCE_DIR "/cases/failure_maps/paper-longitudinal.json' --report '" +
      page.string() + "'");
  ASSERT_EQ(r.status, 0) << r.err;
  const std::string html = text_of(page);  // "within 10 %" is of these grains, whose own error stands beside it
  EXPECT_LT(html.find("Error of resolution of the grains: "), html.find("id=\"map\""));
  EXPECT_THAT(html, HasSubstr("(they start at those of paper-lugged, 11 mm)"));
  const nlohmann::json map = r.json();
  EXPECT_LT(map["cross_validated_error"].get<double>(), 0.03);
  EXPECT_GT(map["shares"]["undecided"].get<double>(), 0.9);  // grains of 40 mm, 16 % of the load off for their size
  const auto mean = [&](const std::string& name, double from, double to) {
    double sum = 0.0, count = 0.0;
    for (const auto& row : map["rows"])
      if (const double at = row[name]; !row["difference"].is_null() && at >= from && at < to)
        sum += row["difference"]["value"].get<double>(), count += 1;
    return sum / count;
  };
  EXPECT_GT(mean("load", 6000, 8000) - mean("load", 2000, 4000), 0.08);
  EXPECT_NEAR(mean("angle", 0, 0.13), mean("angle", 0.13, 0.27), 0.03);  // the slope hardly matters
  EXPECT_EQ(map["checks"].size(), 5U);
  for (const auto& check : map["checks"]) {
    const auto &predicted = check["predicted"], &found = check["found"];
    EXPECT_LT(std::abs(predicted["value"].get<double>() - found["value"].get<double>()),
              3 * std::hypot(predicted["std_error"].get<double>(), found["std_error"].get<double>()));
  }
}

/// The heavy tire's map from the library, of a model with these flags: ranges and grains are the store's.
nlohmann::json heavy_map(const std::string& model) {
  const Outcome r = soilbin("failure-map heavy-lugged-incline --stored --json " + model);
  EXPECT_EQ(r.status, 0) << r.err;
  return r.json();
}

/// That of resistive force theory, asked for once.
const nlohmann::json& heavy_map_of_rft() {
  static const nlohmann::json map = heavy_map("--of rft");
  return map;
}

/// Mean difference over the rows [share of the load], and its root mean square.
std::pair<double, double> mean_and_rms(const nlohmann::json& map) {
  double sum = 0.0, squares = 0.0, n = 0.0;
  for (const auto& row : map["rows"])
    if (!row["difference"].is_null()) {
      const double value = row["difference"]["value"];
      sum += value, squares += value * value, n += 1;
      EXPECT_FALSE(row["resolution_error"].is_null());
    }
  return {sum / n, std::sqrt(squares / n)};
}

/// Root mean square of what fresh conditions gave less what the map predicted [share of the load]; each within two
/// standard errors.
double check_error(const nlohmann::json& map) {
  EXPECT_EQ(map["checks"].size(), 5U);
  double squares = 0.0;
  for (const auto& one : map["checks"]) {
    const auto &found = one["found"], &predicted = one["predicted"];
    const double off = found["value"].get<double>() - predicted["value"].get<double>();
    EXPECT_LT(std::abs(off), 2 * std::hypot(found["std_error"].get<double>(), predicted["std_error"].get<double>()));
    squares += off * off;
  }
  return std::sqrt(squares / static_cast<double>(map["checks"].size()));
}

// docs/lab/failure-maps.md on the heavy lugged tire: the analytic wheel pulls too much, decided; the effects that it
// lacks take half of that; resistive force theory, from density and friction angle alone, is near.
TEST(SlowFailureMapCommand, DecidesAboutAHeavyLuggedTire) {
  const nlohmann::json analytic = heavy_map("");
  EXPECT_EQ(analytic["rows"], heavy_map("--effect lug_thrust:passive_blade")["rows"]) << "as the study has it";
  EXPECT_GT(mean_and_rms(analytic).first, 0.20);
  EXPECT_GT(analytic["shares"]["differ"].get<double>(), 0.8);
  EXPECT_EQ(analytic["shares"]["agree"].get<double>(), 0.0);
  EXPECT_LT(mean_and_rms(heavy_map("--effect slip_sinkage --effect bulldozing --effect interface_limit,a=0.18")).second,
            0.6 * mean_and_rms(heavy_map("--effect none")).second);
  const nlohmann::json& rft = heavy_map_of_rft();
  EXPECT_LT(mean_and_rms(rft).second, 0.08);
  EXPECT_GT(rft["shares"]["agree"].get<double>(), 0.2);
  EXPECT_LT(rft["shares"]["differ"].get<double>(), 0.05);
  EXPECT_LT(check_error(analytic), 0.01);
  EXPECT_LT(check_error(rft), 0.01);
}

TEST(SlowFailureMapCommand, AsksTheLibrarysMapAgainWithoutItsFlags) {
  const std::string ranges =
      "--load 10kN..40kN --lug-height 0mm..45mm --angle 0deg..20deg --slip 5%..50% --boundary 0 --rounds 0 "
      "--coarser-twin --patch --graded 2 --bed-length 1m --behind 0.6m --ahead 1.2m --travel 2.4m --settling-friction "
      "0 --store '" SOILBIN_SOURCE_DIR "/cases/failure_maps/heavy-longitudinal.json' ";
  EXPECT_EQ(heavy_map_of_rft(), heavy_map("--of rft " + ranges));
}

TEST(SlowFailureMapCommand, TellsItsFlagsToItsStore) {
  const Scratch scratch;
  const fs::path store = scratch / "store.json";
  nlohmann::ordered_json known =
      nlohmann::ordered_json::parse(text_of(SOILBIN_SOURCE_DIR "/cases/failure_maps/paper-longitudinal.json"));
  known.erase("asked");
  std::ofstream(store) << known;
  const Outcome r = soilbin(
      "failure-map paper-longitudinal --soil paper-sand-virtual --load 2kN..8kN --lug-height 0mm..30mm --angle "
      "0deg..15deg --slip 5%..50% --first 20 --boundary 0 --rounds 0 --settling-friction 0 --threads 1 --of rft "
      "--store '" +
      store.string() + "'");
  ASSERT_EQ(r.status, 0) << r.err;
  const auto asked = nlohmann::json::parse(text_of(store))["asked"];
  EXPECT_EQ(asked["study"], "paper-longitudinal");
  EXPECT_EQ(asked["--load"], "2kN..8kN");
  EXPECT_EQ(asked["--settling-friction"], "0");
  EXPECT_FALSE(asked.contains("--of")) << "any model may be judged by the same runs";
  EXPECT_FALSE(asked.contains("--threads"));
}

TEST(SlowFailureMapCommand, ADryRunListsTheRunsThatComeNext) {
  const Scratch scratch;
  const std::string map =
      "failure-map paper-longitudinal --soil paper-sand-virtual --load 2kN..8kN --lug-height 0mm..30mm --angle "
      "0deg..15deg --slip 5%..50% --first 6 --dry-run --store '" +
      (scratch / "store.json").string() + "' ";
  const Outcome r = soilbin(map + "--json");
  ASSERT_EQ(r.status, 0) << r.err;
  const nlohmann::json plan = r.json();
  EXPECT_EQ(plan["format"], "soilbin-plan/1");
  ASSERT_EQ(plan["runs"].size(), 6U);
  EXPECT_EQ(plan["recorded"], 0);
  EXPECT_THAT(plan["runs"].at(0)["tire"].get<std::string>(), HasSubstr("lugs of "));
  EXPECT_EQ(soilbin(map + "--coarser-twin --json").json()["runs"].size(), 12U);
  EXPECT_GT(plan["core_hours_left"].get<double>(), 0.0);
  EXPECT_FALSE(fs::exists(scratch / "store.json"));
  EXPECT_THAT(soilbin(map + "--bed-width 0.3m"), Refuses(HasSubstr("a bed 0.3 m wide is too narrow")));
}

TEST(FailureMapCommand, NamesWhatIsWrong) {
  const auto error = [](const std::string& flags) {
    return soilbin(
               "failure-map paper-longitudinal --soil paper-sand-virtual --lug-height 0mm..1mm --slip 0%..1% "
               "--stored " +
               flags)
        .err;
  };
  EXPECT_THAT(error("--incline sideways --load 1N..2N --angle 0deg..1deg"), HasSubstr("'sideways' is none of"));
  EXPECT_THAT(error("--against rft --of rft --load 1N..2N --angle 0deg..1deg"), HasSubstr("a model against itself"));
  EXPECT_THAT(error("--against rft --patch --load 1N..2N --angle 0deg..1deg"), HasSubstr("--patch has no effect"));
  EXPECT_THAT(error("--load 100N..40N --angle 0deg..1deg"), HasSubstr("below the upper"));
  EXPECT_THAT(error("--load 1N..2N --angle 15deg"), HasSubstr("expected LOW..HIGH"));
  EXPECT_THAT(soilbin("failure-map paper-longitudinal --soil paper-sand-virtual --load 1N..2N --lug-height 0mm..1mm "
                      "--angle 0deg..1deg --slip 0%..1% --stored --store no-such.json"),
              Refuses(HasSubstr("no-such.json: no such file")));
  EXPECT_THAT(soilbin("failure-map paper-longitudinal --load 1N..2N").err, HasSubstr("--lug-height is missing"));
  EXPECT_THAT(soilbin("failure-map rover-slip --stored").err, HasSubstr("the library has no map of 'rover-slip'"));
}

TEST(CampaignCommand, RefusesWhatIsNoRecord) {
  const Scratch scratch;
  const std::string output = " --output '" + (scratch / "told").string() + "'";
  EXPECT_EQ(soilbin("campaign no-such.json" + output).status, 2);
  const fs::path text = scratch.write("record.json", "{}");
  EXPECT_EQ(soilbin("campaign '" + text.string() + "'" + output).status, 2);
  EXPECT_FALSE(fs::exists(scratch / "told"));
  EXPECT_THAT(soilbin("campaign --help").out, HasSubstr("longitudinal_incline"));
}

// The control that comes with the project: grains in which nothing was switched on. What the loop lists is true of
// them.
TEST(SlowCampaigns, TheLoopListsThatSoftGrainsSpringBack) {
  const Outcome r = soilbin("loop '" SOILBIN_SOURCE_DIR "/bench/dem_nature/measured/dem-null' --json");
  ASSERT_EQ(r.status, 0) << r.err;
  const nlohmann::json found = r.json();
  // No soil of the model follows grains to the noise, so a named effect must not pass for all that is missing; the exit
  // angle is among the candidates.
  EXPECT_EQ(found["verdict"], "unknown_effect");
  const auto& sets = found["ambiguity_set"];
  EXPECT_TRUE(std::any_of(sets.begin(), sets.end(), [](const nlohmann::json& set) {
    const auto& ids = set["effects"];
    return std::find(ids.begin(), ids.end(), "exit_angle") != ids.end();
  }));
}

}  // namespace
}  // namespace soilbin::cli::test
