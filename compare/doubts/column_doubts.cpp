#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

#include "compare/doubts/doubts.hpp"
#include "compare/measured/campaign.hpp"
#include "scenario/quantity.hpp"

namespace soilbin::compare {
namespace {

/// The column of a quantity; where there is no file, named as the quantity.
DataColumn column_of(const Campaign& campaign, std::string_view quantity) {
  const auto found = campaign.columns.find(std::string(quantity));
  return found == campaign.columns.end() ? DataColumn{std::string(quantity), "", {}} : found->second;
}

/// "runs.csv:1:34: ", empty where there is no file.
std::string place_of(const DataColumn& column) {
  const SourcePosition& at = column.at;
  return at.line > 0 ? fmt::format("{}:{}:{}: ", at.file, at.line, at.column) : "";
}

/// The SI value of a 1 in a column.
double si_of_one(const DataColumn& column) {
  const Unit unit = parse_unit(column.unit);
  return unit.numerator / unit.denominator * std::pow(10.0, unit.decimal);
}

/// What may have been done to one column or two, undone.
struct Correction {
  std::vector<std::string_view> columns;  ///< the quantities
  std::function<void(Run&)> undo;
  Doubt doubt;
  bool by_power_of_ten = false;
};

/// A doubt about a column's unit, at its header: place, header, by how much it is off, unit, the unit that it may have.
Doubt doubt_of_unit(DoubtKind kind, const DataColumn& column, double times, const char* unit = "") {
  return {kind, {place_of(column), clipped(column.header), times, column.unit == "-" ? "" : column.unit, unit}};
}

/// Signs as docs/reference/conventions.md has them. That of the sinkage shows by itself (row_doubts.cpp).
void add_flipped_signs(const Campaign& campaign, std::vector<Correction>& all) {
  const auto add = [&](std::string_view quantity, const char* positive, std::function<void(Run&)> undo) {
    const DataColumn column = column_of(campaign, quantity);
    all.push_back(
        {{quantity}, std::move(undo), {DoubtKind::flipped_sign, {place_of(column), clipped(column.header), positive}}});
  };
  const auto channel = [&](std::string_view quantity, std::optional<double> Run::*measured, const char* positive) {
    add(quantity, positive, [measured](Run& run) {
      if (run.*measured) *(run.*measured) *= -1;
    });
  };
  channel("drawbar_pull", &Run::drawbar_pull, "pulls forward");
  channel("torque", &Run::torque, "drives the wheel");
  channel("lateral_force", &Run::lateral_force, "points to the left of travel");
  add("slip", "is a driven wheel's slip", [](Run& run) { run.at.slip *= -1; });
}

void add_powers_of_ten(const Campaign& campaign, std::vector<Correction>& all) {
  for (const ChannelView& view : channel_views)
    for (const double power : {10.0, 100.0, 1000.0})
      for (const bool large : {true, false})
        all.push_back({{view.name},
                       [measured = view.measured, times = large ? 1 / power : power](Run& run) {
                         if (run.*measured) *(run.*measured) *= times;
                       },
                       doubt_of_unit(large ? DoubtKind::column_too_large : DoubtKind::column_too_small,
                                     column_of(campaign, view.name), power),
                       true});
}

/// Shares under a heading that says %, and the other way round.
void add_slips_in_another_unit(const Campaign& campaign, std::vector<Correction>& all) {
  for (const auto& [kind, times] :
       {std::pair{DoubtKind::slip_in_shares, 100.0}, std::pair{DoubtKind::slip_in_percent, 0.01}})
    all.push_back({{"slip"},
                   [factor = times](Run& run) { run.at.slip *= factor; },
                   doubt_of_unit(kind, column_of(campaign, "slip"), times)});
}

/// Loads in kilograms, pounds or kilonewtons under a heading that says newtons, and the like; a decimal point that
/// slid.
void add_loads_in_another_unit(const Campaign& campaign, std::vector<Correction>& all) {
  const DataColumn column = column_of(campaign, "load");
  for (const auto& [unit, one] : {std::pair{"kg", "1 kgf"}, {"lbf", "1 lbf"}, {"kN", "1 kN"}}) {
    const double newtons = read_quantity(one, {"N", above_zero});
    all.push_back({{"load"},
                   [newtons](Run& run) { run.at.load *= newtons; },
                   doubt_of_unit(DoubtKind::load_in_another_unit, column, newtons, unit)});
  }
  for (const double power : {10.0, 100.0, 1000.0})  // ten times too small is as good as in kg, a thousand times in kN
    all.push_back({{"load"},
                   [power](Run& run) { run.at.load /= power; },
                   doubt_of_unit(DoubtKind::column_too_large, column, power)});
}

/// At the second of two columns.
Doubt doubt_of_swap(DoubtKind kind, const Campaign& campaign, std::string_view one, std::string_view other) {
  DataColumn first = column_of(campaign, one), second = column_of(campaign, other);
  if (second.at.column < first.at.column) std::swap(first, second);
  return {kind, {place_of(second), first.header, second.header, campaign.columns.empty() ? "" : "campaign.yaml"}};
}

/// A heading over the numbers of another: its unit goes with it.
void add_swapped_columns(const Campaign& campaign, std::vector<Correction>& all) {
  for (auto one = channel_views.begin(); one != channel_views.end(); ++one)
    for (auto other = one + 1; other != channel_views.end(); ++other) {
      const double ratio = si_of_one(column_of(campaign, one->name)) / si_of_one(column_of(campaign, other->name));
      all.push_back({{one->name, other->name},
                     [a = one->measured, b = other->measured, ratio](Run& run) {
                       std::swap(run.*a, run.*b);
                       if (run.*a) *(run.*a) *= ratio;
                       if (run.*b) *(run.*b) /= ratio;
                     },
                     doubt_of_swap(DoubtKind::columns_swapped, campaign, one->name, other->name)});
    }
  const auto positive = [](const Run& run) { return run.drawbar_pull.value_or(1.0) > 0.0; };
  if (!std::ranges::all_of(campaign.runs, positive)) return;  // no load is negative
  const double ratio = si_of_one(column_of(campaign, "load")) / si_of_one(column_of(campaign, "drawbar_pull"));
  all.push_back({{"load", "drawbar_pull"},
                 [ratio](Run& run) {
                   if (run.drawbar_pull)
                     run.at.load = ratio * std::exchange(run.drawbar_pull, run.at.load / ratio).value();
                 },
                 doubt_of_swap(DoubtKind::load_swapped, campaign, "load", "drawbar_pull")});
}

/// All that is looked for.
std::vector<Correction> corrections(const Campaign& campaign) {
  std::vector<Correction> all;
  add_flipped_signs(campaign, all);
  add_powers_of_ten(campaign, all);
  add_slips_in_another_unit(campaign, all);
  add_loads_in_another_unit(campaign, all);
  add_swapped_columns(campaign, all);
  return all;
}

/// Rows and what the model says of each.
struct Compared {
  std::vector<Run> runs;
  std::vector<Answer> answers;
};

/// The rows with a column corrected; the model is asked anew where their conditions change.
Compared corrected(const Compared& rows, const Correction& correction, const AskAgain& ask) {
  Compared other = rows;
  std::vector<OperatingCondition> conditions;
  bool elsewhere = false;
  for (std::size_t i = 0; i < rows.runs.size(); ++i) {
    correction.undo(other.runs[i]);
    const OperatingCondition &was = rows.runs[i].at, &is = conditions.emplace_back(other.runs[i].at);
    elsewhere = elsewhere || was.slip != is.slip || was.load != is.load;
  }
  if (elsewhere) other.answers = ask(conditions);
  return other;
}

/// A channel's measured and predicted values, in rows that have both.
struct Pairs {
  std::vector<double> measured, predicted;
};

double root_mean_square(const std::vector<double>& values) {
  double squares = 0;
  for (const double value : values) squares += value * value;
  return std::sqrt(squares / static_cast<double>(values.size()));
}

/// How far a channel is from its prediction, as a share of the sizes of both: 0 as predicted, 1/2 where it is three
/// times as large or a third, 1 where its sign is the other one or it is of quite another size. None is trusted to less
/// than 5 %.
double misfit(const Pairs& pairs) {
  std::vector<double> errors;
  for (std::size_t i = 0; i < pairs.measured.size(); ++i) errors.push_back(pairs.measured[i] - pairs.predicted[i]);
  const double sizes = root_mean_square(pairs.measured) + root_mean_square(pairs.predicted);
  return std::max(0.05, sizes > 0.0 ? root_mean_square(errors) / sizes : 0.0);
}

/// How many times too large or too small.
double size_ratio(const Pairs& pairs) {
  const double ratio = root_mean_square(pairs.measured) / root_mean_square(pairs.predicted);
  return std::max(ratio, 1 / ratio);
}

/// Whether the measured values rise and fall as predicted; true of a prediction that is the same everywhere.
bool follows(const Pairs& pairs) {
  constexpr double clearly = 0.5;
  const auto n = static_cast<double>(pairs.measured.size());
  double x = 0, y = 0, xx = 0, xy = 0, yy = 0;
  for (std::size_t i = 0; i < pairs.measured.size(); ++i) x += pairs.measured[i] / n, y += pairs.predicted[i] / n;
  for (std::size_t i = 0; i < pairs.measured.size(); ++i) {
    const double dx = pairs.measured[i] - x, dy = pairs.predicted[i] - y;
    xx += dx * dx, xy += dx * dy, yy += dy * dy;
  }
  return yy <= 1e-12 * n * y * y || xy > clearly * std::sqrt(xx * yy);
}

/// Whether a channel reads or is predicted otherwise by more than a tenth: others say nothing of a correction.
bool moved(const Pairs& before, const Pairs& after) {
  std::vector<double> by;
  for (std::size_t i = 0; i < before.measured.size(); ++i)
    by.push_back(std::abs(after.measured[i] - before.measured[i]) + std::abs(after.predicted[i] - before.predicted[i]));
  return root_mean_square(by) > 0.1 * (root_mean_square(before.measured) + root_mean_square(before.predicted));
}

/// The misfits with a correction over those without, of the channels that it changes: their geometric mean, and the
/// logarithm of their product, which tells corrections that explain much from those that explain a part.
struct MisfitLeft {
  double mean = 1.0, log_product = 0.0;
};

/// Whether a correction gives an answer to most rows where the model had none.
bool answers_at_last(const Compared& rows, const Compared& other) {
  std::ptrdiff_t before = 0, after = 0;
  for (std::size_t i = 0; i < rows.answers.size(); ++i)
    before += rows.answers[i].result ? 1 : 0, after += other.answers[i].result ? 1 : 0;
  const auto n = static_cast<std::ptrdiff_t>(rows.answers.size());
  return 2 * before < n && 2 * after > n;
}

/// None where the correction is not to be thought of. A prediction that there is none of counts as 0, wholly wrong.
std::optional<MisfitLeft> misfit_left(const Correction& correction, const Compared& rows, const Compared& other) {
  constexpr std::size_t fewest_to_compare = 3;
  // The prediction may itself be wrong by a factor of 2 or 3.
  constexpr double least_size_ratio = 6.0, most_size_ratio_left = 3.0;
  const bool at_last = answers_at_last(rows, other);
  double log_ratio = 0;
  std::size_t channels = 0;
  for (const ChannelView& view : channel_views) {
    Pairs before, after;
    std::size_t comparable = 0;
    for (std::size_t i = 0; i < rows.runs.size(); ++i) {
      const auto &was = rows.runs[i].*view.measured, &is = other.runs[i].*view.measured;
      const auto &said = rows.answers[i].result, &says = other.answers[i].result;
      if (!was || !(said || at_last)) continue;
      ++comparable;
      if (!is || !says) continue;
      before.measured.push_back(*was), before.predicted.push_back(said ? ((*said).*view.predicted).value : 0.0);
      after.measured.push_back(*is), after.predicted.push_back(((*says).*view.predicted).value);
    }
    const std::size_t n = after.measured.size();
    if (n < fewest_to_compare || 2 * n < comparable) continue;
    if (!moved(before, after)) continue;
    const bool named = at_last || std::ranges::find(correction.columns, view.name) != correction.columns.end();
    if (named && !follows(after)) return std::nullopt;
    if (correction.by_power_of_ten &&
        !(size_ratio(before) > least_size_ratio && size_ratio(after) < most_size_ratio_left))
      return std::nullopt;
    log_ratio += std::log(misfit(after) / misfit(before)), ++channels;
  }
  if (channels == 0) return std::nullopt;
  return MisfitLeft{std::exp(log_ratio / static_cast<double>(channels)), log_ratio};
}

/// At most so many rows of a campaign, spread evenly over it.
Compared some_rows(const Campaign& campaign, const std::vector<Answer>& answers) {
  constexpr std::size_t most = 200;
  const std::size_t every = campaign.runs.empty() ? 1 : 1 + (campaign.runs.size() - 1) / most;
  Compared some;
  for (std::size_t i = 0; i < campaign.runs.size(); i += every)
    some.runs.push_back(campaign.runs[i]), some.answers.push_back(answers[i]);
  return some;
}

}  // namespace

Doubts column_doubts(const Campaign& campaign, const std::vector<Answer>& answers, const AskAgain& ask) {
  constexpr double clearly = 0.5;
  Doubts found;
  std::set<std::string_view> told;
  Compared rows = some_rows(campaign, answers);
  const std::vector<Correction> all = corrections(campaign);
  for (;;) {
    double least = 0.0;
    const Correction* best = nullptr;
    Compared best_rows;
    for (const Correction& correction : all) {
      if (std::ranges::any_of(correction.columns, [&](std::string_view one) { return told.contains(one); })) continue;
      Compared other = corrected(rows, correction, ask);
      const std::optional<MisfitLeft> left = misfit_left(correction, rows, other);
      if (!left || !(left->mean < clearly && left->log_product < least)) continue;
      least = left->log_product, best = &correction, best_rows = std::move(other);
    }
    if (!best) return found;
    found.push_back(best->doubt);
    told.insert(best->columns.begin(), best->columns.end());
    rows = std::move(best_rows);  // what is left of the others, with this one put right
  }
}

}  // namespace soilbin::compare
