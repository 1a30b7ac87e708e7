#include "dem/archive/checkpoints.hpp"

#include <fmt/core.h>

namespace soilbin::dem {

using Clock = std::chrono::steady_clock;

bool Checkpointer::is_due(std::int64_t step) const {
  if (checkpoints_.steps > 0 && step - step_ >= checkpoints_.steps) return true;
  return checkpoints_.seconds > 0 && std::chrono::duration<double>(Clock::now() - at_).count() >= checkpoints_.seconds;
}

void Checkpointer::write(const Simulation& simulation, const Notes& notes) {
  write_restart(checkpoints_.restart, simulation.setup(), simulation.state(), notes);
  step_ = simulation.state().step;
  at_ = Clock::now();
}

Start resume_or_start(const std::filesystem::path& restart, const std::function<Simulation()>& fresh,
                      std::optional<int> threads) {
  if (!has_restart(restart)) return {fresh(), {}, ""};
  LastGood found = read_last_good(restart);
  std::string message = found.warning.empty() ? "" : found.warning + "\n";
  message += fmt::format("going on from {}, step {}", found.from.string(), found.restart.state.step);
  if (threads) found.restart.setup.numerics.threads = *threads;
  return {Simulation(std::move(found.restart.setup), std::move(found.restart.state)), std::move(found.restart.notes),
          std::move(message)};
}

}  // namespace soilbin::dem
