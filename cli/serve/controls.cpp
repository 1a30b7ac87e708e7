#include "cli/serve/controls.hpp"

#include <algorithm>
#include <cmath>
#include <functional>

#include "bekker_wong/effect.hpp"
#include "cli/described_flags.hpp"
#include "cli/outputs.hpp"
#include "compare/report/json_fields.hpp"
#include "compare/report/number_text.hpp"
#include "scenario/quantity.hpp"
#include "scenario/soil_parameters.hpp"

namespace soilbin::cli {
namespace {

using Json = nlohmann::ordered_json;

/// 1, 2 or 5 times a power of ten, nearest to x (> 0) on a logarithmic scale.
double round_number(double x) {
  const double decade = std::pow(10.0, std::floor(std::log10(x)));
  for (const auto& [digit, below] : {std::pair{1.0, 1.5}, {2.0, 3.5}, {5.0, 7.5}})
    if (x < below * decade) return digit * decade;
  return 10 * decade;
}

/// A number of SI as it is written in this unit.
double read_in(double value, const std::string& unit) {
  const std::string text = write_quantity(value, unit), own = " " + unit;
  const bool in_unit = unit == "-" || unit.empty() || text.ends_with(own);  // else in base units, to keep every bit
  const auto number = read_number(text.substr(0, text.find(' ')));
  return in_unit && number ? *number : value * compare::per_unit(unit);
}

/// A slider's limits and step, in the unit that is shown. Where the range knows no limit a slider reaches a few times
/// the value or `usual`, both in that unit; where the limit itself is not admissible, half way to it.
struct Slider {
  double lower, upper, step;
};

Slider slider_over(const Range& range, double per_si, double value, double usual) {
  constexpr double steps = 200;
  const double far = round_number(3 * std::max(std::abs(value), usual));
  const auto limit = [&](double end, bool open, double else_at) {
    return std::isfinite(end) ? std::round(end * per_si * 10) / 10 / (open ? 2.0 : 1.0) : else_at;
  };
  Slider slider{limit(range.lower, range.lower_open, value < 0.0 ? -far : 0.0),
                limit(range.upper, range.upper_open, far), 0.0};
  slider.step = round_number((slider.upper - slider.lower) / steps);
  if (slider.lower == 0.0 && range.lower_open) slider.lower = slider.step;
  return slider;
}

std::string title_of(std::string flag) {
  std::ranges::replace(flag, '-', ' ');
  return compare::capital(flag);
}

Json control_json(const char* group, const std::string& flag, const char* meaning, const std::string& unit, Json value,
                  const Slider& slider) {
  return {{"group", group}, {"key", flag},           {"title", title_of(flag)}, {"meaning", meaning}, {"unit", unit},
          {"value", value}, {"lower", slider.lower}, {"upper", slider.upper},   {"step", slider.step}};
}

/// Where a slider stands whose number tire or vehicle don't declare [SI]; no value: there is no slider.
std::optional<double> usual_value(const std::string& key, double radius) {
  if (key == "inflation_pressure") return 100e3;
  if (key == "carcass_pressure") return 30e3;
  if (key == "thickness") return 0.04 * radius;
  if (key == "power") return 100e3;
  return std::nullopt;
}

std::optional<double> value_of(const std::optional<double>& number) { return number; }
std::optional<double> value_of(const std::optional<Estimate>& estimate) {
  return estimate ? std::optional(estimate->value) : std::nullopt;
}

/// A usual size [SI] of a number, by its key, as of slider_over.
using UsualSize = std::function<double(std::string_view key)>;

UsualSize always(double size) {
  return [size](std::string_view) { return size; };
}

/// Adds a control for each number of `from`; `radius` [m] of the tire; `force`: the unit in which forces are told.
template <class T>
void add_numbers(Json& to, const T& from, const char* group, const std::string& prefix, const UsualSize& usual,
                 double radius, const std::string& force = "N") {
  each_member<T>([&](const char* key, auto member, const auto& limits, const char* meaning) {
    using Value = std::decay_t<decltype(from.*member)>;
    const Value& value = from.*member;
    const std::string flag = key_of(prefix, key);
    if (std::is_same_v<T, OperatingCondition> && key == std::string_view("inflation_pressure")) return;  // the tire's
    if constexpr (std::is_same_v<Value, double>) {
      const std::string unit = limits.unit == "N" ? force : shown_unit(limits.unit);
      const double per_si = compare::per_unit(unit);
      to.push_back(control_json(group, flag, meaning, unit, read_in(value, unit),
                                slider_over(limits.range, per_si, value * per_si, usual(key) * per_si)));
    } else if constexpr (std::is_same_v<Value, std::optional<double>> ||
                         std::is_same_v<Value, std::optional<Estimate>>) {
      const std::optional<double> start = usual_value(key, radius);
      if (!start) return;
      const std::string unit = shown_unit(limits.unit);
      const double per_si = compare::per_unit(unit);
      const std::optional<double> given = value_of(value);
      to.push_back(control_json(group, flag, meaning, unit, given ? Json(read_in(*given, unit)) : Json(nullptr),
                                slider_over(limits.range, per_si, given.value_or(0.0) * per_si, *start * per_si)));
    } else if constexpr (std::is_same_v<Value, std::optional<int>> && std::is_same_v<T, Lugs>) {
      to.push_back(control_json(group, flag, meaning, "", value ? Json(*value) : Json(nullptr),
                                {static_cast<double>(limits), 60.0, 1.0}));
    }
  });
}

/// A usual size [SI]: a slider reaches three times this for a soil without the value, or with a small one.
double usual_soil_value(const SoilParameter& p) {
  const std::string_view name = p.name;
  if (name == "k_c") return 5e3;
  if (name == "k_phi") return 500e3;
  if (name == "cohesion") return 3e3;
  return name == "shear_modulus" ? 0.02 : 1.0;
}

void add_soil_values(Json& numbers, const SemiEmpiricalSoil& soil) {
  for (const SoilParameter& p : soil_parameters) {
    const std::string unit = std::string(p.unit) == "-" ? "" : p.unit;
    const Estimate& value = soil.*p.value;
    const double n = soil.exponent.value;
    const auto in_unit = [&](double si) {
      const std::string text = write_quantity(si, p.unit, n);
      return read_number(text.substr(0, text.find(' '))).value_or(si * p.per_si);
    };
    Json control = control_json("soil", key_of("", p.name), p.meaning, unit, in_unit(value.value),
                                slider_over(p.range, p.per_si, value.value * p.per_si, usual_soil_value(p) * p.per_si));
    control["title"] = p.title;
    control["sd"] = in_unit(value.std_error);
    numbers.push_back(std::move(control));
  }
}

/// A slider for each parameter of a form. Bounds that lie far beyond what is usual are for the box beside it.
Json parameters_json(const bekker_wong::EffectForm& form) {
  constexpr double steps = 200, usual = 4, far = 12;
  return compare::list_of(form.parameters, [](const bekker_wong::EffectParameter& parameter) {
    const double per_si = compare::per_unit(parameter.unit), start = parameter.fallback * per_si;
    double lower = parameter.lower * per_si, upper = parameter.upper * per_si;
    if (start != 0.0 && upper > far * std::abs(start)) upper = round_number(usual * std::abs(start));
    if (lower < -upper) lower = -upper;
    return Json{{"key", parameter.name},
                {"title", parameter.name},
                {"meaning", parameter.meaning},
                {"unit", parameter.unit == "-" ? "" : parameter.unit},
                {"value", read_in(parameter.fallback, parameter.unit)},
                {"lower", lower},
                {"upper", upper},
                {"step", round_number((upper - lower) / steps)}};
  });
}

/// A value of the condition that most questions leave out, and that only some effects hear of.
struct SliderSpec {
  const char* key;
  const char* meaning;
  const char* unit;
  double start;  ///< in that unit: where the effects' defaults have the soil as declared
  double lower, upper, step;
};

constexpr SliderSpec condition_sliders[] = {{"pass", "1: undisturbed soil", "", 1, 1, 10, 1},
                                            {"moisture", "water content by mass", "%", 8, 0, 30, 0.5},
                                            {"position", "mean distance along the bin", "m", 0, -10, 10, 0.1},
                                            {"run", "order in which the runs were made", "", 1, 0, 100, 1}};

double given_value(const OperatingCondition& at, const SliderSpec& slider) {
  const std::string key = slider.key;
  if (key == "pass") return at.pass;
  if (key == "run") return at.run ? *at.run : slider.start;
  const std::optional<double>& value = key == "moisture" ? at.moisture : at.position;
  return value ? read_in(*value, slider.unit) : slider.start;
}

Json hearing_ids(const std::string& key) {
  Json ids = Json::array();
  for (const bekker_wong::EffectForm& form : bekker_wong::effect_catalogue())
    if (depends_on(form, key) && (ids.empty() || ids.back() != form.id)) ids.push_back(form.id);
  return ids;
}

template <class Described>
bool is_flag_of(const std::string& flag) {
  const std::vector<std::string> keys = keys_of<Described>();
  return std::ranges::any_of(keys, [&](const std::string& key) { return key_of("", key.c_str()) == flag; });
}

void add_condition_sliders(Json& numbers, const OperatingCondition& at) {
  for (const SliderSpec& slider : condition_sliders)
    numbers.push_back({{"group", "condition"},
                       {"key", slider.key},
                       {"title", compare::capital(slider.key)},
                       {"meaning", slider.meaning},
                       {"unit", slider.unit},
                       {"value", given_value(at, slider)},
                       {"lower", slider.lower},
                       {"upper", slider.upper},
                       {"step", slider.step},
                       {"effects", hearing_ids(slider.key)}});
}

}  // namespace

std::string shown_unit(const std::string& unit) { return unit == "-" ? "%" : unit; }

std::string without_blanks(std::string text) {
  for (std::size_t at = text.find(' '); at != std::string::npos; at = text.find(' ', at + 1))
    if (at + 1 == text.size() || text[at + 1] != '1') text.erase(at--, 1);  // '0.2 1/kPa' needs its blank
  return text;
}

std::string key_of(const std::string& prefix, const char* key) { return flag_of(prefix, key).substr(2); }

std::string effect_word(const EffectChoice& choice, const Soil& soil) {
  const bekker_wong::EffectForm& form = bekker_wong::find_form(choice);
  std::string word = form.id + ":" + form.form;
  for (const bekker_wong::EffectParameter& parameter : form.parameters) {
    const auto given = choice.parameters.find(parameter.name);
    if (given == choice.parameters.end() || given->second == parameter.fallback) continue;
    word +=
        "," + parameter.name + "=" + without_blanks(write_quantity(given->second, parameter.unit, exponent_of(soil)));
  }
  return word;
}

Json effects_json(const std::vector<EffectChoice>& effects, const Soil& soil) {
  Json all = Json::array();
  for (const bekker_wong::EffectForm& form : bekker_wong::effect_catalogue()) {
    if (all.empty() || all.back()["id"] != form.id)
      all.push_back({{"id", form.id},
                     {"of", form.measurement ? "measurement" : "wheel"},
                     {"on", nullptr},
                     {"forms", Json::array()}});
    all.back()["forms"].push_back({{"form", form.form},
                                   {"equation", form.equation},
                                   {"source", form.source},
                                   {"parameters", parameters_json(form)}});
    for (const EffectChoice& choice : effects)
      if (choice.id == form.id) all.back()["on"] = effect_word(choice, soil);
  }
  return all;
}

bool is_tire_flag(const std::string& key) { return key.starts_with("lug-") || is_flag_of<Tire>(key); }

bool is_soil_flag(const std::string& key) { return is_flag_of<SemiEmpiricalSoil>(key); }

bool is_told_in_kilonewtons(double load) { return load >= 1000.0; }

Json numbers_json(const Case& question, const std::string& force) {
  constexpr double usual_of_condition = 0.1, usual_of_tire = 0.1, usual_lug = 0.02;
  Json numbers = Json::array();
  const OperatingCondition& at = question.study.conditions.front();
  const Tire& tire = question.scenario.tire;
  add_numbers(numbers, at, "condition", "", always(usual_of_condition), tire.radius, force);
  add_numbers(numbers, tire, "tire", "", always(usual_of_tire), tire.radius);
  add_numbers(numbers, tire.lugs, "tire", "lug-", always(usual_lug * tire.radius), tire.radius);
  if (question.scenario.soil.semi_empirical) add_soil_values(numbers, *question.scenario.soil.semi_empirical);
  add_condition_sliders(numbers, at);
  return numbers;
}

std::string force_unit_of(const compare::VehicleCase& vehicle) {
  return is_told_in_kilonewtons(vehicle.mass * gravity_of(vehicle.soil)) ? "kN" : "N";
}

Json vehicle_numbers_json(const compare::VehicleCase& vehicle, const std::string& force) {
  constexpr double usual_speed = 0.1, usual_mass = 10.0, usual_height = 0.1;
  const double weight = vehicle.mass * gravity_of(vehicle.soil), radius = vehicle.line_radius();
  Json numbers = Json::array();
  const UsualSize usual = [&](std::string_view key) { return key == "pull" ? weight / 6 : usual_speed; };
  add_numbers(numbers, vehicle.condition, "condition", "", usual, radius, force);
  add_numbers(numbers, vehicle, "vehicle", "", always(usual_mass), radius);
  Json centre = Json::array();
  add_numbers(centre, vehicle.centre_of_gravity, "vehicle", "centre-of-gravity-", always(usual_height), radius);
  const auto [rear, front] = std::ranges::minmax(vehicle.axles, {}, &compare::VehicleAxle::x);
  for (Json& control : centre) {
    if (control["key"] == "centre-of-gravity-y") continue;
    if (control["key"] == "centre-of-gravity-x" && front.x > rear.x)
      control["lower"] = rear.x, control["upper"] = front.x, control["step"] = 0.01;
    numbers.push_back(std::move(control));
  }
  if (vehicle.soil.semi_empirical) add_soil_values(numbers, *vehicle.soil.semi_empirical);
  return numbers;
}

Json effect_values_json(const std::vector<EffectChoice>& effects) {
  return compare::list_of(effects, [](const EffectChoice& choice) {
    const bekker_wong::EffectForm& form = bekker_wong::find_form(choice);
    const auto value_of = [&](const bekker_wong::EffectParameter& parameter) {
      const auto given = choice.parameters.find(parameter.name);
      const double value = given == choice.parameters.end() ? parameter.fallback : given->second;
      return Json{{"key", parameter.name}, {"value", read_in(value, parameter.unit)}};
    };
    return Json{{"id", form.id}, {"form", form.form}, {"parameters", compare::list_of(form.parameters, value_of)}};
  });
}

}  // namespace soilbin::cli
