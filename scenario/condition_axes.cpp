#include "scenario/condition_axes.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <utility>

namespace soilbin {
namespace {

/// A condition in the making.
struct Point {
  OperatingCondition at;
  std::optional<double> rotation;  ///< [rad/s]
};

using Setter = std::function<void(Point&)>;

/// The values that one key takes.
struct Axis {
  std::string key;
  const YamlNode* node = nullptr;
  std::vector<Setter> values;
};

constexpr std::size_t most_values = 10'000;

/// A value rounded to 12 digits of `largest`, in a unit.
double rounded(double value, double largest, const Unit& unit, std::optional<double> n) {
  const double per_unit = unit.denominator / unit.numerator / std::pow(10.0, unit.decimal);
  largest *= per_unit;
  if (!(largest > 1e-12 && largest < 1e12)) return value;
  const int places = 12 - static_cast<int>(std::ceil(std::log10(largest)));
  const std::string number = fmt::format("{:.{}f}", value * per_unit, places);
  if (read_number(number) == 0.0) return 0.0;
  return read_quantity(unit.text == "-" ? number : number + " " + unit.text, Measure{unit.text, any_value}, n);
}

std::vector<double> equally_spaced(double from, double to, std::size_t count, double step, const Unit& unit,
                                   std::optional<double> n) {
  std::vector<double> all;
  for (std::size_t i = 0; i < count; ++i) {
    const double x = from + static_cast<double>(i) * step, largest = std::max(std::abs(from), std::abs(to));
    all.push_back(std::clamp(rounded(x, largest, unit, n), std::min(from, to), std::max(from, to)));
  }
  return all;
}

InputError too_many_values() { return InputError(fmt::format("more than {} values in a range", most_values)); }

/// The numbers of {from, to, step | count}.
class RangeReader {
 public:
  RangeReader(const YamlNode& node, const Measure& measure, const Reading& reading)
      : node_(node), measure_(measure), reading_(reading) {}

  std::vector<double> read() {
    expect_keys(node_, {"from", "to", "step", "count"}, reading_);
    from_ = read_scalar(need("from"), measure_, reading_);
    to_ = read_scalar(need("to"), measure_, reading_).value;
    const YamlNode* step = value_of(node_, "step", Need::optional, "from one value to the next", reading_);
    const YamlNode* count = value_of(node_, "count", Need::optional, "number of values", reading_);
    if ((step == nullptr) == (count == nullptr))
      reading_.refuse(node_, "a range needs either 'step' or 'count'", "{from: 0 %, to: 60 %, step: 10 %}");
    return step != nullptr ? by_step(*step) : by_count(*count);
  }

 private:
  const YamlNode& need(const char* key) const {
    return *value_of(node_, key, Need::required, "an end of the range", reading_);
  }

  std::vector<double> by_step(const YamlNode& node) {
    const Quantity step = read_scalar(node, Measure{measure_.unit, any_value}, reading_);
    try {
      return numbers_by_step(from_, to_, step, reading_.n);
    } catch (const InputError& error) {
      reading_.refuse(node, error.what());
    }
  }

  std::vector<double> by_count(const YamlNode& node) {
    const int count = read_integer(node, 2, reading_);
    try {
      return numbers_by_count(from_, to_, count, reading_.n);
    } catch (const InputError& error) {
      reading_.refuse(node, error.what());
    }
  }

  const YamlNode& node_;
  const Measure& measure_;
  const Reading& reading_;
  Quantity from_;
  double to_ = 0.0;
};

std::vector<double> read_numbers(const YamlNode& node, const Measure& measure, const Reading& reading) {
  if (node.is_mapping()) return RangeReader(node, measure, reading).read();
  if (!node.is_sequence()) return {read_scalar(node, measure, reading).value};
  std::vector<double> values;
  for (const YamlNode& item : node.items) values.push_back(read_scalar(item, measure, reading).value);
  return values;
}

/// One value, or each of a list.
void each(const YamlNode& node, const auto& read) {
  if (!node.is_sequence()) return read(node);
  for (const YamlNode& item : node.items) read(item);
}

/// The visitor of OperatingCondition's description that collects axes.
class AxisReader {
 public:
  using C = OperatingCondition;

  AxisReader(const YamlNode& mapping, const Reading& reading) : mapping_(mapping), reading_(reading) {}

  template <class N>
  void number(const char* key, N C::*member, const Measure& measure, Need need, const char* meaning) {
    numbers(key, measure, need, meaning, [member](Point& point, double x) { point.at.*member = x; });
  }

  void rotation() {
    numbers("rotation", Measure{"rpm", above_zero}, Need::optional, "speed of rotation",
            [](Point& point, double x) { point.rotation = x; });
  }

  template <class N>
  void integer(const char* key, N C::*member, int lowest, Need need, const char* meaning) {
    Axis* axis = begin(key, need, meaning);
    if (axis == nullptr) return;
    each(*axis->node, [&](const YamlNode& node) {
      const int value = read_integer(node, lowest, reading_);
      axis->values.push_back([member, value](Point& point) { point.at.*member = value; });
    });
  }

  template <class E>
  void choice(const char* key, E C::*member, Need need, const char* meaning) {
    Axis* axis = begin(key, need, meaning);
    if (axis == nullptr) return;
    each(*axis->node, [&](const YamlNode& node) {
      const E value = read_choice<E>(node, reading_);
      axis->values.push_back([member, value](Point& point) { point.at.*member = value; });
    });
  }

