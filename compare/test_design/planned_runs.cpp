#include "compare/test_design/planned_runs.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "compare/design/factor.hpp"
#include "compare/fit/thresholds.hpp"
#include "compare/measured/condition_views.hpp"
#include "compare/measured/run_columns.hpp"
#include "compare/report/number_text.hpp"
#include "scenario/errors.hpp"
#include "scenario/nearest_word.hpp"

namespace soilbin::compare {

using Eigen::MatrixXd;

namespace {

using Conditions = std::vector<OperatingCondition>;

/// As a person would set it: three digits of the range, in the column's unit.
double settable(const ConditionView& view, double value, const std::pair<double, double>& range) {
  if (view.whole) return std::round(value);
  const double unit = per_unit(std::string(view.column_unit)), span = (range.second - range.first) * unit;
  if (!(span > 0.0)) return value;
  const double digit = std::pow(10.0, std::floor(std::log10(span)) - 2);
  double steps = std::round(value * unit / digit);
  if (steps * digit < range.first * unit - 1e-9 * span) ++steps;
  if (steps * digit > range.second * unit + 1e-9 * span) --steps;
  return std::clamp(steps * digit / unit, range.first, range.second);
}

std::vector<double> settable_levels(const ConditionView& view, const std::pair<double, double>& range, int levels) {
  std::vector<double> values = evenly(range, levels);
  for (double& value : values) value = settable(view, value, range);
  values.erase(std::unique(values.begin(), values.end()), values.end());
  return values;
}

/// What the rig is asked about: its limits, in the order in which people read conditions.
class Rig {
 public:
  Rig(const Campaign& campaign, const Observations& made, const Limits& given) : campaign_(campaign), limits_(given) {
    for (const auto& [name, range] : limits_of(made)) {
      const double size = std::max(std::abs(range.first), std::abs(range.second));
      if (range.second - range.first > thresholds::min_learned_range * size) limits_.emplace(name, range);
    }
    if (!limits_.contains("load"))
      throw InputError(
          "no run says which loads the rig can carry\n  hint: name its limits, such as --limit load=60N..140N");
    const std::size_t rows = made.rows.size();
    centre_.slip_by = campaign.slip_by, centre_.force_frame = campaign.force_frame;
    if (rows > 0) centre_ = made.rows[rows / 2];
    centre_.run.reset();
    for (const auto& [name, range] : limits_) {
      const ConditionView& view = condition_view(name);
      const bool angle = view.column_unit == "deg";
      const double middle = view.whole ? range.first
                            : angle    ? std::clamp(0.0, range.first, range.second)
                                       : 0.5 * (range.first + range.second);
      view.set(centre_, settable(view, middle, range));
    }
    for (const ConditionView& view : condition_views)
      if (const auto limit = limits_.find(std::string(view.name));
          limit != limits_.end() && limit->second.second > limit->second.first)
        varied_.push_back(limit->first);
    if (varied_.empty())
      throw InputError("nothing varies within these limits\n  hint: give ranges, such as --limit slip=0%..60%");
  }

  const std::vector<std::string>& varied() const { return varied_; }

  /// Combinations of a few levels of each condition, some of them drawn where there are many.
  Conditions choices(std::uint64_t seed) const {
    std::vector<Levels> levels;
    for (const std::string& name : varied_) {
      const ConditionView& view = condition_view(name);
      const auto& range = limits_.at(name);
      const int whole = static_cast<int>(std::min(range.second - range.first, 5.0)) + 1;
      levels.emplace_back(name, settable_levels(view, range, view.whole ? whole : name == "slip" ? 11 : 3));
    }
    Conditions all = combinations(centre_, levels);
    if (all.size() > thresholds::max_choices) {
      std::vector<std::size_t> order = drawn_order(all.size(), seed);
      order.resize(thresholds::max_choices);
      std::ranges::sort(order);
      Conditions drawn;
      for (const std::size_t i : order) drawn.push_back(all[i]);
      all = std::move(drawn);
    }
    std::erase_if(all, [&](const OperatingCondition& at) { return !carried(at); });
    return all;
  }

  /// One condition after the other from end to end, the others as in the middle; where the soil would give way, the
  /// nearest setting that it carries, or else another condition.
  Conditions sweep(int runs, const OperatingCondition& otherwise) const {
    Conditions rows;
    const int conditions = static_cast<int>(varied_.size());
    for (int v = 0; v < conditions; ++v) {
      const ConditionView& view = condition_view(varied_[v]);
      const auto& range = limits_.at(varied_[v]);
      Conditions one;
      for (const double value : evenly(range, runs / conditions + (v < runs % conditions))) {
        one.push_back(centre_);
        view.set(one.back(), settable(view, value, range));
      }
      Conditions firm = one;
      std::erase_if(firm, [&](const OperatingCondition& at) { return !carried(at); });
      if (firm.empty()) firm = {otherwise};
      for (const OperatingCondition& at : one)
        rows.push_back(*std::ranges::min_element(firm, [&](const auto& a, const auto& b) {
          return std::abs(view.get(a) - view.get(at)) < std::abs(view.get(b) - view.get(at));
        }));
    }
    return rows;
  }

