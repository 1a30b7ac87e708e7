#include "dem/archive/resumable_run.hpp"

#include <fmt/core.h>

namespace soilbin::dem {
namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

Notes notes_of(const Driver& driver) { return driver.notes ? driver.notes() : Notes{}; }

[[noreturn]] void keep_and_stop(Checkpointer& checkpointer, const fs::path& path, const Simulation& simulation,
                                const Driver& driver, const RunStopped& reason) {
  std::string where;
  try {
    checkpointer.write(path, simulation, notes_of(driver));
    where = fmt::format("its state is in {}", path.string());
  } catch (const std::runtime_error& error) {
    where = fmt::format("its state is lost: {}", error.what());
  }
  throw RunStopped(fmt::format("{}\n  {}", reason.what(), where));
}

}  // namespace

bool Checkpointer::is_due(std::int64_t step) const {
  if (checkpoints_.steps > 0 && step - step_ >= checkpoints_.steps) return true;
  return checkpoints_.seconds > 0 && std::chrono::duration<double>(Clock::now() - at_).count() >= checkpoints_.seconds;
}

void Checkpointer::write(const fs::path& path, const Simulation& simulation, const Notes& notes) {
  write_restart(path, simulation.setup(), simulation.state(), notes);
  step_ = simulation.state().step;
  at_ = Clock::now();
}

Start resume_or_start(const fs::path& restart, const std::function<Simulation()>& fresh, std::optional<int> threads) {
  if (!has_restart(restart)) return {fresh(), {}, ""};
  LastGood found = read_last_good(restart);
  std::string told = found.warning.empty() ? "" : found.warning + "\n";
  told += fmt::format("going on from {}, step {}", found.from.string(), found.restart.state.step);
  if (threads) found.restart.setup.numerics.threads = *threads;
  return {Simulation(std::move(found.restart.setup), std::move(found.restart.state)), std::move(found.restart.notes),
          std::move(told)};
}

RunEnd run_resumably(Simulation& simulation, std::int64_t until, const Checkpoints& checkpoints,
                     const std::atomic<bool>& stop, const Driver& driver) {
  Checkpointer checkpointer(checkpoints, simulation.state().step);
  const auto at_step = [&] {
    if (driver.at_step) driver.at_step(simulation);
  };
  at_step();
  while (simulation.state().step < until) {
    try {
      simulation.run(1);
    } catch (const RunStopped& reason) {
      keep_and_stop(checkpointer, checkpoints.restart.string() + ".stopped", simulation, driver, reason);
    }
    const std::int64_t step = simulation.state().step;
    const bool stopping = stop && step < until;
    if (stopping || step >= until || checkpointer.is_due(step)) checkpointer.write(simulation, notes_of(driver));
    if (stopping) return RunEnd::interrupted;
    at_step();
  }
  return RunEnd::reached;
}

}  // namespace soilbin::dem
