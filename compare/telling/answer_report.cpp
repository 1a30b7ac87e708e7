#include "compare/telling/answer_report.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <iterator>
#include <limits>
#include <numeric>

#include "bekker_wong/effect.hpp"
#include "bekker_wong/presumption.hpp"
#include "compare/doubts/doubts.hpp"
#include "compare/measured/campaign.hpp"
#include "compare/report/number_text.hpp"
#include "compare/report/table.hpp"
#include "compare/sweep/answer_sheets.hpp"
#include "compare/sweep/result_json.hpp"
#include "compare/sweep/varying.hpp"
#include "compare/sweep/wheel_power.hpp"
#include "compare/telling/reports.hpp"
#include "scenario/nearest_word.hpp"
#include "scenario/unit.hpp"

namespace soilbin::compare {
namespace {

bool any_side_force(const std::vector<ModelAnswers>& study) {
  for (const ModelAnswers& model : study)
    for (const Answer& answer : model.answers)
      if (answer.result && answer.result->lateral_force.value != 0.0) return true;
  return false;
}

/// The places of the conditions, one curve after the other, each in its own order.
std::vector<std::size_t> curve_by_curve(const Curves& curves) {
  std::vector<std::size_t> order(curves.curve_of.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::ranges::stable_sort(order, {}, [&](std::size_t i) { return curves.curve_of[i]; });
  return order;
}

/// In percent; "-" where there is none (has_efficiency).
std::string efficiency_in_percent(const TractionResult& result) {
  return has_efficiency(result) ? number(100 * result.tractive_efficiency) : "-";
}

/// Why a pull of the analytic model at 0 % slip on the level is not 0, which readers expect; none where there is none.
std::vector<std::string> why_it_pulls_without_slip(const ModelAnswers& model) {
  const bool there =
      model.choice.model == ModelKind::bekker_wong && std::ranges::any_of(model.answers, [](const Answer& answer) {
        return answer.result && std::abs(answer.at.slip) < 1e-9 && answer.at.longitudinal_incline == 0.0;
      });
  if (!there) return {};
  return {"At 0 % slip (v = r ω) the soil is still compacted and sheared along the contact, so the pull is not 0."};
}

/// Whether an efficiency of a tire that flattens is told.
bool tells_flexible_efficiency(const std::vector<ModelAnswers>& study) {
  return std::ranges::any_of(study, [](const ModelAnswers& model) {
    return model.choice.model == ModelKind::bekker_wong && bekker_wong::is_flexible(model.choice.effects) &&
           std::ranges::any_of(model.answers,
                               [](const Answer& answer) { return answer.result && has_efficiency(*answer.result); });
  });
}

/// Stresses under the wheel by each model at its only condition.
Sheet stresses_of(const std::vector<ModelAnswers>& study) {
  std::vector<LabelledPatch> patches;
  for (const ModelAnswers& model : study)
    if (const auto& result = model.answers.front().result)
      patches.push_back({model_in_words(model.choice.label), static_cast<int>(patches.size()), result->patch});
  return patch_sheet("", patches);
}

std::string steps_text(const std::vector<Step>& steps) {
  std::string text;
  for (const Step& step : steps) {
    text += fmt::format("  {}\n      {}\n", step.name, step.equation);
    text += step.unit == "SI"  // an effect's parameters
                ? fmt::format("      with {}\n", step.numbers)
                : fmt::format("      = {} = {}{}\n", step.numbers, number(step.value), unit_behind(step.unit));
    if (!step.remark.empty()) text += fmt::format("      ({})\n", step.remark);
  }
  return text;
}

std::string step_in_words(const dem::StepCriteria& step) {
  return fmt::format(
      "dem: time step {:.3g} s, {:.2g} of the Rayleigh time of {:.3g} s; an impact at the rim's {:.2g} m/s lasts "
      "{:.3g} s, {:.0f} steps",
      step.step, step.step / step.rayleigh, step.rayleigh, step.speed, step.hertz, step.hertz / step.step);
}

std::function<Sheet()> curves_of(const Case& question, const std::vector<ModelAnswers>& study) {
  return drawn_once([&] {
    Sheet sheet = plot_of_study(question, study);
    sheet.title = title_of_question(question);
    return sheet;
  });
}

bool has_an_answer(const std::vector<RecordedRun>& runs, const OperatingCondition& at) {
  return std::ranges::any_of(runs, [&](const auto& run) { return run.answer.result && alike(run.answer.at, at); });
}

}  // namespace

std::string errors_in_words(const Scenario& asked) {
  if (!asked.soil.semi_empirical) return "";
  const SemiEmpiricalSoil& s = *asked.soil.semi_empirical;
  std::string declared, assumed, exact;
  const auto add = [](std::string& list, const char* symbol) {
    list += (list.empty() ? "" : ", ") + std::string(symbol);
  };
  for (const SoilParameter& p : soil_parameters) {
    const Estimate& value = s.*p.value;
    add(has_assumed_sd(s, value) ? assumed : value.std_error > 0.0 ? declared : exact, p.symbol);
  }
  if (bekker_wong::errs_by_carcass(asked.tire, asked.effects)) add(declared, "p_c");
  std::string together =
      asked.errors.empty() ? "" : " The model's fit says how values of the soil and of its effects err together.";
  if (const double missed = asked.misfit.front(); missed > 0.0)
    together += fmt::format(" It includes the fit's own misfit, in the drawbar pull {}.", newtons(missed));
  if (declared.empty() && assumed.empty())
    return together.empty() ? "No ±: all values of the soil count as exact." : "± is one standard error." + together;
  std::string text = "± is one standard error from the standard deviations of ";
  if (!declared.empty()) text += declared + (assumed.empty() ? "" : " (declared) and ");
  if (!assumed.empty()) text += fmt::format("{} (assumed: {:g} %, no source)", assumed, 100 * *s.assumed_sd);
  return text +
         (exact.empty() ? "."
                        : "; " + exact + (exact.find(',') == std::string::npos ? " counts" : " count") + " as exact.") +
         together;
}

bool known(const std::optional<Estimate>& value) { return value && value->std_error > 0.0; }

std::string errors_in_words(const Case& question) {
  const auto analytic = std::ranges::find(question.study.models, ModelKind::bekker_wong, &ModelChoice::model);
  const bool has_analytic = analytic != question.study.models.end();
  std::string text = has_analytic ? errors_in_words(seen_by(*analytic, question.scenario)) : "";
  const auto add = [&](ModelKind kind, const char* name, const std::string& values) {
    if (asks(question.study, kind))
      text += text.empty() ? "± is one standard error from " + values : fmt::format(" {}: from {}", name, values);
  };
  const Soil& soil = question.scenario.soil;
  add(ModelKind::rft, "Resistive force theory", "the standard deviations of xi_n and surface friction.");
  add(ModelKind::cone_index, "Cone index",
      fmt::format("the standard deviation of the {}{}; how far tires scatter about the relation is not in it.",
                  soil.cone_index ? "cone index" : "cone index gradient",
                  known(soil.cone_index) || known(soil.cone_index_gradient) ? "" : ", which has none"));
  return text;
}

std::vector<std::string> notes_on(const std::vector<RecordedRun>& runs, const std::string& density) {
  std::vector<std::string> notes;
  if (runs.empty()) return notes;
  double seconds = 0, densest = std::numeric_limits<double>::infinity(), loosest = 0;
  for (const RecordedRun& run : runs) {
    seconds += run.seconds;
    if (!run.answer.result && has_an_answer(runs, run.answer.at))
      notes.push_back(fmt::format("no answer at {}, bed sample {}, which is left out: {}", in_words(run.answer.at),
                                  run.packing, run.answer.error.substr(0, run.answer.error.find('\n'))));
    if (run.answer.result && !run.steady)
      notes.push_back(fmt::format("not steady at {}{} (drift {:.3g} standard errors): lengthen the run",
                                  in_words(run.answer.at),
                                  run.packing == 1 ? "" : fmt::format(", bed sample {}", run.packing), run.drift));
    if (std::isfinite(run.bed.void_ratio))
      densest = std::min(densest, run.bed.void_ratio), loosest = std::max(loosest, run.bed.void_ratio);
  }
  const std::string low = fmt::format("{:.3f}", densest), high = fmt::format("{:.3f}", loosest);
  if (loosest > 0) notes.push_back("bed: void ratio " + (low == high ? low : low + " to " + high));
  notes.push_back(fmt::format("dem: {}, {:.0f} s in all", counted(runs.size(), "run"), seconds));
  if (!density.empty()) notes.push_back(density);
  return notes;
}

std::string asked_in_words(const Case& question) {
  return fmt::format("{} on {}", tire_in_words(question), in_words(question.scenario.soil));
}

std::string title_of_question(const Case& question, bool with_slip) {
  std::string title = fmt::format("{} on {}", question.scenario.tire.name, in_words(question.scenario.soil));
  const std::string shared = shared_in_words(question.study.conditions, with_slip);
  return shared.empty() ? title : title + ", " + shared;
}

std::vector<PrintedValue> printed_values(const TractionResult& r, ForcesIn told) {
  const double per_newton = told == ForcesIn::newtons ? 1.0 : 1e-3;
  const std::string unit = told == ForcesIn::newtons ? "N" : "kN";
  std::vector<PrintedValue> all;
  for (const ChannelView& channel : channel_views) {
    const bool force = channel.unit == "N";
    if (std::isnan((r.*channel.predicted).value)) continue;  // the cone index knows no sinkage
    all.push_back({capital(std::string(channel.title)),
                   number(r.*channel.predicted, force ? per_newton : channel.per_si),
                   force ? unit : std::string(channel.unit)});
  }
  const std::string none = why_no_efficiency(r);
  all.push_back(
      {"Tractive efficiency", none.empty() ? efficiency_in_percent(r) : "none: " + none, none.empty() ? "%" : ""});
  if (std::isfinite(r.entry_angle)) {
    const auto tenths = [](double angle) { return std::round(10 * angle / degree) / 10 + 0.0; };  // no "-0.0"
    all.push_back({"Contact",
                   fmt::format("entry {:.1f} deg, peak stress {:.1f} deg, exit {:.1f} deg", tenths(r.entry_angle),
                               tenths(r.max_stress_angle), tenths(r.exit_angle)),
                   ""});
  }
  if (std::isfinite(r.contact_area))
    all.push_back({"Ground pressure",
                   fmt::format("{} kPa: the load over {} cm² of contact, seen from above",
                               number(r.at.load / r.contact_area / 1e3), number(1e4 * r.contact_area)),
                   ""});
  std::string sum;
  for (const Contribution& part : r.budget) {
    const std::string sign = sum.empty() ? (part.force < 0 ? "-" : "") : (part.force < 0 ? " - " : " + ");
    sum += fmt::format("{}{} {} ({})", sign, number(std::abs(part.force) * per_newton), unit, spaced(part.name));
  }
  if (const BudgetRest& rest = r.budget_rest; std::abs(rest.force) > 1e-9 * r.at.load)
    sum += fmt::format("; {} {} unexplained{}", number(rest.force * per_newton), unit,
                       std::isfinite(rest.bound)
                           ? fmt::format(" (sampling error: up to {} {})", number(rest.bound * per_newton), unit)
                           : "");
  all.push_back({"Drawbar pull is", sum, ""});
  if (!r.without_error_of.empty())
    all.push_back(
        {"Standard errors",
         fmt::format("leave out the soil's {}: the results have no derivative by it here", listed(r.without_error_of)),
         ""});
  return all;
}

std::vector<ReportPart> answer_parts(const Tire& tire, const ModelAnswers& model, const Answer& answer) {
  std::vector<ReportPart> parts;
  if (!answer.result) {
    parts.push_back({Sentences(std::vector<BackedSentence>{
        {model_in_words(model.choice.label), fmt::format("{}: no solution: {}", in_words(answer.at), answer.error)}})});
    return parts;
  }
  parts.push_back({Sentences(std::vector<BackedSentence>{{model_in_words(model.choice.label), in_words(answer.at)}})});
  NamedValues values;
  for (const PrintedValue& one : printed_values(*answer.result))
    values.all.emplace_back(one.name, one.value + (one.unit.empty() ? "" : " " + one.unit));
  if (const auto taken = power_of(tire, *answer.result))
    values.all.emplace_back("Power", fmt::format("{} W at {} m/s, {} J/m", number(taken->power),
                                                 number(answer.at.speed, 3), number(taken->energy)));
  parts.push_back({std::move(values)});
  parts.push_back({Sentences(why_it_pulls_without_slip({model.choice, {answer}}))});
  return parts;
}

std::vector<ReportPart> study_parts(const std::vector<ModelAnswers>& study) {
  const bool side = any_side_force(study);
  std::vector<ReportPart> parts;
  for (const ModelAnswers& model : study) {
    const Curves curves = curves_against_slip(conditions_of(model.answers), Spread::exact);
    std::vector<std::string> header;
    if (!curves.varying.empty()) header.push_back(curves.varying);
    header.push_back("slip [%]");
    for (std::size_t c = 0; c < channel_views.size(); ++c)
      if (side || !channel_views[c].sideways)
        header.push_back(heading(std::string(channel_views[c].title), std::string(channel_views[c].unit)));
    header.push_back("efficiency [%]");
    Table table{model_in_words(model.choice.label), header};
    std::vector<std::string> unsolved;
    for (const std::size_t i : curve_by_curve(curves)) {
      const Answer& answer = model.answers[i];
      std::vector<TableCell> row;
      if (!curves.varying.empty()) row.push_back(curves.labels[curves.curve_of[i]]);
      row.push_back(fmt::format("{:.4g}", 100 * answer.at.slip));
      for (const ChannelView& channel : channel_views)
        if (side || !channel.sideways)
          row.push_back(answer.result ? number((*answer.result).*channel.predicted, channel.per_si) : "-");
      row.push_back(answer.result ? efficiency_in_percent(*answer.result) : "-");
      table.add(std::move(row));
      if (!answer.result) unsolved.push_back(fmt::format("no solution at {}: {}", in_words(answer.at), answer.error));
    }
    parts.push_back({std::move(table)});
    if (!unsolved.empty()) parts.push_back({Sentences(unsolved)});
  }
  if (!study.empty()) parts.push_back({Sentences(why_it_pulls_without_slip(study.front()))});
  return parts;
}

Report report_on(const Case& question, const std::vector<ModelAnswers>& study) {
  Report report{title_of_question(question), question.description};
  report.sheet = curves_of(question, study);
  report.csv = [&] { return study_csv(study, remarks_about(question.scenario)); };
  if (!any_result(study)) {
    report.no_answer = "no solution: " + study.front().answers.front().error;
    return report;
  }
  report.heading = asked_in_words(question) + "\n" + errors_in_words(question);
  const bool several = question.study.conditions.size() > 1;
  if (const std::string shared = shared_in_words(question.study.conditions, false); several && !shared.empty())
    report.add(Sentences(std::vector{shared}), Told::on_terminals);
  std::vector<ReportPart> parts;
  if (several) {
    parts = study_parts(study);
  } else {
    for (const ModelAnswers& model : study)
      for (ReportPart& part : answer_parts(question.scenario.tire, model, model.answers.front()))
        parts.push_back(std::move(part));
  }
  report.parts.insert(report.parts.end(), std::make_move_iterator(parts.begin()), std::make_move_iterator(parts.end()));
  if (tells_flexible_efficiency(study)) report.add(Sentences(std::vector<std::string>{carcass_without_loss}));
  if (const std::string errors = errors_in_words(question); !errors.empty())
    report.add(Prose{{errors}}, Told::to_look_at);
  report.add(WarningsHere());
  if (several && curves_run_over(question.study.conditions) != nullptr)
    report.add("Curves", Figure(report.sheet, "Bands: one standard error."));
  const bool has_stresses = std::ranges::any_of(study, [](const ModelAnswers& model) {
    const std::optional<TractionResult>& result = model.answers.front().result;
    return result && !result->patch.empty();
  });
  if (!several && has_stresses) report.add("Stresses under the wheel", Figure([&] { return stresses_of(study); }, ""));
  std::vector<std::string> labels;
  for (const ModelAnswers& model : study) labels.push_back(model.choice.label);
  report.made_of = names_and_ids(labels);
  return report;
}

Report report_on(const Case& question, const StudyResults& results, const std::string& density) {
  Report report{question.study.name, question.description, question.study.name + ": " + asked_in_words(question)};
  if (const std::string errors = errors_in_words(question); !errors.empty())
    report.heading += "\n" + errors;  // grains say beside their answer where theirs come from
  if (results.step) report.heading += "\n" + step_in_words(*results.step);
  if (const std::string shared = shared_in_words(question.study.conditions, false); !shared.empty())
    report.add(Sentences(std::vector{shared}));
  for (ReportPart& part : study_parts(results.study)) report.parts.push_back(std::move(part));
  report.add(WarningsHere());
  report.sheet = drawn_once([&] { return plot_of_study(question, results.study); });
  if (curves_run_over(question.study.conditions) != nullptr)
    report.add("Curves", Figure(report.sheet, "Bands: one standard error."));
  report.notes = notes_on(results.runs, density);
  for (std::string& remark : in_words(results.of_runs)) report.notes.push_back(std::move(remark));
  if (!any_result(results.study)) report.no_answer = "no condition of the study has a solution";
  return report;
}

std::string equations_text(const Explanation& explanation) {
  std::string text;
  const auto add = [&](const char* heading, const std::vector<Step>& steps) {
    if (!steps.empty()) text += (text.empty() ? "" : "\n") + std::string(heading) + "\n" + steps_text(steps);
  };
  add(explanation.effects.empty() ? "Equations with their values"
                                  : "Base-model equations, with the soil values and the circles that the effects leave",
      explanation.steps);
  add("Effects", explanation.effects);
  add("Closed-form checks (no balance, no effects)", explanation.cross_checks);
  return text;
}

Report report_on(const Case& question, const std::vector<Explained>& explained) {
  const std::string heading = asked_in_words(question);
  Report report{"Why: " + heading, question.description, heading};
  for (const Explained& one : explained) {
    for (ReportPart& part : answer_parts(question.scenario.tire, {one.choice, {}}, {one.at, one.why.result, ""}))
      report.parts.push_back(std::move(part));
    Table forces = forces_table(one.why.result);
    forces.caption = "Budget of forces along the drawbar pull";
    report.add(std::move(forces));
    report.add(Code{equations_text(one.why)});
  }
  report.add(WarningsHere());
  Table sources = sources_table(question.scenario);
  sources.caption = "Where the values come from";
  report.add(std::move(sources));
  return report;
}

}  // namespace soilbin::compare