  /// Whether the declared soil carries a good deal more than the load there: near the largest load that it carries
  /// sinkage has no bound, and nobody would set a wheel down.
  bool carried(OperatingCondition at) const {
    at.load *= thresholds::spare_load;
    const Observations one{.rows = {at},
                           .condition = {0},
                           .source_row = {0},
                           .cells = {{0, sinkage, 0.0, 0.0}},
                           .conditions = 1,
                           .block = {0}};
    const auto prediction = declared_prediction(campaign_, one);
    return prediction && prediction->allFinite();
  }

 private:
  const Campaign& campaign_;
  Limits limits_;
  OperatingCondition centre_;
  std::vector<std::string> varied_;
};

/// Runs as places in EffectShapes::sensitivities.
using Places = std::vector<std::size_t>;

/// The search for a plan.
class Exchange {
 public:
  /// choices: the first so many places may be chosen, none more often than `most_often`; information: of what is made.
  Exchange(const EffectShapes& shapes, std::size_t choices, const MatrixXd& information, const DesignOptions& options)
      : shapes_(shapes),
        choices_(choices),
        made_(information),
        options_(options),
        most_often_(std::max<std::size_t>(thresholds::max_repeats, (options.runs + choices - 1) / choices)) {}

  double worth(const Places& plan) const { return share_named_right(shapes_, information(plan)); }
  MatrixXd information(const Places& plan) const {
    MatrixXd sum = made_;
    for (const std::size_t place : plan) sum += shapes_.information_of(place);
    return sum;
  }

  /// Each run where it adds most to those before.
  Places greedy() const {
    Places plan;
    while (std::ssize(plan) < options_.runs) {
      report();
      plan.push_back(best_addition(plan).first);
    }
    return plan;
  }

  /// Moves one run after the other to where it tells most, until none moves.
  Places improved(Places plan) const {
    double now = worth(plan);
    for (int pass = 0; pass < thresholds::max_passes; ++pass) {
      bool moved = false;
      for (std::size_t i = 0; i < plan.size(); ++i) {
        report();
        Places others = plan;
        others.erase(others.begin() + static_cast<std::ptrdiff_t>(i));
        const auto [place, better] = best_addition(others);
        if (!(better > now + 1e-9)) continue;
        plan[i] = place, now = better, moved = true;
      }
      if (!moved) break;
    }
    return plan;
  }

 private:
  /// The choice that tells most beside these runs, and what all then tell.
  std::pair<std::size_t, double> best_addition(const Places& others) const {
    const MatrixXd known = information(others);
    std::vector<double> worths(choices_, -1.0);
    const int parts = std::max(1, options_.threads);
    ThreadPool{options_.threads}.each(parts, [&](int part, const Pulse&) {
      for (std::size_t c = part; c < choices_; c += parts)
        if (static_cast<std::size_t>(std::ranges::count(others, c)) < most_often_)
          worths[c] = share_named_right(shapes_, known + shapes_.information_of(c));
    });
    const auto best = std::ranges::max_element(worths);
    return {static_cast<std::size_t>(best - worths.begin()), *best};
  }

  void report() const {
    ++steps_;
    const std::size_t all = static_cast<std::size_t>(options_.runs) * (2 * thresholds::max_passes + 1);
    if (options_.progress) options_.progress(std::min(steps_, all), all);
  }

