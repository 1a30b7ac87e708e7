// A vehicle beside measured states of it as it is told; soilbin-vehicle-measured/1.
#include <fmt/format.h>

#include <cmath>

#include "compare/report/json_fields.hpp"
#include "compare/report/number_text.hpp"
#include "compare/telling/reports.hpp"
#include "compare/telling/vehicle_words.hpp"
#include "compare/vehicle/vehicle_measured.hpp"
#include "scenario/csv.hpp"

namespace soilbin::compare {
namespace {

const VehicleChannelView& view_of(const MeasuredAnswers& answers) {
  return vehicle_channels.at(static_cast<std::size_t>(answers.measured.channel));
}

/// Of the channel as people read it.
double shown_scale(const MeasuredAnswers& answers) { return per_unit(view_of(answers).unit); }

/// "3.7 ± 4.1"
std::string modelled_text(const MeasuredAnswers& answers, const Estimate& value) {
  return number({value.value, told_error(value.std_error)}, shown_scale(answers));
}

/// How many standard errors of the model a measured state lies below it; none where no error is known.
std::optional<double> errors_off(const MeasuredAnswers& answers, std::size_t state) {
  const std::optional<double> off = answers.difference(state);
  if (!off || !(answers.modelled[state].value->std_error > 0.0)) return {};
  return *off / answers.modelled[state].value->std_error;
}

/// Of the states whose model has an error, those that lie within two.
struct WithinTwo {
  std::size_t within = 0, all = 0;
};

WithinTwo within_two(const MeasuredAnswers& answers) {
  WithinTwo count;
  for (std::size_t i = 0; i < answers.modelled.size(); ++i)
    if (const std::optional<double> off = errors_off(answers, i)) ++count.all, count.within += std::abs(*off) <= 2.0;
  return count;
}

std::size_t farthest_off(const MeasuredAnswers& answers) {
  std::size_t farthest = 0;
  for (std::size_t i = 1; i < answers.modelled.size(); ++i)
    if (std::abs(answers.difference(i).value_or(0.0)) > std::abs(answers.difference(farthest).value_or(0.0)))
      farthest = i;
  return farthest;
}

std::vector<BackedSentence> measured_verdicts(const MeasuredAnswers& answers) {
  const VehicleChannelView& view = view_of(answers);
  std::vector<BackedSentence> said;
  if (answers.answered > 0) {
    const double mean = answers.mean.value;
    said.push_back(
        {"How far off",
         fmt::format("{} {} (root mean square over {}). On average the model's {} is {} {} {} what was "
                     "measured.",
                     number(answers.rms * shown_scale(answers), 2), view.unit, counted(answers.answered, "point"),
                     view.title, modelled_text(answers, {std::abs(mean), answers.mean.std_error}), view.unit,
                     mean < 0.0 ? "below" : "above")});
    const std::size_t i = farthest_off(answers);
    said.push_back({"Farthest off", fmt::format("At {} % of slip: {} {} by the model, {} measured.",
                                                number(100 * answers.modelled[i].slip, 3),
                                                modelled_text(answers, *answers.modelled[i].value), view.unit,
                                                number(answers.measured.states[i].value * shown_scale(answers), 3))});
  }
  if (const WithinTwo count = within_two(answers); count.all > 0)
    said.push_back({"The soil's doubt", fmt::format("{} of {} lie within two standard errors of the model.",
                                                    count.within, counted(count.all, "point"))});
  for (const ModelledState& state : answers.modelled)
    if (state.failure)
      said.push_back({fmt::format("At {} % of slip", number(100 * state.slip, 3)),
                      failure_in_words(answers.wheels, *state.failure) + "."});
  return said;
}

std::vector<KeyFigure> measured_key_figures(const MeasuredAnswers& answers) {
  if (answers.answered == 0) return {{"no answer", "at any measured slip"}};
  const std::string unit = unit_behind(view_of(answers).unit);
  std::vector<KeyFigure> figures = {
      {number(answers.rms * shown_scale(answers), 2) + unit, "root mean square of model - measured"},
      {modelled_text(answers, answers.mean) + unit, "mean of model - measured"}};
  if (const WithinTwo count = within_two(answers); count.all > 0)
    figures.push_back({fmt::format("{} of {}", count.within, count.all), "points within two standard errors"});
  return figures;
}

bool tells_slopes_of_pulls(const MeasuredAnswers& answers) {
  return answers.measured.tells_slopes && answers.measured.channel != VehicleChannel::slope;
}

Table states_table(const MeasuredAnswers& answers) {
  const VehicleChannelView& view = view_of(answers);
  const bool sloping = tells_slopes_of_pulls(answers);
  Table table{capital(view.title) + " at a slip",
              {"slip [%]", heading("measured", view.unit), heading("model", view.unit),
               heading("model - measured", view.unit), "over its standard error"}};
  if (sloping) table.header.insert(table.header.begin() + 1, "slope [deg]");
  for (std::size_t i = 0; i < answers.modelled.size(); ++i) {
    const MeasuredState& measured = answers.measured.states[i];
    const auto& value = answers.modelled[i].value;
    const std::optional<double> off = answers.difference(i), errors = errors_off(answers, i);
    std::vector<TableCell> row = {number(100 * measured.slip), number(measured.value * shown_scale(answers)),
                                  value ? modelled_text(answers, *value) : "-",
                                  off ? number(*off * shown_scale(answers), 3) : "-",
                                  errors ? number(*errors, 2) : "-"};
    if (sloping) row.insert(row.begin() + 1, number(*measured.slope * per_unit("deg")));
    table.add(std::move(row));
  }
  table.legend =
      "±: one standard error, from the standard deviations of the soil's values. All points share one soil, so that "
      "they are off together. What the measurement itself is off by is not in it.";
  return table;
}

Series over_slip(const MeasuredAnswers& answers, const std::vector<ModelledState>& states, Series series) {
  for (const ModelledState& state : states) {
    series.x.push_back(100 * state.slip);
    series.y.push_back(state.value ? state.value->value * shown_scale(answers) : not_a_number);
    series.error.push_back(state.value ? told_error(state.value->std_error) * shown_scale(answers) : 0.0);
  }
  return series;
}

Sheet measured_sheet(const MeasuredAnswers& answers) {
  const VehicleChannelView& view = view_of(answers);
  Sheet sheet{answers.question.name + " on " + answers.question.soil.name,
              {{heading(capital(view.title), view.unit), {"slip of the drive line [%]"}, {}, {}}}};
  sheet.note = "band: one standard error, from the standard deviations of the soil's values";
  std::vector<Series>& all = sheet.plots[0].series;
  all.push_back(answers.curve.empty() ? over_slip(answers, answers.modelled, {.label = "model", .mark = Mark::points})
                                      : over_slip(answers, answers.curve, {.label = "model"}));
  all.push_back(over_samples(
      {.label = "measured", .mark = Mark::points, .color = 1}, answers.measured.states,
      [](const MeasuredState& state) { return 100 * state.slip; },
      [&](const MeasuredState& state) { return state.value * shown_scale(answers); }));
  return sheet;
}

Json modelled_json(const MeasuredAnswers& answers, const ModelledState& state) {
  Json json = {{"slip", state.slip}, {"model", or_null(state.value)}};
  if (state.failure) json["failure"] = failure_json(answers.wheels, *state.failure);
  return json;
}

Json measured_json(const MeasuredAnswers& answers) {
  const VehicleCondition& at = answers.question.condition;
  Json document = {
      {"format", "soilbin-vehicle-measured/1"}, {"vehicle", answers.question.name},
      {"soil", answers.question.soil.name},     {"condition", {{"cross_slope", at.cross_slope}, {"speed", at.speed}}},
      {"measured_in", answers.measured.file},   {"channel", view_of(answers).key}};
  if (answers.measured.channel == VehicleChannel::slope)
    document["condition"]["pull"] = at.pull;
  else if (!answers.measured.tells_slopes)
    document["condition"]["slope"] = at.slope;
  document["rms"] = finite(answers.rms), document["mean"] = estimate_json(answers.mean);
  document["points"] = Json::array();
  for (std::size_t i = 0; i < answers.modelled.size(); ++i) {
    Json& point = document["points"].emplace_back(modelled_json(answers, answers.modelled[i]));
    const MeasuredState& measured = answers.measured.states[i];
    if (measured.slope) point["slope"] = *measured.slope;
    point["measured"] = measured.value;
    point["difference"] = or_null(answers.difference(i));
    point["difference_over_error"] = or_null(errors_off(answers, i));
  }
  document["curve"] = list_of(answers.curve, [&](const ModelledState& state) { return modelled_json(answers, state); });
  return document;
}

std::string measured_csv(const MeasuredAnswers& answers) {
  const VehicleChannelView& view = view_of(answers);
  const bool sloping = tells_slopes_of_pulls(answers);
  std::string text =
      fmt::format("slip,{0}measured_{1}_{2},model_{1}_{2},model_se_{2},difference_{2},difference_over_error,error\n",
                  sloping ? "slope_deg," : "", view.key, view.unit);
  for (std::size_t i = 0; i < answers.modelled.size(); ++i) {
    const MeasuredState& measured = answers.measured.states[i];
    const ModelledState& state = answers.modelled[i];
    const double scale = shown_scale(answers);
    const Estimate value = state.value.value_or(Estimate{not_a_number, not_a_number});
    text += fmt::format("{},{}{},{},{},{},{},{}\n", csv_number(state.slip),
                        sloping ? csv_number(*measured.slope * per_unit("deg")) + "," : "",
                        csv_number(measured.value * scale), csv_number(value.value * scale),
                        csv_number(value.std_error * scale),
                        csv_number(answers.difference(i).value_or(not_a_number) * scale),
                        csv_number(errors_off(answers, i).value_or(not_a_number)),
                        state.failure ? csv_cell(failure_in_words(answers.wheels, *state.failure)) : "");
  }
  return text;
}

}  // namespace

Report report_on(const MeasuredAnswers& answers) {
  const VehicleCase& question = answers.question;
  Report report{"Vehicle beside measurements: " + question.name,
                "How far is the model off what was measured of the whole machine?",
                fmt::format("{} ({:.6g} kg) on {}, beside {} of {}", question.name, question.mass, question.soil.name,
                            counted(answers.measured.states.size(), "point"), answers.measured.file)};
  report.add(KeyFigures{measured_key_figures(answers)}, Told::on_pages);
  report.add(Sentences(measured_verdicts(answers)));
  report.add(WarningsHere());
  report.sheet = drawn_once([&] { return measured_sheet(answers); });
  report.add("Over slip", Figure(report.sheet, answers.curve.empty()
                                                   ? "Bars: one standard error."
                                                   : "Points: measured. Line: the model, with a band of one standard "
                                                     "error by the soil's values."));
  report.add("Point by point", states_table(answers));
  if (answers.answered == 0) report.no_answer = "the model has no steady vehicle at any measured slip";
  report.data = [&answers] { return measured_json(answers); };
  report.csv = [&answers] { return measured_csv(answers); };
  return report;
}

}  // namespace soilbin::compare
