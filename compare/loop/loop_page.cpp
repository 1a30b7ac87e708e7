// The loop's report as one page.
#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "compare/loop/answer_words.hpp"
#include "compare/measured/channels.hpp"
#include "compare/measured/condition_views.hpp"
#include "compare/report/number_text.hpp"
#include "scenario/soil_parameters.hpp"

namespace soilbin::compare {
namespace {

/// (measured - predicted)/sd of each cell.
Eigen::VectorXd standardised(const LoopAnswer& answer, const Eigen::VectorXd& prediction) {
  const Observations& observations = answer.found().base.data().observations;
  Eigen::VectorXd r = observations.values() - prediction;
  for (Eigen::Index i = 0; i < r.size(); ++i) {
    const Cell& cell = observations.cells[i];
    r[i] /= answer.noise.channels[cell.channel].sd(prediction[i]);
  }
  return r;
}

std::string axis_title(const Covariate& x) {
  const ConditionView& view = condition_view(x.name);
  return view.unit.empty() ? std::string(view.title) : fmt::format("{} [{}]", view.title, view.unit);
}

/// Cells of a channel over a covariate.
Series over(const Observations& observations, const Eigen::VectorXd& y, const Covariate& x, int channel,
            const std::string& label, int color, Mark mark) {
  Series series{.label = label, .x = {}, .y = {}, .error = {}, .mark = mark, .color = color};
  const double per_si = condition_view(x.name).per_si;
  std::vector<std::pair<double, double>> points;
  for (std::size_t i = 0; i < observations.cells.size(); ++i)
    if (observations.cells[i].channel == channel)
      points.emplace_back(per_si * x.values[observations.cells[i].row], y[i]);
  std::stable_sort(points.begin(), points.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
  for (const auto& [at, value] : points) series.x.push_back(at), series.y.push_back(value);
  return series;
}

bool has_cells(const Observations& observations, int channel) {
  return std::any_of(observations.cells.begin(), observations.cells.end(),
                     [&](const Cell& c) { return c.channel == channel; });
}

Sheet residual_sheet(const Observations& observations, const Covariate& x, const Eigen::VectorXd& before,
                     const Eigen::VectorXd* after) {
  Sheet sheet{fmt::format("Residuals against {}", condition_view(x.name).title), {}, Palette::named};
  for (int channel = 0; channel < channel_count; ++channel) {
    if (!has_cells(observations, channel)) continue;
    Plot plot{
        std::string(channel_views[channel].title), {axis_title(x), {}, {}}, {"residual [sd of the noise]", {}, {}}, {}};
    plot.series.push_back(over(observations, before, x, channel, "before", 0, Mark::points));
    if (after != nullptr) plot.series.push_back(over(observations, *after, x, channel, "after", 1, Mark::points));
    sheet.plots.push_back(std::move(plot));
  }
  return sheet;
}

/// What the accepted effects change in the prediction, soil refitted, in sd of the noise.
Eigen::VectorXd signature_of_best(const LoopAnswer& answer) {
  const FittedModel& base = answer.found().base;
  Eigen::VectorXd change = answer.found().best().fit().prediction - base.fit().prediction;
  for (Eigen::Index i = 0; i < change.size(); ++i) {
    const Cell& cell = base.data().observations.cells[i];
    change[i] /= answer.noise.channels[cell.channel].sd(base.fit().prediction[i]);
  }
  return change;
}

/// The variable that a change depends on most: of the largest share of a channel's variance, by size of the change.
const Covariate& main_variable(const Observations& observations, const Eigen::VectorXd& change,
                               const std::vector<Covariate>& variables) {
  std::array<double, channel_count> size{};
  for (std::size_t i = 0; i < observations.cells.size(); ++i)
    size[observations.cells[i].channel] += std::pow(change[i], 2);
  std::map<std::string, double> explained;
  for (const Dependence& d : dependences(observations, change, 0, 1))
    explained[d.variable] += d.share * size[d.channel];
  return *std::max_element(variables.begin(), variables.end(), [&](const Covariate& a, const Covariate& b) {
    return explained[a.name] < explained[b.name];
  });
}

Sheet signature_sheet(const Observations& observations, const Eigen::VectorXd& before, const Eigen::VectorXd& change,
                      const Covariate& x) {
  Sheet sheet{"The effect's signature over the residual", {}, Palette::named};
  for (int channel = 0; channel < channel_count; ++channel) {
    if (!has_cells(observations, channel)) continue;
    Plot plot{std::string(channel_views[channel].title), {axis_title(x), {}, {}}, {"[sd of the noise]", {}, {}}, {}};
    plot.series.push_back(over(observations, before, x, channel, "residual of the base model", 0, Mark::points));
    plot.series.push_back(over(observations, change, x, channel, "with the effect less without", 1, Mark::points));
    sheet.plots.push_back(std::move(plot));
  }
  return sheet;
}

HtmlTable dependence_table(const LoopAnswer& answer) {
  HtmlTable table{"Share of each channel's residual that a parabola in the variable explains, and its p by permutation",
                  {"channel", "variable", "before [%]", "p", "after [%]", "p"},
                  {},
                  {true, true}};
  for (std::size_t i = 0; i < answer.dependences_before.size(); ++i) {
    const Dependence& b = answer.dependences_before[i];
    std::vector<std::string> row = {std::string(channel_views[b.channel].title),
                                    std::string(condition_view(b.variable).title),
                                    number(100 * b.share),
                                    number(b.p_value),
                                    "-",
                                    "-"};
    if (i < answer.dependences_after.size()) {
      row[4] = number(100 * answer.dependences_after[i].share);
      row[5] = number(answer.dependences_after[i].p_value);
    }
    table.rows.push_back(std::move(row));
  }
  return table;
}

HtmlTable noise_table(const LoopAnswer& answer) {
  HtmlTable table{
      "Noise: sqrt(a^2 + b^2 f^2)", {"channel", "a", "b [%]", "degrees of freedom", "sd within re-runs"}, {}, {}};
  for (std::size_t c = 0; c < channel_views.size(); ++c) {
    const ChannelNoise& n = answer.noise.channels[c];
    if (!n.measured) continue;
    const ChannelView& view = channel_views[c];
    table.rows.push_back({std::string(view.title), fmt::format("{} {}", number(n.floor * view.per_si), view.unit),
                          number(100 * n.growth), number(n.freedom),
                          n.rerun_sd > 0 ? fmt::format("{} {}", number(n.rerun_sd * view.per_si), view.unit) : "-"});
  }
  return table;
}

/// The strongest signature of each form, strongest first.
std::vector<const Signature*> strongest_signatures(const LoopAnswer& answer) {
  constexpr std::size_t most = 15;
  std::vector<const Signature*> order, strongest;
  for (const Signature& s : answer.found().signatures.all)
    if (s.projected_norm > 0) order.push_back(&s);
  std::stable_sort(order.begin(), order.end(), [](auto a, auto b) { return a->strength() > b->strength(); });
  std::set<const bekker_wong::EffectForm*> shown;
  for (const Signature* s : order)
    if (strongest.size() < most && shown.insert(s->term.form).second) strongest.push_back(s);
  return strongest;
}

HtmlTable signature_table(const std::vector<const Signature*>& signatures) {
  HtmlTable table{
      "The strongest signatures against the base model; kept: the share that the soil's values can't absorb",
      {"effect", "form", "score [sd]", "amplitude [SI]", "kept [%]", "detectable from [SI]"},
      {},
      {true, true}};
  for (const Signature* s : signatures)
    table.rows.push_back({s->term.form->id, s->term.form->form, number(s->score),
                          number(Estimate{s->amplitude, s->std_error}), number(100 * s->share_kept),
                          number(s->detectable)});
  return table;
}

/// What the forms presume of the wheel, a paragraph below their table.
void add_presumptions(Page& page, const std::vector<const Signature*>& signatures, const Tire& wheel) {
  std::vector<EffectChoice> forms;
  for (const Signature* s : signatures) forms.push_back({s->term.form->id, s->term.form->form, {}});
  for (const std::string& sentence : bekker_wong::presumptions(forms, wheel)) page.paragraph(sentence);
}

/// The effects whose signatures look most like an accepted one's.
HtmlTable likeness_table(const LoopAnswer& answer) {
  HtmlTable table{"What looks most like the accepted effects: cosine of the traces off what the soil's values absorb",
                  {"effect", "p-value", "most alike", "cosine"},
                  {},
                  {true, false, true, false}};
  constexpr std::size_t most = 3;
  for (const AcceptedEffect& effect : answer.effects) {
    std::vector<std::pair<double, std::string>> order;
    for (const auto& [id, cosine] : effect.cosines) order.emplace_back(-cosine, id);
    std::sort(order.begin(), order.end());
    for (std::size_t i = 0; i < std::min(most, order.size()); ++i)
      table.rows.push_back({effect.choice.id, number(effect.p_value), order[i].second, number(-order[i].first)});
  }
  return table;
}

HtmlTable soil_table(const LoopAnswer& answer) {
  HtmlTable table{"The soil's values, and the bias that leaving the effects out puts into them",
                  {"value", "with", "without", "bias", "unit"},
                  {},
                  {true, false, false, false, true}};
  for (const SoilShift& s : answer.soil_shifts) {
    const SoilParameter& p = soil_parameter(s.name);
    table.rows.push_back({p.title, number(s.with, p.per_si), number(s.without, p.per_si),
                          number(p.per_si * (s.without.value - s.with.value)), p.unit});
  }
  return table;
}

}  // namespace

std::string loop_page(const Campaign& campaign, const LoopAnswer& answer, const std::vector<std::string>& doubts,
                      const std::string& command) {
  Page page("The loop on " + campaign.name, "residual, cause, effect added, error before and after");
  std::vector<std::pair<std::string, std::string>> summary = {{"Verdict", verdict_sentence(answer)}};
  for (const std::string& sentence : explanation(answer)) summary.emplace_back("", sentence);
  page.summary(summary);
  page.doubts(doubts);
  if (answer.verdict != Verdict::not_enough_data || answer.has_candidates()) {
    const Attribution& found = answer.found();
    const Observations& observations = found.base.data().observations;
    const Eigen::VectorXd before = standardised(answer, found.base.fit().prediction);
    std::optional<Eigen::VectorXd> after;
    if (!answer.effects.empty() || !answer.stand_in.empty())
      after = standardised(answer, found.best().fit().prediction);
    page.section("Error before and after");
    page.table(error_table(answer));
    const std::vector<Covariate> variables = covariates(observations);
    if (after && !variables.empty()) {
      page.section(answer.effects.empty() ? "What stands in for the effect, over the residual"
                                          : "The effect over the residual");
      const Eigen::VectorXd change = signature_of_best(answer);
      page.figure(signature_sheet(observations, before, change, main_variable(observations, change, variables)),
                  "Points: what the base model, refitted, leaves; and what the effect changes in the prediction.");
    }
    page.section("Candidates");
    page.table(candidates_table(answer));
    const std::vector<const Signature*> signatures = strongest_signatures(answer);
    page.table(signature_table(signatures));
    add_presumptions(page, signatures, answer.wheel);
    if (!answer.effects.empty()) page.table(likeness_table(answer));
    if (!answer.soil_shifts.empty()) page.table(soil_table(answer));
    page.section("Residuals against every variable");
    for (const Covariate& x : variables)
      page.figure(residual_sheet(observations, x, before, after ? &*after : nullptr),
                  "In standard deviations of the noise.");
    page.table(dependence_table(answer));
    page.section("Noise");
    page.table(noise_table(answer));
  }
  if (!answer.not_testable.empty()) {
    page.section("Not testable");
    page.paragraph(
        "These effects leave no trace in these data beyond what the soil's values absorb. That does not mean "
        "that they are absent.");
    page.list(answer.not_testable);
  }
  page.section("How to repeat this");
  page.code(command);
  return page.html();
}

}  // namespace soilbin::compare
