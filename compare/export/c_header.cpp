// A force table as one file of C. The look-up in it and look_up() of force_table.cpp are one algorithm in two
// languages; tests compile the former and compare.
#include <fmt/core.h>
#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>

#include "compare/export/force_table.hpp"
#include "compare/report/number_text.hpp"
#include "compare/sweep/explanation.hpp"
#include "compare/sweep/varying.hpp"

namespace soilbin::compare {
namespace {

std::string c_number(double value) { return std::isfinite(value) ? fmt::format("{:.9g}", value + 0.0) : "NAN"; }

/// Text that can't end a comment.
std::string in_comment(std::string text) {
  for (std::size_t at; (at = text.find("*/")) != text.npos;) text.replace(at, 2, "* /");
  std::ranges::replace(text, '\n', ' ');
  return text;
}

/// "load: 50 .. 200 N, 16 nodes".
std::string axis_in_words(const TableAxis& axis) {
  const std::string unit = unit_behind(axis.view->unit.empty() ? "-" : axis.view->unit);
  return fmt::format("{}: {:.6g} .. {:.6g}{}, {} nodes", axis.view->name, axis.nodes.front() * axis.view->per_si,
                     axis.nodes.back() * axis.view->per_si, unit, axis.nodes.size());
}

/// Lines of the opening comment.
std::string provenance_of(const ForceTable& table, const CHeaderAbout& about) {
  const Scenario& scenario = table.question.scenario;
  std::string text = fmt::format(
      "/* Forces of a wheel on soft soil as a table, written by soilbin {} (soilbin export table).\n *\n * tire:  {}\n"
      " * soil:  {}\n * model: {}\n",
      about.version, in_comment(in_words(scenario.tire)), in_comment(in_words(scenario.soil)),
      in_comment(table.nodes.choice.label));
  for (const EffectChoice& effect : table.nodes.choice.effects) {
    text += fmt::format(" *   {}:{}", effect.id, effect.form);
    for (const auto& [name, value] : effect.parameters) text += fmt::format(", {} = {:.6g} (SI)", name, value);
    text += "\n";
  }
  for (const SourcedValue& value : sourced_values(scenario))
    text += fmt::format(" *   {} {}: {} [{}]\n", value.of, value.key, in_comment(in_words(value)),
                        in_comment(value.source));
  text += " *\n * Range:\n";
  for (const TableAxis& axis : table.axes) text += fmt::format(" *   {}\n", axis_in_words(axis));
  text += fmt::format(
      " * The first node, and what is the same at all: {}\n *\n * Largest and root mean square error of the "
      "interpolation against the model, in the middles of {} cells:\n",
      in_comment(in_words(table.fixed)), table.cells);
  for (const TableChannel& channel : table.channels)
    text += fmt::format(" *   {}: {:.3g}, {:.3g} {}; the largest value is {:.4g}\n", channel.channel->name,
                        channel.largest_error, channel.rms_error, channel.channel->si_unit, channel.scale);
  if (table.without_answer > 0)
    text += fmt::format(" * {} of {} nodes have no answer of the model.\n", table.without_answer,
                        table.nodes.answers.size());
  return text;
}

/// The code of every table: NAME is its name, ARGUMENTS and PLACE what its function takes.
constexpr const char* look_up_in_c = R"(
/* Multilinear between the nodes. Outside the range: the values at the nearest place within it, and NAME_CLAMPED.
 * NAME_NO_ANSWER, and NAN in every value: the place is not a number, or the model has no answer at a corner. */
static inline int NAME_lookup(ARGUMENTS, NAME_answer *answer) {
  const double at[NAME_axes] = {PLACE};
  double sums[NAME_numbers] = {0.0}, shares[NAME_axes];
  int cells[NAME_axes], status = NAME_OK, axis, corner, k;
  for (axis = 0; axis < NAME_axes; ++axis) {
    const double *nodes = NAME_nodes[axis];
    const int count = NAME_sizes[axis];
    double value = at[axis];
    int low = 0, high = count - 1;
    if (value != value) {
      for (k = 0; k < NAME_numbers; ++k) sums[k] = NAN;
      memcpy(answer, sums, sizeof sums);
      return NAME_NO_ANSWER;
    }
    if (value < nodes[0]) value = nodes[0], status = NAME_CLAMPED;
    if (value > nodes[count - 1]) value = nodes[count - 1], status = NAME_CLAMPED;
    while (high - low > 1) {
      const int middle = (low + high) / 2;
      if (nodes[middle] <= value) low = middle; else high = middle;
    }
    cells[axis] = low;
    shares[axis] = (value - nodes[low]) / (nodes[low + 1] - nodes[low]);
  }
  for (corner = 0; corner < (1 << NAME_axes); ++corner) {
    double weight = 1.0;
    long node = 0;
    for (axis = 0; axis < NAME_axes; ++axis) {
      const int upper = (corner >> axis) & 1;
      weight *= upper ? shares[axis] : 1.0 - shares[axis];
      node = node * NAME_sizes[axis] + cells[axis] + upper;
    }
    if (weight == 0.0) continue;
    for (k = 0; k < NAME_numbers; ++k) sums[k] += weight * NAME_table[node][k];
  }
  if (sums[0] != sums[0]) {
    for (k = 0; k < NAME_numbers; ++k) sums[k] = NAN;
    status = NAME_NO_ANSWER;
  }
  memcpy(answer, sums, sizeof sums);
  return status;
}

#ifdef __cplusplus
}
#endif
#endif
)";

