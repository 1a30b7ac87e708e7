// Measured columns that look mistaken: what is told, at which header, and that models which are only wrong raise none.

#include <gmock/gmock.h>

#include <functional>

#include "compare/doubt_matchers.hpp"
#include "compare/doubts/doubts.hpp"
#include "compare/modelled_campaign.hpp"
#include "scenario/unit.hpp"
#include "tests/fixtures.hpp"

namespace soilbin::compare {
namespace {

using test::condition;
using test::tells;
using test::wheel_on_sand;
using testing::Contains;
using testing::ElementsAre;
using testing::IsEmpty;
using testing::Not;

// Pull and torque of a wheel of 110 mm differ by size, load and pull by both.
TEST(ColumnDoubts, SwappedColumnsAreToldAtTheirHeader) {
  const Campaign good = modelled_campaign();
  Campaign swapped = good;
  swapped.columns["drawbar_pull"] = {"Fx", "N", {"runs.csv", 1, 14}};
  swapped.columns["torque"] = {"My", "N*m", {"runs.csv", 1, 11}};
  for (compare::Run& run : swapped.runs) std::swap(run.drawbar_pull, run.torque);
  EXPECT_THAT(doubts(swapped), Contains(tells(DoubtKind::columns_swapped, {"runs.csv:1:14: ", "My", "Fx"})));
  Campaign loads = modelled_campaign(0.1);
  std::erase_if(loads.runs, [](const compare::Run& run) { return !(*run.drawbar_pull > 0); });
  ASSERT_GE(loads.runs.size(), 3U);
  EXPECT_THAT(doubts(loads), Not(Contains(tells(DoubtKind::load_swapped))));
  for (compare::Run& run : loads.runs) {
    const double load = run.at.load;
    run.at.load = *run.drawbar_pull;
    run.drawbar_pull = load;
  }
  EXPECT_THAT(doubts(loads), Contains(tells(DoubtKind::load_swapped, {"", "load", "drawbar_pull"})));
}

/// How far a rig's channels are from the declared model's.
struct Off {
  double pull_of_load = -0.03, torque_times = 1.2, side_force_times = 0.8;
};

/// Loads of 60 and 100 N, yawed to either side, over slip from -10 % on.
Campaign rig_campaign(const Off& off = {}) {
  Campaign campaign;
  const Scenario scenario = wheel_on_sand();
  campaign.wheel = scenario.tire;
  campaign.soil = *scenario.soil.semi_empirical;
  campaign.columns = {
      {"load", {"W", "N", {"runs.csv", 1, 1}}},          {"slip", {"Slip", "%", {"runs.csv", 1, 3}}},
      {"drawbar_pull", {"Fx", "N", {"runs.csv", 1, 8}}}, {"torque", {"My", "N m", {"runs.csv", 1, 11}}},
      {"sinkage", {"z", "mm", {"runs.csv", 1, 14}}},     {"lateral_force", {"Fy", "N", {"runs.csv", 1, 16}}}};
  for (const double load : {60.0, 100.0})
    for (const double yaw : {0.0, 10 * degree, -10 * degree})
      for (int i = -1; i < 5; ++i) {
        Run run;
        run.at = condition(load, 0.1 * i);
        run.at.yaw = yaw;
        run.csv_line = static_cast<int>(campaign.runs.size()) + 2;
        const TractionResult told = *ask(*make_model(ModelKind::bekker_wong), scenario, run.at).result;
        run.drawbar_pull = told.drawbar_pull.value + off.pull_of_load * load,
        run.torque = off.torque_times * told.torque.value;
        run.sinkage = told.sinkage.value, run.lateral_force = off.side_force_times * told.lateral_force.value;
        campaign.runs.push_back(run);
      }
  return campaign;
}

TEST(ColumnDoubts, LoadsInAnotherUnitAreToldAtTheirHeader) {
  for (const auto& [unit, newtons] : {std::pair{"kg", 9.80665}, {"lbf", 4.4482216}, {"kN", 1000.0}}) {
    Campaign campaign = modelled_campaign();
    campaign.columns["load"] = {"load_N", "N", {"runs.csv", 1, 5}};
    for (compare::Run& run : campaign.runs) run.at.load /= newtons;
    EXPECT_THAT(doubts(campaign),
                Contains(tells(DoubtKind::load_in_another_unit, {"runs.csv:1:5: ", "load_N", newtons, "N", unit})));
  }
  Campaign times_ten = rig_campaign();  // of all channels none is called too small
  for (compare::Run& run : times_ten.runs) run.at.load *= 10;
  const auto of_columns = [](const Campaign& campaign) { return of_mistaken_columns(doubts_before_fit(campaign)); };
  EXPECT_THAT(of_columns(times_ten), ElementsAre(tells(DoubtKind::column_too_large, {"runs.csv:1:1: ", "W", 10})));
  for (const double times : {100.0, 1000.0}) {  // the soil carries no such loads: the model has no answer
    Campaign heavier = rig_campaign();
    for (compare::Run& run : heavier.runs) run.at.load *= times;
    EXPECT_THAT(of_columns(heavier), ElementsAre(tells(DoubtKind::column_too_large, {"runs.csv:1:1: ", "W", times})));
  }
  Campaign halved = modelled_campaign();  // no unit
  for (compare::Run& run : halved.runs) run.at.load /= 2;
  EXPECT_THAT(doubts(halved), Not(Contains(tells(DoubtKind::load_in_another_unit))));
}

/// What is told with each row changed.
Doubts doubts_with(const std::function<void(compare::Run&)>& change) {
  Campaign campaign = rig_campaign();
  for (compare::Run& run : campaign.runs) change(run);
  return doubts(campaign);
}

TEST(ColumnDoubts, NoneWhereTheModelIsOffByAnOffsetOrAFactor) {
  EXPECT_THAT(doubts(rig_campaign()), IsEmpty());
  EXPECT_THAT(doubts(rig_campaign({.pull_of_load = -0.3, .torque_times = 1.5, .side_force_times = 0.5})), IsEmpty());
  EXPECT_THAT(doubts(rig_campaign({.pull_of_load = 0.2, .torque_times = 3, .side_force_times = 3})), IsEmpty());
}

TEST(ColumnDoubts, AFlippedSignIsToldWithTheSignThatIsMeant) {
  const auto flipped = [](const char* place, const char* header, const char* positive) {
    return ElementsAre(tells(DoubtKind::flipped_sign, {place, header, positive}));
  };
  EXPECT_THAT(doubts_with([](compare::Run& run) { *run.torque *= -1; }),
              flipped("runs.csv:1:11: ", "My", "drives the wheel"));
  EXPECT_THAT(doubts_with([](compare::Run& run) { *run.lateral_force *= -1; }),
              flipped("runs.csv:1:16: ", "Fy", "points to the left of travel"));
  EXPECT_THAT(doubts_with([](compare::Run& run) { run.at.slip *= -1; }),
              flipped("runs.csv:1:3: ", "Slip", "is a driven wheel's slip"));
}

TEST(ColumnDoubts, APowerOfTenIsToldWithTheDeclaredUnit) {
  EXPECT_THAT(in_words(doubts_with([](compare::Run& run) { *run.torque *= 1000; })),
              ElementsAre("runs.csv:1:11: column 'My' looks 1000 times too large: with its values divided by 1000 the "
                          "prediction fits far better; look at its unit, 'N m', in its header or under 'columns:' in "
                          "campaign.yaml"));
  EXPECT_THAT(doubts_with([](compare::Run& run) { *run.torque *= 100; }),
              ElementsAre(tells(DoubtKind::column_too_large, {"runs.csv:1:11: ", "My", 100})));
  EXPECT_THAT(doubts_with([](compare::Run& run) { *run.lateral_force /= 1000; }),
              ElementsAre(tells(DoubtKind::column_too_small, {"runs.csv:1:16: ", "Fy", 1000})));
  EXPECT_THAT(doubts_with([](compare::Run& run) { *run.sinkage /= 10; }),
              ElementsAre(tells(DoubtKind::column_too_small, {"runs.csv:1:14: ", "z", 10})));
  EXPECT_THAT(doubts_with([](compare::Run& run) { *run.sinkage /= 3; }), IsEmpty())
      << "a model may be wrong by as much";
}

// A fit for effects would take such a column for an effect: it gets that doubt by itself too.
TEST(ColumnDoubts, AreToldByThemselvesBeforeAFit) {
  Campaign campaign = rig_campaign();
  EXPECT_THAT(of_mistaken_columns(doubts_before_fit(campaign)), IsEmpty());
  for (compare::Run& run : campaign.runs) *run.torque *= 10;
  campaign.runs.push_back(campaign.runs.back());
  campaign.runs.back().csv_line = 99;
  const Doubts found = doubts_before_fit(campaign);
  const auto of_torque = tells(DoubtKind::column_too_large, {"runs.csv:1:11: ", "My", 10});
  EXPECT_THAT(of_mistaken_columns(found), ElementsAre(of_torque));
  EXPECT_THAT(found, testing::UnorderedElementsAre(of_torque, tells(DoubtKind::repeated_row)));
}

TEST(ColumnDoubts, SlipsAsSharesInAColumnOfPercentAreTold) {
  EXPECT_THAT(doubts_with([](compare::Run& run) { run.at.slip /= 100; }),
              ElementsAre(tells(DoubtKind::slip_in_shares, {"runs.csv:1:3: ", "Slip", 100, "%"})));
}

// The numbers change places, the headings and their units don't: 3 N m stand as 3 mm.
TEST(ColumnDoubts, EveryTwoChannelsMayBeSwapped) {
  EXPECT_THAT(doubts_with([](compare::Run& run) {
                std::swap(run.torque, run.sinkage);
                *run.torque *= 1000, *run.sinkage /= 1000;
              }),
              Contains(tells(DoubtKind::columns_swapped, {"runs.csv:1:14: ", "My", "z"})));
  EXPECT_THAT(doubts_with([](compare::Run& run) { std::swap(run.torque, run.lateral_force); }),
              ElementsAre(tells(DoubtKind::columns_swapped, {"runs.csv:1:16: ", "My", "Fy"})));
}

// No third column is told to explain the two.
TEST(ColumnDoubts, EachColumnIsToldOnceWithTheOthersPutRight) {
  EXPECT_THAT(doubts_with([](compare::Run& run) { *run.torque *= -1, *run.sinkage /= 100; }),
              testing::UnorderedElementsAre(tells(DoubtKind::flipped_sign, {"runs.csv:1:11: ", "My"}),
                                            tells(DoubtKind::column_too_small, {"runs.csv:1:14: ", "z", 100})));
}

// Where no load of ten times less would pull so either, the soil is what it is: too soft for the wheel.
TEST(ColumnDoubts, ASoilTooSoftForItsWheelIsNoMistakenColumn) {
  Campaign campaign = rig_campaign();
  campaign.soil.k_phi.value /= 1000, campaign.soil.k_c.value /= 1000;
  EXPECT_THAT(of_mistaken_columns(doubts_before_fit(campaign)), IsEmpty());
}

}  // namespace
}  // namespace soilbin::compare
