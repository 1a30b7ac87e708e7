// What can be seen of a run in LAMMPS from outside: its grains, contacts and unrest, over all processes where it says
// so.
#include <array>

#include "dem/bed/settled_bed.hpp"
#include "dem/worker_lammps/lammps_simulation.hpp"
#include "dem/worker_lammps/processes.hpp"

namespace soilbin::dem {

Grains LammpsSimulation::own_grains() const {
  Grains own;
  const Lammps::Rows rows = lammps_.rows();
  for (int row = 0; row < lammps_.count(); ++row)
    own.add({.id = static_cast<GrainId>(rows.id[row] - 1),
             .radius = rows.radius[row],
             .mass = rows.mass[row],
             .material = grain_material,
             .position = vec(rows.position[row]),
             .velocity = vec(rows.velocity[row]),
             .spin = vec(rows.spin[row])});
  return own;
}

void LammpsSimulation::see_grains(const GrainSink& visit) const {
  const Lammps::Rows rows = lammps_.rows();
  for (int row = 0; row < lammps_.with_ghosts(); ++row) visit(vec(rows.position[row]), rows.radius[row]);
}

Region LammpsSimulation::part() const {
  const Lammps::Part part = lammps_.part();
  return {part.lower, part.upper};
}

void LammpsSimulation::see_contacts(const std::function<void(std::size_t row)>& visit) const {
  const Lammps::Neighbours pairs = lammps_.neighbours();
  const int rows = lammps_.count();
  const Lammps::Rows now = lammps_.rows();
  std::span<const int> others;
  for (int k = 0; k < pairs.size(); ++k) {
    const int i = pairs.of(k, others);
    for (const int marked : others) {
      const int j = marked & Lammps::Neighbours::mask;
      const double sum = now.radius[i] + now.radius[j];
      if (squared(vec(now.position[i]) - vec(now.position[j])) >= sum * sum) continue;
      visit(static_cast<std::size_t>(i));
      if (j < rows) visit(static_cast<std::size_t>(j));
    }
  }
}

void LammpsSimulation::watch() { lammps_.command("fix before all store/state 0 x y z vx vy vz"); }

UnrestSums LammpsSimulation::end_watch(double time) {
  UnrestSums sums;
  const Lammps::Rows rows = lammps_.rows();
  double** before = lammps_.kept_by("before");
  const double g = length(state_.gravity);
  for (int row = 0; row < lammps_.count(); ++row)
    sums.add(rows.mass[row], rows.radius[row], vec(rows.position[row]) - vec(before[row]),
             vec(rows.velocity[row]) - vec(before[row] + 3), g, time);
  lammps_.command("unfix before");
  sums.forces = pressing_, sums.contacts = contacts_made_;
  std::array<double*, 7> all{&sums.kinetic, &sums.net,    &sums.weight,  &sums.diameters,
                             &sums.grains,  &sums.forces, &sums.contacts};
  std::array<double, 7> numbers{};
  for (std::size_t k = 0; k < all.size(); ++k) numbers[k] = *all[k];
  sum_up(world_, numbers);
  for (std::size_t k = 0; k < all.size(); ++k) *all[k] = numbers[k];
  return sums;
}

LammpsSimulation::PairMeans LammpsSimulation::pair_means() const {
  const Lammps::Neighbours pairs = lammps_.neighbours();
  const int rows = lammps_.count();
  const Lammps::Rows now = lammps_.rows();
  std::array<double, 2> sums{};  // contacts, overlaps
  std::span<const int> others;
  for (int k = 0; k < pairs.size(); ++k) {
    const int i = pairs.of(k, others);
    for (const int marked : others) {
      const int j = marked & Lammps::Neighbours::mask;
      const double overlap = now.radius[i] + now.radius[j] - length(vec(now.position[i]) - vec(now.position[j]));
      const double share = j < rows ? 1 : 0.5;  // two processes have it
      if (overlap > 0) sums[0] += share, sums[1] += share * overlap;
    }
  }
  sum_up(world_, sums);
  return {sums[0], sums[0] > 0 ? sums[1] / sums[0] : 0};
}

double LammpsSimulation::memory_a_grain() const {
  double bytes = 1e6 * lammps_.memory() + 2.0 * static_cast<double>(pairs_.contacts().capacity() * sizeof(PairContact));
  sum_up(world_, {&bytes, 1});
  return bytes / grain_count();
}

void join_largest(const LammpsSimulation& simulation, std::span<double> numbers) {
  MPI_Allreduce(MPI_IN_PLACE, numbers.data(), static_cast<int>(numbers.size()), MPI_DOUBLE, MPI_MAX,
                simulation.world());
}

void join_sums(const LammpsSimulation& simulation, std::span<double> numbers) { sum_up(simulation.world(), numbers); }

void add_to_flow(const LammpsSimulation& simulation, const Vec3& axle, FlowMeter& flow) {
  FlowMeter now = flow.empty_one();
  now.add(simulation.own_grains(), axle);
  now.join([&](std::vector<double>& sums) { join_sums(simulation, sums); });
  flow += now;
}

}  // namespace soilbin::dem
