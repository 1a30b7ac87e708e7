// soilbin export: answers and soils as other programs read them.
#include <fmt/core.h>

#include <memory>
#include <vector>

#include "cli/commands.hpp"
#include "cli/flag_values.hpp"
#include "cli/outputs.hpp"
#include "cli/progress.hpp"
#include "cli/question.hpp"
#include "compare/doubts/doubts.hpp"
#include "compare/experiments/force_table_file.hpp"
#include "compare/export/wheel_fmu.hpp"
#include "compare/export/wheel_slip.hpp"
#include "compare/report/json_fields.hpp"
#include "compare/telling/reports.hpp"
#include "scenario/errors.hpp"
#include "scenario/source_text.hpp"

namespace soilbin::cli {
namespace {

struct TableOptions {
  OutputFlags outputs;
  std::string hdf5, header, fmu;
  QuickModelFlag model;
  TireFlags tire;
};

struct AskedTable {
  compare::ForceTable table;
  compare::Doubts doubts;
};

AskedTable ask_table(const Question& inputs, const TableOptions& options, const Session& session) {
  Case question = inputs.ask(session.place);
  options.model.apply(question, inputs.names_effects());
  require_semi_empirical(question, session.place.library);
  compare::Doubts notes = options.tire.apply(question, inputs.switches_effects_off());
  AskedTable asked{compare::force_table(std::move(question), shown_progress()), {}};
  asked.doubts = joined_doubts(std::move(notes), asked.table.question, {asked.table.nodes});
  return asked;
}

int export_table(const Question& inputs, const TableOptions& options, const Session& session) {
  const auto [table, doubts] = ask_table(inputs, options, session);
  compare::Report report = compare::report_on(table);
  report.resolved_case = write_case(table.question, session.place.effects);
  Outputs outputs = publish(report, options.outputs, doubts, session);
  outputs.file(options.hdf5, [&, &made = table] {
    return compare::hdf5_of(made,
                            {.name = options.hdf5, .version = SOILBIN_VERSION, .resolved_case = report.resolved_case});
  });
  outputs.file(options.header, [&, &made = table] {
    return compare::c_header_of(made, {.name = compare::c_name_of(options.header), .version = SOILBIN_VERSION});
  });
  return outputs.status(done);
}

int export_fmi(const Question& inputs, const TableOptions& options, const Session& session) {
  AskedTable asked = ask_table(inputs, options, session);
  const std::string name = compare::c_name_of(options.fmu.empty() ? "wheel.fmu" : options.fmu);
  const compare::WheelFmu fmu = compare::wheel_fmu(std::move(asked.table), {.name = name, .version = SOILBIN_VERSION});
  const compare::CompiledC compiled = compare::compiled_by_cc(compare::files_in_c(fmu), name + ".c");
  if (interrupt_asked()) throw Interrupted();
  compare::Report report = compare::report_on(fmu, compiled);
  report.resolved_case = write_case(fmu.table.question, session.place.effects);
  Outputs outputs = publish(report, options.outputs, asked.doubts, session);
  outputs.file(options.fmu, [&] { return compare::packed_fmu(fmu, compiled.library, report.resolved_case); });
  return outputs.status(done);
}

struct ScmOptions {
  std::string soil, output;
  OutputFlags outputs;
};

int export_scm(const ScmOptions& options, const Session& session) {
  const Soil soil = find_soil(options.soil, session.place.library);
  if (!soil.semi_empirical)
    throw InputError(
        fmt::format("soil '{}' has no semi_empirical values, which SCM is made of\n"
                    "  hint: soilbin list soils says which have; soilbin bevameter finds those of grains",
                    clipped(soil.name)));
  const compare::Report report = compare::report_on_scm(soil, SOILBIN_VERSION);
  Outputs outputs = publish(report, options.outputs, compare::doubts(soil), session);
  outputs.file(options.output, [&] { return compare::json_text(report.data()); });
  return outputs.status(done);
}

void add_scm(CLI::App& app, Session& session) {
  CLI::App* command =
      app.add_subcommand("scm", "a soil as Chrono's SCM terrain reads it, and which of our effects that lacks");
  const auto options = std::make_shared<ScmOptions>();
  add_value(*command, "soil", options->soil, "SOIL", "a soil of the library, or a file")->required();
  add_file(*command, "--output", options->output, "FILE.json", "save the file that Chrono reads");
  options->outputs.add_to(*command, {.json = "what --output saves"});
  command->footer(
      "Each --soil takes the file too: soilbin estimate --soil scm.json ...\n"
      "Example: soilbin export scm dry-sand --output scm.json");
  command->callback([=, &session] { session.action = [=, &session] { return export_scm(*options, session); }; });
}

struct GazeboOptions {
  OutputFlags outputs;
  TireFlags tire;
  std::string map, map_size;
  std::vector<std::string> map_soils;
  bool wants_map() const { return !map.empty() || !map_soils.empty(); }
};

int export_gazebo(const Question& inputs, const GazeboOptions& options, const Session& session) {
  Case question = inputs.ask(session.place);
  require_semi_empirical(question, session.place.library);
  compare::Doubts notes = options.tire.apply(question, inputs.switches_effects_off());
  if (!options.map_size.empty() && !options.wants_map())
    throw InputError("--map-size means nothing without a map\n  hint: --map FILE.png");
  compare::SlipMapSize size;
  set_where_given("--map-size", options.map_size, {"m", above_zero}, size.size);
  const compare::WheelSlipFit fit = compare::wheel_slip_of(std::move(question));
  std::vector<Soil> others;
  for (const std::string& name : options.map_soils) others.push_back(find_soil(name, session.place.library));
  compare::SlipMap map;
  if (options.wants_map()) map = slip_map(fit, others, size);
  compare::Report report = options.wants_map()
                               ? compare::report_on(fit, map, options.map.empty() ? "slip_map.png" : options.map)
                               : compare::report_on(fit);
  report.resolved_case = write_case(fit.question, session.place.effects);
  Outputs outputs =
      publish(report, options.outputs, joined_doubts(std::move(notes), fit.question, fit.answers), session);
  outputs.file(options.map, [&] { return compare::rgb_png(compare::picture_of(map)); });
  return outputs.status(done);
}

void add_gazebo(CLI::App& app, Session& session) {
  CLI::App* command = app.add_subcommand(
      "gazebo", "slip compliance and friction of a wheel for Gazebo's plugin WheelSlip, fitted to its curves");
  const auto inputs = std::make_shared<Question>(*command);
  const auto options = std::make_shared<GazeboOptions>();
  options->tire.add_to(*command);
  const char* map_group = "Map of soils, for the plugin LookupWheelSlip";
  add_file(*command, "--map", options->map, "FILE.png", "save the map: the soil, then each --map-soil, in stripes")
      ->group(map_group);
  add_repeatable(*command, "--map-soil", options->map_soils, "SOIL", "another soil of the map; repeatable")
      ->group(map_group);
  add_value(*command, "--map-size", options->map_size, "LENGTH", "side of the map's square on the ground; 10 m")
      ->group(map_group);
  options->outputs.add_to(*command, {.json = "soilbin-wheel-slip/1, in SI"});
  command->footer(
      "The longitudinal line is fitted at slips up to 60 %, the lateral one at the slip that is given.\n"
      "Example: soilbin export gazebo --soil dry-sand --tire rover-wheel --load 65N --slip 20%\n"
      "         --map map.png --map-soil lunar-regolith");
  command->callback(
      [=, &session] { session.action = [=, &session] { return export_gazebo(*inputs, *options, session); }; });
}

void add_table(CLI::App& app, Session& session) {
  CLI::App* command = app.add_subcommand(
      "table", "forces on a grid of load, slip, yaw and slopes, with a measured error of the interpolation");
  const auto inputs = std::make_shared<Question>(*command);
  const auto options = std::make_shared<TableOptions>();
  options->model.add_to(*command);
  options->tire.add_to(*command);
  add_file(*command, "--header", options->header, "FILE.h", "save one file of C with the table and its look-up");
  add_file(*command, "--hdf5", options->hdf5, "FILE.h5", "save the table as HDF5");
  options->outputs.add_to(*command, {.json = "soilbin-force-table/1, in SI", .csv = "save the table, a line a node"});
  command->footer(
      "The table runs over each condition that has several values, in every combination.\n"
      "Example: soilbin export table --soil dry-sand --tire rover-wheel --load 40N..120N:10N --slip 0%..60%:5%\n"
      "         --header rover.h --csv rover.csv");
  command->callback(
      [=, &session] { session.action = [=, &session] { return export_table(*inputs, *options, session); }; });
}

void add_fmi(CLI::App& app, Session& session) {
  CLI::App* command = app.add_subcommand(
      "fmi", "a driven wheel as a co-simulation unit of FMI 2.0: its equations of motion over a table of forces");
  const auto inputs = std::make_shared<Question>(*command);
  const auto options = std::make_shared<TableOptions>();
  options->model.add_to(*command);
  options->tire.add_to(*command);
  add_file(*command, "--output", options->fmu, "FILE.fmu", "save the unit, compiled where the machine has 'cc'");
  options->outputs.add_to(*command, {.json = "soilbin-fmu/1, in SI", .csv = "save the table, a line a node"});
  command->footer(
      "The table runs over slip from 0 % on; each other condition with several values becomes an input of the unit.\n"
      "Example: soilbin export fmi --soil dry-sand --tire rover-wheel --load 40N..120N:10N --slip 0%..80%:5%\n"
      "         --output rover.fmu");
  command->callback(
      [=, &session] { session.action = [=, &session] { return export_fmi(*inputs, *options, session); }; });
}

}  // namespace

void add_export(CLI::App& app, Session& session) {
  CLI::App* command = app.add_subcommand("export", "answers and soils as other programs read them");
  command->require_subcommand(1);
  add_table(*command, session);
  add_scm(*command, session);
  add_gazebo(*command, session);
  add_fmi(*command, session);
}

}  // namespace soilbin::cli
