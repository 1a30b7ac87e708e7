// What tests of a soil gave, as it is told: measured plates and shear, and the virtual bevameter.
#include <fmt/core.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "compare/bevameter/bevameter.hpp"
#include "compare/bevameter/measured_plates.hpp"
#include "compare/bevameter/measured_shear.hpp"
#include "compare/bevameter/plate_groups.hpp"
#include "compare/experiments/virtual_bevameter.hpp"
#include "compare/report/json_fields.hpp"
#include "compare/report/number_text.hpp"
#include "compare/telling/reports.hpp"
#include "resistive_force/response.hpp"
#include "scenario/mapping_writer.hpp"
#include "scenario/quantity.hpp"
#include "scenario/soil.hpp"
#include "scenario/soil_parameters.hpp"

namespace soilbin::compare {
namespace {

using bekker_wong::PlateCurve;

/// Pressure over sinkage: every reading that was used, those set aside that do not lie far beyond them, and Bekker's
/// form for each plate.
Sheet plates_sheet(std::span<const MeasuredPlate> plates, const MeasuredPlatesFit& fit, const std::string& title) {
  Plot plot{"Pressure [kPa]", {"sinkage [mm]", 0.0}, {"", 0.0}};
  const auto is_aside = [&](const MeasuredPlate& plate) {
    return std::ranges::any_of(fit.apart, [&](const PlateTestApart& one) {
      return one.apart.set_aside && one.test == plate.test && one.radius == plate.curve.radius;
    });
  };
  const auto add = [](Series& points, const PlateCurve& curve, double deepest, double highest) {
    const std::size_t every = curve.pressure.size() / 40 + 1;  // more points than these hide each other
    for (std::size_t i = 0; i < curve.pressure.size(); i += every)
      if (curve.sinkage[i] <= deepest && curve.pressure[i] <= highest)
        points.x.push_back(1e3 * curve.sinkage[i]), points.y.push_back(1e-3 * curve.pressure[i]);
  };
  constexpr double everywhere = std::numeric_limits<double>::infinity();
  double most = 0.0;  // sinkage on a loading curve
  for (std::size_t k = 0; k < fit.radii.size(); ++k) {
    const std::string plate = fmt::format("b = {:g} mm", 1000 * fit.radii[k]);
    double deepest = 0.0;
    for (const MeasuredPlate& measured : plates) {
      if (measured.curve.radius != fit.radii[k] || is_aside(measured)) continue;
      Series points{.label = plate + ", measured", .mark = Mark::points, .color = static_cast<int>(k)};
      const PlateCurve used =
          within(readings_of(measured.curve, loading_curve(measured.curve).readings), {fit.lowest, fit.highest});
      add(points, used, everywhere, everywhere);
      deepest = std::max(deepest, *std::ranges::max_element(used.sinkage));
      plot.series.push_back(std::move(points));
    }
    most = std::max(most, deepest);
    plot.series.push_back(fitted_curve(plate + ", Bekker's form", static_cast<int>(k), deepest,
                                       [&](double z) { return 1e-3 * bekkers_form(fit, fit.radii[k], z); }));
  }
  Series aside{.label = "set aside", .mark = Mark::points, .color = static_cast<int>(fit.radii.size())};
  for (const MeasuredPlate& measured : plates) {
    std::vector<std::size_t> places;
    for (const PlateReadingsAside& one : fit.aside)
      if (one.test == measured.test && one.radius == measured.curve.radius)
        places.insert(places.end(), one.readings.readings.begin(), one.readings.readings.end());
    add(aside, is_aside(measured) ? measured.curve : readings_of(measured.curve, places), 1.5 * most,
        1.5 * fit.highest);
  }
  if (!aside.x.empty()) plot.series.push_back(std::move(aside));
  return {title, {plot}, Palette::named};
}

/// Values with what they are of.
template <class Value>
using ParameterValues = std::vector<std::pair<const SoilParameter&, const Value&>>;

ParameterValues<PlateValue> plate_values(const MeasuredPlatesFit& fit) {
  return {{soil_parameter("exponent"), fit.exponent},
          {soil_parameter("k_c"), fit.k_c},
          {soil_parameter("k_phi"), fit.k_phi}};
}

/// "  exponent: {value: 1.1, sd: 0.2, source: ...}": the sd to two digits, the value to the sd's place.
std::string yaml_line(const SoilParameter& p, const Estimate& value, const std::string& source, int indent = 2) {
  const std::string unit = unit_behind(p.unit);
  const double sd = value.std_error * p.per_si, shown = value.value * p.per_si;
  const int places = sd > 0.0 ? std::clamp(1 - static_cast<int>(std::floor(std::log10(sd))), 0, 9) : 0;
  return fmt::format("{:{}}{}: {{value: {}{}, sd: {:.{}f}{}, source: {}}}\n", "", indent, p.name,
                     sd > 0.0 ? fmt::format("{:.{}f}", shown, places) : write_number(shown), unit, sd, places, unit,
                     yaml_scalar(source));
}

std::string reference_line(double sinkage, int indent = 2) {
  return fmt::format("{:{}}reference_sinkage: {:.3g} mm\n", "", indent, 1e3 * sinkage);
}

/// The lines that a campaign or a soil file takes.
std::string yaml_lines(const MeasuredPlatesFit& fit, const std::string& source) {
  const SoilParameter& exponent = soil_parameter("exponent");
  if (!exponent.range.holds(fit.exponent.estimate.value))
    return fmt::format("None for a file: a soil file takes n from {:g} to {:g}.\n", exponent.range.lower,
                       exponent.range.upper);
  std::string text = "For campaign.yaml or a soil file:\n\n";
  for (const auto& [p, value] : plate_values(fit)) {
    const bool presumed = fit.one_size() && std::string_view(p.name) == "k_c";
    text += yaml_line(p, value.estimate, presumed ? source + "; presumed: one size of plate" : source);
  }
  return text + reference_line(fit.reference_sinkage);
}

/// The section of a soil file that the model rft reads.
std::string rft_lines(const MeasuredPlatesFit& fit, const std::string& source) {
  const Estimate& xi_n = fit.xi_n.estimate;
  return fmt::format(
      "For the model rft, in a soil file:\n\n"
      "resistive_force:\n  xi_n: {{value: {} kN/m^3, sd: {} kN/m^3, source: {}}}\n"
      "  surface_friction: {{value: 0.5, sd: 0.1, source: assumed}}\n",
      number(xi_n.value / 1e3), number(xi_n.std_error / 1e3), yaml_scalar(source));
}

/// "lines 3, 7 to 9, 12, ..."
std::string line_list(const std::vector<int>& lines) {
  constexpr std::size_t most = 6;
  if (lines.empty()) return "";
  std::vector<std::string> runs;
  for (std::size_t i = 0; i < lines.size();) {
    std::size_t last = i;
    while (last + 1 < lines.size() && lines[last + 1] == lines[last] + 1) ++last;
    if (runs.size() == most) {
      runs.emplace_back("...");
      break;
    }
    runs.push_back(last == i ? std::to_string(lines[i])
                             : fmt::format("{}{}{}", lines[i], last == i + 1 ? ", " : " to ", lines[last]));
    i = last + 1;
  }
  return fmt::format("line{} {}", lines.size() == 1 ? "" : "s", fmt::join(runs, ", "));
}

/// A sentence for each kind of readings that were set aside.
std::vector<std::string> aside_in_words(const MeasuredPlatesFit& fit) {
  struct Kind {
    std::vector<AsideWhy> whys;
    const char* what;
  };
  const std::array<Kind, 3> kinds = {{
      {{AsideWhy::sinkage_spike, AsideWhy::pressure_spike, AsideWhy::end_spike}, "spikes"},
      {{AsideWhy::unloading}, "unloading, reloading or holding"},
      {{AsideWhy::stuck},
       "constant sinkage under rising pressure (a depth sensor that sticks or is at the end of its range, or hard "
       "ground)"},
  }};
  std::vector<std::string> sentences;
  for (const Kind& kind : kinds) {
    std::vector<int> lines;
    std::set<std::pair<std::string, double>> tests;
    std::vector<double> stiffness;
    std::size_t count = 0;
    for (const PlateReadingsAside& one : fit.aside) {
      if (std::ranges::find(kind.whys, one.readings.why) == kind.whys.end()) continue;
      count += one.readings.readings.size();
      lines.insert(lines.end(), one.lines.begin(), one.lines.end());
      tests.emplace(one.test, one.radius);
      if (one.readings.unloading_stiffness) stiffness.push_back(*one.readings.unloading_stiffness);
    }
    if (count == 0) continue;
    std::ranges::sort(lines), std::ranges::sort(stiffness);
    const std::string where = line_list(lines);
    sentences.push_back(fmt::format("Set aside as {}: {} of {}{}.", kind.what, counted(count, "reading"),
                                    counted(tests.size(), "test"), where.empty() ? "" : fmt::format(" ({})", where)));
    if (stiffness.size() == 1)
      sentences.push_back(fmt::format("There the slope of pressure over sinkage k_u is {} MN/m^3.",
                                      number(stiffness.front() / 1e6, 3)));
    else if (stiffness.size() > 1)
      sentences.push_back(fmt::format("There the slope of pressure over sinkage k_u is {} to {} MN/m^3.",
                                      number(stiffness.front() / 1e6, 3), number(stiffness.back() / 1e6, 3)));
  }
  return sentences;
}

std::vector<std::string> apart_in_words(const MeasuredPlatesFit& fit) {
  std::vector<std::string> sentences;
  for (const PlateTestApart& one : fit.apart) sentences.push_back(capital(in_words(one)));
  return sentences;
}

Json plates_json(const MeasuredPlatesFit& fit, std::size_t tests) {
  Json document = {{"format", "soilbin-plates/1"}, {"tests", tests}};
  for (const auto& [p, value] : plate_values(fit)) {
    document[p.name] = estimate_json(value.estimate);
    document[p.name]["between_tests"] = value.between_tests;
    document[p.name]["between_pressures"] = value.between_pressures;
    document[p.name]["between_readings"] = value.between_readings;
  }
  document["reference_sinkage"] = fit.reference_sinkage;
  document["pressure_error"] = fit.pressure_error;
  document["xi_n"] = estimate_json(fit.xi_n.estimate);
  document["xi_n"]["between_tests"] = fit.xi_n.between_tests;
  document["xi_n"]["between_pressures"] = fit.xi_n.between_pressures;
  document["xi_n"]["pressure_error"] = fit.xi_n_pressure_error;
  document["test_scatter"] = fit.test_scatter;
  document["exponent_scatter"] = fit.exponent_scatter;
  document["low_exponent"] = fit.low_exponent, document["high_exponent"] = fit.high_exponent;
  document["lowest_pressure"] = fit.lowest, document["highest_pressure"] = fit.highest;
  document["plates"] = Json::array();
  for (std::size_t k = 0; k < fit.radii.size(); ++k)
    document["plates"].push_back({{"radius", fit.radii[k]},
                                  {"tests", fit.tests[k]},
                                  {"exponent", fit.plate_exponents[k]},
                                  {"modulus", fit.plate_moduli[k]}});
  document["plate_sizes"] = fit.radii.size();
  if (fit.one_size()) {  // k_c and k_phi are not known by themselves
    document["modulus"] = document["k_phi"];
    document["modulus"]["radius"] = fit.radii.front();
    document["k_c"] = nullptr, document["k_phi"] = nullptr;
  }
  document["readings"] = fit.readings;
  document["set_aside"] = list_of(fit.aside, [](const PlateReadingsAside& one) {
    Json aside = {{"test", one.test},
                  {"radius", one.radius},
                  {"why", word(one.readings.why)},
                  {"readings", one.readings.readings.size()},
                  {"lines", one.lines}};
    if (one.readings.unloading_stiffness) aside["unloading_stiffness"] = finite(*one.readings.unloading_stiffness);
    return aside;
  });
  document["disagreeing_tests"] = list_of(fit.apart, [](const PlateTestApart& one) {
    return Json{{"test", one.test},
                {"radius", one.radius},
                {"first_line", one.first_line},
                {"last_line", one.last_line},
                {"factor", finite(one.apart.factor)},
                {"as_if", one.apart.unit},
                {"set_aside", one.apart.set_aside}};
  });
  document["with_all_kept"] = nullptr;
  if (fit.kept)
    document["with_all_kept"] = {
        {"exponent", finite((*fit.kept)[0])}, {"k_c", finite((*fit.kept)[1])}, {"k_phi", finite((*fit.kept)[2])}};
  return document;
}

Table values_table(const MeasuredPlatesFit& fit) {
  Table table{"", {"value", "fit", "between tests", "between low and high pressures", "of readings"}};
  for (const auto& [p, value] : plate_values(fit)) {
    if (fit.one_size() && std::string_view(p.name) == "k_c") continue;
    const std::string symbol = fit.one_size() && std::string_view(p.name) == "k_phi" ? "k" : p.symbol;
    table.add({heading(symbol, p.unit), number(value.estimate, p.per_si), number(value.between_tests * p.per_si),
               number(value.between_pressures * p.per_si), number(value.between_readings * p.per_si)});
  }
  table.add({"xi_n [kN/m^3]", number(fit.xi_n.estimate, 1e-3), number(fit.xi_n.between_tests / 1e3),
             number(fit.xi_n.between_pressures / 1e3), "-"});
  return table;
}

Table plates_table(const MeasuredPlatesFit& fit) {
  Table table{"", {"b [mm]", "tests", "n of its own", "k at the common n [kN/m^(n+2)]"}};
  for (std::size_t k = 0; k < fit.radii.size(); ++k)
    table.add({fmt::format("{:g}", 1000 * fit.radii[k]), std::to_string(fit.tests[k]), number(fit.plate_exponents[k]),
               number(fit.plate_moduli[k] / 1e3)});
  return table;
}

std::vector<std::string> words_on_errors(const MeasuredPlatesFit& fit) {
  return {
      "± is one standard error: the three columns beside it, squared and added.",
      fit.one_size() ? fmt::format("k stands for k_c/b + k_phi at b = {:g} mm: one plate size can't separate the two. "
                                   "It is valid for a wheel or plate of about this b.",
                                   1000 * fit.radii.front())
                     : std::string("The errors of k_c and k_phi are at this n."),
      fmt::format("An error of n leaves the pressure at {} mm as it is, and k follows: a file's reference_sinkage.",
                  number(1e3 * fit.reference_sinkage, 3)),
      fmt::format("xi_n is the model rft's: the pressure under any plate is {:.3f} xi_n z. RMS error of the pressures: "
                  "{} by xi_n, {} by Bekker's form (of the mean pressure).",
                  resistive_force::plate_response(), percent(fit.xi_n_pressure_error), percent(fit.pressure_error))};
}

}  // namespace

Report report_on(const MeasuredPlatesFit& fit, std::span<const MeasuredPlate> plates, const std::string& file) {
  const std::string sizes = fit.one_size() ? "plates of one size" : fmt::format("plates of {} sizes", fit.radii.size());
  Report report{file, "Measured plate tests and Bekker's form p = (k_c/b + k_phi) z^n.",
                fmt::format("{} with {}, {:.2g} to {:.3g} kPa", counted(plates.size(), "test"), sizes, fit.lowest / 1e3,
                            fit.highest / 1e3)};
  report.add("Values", values_table(fit));
  report.add(Sentences(words_on_errors(fit)));
  report.sheet = drawn_once([&fit, plates, file] { return plates_sheet(plates, fit, file); });
  report.add("Pressure over sinkage", Figure{report.sheet, "Points: readings; lines: Bekker's form."});
  report.add("Plate by plate", plates_table(fit));
  report.add(Sentences({"b is a round plate's radius, a strip's width."}));
  std::vector<std::string> aside = apart_in_words(fit), of_readings = aside_in_words(fit);
  aside.insert(aside.end(), of_readings.begin(), of_readings.end());
  if (fit.kept && !aside.empty())
    aside.push_back(fmt::format("With everything kept: n = {}, k_c = {} kN/m^(n+1), k_phi = {} kN/m^(n+2).",
                                number((*fit.kept)[0]), number((*fit.kept)[1] / 1e3), number((*fit.kept)[2] / 1e3)));
  if (!aside.empty()) report.add("Set aside", Sentences(aside));
  report.add("For the model rft", Code{rft_lines(fit, "soilbin plates " + file)});
  report.add("For a soil file", Code{yaml_lines(fit, "soilbin plates " + file)});
  report.data = [&fit, tests = plates.size()] { return plates_json(fit, tests); };
  return report;
}

namespace {

/// A group's k_u, "190 to 220", or "-".
std::string unloading_in_words(const MeasuredPlatesFit& fit) {
  double least = std::numeric_limits<double>::infinity(), most = 0.0;
  for (const PlateReadingsAside& one : fit.aside)
    if (const std::optional<double>& slope = one.readings.unloading_stiffness)
      least = std::min(least, *slope), most = std::max(most, *slope);
  if (most == 0.0) return "-";
  const std::string low = number(least / 1e6, 3), high = number(most / 1e6, 3);
  return low == high ? low : low + " to " + high;
}

Table groups_table(const PlateGroups& groups) {
  const bool one_size = std::ranges::all_of(groups.all, [](const PlateGroup& group) { return group.fit.one_size(); });
  Table table{"", {groups.by, "tests", "up to [kPa]", "n", "n, low pressures", "n, high pressures"}};
  for (const char* header : {"k_c [kN/m^(n+1)]", "k_phi [kN/m^(n+2)]"})
    if (!one_size) table.header.emplace_back(header);
  if (one_size) table.header.emplace_back("k [kN/m^(n+2)]");
  for (const char* header : {"missed [%]", "k_u [MN/m^3]"}) table.header.emplace_back(header);
  for (const PlateGroup& group : groups.all) {
    const MeasuredPlatesFit& fit = group.fit;
    std::vector<TableCell> row = {
        group.value.empty() ? "-" : group.value, std::to_string(group.tests.size()), number(fit.highest / 1e3, 3),
        number(fit.exponent.estimate),           number(fit.low_exponent, 3),        number(fit.high_exponent, 3)};
    if (!one_size) row.emplace_back(fit.one_size() ? "-" : number(fit.k_c.estimate, 1e-3));
    row.emplace_back(number(fit.k_phi.estimate, 1e-3));
    row.emplace_back(number(100 * fit.pressure_error, 2)), row.emplace_back(unloading_in_words(fit));
    table.add(row);
  }
  return table;
}

std::vector<std::string> words_on_groups(const PlateGroups& groups) {
  std::vector<std::string> words = {
      "Each group is fitted by itself, as soilbin plates fits one file; its errors and what it leaves out: --only.",
      "n at low and at high pressures: of the lower and the upper half of a group's pressures. Where the upper n is "
      "larger, the bed stiffens with depth; where it is smaller, it nears the most that it bears."};
  if (const std::optional<DensityTrend>& trend = groups.trend)
    words.push_back(fmt::format(
        "Over the dry density, {:g} to {:g} kg/m^3 in {} beds: n goes as its power {}, and the pressure at z = b = "
        "{:g} mm as its power {}, about {} and {} kPa at {} kg/m^3.",
        trend->lowest, trend->highest, trend->densities, number(trend->exponent.power), 1000 * trend->radius,
        number(trend->pressure.power), number(trend->exponent.reference, 3), number(trend->pressure.reference / 1e3, 3),
        number(trend->density, 4)));
  return words;
}

Json power_json(const PowerOfDensity& power) {
  return {{"reference", power.reference}, {"share", power.share}, {"power", estimate_json(power.power)}};
}

Json groups_json(const PlateGroups& groups) {
  Json document = {{"format", "soilbin-plate-groups/1"}, {"by", groups.by}, {"groups", Json::array()}};
  for (const PlateGroup& group : groups.all) {
    Json one = plates_json(group.fit, group.tests.size());
    one.erase("format");
    one["value"] = group.value;
    one["dry_density"] = group.density ? Json(*group.density) : Json();
    document["groups"].push_back(std::move(one));
  }
  document["density_trend"] = nullptr, document["at_density"] = nullptr;
  if (const std::optional<DensityTrend>& trend = groups.trend)
    document["density_trend"] = {{"dry_density", trend->density},
                                 {"lowest", trend->lowest},
                                 {"highest", trend->highest},
                                 {"radius", trend->radius},
                                 {"densities", trend->densities},
                                 {"exponent", power_json(trend->exponent)},
                                 {"pressure", power_json(trend->pressure)}};
  if (const std::optional<SemiEmpiricalSoil>& at = groups.at)
    document["at_density"] = {{"dry_density", *at->density},
                              {"exponent", estimate_json(at->exponent)},
                              {"modulus", estimate_json(at->k_phi)},
                              {"k_c", estimate_json(at->k_c)},
                              {"reference_sinkage", at->reference_sinkage.value_or(1.0)}};
  return document;
}

/// n, k_c, k_phi and the reference sinkage of a bed, as a soil file has them.
std::string lines_of(const SemiEmpiricalSoil& bed, bool one_size, const std::string& source, int indent) {
  std::string text;
  for (const SoilParameter& p : bevameter_parameters.first<3>()) {
    const bool presumed = one_size && std::string_view(p.name) == "k_c";
    text += yaml_line(p, bed.*p.value, presumed ? source + "; presumed: one size of plate" : source, indent);
  }
  return text + reference_line(bed.reference_sinkage.value_or(1.0), indent);
}

/// The bed that was asked for; else all of them, for a soil's section 'beds'.
std::string soil_file_lines(const PlateGroups& groups, const std::string& source) {
  const bool one_size = groups.all.front().fit.one_size();
  if (const std::optional<SemiEmpiricalSoil>& at = groups.at)
    return fmt::format("For a soil file, at {:g} kg/m^3:\n\n", *at->density) +
           lines_of(*at, one_size, fmt::format("{} --density {:g}kg/m^3", source, *at->density), 2) +
           fmt::format("  density: {{value: {:g} kg/m^3, source: \"as asked; dry\"}}\n", *at->density);
  std::string text =
      "For a soil file whose density can be asked for (each bed needs c, phi and K too: soilbin shear):\n\nbeds:\n";
  for (const SemiEmpiricalSoil& bed : groups.beds)
    text += fmt::format("  - density: {:g} kg/m^3\n", *bed.density) + lines_of(bed, one_size, source, 4);
  return text;
}

Sheet groups_sheet(const PlateGroups& groups, const std::string& title) {
  Plot plot{"Pressure [kPa]", {"sinkage [mm]", 0.0}, {"", 0.0}};
  int color = 0;
  for (const PlateGroup& group : groups.all) {
    Plot own = plates_sheet(group.tests, group.fit, title).plots.front();
    for (Series& series : own.series) {
      if (series.label == "set aside") continue;
      series.color = color, series.label = (group.value.empty() ? "-" : group.value) + ", " + series.label;
      plot.series.push_back(std::move(series));
    }
    ++color;
  }
  return {title, {plot}, Palette::named};
}

}  // namespace

Report report_on(const PlateGroups& groups, const std::string& file) {
  const std::string source = fmt::format("soilbin plates {} --by {}", file, groups.by);
  Report report{file, "Measured plate tests, fitted apart by a column.",
                fmt::format("{} by {}", counted(groups.all.size(), "group"), groups.by)};
  report.add("Group by group", groups_table(groups));
  report.add(Sentences(words_on_groups(groups)));
  report.sheet = drawn_once([&groups, file] { return groups_sheet(groups, file); });
  report.add("Pressure over sinkage", Figure{report.sheet, "Points: readings; lines: Bekker's form."});
  if (!groups.beds.empty()) report.add("For a soil file", Code{soil_file_lines(groups, source)});
  report.data = [&groups] { return groups_json(groups); };
  return report;
}

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

ParameterValues<Estimate> shear_values(const MeasuredShearFit& fit) {
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

// What a virtual bevameter found in a soil's grains, as it is told; soilbin-bevameter/1.

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

Json bevameter_json(const Soil& soil, const BevameterFit& fit, double density) {
  Json document = {{"format", "soilbin-bevameter/1"}, {"soil", soil.name}};
  for (const SoilParameter& p : bevameter_parameters) document[p.name] = estimate_json(fit.soil.*p.value);
  document["cohesion_as_fitted"] = fit.cohesion_as_fitted;
  document["pressure_error"] = fit.pressure_error;
  document["density"] = density;
  document["xi_n"] = estimate_json(fit.xi_n);
  return document;
}

Table values_table(const BevameterFit& fit, const Soil& soil) {
  Table table{"", {"value", "bevameter", "soil file"}};
  for (const SoilParameter& p : bevameter_parameters)
    table.add({heading(p.symbol, p.unit), number(fit.soil.*p.value, p.per_si),
               soil.semi_empirical ? number((*soil.semi_empirical).*p.value, p.per_si) : "-"});
  table.add({heading("xi_n", "kN/m^3"), number(fit.xi_n, 1e-3),
             soil.resistive_force ? number(soil.resistive_force->xi_n, 1e-3) : "-"});
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
