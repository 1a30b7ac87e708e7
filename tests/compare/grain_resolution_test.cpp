// The error of resolution: what the study's records say, and what follows from its form.
#include "compare/doubts/grain_resolution.hpp"

#include <fmt/core.h>
#include <gmock/gmock.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <list>
#include <map>
#include <vector>

#include "compare/discrepancy/side.hpp"
#include "compare/recorded/run_store.hpp"
#include "scenario/errors.hpp"
#include "tests/fixtures.hpp"

namespace soilbin::compare {
namespace {

using test::condition;
using testing::HasSubstr;

constexpr std::array<StudiedWheel, 2> both_wheels = {StudiedWheel::lugged, StudiedWheel::bare};

/// The studied wheel on grains of this mean diameter.
Scenario studied_wheel(double diameter, StudiedWheel wheel = StudiedWheel::lugged) {
  Scenario scenario = test::wheel_on_sand();
  Tire& tire = scenario.tire;
  tire.radius = studied_radius, tire.width = studied_width,
  tire.lugs.height = wheel == StudiedWheel::lugged ? studied_lugs : 0;
  GranularSoil grains;
  grains.radius_min = 0.375 * diameter, grains.radius_max = 0.625 * diameter;
  grains.youngs_modulus = studied_contacts.modulus, grains.grain_tire.sliding_friction = studied_contacts.on_tire;
  grains.grain_grain.sliding_friction = studied_contacts.sliding;
  grains.grain_grain.rolling_friction = studied_contacts.rolling;
  grains.grain_grain.cohesion = studied_contacts.cohesion;
  scenario.soil.granular = grains;
  return scenario;
}

ResolutionError error_at(const StudiedAnswer& row, StudiedWheel wheel) {
  return resolution_error(studied_wheel(row.diameter, wheel), condition(studied_load, row.slip), row.sinkage.value);
}

/// The study's answers at each slip.
std::map<double, std::vector<StudiedAnswer>> by_slip(StudiedWheel wheel) {
  std::map<double, std::vector<StudiedAnswer>> all;
  for (const StudiedAnswer& row : studied_answers(wheel)) all[row.slip].push_back(row);
  return all;
}

// y = 3 + 2 d through d = 1, 2, 4 with errors of 0.1: weights of 100; mean 7/3, sum of squares 14/3, so the slope is
// known to 0.1/sqrt(14/3) and the value at 0 to 0.1 sqrt(1/3 + (7/3)^2/(14/3)).
TEST(GrainResolution, AFitGivesBackALine) {
  const std::vector<double> at = {1, 2, 4};
  const std::vector<Estimate> line = {{5, 0.1}, {7, 0.1}, {11, 0.1}};
  const SizeFit fit = fit_against_size(at, line);
  EXPECT_NEAR(fit.slope.value, 2, 1e-12);
  EXPECT_NEAR(fit.at_zero.value, 3, 1e-12);
  EXPECT_NEAR(fit.slope.std_error, 0.1 / std::sqrt(14.0 / 3), 1e-12);
  EXPECT_NEAR(fit.at_zero.std_error, 0.1 * std::sqrt(1.0 / 3 + 49.0 / 9 / (14.0 / 3)), 1e-12);
  const std::vector<Estimate> bent = {{5, 0.1}, {9, 0.1}, {11, 0.1}};
  EXPECT_GT(fit_against_size(at, bent).slope.std_error, 5 * fit.slope.std_error)
      << "what a line misses is an error too";
}

/// What the runs of a size say of a channel: their mean over packings, and its error from `scatter`, the standard
/// deviation between packings that all sizes have together, or from the runs' own where that is larger.
Estimate mean_of_runs(const std::vector<const TractionResult*>& runs, Estimate TractionResult::*channel,
                      double scatter) {
  double sum = 0, variance = 0;
  for (const TractionResult* run : runs)
    sum += (run->*channel).value, variance += std::pow((run->*channel).std_error, 2);
  const double n = static_cast<double>(runs.size());
  return {sum / n, std::max(scatter / std::sqrt(n), std::sqrt(variance) / n)};
}

// The table in the program is what the records of the study say, to the digits that it has.
TEST(GrainResolution, TheStudyIsThatOfItsRecords) {
  const std::filesystem::path folder = std::filesystem::path(SOILBIN_SOURCE_DIR) / "bench/grain_size/recorded";
  struct Channel {
    Estimate StudiedAnswer::*studied;
    Estimate TractionResult::*recorded;
    double half_a_digit;
  };
  for (const StudiedWheel wheel : both_wheels)
    for (const auto& [slip, rows] : by_slip(wheel)) {
      const char* name = wheel == StudiedWheel::lugged ? "lugged" : "bare";
      std::vector<std::vector<const TractionResult*>> runs;
      std::list<Record> records;
      for (const StudiedAnswer& row : rows) {
        records.push_back(read_record(folder / fmt::format("{}-{:.0f}mm.json", name, 1000 * row.diameter)));
        runs.emplace_back();
        for (const RecordedRun& run : records.back().runs)
          if (std::abs(run.answer.at.slip - slip) < 1e-9) runs.back().push_back(&*run.answer.result);
        ASSERT_FALSE(runs.back().empty());
        EXPECT_EQ(runs.back().front()->at.load, studied_load);
      }
      for (const Channel& channel : {Channel{&StudiedAnswer::drawbar_pull, &TractionResult::drawbar_pull, 0.5},
                                     Channel{&StudiedAnswer::torque, &TractionResult::torque, 0.5},
                                     Channel{&StudiedAnswer::sinkage, &TractionResult::sinkage, 5e-5}}) {
        double squares = 0, freedom = 0;
        for (const std::vector<const TractionResult*>& of_size : runs) {
          const double mean = mean_of_runs(of_size, channel.recorded, 0).value;
          for (const TractionResult* run : of_size) squares += std::pow((run->*channel.recorded).value - mean, 2);
          freedom += static_cast<double>(of_size.size()) - 1;
        }
        ASSERT_GT(freedom, 0);
        for (std::size_t i = 0; i < rows.size(); ++i) {
          const Estimate told = rows[i].*channel.studied;
          const Estimate found = mean_of_runs(runs[i], channel.recorded, std::sqrt(squares / freedom));
          EXPECT_NEAR(told.value, found.value, channel.half_a_digit) << rows[i].diameter << ' ' << slip;
          EXPECT_NEAR(told.std_error, found.std_error, channel.half_a_digit) << rows[i].diameter << ' ' << slip;
        }
      }
    }
}

// At a size of the study the answer less the error is the fit's value for d -> 0, so at every size the same within the
// study's errors, and the channels' errors are those of the fit.
TEST(GrainResolution, TheStudysAnswersComeDownToOneValue) {
  for (const StudiedWheel wheel : both_wheels)
    for (const auto& [slip, rows] : by_slip(wheel)) {
      std::vector<double> diameters;
      std::vector<Estimate> pulls, torques, sinkages;
      for (const StudiedAnswer& row : rows) {
        diameters.push_back(row.diameter);
        pulls.push_back(row.drawbar_pull), torques.push_back(row.torque), sinkages.push_back(row.sinkage);
      }
      const SizeFit pull = fit_against_size(diameters, pulls), torque = fit_against_size(diameters, torques),
                    sinkage = fit_against_size(diameters, sinkages);
      for (const StudiedAnswer& row : rows) {
        const ResolutionError error = error_at(row, wheel);
        ASSERT_TRUE(error.known()) << error.beyond;
        const auto off = [&](const Estimate& told, const Estimate& by, const SizeFit& fit) {
          return std::abs(told.value - by.value - fit.at_zero.value) /
                 std::hypot(told.std_error, fit.at_zero.std_error);
        };
        EXPECT_LT(off(row.drawbar_pull, error.drawbar_pull, pull), 2) << row.diameter;
        EXPECT_LT(off(row.torque, error.torque, torque), 2) << row.diameter;
        EXPECT_LT(off(row.sinkage, error.sinkage, sinkage), 2) << row.diameter;
        EXPECT_NEAR(error.drawbar_pull.std_error, row.diameter * pull.slope.std_error,
                    0.05 * error.drawbar_pull.std_error);
      }
    }
}

TEST(GrainResolution, VanishesWithTheGrainsAndGrowsWithThem) {
  const OperatingCondition at = condition(studied_load, 0.2);
  ResolutionError before = resolution_error(studied_wheel(1e-9), at, 0.02);
  EXPECT_NEAR(before.drawbar_pull.value, 0, 1e-3);
  EXPECT_NEAR(before.torque.value, 0, 1e-3);
  EXPECT_NEAR(before.sinkage.value, 0, 1e-8);
  for (const double d : {0.001, 0.005, 0.01, 0.02, 0.03, 0.035}) {
    const ResolutionError now = resolution_error(studied_wheel(d), at, 0.02 + before.sinkage.value);
    ASSERT_TRUE(now.known()) << now.beyond;
    EXPECT_GT(std::abs(now.drawbar_pull.value), std::abs(before.drawbar_pull.value)) << d;
    EXPECT_GT(std::abs(now.torque.value), std::abs(before.torque.value)) << d;
    EXPECT_GT(std::abs(now.sinkage.value), std::abs(before.sinkage.value)) << d;
    EXPECT_GT(now.drawbar_pull.std_error, before.drawbar_pull.std_error) << d;
    before = now;
  }
}

// A wheel, its lugs, its sinkage and the grains twice as large, the load four times: pressures are the same, forces
// four times as large, moments eight times.
TEST(GrainResolution, ScalesWithTheWheel) {
  const Scenario small = studied_wheel(0.01);
  Scenario large = studied_wheel(0.02);
  large.tire.radius *= 2, large.tire.width *= 2, large.tire.lugs.height *= 2;
  const ResolutionError one = resolution_error(small, condition(1000, 0.2), 0.01);
  const ResolutionError two = resolution_error(large, condition(4000, 0.2), 0.02);
  EXPECT_NEAR(two.drawbar_pull.value, 4 * one.drawbar_pull.value, 1e-9);
  EXPECT_NEAR(two.torque.value, 8 * one.torque.value, 1e-9);
  EXPECT_NEAR(two.sinkage.value, 2 * one.sinkage.value, 1e-12);
}

// What was found for one wheel is a guess for another: its error is no less than what the guess for a rover's wheel
// missed.
TEST(GrainResolution, IsLessCertainForAnotherWheelOrLoad) {
  const Scenario studied = studied_wheel(0.02);
  const OperatingCondition at = condition(studied_load, 0.2);
  const ResolutionError own = resolution_error(studied, at, 0.03);
  EXPECT_LT(own.drawbar_pull.std_error, 0.2 * own.drawbar_pull.value);
  Scenario larger = studied, high = studied;
  larger.tire.radius *= 1.1, high.tire.lugs.height = 0.03;
  for (const ResolutionError& error : {resolution_error(larger, at, 0.03), resolution_error(high, at, 0.03),
                                       resolution_error(studied, condition(2000, 0.2), 0.03)}) {
    EXPECT_GT(error.drawbar_pull.std_error, carried_over.drawbar_pull * std::abs(error.drawbar_pull.value));
    EXPECT_GT(error.torque.std_error, carried_over.torque * std::abs(error.torque.value));
    EXPECT_GT(error.sinkage.std_error, carried_over.sinkage * std::abs(error.sinkage.value));
  }
}

// What the study has not looked at widens its error, by each once: it had told +333 +- 57 N of a narrow tire on hard
// grains, up and across a slope, at yaw.
TEST(GrainResolution, IsWidenedByWhatTheStudyHasNotLookedAt) {
  const Scenario studied = studied_wheel(0.02);
  const OperatingCondition at = condition(studied_load, 0.2);
  const Estimate own = resolution_error(studied, at, 0.03).drawbar_pull;
  const auto shares = [&](const Scenario& asked, const OperatingCondition& where, double void_ratio = 0.507) {
    const Estimate error = resolution_error(asked, where, 0.03, SinkageOf::grains, void_ratio).drawbar_pull;
    EXPECT_NEAR(error.value, own.value, 0.2 * own.value);
    return std::pow(error.std_error / error.value, 2) - std::pow(own.std_error / own.value, 2);
  };
  const double once = std::pow(carried_over.drawbar_pull, 2);
  EXPECT_NEAR(shares(studied, at), 0, 1e-9);
  Scenario narrow = studied, hard = studied, free = studied;
  narrow.tire.width = 0.1, hard.soil.granular->youngs_modulus = 200e6, free.soil.granular->grain_grain.cohesion = 0;
  for (const Scenario& other : {narrow, hard, free}) EXPECT_NEAR(shares(other, at), once, 1e-9);
  Scenario narrow_and_hard = narrow;
  narrow_and_hard.soil = hard.soil;
  EXPECT_NEAR(shares(narrow_and_hard, at), once, 1e-9) << "tried together";
  OperatingCondition up = at, across = at, turned = at, again = at, slipping = at, all = at;
  up.longitudinal_incline = 0.26, across.transverse_incline = 0.26, turned.yaw = 0.35, again.pass = 2,
  slipping.slip = 0.28;
  for (const OperatingCondition& where : {up, across, turned, again, slipping})
    EXPECT_NEAR(shares(studied, where), once, 1e-9);
  EXPECT_NEAR(shares(studied, at, 0.7), once, 1e-9) << "a loose bed";
  all.longitudinal_incline = all.transverse_incline = 0.26, all.yaw = 0.35;
  EXPECT_NEAR(shares(narrow_and_hard, all, 0.7), 4 * once, 1e-9);
}

TractionResult told(Estimate pull, Estimate torque, Estimate sinkage) {
  TractionResult result;
  result.at = condition(studied_load, 0.2);
  result.drawbar_pull = pull, result.torque = torque, result.sinkage = sinkage;
  return result;
}

// A line through 700 N at d and 900 N at 1.4 d gives 200 N, 500 N less, for d -> 0; errors of 30 and 40 N give 50/0.4.
TEST(CoarserTwin, GivesTheErrorOfAStraightLine) {
  const ResolutionError error =
      error_by_twin(told({700, 30}, {600, 0}, {0.020, 0.0003}), told({900, 40}, {680, 0}, {0.016, 0.0004}), 1.4);
  EXPECT_TRUE(error.known() && error.by_twin);
  EXPECT_NEAR(error.drawbar_pull.value, 500, 1e-9);
  EXPECT_NEAR(error.drawbar_pull.std_error, 125, 1e-9);
  EXPECT_NEAR(error.torque.value, 200, 1e-9);
  EXPECT_NEAR(error.sinkage.value, -0.010, 1e-12);
  EXPECT_NEAR(error.sinkage.std_error, 0.00125, 1e-12);
  EXPECT_EQ(to_json(error)["from"], "twin");
}

RecordedRun run_of(const TractionResult& result) {
  RecordedRun run{.answer = {result.at, result, ""}, .source = "abc", .power = {}, .rut = {}, .flow = {}};
  run.bed.void_ratio = studied_void_ratio;
  return run;
}

TEST(CoarserTwin, AnAnswerCarriesItsOwnError) {
  const Scenario scenario = studied_wheel(0.02);
  const std::vector<RecordedRun> runs = {run_of(told({700, 30}, {600, 10}, {0.02, 0.001}))},
                                 coarser = {run_of(told({900, 40}, {680, 10}, {0.016, 0.001}))};
  const std::vector<OperatingCondition> at = {runs[0].answer.at};
  const SidePoint alone = side_of("dem", runs, at).points.at(0), with = side_of("dem", runs, at, coarser).points.at(0);
  EXPECT_FALSE(resolution_error(scenario, at[0], alone).by_twin);
  EXPECT_EQ(to_json(resolution_error(scenario, at[0], alone))["from"], "study");
  const ResolutionError own = resolution_error(scenario, at[0], with);
  EXPECT_TRUE(own.by_twin);
  EXPECT_NEAR(own.drawbar_pull.value, 500, 1e-9);
  EXPECT_NEAR(own.drawbar_pull.std_error, 125, 1e-9);
  Doubts doubts = {Doubt{DoubtKind::coarse_grains, {"by the study", "", 20.0, 15.0, 10.0, 5.0, 10.0, 0.5, 1.0}}};
  tell_twins(doubts, {alone}, at);
  EXPECT_THAT(in_words(doubts[0]), HasSubstr("by the study"));
  tell_twins(doubts, {with}, at);
  EXPECT_THAT(in_words(doubts[0]), HasSubstr("estimated error drawbar pull +500 ± 125 N"));
  EXPECT_FALSE(side_of("dem", runs, {condition(8000, 0.2)}, coarser).points.at(0).by_twin);
}

TEST(CoarserTwin, ComesBackFromTheFileAndFromShards) {
  Record record{.soilbin = "0.1.0", .model = "dem", .question = "name: made\n", .inputs = {}, .runs = {}};
  record.runs = {run_of(told({700, 30}, {600, 10}, {0.02, 0.001}))};
  Record other = record;
  other.runs.clear(), other.coarser = {run_of(told({900, 40}, {680, 10}, {0.016, 0.001}))};
  const std::string text = record_text(merged({{"a.json", record}, {"b.json", other}}));
  const Record back = parse_record({"r.json", text});
  EXPECT_EQ(record_text(back), text);
  ASSERT_EQ(back.coarser.size(), 1U);
  EXPECT_EQ(back.coarser[0].answer.result->drawbar_pull.value, 900);
  const OperatingCondition at = back.coarser[0].answer.at;
  EXPECT_EQ(find_run(back, {at, 1, RunKind::coarser}), &back.coarser[0]);
  EXPECT_EQ(find_run(back, {at, 1}), &back.runs[0]);
  EXPECT_EQ(record_text(merged({{"r.json", back}, {"a.json", record}})), text) << "merged again";
}

// Between studied slips an error lies between theirs, at the same depth of the contact's fine end.
TEST(GrainResolution, IsInterpolatedBetweenSlips) {
  const auto slips = by_slip(StudiedWheel::lugged);
  for (auto low = slips.begin(), high = std::next(low); high != slips.end(); ++low, ++high) {
    const auto at = [&](double slip) {
      return resolution_error(studied_wheel(0.02), condition(studied_load, slip), 0.03).sinkage.value;
    };
    EXPECT_NEAR(at(0.5 * (low->first + high->first)), 0.5 * (at(low->first) + at(high->first)), 1e-12);
  }
}

TEST(GrainResolution, SaysWhereTheStudyDoesNotReach) {
  const OperatingCondition at = condition(studied_load, 0.2);
  EXPECT_THAT(resolution_error(studied_wheel(0.06), at, 0.01).beyond, HasSubstr("a grain is 5.5 lug heights"));
  EXPECT_THAT(resolution_error(studied_wheel(0.02), condition(4000, 0.9), 0.01).beyond,
              HasSubstr("slip 90 % lies outside the "));
  Scenario small = studied_wheel(0.04);
  small.tire.radius = 0.1, small.tire.lugs.height = 0.02;
  EXPECT_THAT(resolution_error(small, condition(100, 0.2), 0.0).beyond, HasSubstr("contact lengths"));
  Scenario none = studied_wheel(0.02);
  none.soil.granular.reset();
  EXPECT_THROW(resolution_error(none, at, 0.01), InputError);
}

}  // namespace
}  // namespace soilbin::compare
