// Time logs: how samples become runs, with which errors, and how rows that are samples are told from runs.
#include "compare/measured/time_log.hpp"

#include <fmt/core.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <random>

#include "bekker_wong/effect_vocabulary.hpp"
#include "compare/doubt_matchers.hpp"
#include "compare/doubts/doubts.hpp"
#include "compare/measured/stretches.hpp"
#include "scenario/csv.hpp"
#include "scenario/library.hpp"
#include "tests/compare/modelled_campaign.hpp"
#include "tests/scenario/refusal.hpp"

namespace soilbin::compare {
namespace {

using test::refusal;
using testing::AllOf;
using testing::Contains;
using testing::Each;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;
using testing::StartsWith;

TimeLog log_of(const std::string& csv, const LogReading& how = {}) {
  return read_time_log(make_source_text(csv, "log.csv"), how);
}

LogRuns runs_of(const std::string& csv, const LogReading& how = {}) { return runs_of_log(log_of(csv, how)); }

/// x_k = 0.8 x_(k-1) + noise, of standard deviation 1; its autocorrelation time is (1 + 0.8)/(1 - 0.8) = 9.
class SlowNoise {
 public:
  explicit SlowNoise(unsigned seed) : random_(seed) {}
  double operator()() { return last_ = 0.8 * last_ + 0.6 * normal_(random_); }
  double white() { return normal_(random_); }

