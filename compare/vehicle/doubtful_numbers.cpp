#include "compare/vehicle/doubtful_numbers.hpp"

#include <algorithm>
#include <string>

#include "bekker_wong/presumption.hpp"
#include "scenario/soil_parameters.hpp"

namespace soilbin::compare {

std::vector<DoubtfulNumber> doubtful_numbers(const std::vector<VehicleWheel>& wheels) {
  std::vector<DoubtfulNumber> all;
  const SemiEmpiricalSoil& soil = *wheels.front().scenario.soil.semi_empirical;
  for (const SoilParameter& p : soil_parameters)
    if (const Estimate& value = soil.*p.value; value.std_error > 0.0)
      all.push_back({value.value, value.std_error, p.range,
                     [&p, n = soil.exponent.value](Scenario& scenario, double x) {
                       move_value(*scenario.soil.semi_empirical, p, x, n);
                     },
                     p.title});
  std::vector<std::string> tires;
  for (const VehicleWheel& wheel : wheels) {
    const Tire& tire = wheel.scenario.tire;
    if (std::ranges::find(tires, tire.name) != tires.end()) continue;
    tires.push_back(tire.name);
    if (bekker_wong::errs_by_carcass(tire, wheel.scenario.effects))
      all.push_back({tire.carcass_pressure->value, tire.carcass_pressure->std_error, zero_or_more,
                     [name = tire.name](Scenario& scenario, double x) {
                       if (scenario.tire.name == name) scenario.tire.carcass_pressure->value = x;
                     },
                     "carcass pressure of " + tire.name});
  }
  return all;
}

}  // namespace soilbin::compare
