// soilbin bevameter: from a soil's grains to the values of the Bekker / Wong-Reece model.
#include <fmt/core.h>

#include <memory>

#include "cli/commands.hpp"
#include "cli/element_test_flags.hpp"
#include "cli/flag_values.hpp"
#include "cli/outputs.hpp"
#include "cli/progress.hpp"
#include "cli/soil_bin.hpp"
#include "compare/bevameter/bevameter.hpp"
#include "compare/experiments/virtual_bevameter.hpp"
#include "compare/telling/reports.hpp"
#include "scenario/errors.hpp"
#include "scenario/soil.hpp"

namespace soilbin::cli {
namespace {

struct BevameterOptions {
  std::string soil, output;
  int packings = 2;
  OutputFlags outputs;
  ElementTestFlags flags;
  PlateFlags plates;
};

int bevameter(const BevameterOptions& options, const Session& session) {
  if (options.packings < 1) throw InputError("--packings: 1 or more");
  const Soil soil = find_soil(options.soil, session.place.library);
  const compare::VirtualBevameter asked{.specimen = options.flags.specimen(grains_of(soil)),
                                        .plates = options.plates.plates(grains_of(soil)),
                                        .size = options.flags.size,
                                        .packings = options.packings,
                                        .how = options.flags.work()};
  dem::BedStore beds(folder_of_beds());
  const compare::BevameterReadings measured = compare::virtual_bevameter(grains_of(soil), asked, beds);
  const compare::BevameterFit fit = compare::fit_bevameter(measured.plates, measured.shear);
  clear_progress_line();
  const std::string source = fmt::format(
      "virtual bevameter on the grains of {}: {} round plates, ring with grousers, {} bed samples, settling friction "
      "{}",
      soil.name, asked.plates.diameters.size(), options.packings, number(asked.specimen.settling_friction));
  Outputs outputs = publish(compare::report_on(fit, measured, soil, options.packings), options.outputs, {}, session);
  outputs.file(options.output, [&] { return write_soil(with_bevameter(soil, fit, measured.density, source)); });
  return outputs.status(done);
}

}  // namespace

void add_bevameter(CLI::App& app, Session& session) {
  CLI::App* command =
      app.add_subcommand("bevameter", "n, k_c, k_phi, c, phi and K of a soil's grains, by simulated plates and a ring");
  const auto options = std::make_shared<BevameterOptions>();
  add_value(*command, "soil", options->soil, "SOIL", "a soil of the library, or a YAML file")->required();
  add_file(*command, "--output", options->output, "FILE.yaml", "save the soil with these values");
  add_value(*command, "--packings", options->packings, "N", "number of beds, 2; their scatter is the error")
      ->check(whole_number(1, compare::most_packings));
  options->outputs.add_to(
      *command, {.json = "soilbin-bevameter/1, in SI", .plot = "draw the curves (points) and the fit (lines)"});
  options->flags.add_to(*command);
  options->plates.add_to(*command);
  command->footer("Example: soilbin bevameter paper-sand --settling-friction 0 --output paper-sand-dense.yaml");
  command->callback([=, &session] { session.action = [=, &session] { return bevameter(*options, session); }; });
}

}  // namespace soilbin::cli
