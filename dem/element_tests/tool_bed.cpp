#include "dem/element_tests/tool_bed.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "scenario/errors.hpp"

namespace soilbin::dem {

using std::numbers::pi;

void check_bed(const TestBed& bed) {
  if (!(bed.width > 1.2 && bed.depth > 0.2))
    throw InputError(
        fmt::format("a bed {:.3g} wide and {:.3g} deep, in diameters of the tool, is too small: above 1.2 and 0.2\n"
                    "  hint: a larger --size",
                    bed.width, bed.depth));
}

std::shared_ptr<const SettledBed> bed_for_tool(const GranularSoil& soil, const TestBed& bed, double tool,
                                               const WorkOptions& how, BedStore* beds) {
  check_bed(bed);
  const double side = bed.width * tool;
  return specimen_bed(specimen_recipe(soil, {side, side, bed.depth * tool}, bed.specimen), how, beds);
}

Simulation simulation_on(const SettledBed& bed, const WorkOptions& how, double share_of_friction) {
  Setup setup = bed.setup;
  add_wall_material(setup, bed.recipe.soil, share_of_friction);
  setup.numerics.skin = 0.2 * bed.recipe.soil.radius_max;
  setup.numerics.threads = how.threads;
  setup.numerics.deepest_overlap = 0.5;  // chains of grains under an edge are pressed hard
  return Simulation(std::move(setup), bed.state);
}

double surface_of(const SettledBed& bed) {
  const double r = mean_diameter(bed.recipe.soil) / 2, side = bed.recipe.size.length;
  return surface_height(bed.state.grains, {2 * r, side - 2 * r, 2 * r, side - 2 * r}, r / 4).mean();
}

double highest_within(const SettledBed& bed, double radius) {
  const double middle = bed.recipe.size.length / 2;
  double top = 0;
  for (std::size_t k = 0; k < bed.state.grains.count(); ++k) {
    const Motion& grain = bed.state.grains.motion[k];
    if (std::hypot(grain.position.x - middle, grain.position.y - middle) < radius + grain.radius)
      top = std::max(top, grain.position.z + grain.radius);
  }
  return top;
}

PlateRun press(const SettledBed& bed, Simulation simulation, const Pressing& pressing, SteppedWork& work) {
  const double area = pi * pressing.diameter * pressing.diameter / 4;
  PlateRun run;
  run.diameter = pressing.diameter, run.speed = pressing.speed;
  run.packing = bed.recipe.packing, run.grains = number_of_grains(bed.state);
  run.void_ratio = bed.report.void_ratio, run.density = bed.report.bulk_density;
  Body tool = pressing.tool;
  tool.velocity = {0, 0, -pressing.speed};
  const int index = simulation.add_body(tool);
  const auto steps = steps_of_sample(pressing.way, pressing.speed * simulation.setup().numerics.dt, pressing.samples);
  work.begin("pressing");
  for (int k = 0; k < pressing.samples; ++k) {
    PlateSample sample;
    for (std::int64_t i = 0; i < steps; ++i) {
      work.step(simulation);
      const Body& at = simulation.body(index);
      sample.pressure += at.force.z / (area * static_cast<double>(steps));
      sample.sinkage += (pressing.surface - (at.position.z + pressing.base)) / static_cast<double>(steps);
    }
    run.curve.push_back(sample);
  }
  return run;
}

}  // namespace soilbin::dem
