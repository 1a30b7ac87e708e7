#include "compare/telling/studies_report.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <span>
#include <utility>

#include "bekker_wong/effect.hpp"
#include "compare/doubts/doubt.hpp"
#include "compare/report/number_text.hpp"
#include "compare/report/shell_words.hpp"
#include "compare/sweep/answer_sheets.hpp"
#include "compare/sweep/result_json.hpp"
#include "compare/sweep/varying.hpp"
#include "compare/telling/reports.hpp"
#include "scenario/soil_parameters.hpp"

namespace soilbin::compare {
namespace {

/// One curve of a model; the pointers go into the answers and are null where no condition has such a result.
struct Peak {
  std::string label;                           ///< of the curve: "4 kN"; "" for the only one
  const TractionResult* pull = nullptr;        ///< largest drawbar pull
  const TractionResult* efficiency = nullptr;  ///< largest tractive efficiency while driving and pulling
  const TractionResult* last = nullptr;        ///< at the largest slip
  std::size_t solved = 0, unsolved = 0;        ///< slips with a result; of the study's conditions those without

  /// The pull still grows at the largest slip: whoever asks for more may find more.
  bool at_the_end() const { return solved > 1 && pull == last; }
};

/// A peak for each curve of a model's answers, in the order of curves_against_slip.
std::vector<Peak> peaks(const ModelAnswers& model) {
  const Curves curves = curves_against_slip(conditions_of(model.answers), Spread::exact);
  std::vector<Peak> found(curves.labels.size());
  for (std::size_t c = 0; c < found.size(); ++c) found[c].label = curves.labels[c];
  for (std::size_t i = 0; i < model.answers.size(); ++i) {
    Peak& peak = found[curves.curve_of[i]];
    if (!model.answers[i].result) {
      ++peak.unsolved;
      continue;
    }
    ++peak.solved;
    const TractionResult& r = *model.answers[i].result;
    if (!peak.pull || r.drawbar_pull.value > peak.pull->drawbar_pull.value) peak.pull = &r;
    if (!peak.last || r.at.slip > peak.last->at.slip) peak.last = &r;
    if (has_efficiency(r) && (!peak.efficiency || r.tractive_efficiency > peak.efficiency->tractive_efficiency))
      peak.efficiency = &r;
  }
  return found;
}

/// The peaks of a part's model along its smooth curves, as they are drawn, where there are any.
std::vector<Peak> peaks(const StudyPart& part, std::size_t model) {
  std::vector<Peak> asked = peaks(part.study[model]);
  if (model >= part.along_curves.size()) return asked;
  std::vector<Peak> drawn = peaks(part.along_curves[model]);
  for (std::size_t c = 0; c < drawn.size(); ++c) drawn[c].unsolved = asked.at(c).unsolved;
  return drawn;
}

/// The model that a headline speaks of: of a tire with a declared pressure the first that reads it, else the first.
std::size_t leading_model(const StudyPart& part) {
  if (part.question.scenario.tire.inflation_pressure)
    for (std::size_t m = 0; m < part.study.size(); ++m)
      if (bekker_wong::is_flexible(part.study[m].choice.effects)) return m;
  return 0;
}

/// The curve that a study's sentence and key figure are about: the middle one of those of the leading model that have a
/// result.
std::optional<Peak> shown_peak(const StudyPart& part) {
  if (part.study.empty()) return std::nullopt;
  std::vector<Peak> solved = peaks(part, leading_model(part));
  std::erase_if(solved, [](const Peak& peak) { return peak.pull == nullptr; });
  if (solved.empty()) return std::nullopt;
  return solved[(solved.size() - 1) / 2];
}

std::string force(double newton) { return newtons(newton, 3); }

/// "1.32 ± 0.22 kN".
std::string force(const Estimate& pull) {
  const bool kilo = std::abs(pull.value) >= 1000.0;
  return number(pull, kilo ? 1e-3 : 1.0) + (kilo ? " kN" : " N");
}

/// "The largest pull rises from 817 N at 2 kN to 2.06 kN at 8 kN."
std::string change(const Peak& first, const Peak& last) {
  const double a = first.pull->drawbar_pull.value, b = last.pull->drawbar_pull.value;
  if (std::abs(b - a) < 0.01 * std::abs(a))
    return fmt::format("From {} to {} the largest pull hardly changes.", first.label, last.label);
  return fmt::format("The largest pull {} from {} at {} to {} at {}{}.", b > a ? "rises" : "falls", force(a),
                     first.label, force(b), last.label, b < 0.0 ? " (the wheel must be pushed)" : "");
}

std::string largest_pull(const Peak& peak) {
  const TractionResult& r = *peak.pull;
  std::string text = fmt::format("{} largest pull is {}, {:.0f} % of the load, at {:.3g} % slip{}",
                                 peak.label.empty() ? "The" : "At " + peak.label + " the", force(r.drawbar_pull),
                                 100 * r.drawbar_pull.value / r.at.load, 100 * r.at.slip,
                                 peak.at_the_end() ? ", the largest slip asked for, where it still grows" : "");
  if (peak.efficiency != nullptr)
    text += fmt::format("; peak tractive efficiency {:.0f} %, at {:.3g} % slip",
                        100 * peak.efficiency->tractive_efficiency, 100 * peak.efficiency->at.slip);
  return text + ".";
}

/// What another model of the study says of the same curve.
std::string other_model(const std::string& label, const Peak& base, const Peak& other) {
  return fmt::format("{}: {} at {:.3g} % slip; sinkage at {:.3g} % slip {:.0f} mm, against {:.0f} mm.", capital(label),
                     force(other.pull->drawbar_pull.value), 100 * other.pull->at.slip, 100 * other.last->at.slip,
                     1000 * other.last->sinkage.value, 1000 * base.last->sinkage.value);
}

std::string percent_to_tenths(double share) { return fmt::format("{:.4g}", std::round(1000 * share) / 10); }

/// The cells of one curve, without its model.
std::vector<TableCell> peak_row(const Peak& peak) {
  std::vector<TableCell> row = {peak.label.empty() ? "all" : peak.label};
  if (peak.unsolved > 0) row[0].text += fmt::format(" ({} without a solution)", peak.unsolved);
  if (peak.pull != nullptr)
    row.insert(row.end(), {number(peak.pull->drawbar_pull), percent_to_tenths(peak.pull->at.slip),
                           number(peak.pull->torque), number(peak.pull->sinkage, 1000)});
  else
    row.insert(row.end(), 4, "-");
  row.push_back(peak.efficiency != nullptr ? percent_to_tenths(peak.efficiency->tractive_efficiency) : "-");
  row.push_back(peak.efficiency != nullptr ? percent_to_tenths(peak.efficiency->at.slip) : "-");
  return row;
}

Table peak_table(const StudyPart& part) {
  Table table{"Where each curve pulls most, and where it is most efficient",
              {"curve", "largest pull [N]", "at slip [%]", "torque [N m]", "sinkage [mm]", "best efficiency [%]",
               "at slip [%]"},
              {true}};
  const bool several = part.study.size() > 1;
  if (several) {
    table.header.insert(table.header.begin(), "model");
    table.text_columns.push_back(true);
  }
  for (std::size_t m = 0; m < part.study.size(); ++m)
    for (const Peak& peak : peaks(part, m)) {
      table.add(peak_row(peak));
      if (several) table.rows.back().insert(table.rows.back().begin(), model_in_words(part.study[m].choice.label));
    }
  return table;
}

Table answers_table(const StudyPart& part) {
  Table table{
      "",
      {"model", "condition", "drawbar pull [N]", "torque [N m]", "sinkage [mm]", "lateral force [N]", "efficiency [%]"},
      {true, true}};
  for (const ModelAnswers& model : part.study)
    for (const Answer& answer : model.answers) {
      std::vector<TableCell> row = {model_in_words(model.choice.label), in_words(answer.at)};
      if (!answer.result)
        row.push_back("no solution: " + answer.error);
      else
        for (const ChannelView& channel : channel_views)
          row.push_back(number((*answer.result).*channel.predicted, channel.per_si));
      if (answer.result)
        row.push_back(has_efficiency(*answer.result) ? number(100 * answer.result->tractive_efficiency) : "-");
      row.resize(table.header.size());
      table.add(std::move(row));
    }
  return table;
}

std::string source_of(const SemiEmpiricalSoil& soil, const std::string& key) {
  return soil.sources.contains(key) ? soil.sources.at(key) : "";
}

Table soil_table(const std::string& name, const SemiEmpiricalSoil& soil, const std::string& source) {
  Table table{"Soil " + name + (source.empty() ? "" : ": " + source),
              {"value", "", "unit", "source"},
              {true, false, true, true}};
  for (const SoilParameter& p : soil_parameters)
    table.add({p.title, number(soil.*p.value, p.per_si), p.unit, source_of(soil, p.name)});
  if (!soil.density) table.add({"density", number(presumed_bulk_density), "kg/m^3", "assumed: the soil declares none"});
  for (const ExactSoilValue& exact : exact_soil_values)
    if (const std::optional<double>& value = soil.*exact.value)
      table.add({exact.name, number(*value), exact.unit, source_of(soil, exact.name)});
  return table;
}

std::string tire_words(const Tire& tire) {
  std::string text = fmt::format("Wheel {}: radius {} mm, width {} mm, ", tire.name, number(1000 * tire.radius),
                                 number(1000 * tire.width));
  text += is_lugged(tire) ? fmt::format("lugs of {} mm", number(1000 * tire.lugs.height)) : "smooth";
  return text + (tire.source.empty() ? "." : ". Source: " + tire.source + ".");
}

/// Which of the curves have a band, and how to see the others'.
std::string bands_in_words(const std::vector<Series>& pulls) {
  std::size_t drawn = 0, kept_back = 0;
  for (const Series& series : pulls)
    if (!series.error.empty()) ++(series.band ? drawn : kept_back);
  if (drawn + kept_back == 0) return "";
  return std::string(drawn > 0 ? " Band: one standard error; the efficiency has none." : "") +
         (kept_back > 0 ? " Point at a name in the legend to see its band of one standard error." : "");
}

/// Leaves a panel one band at most, that of its only curve or of the first of several models: two would mix colours.
void leave_one_band(Sheet& sheet, bool one_curve) {
  for (Plot& plot : sheet.plots)
    for (Series& series : plot.series) series.band = one_curve && &series == plot.series.data();
}

Figure curve_figure(const StudyPart& part, const Case& curves, std::vector<ModelAnswers> along) {
  for (ModelAnswers& model : along) model.choice.label = model_in_words(model.choice.label);
  Sheet sheet = study_sheet(curves, along);
  const bool one_curve = sheet.palette == Palette::named;
  leave_one_band(sheet, one_curve);
  std::string caption = fmt::format("{} on {}. Efficiency is drawn where the wheel both drives and pulls.{}{}",
                                    part.question.scenario.tire.name, in_words(part.question.scenario.soil),
                                    part.study.size() > 1 && !one_curve
                                        ? fmt::format(" Dashed: {}.", model_in_words(part.study[1].choice.label))
                                        : "",
                                    bands_in_words(sheet.plots.front().series));
  return {std::move(sheet), std::move(caption)};
}

std::vector<Answer> on_curve(const std::vector<Answer>& answers, const std::string& label) {
  const Curves curves = curves_against_slip(conditions_of(answers), Spread::exact);
  std::vector<Answer> some;
  for (std::size_t i = 0; i < answers.size(); ++i)
    if (curves.labels[curves.curve_of[i]] == label) some.push_back(answers[i]);
  return some;
}

using StudyParts = std::vector<ReportPart>;

/// The figure of one of a study's curves.
Figure figure_of_curve(const StudyPart& part, const Curves& curves, std::size_t c) {
  Case one = part.curves;
  one.study.conditions.clear();
  for (std::size_t i = 0; i < curves.curve_of.size(); ++i)
    if (curves.curve_of[i] == c) one.study.conditions.push_back(part.curves.study.conditions[i]);
  std::vector<ModelAnswers> along = part.along_curves;
  for (ModelAnswers& model : along) model.answers = on_curve(model.answers, curves.labels[c]);
  return curve_figure(part, one, along);
}

/// A curve at a time, the one that the headline speaks of first; all of them last.
void add_curves(Report& report, const StudyPart& part) {
  const Curves curves = curves_against_slip(part.curves.study.conditions, Spread::exact);
  const auto all = [&part] { return StudyParts{{curve_figure(part, part.curves, part.along_curves)}}; };
  if (curves.labels.size() < 2) return report.add(curve_figure(part, part.curves, part.along_curves));
  Choices choices{capital(curves.varying), {}};
  for (std::size_t c = 0; c < curves.labels.size(); ++c)
    choices.all.emplace_back(curves.labels[c],
                             [&part, curves, c] { return StudyParts{{figure_of_curve(part, curves, c)}}; });
  choices.all.emplace_back("all curves at once", all);
  const std::optional<Peak> shown = shown_peak(part);
  if (const auto first = std::ranges::find(curves.labels, shown ? shown->label : ""); first != curves.labels.end())
    choices.first = static_cast<std::size_t>(first - curves.labels.begin());
  report.add(std::move(choices));
}

/// Which standard deviations the errors come from, declared and assumed; nothing for grains, which have none of these.
Prose origin_of_errors(const Scenario& scenario) {
  const std::string words = errors_in_words(scenario);
  return words.empty() ? Prose{} : Prose{{words}};
}

/// `opens`: its curves stand at the head of the page already.
void add_study(Report& report, const StudyPart& part, bool opens) {
  report.add(part.question.study.name, Prose{});
  if (!part.question.description.empty()) report.add(Prose{{part.question.description + "."}});
  if (opens)
    report.add(Prose{{"Its curves are at the top of this page."}});
  else
    add_curves(report, part);
  report.add(origin_of_errors(seen_by(part.question.study.models.front(), part.question.scenario)));
  report.add(peak_table(part));
  report.add(Fold{"All conditions as a table", [&part] { return StudyParts{{answers_table(part)}}; }});
}

void add_campaign(Report& report, const CampaignPart& part) {
  report.add(part.campaign.name,
             channel_errors_table(part.prediction, "Predicted - measured, without fitting",
                                  {"channel", "runs", "RMS error", "bias", "measured range", "share of range [%]"}));
  report.add(origin_of_errors(scenario_of(part.campaign)));
  report.add(Figure(campaign_sheet(part.campaign, part.prediction),
                    "Points: measured runs. Lines: what the model says at the same load, slip and angle, with the soil "
                    "as it was declared beforehand."));
  report.add(Figure(scatter_sheet(part.campaign, part.prediction),
                    "On the dashed line the prediction equals the measurement."));
}

void add_provenance(Report& report, const std::vector<StudyPart>& studies, const std::vector<CampaignPart>& campaigns) {
  report.add("Where the numbers come from", Prose{});
  std::vector<std::string> written;
  const auto once = [&](const std::string& what) {
    const bool fresh = std::ranges::find(written, what) == written.end();
    if (fresh) written.push_back(what);
    return fresh;
  };
  for (const StudyPart& part : studies) {
    const Scenario& scenario = part.question.scenario;
    if (once(tire_words(scenario.tire))) report.add(Prose{{tire_words(scenario.tire)}});
    if (scenario.soil.semi_empirical && once("soil " + scenario.soil.name))
      report.add(soil_table(in_words(scenario.soil), *scenario.soil.semi_empirical, scenario.soil.source));
  }
  for (const CampaignPart& part : campaigns) {
    Tire wheel = part.campaign.wheel;
    if (wheel.name.empty()) wheel.name = "of " + part.campaign.name;
    if (once(tire_words(wheel))) report.add(Prose{{tire_words(wheel)}});
    report.add(soil_table("declared by " + part.campaign.name, part.campaign.soil, ""));
  }
}

/// What each number at the head of the page is of.
std::vector<KeyFigure> key_figures(const std::vector<StudyPart>& studies, const std::vector<CampaignPart>& campaigns) {
  std::vector<KeyFigure> figures;
  for (const StudyPart& part : studies)
    if (const std::optional<Peak> peak = shown_peak(part)) {
      const TractionResult& r = *peak->pull;
      figures.push_back(
          {force(r.drawbar_pull),
           fmt::format("largest drawbar pull of {} on {}{}: {:.0f} % of the load, at {:.3g} % slip ({})",
                       part.question.scenario.tire.name, in_words(part.question.scenario.soil),
                       peak->label.empty() ? "" : " at " + peak->label, 100 * r.drawbar_pull.value / r.at.load,
                       100 * r.at.slip, part.question.study.name)});
    }
  for (const CampaignPart& part : campaigns)
    for (const ChannelError& error : part.prediction.errors)
      if (channel_views[error.channel].name == "drawbar_pull")
        figures.push_back({force(error.rmse), fmt::format("error of the predicted drawbar pull without fitting: RMS "
                                                          "over {} runs, {:.0f} % of the measured range ({})",
                                                          error.runs, 100 * error.share_of_range, part.campaign.name)});
  return figures;
}

/// soilbin-report/1: of each study soilbin-run/1, of each campaign soilbin-predict/1.
Json studies_json(const std::vector<StudyPart>& studies, const std::vector<CampaignPart>& campaigns) {
  return {{"format", "soilbin-report/1"},
          {"studies", list_of(studies,
                              [](const StudyPart& part) {
                                Json study =
                                    run_json(part.question, rows_json(part.question.scenario.tire, part.study));
                                add_warnings(study, {});  // the page's own stand beside it
                                return study;
                              })},
          {"campaigns",
           list_of(campaigns, [](const CampaignPart& part) { return to_json(part.prediction, part.campaign.name); })}};
}

}  // namespace

std::string in_words(const StudyPart& part) {
  if (part.study.empty()) return "";
  const std::size_t leading = leading_model(part);
  const std::vector<Peak> base = peaks(part, leading);
  std::vector<std::size_t> solved;
  for (std::size_t i = 0; i < base.size(); ++i)
    if (base[i].pull != nullptr) solved.push_back(i);
  if (solved.empty()) return "No condition has a solution.";
  const std::size_t shown = solved[(solved.size() - 1) / 2];
  std::string text = largest_pull(base[shown]);
  if (leading > 0)
    text = capital(model_in_words(part.study[leading].choice.label)) + ", at the declared pressure. " + text;
  for (std::size_t m = 0; m < part.study.size(); ++m) {
    if (m == leading) continue;
    const std::vector<Peak> other = peaks(part, m);
    if (other[shown].pull != nullptr)
      text.append(" ").append(other_model(model_in_words(part.study[m].choice.label), base[shown], other[shown]));
  }
  if (solved.size() > 1) text.append(" ").append(change(base[solved.front()], base[solved.back()]));
  return text;
}

std::string in_words(const CampaignPart& part) {
  std::string text = fmt::format("Prediction error without fitting (RMS over {} runs", part.prediction.runs.size());
  if (part.prediction.unsolved > 0) text += fmt::format(", {} not answered", part.prediction.unsolved);
  text += "):";
  const ChannelError* worst = nullptr;
  for (std::size_t i = 0; i < part.prediction.errors.size(); ++i) {
    const ChannelError& error = part.prediction.errors[i];
    const ChannelView& channel = channel_views[error.channel];
    text += fmt::format("{} {} {:.3g} {} ({:.0f} % of the measured range)", i == 0 ? "" : ",", channel.title,
                        error.rmse * channel.per_si, channel.unit, 100 * error.share_of_range);
    if (worst == nullptr || error.share_of_range > worst->share_of_range) worst = &error;
  }
  if (worst != nullptr) {
    const ChannelView& channel = channel_views[worst->channel];
    text += fmt::format(". Worst: {}, on average {:.3g} {} too {}", channel.title,
                        std::abs(worst->bias) * channel.per_si, channel.unit, worst->bias < 0 ? "small" : "large");
  }
  return text + ".";
}

Report report_on(const std::vector<StudyPart>& studies, const std::vector<CampaignPart>& campaigns,
                 const std::vector<PageCard>& links) {
  Report report{
      "soilbin report",
      "What does this tire do on this soil? Answers of the analytic wheel, and how they compare with measurements."};
  report.add(KeyFigures{key_figures(studies, campaigns)}, Told::to_look_at);
  std::vector<std::pair<std::string, std::string>> summary;
  for (const StudyPart& part : studies) summary.emplace_back(part.question.study.name, in_words(part));
  for (const CampaignPart& part : campaigns) summary.emplace_back(part.campaign.name, in_words(part));
  report.add(Sentences(summary));
  const std::size_t told_on_terminals = report.parts.size();
  if (!studies.empty()) add_curves(report, studies.front());
  if (!links.empty()) report.add("More pages", Cards{links}, Told::on_pages);
  if (!studies.empty() && !studies.front().asked_as.empty()) {
    report.add(Prose{
        {"The live page has sliders for load, slip, tire and soil, and its curves follow them. It is opened by"}});
    report.add(Code{"soilbin serve " + shell_words({studies.front().asked_as})});
  }
  for (const StudyPart& part : studies) add_study(report, part, &part == &studies.front());
  for (const CampaignPart& part : campaigns) add_campaign(report, part);
  report.add(WarningsHere());
  add_provenance(report, studies, campaigns);
  for (ReportPart& part : std::span(report.parts).subspan(told_on_terminals))
    if (holds(part.told, Told::on_terminals)) part.told = Told::to_look_at;
  report.notes = {
      "The model is Bekker's pressure-sinkage law with Wong and Reece's stresses under a rigid wheel and Janosi's "
      "shear law; effects named in a model's label are added to it. ± is one standard error, propagated to first order "
      "from the standard deviations of the soil's values. The balance of the load is solved to about 1e-14; the "
      "quadrature is good to 1e-9."};
  std::vector<std::string> labels;
  for (const StudyPart& part : studies)
    for (const ModelAnswers& model : part.study) labels.push_back(model.choice.label);
  report.made_of = names_and_ids(labels);
  report.data = [&] { return studies_json(studies, campaigns); };
  report.data_name = "report";
  return report;
}

}  // namespace soilbin::compare
