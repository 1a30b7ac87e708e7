#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <utility>

#include "compare/measured/campaign.hpp"
#include "compare/measured/condition_views.hpp"
#include "compare/report/number_text.hpp"
#include "compare/sweep/varying.hpp"
#include "compare/telling/loop_report.hpp"
#include "scenario/errors.hpp"

namespace soilbin::compare {
namespace {

constexpr int before_color = 1, after_color = 0, measured_color = 5;

const Observations& seen(const LoopAnswer& answer) { return answer.found().base.data().observations; }

/// The model with effects; null where the answer's model takes none.
const FittedModel* model_after(const LoopAnswer& answer) { return answer.uses_effects() ? &answer.model() : nullptr; }

bool has_cells(const Observations& observations, int channel) {
  return std::ranges::any_of(observations.cells, [&](const Cell& c) { return c.channel == channel; });
}

/// (measured - predicted)/sd of each cell.
Eigen::VectorXd standardised(const LoopAnswer& answer, const Eigen::VectorXd& difference, const Eigen::VectorXd& at) {
  Eigen::VectorXd r = difference;
  for (Eigen::Index i = 0; i < r.size(); ++i) {
    const Cell& cell = seen(answer).cells[i];
    r[i] /= answer.noise.channels[cell.channel].sd(at[i], cell.spread);
  }
  return r;
}

/// What the effects change in the prediction, soil refitted, in sd of the noise.
Eigen::VectorXd change_by_effects(const LoopAnswer& answer) {
  const Eigen::VectorXd& base = answer.found().base.fit().prediction;
  return standardised(answer, answer.model().fit().prediction - base, base);
}

/// A number for each cell [sd of the noise], and how it is drawn.
struct DrawnValues {
  const char* label;
  int color;
  Eigen::VectorXd values;
};

/// Values over a covariate, sorted by it: a panel for each channel.
Sheet over(const Observations& observations, const Covariate& x, std::string title,
           const std::vector<DrawnValues>& drawn) {
  const ConditionView& view = condition_view(x.name);
  Sheet sheet{std::move(title)};
  for (int channel = 0; channel < channel_count; ++channel) {
    if (!has_cells(observations, channel)) continue;
    Plot plot{capital(std::string(channel_views[channel].title)) + " [sd of the noise]", {heading(view)}};
    for (const auto& [label, color, values] : drawn) {
      std::vector<std::pair<double, double>> points;
      for (std::size_t i = 0; i < observations.cells.size(); ++i)
        if (observations.cells[i].channel == channel)
          points.emplace_back(view.per_si * x.values[observations.cells[i].row], values[i]);
      std::ranges::stable_sort(points, [](const auto& a, const auto& b) { return a.first < b.first; });
      Series& series = plot.series.emplace_back(Series{.label = label, .mark = Mark::points, .color = color});
      for (const auto& [at, value] : points) series.x.push_back(at), series.y.push_back(value);
    }
    sheet.plots.push_back(std::move(plot));
  }
  return sheet;
}

/// Where each row is drawn along a variable. Rows of few levels are spread about theirs, so that they can be seen.
std::vector<double> drawn_at(const Covariate& x) {
  constexpr std::size_t few = 8;
  constexpr double spread = 0.07;  // of the range
  const double per_si = condition_view(x.name).per_si, step = 1e-3 * (x.values.maxCoeff() - x.values.minCoeff());
  std::map<long long, std::vector<Eigen::Index>> levels;
  for (Eigen::Index row = 0; row < x.values.size(); ++row)
    levels[std::llround(x.values[row] / std::max(step, 1e-300))].push_back(row);
  std::vector<double> at(static_cast<std::size_t>(x.values.size()));
  for (const auto& [level, rows] : levels)
    for (std::size_t k = 0; k < rows.size(); ++k) {
      const double off = levels.size() > few || rows.size() < 2
                             ? 0.0
                             : spread * (static_cast<double>(k) / static_cast<double>(rows.size() - 1) - 0.5);
      at[rows[k]] = per_si * (x.values[rows[k]] + 1e3 * step * off);
    }
  return at;
}

/// The condition between a curve's runs: the mean of each number that they state.
OperatingCondition middle_of(const Observations& observations, const std::vector<int>& rows) {
  OperatingCondition middle = observations.rows[rows.front()];
  for (const ConditionView& view : condition_views) {
    double sum = 0.0;
    for (const int row : rows) sum += view.get(observations.rows[row]);
    if (std::isfinite(sum)) view.set(middle, sum / static_cast<double>(rows.size()));
  }
  return middle;
}

/// One model's channels along a curve; not a number where it has no balance.
std::vector<Series> along(const FittedModel& model, OperatingCondition at, double from, double to, Series like) {
  constexpr int points = 49;
  std::vector<Series> series(channel_count, like);
  for (int i = 0; i < points; ++i) {
    at.slip = from + (to - from) * i / (points - 1);
    std::optional<bekker_wong::Reading> reading;
    try {
      reading = model.predictor().reading(model.fit().theta, at);
    } catch (const NoSolution&) {}
    for (int c = 0; c < channel_count; ++c) {
      series[c].x.push_back(100 * at.slip);
      series[c].y.push_back(reading ? channel_views[c].per_si * channel_of(*reading, c) : not_a_number);
    }
  }
  return series;
}

/// The measured values of a curve's rows, each with the noise of one run.
Series measured_on(const LoopAnswer& answer, const std::vector<int>& rows, int channel) {
  const Observations& observations = seen(answer);
  const FittedModel* after = model_after(answer);
  const Eigen::VectorXd& prediction = after ? after->fit().prediction : answer.found().base.fit().prediction;
  const std::set<int> wanted(rows.begin(), rows.end());
  Series series{.label = "measured", .mark = Mark::points, .color = measured_color};
  const double per_si = channel_views[channel].per_si;
  for (std::size_t i = 0; i < observations.cells.size(); ++i) {
    const Cell& cell = observations.cells[i];
    if (cell.channel != channel || !wanted.contains(cell.row)) continue;
    series.x.push_back(100 * observations.rows[cell.row].slip);
    series.y.push_back(per_si * cell.value);
    series.error.push_back(per_si * answer.noise.channels[channel].sd(prediction[i], cell.spread));
  }
  return series;
}

/// The rows of each curve against slip that has four slips or more.
std::vector<std::pair<std::string, std::vector<int>>> curves_with_points(const Observations& observations) {
  constexpr std::size_t least_slips = 4;
  const Curves curves = curves_against_slip(observations.rows, Spread::measured);
  std::vector<std::pair<std::string, std::vector<int>>> found;
  for (const std::string& label : curves.labels) found.emplace_back(label, std::vector<int>());
  for (std::size_t row = 0; row < observations.rows.size(); ++row)
    found[curves.curve_of[row]].second.push_back(static_cast<int>(row));
  std::erase_if(found, [&](const auto& curve) {
    std::set<long> slips;  // in per cent
    for (const int row : curve.second) slips.insert(std::lround(100 * observations.rows[row].slip));
    return slips.size() < least_slips;
  });
  return found;
}

}  // namespace

Sheet fit_sheet(const LoopAnswer& answer, const std::vector<int>& rows) {
  const Observations& observations = seen(answer);
  const OperatingCondition middle = middle_of(observations, rows);
  const auto [low, high] = std::ranges::minmax_element(
      rows, [&](int a, int b) { return observations.rows[a].slip < observations.rows[b].slip; });
  const double from = observations.rows[*low].slip, to = observations.rows[*high].slip;
  const FittedModel* after = model_after(answer);
  const auto before_curves =
      along(answer.found().base, middle, from, to,
            {.label = after ? "model before" : "model", .color = before_color, .dash = after ? 1 : 0});
  const auto after_curves = after ? along(*after, middle, from, to,
                                          {.label = "model after", .x = {}, .y = {}, .error = {}, .color = after_color})
                                  : std::vector<Series>();
  Sheet sheet{""};
  for (int c = 0; c < channel_count; ++c) {
    Series measured = measured_on(answer, rows, c);
    if (measured.x.empty()) continue;
    Plot plot{heading(channel_views[c]), {heading(condition_view("slip"))}};
    plot.series = {std::move(measured), before_curves[c]};
    if (after) plot.series.push_back(after_curves[c]);
    sheet.plots.push_back(std::move(plot));
  }
  return sheet;
}

std::vector<std::pair<std::string, std::vector<int>>> curves_of_the_fit(const LoopAnswer& answer) {
  constexpr std::size_t most_curves = 12;
  const Observations& observations = seen(answer);
  auto curves = curves_with_points(observations);
  std::size_t covered = 0;
  for (const auto& [label, rows] : curves) covered += rows.size();
  if (2 * covered < observations.rows.size() || curves.size() > most_curves) return {};
  if (model_after(answer) != nullptr) {
    const Eigen::VectorXd change = change_by_effects(answer);
    const auto mean_square = [&](const std::vector<int>& rows) {
      const std::set<int> wanted(rows.begin(), rows.end());
      double sum = 0.0, cells = 0.0;
      for (std::size_t i = 0; i < observations.cells.size(); ++i)
        if (wanted.contains(observations.cells[i].row)) sum += std::pow(change[i], 2), ++cells;
      return cells > 0 ? sum / cells : 0.0;
    };
    std::ranges::stable_sort(
        curves, [&](const auto& a, const auto& b) { return mean_square(a.second) > mean_square(b.second); });
  }
  for (auto& [label, rows] : curves)
    if (label.empty()) label = "all runs";
  return curves;
}

Sheet gap_sheet(const LoopAnswer& answer, const Covariate& x) {
  const Observations& observations = seen(answer);
  const Eigen::VectorXd& before = answer.found().base.fit().prediction;
  const FittedModel* after = model_after(answer);
  const std::vector<double> at = drawn_at(x);
  Sheet sheet{""};
  for (int channel = 0; channel < channel_count; ++channel) {
    if (!has_cells(observations, channel)) continue;
    const double per_si = channel_views[channel].per_si;
    Plot plot{heading(channel_views[channel]) + " minus the model before", {heading(condition_view(x.name))}};
    Series measured{.label = "measured", .mark = Mark::points, .color = measured_color},
        modelled{.label = "model after", .mark = Mark::points, .color = after_color};
    for (std::size_t i = 0; i < observations.cells.size(); ++i) {
      const Cell& cell = observations.cells[i];
      const auto e = static_cast<Eigen::Index>(i);
      if (cell.channel != channel) continue;
      measured.x.push_back(at[cell.row]);
      measured.y.push_back(per_si * (cell.value - before[e]));
      measured.error.push_back(per_si * answer.noise.channels[channel].sd(before[e], cell.spread));
      if (after)
        modelled.x.push_back(measured.x.back()),
            modelled.y.push_back(per_si * (after->fit().prediction[e] - before[e]));
    }
    const auto [low, high] = std::ranges::minmax_element(measured.x);
    plot.series = {measured,
                   {.label = after ? "model before" : "model",
                    .x = {*low, *high},
                    .y = {0, 0},
                    .color = before_color,
                    .dash = after ? 1 : 0}};
    if (after) plot.series.push_back(std::move(modelled));
    sheet.plots.push_back(std::move(plot));
  }
  return sheet;
}

Sheet residual_sheet(const LoopAnswer& answer, const Covariate& x) {
  const Eigen::VectorXd values = seen(answer).values();
  const auto residual = [&](const Eigen::VectorXd& prediction) {
    return standardised(answer, values - prediction, prediction);
  };
  std::vector<DrawnValues> drawn = {{"before", before_color, residual(answer.found().base.fit().prediction)}};
  if (const FittedModel* model = model_after(answer))
    drawn.push_back({"after", after_color, residual(model->fit().prediction)});
  return over(seen(answer), x, fmt::format("Residuals against {}", condition_view(x.name).title), drawn);
}

Sheet signature_sheet(const LoopAnswer& answer, const Covariate& x) {
  const Eigen::VectorXd& base = answer.found().base.fit().prediction;
  return over(seen(answer), x, "The effect's signature over the residual",
              {{"residual of the base model", before_color, standardised(answer, seen(answer).values() - base, base)},
               {"with the effect - without", after_color, change_by_effects(answer)}});
}

std::vector<Covariate> variables_by_weight(const LoopAnswer& answer) {
  const Observations& observations = seen(answer);
  std::vector<Covariate> variables = covariates(observations);
  if (model_after(answer) == nullptr) return variables;
  const Eigen::VectorXd change = change_by_effects(answer);
  std::array<double, channel_count> size{};
  for (std::size_t i = 0; i < observations.cells.size(); ++i)
    size[observations.cells[i].channel] += std::pow(change[i], 2);
  std::map<std::string, double> explained;
  for (const Dependence& d : dependences(observations, change, 0, 1))
    explained[d.variable] += d.share * size[d.channel];
  std::ranges::stable_sort(
      variables, [&](const Covariate& a, const Covariate& b) { return explained[a.name] > explained[b.name]; });
  return variables;
}

}  // namespace soilbin::compare
