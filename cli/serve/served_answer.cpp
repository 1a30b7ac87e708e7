#include "cli/serve/served_answer.hpp"

#include <algorithm>
#include <cmath>
#include <memory>

#include "bekker_wong/effect.hpp"
#include "bekker_wong/model.hpp"
#include "cli/progress.hpp"
#include "cli/serve/controls.hpp"
#include "compare/measured/campaign.hpp"
#include "compare/report/json_fields.hpp"
#include "compare/report/number_text.hpp"
#include "compare/sweep/answer_sheets.hpp"
#include "compare/sweep/wheel_limits.hpp"
#include "compare/telling/answer_report.hpp"
#include "scenario/unit.hpp"

namespace soilbin::cli {
namespace {

using Json = nlohmann::ordered_json;

constexpr int curve_points = 61;

/// A curve shows four numbers a slip, and no stresses.
std::unique_ptr<const Model> make_curve_model(ModelKind kind) {
  if (kind != ModelKind::bekker_wong) return compare::make_model(kind);
  return std::make_unique<const bekker_wong::BekkerWong>(bekker_wong::Detail{.errors = true, .patch = false});
}

/// Whether forces are told in kN, as the load is.
bool tells_kilonewtons(const ServedAnswer& one) {
  return is_told_in_kilonewtons(one.asked.question.study.conditions.front().load);
}

/// How far the tire gives way at the middle of its contact [m]: by what the rim's angle of entry is deeper than its
/// sinkage. 0 for a tire whose effects do not read its inflation pressure.
double deflection(const ServedAnswer& one, const TractionResult& result) {
  const Case& question = one.asked.question;
  const bool flexible = bekker_wong::is_flexible(question.study.models.front().effects);
  const double rim = question.scenario.tire.radius * (1.0 - std::cos(result.entry_angle));
  return flexible ? std::max(0.0, rim - result.sinkage.value) : 0.0;
}

}  // namespace

void in_kilonewtons(compare::Sheet& sheet) {
  const std::string newtons = "[N]";
  for (compare::Plot& plot : sheet.plots) {
    const std::size_t at = plot.title.find(newtons);
    if (at == std::string::npos) continue;
    plot.title.replace(at, newtons.size(), "[kN]");
    for (compare::Series& series : plot.series)
      for (std::vector<double>* values : {&series.y, &series.error, &series.base})
        for (double& value : *values) value /= 1000.0;
  }
}

Case swept_over(Case question, const std::pair<double, double>& slips) {
  OperatingCondition at = question.study.conditions.front();
  question.study.conditions.clear();
  for (int i = 0; i < curve_points; ++i) {
    at.slip = std::lerp(slips.first, slips.second, static_cast<double>(i) / (curve_points - 1));
    question.study.conditions.push_back(at);
  }
  return question;
}

ServedAnswer answer_to(Asked asked, const std::pair<double, double>& slips) {
  ServedAnswer one{std::move(asked), {}, {}, {}};
  Case& question = one.asked.question;
  one.notes = one.asked.tire.apply(question, one.asked.base_model);
  one.swept = swept_over(one.asked.question, slips);
  const compare::Progress until_asked = [](std::size_t, std::size_t) {
    if (interrupt_asked()) throw Interrupted();
  };
  one.point = compare::run_study(one.asked.question, until_asked);
  one.curves = compare::run_study(one.swept, until_asked, make_curve_model);
  return one;
}

Json curves_json(const std::vector<ServedAnswer>& sides) {
  compare::Sheet all;
  for (std::size_t side = 0; side < sides.size(); ++side) {
    const ServedAnswer& one = sides[side];
    compare::Sheet sheet = compare::study_sheet(one.swept, one.curves, compare::Panels::all);
    const compare::Sheet here = compare::study_sheet(one.asked.question, one.point, compare::Panels::all);
    if (side == 0) all = {sheet.title, std::vector<compare::Plot>(sheet.plots.size()), sheet.palette};
    for (std::size_t i = 0; i < sheet.plots.size(); ++i) {
      compare::Plot& plot = all.plots[i];
      if (side == 0) plot = {sheet.plots[i].title, sheet.plots[i].x, sheet.plots[i].y, {}, false};
      for (compare::Series& series : sheet.plots[i].series) {
        series.label = one.label, series.color = side == 0 ? 0 : 2;
        plot.series.push_back(std::move(series));
      }
      for (compare::Series series : here.plots[i].series) {
        series.mark = compare::Mark::points;
        series.label = one.label.empty() ? "this point" : one.label + ", this point";
        series.color = side == 0 ? 1 : 2;
        if (sides.size() > 1)
          series.error.clear();  // bars would stand beside each other, off their slip; bands tell it
        plot.series.push_back(std::move(series));
      }
    }
  }
  if (tells_kilonewtons(sides.front())) in_kilonewtons(all);
  return compare::to_json(all);
}

Json stresses_json(const std::vector<ServedAnswer>& sides) {
  std::vector<compare::LabelledPatch> patches;
  for (const ServedAnswer& one : sides)
    if (const auto& result = one.point.front().answers.front().result)
      patches.push_back({one.label, one.label == sides.front().label ? 0 : 2, result->patch});
  return compare::to_json(compare::patch_sheet("Stresses along the contact", patches));
}

Json budget_json(const std::vector<ServedAnswer>& sides) {
  std::vector<compare::LabelledAnswers> curves;
  for (const ServedAnswer& one : sides) curves.push_back({one.label, one.curves.front().answers});
  compare::Sheet sheet = compare::budget_sheet("Parts of the drawbar pull", curves);
  if (tells_kilonewtons(sides.front())) in_kilonewtons(sheet);
  return compare::to_json(sheet);
}

Json wheel_json(const ServedAnswer& one) {
  const auto& result = one.point.front().answers.front().result;
  if (!result) return nullptr;
  const Tire& tire = one.asked.question.scenario.tire;
  Json json = {{"label", one.label},
               {"radius", tire.radius},
               {"lug_height", tire.lugs.height},
               {"lug_count", tire.lugs.count.value_or(0)},
               {"load", result->at.load},
               {"incline", result->at.longitudinal_incline},
               {"drawbar_pull", result->drawbar_pull.value},
               {"torque", result->torque.value},
               {"sinkage", result->sinkage.value},
               {"deflection", deflection(one, *result)},
               {"entry", result->entry_angle},
               {"exit", result->exit_angle},
               {"theta", Json::array()},
               {"normal", Json::array()},
               {"shear", Json::array()}};
  constexpr std::size_t most = 96;
  const std::size_t every = result->patch.size() / most + 1;
  for (std::size_t k = 0; k < result->patch.size(); k += every) {
    const StressSample& sample = result->patch[k];
    json["theta"].push_back(sample.theta);
    json["normal"].push_back(compare::finite(sample.normal));
    json["shear"].push_back(compare::finite(sample.shear));
  }
  return json;
}

Json readings_json(const ServedAnswer& one) {
  const auto& result = one.point.front().answers.front().result;
  if (!result) return Json::array();
  const std::size_t channels = compare::channel_views.size();
  std::vector<compare::PrintedValue> readings = compare::printed_values(
      *result, tells_kilonewtons(one) ? compare::ForcesIn::kilonewtons : compare::ForcesIn::newtons);
  if (const std::optional<double> steepest = compare::steepest_slope(one.asked.question))
    readings.insert(readings.begin() + static_cast<std::ptrdiff_t>(channels) + 1,
                    {"Steepest slope", compare::number(*steepest / degree), "deg"});
  return compare::list_of(readings, [](const compare::PrintedValue& reading) {
    return Json{{"name", reading.name}, {"value", reading.value}, {"unit", reading.unit}};
  });
}

}  // namespace soilbin::cli
