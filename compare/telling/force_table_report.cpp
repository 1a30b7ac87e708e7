// A table of forces for other programs as it is told; soilbin-force-table/1.
#include <fmt/core.h>

#include "compare/export/force_table.hpp"
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

Json numbers_json(const std::vector<double>& values) {
  Json all = Json::array();
  for (const double value : values) all.push_back(finite(value));
  return all;
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
        {{"name", axis.view->name}, {"nodes", numbers_json(axis.nodes)}, {"error_share", finite(axis.error_share)}});
  }
  for (const TableChannel& channel : table.channels)
    document["channels"].push_back({{"name", channel.channel->name},
                                    {"unit", channel.channel->si_unit},
                                    {"largest_error", finite(channel.largest_error)},
                                    {"rms_error", finite(channel.rms_error)},
                                    {"scale", finite(channel.scale)},
                                    {"values", numbers_json(channel.values)},
                                    {"std_errors", numbers_json(channel.std_errors)}});
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

}  // namespace soilbin::compare