 private:
  std::mt19937 random_;
  std::normal_distribution<double> normal_;
  double last_ = 0.0;
};

/// Twelve runs of thirty samples as the base model has them, each run with an offset of its own bed.
Campaign logged_as_runs(unsigned seed) {
  Campaign campaign = modelled_campaign();
  const Scenario scenario = scenario_of(campaign);
  const auto model = make_model(ModelKind::bekker_wong);
  SlowNoise noise(seed);
  campaign.runs.clear();
  for (const double load : {60.0, 80.0, 100.0})
    for (const double slip : {0.05, 0.15, 0.3, 0.5}) {
      const TractionResult told = *ask(*model, scenario, test::condition(load, slip)).result;
      const double bed = 0.02 * load * noise.white(), deeper = 0.0007 * noise.white();
      for (int i = 0; i < 30; ++i) {
        Run run;
        run.at = test::condition(load, slip);
        run.csv_line = static_cast<int>(campaign.runs.size()) + 2;
        run.drawbar_pull = told.drawbar_pull.value + bed + 0.4 * noise();
        run.torque = told.torque.value + 0.1 * bed + 0.03 * noise.white();
        run.sinkage = told.sinkage.value + deeper + 1e-4 * noise.white();
        campaign.runs.push_back(run);
      }
    }
  return campaign;
}

// 360 samples passed as 360 runs, and the beds' offsets as an effect: the file's own rows must tell.
TEST(RowsOfALog, AreToldFromRuns) {
  for (const unsigned seed : {1U, 2U}) {
    const Campaign campaign = logged_as_runs(seed);
    EXPECT_THAT(in_words(doubts(campaign)),
                Contains(AllOf(HasSubstr("samples of a time log"), HasSubstr("30 rows on end are at one setpoint"),
                               HasSubstr("soilbin runs 'runs.csv'"))));
    EXPECT_TRUE(tell_of(of_mistaken_columns(doubts_before_fit(campaign)), DoubtKind::rows_are_samples));
    const LogRuns made = runs_of(write_runs(campaign.runs));
    ASSERT_EQ(made.runs.size(), 12U);
    EXPECT_THAT(made.left_out, IsEmpty());
    Campaign reduced = campaign;
    reduced.runs.clear();
    for (const LoggedRun& one : made.runs) reduced.runs.push_back(one.run);
    EXPECT_THAT(signs_of_a_log(reduced), IsEmpty());
    for (std::size_t k = 0; k < 12; ++k) {
      double mean = 0.0;
      for (std::size_t i = 0; i < 30; ++i) mean += *campaign.runs[30 * k + i].drawbar_pull / 30;
      if (made.runs[k].cut_before + made.runs[k].cut_after == 0) {
        EXPECT_NEAR(*made.runs[k].run.drawbar_pull, mean, 1e-9 * std::abs(mean));
      }
      EXPECT_EQ(made.runs[k].first_line, static_cast<int>(2 + 30 * k));
      EXPECT_LT(made.runs[k].channels[0]->effective, 20.0) << "of 30 samples whose autocorrelation time is 9";
    }
  }
}

TEST(RowsOfALog, AreToldByAClockThatIsLeftAside) {
  Campaign campaign = modelled_campaign();
  IgnoredColumn clock{"time_s", {}, {}};
  for (int i = 0; i < 24; ++i) clock.texts.push_back(std::to_string(0.1 * (i % 12)));
  campaign.ignored = {clock};
  EXPECT_THAT(signs_of_a_log(campaign),
              ElementsAre(test::tells(DoubtKind::rows_are_samples, {campaign.data, "time_s", "", "", ""})));
  campaign.ignored[0].header = "operator";
  EXPECT_THAT(signs_of_a_log(campaign), IsEmpty());
  campaign.ignored[0] = {"time", {}, {"09:10", "09:55", "10:20"}};
  EXPECT_THAT(signs_of_a_log(campaign), IsEmpty()) << "when a run was made";
}

TEST(RowsOfALog, AreToldByTheNumberOfTheirRunAndByTheirWheels) {
  Campaign campaign = modelled_campaign();
  for (std::size_t i = 0; i < campaign.runs.size(); ++i) campaign.runs[i].at.run = static_cast<int>(i / 4);
  campaign.ignored = {{"wheel", {}, {"A", "A", "B"}}};
  EXPECT_THAT(signs_of_a_log(campaign),
              ElementsAre(test::tells(DoubtKind::rows_are_samples, {campaign.data, "", 4, "", ""}),
                          test::tells(DoubtKind::several_wheels, {"wheel", 2})));
}

// Re-runs, sorted, shuffled or in fine steps of slip, are runs: each on a bed of its own.
TEST(RowsOfALog, AreNotSeenInRuns) {
  const Campaign log = logged_as_runs(3);
  Campaign campaign = log;
  campaign.runs.clear();
  for (std::size_t k = 0; k < 12; ++k)  // three re-runs on end
    for (std::size_t i = 0; i < 3; ++i) campaign.runs.push_back(log.runs[30 * k + 10 * i]);
  EXPECT_THAT(signs_of_a_log(campaign), IsEmpty());
  campaign.runs = log.runs;  // thirty of each, in random order
  std::shuffle(campaign.runs.begin(), campaign.runs.end(), std::mt19937(1));
  EXPECT_THAT(signs_of_a_log(campaign), IsEmpty());
  campaign = modelled_campaign();
  const compare::Run first = campaign.runs.front();
  campaign.runs.clear();
  for (int i = 0; i < 120; ++i) {  // slips of 0.5 % apart
    campaign.runs.push_back(first);
    campaign.runs.back().at.slip = 0.005 * i, campaign.runs.back().at.run = i;
    *campaign.runs.back().drawbar_pull += 0.1 * i;
  }
  EXPECT_THAT(signs_of_a_log(campaign), IsEmpty());
}

TEST(RowsOfALog, OfALoggedSweepAreSmooth) {
  Campaign campaign = modelled_campaign();
  const compare::Run first = campaign.runs.front();
  campaign.runs.clear();
  for (int i = 0; i < 1200; ++i) {
    campaign.runs.push_back(first);
    campaign.runs.back().at.slip = 0.0005 * i, campaign.runs.back().at.run.reset();
    *campaign.runs.back().drawbar_pull += 0.01 * i;
  }
  EXPECT_THAT(signs_of_a_log(campaign),
              ElementsAre(test::tells(DoubtKind::rows_are_samples, {campaign.data, "", "", "", 1200})));
}

constexpr const char* unknown_clock = "time_s,load_N,slip,sinkage_m\n0.1,80,0.2,0.01\n";

TEST(RowsOfALog, WithAClockAreRefusedWithTheCommandThatMakesRuns) {
  const auto open = [](const std::string& name) { return make_source_text(unknown_clock, name); };
  const std::string yaml =
      "format: soilbin-campaign/1\nname: c\nwheel: {radius: 0.25 m, width: 0.1 m}\nsoil:\n  exponent: 1.1\n  k_c: 0.99 "
      "kN/m^(n+1)\n  k_phi: 1528 kN/m^(n+2)\n  cohesion: 1.04 kPa\n  friction_angle: 28 deg\n  shear_modulus: 20 "
      "mm\n  stress_angle_c1: 0.18\n  stress_angle_c2: 0.32\n";
  EXPECT_THAT(refusal([&] {
                parse_campaign(make_source_text(yaml, "campaign.yaml"), open, Library(),
                               bekker_wong::CatalogueVocabulary());
              }),
              AllOf(StartsWith("runs.csv:1:1: column 'time_s' holds a time"), HasSubstr("soilbin runs 'runs.csv'")));
}

/// A log of holds, each at its slip, of so many samples; a clock in tenths of a second.
std::string log_at(const std::vector<double>& slips, int samples, SlowNoise& noise, double pause = 0.1) {
  std::string csv = "time_s,load_kN,slip [%],drawbar_pull_N,motor_temperature\n";
  double time = 0.0;
  for (const double slip : slips) {
    for (int i = 0; i < samples; ++i, time += 0.1)
      csv += fmt::format("{:.1f},{:.5f},{:.3f},{:.4f},20\n", time, 0.08 + 0.001 * noise.white(),
                         100 * slip + 0.5 * noise.white(), 100 * slip + 2 * noise());
    time += pause - 0.1;
  }
  return csv;
}

TEST(TimeLogs, AreDividedWhereTheConditionsStep) {
  SlowNoise noise(4);
  const LogRuns made = runs_of(log_at({0.1, 0.2, 0.1, 0.4}, 300, noise));
  ASSERT_EQ(made.runs.size(), 4U);
  const double slips[] = {0.1, 0.2, 0.1, 0.4};
  for (std::size_t k = 0; k < 4; ++k) {
    const LoggedRun& one = made.runs[k];
    EXPECT_NEAR(one.first_line, 2 + 300 * static_cast<double>(k), 3.0) << "noise may move the step by a sample or two";
    EXPECT_NEAR(one.run.at.slip, slips[k], 0.001);
    EXPECT_NEAR(one.run.at.load, 80.0, 0.5) << "in kN there";
    EXPECT_EQ(one.run.at.run, static_cast<int>(k) + 1);
    EXPECT_NEAR(*one.run.drawbar_pull, 100 * slips[k], 4 * one.channels[0]->mean.std_error);
  }
  EXPECT_EQ(made.runs[0].run.setpoint, made.runs[2].run.setpoint);
  EXPECT_NE(made.runs[0].run.setpoint, made.runs[1].run.setpoint);
  EXPECT_THAT(made.notes, Contains("Columns left aside: motor_temperature."));
  EXPECT_TRUE(made.has_clock);
  EXPECT_EQ(made.periods, 1U) << "the clock goes on from the first run to the last";
}

// The clock's breaks tell two runs at one setpoint apart; without a clock they are one.
TEST(TimeLogs, AreDividedWhereTheClockBreaks) {
  SlowNoise noise(5);
  EXPECT_EQ(runs_of(log_at({0.1, 0.1, 0.1}, 100, noise, 60.0)).runs.size(), 3U);
  EXPECT_EQ(runs_of(log_at({0.1, 0.1, 0.1}, 100, noise)).runs.size(), 1U);
}

/// A steady hold of 120 samples, a second apart and with no break, whose clock reads so.
std::string hold_by_clock(const std::function<std::string(int second)>& clock) {
  SlowNoise noise(6);
  std::string csv = "time,load_N,slip,drawbar_pull_N\n";
  for (int i = 0; i < 120; ++i) csv += fmt::format("{},80,0.1,{:.4f}\n", clock(i), 10 + noise.white());
  return csv;
}

/// "23:59:00" and on.
std::string late(int second) {
  return fmt::format("{:02}:{:02}:{:02}", second < 60 ? 23 : 0, second < 60 ? 59 : 0, second % 60);
}

TEST(TimeLogs, PassMidnightAndTheEndOfAMonthUnbroken) {
  const auto dated = [](const char* before, const char* after) {
    return hold_by_clock([=](int i) { return fmt::format("{} {}", i < 60 ? before : after, late(i)); });
  };
  for (const std::string& csv :
       {hold_by_clock(late), dated("2026-01-31", "2026-02-01"), dated("12/31/2025", "01/01/2026"),
        dated("04/05/2026", "05/05/2026"), dated("05/04/2026", "05/05/2026"), dated("28.02.2028", "29.02.2028")}) {
    const LogRuns made = runs_of(csv);
    EXPECT_EQ(made.runs.size(), 1U) << csv.substr(30, 30);
    EXPECT_EQ(made.periods, 1U);
    EXPECT_THAT(made.notes, IsEmpty());
  }
  EXPECT_EQ(runs_of(dated("2026-01-31", "2026-02-02")).periods, 2U) << "a day lies between";
}

TEST(TimeLogs, SayThatAClockCannotBeRead) {
  const LogRuns made = runs_of(hold_by_clock([](int i) { return fmt::format("noon and {}", i); }));
  EXPECT_FALSE(made.has_clock);
  EXPECT_THAT(made.notes, ElementsAre(HasSubstr("Times that can't be read: 120, the first 'noon and 0'")));
}

// White noise x with autocorrelation time 9: the error of a mean of n is sd sqrt(9/n), not sd/sqrt(n).
TEST(TimeLogs, GiveErrorsThatAllowForSamplesBeingAlike) {
  double squares = 0.0, told = 0.0, effective = 0.0;
  constexpr int runs = 60, samples = 900;
  for (unsigned seed = 0; seed < runs; ++seed) {
    SlowNoise noise(100 + seed);
    const LogRuns made = runs_of(log_at({0.2}, samples, noise));
    const RunMean& pull = *made.runs.at(0).channels[0];
    squares += (pull.mean.value - 20.0) * (pull.mean.value - 20.0) / runs;
    told += pull.mean.std_error * pull.mean.std_error / runs, effective += pull.effective / runs;
    EXPECT_NEAR(pull.sd, 2.0, 0.5);
  }
  const double expected = 2.0 * std::sqrt(9.0 / samples);
  EXPECT_NEAR(std::sqrt(told), expected, 0.15 * expected);
  EXPECT_NEAR(std::sqrt(squares), expected, 0.3 * expected) << "sixty means scatter so themselves";
  EXPECT_NEAR(effective, samples / 9.0, 0.35 * samples / 9.0);
}

/// One hold whose pull begins far off, and ends so.
std::string log_with_transients(SlowNoise& noise) {
  std::string csv = "run,load_N,slip,drawbar_pull_N\n";
  for (int i = 0; i < 400; ++i) {
    const double off = 30 * std::exp(-i / 15.0) + 30 * std::exp((i - 399) / 10.0);
    csv += fmt::format("1,80,0.2,{:.5f}\n", 20 + off + 0.5 * noise.white());
  }
  return csv;
}

TEST(TimeLogs, LoseTheirTransientsAtBothEnds) {
  SlowNoise noise(6);
  const LogRuns made = runs_of(log_with_transients(noise));
  ASSERT_EQ(made.runs.size(), 1U);
  const LoggedRun& one = made.runs[0];
  EXPECT_GT(one.cut_before, 30U) << "after two of its times of decay there are 4 N left";
  EXPECT_GT(one.cut_after, 20U);
  EXPECT_LT(one.cut_before + one.cut_after, 250U);
  EXPECT_NEAR(*one.run.drawbar_pull, 20.0, 0.2);
  std::string steady = "run,load_N,slip,drawbar_pull_N\n";
  for (int i = 0; i < 400; ++i) steady += fmt::format("1,80,0.2,{:.5f}\n", 20 + 0.5 * noise.white());
  EXPECT_LE(runs_of(steady).runs.at(0).cut_before, 20U) << "nothing to cut";
}

TEST(TimeLogs, OfRampsMakeNoRuns) {
  std::string csv = "run,load_N,slip,drawbar_pull_N\n";
  for (int i = 0; i < 200; ++i) csv += fmt::format("1,80,{:.4f},{:.3f}\n", 0.003 * i, 10 + 0.1 * i);
  EXPECT_THAT(refusal([&] { runs_of(csv); }),
              AllOf(HasSubstr("no run has a steady setpoint: a ramp: the slip goes from"), HasSubstr("--by COLUMN")));
  for (int i = 0; i < 50; ++i) csv += fmt::format("2,80,0.2,{}\n", 20 + i % 2);
  const LogRuns made = runs_of(csv);
  EXPECT_EQ(made.runs.size(), 1U);
  ASSERT_EQ(made.left_out.size(), 1U);
  EXPECT_THAT(made.left_out[0].why, HasSubstr("a ramp: the slip goes from"));
  EXPECT_EQ(made.left_out[0].samples, 200U);
}

TEST(TimeLogs, SayWhichRunsAreNotSteady) {
  SlowNoise noise(7);
  std::string csv = "run,load_N,slip,drawbar_pull_N,sinkage_mm\n";
  for (int i = 0; i < 200; ++i) csv += fmt::format("1,80,0.2,{:.3f},{:.3f}\n", 10 + 0.1 * i, 5 + noise.white());
  EXPECT_EQ(runs_of(csv).runs.at(0).unsteady.at(0).title, "drawbar pull");
}

TEST(TimeLogs, OfSeveralWheelsAreReadOneByOne) {
  std::string csv = "wheel,load_N,slip,sinkage_m\n";
  for (const char* wheel : {"A", "B"})
    for (int i = 0; i < 20; ++i) csv += fmt::format("{},80,0.2,{}\n", wheel, wheel[0] == 'A' ? 0.01 : 0.02);
  EXPECT_THAT(refusal([&] { log_of(csv); }),
              AllOf(StartsWith("log.csv:1:1: samples of 2 wheels: A, B"), HasSubstr("--only 'wheel=A'")));
  LogReading only;
  only.only = {{"wheel", "B"}};
  EXPECT_NEAR(*runs_of(csv, only).runs.at(0).run.sinkage, 0.02, 1e-15);
}

TEST(TimeLogs, DropRowsThatRepeatTheOneBefore) {
  std::string csv = "t,load_N,slip,sinkage_m\n";
  for (int i = 0; i < 20; ++i)
    for (int again = 0; again < 2; ++again) csv += fmt::format("{},80,0.2,{}\n", i, 0.01 + 0.0001 * (i % 3));
  const LogRuns made = runs_of(csv);
  EXPECT_EQ(made.runs.at(0).samples, 20U);
  EXPECT_THAT(made.notes, Contains("Rows that repeat the one before them, dropped: 20."));
}

TEST(TimeLogs, AColumnThatCountsSamplesNamesNoRuns) {
  std::string csv = "run,load_N,slip,sinkage_m\n";
  for (int i = 0; i < 60; ++i) csv += fmt::format("{},80,{},0.01\n", i + 1, i < 30 ? 0.1 : 0.3);
  const LogRuns made = runs_of(csv);
  EXPECT_EQ(made.runs.size(), 2U);
  EXPECT_THAT(made.notes, Contains(HasSubstr("it names no runs")));
}

TEST(TimeLogs, ArePartedByAColumnOfTheirOwn) {
  std::string csv = "Versuch,load_N,slip,sinkage_m\n";
  for (int i = 0; i < 60; ++i) csv += fmt::format("V{},80,0.1,0.01\n", i / 20);
  EXPECT_EQ(runs_of(csv).runs.size(), 1U);
  LogReading how;
  how.by = "Versuch";
  EXPECT_EQ(runs_of(csv, how).runs.size(), 3U);
  how.by = "Versuhc";
  EXPECT_THAT(refusal([&] { runs_of(csv, how); }), HasSubstr("did you mean 'Versuch'?"));
}

TEST(TimeLogs, AreRefusedWithWhatIsMissing) {
  EXPECT_THAT(refusal([] { log_of("load_N,sinkage_m\n80,0.1\n"); }), HasSubstr("no column holds the slip"));
  EXPECT_THAT(refusal([] { log_of("load_N,slip\n80,0.1\n"); }), HasSubstr("no measured channel"));
  EXPECT_THAT(refusal([] { log_of("load_N,slip,sinkage_m\n"); }), HasSubstr("holds no samples"));
  EXPECT_THAT(refusal([] { log_of("load_N,slip,sinkage_m\n80,0.1,deep\n"); }),
              StartsWith("log.csv:2:8: column 'sinkage_m': expected a finite number"));
  EXPECT_THAT(refusal([] { log_of("load_N,load_kN,slip,sinkage_m\n80,1,0.1,1\n"); }), HasSubstr("both hold 'load'"));
}

TEST(TimeLogs, ClocksAreNumbersOrTimesOfDay) {
  EXPECT_EQ(clock_time("12.5"), 12.5);
  EXPECT_EQ(clock_time("01:02:03.5"), 3723.5);
  EXPECT_EQ(*clock_time("2026-01-02T00:00:01") - *clock_time("2026-01-01T23:59:59"), 2.0);
  for (const char* clock : {"t", "time_s", "Time [ms]", "timestamp", "t_min"})
    EXPECT_TRUE(names_a_clock(clock)) << clock;
  for (const char* other : {"T", "t_ambient", "time_constant", "slip", "torque_Nm"})
    EXPECT_FALSE(names_a_clock(other)) << other;
  EXPECT_FALSE(clock_time("noon"));
  EXPECT_FALSE(clock_time("2026-02-30T00:00:00")) << "no such day";
  EXPECT_EQ(clock_time("12:00:01 AM"), 1.0);
  EXPECT_EQ(clock_time("1:30 pm"), 13.5 * 3600);
  EXPECT_EQ(clock_time("1970-01-02T00:00:00Z"), 86400.0);
  for (const char* same : {"2026-01-31T22:51:40Z", "2026-01-31T23:51:40+01:00", "2026-01-31 14:51:40 -0800",
                           "01/31/2026 10:51:40 PM", "31.01.2026 22:51:40", "31.1.26 22:51:40 UTC"})
    EXPECT_EQ(clock_time(same), clock_time("2026-01-31T22:51:40")) << same;
  EXPECT_FALSE(clock_time("1:2:3:4"));
}

// Under the names and units that a campaign declares its reader takes the rows as they are.
TEST(TimeLogs, AreWrittenUnderACampaignsNames) {
  std::string csv = "Fz,i,Fx\n";
  for (int i = 0; i < 40; ++i) csv += fmt::format("0.08,20,{}\n", 12.25 + 0.5 * (i % 2));
  LogReading how;
  how.columns = {{"load", {"Fz", "kN", {}}}, {"slip", {"i", "%", {}}}, {"drawbar_pull", {"Fx", "N", {}}}};
  EXPECT_EQ(runs_csv(runs_of(csv, how), how.columns).substr(0, 60),
            std::string("run,setpoint,Fz,i,Fx,drawbar_pull_sd_N,drawbar_pull_error_N\n1,s1,0.08,20,").substr(0, 60));
}

TEST(Stretches, AreThoseThatCostLeast) {
  const std::vector<HeldSeries> held = {{{1, 1, 1, 1, 5, 5, 5, 2, 2, 2, 2, 2}, 0.1}};
  EXPECT_THAT(stretch_starts(held, 0, 12), ElementsAre(0U, 4U, 7U));
  EXPECT_THAT(stretch_starts(held, 4, 7), ElementsAre(4U));
  std::vector<HeldSeries> longer = {{std::vector<double>(50'001, 0.0), 0.1}};
  std::fill(longer[0].values.begin() + 12'345, longer[0].values.end(), 1.0);
  EXPECT_THAT(stretch_starts(longer, 0, 50'001), ElementsAre(0U, 12'345U)) << "to the row, though blocks are parted";
}

// A spreadsheet of a country with a decimal comma, read and written.
TEST(DecimalCommas, AreReadAndWritten) {
  const CsvTable table =
      parse_csv(make_source_text("load_N;slip;label\n80,5;-1,5e-1;\"a,5\"\n81;0.2;\"1,5\"\n", "x.csv"));
  ASSERT_EQ(table.rows.size(), 2U);
  EXPECT_EQ(table.rows[0].cells[0].text, "80.5");
  EXPECT_EQ(table.rows[0].cells[1].text, "-1.5e-1");
  EXPECT_EQ(table.rows[0].cells[2].text, "a,5");
  EXPECT_EQ(table.rows[1].cells[1].text, "0.2") << "a decimal point is one too";
  EXPECT_EQ(table.rows[1].cells[2].text, "1,5") << "in quotes it is a text";
}

TEST(DecimalCommas, ComeBackAsTheyWere) {
  const std::string csv =
      "\"a;b\",x,label\n1.5,-2e-05,plain\n,0.1,\"say \"\"so\"\"; or, not\"\n3,4,\"1,5\"\n5,6,\"two\nlines\"\n7,8,1.5\n";
  const std::string comma = with_decimal_commas(csv);
  EXPECT_THAT(comma, HasSubstr("1,5;-2e-05;plain\n"));
  const CsvTable before = parse_csv(make_source_text(csv, "a.csv")),
                 after = parse_csv(make_source_text(comma, "b.csv"));
  ASSERT_EQ(before.rows.size(), after.rows.size());
  for (std::size_t r = 0; r < before.rows.size(); ++r)
    for (std::size_t c = 0; c < before.header.cells.size(); ++c) {
      EXPECT_EQ(before.rows[r].cells[c].text, after.rows[r].cells[c].text) << r << ',' << c;
      EXPECT_EQ(before.header.cells[c].text, after.header.cells[c].text);
    }
}

}  // namespace
}  // namespace soilbin::compare
