#include "dem/worker_lammps/lammps_run.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "scenario/estimate.hpp"

namespace soilbin::dem {
namespace {

constexpr std::int64_t between_words = 100;  // steps, as StagedRun

}  // namespace

LammpsRun::LammpsRun(MPI_Comm world, const WheelJob& job, const WorkOptions& how, const std::string& log)
    : job_(job), how_(how), simulation_(world, job.setup, job.bed.state, log) {}

double LammpsRun::seconds() const {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - began_).count();
}

void LammpsRun::through(const std::function<void()>& stages) {
  rest();
  stages();
  tell("done", 1);
  tell_cost();
}

void LammpsRun::tell_cost() const {
  const double grains = simulation_.grain_count(), steps = static_cast<double>(simulation_.state().step);
  const double bytes = simulation_.memory_a_grain();
  int rank = 0, ranks = 1;
  MPI_Comm_rank(simulation_.world(), &rank), MPI_Comm_size(simulation_.world(), &ranks);
  if (rank != 0 || !how_.tell) return;
  how_.tell(
      fmt::format("cost ranks {} grains {:.0f} steps {:.0f} seconds {:.4g} grain_steps_per_second {:.4g} "
                  "bytes_a_grain {:.4g}",
                  ranks, grains, steps, seconds(), grains * steps / seconds(), bytes));
}

/// Until the grains are as slow as the bed's own test asks.
void LammpsRun::rest() {
  const RestTest& test = job_.bed.recipe.rest;
  const double diameter = mean_diameter(job_.bed.recipe.soil), dt = simulation_.setup().numerics.dt;
  const std::int64_t every = std::max<std::int64_t>(1, std::llround(test.every / dt));
  while (true) {
    steps("resting", every, [&](std::int64_t) { simulation_.run(1); });
    if (simulation_.kinetic(diameter) < test.kinetic) return;
    if (simulation_.time() > test.at_most)
      throw RunStopped(fmt::format("the bed did not come to rest again in {:.3g} s: kinetic {:.3g}, asked {:.3g}",
                                   test.at_most, simulation_.kinetic(diameter), test.kinetic));
  }
}

void LammpsRun::steps(std::string_view stage, std::int64_t steps, const std::function<void(std::int64_t)>& each) {
  std::int64_t taken = 0;
  loop(
      stage, [&] { return taken < steps; }, [&] { each(taken++); });
}

void LammpsRun::loop(std::string_view stage, const std::function<bool()>& goes_on, const std::function<void()>& each) {
  for (std::int64_t taken = 0; goes_on(); ++taken) {
    if (taken % between_words == 0) tell(stage, std::min(1.0, static_cast<double>(steps_) / all_steps_));
    each();
  }
}

void LammpsRun::step() {
  simulation_.run(1);
  ++steps_;
}

void LammpsRun::tell(std::string_view stage, double share) const {
  int rank = 0, stops = how_.stop.stop_requested();
  MPI_Comm_rank(simulation_.world(), &rank);
  MPI_Allreduce(MPI_IN_PLACE, &stops, 1, MPI_INT, MPI_MAX, simulation_.world());
  if (stops) throw Stopped();
  if (rank == 0 && how_.progress)
    how_.progress({stage, share, share > 0 ? seconds() * (1 - share) / share : not_a_number});
}

}  // namespace soilbin::dem
