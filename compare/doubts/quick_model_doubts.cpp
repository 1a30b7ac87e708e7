#include <cmath>
#include <optional>
#include <set>
#include <tuple>
#include <utility>

#include "compare/doubts/doubts.hpp"
#include "cone_index/model.hpp"
#include "cone_index/vehicle.hpp"
#include "resistive_force/model.hpp"
#include "scenario/errors.hpp"

namespace soilbin::compare {

Doubts resistive_force_doubts(const Soil& soil) {
  Doubts all;
  if (!soil.resistive_force && !soil.semi_empirical) return all;
  const ResistiveForceSoil values = resistive_force::resistive_force_of(soil);
  const auto& [xi_n, friction] = std::tie(values.xi_n, values.surface_friction);
  if (!soil.resistive_force)
    all.push_back({DoubtKind::rft_values_estimated,
                   {xi_n.value / 1e6, xi_n.std_error / 1e6, friction.value, friction.std_error}});
  constexpr double little_cohesion = 1000.0;  // [Pa]; a dry sand's
  if (soil.semi_empirical && soil.semi_empirical->cohesion.value > little_cohesion)
    all.push_back({DoubtKind::rft_without_cohesion, {soil.semi_empirical->cohesion.value / 1000}});
  return all;
}

namespace {

/// A tire, load and soil beside those of the tests behind the relation. Brixius: as commonly quoted after his paper.
/// Turnage: below 5 the pull at 20 % slip is negative, and tests of the Waterways Experiment Station reach to some 100.
Doubts outside_cone_tests(const cone_index::TireMeasures& tire, const cone_index::MobilityNumber& number,
                          const OperatingCondition& at) {
  struct Tested {
    const char* what;
    double value, low, high;
  };
  const double share = tire.deflection / tire.section_height;
  std::vector<Tested> all = {{"Turnage's mobility number", number.value, 5, 100}};
  if (!number.sand)
    all = {{"width over diameter", tire.width / tire.diameter, 0.1, 0.7},
           {"deflection over section height", share, 0.1, 0.3},
           {"load over width and diameter [kPa]", at.load / (tire.width * tire.diameter) / 1000, 15, 55}};
  Doubts outside;
  for (const auto& [what, value, low, high] : all)
    if (value < low || value > high)
      outside.push_back({DoubtKind::outside_cone_index_tests, {what, value, low, high}, at});
  return outside;
}

}  // namespace

Doubts cone_index_doubts(const Scenario& scenario, const std::vector<OperatingCondition>& conditions) {
  using cone_index::DeflectionFrom;
  Doubts all;
  std::set<std::tuple<double, double, std::optional<double>>> seen;  // what a tire and its contact depend on
  const auto add_once = [&](Doubt doubt) {
    if (!tell_of(all, doubt.kind)) all.push_back(std::move(doubt));
  };
  for (const OperatingCondition& at : conditions) {
    if (!seen.emplace(at.load, at.longitudinal_incline, at.inflation_pressure).second) continue;
    const double pressing = at.load * std::cos(at.longitudinal_incline);
    cone_index::TireTaken taken;
    cone_index::MobilityNumber number;
    try {
      taken = cone_index::tire_taken(tire_at(scenario.tire, at), pressing);
      number = cone_index::mobility_number(scenario.soil, taken.measures, pressing);
    } catch (const InputError&) {
      continue;  // its answer says why
    }
    const auto& [diameter, width, height, deflection] = taken.measures;
    if (taken.section_height_assumed)
      add_once({DoubtKind::section_height_assumed, {1000 * height, 100 * height / width}});
    if (!number.sand && !scenario.tire.construction) add_once({DoubtKind::construction_unknown});
    if (taken.deflection == DeflectionFrom::pressure)
      all.push_back({DoubtKind::firm_deflection_by_pressure, {1000 * deflection, 100 * deflection / height}, at});
    if (taken.deflection == DeflectionFrom::assumed)
      add_once({DoubtKind::firm_deflection_assumed, {100 * deflection / height}});
    append(all, outside_cone_tests(taken.measures, number, at));
  }
  if (!conditions.empty()) all.push_back({DoubtKind::cone_index_tells_no_sinkage});
  return once_each(all);
}

Doubts doubts(const cone_index::Mobility& mobility) {
  Doubts all;
  const cone_index::Vehicle& vehicle = mobility.vehicle;
  if (const int driven = vehicle.driven_axles.value_or(vehicle.axles); driven < vehicle.axles)
    all.push_back({DoubtKind::some_axles_driven, {driven, vehicle.axles}});
  if (mobility.rating_is_cone_index) all.push_back({DoubtKind::cone_index_as_rating});
  if (mobility.passages)
    for (const cone_index::Passage& one : *mobility.passages)
      if (one.is_close())
        all.push_back({DoubtKind::close_to_vehicle_cone_index,
                       {one.passes, one.excess.value / 1000, one.excess.std_error / 1000}});
  if (!mobility.pressure)
    all.push_back({DoubtKind::no_mean_maximum_pressure,
                   {vehicle.deflection && vehicle.section_height
                        ? "a factor K (mmp_factor): none is known for so many axles and driven axles"
                        : "the tires' deflection and section height"}});
  return all;
}

}  // namespace soilbin::compare
