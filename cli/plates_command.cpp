// soilbin plates: measured plate tests, and the n, k_c and k_phi that they give.
#include <fmt/core.h>

#include <filesystem>
#include <memory>
#include <optional>

#include "cli/commands.hpp"
#include "cli/flag_values.hpp"
#include "cli/outputs.hpp"
#include "compare/bevameter/measured_plates.hpp"
#include "compare/doubts/plate_doubts.hpp"
#include "compare/telling/reports.hpp"

namespace soilbin::cli {
namespace {

struct PlatesOptions {
  std::string file, pressure, plate;
  std::vector<std::string> only;
  OutputFlags outputs;
};

int plates(const PlatesOptions& options, const Session& session) {
  compare::PressureWindow window;
  if (!options.pressure.empty())
    std::tie(window.first, window.last) = read_range("--pressure", options.pressure, {"kPa", zero_or_more});
  std::optional<double> diameter;
  if (!options.plate.empty()) diameter = read_flag("--plate", options.plate, {"mm", above_zero});
  const std::vector<compare::MeasuredPlate> tests = compare::read_plates(
      read_source_text(options.file, compare::largest_plate_csv), column_values("--only", options.only), diameter);
  const compare::MeasuredPlatesFit fit = compare::fit_measured_plates(tests, window);
  const std::string name = std::filesystem::path(options.file).filename().string();
  return publish(compare::report_on(fit, tests, name), options.outputs, compare::doubts(fit), session).status(done);
}

}  // namespace

void add_plates(CLI::App& app, Session& session) {
  CLI::App* command = app.add_subcommand("plates", "n, k_c and k_phi of measured plate tests, with errors and a plot");
  const auto options = std::make_shared<PlatesOptions>();
  add_value(*command, "file", options->file, "FILE.csv",
            "one row a reading: sinkage_m, pressure_kPa or force_N, plate_diameter_m (any units), and a name "
            "for each test")
      ->required();
  add_value(*command, "--only", options->only, "COLUMN=VALUE", "rows that have this value alone; may be given again")
      ->allow_extra_args(false);
  add_value(*command, "--pressure", options->pressure, "LOW..HIGH",
            "readings that are used; best those that your wheel makes");
  add_value(*command, "--plate", options->plate, "DIAMETER",
            "of the one round plate of all tests, where no column gives it");
  options->outputs.add_to(*command, {.json = "soilbin-plates/1, in SI", .plot = "draw the readings and Bekker's form"});
  command->footer("Example: soilbin plates plates.csv --only box=large-box --pressure 1kPa..30kPa --plot plates.svg");
  command->callback([=, &session] { session.action = [=, &session] { return plates(*options, session); }; });
}

}  // namespace soilbin::cli
