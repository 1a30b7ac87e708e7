// What the tests of grains in LAMMPS have in common: a wheel's job on the small bed, places by id, a folder of all
// processes.
#pragma once

#include <fmt/core.h>
#include <gtest/gtest.h>
#include <mpi.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <vector>

#include "dem/rig/wheel_in_bin.hpp"
#include "dem/rig/wheel_job.hpp"
#include "dem/worker_lammps/lammps_simulation.hpp"
#include "tests/dem/small_bed.hpp"

namespace soilbin::dem::test {

inline Tire lugged() {
  Tire tire = small_wheel();
  tire.lugs = {.height = 0.008, .count = 12, .thickness = 0.01};
  return tire;
}

inline Rig brief_rig() {
  Rig rig;
  rig.behind = 0.12, rig.ahead = 0.12, rig.travel = 0.25;
  rig.lowering = 0.1, rig.resting = 0.02, rig.starting = 0.05;
  return rig;
}

inline OperatingCondition driven() {
  OperatingCondition at;
  at.load = 20, at.slip = 0.3, at.speed = 0.3;
  return at;
}

/// The wheel driven over a bed, as the command hands it to the worker.
inline WheelJob wheel_job_on(const SettledBed& bed) {
  WheelJob job{.setup = {},
               .bed = bed,
               .tire = lugged(),
               .contact = bed.recipe.soil.grain_tire,
               .rig = brief_rig(),
               .at = driven(),
               .inputs = "of this run\n"};
  job.setup = run_setup(job.wheel(), 1);
  return job;
}

inline constexpr std::size_t most_ids = 2000;  // of the small bed

/// Positions of all grains, by id, on each process.
inline std::vector<double> places_of_all(const LammpsSimulation& simulation) {
  std::vector<double> numbers(3 * most_ids);
  const Grains& own = own_grains(simulation);
  for (std::size_t k = 0; k < own.count(); ++k) {
    std::copy_n(&own.motion[k].position.x, 3, &numbers[3 * own.id[k]]);
  }
  join_sums(simulation, numbers);
  return numbers;
}

/// A folder that goes with the test, the same on all processes.
class SharedFolder {
 public:
  SharedFolder() {
    int id = ::getpid();
    MPI_Bcast(&id, 1, MPI_INT, 0, MPI_COMM_WORLD);
    path_ = std::filesystem::path(testing::TempDir()) / fmt::format("soilbin-lammps-{}", id);
    std::filesystem::create_directories(path_);
    MPI_Barrier(MPI_COMM_WORLD);
  }
  SharedFolder(const SharedFolder&) = delete;
  SharedFolder& operator=(const SharedFolder&) = delete;
  ~SharedFolder() {
    MPI_Barrier(MPI_COMM_WORLD);
    std::error_code another_was_first;
    std::filesystem::remove_all(path_, another_was_first);
  }
  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

}  // namespace soilbin::dem::test
