// Runs of the rig that are stopped, or lose their process, and go on: to the bit as if they never had.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <filesystem>
#include <fstream>

#include "dem/archive/note_text.hpp"
#include "dem/archive/sealed_file.hpp"
#include "dem/rig/dem_model.hpp"
#include "dem/rig/drive_parts.hpp"
#include "dem/rig/staged_run.hpp"
#include "scenario/errors.hpp"
#include "scenario/unit.hpp"
#include "tests/dem/archive_scene.hpp"
#include "tests/dem/small_bed.hpp"
#include "tests/scenario/refusal.hpp"

namespace soilbin::dem {
namespace {

using test::Folder;
using test::small_wheel;
using test::with_threads;
using ::testing::HasSubstr;

const SettledBed& bed() {
  static const SettledBed bed = settle_bed(test::small_recipe({0.8, 0.16, 0.06}), with_threads(1));
  return bed;
}

Rig short_rig() {
  Rig rig;
  rig.behind = 0.12, rig.ahead = 0.12;
  rig.tilting = 0.1, rig.lowering = 0.1, rig.resting = 0.05;
  rig.ledger = true;
  return rig;
}

/// Up a slope that grows, with a motor that comes to its limit.
Drive small_drive() {
  Drive drive;
  drive.load = 20;
  drive.duration = 0.6;
  drive.controller.rim_speed = 0.3, drive.controller.highest_torque = 0.5, drive.controller.ramp = 0.2;
  drive.profile.resize(2);
  drive.profile[0].longitudinal_incline = 2 * degree, drive.profile[0].drawbar = 1;
  drive.profile[1] = drive.profile[0];
  drive.profile[1].at = 0.1, drive.profile[1].longitudinal_incline = 5 * degree;
  return drive;
}

GrainDriveRecord driven(const Drive& drive, const Rig& rig, const WorkOptions& how, const Checkpoints& checkpoints) {
  return drive_freely({bed(), small_wheel(), bed().recipe.soil.grain_tire, rig}, drive, 30, how, checkpoints);
}

/// Everything that a drive tells.
std::string bits_of(GrainDriveRecord record) {
  NoteWriter bits;
  bits(record.end, record.end_time, record.samples, record.happenings, record.hold, record.grains, record.steps);
  bool steady = record.steady.has_value();
  bits(steady, record.not_steady);
  return bits.text();
}

OperatingCondition two_passes_uphill() {
  OperatingCondition at;
  at.load = 20, at.slip = 0.2, at.speed = 0.3, at.longitudinal_incline = 2 * degree, at.pass = 2;
  return at;
}

WheelRun run(const WorkOptions& how, const Checkpoints& checkpoints) {
  return run_wheel({bed(), small_wheel(), bed().recipe.soil.grain_tire, short_rig()}, two_passes_uphill(), how,
                   checkpoints);
}

std::string bits_of(WheelRun run) {
  NoteWriter bits;
  bits(run.samples, run.steady_from, run.steady, run.drift, run.surface, run.moment, run.flow.vx, run.flow.solid);
  bits(run.rut.across, run.rut.along, run.rut.volume, run.result.drawbar_pull.value, run.result.torque.std_error);
  return bits.text();
}

/// Stops the work at each so many words that it says, until it is done; gives what it told and how often it stopped.
std::pair<std::string, int> stopped_again_and_again(const auto& work, int words) {
  int stops = 0;
  while (true) {
    std::stop_source source;
    WorkOptions how = with_threads(1 + stops % 2);
    how.stop = source.get_token();
    how.progress = [&, said = 0](const Progress&) mutable {
      if (++said == words) source.request_stop();
    };
    try {
      return {bits_of(work(how)), stops};
    } catch (const Stopped&) {
      ++stops;
    }
  }
}

TEST(SlowRigResume, ADriveThatIsStoppedAgainAndAgainTellsTheSame) {
  const Folder folder;
  const std::string whole = bits_of(driven(small_drive(), short_rig(), with_threads(1), {}));
  std::vector<std::string> told;
  const Checkpoints kept{folder / "drive.h5", 0, 0, [&](const std::string& words) { told.push_back(words); }};
  const auto work = [&](const WorkOptions& how) { return driven(small_drive(), short_rig(), how, kept); };
  const auto began = std::chrono::steady_clock::now();
  const auto [bits, stops] = stopped_again_and_again(work, 4);
  const double took = std::chrono::duration<double>(std::chrono::steady_clock::now() - began).count();
  EXPECT_GE(stops, 4);
  EXPECT_TRUE(bits == whole);
  ASSERT_GE(told.size(), 2U);
  EXPECT_THAT(told[0], HasSubstr("the same command goes on from there"));
  EXPECT_THAT(told[1], HasSubstr("going on from " + kept.restart.string()));
  // Its last restart answers at once.
  WorkOptions quick = with_threads(1);
  quick.progress = [](const Progress& progress) { EXPECT_EQ(progress.done, 1); };
  const GrainDriveRecord again = driven(small_drive(), short_rig(), quick, kept);
  EXPECT_TRUE(bits_of(again) == whole);
  EXPECT_GT(again.earlier, 0) << "the seconds of all pieces add up";
  EXPECT_LT(again.earlier, took);
}

TEST(SlowRigResume, OfTwoAtOneRunOneKeepsIt) {
  const Folder folder;
  Drive brief = small_drive();
  brief.duration = 0.1;
  Checkpoints kept{folder / "drive.h5", 0, 100};
  std::string told, other;
  kept.tell = [&](const std::string& words) { told += words; };
  WorkOptions how = with_threads(1);
  how.progress = [&](const Progress&) {
    if (other.empty()) other = bits_of(driven(brief, short_rig(), with_threads(1), kept));
  };
  EXPECT_TRUE(bits_of(driven(brief, short_rig(), how, kept)) == other);
  EXPECT_EQ(told, "another process is at the same run: this one can't be gone on with");
  EXPECT_TRUE(has_restart(kept.restart));
  EXPECT_FALSE(std::filesystem::exists(kept.restart.string() + ".lock"));
}

// A run is worth more than the chance to go on with it: where the disk refuses, it says so and goes on.
TEST(SlowRigResume, ADiskThatRefusesStopsNoRun) {
  const Folder folder;
  Drive brief = small_drive();
  brief.duration = 0.1;
  const std::string whole = bits_of(driven(brief, short_rig(), with_threads(1), {}));
  std::ofstream(folder / "file") << "in the way";
  std::string told;
  const Checkpoints nowhere{folder / "file/drive.h5", 0, 100, [&](const std::string& words) { told += words; }};
  EXPECT_TRUE(bits_of(driven(brief, short_rig(), with_threads(1), nowhere)) == whole);
  EXPECT_THAT(told, testing::StartsWith("warning: "));
  EXPECT_THAT(told, HasSubstr("can't be gone on with"));

  told.clear();
  const Checkpoints later{folder / "drive.h5", 0, 100, nowhere.tell};
  WorkOptions how = with_threads(1);
  how.progress = [&](const Progress&) { std::filesystem::create_directories(later.restart / "in the way"); };
  EXPECT_TRUE(bits_of(driven(brief, short_rig(), how, later)) == whole);
  EXPECT_THAT(told, HasSubstr("drive.h5: can't write: Is a directory\n  the run goes on without"));
}

// Between a run's end and its answer's place in a file the restart is all there is of it.
TEST(SlowRigResume, AFinishedRunStaysUntilItIsForgotten) {
  const Folder folder;
  DemSettings settings;
  settings.size = {0.8, 0.16, 0.06}, settings.rig = short_rig(), settings.how = with_threads(1);
  settings.checkpoints.restart = folder / "";
  settings.forget_finished = false;
  std::string told;
  settings.checkpoints.tell = [&](const std::string& words) { told += words; };
  Scenario scenario;
  scenario.tire = small_wheel(), scenario.soil.granular = bed().recipe.soil;
  OperatingCondition at = two_passes_uphill();
  at.pass = 1;
  const DemModel model(settings);
  const double pull = model.evaluate(scenario, at).drawbar_pull.value;
  const std::filesystem::path restart = model.restart_of(scenario, at);
  EXPECT_TRUE(has_restart(restart));
  EXPECT_EQ(told, "");
  EXPECT_EQ(model.evaluate(scenario, at).drawbar_pull.value, pull);
  EXPECT_THAT(told, HasSubstr("going on from " + restart.string()));
  {
    const FileLock at_it(restart.string() + ".lock", FileLock::Wait::no);
    forget_run(restart);
    EXPECT_TRUE(has_restart(restart)) << "another process may be at it";
  }
  forget_run(restart);
  EXPECT_FALSE(has_restart(restart));
  EXPECT_FALSE(std::filesystem::exists(restart.string() + ".lock"));

  settings.forget_finished = true;
  EXPECT_EQ(DemModel(settings).evaluate(scenario, at).drawbar_pull.value, pull);
  EXPECT_FALSE(has_restart(restart));
}

TEST(SlowRigResume, ARunInTwoPassesThatIsStoppedAgainAndAgainTellsTheSame) {
  const Folder folder;
  const std::string whole = bits_of(run(with_threads(1), {}));
  const Checkpoints kept{folder / "run.h5", 0};
  const auto [bits, stops] = stopped_again_and_again([&](const WorkOptions& how) { return run(how, kept); }, 12);
  EXPECT_GE(stops, 4);
  EXPECT_TRUE(bits == whole);
}

// A killed process leaves the last restart that it wrote: here each of them in turn.
TEST(SlowRigResume, ADriveWhoseProcessIsLostGoesOnFromItsLastRestart) {
  const Folder lost, later;
  const std::string whole = bits_of(driven(small_drive(), short_rig(), with_threads(1), {}));
  const Checkpoints kept{lost / "drive.h5", 0, 700};
  int copies = 0;
  std::filesystem::file_time_type last;
  WorkOptions how = with_threads(1);
  how.progress = [&](const Progress&) {
    if (!has_restart(kept.restart) || std::filesystem::last_write_time(kept.restart) == last) return;
    last = std::filesystem::last_write_time(kept.restart);
    std::filesystem::copy(kept.restart, later / (std::to_string(copies++) + ".h5"));
  };
  EXPECT_TRUE(bits_of(driven(small_drive(), short_rig(), how, kept)) == whole);
  ASSERT_GE(copies, 3);
  for (int k = 0; k < copies; ++k) {
    const Checkpoints there{later / (std::to_string(k) + ".h5"), 0};
    EXPECT_TRUE(bits_of(driven(small_drive(), short_rig(), with_threads(1), there)) == whole) << k;
  }
}

TEST(SlowRigResume, ADamagedOrForeignRestartIsNeverTakenForTheRuns) {
  const Folder folder;
  const Checkpoints kept{folder / "drive.h5", 0, 700};
  const std::string whole = bits_of(driven(small_drive(), short_rig(), with_threads(1), kept));
  Drive other = small_drive();
  other.profile[1].drawbar = 2;
  EXPECT_THAT(soilbin::test::refusal([&] { driven(other, short_rig(), with_threads(1), kept); }),
              HasSubstr("is the restart of another run"));
  ASSERT_TRUE(has_restart(kept.restart));
  std::ofstream(kept.restart, std::ios::in | std::ios::out).seekp(2000) << "damage";
  std::string told;
  Checkpoints said = kept;
  said.tell = [&](const std::string& words) { told += words; };
  EXPECT_TRUE(bits_of(driven(small_drive(), short_rig(), with_threads(1), said)) == whole);
  EXPECT_THAT(told, HasSubstr("going on from " + previous_of(kept.restart).string()));
  std::ofstream(kept.restart) << "nothing";
  std::ofstream(previous_of(kept.restart)) << "nothing";
  EXPECT_THROW(driven(small_drive(), short_rig(), with_threads(1), kept), InputError);
}

TEST(SlowRigResume, ADriveWithoutAnAnswerLeavesNothing) {
  const Folder folder;
  Drive weak = small_drive();
  weak.profile[0].longitudinal_incline = 8 * degree;
  weak.controller.highest_torque = 0.01;
  const Checkpoints kept{folder / "drive.h5", 0, 100};
  EXPECT_THROW(driven(weak, short_rig(), with_threads(1), kept), NoSolution);
  EXPECT_FALSE(has_restart(kept.restart));
}

}  // namespace
}  // namespace soilbin::dem
