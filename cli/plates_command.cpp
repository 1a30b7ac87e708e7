// soilbin plates: measured plate tests, and the n, k_c and k_phi that they give.
#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <memory>

#include "cli/commands.hpp"
#include "cli/flag_values.hpp"
#include "cli/outputs.hpp"
#include "cli/text_output.hpp"
#include "compare/bevameter/measured_plates.hpp"
#include "compare/measured/csv.hpp"
#include "compare/report/json_fields.hpp"
#include "scenario/errors.hpp"
#include "scenario/soil_parameters.hpp"

namespace soilbin::cli {
namespace {

using compare::MeasuredPlatesFit;
using compare::PlateValue;

struct PlatesOptions {
  std::string file, pressure, plot;
  std::vector<std::string> only;
  bool json = false;
};

/// A value of the fit, as soils name it.
struct NamedValue {
  const SoilParameter& parameter;
  const PlateValue& value;
};

std::vector<NamedValue> values_of(const MeasuredPlatesFit& fit) {
  return {{soil_parameter("exponent"), fit.exponent},
          {soil_parameter("k_c"), fit.k_c},
          {soil_parameter("k_phi"), fit.k_phi}};
}

std::vector<std::pair<std::string, std::string>> rows_asked(const std::vector<std::string>& texts) {
  std::vector<std::pair<std::string, std::string>> only;
  for (const std::string& text : texts) {
    const std::size_t equals = text.find('=');
    if (equals == std::string::npos || equals == 0)
      throw InputError(fmt::format("--only: expected COLUMN=VALUE, such as box=large-box, not '{}'", clipped(text)));
    only.emplace_back(text.substr(0, equals), text.substr(equals + 1));
  }
  return only;
}

/// The lines that a campaign or a soil file takes: the sd to two digits, the value to the sd's place.
std::string as_yaml(const MeasuredPlatesFit& fit, const std::string& source) {
  std::string text;
  for (const auto& [p, value] : values_of(fit)) {
    const std::string unit = std::string_view(p.unit) == "-" ? "" : std::string(" ") + p.unit;
    const double sd = value.estimate.std_error * p.per_si;
    const int places = sd > 0.0 ? std::clamp(1 - static_cast<int>(std::floor(std::log10(sd))), 0, 9) : 4;
    text += fmt::format("  {}: {{value: {:.{}f}{}, sd: {:.{}f}{}, source: \"{}\"}}\n", p.name,
                        value.estimate.value * p.per_si, places, unit, sd, places, unit, source);
  }
  return text;
}

void print_fit(const MeasuredPlatesFit& fit, std::size_t tests, const std::string& source) {
  fmt::print("{} with plates of {} sizes, {:.2g} to {:.3g} kPa\n\n", compare::counted(tests, "test"), fit.radii.size(),
             fit.lowest / 1e3, fit.highest / 1e3);
  TextTable values({"value", "fit", "between tests", "between low and high pressures"});
  for (const auto& [p, value] : values_of(fit))
    values.add({compare::heading(p.symbol, p.unit), number(value.estimate, p.per_si),
                number(value.between_tests * p.per_si), number(value.between_pressures * p.per_si)});
  TextTable plates({"plate [mm]", "tests", "n of its own", "k at the common n [kN/m^(n+2)]"});
  for (std::size_t k = 0; k < fit.radii.size(); ++k)
    plates.add({fmt::format("{:g}", 2000 * fit.radii[k]), std::to_string(fit.tests[k]), number(fit.plate_exponents[k]),
                number(fit.plate_moduli[k] / 1e3)});
  fmt::print(
      "{}\n± is one standard error: the two columns beside it, squared and added. Those of k_c and k_phi hold at this "
      "n.\nA file takes the three as independent, which makes pressures less sure than these tests "
      "are.\n\n{}\nBekker's form misses the pressures by {} (root mean square, of the mean pressure).\n\nFor "
      "campaign.yaml or a soil file:\n\n{}",
      values.text(), plates.text(), compare::percent(fit.pressure_error), as_yaml(fit, source));
}

nlohmann::ordered_json plates_json(const MeasuredPlatesFit& fit, std::size_t tests) {
  nlohmann::ordered_json document = {{"format", "soilbin-plates/1"}, {"tests", tests}};
  for (const auto& [p, value] : values_of(fit)) {
    document[p.name] = compare::estimate_json(value.estimate);
    document[p.name]["between_tests"] = value.between_tests;
    document[p.name]["between_pressures"] = value.between_pressures;
  }
  document["pressure_error"] = fit.pressure_error;
  document["lowest_pressure"] = fit.lowest, document["highest_pressure"] = fit.highest;
  document["plates"] = nlohmann::ordered_json::array();
  for (std::size_t k = 0; k < fit.radii.size(); ++k)
    document["plates"].push_back({{"radius", fit.radii[k]},
                                  {"tests", fit.tests[k]},
                                  {"exponent", fit.plate_exponents[k]},
                                  {"modulus", fit.plate_moduli[k]}});
  return document;
}

int plates(const PlatesOptions& options) {
  compare::PressureWindow window;
  if (!options.pressure.empty())
    std::tie(window.first, window.last) = read_range("--pressure", options.pressure, {"kPa", zero_or_more});
  const std::vector<compare::MeasuredPlate> tests =
      compare::read_plates(read_source_text(options.file, compare::largest_csv), rows_asked(options.only));
  const MeasuredPlatesFit fit = compare::fit_measured_plates(tests, window);
  const std::vector<std::string> doubts = compare::doubts(fit);
  print_warnings(doubts);
  const std::string name = std::filesystem::path(options.file).filename().string();
  Outputs outputs;
  outputs.drawing(options.plot, [&] { return compare::plates_sheet(tests, fit, name); });
  if (options.json)
    print_json(plates_json(fit, tests.size()), doubts);
  else
    print_fit(fit, tests.size(), "soilbin plates " + name);
  return outputs.status(done);
}

}  // namespace

void add_plates(CLI::App& app, Session& session) {
  CLI::App* command = app.add_subcommand("plates", "n, k_c and k_phi of measured plate tests, with errors and a plot");
  const auto options = std::make_shared<PlatesOptions>();
  command
      ->add_option("file", options->file,
                   "one row a reading: sinkage_m, pressure_kPa or force_N, plate_diameter_m (any units), and what "
                   "tells one test from another")
      ->type_name("FILE.csv")
      ->required();
  command->add_option("--only", options->only, "rows that have this value alone; may be given again")
      ->type_name("COLUMN=VALUE")
      ->allow_extra_args(false);
  command->add_option("--pressure", options->pressure, "readings that are used; best those that your wheel makes")
      ->type_name("LOW..HIGH");
  add_plot(*command, options->plot, "draw the readings and Bekker's form");
  command->add_flag("--json", options->json, "soilbin-plates/1, in SI");
  command->footer("Example: soilbin plates plates.csv --only box=large-box --pressure 1kPa..30kPa --plot plates.svg");
  command->callback([=, &session] { session.action = [=] { return plates(*options); }; });
}

}  // namespace soilbin::cli
