#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "scenario/description.hpp"
#include "scenario/grain_sizes.hpp"

namespace soilbin {
namespace {

double sum_of_shares(const GranularSoil& soil) {
  double sum = 0;
  for (const GrainFraction& fraction : soil.sizes) sum += fraction.share;
  return sum;
}

}  // namespace

double mean_diameter(const GranularSoil& soil) {
  if (soil.sizes.empty()) return soil.radius_min + soil.radius_max;
  double sum = 0;
  for (const GrainFraction& fraction : soil.sizes) sum += fraction.share * fraction.radius;
  return 2 * sum / sum_of_shares(soil);
}

void set_sizes(GranularSoil& soil, std::vector<GrainFraction> sizes) {
  soil.sizes = std::move(sizes);
  fill_in(soil, [](const char*) { return false; });
}

void scale_sizes(GranularSoil& soil, double factor) {
  soil.radius_min *= factor, soil.radius_max *= factor;
  for (GrainFraction& fraction : soil.sizes) fraction.radius *= factor;
}

double mean_cube(const GranularSoil& soil) {
  const double a = soil.radius_min, b = soil.radius_max;
  if (soil.sizes.empty()) return (a + b) * (a * a + b * b) / 4;  // of a uniform radius
  double grains = 0;  // in those that have all of the mass at the largest radius
  for (const GrainFraction& fraction : soil.sizes) grains += fraction.share * std::pow(b / fraction.radius, 3);
  return b * b * b * sum_of_shares(soil) / grains;
}

std::string wrong_in_sizes(const GranularSoil& soil) {
  if (soil.sizes.empty()) {
    if (soil.radius_min == 0 || soil.radius_max == 0)
      return fmt::format(
          "key '{}' is missing\n"
          "  hint: radius_min and radius_max, or in their place sizes: [{{radius: 1 mm, share: 40 %}}, ...]",
          soil.radius_min == 0 ? "radius_min" : "radius_max");
    return soil.radius_max < soil.radius_min ? "radius_max is smaller than radius_min" : "";
  }
  for (std::size_t k = 1; k < soil.sizes.size(); ++k)
    if (!(soil.sizes[k].radius > soil.sizes[k - 1].radius))
      return fmt::format("the radii of 'sizes' must rise, and {:.6g} mm follows {:.6g} mm", 1e3 * soil.sizes[k].radius,
                         1e3 * soil.sizes[k - 1].radius);
  constexpr double rounded = 0.005;  // of shares in whole per cent
  if (const double sum = sum_of_shares(soil); !(std::abs(sum - 1) <= rounded))
    return fmt::format(
        "the shares of 'sizes' add up to {:.4g} %, not to 100 %\n"
        "  hint: each is the mass that its sieve retains, as a share of the whole; not what passes it",
        100 * sum);
  if (soil.radius_min != soil.sizes.front().radius || soil.radius_max != soil.sizes.back().radius)
    return "radius_min and radius_max are not the smallest and the largest of 'sizes'\n"
           "  hint: leave them out: they follow from it";
  return "";
}

void fill_in(GranularSoil& soil, const std::function<bool(const char*)>& given) {
  if (soil.sizes.empty()) return;
  const auto [least, most] = std::ranges::minmax(soil.sizes, {}, &GrainFraction::radius);
  if (!given("radius_min")) soil.radius_min = least.radius;
  if (!given("radius_max")) soil.radius_max = most.radius;
}

std::string wrong_in_cohesion(const GranularSoil& soil) {
  const std::pair<const char*, const ContactPair*> contacts[] = {{"grain_grain", &soil.grain_grain},
                                                                 {"grain_tire", &soil.grain_tire}};
  const bool jkr = soil.cohesion_law == GrainCohesion::jkr;
  for (const auto& [name, contact] : contacts) {
    if (jkr && contact->cohesion > 0)
      return fmt::format(
          "the cohesion of {} is an energy density, and cohesion_law jkr has a work of adhesion\n"
          "  hint: work_of_adhesion in J/m^2 in its place, or cohesion_law: linear",
          name);
    if (!jkr && contact->work_of_adhesion > 0)
      return fmt::format(
          "the work_of_adhesion of {} is read by cohesion_law jkr, and linear cohesion has an energy density\n"
          "  hint: cohesion_law: jkr, or 'cohesion' in kJ/m^3 in its place",
          name);
  }
  if (jkr && soil.grain_grain.work_of_adhesion == 0 && soil.grain_tire.work_of_adhesion == 0)
    return "cohesion_law jkr needs the work_of_adhesion of a contact, and none has one\n"
           "  hint: work_of_adhesion: 0.1 J/m^2 in grain_grain, or leave cohesion_law out";
  return "";
}

}  // namespace soilbin
