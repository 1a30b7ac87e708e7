#include "cone_index/model.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "scenario/deflection_table.hpp"
#include "scenario/errors.hpp"
#include "scenario/number_check.hpp"
#include "scenario/tractive_efficiency.hpp"

namespace soilbin::cone_index {
namespace {

/// By how much a tire flattens until its contact carries the load at the pressure [m]. A torus of the tire's diameter d
/// and width b meets the plane in an ellipse of the semi-axes sqrt(d delta) and sqrt(b delta), so W = pi p sqrt(d b)
/// delta (stated). Infinite without a pressure.
double flattening(const TireMeasures& tire, double load, double pressure) {
  return load / (std::numbers::pi * pressure * std::sqrt(tire.diameter * tire.width));
}

void refuse_what_it_cannot_know(const OperatingCondition& at) {
  if (at.yaw != 0.0 || at.transverse_incline != 0.0)
    throw InputError("cone_index knows neither yaw nor cross slopes: no cone tells a side force");
  if (at.slip < 0.0) throw InputError("cone_index knows driven wheels alone: a slip of 0 or more");
}

}  // namespace

TireTaken tire_taken(const Tire& tire, double load) {
  TireTaken taken;
  TireMeasures& m = taken.measures;
  m.diameter = 2.0 * outer_radius(tire);
  m.width = tire.width;
  taken.section_height_assumed = !tire.section_height;
  m.section_height = tire.section_height.value_or(std::min(0.85 * tire.width, 0.25 * m.diameter));
  if (!tire.inflation_pressure) {
    m.deflection = usual_deflection * m.section_height;
  } else if (tire.deflection) {
    taken.deflection = DeflectionFrom::table;
    m.deflection = deflection_of(*tire.deflection, load, *tire.inflation_pressure);
  } else {
    taken.deflection = DeflectionFrom::pressure;
    m.deflection = flattening(m, load, *declared_ground_pressure(tire));
  }
  if (!(m.deflection < m.section_height))
    throw InputError(
        fmt::format("cone_index: under {:.4g} kN the tire deflects by {:.4g} mm, as much as its section "
                    "height of {:.4g} mm\n  hint: raise the inflation pressure or lower the load",
                    load / 1e3, 1e3 * m.deflection, 1e3 * m.section_height));
  return taken;
}

MobilityNumber mobility_number(const Soil& soil, const TireMeasures& tire, double load) {
  if (!soil.cone_index && !soil.cone_index_gradient)
    throw InputError("soil '" + soil.name +
                     "' has no 'cone_index' and, as a sand, no 'cone_index_gradient', one of which the model "
                     "cone_index needs");
  const bool sand = !soil.cone_index;
  const Estimate& value = sand ? *soil.cone_index_gradient : *soil.cone_index;
  const double number = sand ? turnage_number(value.value, tire, load) : brixius_number(value.value, tire, load);
  return {number, number * value.std_error / value.value, sand};
}

TractionResult ConeIndex::evaluate(const Scenario& scenario, const OperatingCondition& at) const {
  check_numbers(at);
  refuse_what_it_cannot_know(at);
  const Tire tire = tire_at(scenario.tire, at);
  const double pressing = at.load * std::cos(at.longitudinal_incline);
  const MobilityNumber number = mobility_number(scenario.soil, tire_taken(tire, pressing).measures, pressing);
  const Ratios ratios =
      number.sand ? turnage(number.value, at.slip) : brixius(number.value, at.slip, tire.construction);
  if (!(ratios.resistance < 1.0))
    throw NoSolution(
        fmt::format("the mobility number is {:.3g}: by the relation the wheel would resist its motion "
                    "with more than the load",
                    number.value));

  TractionResult result;
  result.at = at;
  const double gross = pressing * ratios.gross, resistance = pressing * ratios.resistance,
               slope = at.load * std::sin(at.longitudinal_incline), radius = tire.radius;
  result.drawbar_pull = {gross - resistance - slope, pressing * std::abs(ratios.net_slope()) * number.std_error};
  result.torque = {gross * radius, pressing * radius * std::abs(ratios.gross_slope) * number.std_error};
  result.sinkage = {not_a_number, not_a_number};
  result.entry_angle = result.max_stress_angle = result.exit_angle = not_a_number;
  result.tractive_efficiency = tractive_efficiency(result, radius);
  result.budget = {{"gross_traction", gross}, {"motion_resistance", -resistance}};
  if (slope != 0.0) result.budget.push_back({"slope", -slope});
  result.budget_rest = {0.0, 1e-12 * at.load};
  return result;
}

}  // namespace soilbin::cone_index
