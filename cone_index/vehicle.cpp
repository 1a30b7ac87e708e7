#include "cone_index/vehicle.hpp"

#include <fmt/format.h>

#include <cmath>

#include "scenario/errors.hpp"
#include "scenario/mapping_reader.hpp"
#include "scenario/number_check.hpp"

namespace soilbin::cone_index {
namespace {

constexpr double inch = 0.0254, pound = 4.4482216152605, horsepower = 745.6998715822702, psi = 6894.757293168361;

/// WF of a load an axle [kip].
double weight_factor(double kip) {
  if (kip < 2.0) return 0.553 * kip;
  if (kip < 13.5) return 0.033 * kip + 1.05;
  if (kip < 20.0) return 0.142 * kip - 0.42;
  return 0.278 * kip - 3.115;
}

MobilityFactors factors_of(const Vehicle& v) {
  const double pounds = v.weight / pound, width = v.tire_width / inch, radius = v.tire_diameter / 2 / inch;
  const double tons = pounds / 2000;
  return {.contact_pressure = pounds / (width * radius * v.tires),
          .weight = weight_factor(pounds / 1000 / v.axles),
          .tire = (10.0 + width) / 100.0,
          .grouser = v.chains == YesNo::yes ? 1.05 : 1.0,
          .wheel_load = pounds / 1000 / (2.0 * v.axles),
          .clearance = v.clearance / inch / 10.0,
          .engine = v.power / horsepower / tons >= 10.0 ? 1.0 : 1.05,
          .transmission = v.transmission == Transmission::manual ? 1.05 : 1.0};
}

}  // namespace

std::string contradiction(const Vehicle& vehicle) {
  if (vehicle.driven_axles.value_or(1) > vehicle.axles) return "more axles are driven than there are";
  if (vehicle.tires < vehicle.axles) return "fewer tires than axles";
  if (vehicle.deflection && vehicle.section_height && !(*vehicle.deflection < *vehicle.section_height))
    return "the deflection is as large as the section height";
  if (vehicle.section_height && !(2 * *vehicle.section_height < vehicle.tire_diameter))
    return "the section height is half of the tire's diameter, or more";
  return "";
}

Vehicle parse_vehicle(const SourceText& source) {
  const YamlNode document = parse_yaml(source);
  const Reading reading{&source, std::nullopt, nullptr, ""};
  expect_format(document, vehicle_format, reading);
  return read_mapping<Vehicle>(document, reading, {"format"});
}

VehicleConeIndex vehicle_cone_index(const Vehicle& vehicle) {
  check_numbers(vehicle);
  VehicleConeIndex index{.factors = factors_of(vehicle)};
  const MobilityFactors& f = index.factors;
  const double mi = index.mobility_index =
      (f.contact_pressure * f.weight / (f.tire * f.grouser) + f.wheel_load - f.clearance) * f.engine * f.transmission;
  if (!(mi > 0.0))
    throw InputError(fmt::format("the mobility index is {:.3g}: what relates it to a cone index holds above 0", mi));
  if (vehicle.deflection && vehicle.section_height)
    index.deflection_factor = std::pow(0.15 * *vehicle.section_height / *vehicle.deflection, 0.25);
  index.one_pass =
      psi * index.deflection_factor * (mi <= 115.0 ? 11.48 + 0.2 * mi - 39.2 / (mi + 3.74) : 4.1 * std::pow(mi, 0.446));
  index.fifty_passes = psi * (28.23 + 0.43 * mi - 92.67 / (mi + 3.67));
  return index;
}

std::optional<double> rowlands_factor(int axles, int driven) {
  struct Row {
    int axles, driven;
    double factor;
  };
  constexpr Row rows[] = {{2, 2, 3.65}, {2, 1, 4.40}, {3, 3, 3.90}, {3, 2, 4.35}, {3, 1, 5.25},
                          {4, 4, 4.10}, {4, 3, 4.44}, {4, 2, 4.95}, {4, 1, 6.05}};
  for (const Row& row : rows)
    if (row.axles == axles && row.driven == driven) return row.factor;
  return std::nullopt;
}

std::optional<MeanMaximumPressure> mean_maximum_pressure(const Vehicle& v) {
  if (!v.deflection) return std::nullopt;
  std::optional<double> factor = v.mmp_factor;
  if (!factor && v.section_height)
    if (const auto rowland = rowlands_factor(v.axles, v.driven_axles.value_or(v.axles)))
      factor = *rowland * std::sqrt(*v.section_height / v.tire_diameter);
  if (!factor) return std::nullopt;
  const double area = v.tires * std::pow(v.tire_width, 0.85) * std::pow(v.tire_diameter, 1.15) *
                      std::sqrt(*v.deflection / v.tire_diameter);
  return MeanMaximumPressure{*factor * v.weight / area, *factor, v.mmp_factor.has_value()};
}

Mobility mobility_of(const Vehicle& vehicle, const std::optional<Estimate>& rating) {
  Mobility mobility{vehicle, vehicle_cone_index(vehicle), mean_maximum_pressure(vehicle)};
  mobility.rating = rating;
  if (!rating) return mobility;
  const auto passage = [&](int passes, double needed) {
    const double excess = rating->value - needed;
    return Passage{passes, needed, {excess, rating->std_error}, excess >= 0.0};
  };
  mobility.passages = {passage(1, mobility.index.one_pass), passage(50, mobility.index.fifty_passes)};
  return mobility;
}

}  // namespace soilbin::cone_index
