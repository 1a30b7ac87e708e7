#include "compare/telling/loop_report.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "compare/doubts/doubts.hpp"
#include "compare/measured/channels.hpp"
#include "compare/measured/condition_views.hpp"
#include "compare/report/bars.hpp"
#include "compare/report/number_text.hpp"
#include "compare/sweep/varying.hpp"
#include "scenario/errors.hpp"

namespace soilbin::compare {
namespace {

// Figures: measured values beside the model before and after. Before: the base model, its soil refitted. After: the
// model with the effects that the answer's model uses. Colours and names are the same in all of them.

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

Sheet curve_sheet_of(const LoopAnswer& answer, const std::vector<int>& rows) {
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

/// The curves against slip that a figure of the fit shows: (name of the curve, its rows), the one that the effects
/// change most first. Empty where the runs do not lie on curves against slip: fewer than half of
/// them have three others at other slips under the same conditions, or there are more than a dozen curves.
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

/// What the base model misses in each channel's unit over one variable, beside what the effects change.
Sheet gap_sheet(const LoopAnswer& answer, const Covariate& x) {
  const Observations& observations = seen(answer);
  const Eigen::VectorXd& before = answer.found().base.fit().prediction;
  const FittedModel* after = model_after(answer);
  const std::vector<double> at = drawn_at(x);
  Sheet sheet{""};
  for (int channel = 0; channel < channel_count; ++channel) {
    if (!has_cells(observations, channel)) continue;
    const double per_si = channel_views[channel].per_si;
    Plot plot{heading(channel_views[channel]) + ", less model before", {heading(condition_view(x.name))}};
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

/// Residuals over one variable before and after [sd of the noise].
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

/// The effects' change of the prediction over the base model's residual [sd of the noise].
Sheet signature_sheet(const LoopAnswer& answer, const Covariate& x) {
  const Eigen::VectorXd& base = answer.found().base.fit().prediction;
  return over(seen(answer), x, "The effect's signature over the residual",
              {{"residual of the base model", before_color, standardised(answer, seen(answer).values() - base, base)},
               {"with the effect less without", after_color, change_by_effects(answer)}});
}

/// The variables of the campaign, first the one on which the effects' change depends most.
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

// Tables.

Table dependence_table(const LoopAnswer& answer) {
  Table table{"Share of each channel's residual that a parabola in the variable explains, and its p by permutation",
              {"channel", "variable", "before [%]", "p", "after [%]", "p"},
              {true, true}};
  const std::vector<Dependence>& after = answer.with_candidates().dependences_after;
  for (std::size_t i = 0; i < answer.dependences_before.size(); ++i) {
    const Dependence& b = answer.dependences_before[i];
    std::vector<TableCell> row = {std::string(channel_views[b.channel].title),
                                  std::string(condition_view(b.variable).title),
                                  number(100 * b.share),
                                  number(b.p_value),
                                  "-",
                                  "-"};
    if (i < after.size()) {
      row[4] = number(100 * after[i].share);
      row[5] = number(after[i].p_value);
    }
    table.add(std::move(row));
  }
  return table;
}

Table noise_table(const LoopAnswer& answer) {
  const bool unsteady =
      std::ranges::any_of(answer.noise.channels, [](const ChannelNoise& n) { return n.unsteady > 0.0; });
  Table table{unsteady
                  ? "Noise of one run that scattered by s in time, at a predicted value f: sqrt(a² + b² f² + q² s²)"
                  : "Noise of one run at a predicted value f: sqrt(a² + b² f²)",
              {"channel", "a", "b [%]", "degrees of freedom", "sd within re-runs"}};
  if (unsteady) table.header.insert(table.header.end(), {"q", "s (median)"});
  for (std::size_t c = 0; c < channel_views.size(); ++c) {
    const ChannelNoise& n = answer.noise.channels[c];
    if (!n.measured) continue;
    const ChannelView& view = channel_views[c];
    table.add({std::string(view.title), fmt::format("{} {}", number(n.floor * view.per_si), view.unit),
               number(100 * n.growth), number(n.freedom),
               n.rerun_sd > 0 ? fmt::format("{} {}", number(n.rerun_sd * view.per_si), view.unit) : "-"});
    if (unsteady)
      table.rows.back().insert(table.rows.back().end(),
                               {number(n.unsteady), fmt::format("{} {}", number(n.spread * view.per_si), view.unit)});
  }
  return table;
}

/// The strongest signature of each form, strongest first.
std::vector<const Signature*> strongest_signatures(const LoopAnswer& answer) {
  constexpr std::size_t most = 15;
  std::vector<const Signature*> order, strongest;
  for (const Signature& s : answer.found().signatures.all)
    if (s.projected_norm > 0) order.push_back(&s);
  std::ranges::stable_sort(order, [](auto a, auto b) { return a->strength() > b->strength(); });
  std::set<const bekker_wong::EffectForm*> shown;
  for (const Signature* s : order)
    if (strongest.size() < most && shown.insert(s->term.form).second) strongest.push_back(s);
  return strongest;
}

Table signature_table(const std::vector<const Signature*>& signatures) {
  Table table{"The strongest signatures against the base model; kept: the share that the soil's values cannot absorb",
              {"effect", "variant", "score [sd]", "amplitude [SI]", "kept [%]", "detectable from [SI]"},
              {true, true}};
  for (const Signature* s : signatures)
    table.add({s->term.form->id, s->term.form->form, number(s->score), number(Estimate{s->amplitude, s->std_error}),
               number(100 * s->share_kept), number(s->detectable)});
  return table;
}

/// What the forms presume of the wheel, a paragraph each below their table.
Prose presumptions_of(const std::vector<const Signature*>& signatures, const Tire& wheel) {
  std::vector<EffectChoice> forms;
  for (const Signature* s : signatures) forms.push_back({s->term.form->id, s->term.form->form, {}});
  return Prose{bekker_wong::presumptions(forms, wheel)};
}

/// The effects whose signatures look most like an accepted one's.
Table likeness_table(const LoopAnswer& answer) {
  Table table{"What looks most like the accepted effects: cosine of the traces off what the soil's values absorb",
              {"effect", "p-value", "most alike", "cosine"},
              {true, false, true, false}};
  constexpr std::size_t most = 3;
  for (const AcceptedEffect& effect : answer.effects()) {
    std::vector<std::pair<double, std::string>> order;
    for (const auto& [id, cosine] : effect.cosines) order.emplace_back(-cosine, id);
    std::ranges::sort(order);
    for (std::size_t i = 0; i < std::min(most, order.size()); ++i)
      table.add({effect.choice.id, number(effect.p_value), order[i].second, number(-order[i].first)});
  }
  return table;
}

std::string caption_of_models(const LoopAnswer& answer) {
  const std::string noise = "Bars: one standard deviation of a run's noise. ";
  if (!answer.uses_effects()) return noise + "The model's soil values are refitted to these runs.";
  return noise + fmt::format("Before: the soil refitted to these runs, no effect added. After: with {}{}.",
                             named_effects(ids_of(answer.effects_in_model())),
                             answer.effects().empty() ? " as an empirical correction" : "");
}

/// The candidates that the data do not rule out, by their share.
Bars candidate_bars(const LoopAnswer& answer) {
  Bars bars{"Candidates: share [%]", {"share"}, {}, "%"};
  for (const WeightedSet& set : answer.ambiguity_set())
    bars.groups.push_back({named_effects(set.ids), {std::round(100 * set.weight)}});
  return bars;
}

using LoopParts = std::vector<ReportPart>;
/// The variables of the campaign (variables_by_weight), which the parts of a report share.
using Variables = std::shared_ptr<const std::vector<Covariate>>;

/// The figure that answers: curves where the runs lie on curves, else what the base model misses.
void add_main_figure(Report& report, const LoopAnswer& answer, const Variables& variables) {
  report.add("Measured and modelled", Prose{}, Told::to_look_at, "figure");
  const auto curves = curves_of_the_fit(answer);
  if (curves.empty()) {
    if (variables->empty()) return;
    report.add(Figure([&answer, variables] { return gap_sheet(answer, variables->front()); },
                      "Each run's measured value and the model after, both less the model before: where the two lie "
                      "together, the effects explain what was missing. " +
                          caption_of_models(answer)),
               Told::to_look_at);
    return;
  }
  Choices choices{"Runs at", {}};
  std::vector<std::pair<std::string, std::function<Sheet()>>> sheets;
  for (const auto& [label, rows] : curves) {
    sheets.emplace_back(label, drawn_once([&answer, rows = rows] { return curve_sheet_of(answer, rows); }));
    choices.all.emplace_back(label, [&answer, sheet = sheets.back().second] {
      return LoopParts{{Figure(sheet, caption_of_models(answer) + " Curves: at the mean of these runs' conditions.")}};
    });
  }
  if (curves.size() > 1)
    choices.all.emplace_back("all of them", [&answer, sheets] {
      Sheet all{""};
      for (const auto& [label, sheet] : sheets)
        for (Plot plot : sheet().plots) {
          plot.title += ": " + label;
          all.plots.push_back(std::move(plot));
        }
      return LoopParts{{Figure(std::move(all), caption_of_models(answer))}};
    });
  report.add(std::move(choices), Told::to_look_at);
}

/// `told`: by whom; an answer that judges nothing keeps its errors from pages.
void add_tables(Report& report, const LoopAnswer& answer, Told told) {
  if (Table errors = error_table(answer); !errors.rows.empty())
    report.add("Error before and after", std::move(errors), told, "error");
  if (answer.uses_effects()) {
    report.add(answer.effects().empty() ? "Empirical correction" : "The effects and their size",
               parameters_table(answer), told, "effects");
    if (!answer.with_candidates().soil_shifts.empty()) report.add(soil_table(answer), Told::to_look_at);
  }
  if (!answer.has_candidates()) return;
  report.add("Candidates", Prose{}, told, "candidates");
  if (answer.ambiguity_set().size() > 1)
    report.add(Drawings{{bars_svg(candidate_bars(answer), {0})}, "Share of the evidence of each candidate.", "shares"},
               Told::to_look_at);
  report.add(candidates_table(answer), told);
}

void add_gaps(Report& report, const LoopAnswer& answer, const Variables& variables) {
  if (variables->empty()) return;
  Choices choices{"Over", {}};
  for (const Covariate& x : *variables)
    choices.all.emplace_back(std::string(condition_view(x.name).title), [&answer, variables, &x] {
      return LoopParts{{Figure(
          [&answer, variables, &x] { return gap_sheet(answer, x); },
          "Each run, less the model before. Runs of one setting stand side by side. " + caption_of_models(answer))}};
    });
  report.add("What the base model misses, over each variable", std::move(choices), Told::to_look_at, "gaps");
}

LoopParts residual_parts(const LoopAnswer& answer, const Variables& variables) {
  LoopParts parts;
  for (const Covariate& x : *variables)
    parts.push_back({Figure(residual_sheet(answer, x), "In standard deviations of the noise, before and after.")});
  parts.push_back({dependence_table(answer)});
  return parts;
}

LoopParts signature_parts(const LoopAnswer& answer, const Variables& variables) {
  LoopParts parts;
  if (answer.uses_effects() && !variables->empty())
    parts.push_back(
        {Figure(signature_sheet(answer, variables->front()),
                "Points: what the base model, refitted, leaves; and what the effect changes in the prediction.")});
  const std::vector<const Signature*> signatures = strongest_signatures(answer);
  parts.push_back({signature_table(signatures)});
  parts.push_back({presumptions_of(signatures, answer.wheel)});
  if (!answer.effects().empty()) parts.push_back({likeness_table(answer)});
  return parts;
}

LoopParts noise_parts(const LoopAnswer& answer) {
  LoopParts parts{{noise_table(answer)}};
  if (answer.validation.overall.cells > 0 && answer.uses_effects())
    parts.push_back({Prose{{fmt::format("The cross-validated squared error falls by {} ± {} noise variances a value.",
                                        number(answer.validation.gain), number(answer.validation.gain_error))}}});
  return parts;
}

void add_appendix(Report& report, const LoopAnswer& answer, const Variables& variables) {
  report.add("Appendix",
             Fold{"Residuals against every variable, in standard deviations of the noise",
                  [&answer, variables] { return residual_parts(answer, variables); }},
             Told::on_pages, "appendix");
  report.add(Fold{"Signatures: what each effect would leave in the residual",
                  [&answer, variables] { return signature_parts(answer, variables); }});
  report.add(Fold{"Noise", [&answer] { return noise_parts(answer); }});
}

}  // namespace

Report report_on(const Campaign& campaign, const LoopAnswer& answer, const Doubts& doubts) {
  Report report{
      campaign.name + ": what the model lacks",
      fmt::format(
          "The analytic wheel against {} measured runs: what is missing, how sure that is, and what to measure next",
          campaign.runs.size()),
      answer.campaign};
  report.add(Headline{headline(answer, in_words(of_mistaken_columns(doubts)))});
  if (Table next = next_run_table(answer); !next.rows.empty()) report.add(std::move(next));
  const bool judged = answer.judgement() && (answer.verdict() != Verdict::not_enough_data || answer.has_candidates());
  const auto variables =
      std::make_shared<const std::vector<Covariate>>(judged ? variables_by_weight(answer) : std::vector<Covariate>());
  if (judged) add_main_figure(report, answer, variables);
  add_tables(report, answer, judged ? Told::everywhere : Told::in_text);
  if (judged) add_gaps(report, answer, variables);
  if (std::vector<std::string> more = notes(answer); !more.empty())
    report.add("Notes", Items{std::move(more)}, Told::everywhere, "notes");
  report.add(WarningsHere());
  if (judged) add_appendix(report, answer, variables);
  report.data = [&] {
    nlohmann::ordered_json document = to_json(answer);
    if (const Doubts columns = of_mistaken_columns(doubts); !columns.empty())
      document["column_doubts"] = in_words(columns);
    return document;
  };
  report.data_name = "loop";
  return report;
}

}  // namespace soilbin::compare
