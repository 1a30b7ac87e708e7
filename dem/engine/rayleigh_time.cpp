#include "dem/engine/rayleigh_time.hpp"

#include <algorithm>
#include <limits>

namespace soilbin::dem {

double rayleigh_time(const Materials& materials, const Grains& grains) {
  double shortest = std::numeric_limits<double>::infinity();
  for (std::size_t k = 0; k < grains.count(); ++k) {
    shortest = std::min(shortest, rayleigh_time(materials.all[grains.material[k]], grains.motion[k].radius));
  }
  return shortest;
}

}  // namespace soilbin::dem
