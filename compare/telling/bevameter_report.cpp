// What a virtual bevameter found in a soil's grains, as it is told; soilbin-bevameter/1.
#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "compare/bevameter/bevameter.hpp"
#include "compare/experiments/virtual_bevameter.hpp"
#include "compare/report/json_fields.hpp"
#include "compare/report/number_text.hpp"
#include "compare/telling/reports.hpp"
#include "scenario/soil.hpp"
#include "scenario/soil_parameters.hpp"

namespace soilbin::compare {
namespace {

/// Pressure against sinkage of each plate and shear stress against displacement under each normal stress. Plates of one
/// radius, and rings under nearly one stress, share a colour.
Sheet bevameter_sheet(const std::string& title, std::span<const PlateSet> plates, std::span<const ShearCurve> shear,
                      const BevameterFit& fit) {
  constexpr double kilo = 1e-3, milli = 1e3;
  Sheet sheet{title,
              {{"Pressure under plates [kPa]", {"sinkage [mm]", 0.0, {}}, {{}, 0.0, {}}, {}},
               {"Shear stress under rings [kPa]", {"displacement [mm]", 0.0, {}}, {{}, 0.0, {}}, {}}}};
  std::vector<double> seen;  // radii, then stresses: their place is the colour
  const auto color_of_value = [&seen](double value) {
    const auto alike = [&](double other) { return std::abs(value - other) < 0.1 * other; };
    const auto place = std::ranges::find_if(seen, alike);
    const auto color = static_cast<int>(place - seen.begin());
    if (place == seen.end()) seen.push_back(value);
    return color;
  };
  const auto add = [](Plot& plot, const std::string& label, int color, const std::vector<double>& x,
                      const std::vector<double>& y, const auto& fitted) {
    Series points{.label = label, .mark = Mark::points, .color = color};
    for (std::size_t k = 0; k < x.size(); ++k) points.x.push_back(milli * x[k]), points.y.push_back(kilo * y[k]);
    plot.series.push_back(std::move(points));
    plot.series.push_back(over_samples(
        {.label = label, .color = color}, x, [](double at) { return milli * at; },
        [&](double at) { return kilo * fitted(at); }));
  };
  for (const PlateSet& set : plates)
    for (const bekker_wong::PlateCurve& plate : set) {
      const double modulus = fit.soil.k_c.value / plate.radius + fit.soil.k_phi.value;
      add(sheet.plots[0], fmt::format("plate of radius {} mm", number(milli * plate.radius)),
          color_of_value(plate.radius), plate.sinkage, plate.pressure,
          [&](double z) { return modulus * std::pow(z, fit.soil.exponent.value); });
    }
  seen.clear();
  for (std::size_t k = 0; k < shear.size(); ++k)
    add(sheet.plots[1], fmt::format("ring under {:.2g} kPa", kilo * shear[k].normal_stress),
        3 + color_of_value(shear[k].normal_stress), shear[k].displacement, shear[k].shear_stress,
        [&, &janosi = fit.shear[k]](double j) { return -janosi.shear_max * std::expm1(-j / janosi.modulus); });
  return sheet;
}

/// soilbin-bevameter/1
Json bevameter_json(const Soil& soil, const BevameterFit& fit, double density) {
  Json document = {{"format", "soilbin-bevameter/1"}, {"soil", soil.name}};
  for (const SoilParameter& p : bevameter_parameters) document[p.name] = estimate_json(fit.soil.*p.value);
  document["cohesion_as_fitted"] = fit.cohesion_as_fitted;
  document["pressure_error"] = fit.pressure_error;
  document["density"] = density;
  return document;
}

Table values_table(const BevameterFit& fit, const Soil& soil) {
  Table table{"", {"value", "bevameter", "soil file"}};
  for (const SoilParameter& p : bevameter_parameters)
    table.add({heading(p.symbol, p.unit), number(fit.soil.*p.value, p.per_si),
               soil.semi_empirical ? number((*soil.semi_empirical).*p.value, p.per_si) : "-"});
  return table;
}

}  // namespace

Report report_on(const BevameterFit& fit, const BevameterReadings& readings, const Soil& soil, int packings) {
  const std::string title = "bevameter: " + soil.name;
  Report report{title, "Simulated plates and rings on the grains of a soil.",
                fmt::format("{}, {} bed samples", title, packings)};
  report.add("Values", values_table(fit, soil));
  std::vector<std::string> left;
  if (fit.cohesion_as_fitted < 0)
    left.push_back(fmt::format("cohesion came out at {} kPa and is given as 0", number(fit.cohesion_as_fitted / 1e3)));
  left.push_back(fmt::format("Bekker's form misses the pressures by {} % (root mean square over mean)",
                             number(fit.pressure_error * 100)));
  report.add(Sentences(left));
  report.sheet =
      drawn_once([=, &readings, &fit] { return bevameter_sheet(title, readings.plates, readings.shear, fit); });
  report.add("Curves", Figure{report.sheet, "Points: simulated; lines: the fit."});
  report.data = [&soil, &fit, density = readings.density] { return bevameter_json(soil, fit, density); };
  return report;
}

}  // namespace soilbin::compare