  const EffectShapes& shapes_;
  std::size_t choices_;
  MatrixXd made_;
  const DesignOptions& options_;
  std::size_t most_often_;
  mutable std::size_t steps_ = 0;
};

/// The runs that a campaign holds and the declared soil carries.
Observations made_runs(const Campaign& campaign, const Rig* rig = nullptr) {
  Campaign measured = campaign;
  std::erase_if(measured.runs, [&](const Run& run) { return !has_channel(run) || (rig && !rig->carried(run.at)); });
  return observe(measured);
}

ExpectedNoise noise_of(const Campaign& campaign, const Conditions& conditions, const ExpectedNoise& given) {
  if (std::ranges::any_of(given, [](const auto& sd) { return sd.has_value(); })) return given;
  ExpectedNoise noise = usual_noise(campaign, conditions);
  for (int c = 0; c < channel_count; ++c) {  // what the runs did not measure, further ones won't
    const auto holds = [&](const Run& run) { return (run.*channel_views[c].measured).has_value(); };
    if (std::ranges::any_of(campaign.runs, has_channel) && std::ranges::none_of(campaign.runs, holds)) noise[c].reset();
  }
  return noise;
}

void refuse_unknown(const Campaign& campaign, const std::vector<std::string>& wanted) {
  const std::vector<std::string> known = bekker_wong::effect_ids();
  for (const std::string& id : wanted) {
    if (std::ranges::find(known, id) == known.end())
      throw InputError(fmt::format("--effect: unknown effect '{}'{}\n  hint: see soilbin list effects", id,
                                   did_you_mean(id, known)));
    for (const EffectChoice& declared : campaign.effects)
      if (declared.id == id) throw InputError(fmt::format("--effect {}: the campaign's model has it already", id));
  }
}

/// In a drawn order, numbered after the campaign's runs once any is made, runs at one condition under one label of
/// their own.
std::vector<Run> in_drawn_order(const Campaign& campaign, Conditions conditions, std::uint64_t seed) {
  int last = 0, plans = 0;
  const bool begun = std::ranges::any_of(campaign.runs, has_channel);
  for (const Run& run : campaign.runs) {
    if (!begun) break;  // an earlier plan, of which nothing is made: this one takes its place
    last = std::max(last, run.at.run.value_or(0));
    const std::string label = run.setpoint.value_or("");
    if (label.starts_with("D") && label.find_first_not_of("0123456789", 1) == label.npos && label.size() < 9)
      plans = std::max(plans, label.size() > 1 ? std::stoi(label.substr(1)) : 0);
  }
  std::ranges::sort(conditions);
  const Conditions sorted = [&] {
    Conditions once = conditions;
    once.erase(std::unique(once.begin(), once.end()), once.end());
    return once;
  }();
  std::vector<Run> runs;
  for (const std::size_t i : drawn_order(conditions.size(), seed)) {
    Run run;
    run.at = conditions[i];
    run.setpoint =
        fmt::format("D{:02d}", std::lower_bound(sorted.begin(), sorted.end(), run.at) - sorted.begin() + 1 + plans);
    run.at.run = last + 1 + static_cast<int>(runs.size());
    runs.push_back(std::move(run));
  }
  return runs;
}

}  // namespace

TestDesign design_test(const Campaign& campaign, const DesignOptions& options) {
  refuse_unknown(campaign, options.effects);
  const Rig rig(campaign, made_runs(campaign), options.limits);
  Conditions conditions = rig.choices(options.seed);
  const std::size_t choices = conditions.size();
  if (choices < 2)
    throw InputError(
        "the declared soil carries the wheel nowhere within these limits\n  hint: smaller loads, --limit "
        "load=LOW..HIGH; what it carries: soilbin limits");
  TestDesign design;
  design.campaign = campaign.name;
  design.columns = campaign.columns;
  design.varied = rig.varied();
  design.noise = noise_of(campaign, conditions, options.noise);
  const Conditions swept = rig.sweep(options.runs, conditions.front());
  const Observations made = made_runs(campaign, &rig);
  design.made = made.rows.size();
  conditions.insert(conditions.end(), swept.begin(), swept.end());
  conditions.insert(conditions.end(), made.rows.begin(), made.rows.end());
  const EffectShapes shapes =
      effect_shapes(campaign, conditions, choices, design.noise, options.effects, {options.threads, [&] {
                                                                                     if (options.progress)
                                                                                       options.progress(0, 100);
                                                                                   }});
  if (shapes.ids.empty() || (!options.effects.empty() && !shapes.not_shown.empty()))
    throw InputError(
        fmt::format("no test within these limits shows {}\n  hint: an effect shows where what it depends on varies: "
                    "--limit; soilbin list effects says what that is",
                    listed(shapes.not_shown)));
  design.effects = shapes.ids, design.not_shown = shapes.not_shown;

  MatrixXd information = MatrixXd::Zero(shapes.columns(), shapes.columns());
  for (std::size_t i = choices + swept.size(); i < conditions.size(); ++i) information += shapes.information_of(i);
  const Exchange exchange(shapes, choices, information, options);
  Places sweep;
  for (std::size_t i = 0; i < swept.size(); ++i) sweep.push_back(choices + i);
  const Places from_sweep = exchange.improved(sweep), from_greedy = exchange.improved(exchange.greedy());
  const Places& best = exchange.worth(from_greedy) >= exchange.worth(from_sweep) ? from_greedy : from_sweep;
  const auto planned = [&](const Places& places) {
    PlannedTest test{{}, candidate_pairs(shapes, exchange.information(places)), exchange.worth(places)};
    for (const std::size_t place : places) test.runs.push_back(conditions[place]);
    return test;
  };
  design.planned = planned(best), design.swept = planned(sweep);
  design.runs = in_drawn_order(campaign, design.planned.runs, options.seed);
  return design;
}

std::string rows_to_fill_in(const TestDesign& design) {
  std::set<std::string_view> measured;
  for (int c = 0; c < channel_count; ++c)
    if (design.noise[c]) measured.insert(channel_views[c].name);
  for (const auto& [quantity, column] : design.columns)
    if (quantity != "rotation") measured.insert(quantity);  // the speed is written
  return write_runs(design.runs, measured, design.columns);
}

}  // namespace soilbin::compare