  /// The axes in the order in which they are written.
  std::vector<Axis> in_order() && {
    for (const Axis& axis : axes_)
      if (axis.values.empty()) reading_.refuse(*axis.node, fmt::format("the list of '{}' is empty", axis.key));
    std::sort(axes_.begin(), axes_.end(), [](const Axis& a, const Axis& b) { return a.node < b.node; });
    return std::move(axes_);
  }

 private:
  void numbers(const char* key, const Measure& measure, Need need, const char* meaning, auto set) {
    Axis* axis = begin(key, need, meaning);
    if (axis == nullptr) return;
    for (const double x : read_numbers(*axis->node, measure, reading_))
      axis->values.push_back([set, x](Point& point) { set(point, x); });
  }

  Axis* begin(const char* key, Need need, const char* meaning) {
    const YamlNode* node = value_of(mapping_, key, need, meaning, reading_);
    return node == nullptr ? nullptr : &axes_.emplace_back(Axis{key, node, {}});
  }

  const YamlNode& mapping_;
  const Reading& reading_;
  std::vector<Axis> axes_;
};

/// speed_at_rotation, refused at its place in the file.
double implied_speed(const Point& point, const Tire& tire, const YamlNode& mapping, const Reading& reading) {
  try {
    return speed_at_rotation(point.at, *point.rotation, tire);
  } catch (const InputError& error) {
    reading.refuse(mapping, error.what(), "give 'speed' instead of 'rotation'");
  }
}

ConditionGrid read_grid(const YamlNode& mapping, const Tire& tire, const Reading& reading) {
  std::vector<std::string> keys = keys_of<OperatingCondition>();
  keys.emplace_back("rotation");
  expect_keys(mapping, keys, reading);
  const YamlNode* rotation = mapping.find("rotation");
  if (rotation != nullptr && mapping.find("speed") != nullptr)
    reading.refuse(*rotation, "'rotation' and 'speed' exclude each other: slip ties them");
  AxisReader reader(mapping, reading);
  describe(reader, std::type_identity<OperatingCondition>{});
  reader.rotation();
  std::vector<Point> points(1);
  for (const Axis& axis : std::move(reader).in_order()) {
    if (axis.values.size() > most_conditions / points.size())
      reading.refuse(mapping, fmt::format("more than {} conditions", most_conditions));
    std::vector<Point> product;
    for (const Point& point : points)
      for (const Setter& set : axis.values) set(product.emplace_back(point));
    points = std::move(product);
  }
  ConditionGrid grid;
  for (Point& point : points) {
    if (point.rotation) point.at.speed = implied_speed(point, tire, mapping, reading);
    grid.conditions.push_back(point.at);
    grid.rotations.push_back(point.rotation);
  }
  return grid;
}

}  // namespace

ConditionGrid read_conditions(const YamlNode& node, const Tire& tire, const Reading& reading) {
  if (!node.is_sequence()) return read_grid(node, tire, reading);
  if (node.items.empty()) reading.refuse(node, "the list of conditions is empty");
  ConditionGrid all;
  for (const YamlNode& item : node.items) {
    const ConditionGrid some = read_grid(item, tire, reading);
    if (all.conditions.size() + some.conditions.size() > most_conditions)
      reading.refuse(item, fmt::format("more than {} conditions", most_conditions));
    all.conditions.insert(all.conditions.end(), some.conditions.begin(), some.conditions.end());
    all.rotations.insert(all.rotations.end(), some.rotations.begin(), some.rotations.end());
  }
  return all;
}

std::vector<double> numbers_by_step(const Quantity& from, double to, const Quantity& step, std::optional<double> n) {
  const double steps = (to - from.value) / step.value;
  if (step.value == 0.0 || !(steps >= 0.0))
    throw InputError(
        "the step doesn't lead from one end of the range to the other: a falling range has a negative step");
  if (steps > static_cast<double>(most_values)) throw too_many_values();
  constexpr double slack = 1e-9;  // of a step: 'to' counts as reached
  const std::size_t count = static_cast<std::size_t>(std::floor(steps + slack)) + 1;
  return equally_spaced(from.value, to, count, step.value, step.unit, n);
}

std::vector<double> numbers_by_count(const Quantity& from, double to, int count, std::optional<double> n) {
  if (count > static_cast<int>(most_values)) throw too_many_values();
  return equally_spaced(from.value, to, static_cast<std::size_t>(count), (to - from.value) / (count - 1), from.unit, n);
}

double speed_at_rotation(const OperatingCondition& at, double rotation, const Tire& tire) {
  if (at.slip <= -1.0) throw InputError("a wheel at -100 % slip is locked: it has no speed of rotation");
  const double rim = tire.radius * rotation;
  const double along = at.slip >= 0.0 ? rim * (1.0 - at.slip) : rim / (1.0 + at.slip);
  if (at.slip_by == SlipBy::travel_speed) return along;
  constexpr double smallest_cosine = 1e-9;
  if (std::cos(at.yaw) < smallest_cosine)
    throw InputError("at a yaw of 90 deg slip in the wheel's plane doesn't tell the speed of travel");
  return along / std::cos(at.yaw);
}

}  // namespace soilbin
