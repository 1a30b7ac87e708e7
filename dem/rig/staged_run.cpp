#include "dem/rig/staged_run.hpp"

#include <fmt/core.h>

#include "dem/rig/lammps_worker.hpp"
#include "scenario/atomic_file.hpp"
#include "scenario/errors.hpp"
#include "scenario/file_bytes.hpp"

namespace soilbin::dem {
namespace {

namespace fs = std::filesystem;

constexpr const char* inputs_note = "inputs";
constexpr const char* where_note = "stages";

fs::path lock_of(const fs::path& restart) { return restart.string() + ".lock"; }

/// Locks the restart; where another run holds it, or without a writable disk, disables checkpoints (no path).
std::unique_ptr<const FileLock> lock_or_none(Checkpoints& checkpoints) {
  if (checkpoints.restart.empty()) return nullptr;
  std::string why = "another process is at the same run: this one can't be gone on with";
  try {
    if (checkpoints.restart.has_parent_path()) make_folder(checkpoints.restart.parent_path());
    auto lock = std::make_unique<const FileLock>(lock_of(checkpoints.restart), FileLock::Wait::no);
    if (lock->is_held()) return lock;
  } catch (const std::runtime_error& error) {
    why = fmt::format("warning: {}\n  this run can't be gone on with if it is stopped", error.what());
  }
  if (checkpoints.tell) checkpoints.tell(why);
  checkpoints.restart.clear();
  return nullptr;
}

/// The run that lies there, if it is the one that is asked for.
Start begin(const Checkpoints& checkpoints, const std::string& inputs, int threads,
            const std::function<Simulation()>& fresh) {
  if (checkpoints.restart.empty()) return {fresh(), {}, ""};
  Start start = resume_or_start(checkpoints.restart, fresh, threads);
  if (!start.message.empty() && start.notes[inputs_note] != inputs)
    throw InputError({checkpoints.restart.string(), 0, 0}, "is the restart of another run", "",
                     "remove it to start anew");
  return start;
}

}  // namespace

StagedRun::StagedRun(const Checkpoints& checkpoints, std::string inputs, const WorkOptions& how,
                     const std::function<Simulation()>& fresh)
    : checkpoints_(checkpoints),
      lock_(lock_or_none(checkpoints_)),
      inputs_(std::move(inputs)),
      how_(how),
      start_(begin(checkpoints_, inputs_, how.threads, fresh)),
      checkpointer_(checkpoints_, start_.simulation.state().step) {
  if (!is_kept()) return;
  if (!start_.message.empty()) go_on_from(std::move(start_.notes), checkpoints_.restart.string());
  keep(where_note, *this);
  if (!start_.message.empty() && checkpoints_.tell) checkpoints_.tell(start_.message);
}

StagedRun::~StagedRun() {
  if (!lock_) return;
  std::error_code gone_already;
  fs::remove(lock_of(checkpoints_.restart), gone_already);
}

void forget_run(const fs::path& restart) {
  if (restart.empty()) return;
  const auto unless_another_is_at_it = [](const fs::path& lock_file, const std::function<void()>& remove) {
    try {
      const FileLock lock(lock_file, FileLock::Wait::no);
      if (!lock.is_held()) return;
      remove();
      std::error_code gone_already;
      fs::remove(lock_file, gone_already);
    } catch (const std::runtime_error&) {  // a folder that can't be written to any more: it stays
    }
  };
  if (const fs::path folder = lammps_folder(restart); is_there(folder))
    unless_another_is_at_it(lammps_lock(folder), [&] { fs::remove_all(folder); });
  if (has_restart(restart)) unless_another_is_at_it(lock_of(restart), [&] { remove_restart(restart); });
}

void StagedRun::through(const std::function<void()>& stages) {
  try {
    stages();
  } catch (const InputError&) {
    remove_restart(checkpoints_.restart);
    throw;
  }
  if (!end_stages()) write_restart();
  tell("done", 1);
}

/// False where there is none: a disk that is full now may have room at the next one.
bool StagedRun::write_restart() {
  if (!is_kept()) return false;
  try {
    Notes notes = kept_notes();
    notes[inputs_note] = inputs_;
    checkpointer_.write(simulation(), notes);
    return true;
  } catch (const std::runtime_error& error) {
    checkpointer_.put_off();
    if (checkpoints_.tell) checkpoints_.tell(fmt::format("warning: {}\n  the run goes on without", error.what()));
    return false;
  }
}

void StagedRun::step() {
  simulation().run(1);
  count_step();
}

void StagedRun::look(std::string_view stage, double share) {
  tell(stage, share);
  tell_of_threads();
  if (is_kept() && checkpointer_.is_due(simulation().state().step)) write_restart();
}

/// Once, where the run has given up threads.
void StagedRun::tell_of_threads() {
  const int all = simulation().threads(), used = simulation().threads_in_use();
  if (told_of_threads_ || used == all || !how_.tell) return;
  told_of_threads_ = true;
  how_.tell(fmt::format("other programs keep the cores busy: the run is faster with {} of {} threads (same answer)",
                        used, all));
}

/// Whatever stops the work here leaves its state.
void StagedRun::tell(std::string_view stage, double share) {
  try {
    if (how_.stop.stop_requested()) throw Stopped();
    if (how_.progress) how_.progress(progress(stage, share));
  } catch (...) {
    if (write_restart() && checkpoints_.tell)
      checkpoints_.tell(fmt::format("kept at {:.0f} %: the same command goes on from there", 100 * share));
    throw;
  }
}

}  // namespace soilbin::dem
