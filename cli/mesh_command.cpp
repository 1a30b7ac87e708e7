// soilbin mesh: what is in a drawing of a wheel, and what is mended before grains meet it.

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "cli/commands.hpp"
#include "cli/flag_values.hpp"
#include "cli/outputs.hpp"
#include "compare/telling/reports.hpp"
#include "dem/surface/drawn_wheel.hpp"
#include "scenario/case.hpp"

namespace soilbin::cli {
namespace {

struct AskedMesh {
  std::string file, tire, unit;
  OutputFlags outputs;
};

dem::DrawnWheel wheel_in(const AskedMesh& options, const Session& session) {
  if (!options.tire.empty()) return dem::read_wheel(options.file, find_tire(options.tire, session.place.library));
  std::optional<dem::LengthUnit> unit;
  for (const dem::LengthUnit& one : dem::drawing_units)
    if (options.unit == one.name) unit = one;
  return dem::read_wheel(options.file, unit);
}

int mesh(const AskedMesh& options, const Session& session) {
  const dem::DrawnWheel wheel = wheel_in(options, session);
  const std::string name = std::filesystem::path(options.file).filename().string();
  return publish(compare::report_on(wheel, name), options.outputs, {}, session).status(done);
}

}  // namespace

void add_mesh(CLI::App& app, Session& session) {
  CLI::App* command =
      app.add_subcommand("mesh", "what is in a drawing of a wheel, and what is mended in it for --wheel-mesh");
  const auto options = std::make_shared<AskedMesh>();
  add_value(*command, "file", options->file, "FILE.stl|obj", "the drawing")->required();
  add_value(*command, "--tire", options->tire, "NAME|FILE",
            "the tire that it is to be: its size says the unit, and a drawing of another size is refused");
  std::vector<std::string> units;
  for (const dem::LengthUnit& unit : dem::drawing_units) units.emplace_back(unit.name);
  add_value(*command, "--unit", options->unit, "mm|m|cm|inch",
            "unit of the drawing; the first of these that makes its radius 10 mm to 3 m")
      ->check(CLI::IsMember(units))
      ->excludes("--tire");
  options->outputs.add_to(*command,
                          {.json = "soilbin-mesh/1, in SI",
                           .plot = "draw the wheel from the side and from the front, and where it was mended"});
  command->footer("Example: soilbin mesh wheel.stl --plot wheel.svg");
  command->callback([=, &session] { session.action = [=, &session] { return mesh(*options, session); }; });
}

}  // namespace soilbin::cli
