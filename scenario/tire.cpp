#include "scenario/tire.hpp"

#include <fmt/core.h>

#include <cmath>
#include <numbers>

namespace soilbin {

Tire tire_at(Tire tire, const OperatingCondition& at) {
  if (at.inflation_pressure) tire.inflation_pressure = at.inflation_pressure;
  return tire;
}

std::optional<double> declared_ground_pressure(const Tire& tire) {
  if (!tire.inflation_pressure) return std::nullopt;
  return *tire.inflation_pressure + (tire.carcass_pressure ? tire.carcass_pressure->value : 0.0);
}

std::string why_no_gaps(const Tire& tire) {
  if (!is_lugged(tire) || !tire.lugs.count || !tire.lugs.thickness) return "";
  constexpr double pi = std::numbers::pi;
  const int count = *tire.lugs.count * (tire.lugs.pattern == LugPattern::staggered ? 2 : 1);
  const double thickness = *tire.lugs.thickness, share = thickness / 2 / tire.radius;
  if (share < 1 && std::asin(share) < 0.999 * pi / count) return "";
  return fmt::format(
      "{} lugs of {:.4g} mm leave no gap round a radius of {:.4g} mm: from one lug to the next are {:.4g} mm", count,
      1000 * thickness, 1000 * tire.radius, 2000 * pi * tire.radius / count);
}

std::string in_words(const Tire& tire) { return in_words(tire, ""); }

std::string in_words(const Tire& tire, std::string_view remark) {
  std::string words = fmt::format("{} (r {:.4g} mm, b {:.4g} mm, ", tire.name.empty() ? "a wheel" : tire.name,
                                  1000 * tire.radius, 1000 * tire.width);
  if (!is_lugged(tire))
    words += "smooth";
  else if (tire.lugs.count)
    words += fmt::format("{} lugs of {:.4g} mm", *tire.lugs.count, 1000 * tire.lugs.height);
  else
    words += fmt::format("lugs of {:.4g} mm", 1000 * tire.lugs.height);
  if (tire.inflation_pressure) words += fmt::format(", {:.4g} kPa", *tire.inflation_pressure / 1000);
  if (tire.deflection) words += fmt::format(", load-deflection table of {} rows", tire.deflection->rows.size());
  return words.append(remark) + ")";
}

}  // namespace soilbin
