// soilbin shear: measured shear tests, and the c, phi and K that they give.
#include <filesystem>
#include <memory>
#include <optional>

#include "cli/commands.hpp"
#include "cli/flag_values.hpp"
#include "cli/outputs.hpp"
#include "compare/bevameter/measured_shear.hpp"
#include "compare/bevameter/plate_tests.hpp"
#include "compare/doubts/doubts.hpp"
#include "compare/telling/reports.hpp"

namespace soilbin::cli {
namespace {

struct ShearOptions {
  std::string file, normal_stress;
  std::vector<std::string> only;
  OutputFlags outputs;
};

int shear(const ShearOptions& options, const Session& session) {
  std::optional<double> normal_stress;
  set_where_given("--normal-stress", options.normal_stress, {"kPa", above_zero}, normal_stress);
  const std::vector<compare::MeasuredShear> tests = compare::read_shear(
      read_source_text(options.file, compare::largest_plate_csv), column_values("--only", options.only), normal_stress);
  const compare::MeasuredShearFit fit = compare::fit_measured_shear(tests);
  const std::string name = std::filesystem::path(options.file).filename().string();
  return publish(compare::report_on(fit, tests, name), options.outputs, compare::doubts(fit, tests), session)
      .status(done);
}

}  // namespace

void add_shear(CLI::App& app, Session& session) {
  CLI::App* command = app.add_subcommand("shear", "c, phi and K of measured shear tests, with errors and a plot");
  const auto options = std::make_shared<ShearOptions>();
  add_value(*command, "file", options->file, "FILE.csv",
            "one row a reading: displacement_mm, shear_stress_kPa, normal_stress_kPa (any units), and a name for each "
            "test")
      ->required();
  add_repeatable(*command, "--only", options->only, "COLUMN=VALUE",
                 "rows that have this value alone; may be given again");
  add_value(*command, "--normal-stress", options->normal_stress, "STRESS", "of all tests, where no column gives it");
  options->outputs.add_to(*command,
                          {.json = "soilbin-shear/1, in SI", .plot = "draw the readings and Janosi's curves"});
  command->footer("Example: soilbin shear ring.csv --only bed=dense --plot ring.svg");
  command->callback([=, &session] { session.action = [=, &session] { return shear(*options, session); }; });
}

}  // namespace soilbin::cli