std::string replaced(std::string text, const std::string& word, const std::string& by) {
  for (std::size_t at = 0; (at = text.find(word, at)) != text.npos; at += by.size()) text.replace(at, word.size(), by);
  return text;
}

}  // namespace

std::string si_unit_of(const ConditionView& view) {
  const std::string unit(view.column_unit);
  if (unit == "deg") return "rad";
  if (unit == "kPa") return "Pa";
  return unit == "%" ? "-" : unit;
}

std::string c_name_of(const std::string& file) {
  std::string name = file.substr(file.find_last_of('/') + 1);
  name = name.substr(0, name.find_last_of('.'));
  for (char& c : name)
    if (std::isalnum(static_cast<unsigned char>(c)) == 0) c = '_';
  if (name.empty() || std::isdigit(static_cast<unsigned char>(name.front())) != 0 || name.front() == '_')
    name = "table" + std::string(name.starts_with('_') ? "" : "_") + name;
  return name;
}

std::string c_header_of(const ForceTable& table, const CHeaderAbout& about) {
  const std::string& name = about.name;
  std::string capitals = name;
  std::ranges::transform(capitals, capitals.begin(), [](unsigned char c) { return std::toupper(c); });
  std::vector<std::string> arguments, places, units, sizes, pointers;
  std::string fields, lists, limits;
  for (const TableAxis& axis : table.axes) {
    const std::string key(axis.view->name);
    arguments.push_back("double " + key);
    places.push_back(key);
    units.push_back(fmt::format("{} [{}]", key, si_unit_of(*axis.view)));
    sizes.push_back(std::to_string(axis.nodes.size()));
    pointers.push_back(name + "_" + key);
    std::vector<std::string> nodes;
    for (const double node : axis.nodes) nodes.push_back(fmt::format("{:.17g}", node + 0.0));
    lists += fmt::format("static const double {}_{}[{}] = {{{}}};\n", name, key, nodes.size(), fmt::join(nodes, ", "));
  }
  const std::string place = fmt::format("{}", fmt::join(places, ", "));
  for (const char* suffix : {"", "_std_error"})
    for (const TableChannel& channel : table.channels)
      fields += fmt::format("  double {}{}; /* {}[{}] */\n", channel.channel->name, suffix,
                            *suffix == '\0' ? "" : "from the soil's standard deviations ", channel.channel->si_unit);
  for (const TableChannel& channel : table.channels) {
    std::string key(channel.channel->name);
    std::ranges::transform(key, key.begin(), [](unsigned char c) { return std::toupper(c); });
    limits += fmt::format("#define {0}_{1}_LARGEST_ERROR {2:.9g}\n#define {0}_{1}_RMS_ERROR {3:.9g}\n", capitals, key,
                          channel.largest_error, channel.rms_error);
  }
  std::string text = provenance_of(table, about);
  text += fmt::format(
      " *\n * {0}_lookup({1}, &answer) returns {0}_OK, {0}_CLAMPED or {0}_NO_ANSWER.\n * It takes {2}.\n"
      " * Signs: drawbar pull along travel, less the slope's share of the load; lateral force to the left of travel.\n"
      " * Not with -ffast-math, which takes NAN away.\n"
      " */\n#ifndef {3}_H\n#define {3}_H\n#include <math.h>\n#include <string.h>\n#ifdef __cplusplus\nextern \"C\" "
      "{{\n#endif\n\n",
      name, place, fmt::join(units, ", "), capitals);
  text += fmt::format("enum {{ {0}_OK = 0, {0}_CLAMPED = 1, {0}_NO_ANSWER = 2 }};\n", name);
  text += fmt::format("enum {{ {0}_axes = {1}, {0}_numbers = {2} }};\n\ntypedef struct {{\n{3}}} {0}_answer;\n\n", name,
                      table.axes.size(), 2 * table.channels.size(), fields);
  text += "/* Of the interpolation, against the model, in SI. */\n" + limits + "\n" + lists;
  text += fmt::format(
      "static const double *const {0}_nodes[{0}_axes] = {{{1}}};\nstatic const int {0}_sizes[{0}_axes] = {{{2}}};\n\n"
      "/* A row a node, the last axis fastest: the members of {0}_answer. */\nstatic const double "
      "{0}_table[{3}][{0}_numbers] = {{\n",
      name, fmt::join(pointers, ", "), fmt::join(sizes, ", "), table.nodes.answers.size());
  for (std::size_t node = 0; node < table.nodes.answers.size(); ++node) {
    std::vector<std::string> row;
    for (const TableChannel& channel : table.channels) row.push_back(c_number(channel.values[node]));
    for (const TableChannel& channel : table.channels) row.push_back(c_number(channel.std_errors[node]));
    text += fmt::format("  {{{}}},\n", fmt::join(row, ", "));
  }
  text += "};\n";
  const std::string code =
      replaced(replaced(look_up_in_c, "ARGUMENTS", fmt::format("{}", fmt::join(arguments, ", "))), "PLACE", place);
  return text + replaced(code, "NAME_", name + "_");  // last: a file may be called PLACE
}

}  // namespace soilbin::compare
