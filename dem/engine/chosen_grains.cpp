// What is done to grains that a rule chooses: they are taken away, or held where they are.
#include <algorithm>

#include "dem/engine/simulation.hpp"

namespace soilbin::dem {

std::size_t Simulation::remove_grains(const std::function<bool(const GrainNow&)>& gone) {
  settle_changes();
  std::vector<std::uint8_t> marked;
  for (const GrainNow& grain : grains()) marked.push_back(gone(grain));
  const auto count = static_cast<std::size_t>(std::count(marked.begin(), marked.end(), 1));
  if (count == 0) return 0;
  wake_all();
  accounted([&] { search(marked); });
  return count;
}

std::size_t Simulation::hold_grains(const std::function<bool(const GrainNow&)>& which) {
  settle_changes();
  const std::vector<GrainNow> now = grains();
  std::vector<std::size_t> rows;
  for (std::size_t row = 0; row < now.size(); ++row)
    if (!state_.grains.motion[row].held() && which(now[row])) rows.push_back(row);
  if (rows.empty()) return 0;
  wake_all();
  accounted([&] {
    for (const std::size_t row : rows) {
      state_.grains.motion[row].velocity = state_.grains.spin[row].rate = {};
      state_.grains.motion[row].inverse_mass = state_.grains.spin[row].inverse_inertia = 0;
    }
    search();
  });
  return rows.size();
}

}  // namespace soilbin::dem
