#include <fmt/core.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "compare/discrepancy/comparison.hpp"
#include "compare/report/number_text.hpp"
#include "compare/sweep/varying.hpp"
#include "compare/telling/comparison_report.hpp"
#include "scenario/estimate.hpp"

namespace soilbin::compare {
namespace {

std::string signed_number(double value, int places) {
  return std::isfinite(value) ? fmt::format("{:+.{}f}", value, places) : "-";
}

/// "0.76 (1.2)": what the parts leave, and how much that may be; "-" where nobody counted.
std::string rest_cell(const BudgetRest& rest) {
  constexpr double nothing = 1e-3;  // [N] below it is rounding alone
  if (!std::isfinite(rest.force)) return "-";
  if (std::abs(rest.force) < nothing && std::abs(rest.bound) < nothing) return "0";
  return fmt::format("{} ({})", number(rest.force), std::isfinite(rest.bound) ? number(rest.bound) : "not known");
}

}  // namespace

std::string rows_anchor(const ComparedChannel& of) {
  return fmt::format("rows-{}-{}-{}", of.side, of.reference, of.channel);
}

Table tally_table(const Comparison& comparison) {
  constexpr std::size_t more_than_a_channel = 2;
  const bool several = comparison.sides.size() > more_than_a_channel;
  MarkedTable table{
      "Channel by channel, the widest apart first",
      {"channel", "RMS difference", "expected from uncertainty", "mean difference", "differ", "widest at"},
      {true, false, false, false, true, true}};
  for (const Tally* t : widest_first(comparison)) {
    const Difference& worst = comparison.differences[t->worst];
    const std::string pair = less_in_words(comparison, *t);
    if (!several) table.header[3] = "mean of " + pair;
    const Tone tone = t->unknown == t->values     ? Tone::none
                      : t->rms <= t->expected_rms ? Tone::good
                      : t->differ > 0             ? Tone::bad
                                                  : Tone::none;
    table.add(
        {{std::string(channel_views[t->channel].title), several ? pair : "", Tone::none, rows_anchor(*t)},
         {in_unit(t->channel, t->rms), fmt::format("{} of {}", percent(t->rms_share), measure_of(*t)), tone},
         t->expected_rms > 0 ? in_unit(t->channel, t->expected_rms) : "-",
         in_unit(t->channel, t->bias),
         {t->unknown == t->values ? "not tested" : fmt::format("{} of {}", t->differ, t->values),
          t->unknown == t->values ? ""
                                  : fmt::format("{} within scatter, {} within errors", t->in_scatter, t->in_errors)},
         {in_words(comparison.question.study.conditions[worst.condition]),
          fmt::format("{} against {}", in_unit(t->channel, worst.value.value),
                      in_unit(t->channel, worst.reference_value.value))}});
  }
  return table;
}

namespace {

/// The unit of a channel's column, and how many of it are one SI unit: kN and kN m where they are that large.
std::pair<std::string, double> column_unit(const Comparison& comparison, std::size_t channel) {
  const ChannelView& view = channel_views[channel];
  bool kilo = false;
  for (const Difference& d : comparison.differences)
    kilo = kilo || (d.channel == channel && std::abs(d.reference_value.value) >= 1000.0);
  kilo = kilo && view.unit.starts_with("N");
  return {(kilo ? "k" : "") + std::string(view.unit), view.per_si / (kilo ? 1000.0 : 1.0)};
}

/// "+0.35 *": a side less the baseline; "-" where either has no result.
std::string change_cell(const Comparison& comparison, const ComparedChannel& asked, std::size_t condition,
                        double per_si) {
  for (const Difference& d : comparison.differences)
    if (d.is_of(asked) && d.condition == condition) {
      const double change = d.difference * per_si;
      return fmt::format("{}{}{}", change > 0 ? "+" : "", number(change, 3),
                         d.finding == DifferenceFinding::difference ? " *" : "");
    }
  return "-";
}

/// A condition a row: of each of the channels the baseline and the other sides' changes.
Table matrix_table(const Comparison& comparison, std::size_t baseline, const std::vector<std::size_t>& channels) {
  const std::vector<Side>& sides = comparison.sides;
  Table table{fmt::format("Baseline: {}. Change: model - baseline; * significant", name_of(sides[baseline])),
              {"condition"},
              {true}};
  for (const std::size_t c : channels) {
    const std::string title(channel_views[c].title), unit = column_unit(comparison, c).first;
    table.header.push_back(fmt::format("{} [{}], {}", title, unit, name_of(sides[baseline])));
    for (std::size_t s = 0; s < sides.size(); ++s)
      if (s != baseline) table.header.push_back(fmt::format("change [{}], {}", unit, name_of(sides[s])));
  }
  for (std::size_t i = 0; i < comparison.question.study.conditions.size(); ++i) {
    std::vector<TableCell> row = {in_words(comparison.question.study.conditions[i])};
    for (const std::size_t c : channels) {
      const double per_si = column_unit(comparison, c).second;
      const SidePoint& point = sides[baseline].points[i];
      row.push_back(point.result && point.has[c] ? number((*point.result).*channel_views[c].predicted, per_si) : "-");
      for (std::size_t s = 0; s < sides.size(); ++s)
        if (s != baseline) row.push_back(change_cell(comparison, {s, baseline, c}, i, per_si));
    }
    table.add(std::move(row));
  }
  return table;
}

}  // namespace

std::vector<Table> matrix_tables(const Comparison& comparison) {
  constexpr std::size_t most_columns = 10;
  if (comparison.tallies.empty()) return {};
  const std::vector<Side>& sides = comparison.sides;
  const std::size_t baseline = sides.back().kind == SideKind::analytic ? 0 : sides.size() - 1;
  std::vector<std::size_t> channels;
  for (std::size_t c = 0; c < channel_views.size(); ++c)
    if (std::ranges::any_of(comparison.tallies,
                            [&](const Tally& t) { return t.channel == c && t.reference == baseline; }))
      channels.push_back(c);
  if (channels.size() * sides.size() <= most_columns) return {matrix_table(comparison, baseline, channels)};
  std::vector<Table> tables;
  for (const std::size_t c : channels) tables.push_back(matrix_table(comparison, baseline, {c}));
  return tables;
}

Table rows_table(const Comparison& comparison, const Tally& tally) {
  const ChannelView& channel = channel_views[tally.channel];
  Table table{fmt::format("{} [{}]: {} against {}; ± is one standard error", channel.title, channel.unit,
                          name_of(comparison.sides[tally.side]), name_of(comparison.sides[tally.reference])),
              {"condition", name_of(comparison.sides[tally.side]), name_of(comparison.sides[tally.reference]),
               "difference", "scatter of a run", "share [%]", "in sigma", "finding"},
              {true, false, false, false, false, false, false, true}};
  for (const Difference& d : comparison.differences) {
    if (!d.is_of(tally)) continue;
    table.add({in_words(comparison.question.study.conditions[d.condition]), number(d.value, channel.per_si),
               number(d.reference_value, channel.per_si), number(Estimate{d.difference, d.std_error}, channel.per_si),
               number(d.scatter * channel.per_si), signed_number(100 * d.share, 2), signed_number(d.sigma, 1),
               std::string(words(d.finding))});
  }
  if (tally.unknown == tally.values) {  // nothing is tested, which the summary says once
    constexpr std::size_t numbers = 4;
    table.header.resize(numbers), table.text_columns.resize(numbers);
    for (std::vector<TableCell>& row : table.rows) row.resize(numbers);
  }
  return table;
}

Table points_table(const Comparison& comparison, const Side& side) {
  Table table{name_of(side),
              {"condition", "drawbar pull [N]", "torque [N m]", "sinkage [mm]", "lateral force [N]", "runs",
               "scatter of the pull [N]", "warnings"},
              {true, false, false, false, false, false, false, true}};
  for (std::size_t i = 0; i < side.points.size(); ++i) {
    const SidePoint& point = side.points[i];
    std::vector<TableCell> row = {in_words(comparison.question.study.conditions[i])};
    for (std::size_t c = 0; c < channel_views.size(); ++c)
      row.push_back(point.result && point.has[c]
                        ? number((*point.result).*channel_views[c].predicted, channel_views[c].per_si)
                        : "-");
    row.push_back(side.kind == SideKind::analytic ? "-" : std::to_string(point.runs));
    row.push_back(point.scatter[0] > 0.0 ? number(point.scatter[0]) : "-");
    row.push_back(point.result ? as_remark(point.doubts) : point.error);
    table.add(std::move(row));
  }
  return table;
}

Table budget_table(const Comparison& comparison, std::size_t condition) {
  const BudgetTable budget = budget_at(comparison, condition);
  Table table{"Parts of the drawbar pull [N]; '-': not a part of this side", {"part"}, {true}};
  for (const std::size_t s : budget.sides) table.header.push_back(name_of(comparison.sides[s]));
  for (const BudgetRow& row : budget.rows) {
    std::vector<TableCell> cells = {part_in_words(row.name)};
    for (const double force : row.force) cells.push_back(number(force));
    table.add(std::move(cells));
  }
  std::vector<TableCell> rest = {"unexplained (at most by chance)"}, pull = {"drawbar pull"};
  for (const std::size_t s : budget.sides) {
    const TractionResult& result = *comparison.sides[s].points[condition].result;
    rest.push_back(rest_cell(result.budget_rest));
    pull.push_back(number(result.drawbar_pull.value));
  }
  if (!budget.rows.empty()) table.rows.insert(table.rows.end(), {std::move(rest), std::move(pull)});
  return table;
}

Table sinkage_table(const Comparison& comparison) {
  Table table{"Sinkage [mm] at slip 0, and what the largest slip adds",
              {"curve", "side", "at slip 0", "slip [%]", "added by slip"},
              {true, true}};
  const auto& conditions = comparison.question.study.conditions;
  const Curves& curves = comparison.curves;
  std::map<std::pair<std::size_t, std::size_t>, SinkageSplit> last;  // by curve, side
  for (const SinkageSplit& split : sinkage_splits(comparison)) {
    const auto [place, fresh] = last.insert({{curves.curve_of[split.condition], split.side}, split});
    if (!fresh && conditions[split.condition].slip > conditions[place->second.condition].slip) place->second = split;
  }
  for (const auto& [key, split] : last)
    table.add({curves.labels[key.first].empty() ? "all" : curves.labels[key.first],
               name_of(comparison.sides[key.second]), number(1000 * split.at_rest),
               number(100 * conditions[split.condition].slip), number(1000 * split.by_slip)});
  return table;
}

Table joint_table(const Comparison& comparison) {
  Table table{"All values together, with the soil's uncertainty, which all conditions share",
              {"side", "against", "values", "chi2, soil exact", "chi2", "freedom of the noise", "p-value"},
              {true, true}};
  for (const JointTest& test : comparison.joint)
    table.add({name_of(comparison.sides[test.side]), name_of(comparison.sides[test.reference]),
               std::to_string(test.values), number(test.chi2_soil_exact), number(test.chi2),
               std::isinf(test.freedom) ? "known" : fmt::format("{:.0f}", test.freedom),
               test.p_value < 1e-300 ? "< 1e-300" : fmt::format("{:.2g}", test.p_value)});
  return table;
}

}  // namespace soilbin::compare
