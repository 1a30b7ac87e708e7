#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "compare/bevameter/measured_shear.hpp"
#include "compare/report/json_fields.hpp"
#include "compare/report/number_text.hpp"
#include "compare/telling/reports.hpp"
#include "scenario/mapping_writer.hpp"
#include "scenario/soil_parameters.hpp"

namespace soilbin::compare {
namespace {

/// Shear stress over displacement: every reading and Janosi's curve of each test, as far as it was fitted.
Sheet shear_sheet(std::span<const MeasuredShear> tests, const MeasuredShearFit& fit, const std::string& title) {
  Plot plot{"Shear stress [kPa]", {"displacement [mm]", 0.0}, {"", 0.0}};
  for (std::size_t k = 0; k < tests.size(); ++k) {
    const ShearCurve& curve = tests[k].curve;
    const std::string name = fmt::format("{} kPa", number(curve.normal_stress / 1e3, 3));
    Series points{.label = name + ", measured", .mark = Mark::points, .color = static_cast<int>(k)};
    const std::size_t every = curve.displacement.size() / 60 + 1;  // more points than these hide each other
    for (std::size_t i = 0; i < curve.displacement.size(); i += every)
      points.x.push_back(1e3 * curve.displacement[i]), points.y.push_back(1e-3 * curve.shear_stress[i]);
    plot.series.push_back(std::move(points));
    const ShearTestFit& one = fit.tests[k];
    const double to = one.residual ? one.peak_at : *std::ranges::max_element(curve.displacement);
    plot.series.push_back(fitted_curve(name + ", Janosi's curve", static_cast<int>(k), to, [&](double j) {
      return -1e-3 * one.janosi.shear_max * std::expm1(-j / one.janosi.modulus);
    }));
  }
  return {title, {plot}, Palette::named};
}

struct NamedShearValue {
  const SoilParameter& parameter;
  const Estimate& value;
};

std::vector<NamedShearValue> shear_values(const MeasuredShearFit& fit) {
  return {{soil_parameter("cohesion"), fit.cohesion},
          {soil_parameter("friction_angle"), fit.friction_angle},
          {soil_parameter("shear_modulus"), fit.shear_modulus}};
}

Table shear_values_table(const MeasuredShearFit& fit) {
  Table table{"", {"value", "fit"}};
  for (const auto& [p, value] : shear_values(fit)) {
    if (fit.one_stress && std::string_view(p.name) == "cohesion") continue;
    table.add({heading(p.symbol, p.unit), number(value, p.per_si)});
  }
  if (fit.residual_angle) table.add({"phi, residual [deg]", number(*fit.residual_angle, 1 / degree)});
  return table;
}

Table shear_tests_table(const MeasuredShearFit& fit, std::span<const MeasuredShear> tests) {
  Table table{"",
              {"test", "normal stress [kPa]", "tau_max [kPa]", "K [mm]", "missed [%]", "peak [kPa]", "at [mm]",
               "residual [kPa]"}};
  for (std::size_t k = 0; k < tests.size(); ++k) {
    const ShearTestFit& one = fit.tests[k];
    table.add({tests[k].test.empty() ? "-" : tests[k].test, number(tests[k].curve.normal_stress / 1e3),
               number(one.janosi.shear_max / 1e3), number(1e3 * one.janosi.modulus),
               number(100 * one.janosi.rms / one.janosi.shear_max, 2), number(one.peak / 1e3),
               number(1e3 * one.peak_at), one.residual ? number(*one.residual / 1e3) : "-"});
  }
  return table;
}

std::string shear_lines(const MeasuredShearFit& fit, const std::string& source) {
  std::string text = "For campaign.yaml or a soil file:\n\n";
  for (const auto& [p, value] : shear_values(fit)) {
    const std::string unit = unit_behind(p.unit);
    const bool presumed = fit.one_stress && std::string_view(p.name) == "cohesion";
    text += fmt::format("  {}: {{value: {}{}, sd: {}{}, source: {}}}\n", p.name, number(value.value * p.per_si), unit,
                        number(value.std_error * p.per_si, 2), unit,
                        yaml_scalar(presumed ? source + "; presumed: one normal stress" : source));
  }
  return text;
}

std::vector<std::string> words_on_shear(const MeasuredShearFit& fit) {
  std::vector<std::string> words = {
      "tau = tau_max (1 - exp(-j/K)) (Janosi and Hanamoto 1961); c and phi: a line through tau_max over the normal "
      "stress.",
      "± of c and phi: the tests' scatter about that line; of K: of one more test."};
  if (fit.residual_angle)
    words.emplace_back("Where the stress falls again behind its peak, the curve is fitted up to the peak.");
  if (fit.cohesion_as_fitted < 0.0)
    words.push_back(fmt::format("The line has c = {} kPa: c is 0, and phi of a line through 0.",
                                number(fit.cohesion_as_fitted / 1e3, 3)));
  return words;
}

/// soilbin-shear/1
Json shear_json(const MeasuredShearFit& fit, std::span<const MeasuredShear> tests) {
  Json document = {{"format", "soilbin-shear/1"}, {"one_normal_stress", fit.one_stress}};
  for (const auto& [p, value] : shear_values(fit)) document[p.name] = estimate_json(value);
  document["cohesion_as_fitted"] = fit.cohesion_as_fitted;
  document["residual_angle"] = or_null(fit.residual_angle);
  document["tests"] = Json::array();
  for (std::size_t k = 0; k < tests.size(); ++k) {
    const ShearTestFit& one = fit.tests[k];
    document["tests"].push_back({{"test", tests[k].test},
                                 {"normal_stress", tests[k].curve.normal_stress},
                                 {"readings", tests[k].curve.displacement.size()},
                                 {"shear_max", one.janosi.shear_max},
                                 {"shear_modulus", one.janosi.modulus},
                                 {"rms", one.janosi.rms},
                                 {"peak", one.peak},
                                 {"peak_at", one.peak_at},
                                 {"residual", or_null(one.residual)}});
  }
  return document;
}

}  // namespace

Report report_on(const MeasuredShearFit& fit, std::span<const MeasuredShear> tests, const std::string& file) {
  Report report{file, "Measured shear tests and Janosi's curve.", counted(tests.size(), "test")};
  report.add("Values", shear_values_table(fit));
  report.add(Sentences(words_on_shear(fit)));
  report.sheet = drawn_once([&fit, tests, file] { return shear_sheet(tests, fit, file); });
  report.add("Shear stress over displacement", Figure{report.sheet, "Points: readings; lines: Janosi's curve."});
  report.add("Test by test", shear_tests_table(fit, tests));
  report.add("For a soil file", Code{shear_lines(fit, "soilbin shear " + file)});
  report.data = [&fit, tests] { return shear_json(fit, tests); };
  return report;
}

}  // namespace soilbin::compare
