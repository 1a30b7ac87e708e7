#include "compare/export/wheel_fmu.hpp"

#include <fmt/core.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "compare/sweep/varying.hpp"
#include "scenario/checksum.hpp"
#include "scenario/drive.hpp"
#include "scenario/errors.hpp"
#include "scenario/markup.hpp"

namespace soilbin::compare {
namespace {

using FmuRole = FmuVariable::Role;

const TableAxis& slip_axis(const ForceTable& table) {
  for (const TableAxis& axis : table.axes)
    if (axis.view->name == "slip") {
      if (axis.nodes.front() <= 0.0 && axis.nodes.back() > 0.0) return axis;
      throw InputError(
          "the wheel starts at rest: its table's slips begin at 0 % or below\n  hint: --slip 0%..60%:5%, or "
          "--slip -30%..80%:5% for one that brakes too");
    }
  throw InputError("the wheel's slip follows from its motion: its table runs over slip\n  hint: --slip 0%..60%:5%");
}

const TableAxis* axis_named(const ForceTable& table, std::string_view name) {
  const auto found = std::ranges::find_if(table.axes, [&](const TableAxis& axis) { return axis.view->name == name; });
  return found == table.axes.end() ? nullptr : &*found;
}

const TableChannel* channel_named(const ForceTable& table, std::string_view name) {
  const auto found =
      std::ranges::find_if(table.channels, [&](const TableChannel& channel) { return channel.channel->name == name; });
  return found == table.channels.end() ? nullptr : &*found;
}

/// "N.m", "1": a unit as the standard writes it.
std::string fmi_unit(std::string unit) {
  if (unit == "-") return "1";
  std::ranges::replace(unit, ' ', '.');
  return unit;
}

/// What an input begins with: level and straight, else a value in the middle.
double axis_start(const TableAxis& axis) {
  const std::string_view name = axis.view->name;
  if (name == "yaw" || name.ends_with("incline")) return std::clamp(0.0, axis.nodes.front(), axis.nodes.back());
  return axis.nodes[axis.nodes.size() / 2];
}

double load_at_start(const ForceTable& table) {
  const TableAxis* load = axis_named(table, "load");
  return load == nullptr ? table.fixed.load : axis_start(*load);
}

std::vector<FmuVariable> variables_of(const ForceTable& table) {
  const Tire& tire = table.question.scenario.tire;
  const double gravity = gravity_of(table.question.scenario.soil);
  const Drive drive{.load = load_at_start(table)};
  std::vector<FmuVariable> all = {
      {"motor_torque", FmuRole::input, "N.m", "of the motor on the wheel; unused where spin_is_given", 0.0},
      {"given_spin", FmuRole::input, "rad/s", "angular speed that is held where spin_is_given", 0.0},
      {"drawbar_load", FmuRole::input, "N", "what the wheel pulls against its travel", 0.0}};
  for (const TableAxis& axis : table.axes)
    if (axis.view->name != "slip")
      all.push_back({std::string(axis.view->name), FmuRole::input, fmi_unit(si_unit_of(*axis.view)),
                     std::string(axis.view->title) + ", of the table", axis_start(axis)});
  all.push_back({"mass", FmuRole::parameter, "kg", "that travels with the wheel", mass_of(drive, gravity)});
  all.push_back({"inertia", FmuRole::parameter, "kg.m2", "of what spins, about the axle",
                 inertia_of(drive, tire.radius, gravity)});
  const auto output = [&](std::string name, const char* unit, std::string meaning) {
    all.push_back({std::move(name), FmuRole::output, unit, std::move(meaning)});
  };
  output("travelled", "m", "way along the ground");
  output("speed", "m/s", "of travel");
  output("spin", "rad/s", "angular speed of the wheel");
  output("slip", "1", "(r w - v)/max(|r w|, |v|); 0 while the wheel all but stands");
  output("contact_slip", "1", "slip that the soil under the wheel has seen: the table is asked there");
  for (const TableChannel& channel : table.channels)
    all.push_back({std::string(channel.channel->name), FmuRole::output, fmi_unit(std::string(channel.channel->si_unit)),
                   channel.channel->name == "torque" ? "about the axle, that the motor works against"
                                                     : std::string(channel.channel->title)});
  for (const TableChannel& channel : table.channels)
    all.push_back({std::string(channel.channel->name) + "_std_error", FmuRole::output,
                   fmi_unit(std::string(channel.channel->si_unit)),
                   "of " + std::string(channel.channel->title) + ", from the soil's standard deviations"});
  output("power", "W", "of the motor");
  return all;
}

/// As relaxation_length of the source [m].
double relaxation_length(double sinkage, double radius) {
  return 0.5 * radius * std::acos(1.0 - std::clamp(sinkage / radius, 0.0002, 1.0));
}

/// The steepest change of a channel with slip anywhere in the table, and the shortest relaxation length.
struct TableStiffness {
  double pull = 0.0, torque = 0.0;  ///< [N, N m] for a slip of 1
  double shortest = 0.0;            ///< [m]
};

TableStiffness stiffness_of(const ForceTable& table) {
  TableStiffness found;
  const auto slip = static_cast<std::size_t>(&slip_axis(table) - table.axes.data());
  std::size_t stride = 1;
  for (std::size_t k = slip + 1; k < table.axes.size(); ++k) stride *= table.axes[k].nodes.size();
  const std::vector<double>& slips = table.axes[slip].nodes;
  const auto steepest = [&](const TableChannel& channel) {
    double most = 0.0;
    for (std::size_t node = 0; node + stride < channel.values.size(); ++node) {
      const std::size_t along = node / stride % slips.size();
      if (along + 1 == slips.size()) continue;
      const double rise =
          std::abs(channel.values[node + stride] - channel.values[node]) / (slips[along + 1] - slips[along]);
      if (std::isfinite(rise)) most = std::max(most, rise);
    }
    return most;
  };
  found.pull = steepest(*channel_named(table, "drawbar_pull"));
  found.torque = steepest(*channel_named(table, "torque"));
  double least = table.question.scenario.tire.radius;
  for (const double sinkage : channel_named(table, "sinkage")->values)
    if (std::isfinite(sinkage)) least = std::min(least, sinkage);
  found.shortest = relaxation_length(least, table.question.scenario.tire.radius);
  return found;
}

/// What the source says of this table, before the equations.
std::string source_head(const WheelFmu& fmu, const TableStiffness& stiffness) {
  const ForceTable& table = fmu.table;
  std::vector<std::string> places, roles, starts, names, values, asked;
  for (const FmuVariable& variable : fmu.variables) {
    places.push_back("V_" + variable.name);
    roles.push_back(variable.role == FmuRole::input ? "'i'" : variable.role == FmuRole::parameter ? "'p'" : "'o'");
    starts.push_back(fmt::format("{:.17g}", variable.start.value_or(0.0)));
  }
  for (const TableAxis& axis : table.axes) {
    const std::string name(axis.view->name);
    names.push_back('"' + name + '"');
    values.push_back(name == "slip" ? "-1" : "V_" + name);
    asked.push_back(name == "slip" ? "(slip)" : "(real)[V_" + name + "]");
  }
  const auto input_or = [&](const char* name, double fixed) {
    return axis_named(table, name) != nullptr ? fmt::format("((real)[V_{}])", name) : fmt::format("({:.17g})", fixed);
  };
  std::string told;
  for (const TableChannel& channel : table.channels)
    told += fmt::format(" \\\n  (real)[V_{0}] = (at).{0}, (real)[V_{0}_std_error] = (at).{0}_std_error{1}",
                        channel.channel->name, &channel == &table.channels.back() ? "" : ",");
  const bool in_plane = table.fixed.slip_by == SlipBy::wheel_plane_speed;
  std::string text = fmt::format(
      "/* A driven wheel on soft soil as a co-simulation unit of FMI 2.0, written by soilbin {} (soilbin export fmi).\n"
      " * Tire, soil, model, source of each value, range and errors of its table: {}.h.\n *\n"
      " *   m dv/dt = P - D,  I dw/dt = M_motor - M,  l dk/dt = r w - v - max(|r w|, |v|) k,  l = r/2 acos(1 - z/r)\n "
      "*\n"
      " * P, M and z are the table's at the slip k of the contact; steady, k is the slip of the wheel. At rest what "
      "the\n"
      " * table has at no slip does not act; it comes up over 0.4 l. Forces are taken at k + t dk/dt, t of a "
      "fifth\n"
      " * of the critical damping. Outside the table fmi2DoStep uses its nearest values, returns fmi2Warning and logs "
      "why;\n"
      " * where the table has no answer it returns fmi2Error and the wheel stays as it was.\n"
      " * Compile: cc -std=c99 -O2 -fPIC -shared -fvisibility=hidden -o {}.so {}.c -lm\n */\n"
      "#include <math.h>\n#include <stddef.h>\n#include <stdio.h>\n#include <stdlib.h>\n#include <string.h>\n"
      "#include \"{}.h\"\n\n",
      fmu.version, fmu.name, fmu.name, fmu.name, fmu.name);
  for (const char* member : {"lookup", "answer", "nodes", "sizes", "NO_ANSWER"})
    text += fmt::format("#define TABLE_{0} {1}_{0}\n", member, fmu.name);
  text += fmt::format(
      "#define FMU_GUID \"{}\"\n/* Their places are the value references of modelDescription.xml. */\n"
      "enum {{ {}, REALS }};\nenum {{ V_SPIN_IS_GIVEN = REALS, V_OUTSIDE = REALS + 1 }};\n"
      "static const char roles[REALS] = {{{}}}; /* input, parameter, output */\n"
      "static const double starts[REALS] = {{{}}};\n",
      fmu.guid, fmt::join(places, ", "), fmt::join(roles, ", "), fmt::join(starts, ", "));
  text += fmt::format(
      "enum {{ AXES = {} }};\nstatic const char *const axis_names[AXES] = {{{}}};\n"
      "static const int axis_values[AXES] = {{{}}}; /* -1: the slip of the contact */\n",
      table.axes.size(), fmt::join(names, ", "), fmt::join(values, ", "));
  text += fmt::format(
      "#define RADIUS {:.17g}\n#define STIFFEST_PULL {:.9g}\n#define STIFFEST_TORQUE {:.9g}\n"
      "#define SHORTEST_RELAXATION {:.9g}\n",
      table.question.scenario.tire.radius, stiffness.pull, stiffness.torque, stiffness.shortest);
  text += fmt::format("#define LOAD(real) {}\n#define INCLINE(real) {}\n#define IN_PLANE(real) {}\n",
                      input_or("load", table.fixed.load),
                      input_or("longitudinal_incline", table.fixed.longitudinal_incline),
                      in_plane ? "cos(" + input_or("yaw", table.fixed.yaw) + ")" : "1.0");
  text +=
      fmt::format("#define LOOK_UP(real, slip, answer) TABLE_lookup({}, answer)\n#define TELL_CHANNELS(real, at){}\n",
                  fmt::join(asked, ", "), told);
  return text;
}

std::string unit_definition(const std::string& unit) {
  struct Base {
    const char *unit, *exponents;
  };
  constexpr Base known[] = {{"N", R"(kg="1" m="1" s="-2")"},
                            {"N.m", R"(kg="1" m="2" s="-2")"},
                            {"m", R"(m="1")"},
                            {"m/s", R"(m="1" s="-1")"},
                            {"rad", R"(rad="1")"},
                            {"rad/s", R"(rad="1" s="-1")"},
                            {"kg", R"(kg="1")"},
                            {"kg.m2", R"(kg="1" m="2")"},
                            {"Pa", R"(kg="1" m="-1" s="-2")"},
                            {"W", R"(kg="1" m="2" s="-3")"}};
  for (const Base& base : known)
    if (unit == base.unit) return fmt::format("    <Unit name=\"{}\"><BaseUnit {}/></Unit>\n", unit, base.exponents);
  return fmt::format("    <Unit name=\"{}\"/>\n", unit);
}

std::string scalar_variable(const FmuVariable& variable, std::size_t place) {
  const char* how = variable.role == FmuRole::input    ? R"(causality="input" variability="continuous")"
                    : variable.role == FmuRole::output ? R"(causality="output" variability="continuous")"
                                                       : R"(causality="parameter" variability="fixed" initial="exact")";
  const std::string start = variable.start ? fmt::format(" start=\"{:.17g}\"", *variable.start) : "";
  return fmt::format(
      "    <ScalarVariable name=\"{}\" valueReference=\"{}\" description=\"{}\" {}>\n"
      "      <Real unit=\"{}\"{}/>\n    </ScalarVariable>\n",
      escaped(variable.name), place, escaped(variable.meaning), how, escaped(variable.unit), start);
}

std::string unknowns(const char* element, const std::vector<std::size_t>& indices) {
  std::string text = fmt::format("    <{}>\n", element);
  for (const std::size_t index : indices) text += fmt::format("      <Unknown index=\"{}\"/>\n", index);
  return text + fmt::format("    </{}>\n", element);
}

std::string description_of(const WheelFmu& fmu) {
  const Scenario& scenario = fmu.table.question.scenario;
  std::string units, variables;
  std::vector<std::string> seen;
  std::vector<std::size_t> outputs;
  for (std::size_t place = 0; place < fmu.variables.size(); ++place) {
    const FmuVariable& variable = fmu.variables[place];
    variables += scalar_variable(variable, place);
    if (variable.role == FmuRole::output) outputs.push_back(place + 1);
    if (std::ranges::find(seen, variable.unit) != seen.end()) continue;
    seen.push_back(variable.unit);
    units += unit_definition(variable.unit);
  }
  const std::size_t flag = fmu.variables.size(), outside = flag + 1;
  variables += fmt::format(
      "    <ScalarVariable name=\"spin_is_given\" valueReference=\"{}\" description=\"the wheel turns with given_spin, "
      "in "
      "place of by motor_torque\" causality=\"parameter\" variability=\"fixed\" initial=\"exact\">\n"
      "      <Boolean start=\"false\"/>\n    </ScalarVariable>\n"
      "    <ScalarVariable name=\"outside\" valueReference=\"{}\" description=\"0 where the last step stayed in the "
      "table, "
      "else a bit for each axis that it left, in the order of the table, and one more for rolling backward\" "
      "causality=\"output\" variability=\"discrete\">\n      <Integer/>\n    </ScalarVariable>\n",
      flag, outside);
  outputs.push_back(outside + 1);
  return fmt::format(
             "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<fmiModelDescription fmiVersion=\"2.0\" modelName=\"{0}\" "
             "guid=\"{1}\" description=\"{2}\" version=\"{3}\" generationTool=\"soilbin {3}\" "
             "variableNamingConvention=\"flat\">\n"
             "  <CoSimulation modelIdentifier=\"{0}\" canHandleVariableCommunicationStepSize=\"true\" "
             "canNotUseMemoryManagementFunctions=\"true\" canGetAndSetFMUstate=\"true\" "
             "canSerializeFMUstate=\"true\">\n"
             "    <SourceFiles><File name=\"{0}.c\"/></SourceFiles>\n  </CoSimulation>\n",
             fmu.name, fmu.guid,
             escaped(fmt::format("{} on {}, by {}", in_words(scenario.tire), in_words(scenario.soil),
                                 fmu.table.nodes.choice.label)),
             escaped(fmu.version)) +
         "  <UnitDefinitions>\n" + units + "  </UnitDefinitions>\n" +
         "  <LogCategories>\n    <Category name=\"logStatusWarning\" description=\"the wheel has left the table\"/>\n"
         "    <Category name=\"logStatusError\"/>\n  </LogCategories>\n"
         "  <DefaultExperiment startTime=\"0\" stopTime=\"10\" stepSize=\"0.01\"/>\n  <ModelVariables>\n" +
         variables + "  </ModelVariables>\n  <ModelStructure>\n" + unknowns("Outputs", outputs) +
         unknowns("InitialUnknowns", outputs) + "  </ModelStructure>\n</fmiModelDescription>\n";
}

/// 32 digits of all that the unit holds, as people write a GUID.
std::string guid_of(const std::string& text) {
  const std::string digits = fnv1a_digits(text) + fnv1a_digits("soilbin" + text);
  return fmt::format("{{{}-{}-{}-{}-{}}}", digits.substr(0, 8), digits.substr(8, 4), digits.substr(12, 4),
                     digits.substr(16, 4), digits.substr(20));
}

}  // namespace

WheelFmu wheel_fmu(ForceTable table, const CHeaderAbout& about) {
  slip_axis(table);
  if (axis_named(table, "speed") != nullptr)
    throw InputError("the wheel's speed follows from its motion: leave --speed out, or give one");
  if (table.fixed.force_frame != ForceFrame::travel)
    throw InputError("the wheel's motion takes forces along its travel: leave --force-frame out");
  for (const char* name : {"drawbar_pull", "torque", "sinkage"})
    if (channel_named(table, name) == nullptr)
      throw InputError(
          fmt::format("the wheel's motion needs '{}', which the model '{}' does not answer\n"
                      "  hint: --model bekker_wong or rft",
                      name, table.nodes.choice.label));
  WheelFmu fmu;
  fmu.table = std::move(table), fmu.name = about.name, fmu.version = about.version;
  fmu.variables = variables_of(fmu.table);
  fmu.header = c_header_of(fmu.table, about);
  const TableStiffness stiffness = stiffness_of(fmu.table);
  const auto written = [&] {
    fmu.description = description_of(fmu);
    fmu.source = source_head(fmu, stiffness) + wheel_in_c;
  };
  written();
  fmu.guid = guid_of(fmu.description + fmu.source + fmu.header);
  written();
  const auto start = [&](const char* name) {
    return *std::ranges::find(fmu.variables, name, &FmuVariable::name)->start;
  };
  fmu.rest_frequency = std::sqrt(
      (stiffness.pull / start("mass") + stiffness.torque * fmu.table.question.scenario.tire.radius / start("inertia")) /
      stiffness.shortest);
  return fmu;
}

std::vector<PackedFile> files_in_c(const WheelFmu& fmu) {
  return {{fmu.name + ".c", fmu.source}, {fmu.name + ".h", fmu.header}};
}

/// The folder for a library: by FMI 2.0 linux64 is x86-64, and other machines have the names of FMI 3.0. The machine
/// stands in the ELF header at byte 18.
static std::string platform_of(const std::string& library) {
  constexpr std::size_t machine = 18;
  const int number = library.size() > machine ? static_cast<unsigned char>(library[machine]) : 0;
  return number == 183 ? "aarch64-linux" : number == 243 ? "riscv64-linux" : "linux64";
}

std::string packed_fmu(const WheelFmu& fmu, const std::optional<std::string>& library,
                       const std::string& resolved_case) {
  std::vector<PackedFile> files = {{"modelDescription.xml", fmu.description}, {"resources/case.yaml", resolved_case}};
  for (PackedFile& file : files_in_c(fmu)) files.push_back({"sources/" + file.name, std::move(file.content)});
  if (library) files.push_back({"binaries/" + platform_of(*library) + "/" + fmu.name + ".so", *library});
  return zip_of(files);
}

}  // namespace soilbin::compare
