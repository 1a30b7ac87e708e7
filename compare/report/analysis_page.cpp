#include "compare/report/analysis_page.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "compare/report/curves.hpp"
#include "compare/report/number_text.hpp"
#include "compare/report/page.hpp"
#include "compare/report/peaks.hpp"
#include "compare/sweep/varying.hpp"
#include "scenario/soil_parameters.hpp"
#include "scenario/unit.hpp"

namespace soilbin::compare {
namespace {

std::string percent_to_tenths(double share) { return fmt::format("{:.4g}", std::round(1000 * share) / 10); }

/// The cells of one curve, without its model.
std::vector<std::string> peak_row(const Peak& peak) {
  std::vector<std::string> row = {peak.label.empty() ? "all" : peak.label};
  if (peak.unsolved > 0) row[0] += fmt::format(" ({} without a solution)", peak.unsolved);
  if (peak.pull != nullptr)
    row.insert(row.end(), {number(peak.pull->drawbar_pull), percent_to_tenths(peak.pull->at.slip),
                           number(peak.pull->torque), number(peak.pull->sinkage, 1000)});
  else
    row.insert(row.end(), 4, "-");
  row.push_back(peak.efficiency != nullptr ? percent_to_tenths(peak.efficiency->tractive_efficiency) : "-");
  row.push_back(peak.efficiency != nullptr ? percent_to_tenths(peak.efficiency->at.slip) : "-");
  return row;
}

HtmlTable peak_table(const StudyPart& part) {
  HtmlTable table{"Where each curve pulls most, and where it is most efficient",
                  {"curve", "largest pull [N]", "at slip [%]", "torque [N m]", "sinkage [mm]", "best efficiency [%]",
                   "at slip [%]"},
                  {},
                  {true}};
  const bool several = part.study.size() > 1;
  if (several) {
    table.header.insert(table.header.begin(), "model");
    table.text_columns.push_back(true);
  }
  for (const ModelAnswers& model : part.study)
    for (const Peak& peak : peaks(model)) {
      table.rows.push_back(peak_row(peak));
      if (several) table.rows.back().insert(table.rows.back().begin(), model.choice.label);
    }
  return table;
}

HtmlTable answers_table(const StudyPart& part) {
  HtmlTable table{
      "",
      {"model", "condition", "drawbar pull [N]", "torque [N m]", "sinkage [mm]", "lateral force [N]", "efficiency [%]"},
      {},
      {true, true}};
  for (const ModelAnswers& model : part.study)
    for (const Answer& answer : model.answers) {
      std::vector<std::string> row = {model.choice.label, in_words(answer.at)};
      if (!answer.result)
        row.push_back("no solution: " + answer.error);
      else
        for (const ChannelView& channel : channel_views)
          row.push_back(number((*answer.result).*channel.predicted, channel.per_si));
      if (answer.result)
        row.push_back(has_efficiency(*answer.result) ? number(100 * answer.result->tractive_efficiency) : "-");
      row.resize(table.header.size());
      table.rows.push_back(std::move(row));
    }
  return table;
}

HtmlTable error_table(const Prediction& prediction) {
  HtmlTable table{"Predicted less measured, nothing fitted",
                  {"channel", "runs", "root mean square", "bias", "range measured", "share of range [%]"},
                  {},
                  {}};
  for (const ChannelError& error : prediction.errors) {
    const ChannelView& channel = channel_views[error.channel];
    const auto in_unit = [&](double si) { return fmt::format("{} {}", number(si * channel.per_si), channel.unit); };
    table.rows.push_back({std::string(channel.title), std::to_string(error.runs), in_unit(error.rmse),
                          in_unit(error.bias), in_unit(error.range), number(100 * error.share_of_range)});
  }
  return table;
}

std::string source_of(const std::map<std::string, std::string>& sources, const std::string& key) {
  const auto found = sources.find(key);
  return found == sources.end() ? "" : found->second;
}

HtmlTable soil_table(const std::string& name, const SemiEmpiricalSoil& soil, const std::string& source) {
  HtmlTable table{"Soil " + name + (source.empty() ? "" : ": " + source),
                  {"value", "", "unit", "source"},
                  {},
                  {true, false, true, true}};
  for (const SoilParameter& p : soil_parameters)
    table.rows.push_back({p.title, number(soil.*p.value, p.per_si), p.unit, source_of(soil.sources, p.name)});
  table.rows.push_back({"density", number(bulk_density(soil)), "kg/m^3",
                        soil.density ? source_of(soil.sources, "density") : "presumed: the soil declares none"});
  return table;
}

std::string tire_words(const Tire& tire) {
  std::string text = fmt::format("Wheel {}: radius {} mm, width {} mm, ", tire.name, number(1000 * tire.radius),
                                 number(1000 * tire.width));
  text += is_lugged(tire) ? fmt::format("lugs of {} mm", number(1000 * tire.lugs.height)) : "smooth";
  return text + (tire.source.empty() ? "." : ". Source: " + tire.source + ".");
}

void add_study(Page& page, const StudyPart& part) {
  page.section(part.question.study.name);
  if (!part.question.description.empty()) page.paragraph(part.question.description + ".");
  const Sheet sheet = study_sheet(part.question, part.study);
  page.figure(sheet, fmt::format("{} on {}. Efficiency is drawn where the wheel both drives and pulls.{}",
                                 part.question.scenario.tire.name, in_words(part.question.scenario.soil),
                                 part.study.size() > 1 ? " Dashed: the model with its effect." : ""));
  page.table(peak_table(part));
  page.folded("All conditions as a table", [&] { page.table(answers_table(part)); });
}

void add_campaign(Page& page, const CampaignPart& part) {
  page.section(part.campaign.name);
  page.table(error_table(part.prediction));
  page.figure(campaign_sheet(part.campaign, part.prediction),
              "Points: measured runs. Lines: what the model says at the same load, slip and angle, with the soil as it "
              "was declared beforehand.");
  page.figure(scatter_sheet(part.campaign, part.prediction),
              "On the dashed line the prediction equals the measurement.");
}

void add_provenance(Page& page, const std::vector<StudyPart>& studies, const std::vector<CampaignPart>& campaigns) {
  page.section("Where the numbers come from");
  std::vector<std::string> told;
  const auto once = [&](const std::string& what) {
    const bool fresh = std::find(told.begin(), told.end(), what) == told.end();
    if (fresh) told.push_back(what);
    return fresh;
  };
  for (const StudyPart& part : studies) {
    const Scenario& scenario = part.question.scenario;
    if (once(tire_words(scenario.tire))) page.paragraph(tire_words(scenario.tire));
    if (scenario.soil.semi_empirical && once("soil " + scenario.soil.name))
      page.table(soil_table(in_words(scenario.soil), *scenario.soil.semi_empirical, scenario.soil.source));
  }
  for (const CampaignPart& part : campaigns) {
    Tire wheel = part.campaign.wheel;
    if (wheel.name.empty()) wheel.name = "of " + part.campaign.name;
    if (once(tire_words(wheel))) page.paragraph(tire_words(wheel));
    page.table(soil_table("declared by " + part.campaign.name, part.campaign.soil, ""));
  }
}

}  // namespace

std::string analysis_page(const std::vector<StudyPart>& studies, const std::vector<CampaignPart>& campaigns,
                          const PageAbout& about) {
  Page page(about.title,
            "What does this tire do on this soil? Answers of the semi-empirical wheel model, and how they "
            "compare with measurements.");
  std::vector<std::pair<std::string, std::string>> summary;
  for (const StudyPart& part : studies) summary.emplace_back(part.question.study.name, in_words(part));
  for (const CampaignPart& part : campaigns) summary.emplace_back(part.campaign.name, in_words(part));
  bool doubt = false;
  for (const StudyPart& part : studies)
    for (const ModelAnswers& model : part.study)
      for (const Answer& answer : model.answers)
        doubt = doubt || (answer.result && answer.result->drawbar_pull.std_error > 0.0);
  if (doubt) summary.emplace_back("", "± is one standard error, from the standard deviations of the soil's values.");
  page.summary(summary);
  page.doubts(about.doubts);
  for (const StudyPart& part : studies) add_study(page, part);
  for (const CampaignPart& part : campaigns) add_campaign(page, part);
  add_provenance(page, studies, campaigns);
  page.section("How this page was made");
  page.paragraph(
      "The model is Bekker's pressure-sinkage law with Wong and Reece's stresses under a rigid wheel and "
      "Janosi's shear law; effects named in a model's label are added to it. ± is one standard error, "
      "propagated to first order from the standard deviations of the soil's values. The balance of the load "
      "is solved to about 1e-14; the quadrature is good to 1e-9.");
  page.code(about.command);
  HtmlTable versions{"", {"part", "version"}, {}, {true, true}};
  for (const auto& [name, version] : about.versions) versions.rows.push_back({name, version});
  page.table(versions);
  return page.html();
}

}  // namespace soilbin::compare
