// The figures of a comparison: curves of all sides, heat maps of differences, stresses, contact angles, sinkage,
// budget.
#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <optional>
#include <utility>

#include "compare/discrepancy/comparison.hpp"
#include "compare/report/number_text.hpp"
#include "compare/sweep/answer_sheets.hpp"
#include "compare/sweep/varying.hpp"
#include "compare/telling/comparison_report.hpp"
#include "scenario/estimate.hpp"
#include "scenario/unit.hpp"

namespace soilbin::compare {
namespace {

using Reader = std::function<Estimate(const SidePoint&, std::size_t condition)>;

/// The conditions of one curve in rising order of slip.
std::vector<std::size_t> members_of(const Comparison& comparison, std::size_t curve) {
  const Curves& curves = comparison.curves;
  std::vector<std::size_t> members;
  for (std::size_t i = 0; i < curves.curve_of.size(); ++i)
    if (curves.curve_of[i] == curve) members.push_back(i);
  const auto& conditions = comparison.question.study.conditions;
  std::ranges::stable_sort(members,
                           [&](std::size_t a, std::size_t b) { return conditions[a].slip < conditions[b].slip; });
  return members;
}

/// "paper-straight, 4 kN"; also what a figure's files are called by.
std::string curve_title(const Comparison& comparison, std::size_t curve) {
  const std::string& label = comparison.curves.labels[curve];
  return comparison.question.study.name + (label.empty() ? "" : ", " + label);
}

Mark mark_of(SideKind kind) {
  if (kind == SideKind::measured) return Mark::points;
  return kind == SideKind::grains ? Mark::line_and_points : Mark::line;
}

Series series_of(const Comparison& comparison, std::size_t side, const std::vector<std::size_t>& members,
                 const Reader& read, double per_unit) {
  const Side& one = comparison.sides[side];
  Series series;
  series.label = name_of(one);
  series.color = static_cast<int>(side);
  series.mark = mark_of(one.kind);
  bool sure = true;
  for (const std::size_t i : members) {
    const Estimate y = one.points[i].result ? read(one.points[i], i) : Estimate{not_a_number, 0.0};
    series.x.push_back(100 * comparison.question.study.conditions[i].slip);
    series.y.push_back(y.value * per_unit);
    series.error.push_back(y.std_error * per_unit);
    sure = sure && y.std_error == 0.0;
  }
  if (sure) series.error.clear();
  return series;
}

bool says_anything(const Series& series) {
  return std::ranges::any_of(series.y, [](double y) { return std::isfinite(y); });
}

/// Smooth lines of the analytic sides, and the curve's conditions among theirs.
struct Smooth {
  const Comparison& sides;
  std::vector<std::size_t> members;
};

/// A number of each condition, to be drawn against slip.
struct ChannelPanel {
  std::string title;  ///< with its unit
  Reader read;        ///< [SI]
  double per_si = 1.0;
  const Smooth* smooth = nullptr;          ///< none: the conditions' own points
  std::optional<double> lower{}, upper{};  ///< what the number can't be below and above, in the title's unit
};

/// A panel with a series for each side that has a value.
void add_panel(Sheet& sheet, const Comparison& comparison, const std::vector<std::size_t>& members,
               const ChannelPanel& panel) {
  Plot plot{panel.title, {"slip [%]"}, {"", panel.lower}};
  for (std::size_t s = 0; s < comparison.sides.size(); ++s) {
    const bool many = panel.smooth != nullptr && s < panel.smooth->sides.sides.size();
    Series series = many ? series_of(panel.smooth->sides, s, panel.smooth->members, panel.read, panel.per_si)
                         : series_of(comparison, s, members, panel.read, panel.per_si);
    series.label = name_of(comparison.sides[s]);
    if (says_anything(series)) plot.series.push_back(std::move(series));
  }
  for (const Series& series : plot.series)  // the axis ends at what is possible, and cuts a band there
    for (std::size_t k = 0; k < series.error.size(); ++k)
      if (panel.upper && series.y[k] + series.error[k] > *panel.upper) plot.y.upper = panel.upper;
  if (!plot.series.empty()) sheet.plots.push_back(std::move(plot));
}

constexpr int single_color = 4, negative_color = 3;

/// Whether a point of grains rests on one packing, so that nothing is known of the scatter between beds.
bool of_one_packing(const SidePoint& point) { return point.result && point.runs == 1; }

/// The side's name in a legend, with what limits all of its points.
std::string label_with_limits(const Side& side, bool coarse_grains) {
  if (side.kind != SideKind::grains) return name_of(side);
  std::string label = name_of(side);
  if (coarse_grains) label += ", coarse for the wheel";
  const bool single =
      std::ranges::all_of(side.points, [](const SidePoint& point) { return !point.result || of_one_packing(point); });
  return single ? label + ", one bed sample each" : label;
}

/// The points of a series at which `marked` holds of the side's point, as marks of their own; no points: none is.
Series marks_on(const Series& series, const std::string& label, int color, const std::vector<std::size_t>& members,
                const std::function<bool(std::size_t condition, double y)>& marked) {
  Series marks{.label = label, .mark = Mark::points, .color = color};
  for (std::size_t k = 0; k < members.size(); ++k)
    if (std::isfinite(series.y[k]) && marked(members[k], series.y[k]))
      marks.x.push_back(series.x[k]), marks.y.push_back(series.y[k]);
  return marks;
}

/// Labels with their limits, and marks on the points of grains that have a limit of their own.
void mark_limits(Plot& plot, const Comparison& comparison, const std::vector<std::size_t>& members, bool sinkage,
                 bool coarse_grains) {
  std::vector<Series> marks;
  for (const Side& side : comparison.sides) {
    const auto series =
        std::ranges::find_if(plot.series, [&](const Series& one) { return one.label == name_of(side); });
    if (side.kind != SideKind::grains || series == plot.series.end()) continue;
    series->label = label_with_limits(side, coarse_grains);
    if (series->label.find("one bed sample") == std::string::npos)
      marks.push_back(marks_on(*series, "one bed sample: the scatter is unknown", single_color, members,
                               [&](std::size_t i, double) { return of_one_packing(side.points[i]); }));
    if (sinkage)
      marks.push_back(marks_on(*series, "negative sinkage: the tread is above the mean surface", negative_color,
                               members, [](std::size_t, double y) { return y < 0.0; }));
  }
  for (Series& mark : marks)
    if (!mark.x.empty()) plot.series.push_back(std::move(mark));
}

}  // namespace

Sheet overview_sheet(const Comparison& comparison, const Comparison& smooth) {
  std::vector<ModelAnswers> study;
  for (std::size_t s = 0; s < comparison.sides.size(); ++s) {
    const Comparison& from = s < smooth.sides.size() ? smooth : comparison;
    const std::vector<SidePoint>& points = from.sides[s].points;
    ModelAnswers answers{{ModelKind::bekker_wong, {}, name_of(comparison.sides[s])}, {}};
    for (std::size_t i = 0; i < points.size(); ++i)
      answers.answers.push_back({from.question.study.conditions[i], points[i].result, points[i].error});
    study.push_back(std::move(answers));
  }
  Sheet sheet = study_sheet(comparison.question, study);
  const std::size_t curves = comparison.curves.labels.size();  // a plot's series go by model, then by curve
  for (Plot& plot : sheet.plots)
    for (std::size_t k = 0; k < plot.series.size(); ++k)
      plot.series[k].mark = mark_of(comparison.sides[k / curves].kind);
  return sheet;
}

Comparison smooth_sides(const Comparison& comparison) {
  constexpr int points = 41;
  Comparison smooth;
  smooth.question = with_smooth_curves(comparison.question, points);
  smooth.question.study.models.clear();
  for (const Side& side : comparison.sides)
    if (side.choice) smooth.question.study.models.push_back(*side.choice);
  smooth.curves = curves_against_slip(smooth.question.study.conditions, Spread::exact);
  for (const ModelAnswers& answers : run_study(smooth.question)) smooth.sides.push_back(side_of(answers));
  return smooth;
}

Sheet curve_sheet(const Comparison& comparison, std::size_t curve, bool coarse_grains, const Comparison& smooth) {
  Sheet sheet{curve_title(comparison, curve)};
  const std::vector<std::size_t> members = members_of(comparison, curve);
  const Smooth lines{smooth, smooth.sides.empty() ? members : members_of(smooth, curve)};
  for (std::size_t c = 0; c < channel_views.size(); ++c) {
    const ChannelView& channel = channel_views[c];
    const bool compared = std::ranges::any_of(comparison.tallies, [&](const Tally& t) { return t.channel == c; });
    if (!compared && channel.sideways) continue;
    const auto read = [&, c](const SidePoint& point, std::size_t) {
      return point.has[c] ? (*point.result).*channel_views[c].predicted : Estimate{not_a_number, 0.0};
    };
    add_panel(sheet, comparison, members, {heading(channel), read, channel.per_si, &lines});
    if (!sheet.plots.empty())
      mark_limits(sheet.plots.back(), comparison, members, channel.name == "sinkage", coarse_grains);
  }
  const auto efficiency = [](const SidePoint& point, std::size_t) {
    return has_efficiency(*point.result) ? efficiency_with_error(*point.result) : Estimate{not_a_number, 0.0};
  };
  add_panel(sheet, comparison, members, {"Tractive efficiency [%]", efficiency, 100, &lines, 0.0, 100.0});
  if (!sheet.plots.empty()) mark_limits(sheet.plots.back(), comparison, members, false, coarse_grains);
  return sheet;
}

Sheet contact_sheet(const Comparison& comparison, std::size_t curve) {
  Sheet sheet{curve_title(comparison, curve) + ", contact and sinkage"};
  const std::vector<std::size_t> members = members_of(comparison, curve);
  const std::pair<const char*, double TractionResult::*> angles[] = {
      {"Entry angle [deg]", &TractionResult::entry_angle},
      {"Exit angle [deg]", &TractionResult::exit_angle},
      {"Angle of the largest stress [deg]", &TractionResult::max_stress_angle}};
  for (const auto& [title, angle] : angles)
    add_panel(sheet, comparison, members,
              {title,
               [member = angle](const SidePoint& point, std::size_t) {
                 return Estimate{(*point.result).*member, 0.0};
               },
               1 / degree});
  std::map<std::pair<std::size_t, std::size_t>, double> by_slip;
  for (const SinkageSplit& split : sinkage_splits(comparison)) by_slip[{split.side, split.condition}] = split.by_slip;
  Plot plot{"Sinkage that slip adds [mm]", {"slip [%]"}};
  for (std::size_t s = 0; s < comparison.sides.size(); ++s) {
    const Reader read = [&, s](const SidePoint&, std::size_t i) {
      const auto found = by_slip.find({s, i});
      return Estimate{found == by_slip.end() ? not_a_number : found->second, 0.0};
    };
    Series series = series_of(comparison, s, members, read, 1000);
    if (says_anything(series)) plot.series.push_back(std::move(series));
  }
  if (!plot.series.empty()) sheet.plots.push_back(std::move(plot));
  return sheet;
}

Sheet stress_sheet(const Comparison& comparison, std::size_t condition) {
  std::vector<LabelledPatch> patches;
  for (std::size_t s = 0; s < comparison.sides.size(); ++s)
    if (const auto& result = comparison.sides[s].points[condition].result)
      patches.push_back({name_of(comparison.sides[s]), static_cast<int>(s), result->patch});
  return patch_sheet("stresses at " + in_words(comparison.question.study.conditions[condition]), patches);
}

HeatMap heat_map_of(const Comparison& comparison, const Tally& tally) {
  const Curves& curves = comparison.curves;
  const auto& conditions = comparison.question.study.conditions;
  std::vector<double> slips;
  for (const OperatingCondition& at : conditions)
    if (std::ranges::none_of(slips, [&](double s) { return std::abs(s - at.slip) < 1e-9; })) slips.push_back(at.slip);
  std::ranges::sort(slips);
  HeatMap map;
  map.title = fmt::format("{} [% of {}]", capital(std::string(channel_views[tally.channel].title)),
                          scale_in_words(channel_views[tally.channel]));
  map.subtitle = less_in_words(comparison, tally);
  map.x_title = "slip [%]";
  map.y_title = curves.varying.empty() ? "curve" : curves.varying;
  for (const double slip : slips) map.x.push_back(fmt::format("{:.4g}", 100 * slip));
  for (const std::string& label : curves.labels) map.y.push_back(label.empty() ? "all" : label);
  map.cells.assign(curves.labels.size(), std::vector<HeatCell>(slips.size(), HeatCell{not_a_number, "", "", true}));
  for (const Difference& d : comparison.differences) {
    if (!d.is_of(tally)) continue;
    const auto column =
        std::ranges::find_if(slips, [&](double s) { return std::abs(s - conditions[d.condition].slip) < 1e-9; }) -
        slips.begin();
    const std::string sigma = std::isfinite(d.sigma) ? fmt::format(", {:.1f} standard errors", d.sigma) : "";
    const int places = std::abs(d.share) < 1.0 ? 1 : 0;
    const bool none = std::abs(d.share) < 0.0005;  // is written as 0.0
    map.cells[curves.curve_of[d.condition]][column] = {
        none ? 0.0 : 100 * d.share, none ? "0.0" : fmt::format("{:+.{}f}", 100 * d.share, places),
        fmt::format("{}: {} ({:+.2f} %{}): {}", in_words(conditions[d.condition]), in_unit(d.channel, d.difference),
                    100 * d.share, sigma, words(d.finding)),
        d.finding == DifferenceFinding::difference};
  }
  return map;
}

std::pair<Bars, std::vector<int>> budget_bars(const Comparison& comparison, std::size_t condition) {
  const BudgetTable table = budget_at(comparison, condition);
  Bars bars{"Thrust and resistance [N]", {}, {}};
  std::vector<int> colors_of_sides;
  for (const std::size_t s : table.sides) {
    bars.sides.push_back(name_of(comparison.sides[s]));
    colors_of_sides.push_back(static_cast<int>(s % colors(Palette::named).size()));
  }
  for (const BudgetRow& row : table.rows) bars.groups.push_back({part_in_words(row.name), row.force});
  BarGroup whole{"drawbar pull", {}};
  for (const std::size_t s : table.sides)
    whole.values.push_back(comparison.sides[s].points[condition].result->drawbar_pull.value);
  if (!table.rows.empty()) bars.groups.push_back(std::move(whole));
  return {bars, colors_of_sides};
}

}  // namespace soilbin::compare
