// soilbin init: a commented case to start from.
#include <fmt/core.h>

#include <filesystem>
#include <memory>
#include <optional>

#include "cli/commands.hpp"
#include "scenario/atomic_file.hpp"
#include "scenario/errors.hpp"

namespace soilbin::cli {
namespace {

namespace fs = std::filesystem;

constexpr const char* starter_case =
    R"yaml(# A case is a question: this tire, on this soil, at these conditions, answered by these models.
# Try it:   soilbin check case.yaml
#           soilbin run case.yaml --plot curves.svg
#           soilbin explain case.yaml --load 80N --slip 20%
# Every number carries its unit. What there is to choose from: soilbin list tires|soils|effects.
format: soilbin-case/1
name: my-first-case
description: A small smooth wheel on dry sand

tire:                     # or a name of the library, e.g.  tire: rover-wheel
  name: my-wheel
  radius: 110 mm          # to the tread base, without lugs
  width: 100 mm
  # lugs: {height: 8 mm, count: 24}
  # inflation_pressure: 150 kPa      # absent: a rigid wheel

soil: dry-sand            # of the library; or write one out, with value, sd and source for each number

study:
  models:
    - bekker_wong                                        # the base model: no effect
    - {model: bekker_wong, effects: [slip_sinkage]}      # the same wheel, digging itself in as slip grows
  conditions:             # every combination of the values below
    load: [40 N, 80 N]
    slip: {from: 0 %, to: 60 %, step: 10 %}
    # yaw: 10 deg                      # the wheel points to the left of its travel
    # longitudinal_incline: 5 deg      # uphill
    # transverse_incline: 5 deg        # left side up
)yaml";

int init(const std::string& folder, const Session&) {
  const fs::path file = fs::path(folder) / "case.yaml";
  std::error_code error;
  if (fs::exists(fs::symlink_status(file, error)))
    throw InputError(file.string() + " is there already and stays as it is; name another folder: soilbin init DIR");
  if (fs::exists(folder, error) && !fs::is_directory(folder, error))
    throw InputError(folder + " is a file; a folder is expected");
  const std::optional<fs::path> schema = schema_file("case");
  write_file_atomically(
      file, (schema ? fmt::format("# yaml-language-server: $schema={}\n", schema->string()) : "") + starter_case);
  fmt::print("wrote {}\nnext: soilbin run {}\n", file.string(), file.string());
  return done;
}

}  // namespace

void add_init(CLI::App& app, Session& session) {
  CLI::App* command = app.add_subcommand("init", "write a commented case to start from; never overwrites");
  const auto folder = std::make_shared<std::string>(".");
  command->add_option("folder", *folder, "made where it is missing; by default this one")->type_name("DIR");
  command->callback([=, &session] { session.action = [=, &session] { return init(*folder, session); }; });
}

}  // namespace soilbin::cli
