// A table of forces for other programs as it is told; soilbin-force-table/1.
#include <fmt/core.h>

#include "compare/export/force_table.hpp"
#include "compare/export/wheel_fmu.hpp"
#include "compare/report/json_fields.hpp"
#include "compare/report/number_text.hpp"
#include "compare/sweep/model_names.hpp"
#include "compare/sweep/result_json.hpp"
#include "compare/sweep/varying.hpp"
#include "compare/telling/reports.hpp"

namespace soilbin::compare {
namespace {

std::vector<BackedSentence> verdicts_on(const ForceTable& table) {
  std::vector<BackedSentence> said;
  const auto [channel, share] = roughest(table);
  const double per = channel->channel->per_si;
  const std::string unit(channel->channel->unit);
  said.push_back(
      {"Interpolation",
       table.cells == 0
           ? "It could not be checked: no cell of the table has answers at all of its corners."
           : fmt::format("Between its nodes the table lies within {} of the model's largest {}: {} {} at most, {} {} "
                         "root mean square, in the middles of {}. The other channels have smaller shares.",
                         percent(share), channel->channel->title, number(channel->largest_error * per, 3), unit,
                         number(channel->rms_error * per, 3), unit, counted(table.cells, "cell"))});
  if (share > rough_share) {
    const ConditionView& view = *coarsest(table).view;
    said.push_back({"Refine it", fmt::format("Most of the error comes from the steps of '{}': half of them leave a "
                                             "quarter of it where the curves are smooth.",
                                             view.name)});
  }
  if (table.without_answer > 0)
    said.push_back({"Gaps", fmt::format("{} of {} have no answer of the model: a look-up beside one says so.",
                                        table.without_answer, counted(table.nodes.answers.size(), "node"))});
  if (table.cells_without_answer > 0)
    said.push_back({"Gaps between nodes",
                    fmt::format("In the middles of {} of {} the model has no answer, though it has one at their "
                                "corners: there the table answers where the model does not.",
                                table.cells_without_answer, counted(table.cells, "cell"))});
  return said;
}

Table axes_table(const ForceTable& table) {
  Table told{"Axes", {"condition", "from", "to", "unit", "nodes", "error along it [%]"}};
  told.text_columns = {true, false, false, true, false, false};
  for (const TableAxis& axis : table.axes)
    told.add({std::string(axis.view->title), number(axis.nodes.front() * axis.view->per_si),
              number(axis.nodes.back() * axis.view->per_si),
              axis.view->unit.empty() ? "-" : std::string(axis.view->unit), std::to_string(axis.nodes.size()),
              number(100 * axis.error_share, 2)});
  told.legend = "Error along it: root mean square half-way between nodes of this axis alone, by the channel's largest.";
  return told;
}

Table errors_table(const ForceTable& table) {
  Table told{"Error of the interpolation",
             {"channel", "unit", "largest value", "largest error", "root mean square", "largest error [%]"}};
  told.text_columns = {true, true, false, false, false, false};
  for (const TableChannel& channel : table.channels) {
    const double per = channel.channel->per_si;
    told.add({std::string(channel.channel->title), std::string(channel.channel->unit), number(channel.scale * per),
              number(channel.largest_error * per, 3), number(channel.rms_error * per, 3),
              channel.scale > 0.0 ? number(100 * channel.largest_error / channel.scale, 3) : "-"});
  }
  told.legend =
      "Against the model, in the middles of the cells. The standard errors of the soil are beside each value.";
  return told;
}

Json force_table_json(const ForceTable& table) {
  Json document = {{"format", "soilbin-force-table/1"},
                   {"tire", table.question.scenario.tire.name},
                   {"soil", table.question.scenario.soil.name},
                   {"model", table.nodes.choice.label},
                   {"fixed", to_json(table.fixed)},
                   {"nodes", table.nodes.answers.size()},
                   {"nodes_without_answer", table.without_answer},
                   {"cells", table.cells},
                   {"cells_without_answer", table.cells_without_answer},
                   {"axes", Json::array()},
                   {"channels", Json::array()}};
  for (const TableAxis& axis : table.axes) {
    document["fixed"].erase(std::string(axis.view->name));
    document["axes"].push_back(
        {{"name", axis.view->name}, {"nodes", list_of(axis.nodes, finite)}, {"error_share", finite(axis.error_share)}});
  }
  for (const TableChannel& channel : table.channels)
    document["channels"].push_back({{"name", channel.channel->name},
                                    {"unit", channel.channel->si_unit},
                                    {"largest_error", finite(channel.largest_error)},
                                    {"rms_error", finite(channel.rms_error)},
                                    {"scale", finite(channel.scale)},
                                    {"values", list_of(channel.values, finite)},
                                    {"std_errors", list_of(channel.std_errors, finite)}});
  return document;
}

}  // namespace

Report report_on(const ForceTable& table) {
  const Case& question = table.question;
  const std::string asked = fmt::format("{} on {}", in_words(question.scenario.tire), in_words(question.scenario.soil));
  const std::string errors = errors_in_words(question);
  Report report{
      "Force table of " + question.scenario.tire.name,
      "Forces on a grid of conditions, for programs that look them up.",
      fmt::format("{}\nby {}{}", asked, model_in_words(table.nodes.choice.label), errors.empty() ? "" : "\n" + errors)};
  report.add(Sentences(verdicts_on(table)));
  report.add(WarningsHere());
  report.add("Axes", axes_table(table));
  report.add("Errors", errors_table(table));
  report.data = [&table] { return force_table_json(table); };
  report.csv = [&table] { return csv_of(table); };
  report.data_name = report.csv_name = "table";
  return report;
}

// A driven wheel as a unit of FMI 2.0 as it is told; soilbin-fmu/1.

namespace {

const char* role_in_words(FmuVariable::Role role) {
  return role == FmuVariable::Role::input ? "input" : role == FmuVariable::Role::parameter ? "parameter" : "output";
}

std::vector<BackedSentence> words_on(const WheelFmu& fmu, const CompiledC& compiled) {
  std::vector<BackedSentence> said;
  said.push_back({"Range",
                  "Outside the table the unit uses the nearest values, returns fmi2Warning and logs what was "
                  "left. Where the table has no answer it returns fmi2Error, and the wheel stays as it was."});
  said.push_back({"Motion", fmt::format("Steady, the wheel is the table. What is faster than {} rad/s is not in it: it "
                                        "takes what soil the contact has seen by its length alone.",
                                        number(fmu.rest_frequency, 2))});
  said.push_back(compiled.library
                     ? BackedSentence{"Compiled",
                                      "The unit holds a library for Linux of this machine's processor, and "
                                      "its source in C99 for others."}
                     : BackedSentence{"Not compiled", fmt::format("The unit holds its source alone: {}. Programs that "
                                                                  "compile units take it; else install a compiler "
                                                                  "(Debian: apt install gcc) and export again.",
                                                                  compiled.why_not)});
  return said;
}

Table fmu_variables(const WheelFmu& fmu) {
  Table table{"Variables", {"name", "", "unit", "start", "meaning"}};
  table.text_columns = {true, true, true, false, true};
  for (const FmuVariable& variable : fmu.variables)
    table.add({variable.name, role_in_words(variable.role), variable.unit,
               variable.start ? number(*variable.start) : "", variable.meaning});
  table.add(
      {"spin_is_given", "parameter", "", "false", "the wheel turns with given_spin, in place of by motor_torque"});
  table.add({"outside", "output", "", "", "0 where the last step stayed in the table"});
  return table;
}

Json fmu_json(const WheelFmu& fmu, const CompiledC& compiled, Json table) {
  const Json variables = list_of(fmu.variables, [](const FmuVariable& variable) {
    Json one = {{"name", variable.name}, {"role", role_in_words(variable.role)}, {"unit", variable.unit}};
    if (variable.start) one["start"] = *variable.start;
    return one;
  });
  Json document = {{"format", "soilbin-fmu/1"},
                   {"name", fmu.name},
                   {"guid", fmu.guid},
                   {"compiled", compiled.library.has_value()},
                   {"rest_frequency", fmu.rest_frequency},
                   {"variables", variables},
                   {"table", std::move(table)}};
  if (!compiled.library) document["why_not_compiled"] = compiled.why_not;
  return document;
}

}  // namespace

Report report_on(const WheelFmu& fmu, const CompiledC& compiled) {
  Report report = report_on(fmu.table);
  report.title = "FMI unit of " + fmu.table.question.scenario.tire.name;
  report.subtitle = "A driven wheel on soft soil for co-simulation by FMI 2.0.";
  report.add(Sentences(words_on(fmu, compiled)));
  report.add("Variables", fmu_variables(fmu));
  report.data = [&fmu, &compiled, table = report.data] { return fmu_json(fmu, compiled, table()); };
  return report;
}

}  // namespace soilbin::compare
