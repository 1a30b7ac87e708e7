#include <algorithm>
#include <cmath>
#include <vector>

#include "compare/bevameter/measured_plates.hpp"
#include "compare/bevameter/measured_shear.hpp"
#include "compare/bevameter/plate_groups.hpp"
#include "compare/doubts/doubts.hpp"
#include "compare/measured/outliers.hpp"
#include "scenario/beds.hpp"
#include "scenario/source_text.hpp"

namespace soilbin::compare {

namespace {

bool any_stress_twice(std::span<const MeasuredShear> tests) {
  std::vector<double> stresses;
  for (const MeasuredShear& test : tests) stresses.push_back(test.curve.normal_stress);
  std::ranges::sort(stresses);
  return std::ranges::adjacent_find(stresses, [](double a, double b) { return b < 1.05 * a; }) != stresses.end();
}

}  // namespace

Doubts doubts(const MeasuredPlatesFit& fit) {
  Doubts all;
  for (const PlateTestApart& one : fit.apart) all.push_back({DoubtKind::plate_test_apart, {in_words(one)}});
  constexpr double far = 4.0;  // of b: twice a round plate's diameter
  if (fit.deepest > far * fit.deepest_radius)
    all.push_back({DoubtKind::sunk_beyond_plate, {1000 * fit.deepest_radius, 1000 * fit.deepest}});
  std::size_t spikes = 0;
  for (const PlateReadingsAside& one : fit.aside) {
    if (one.readings.why == AsideWhy::stuck)
      all.push_back({DoubtKind::sensor_stuck,
                     {clipped(one.test), 1000 * one.radius, 1000 * one.readings.sinkage, one.readings.pressure / 1000,
                      one.readings.readings.size()}});
    else if (one.readings.why != AsideWhy::unloading)
      spikes += one.readings.readings.size();
  }
  if (static_cast<double>(spikes) > thresholds::max_outlier_share * static_cast<double>(fit.readings + spikes))
    all.push_back({DoubtKind::many_spikes, {spikes, fit.readings + spikes}});
  if (fit.one_size())
    all.push_back({DoubtKind::one_plate_size, {1000 * fit.radii.front()}});
  else
    for (const auto& [name, value] : {std::pair{"k_phi", &fit.k_phi}, {"k_c", &fit.k_c}})
      if (value->estimate.value < 0.0 && -value->estimate.value > value->estimate.std_error)
        all.push_back({DoubtKind::negative_modulus, {name, 2000 * fit.radii.front(), 2000 * fit.radii.back()}});
  if (const double n = fit.exponent.estimate.value; n < 0.1 || n > 1.8)
    all.push_back({DoubtKind::unusual_plate_exponent, {n}});
  if (fit.test_scatter > 0.35) all.push_back({DoubtKind::scattered_plate_tests, {100 * std::expm1(fit.test_scatter)}});
  if (std::ranges::all_of(fit.tests, [](int count) { return count < 2; }))
    all.push_back({DoubtKind::no_repeated_plates});
  if (!fit.halves_compared) all.push_back({DoubtKind::halves_not_compared});
  if (const double bend = fit.high_exponent - fit.low_exponent;
      fit.halves_compared && std::abs(bend) > std::max(0.4, 2 * fit.exponent.between_tests))
    all.push_back(
        {bend > 0 ? DoubtKind::curve_stiffens : DoubtKind::curve_flattens, {fit.low_exponent, fit.high_exponent}});
  if (fit.pressure_error > 0.25) all.push_back({DoubtKind::form_misses, {100 * fit.pressure_error}});
  return all;
}

Doubts doubts(const PlateGroups& groups) {
  Doubts all;
  for (const PlateGroup& group : groups.all)
    for (Doubt& doubt : doubts(group.fit)) {
      const bool of_readings = doubt.kind == DoubtKind::plate_test_apart ||
                               doubt.kind == DoubtKind::sunk_beyond_plate || doubt.kind == DoubtKind::sensor_stuck ||
                               doubt.kind == DoubtKind::many_spikes;
      if (of_readings || (doubt.kind == DoubtKind::one_plate_size && !tell_of(all, doubt.kind)))
        all.push_back(std::move(doubt));
    }
  if (groups.at)
    if (const DensityRange range = tested(groups.beds); !range.holds(*groups.at->density))
      all.push_back({DoubtKind::beyond_densities_of_plates, {*groups.at->density, range.lowest, range.highest}});
  return all;
}

Doubts doubts(const MeasuredShearFit& fit, std::span<const MeasuredShear> tests) {
  Doubts all;
  if (fit.one_stress) all.push_back({DoubtKind::one_normal_stress, {tests.front().curve.normal_stress / 1e3}});
  std::size_t humps = 0;
  for (const ShearTestFit& one : fit.tests) humps += one.residual ? 1 : 0;
  if (humps > 0) all.push_back({DoubtKind::shear_falls_again, {humps, tests.size()}});
  if (fit.tests.size() < 3 && !fit.one_stress) all.push_back({DoubtKind::few_shear_tests, {fit.tests.size()}});
  if (fit.tests.size() >= 3 && !any_stress_twice(tests))
    all.push_back({DoubtKind::no_repeated_shear_tests, {fit.tests.size()}});
  constexpr double steady = 0.02;
  const auto share = [](const MeasuredShear& test) { return test.normal_stress_spread / test.curve.normal_stress; };
  const auto varying = std::ranges::count_if(tests, [&](const MeasuredShear& test) { return share(test) > steady; });
  if (const auto most = std::ranges::max_element(tests, {}, share); varying > 0)
    all.push_back(
        {DoubtKind::varying_normal_stress, {static_cast<std::size_t>(varying), 100 * share(*most), most->test}});
  return all;
}

}  // namespace soilbin::compare
