// soilbin plates: measured plate tests, and the n, k_c and k_phi that they give.

#include <filesystem>
#include <memory>
#include <optional>

#include "cli/commands.hpp"
#include "cli/flag_values.hpp"
#include "cli/outputs.hpp"
#include "compare/bevameter/measured_plates.hpp"
#include "compare/bevameter/plate_groups.hpp"
#include "compare/doubts/doubts.hpp"
#include "compare/telling/reports.hpp"
#include "scenario/errors.hpp"

namespace soilbin::cli {
namespace {

struct PlatesOptions {
  std::string file, pressure, plate, by, density;
  std::vector<std::string> only;
  OutputFlags outputs;
};

int plates(const PlatesOptions& options, const Session& session) {
  compare::PressureWindow window;
  if (!options.pressure.empty())
    std::tie(window.first, window.last) = read_range("--pressure", options.pressure, {"kPa", zero_or_more});
  std::optional<double> diameter;
  set_where_given("--plate", options.plate, {"mm", above_zero}, diameter);
  const std::string name = std::filesystem::path(options.file).filename().string();
  if (!options.by.empty()) {
    std::optional<double> density;
    set_where_given("--density", options.density, {"kg/m^3", above_zero}, density);
    const compare::PlateGroups groups =
        compare::fit_groups(read_source_text(options.file, compare::largest_plate_csv),
                            {options.by, column_values("--only", options.only), diameter, window, density});
    return publish(compare::report_on(groups, name), options.outputs, compare::doubts(groups), session).status(done);
  }
  if (!options.density.empty())
    throw InputError("--density needs --by: a column that tells the beds apart, dry_density_kg/m^3 or another");
  const std::vector<compare::MeasuredPlate> tests = compare::read_plates(
      read_source_text(options.file, compare::largest_plate_csv), column_values("--only", options.only), diameter);
  const compare::MeasuredPlatesFit fit = compare::fit_measured_plates(tests, window);
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
  add_repeatable(*command, "--only", options->only, "COLUMN=VALUE",
                 "rows that have this value alone; may be given again");
  add_value(*command, "--by", options->by, "COLUMN",
            "fits each of the column's values apart: preparations, densities, boxes");
  add_value(*command, "--density", options->density, "DENSITY",
            "with --by: n, k_c and k_phi at this dry density, from two or more in a column dry_density_kg/m^3");
  add_value(*command, "--pressure", options->pressure, "LOW..HIGH",
            "readings that are used; best those that your wheel makes");
  add_value(*command, "--plate", options->plate, "DIAMETER",
            "of the one round plate of all tests, where no column gives it");
  options->outputs.add_to(*command, {.json = "soilbin-plates/1, in SI; with --by soilbin-plate-groups/1",
                                     .plot = "draw the readings and Bekker's form"});
  command->footer("Example: soilbin plates plates.csv --only box=large-box --pressure 1kPa..30kPa --plot plates.svg");
  command->callback([=, &session] { session.action = [=, &session] { return plates(*options, session); }; });
}

}  // namespace soilbin::cli
