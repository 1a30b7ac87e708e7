#include "dem/engine/time_step.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace soilbin::dem {

double rayleigh_time(const Materials& materials, const Grains& grains) {
  double shortest = std::numeric_limits<double>::infinity();
  for (std::size_t k = 0; k < grains.count(); ++k) {
    const Material& m = materials.all[grains.material[k]];
    const double shear = m.young / (2 * (1 + m.poisson));
    shortest = std::min(shortest, std::numbers::pi * grains.motion[k].radius * std::sqrt(m.density / shear) /
                                      (0.1631 * m.poisson + 0.8766));
  }
  return shortest;
}

}  // namespace soilbin::dem
