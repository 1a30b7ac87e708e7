#include "scenario/tire.hpp"

#include <fmt/core.h>

namespace soilbin {

std::string in_words(const Tire& tire) {
  std::string words = fmt::format("{} (r {:.4g} mm, b {:.4g} mm, ", tire.name.empty() ? "a wheel" : tire.name,
                                  1000 * tire.radius, 1000 * tire.width);
  if (!is_lugged(tire))
    words += "smooth";
  else if (tire.lugs.count)
    words += fmt::format("{} lugs of {:.4g} mm", *tire.lugs.count, 1000 * tire.lugs.height);
  else
    words += fmt::format("lugs of {:.4g} mm", 1000 * tire.lugs.height);
  if (tire.inflation_pressure) words += fmt::format(", {:.4g} kPa", *tire.inflation_pressure / 1000);
  return words + ")";
}

}  // namespace soilbin
