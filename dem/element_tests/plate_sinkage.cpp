#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "dem/element_tests/tool_bed.hpp"
#include "dem/surface/shapes.hpp"

namespace soilbin::dem {
namespace {

using std::numbers::pi;

void check(const PlateSettings& s) {
  const Requirements require("plate sinkage");
  require(!s.diameters.empty(), "at least one plate");
  for (const double diameter : s.diameters)
    require(diameter >= narrowest_tool, fmt::format("a plate of {:.3g} grains is too narrow: at least {:.3g}\n  hint: "
                                                    "make radius_min and radius_max smaller, which keeps the strength",
                                                    diameter, narrowest_tool));
  require(s.sinkage > 0 && s.speed >= 1e-6 && s.speed <= 1, "sinkage above 0, speed in 1e-6 .. 1");
  require(s.samples >= 10, "at least 10 samples");
}

/// Presses a disc into the bed's middle.
PlateRun press_plate(const SettledBed& bed, double diameter, const PlateSettings& settings, const WorkOptions& how,
                     SteppedWork& work) {
  const double d = mean_diameter(bed.recipe.soil), middle = bed.recipe.size.length / 2;
  Body disc;
  disc.name = "plate";
  const double thick = (settings.sinkage + 4) * d;  // no grain gets on top of it
  disc.surfaces.push_back({surface_at(smooth_wheel(diameter / 2, thick, 48), {}), 1});
  disc.rotation = rotation_by({pi / 2, 0, 0});  // axle upright
  const double start = highest_within(bed, diameter / 2), surface = surface_of(bed);
  disc.position = {middle, middle, start + thick / 2};
  return press(bed, simulation_on(bed, how),
               {.tool = std::move(disc),
                .base = -thick / 2,
                .diameter = diameter,
                .surface = surface,
                .way = start - surface + settings.sinkage * d,
                .speed = settings.speed * std::sqrt(bed.recipe.gravity * d),
                .samples = settings.samples},
               work);
}

}  // namespace

std::vector<PlateRun> plate_sinkage(const GranularSoil& soil, const PlateSettings& settings, const WorkOptions& how,
                                    BedStore* beds) {
  check(settings);
  const double d = mean_diameter(soil);
  const double widest = *std::max_element(settings.diameters.begin(), settings.diameters.end()) * d;
  const auto bed = bed_for_tool(soil, settings.bed, widest, how, beds);
  SteppedWork work(how);
  const double speed = settings.speed * std::sqrt(bed->recipe.gravity * d);
  work.expect(static_cast<double>(settings.diameters.size()) * (settings.sinkage + 0.7) * d /
              (speed * bed->setup.numerics.dt));
  std::vector<PlateRun> runs;
  for (const double diameter : settings.diameters) runs.push_back(press_plate(*bed, diameter * d, settings, how, work));
  return runs;
}

}  // namespace soilbin::dem
