#include "compare/sweep/varying.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <map>
#include <set>

#include "compare/report/number_text.hpp"
#include "scenario/condition_axes.hpp"
#include "scenario/description.hpp"
#include "scenario/unit.hpp"

namespace soilbin::compare {
namespace {

/// A condition that can tell curves apart, and over which they can run.
struct ConditionAxis {
  const ConditionView& view;
  std::string (*label)(double);
  double relative_gap, absolute_gap;  ///< between neighbours of different setpoints, where measured
  bool follows_slip = false;          ///< may vary with slip alone, and then tells nothing apart

  /// [SI]; 0 where it isn't told.
  double get(const OperatingCondition& at) const {
    const double value = view.get(at);
    return std::isnan(value) ? 0.0 : value;
  }
};

std::string angle(const char* name, double radian) { return fmt::format("{} {:.4g}°", name, radian / degree); }

const std::vector<ConditionAxis>& axes() {
  static const std::vector<ConditionAxis> all = {
      {slip_view(), [](double x) { return fmt::format("slip {:.4g} %", 100 * x); }, 0.0, 0.02},
      {condition_view("load"), [](double x) { return newtons(x); }, 0.25, 0.0},
      {condition_view("longitudinal_incline"),
       [](double x) { return x < 0 ? angle("downhill", -x) : angle("uphill", x); }, 0.0, 2 * degree},
      {condition_view("transverse_incline"), [](double x) { return angle("cross slope", x); }, 0.0, 2 * degree},
      {condition_view("yaw"), [](double x) { return angle("yaw", x); }, 0.0, 2 * degree},
      {condition_view("pass"), [](double x) { return fmt::format("pass {:g}", x); }, 0.0, 0.5},
      {condition_view("inflation_pressure"), [](double x) { return fmt::format("inflation {:.4g} kPa", x / 1000); },
       0.05, 2e3},
      {condition_view("moisture"), [](double x) { return fmt::format("moisture {:.3g} %", 100 * x); }, 0.25, 0.01},
      {condition_view("speed"), [](double x) { return fmt::format("{:.4g} m/s", x); }, 0.25, 0.0, true},
  };
  return all;
}

const ConditionAxis& axis_of(const ConditionView& view) {
  return *std::ranges::find_if(axes(), [&](const ConditionAxis& axis) { return &axis.view == &view; });
}

/// Level of each condition along an axis, and each level's mean value.
struct AxisLevels {
  std::vector<std::size_t> of;
  std::vector<double> value;
};

/// The least gap between sorted values that scatter about levels: of all gaps those far larger than any other, where
/// two values or more stand at a level on average; infinite where there are no such gaps.
double gap_between_levels(const std::vector<double>& sorted) {
  constexpr double far = 5.0, least = 0.02;  // times the next gap; of the largest value
  std::vector<double> gaps;
  for (std::size_t k = 1; k < sorted.size(); ++k) gaps.push_back(sorted[k] - sorted[k - 1]);
  std::ranges::sort(gaps, std::greater());
  double found = std::numeric_limits<double>::infinity(), largest_ratio = far;
  for (std::size_t k = 0; 2 * (k + 2) <= sorted.size(); ++k) {
    const double ratio = gaps[k + 1] > 0.0 ? gaps[k] / gaps[k + 1] : std::numeric_limits<double>::infinity();
    if (!(gaps[k] > least * std::max(std::abs(sorted.front()), std::abs(sorted.back())))) break;
    if (ratio >= largest_ratio) largest_ratio = ratio, found = gaps[k];
  }
  return found;
}

AxisLevels levels(const ConditionAxis& axis, const std::vector<OperatingCondition>& conditions, Spread spread) {
  std::vector<std::size_t> order(conditions.size());
  for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
  const auto at = [&](std::size_t i) { return axis.get(conditions[i]); };
  std::ranges::stable_sort(order, [&](std::size_t a, std::size_t b) { return at(a) < at(b); });
  AxisLevels found{std::vector<std::size_t>(conditions.size()), {}};
  std::vector<double> members, sorted;
  for (const std::size_t i : order) sorted.push_back(at(i));
  // Loads 10 % apart are levels too, where each is held far better than that.
  const double between_levels = spread == Spread::measured && axis.relative_gap > 0.0
                                    ? gap_between_levels(sorted)
                                    : std::numeric_limits<double>::infinity();
  for (std::size_t k = 0; k < order.size(); ++k) {
    const double x = at(order[k]), before = k > 0 ? at(order[k - 1]) : x;
    const double gap =
        spread == Spread::exact ? 1e-9 * std::abs(x) : std::max(axis.relative_gap * std::abs(x), axis.absolute_gap);
    if (k == 0 || x - before > gap || x - before >= between_levels) found.value.push_back(0.0), members.push_back(0.0);
    found.value.back() += x, members.back() += 1;
    found.of[order[k]] = found.value.size() - 1;
  }
  for (std::size_t l = 0; l < found.value.size(); ++l) found.value[l] /= members[l];
  return found;
}

/// Whether levels differ between conditions that agree in the abscissa and in their curve so far.
bool splits_a_place(const AxisLevels& levels, const std::vector<std::vector<std::size_t>>& keys,
                    const ConditionAxis& abscissa, const std::vector<OperatingCondition>& conditions) {
  std::map<std::pair<std::vector<std::size_t>, double>, std::size_t> seen;
  for (std::size_t i = 0; i < conditions.size(); ++i) {
    const auto [place, fresh] = seen.insert({{keys[i], abscissa.get(conditions[i])}, levels.of[i]});
    if (!fresh && place->second != levels.of[i]) return true;
  }
  return false;
}

/// Whether one of the curves has two places or more.
bool has_a_curve(const ConditionAxis& abscissa, const std::vector<OperatingCondition>& conditions) {
  const Curves curves = curves_against(abscissa.view, conditions, Spread::exact);
  std::map<std::size_t, double> place;
  for (std::size_t i = 0; i < conditions.size(); ++i) {
    const double x = abscissa.get(conditions[i]);
    if (place.emplace(curves.curve_of[i], x).first->second != x) return true;
  }
  return false;
}

}  // namespace

const ConditionView* curves_run_over(const std::vector<OperatingCondition>& conditions) {
  const auto found = std::ranges::find_if(axes(), [&](const ConditionAxis& a) { return has_a_curve(a, conditions); });
  return found == axes().end() ? nullptr : &found->view;
}

Curves curves_against(const ConditionView& abscissa, const std::vector<OperatingCondition>& conditions, Spread spread) {
  Curves curves;
  std::vector<std::vector<std::size_t>> keys(conditions.size());
  std::vector<std::string> labels(conditions.size());
  for (const ConditionAxis& axis : axes()) {
    if (&axis.view == &abscissa) continue;
    const AxisLevels found = levels(axis, conditions, spread);
    if (found.value.size() < 2 || (axis.follows_slip && !splits_a_place(found, keys, axis_of(abscissa), conditions)))
      continue;
    curves.varying += (curves.varying.empty() ? "" : ", ") + spaced(axis.view.name);
    for (std::size_t i = 0; i < conditions.size(); ++i) {
      keys[i].push_back(found.of[i]);
      labels[i] += (labels[i].empty() ? "" : ", ") + axis.label(found.value[found.of[i]]);
    }
  }
  const std::set<std::vector<std::size_t>> distinct(keys.begin(), keys.end());
  const std::vector<std::vector<std::size_t>> sorted(distinct.begin(), distinct.end());
  curves.labels.resize(sorted.size());
  for (std::size_t i = 0; i < keys.size(); ++i) {
    const auto place = std::lower_bound(sorted.begin(), sorted.end(), keys[i]) - sorted.begin();
    curves.curve_of.push_back(static_cast<std::size_t>(place));
    curves.labels[curves.curve_of.back()] = labels[i];
  }
  return curves;
}

Case with_smooth_curves(Case question, int points, const ConditionView& abscissa) {
  const Study asked = std::move(question.study);
  question.study = {asked.name, asked.models, {}, {}};
  const Curves curves = curves_against(abscissa, asked.conditions, Spread::exact);
  for (std::size_t curve = 0; curve < curves.labels.size(); ++curve) {
    std::vector<std::size_t> members;
    for (std::size_t i = 0; i < asked.conditions.size(); ++i)
      if (curves.curve_of[i] == curve) members.push_back(i);
    const auto place_of = [&](std::size_t i) { return axis_of(abscissa).get(asked.conditions[i]); };
    std::set<double> places;
    for (const std::size_t i : members) places.insert(place_of(i));
    const double from = *places.begin(), to = *places.rbegin();
    for (int k = 1; !abscissa.whole && k < points - 1 && to > from; ++k) {
      const double place = std::lerp(from, to, static_cast<double>(k) / (points - 1));
      const auto next = places.lower_bound(place);
      const double gap = std::min(*next - place, place - *std::prev(next));
      if (gap > 1e-3 * (to - from)) places.insert(place);
    }
    for (const double place : places) {
      // Beside the nearest condition: its speed, where that varies along the curve, is the nearest too.
      const std::size_t near = *std::ranges::min_element(members, [&](std::size_t a, std::size_t b) {
        return std::abs(place_of(a) - place) < std::abs(place_of(b) - place);
      });
      OperatingCondition at = asked.conditions[near];
      abscissa.set(at, place);
      if (near < asked.rotations.size() && asked.rotations[near])
        at.speed = speed_at_rotation(at, *asked.rotations[near], question.scenario.tire);
      question.study.conditions.push_back(at);
    }
  }
  return question;
}

std::string in_words(const Soil& soil) { return soil.name.empty() ? "a soil of its own (unnamed)" : soil.name; }

std::string in_words(const OperatingCondition& at) {
  const auto has_a_place = [](std::string_view name) { return name == "slip" || name == "load" || name == "speed"; };
  std::string words = fmt::format("load {}, slip {:.4g} %", newtons(at.load), 100 * at.slip);
  const OperatingCondition plain;
  for (const ConditionAxis& axis : axes())
    if (!has_a_place(axis.view.name) && axis.get(at) != axis.get(plain)) words += ", " + axis.label(axis.get(at));
  if (at.speed != plain.speed) words += fmt::format(", {:.4g} m/s", at.speed);
  return words;
}

std::string shared_in_words(const std::vector<OperatingCondition>& conditions, bool with_slip) {
  const OperatingCondition plain;
  std::string load, slip, rest;
  for (const ConditionAxis& axis : axes()) {
    const double value = axis.get(conditions.front());
    if (std::ranges::any_of(conditions, [&](const OperatingCondition& at) { return axis.get(at) != value; })) continue;
    if (axis.view.name == "load")
      load = ", load " + newtons(value, 6);
    else if (axis.view.name == "slip")
      slip = with_slip ? ", " + axis.label(value) : "";
    else if (value != axis.get(plain))
      rest += ", " + axis.label(value);
  }
  const std::string words = load + slip + rest;
  return words.empty() ? "" : words.substr(2);
}

bool alike(const OperatingCondition& a, const OperatingCondition& b) {
  bool agree = true;
  const auto near = [](double x, double y) { return std::abs(x - y) <= 1e-9 * std::max(std::abs(x), std::abs(y)); };
  each_member<OperatingCondition>([&](const char*, auto member, const auto&, const char*) {
    const auto &x = a.*member, &y = b.*member;
    if constexpr (std::is_same_v<decltype(x), const double&>)
      agree = agree && near(x, y);
    else if constexpr (std::is_same_v<decltype(x), const std::optional<double>&>)
      agree = agree && x.has_value() == y.has_value() && near(x.value_or(0.0), y.value_or(0.0));
    else
      agree = agree && x == y;
  });
  return agree;
}

}  // namespace soilbin::compare
