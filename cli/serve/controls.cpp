#include "cli/serve/controls.hpp"

#include <algorithm>
#include <cmath>

#include "bekker_wong/effect.hpp"
#include "cli/described_flags.hpp"
#include "cli/text_output.hpp"
#include "compare/doubts/unheard.hpp"
#include "compare/report/number_text.hpp"
#include "scenario/quantity.hpp"

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
  const std::string text = write_quantity(value, unit);
  return read_number(text.substr(0, text.find(' '))).value_or(value);
}

/// The visitor that makes a control of each number that always has a value. Where the description knows no limit a
/// slider reaches a few times `start`; where the limit itself is not admissible, half way to it.
template <class T>
class NumbersOf {
 public:
  NumbersOf(Json& to, const T& from, std::string prefix, double start)
      : to_(to), from_(from), prefix_(std::move(prefix)), start_(start) {}

  void number(const char* key, double T::*member, const Measure& measure, Need, const char* meaning) {
    constexpr double steps = 200;
    const std::string unit = shown_unit(measure.unit), flag = key_of(prefix_, key);
    const double per_si = compare::per_unit(unit), value = from_.*member * per_si;
    const auto limit = [&](double end, bool open) {
      return std::isfinite(end) ? std::round(end * per_si / (open ? 2.0 : 1.0))
                                : round_number(3 * std::max(std::abs(value), start_ * per_si));
    };
    const double upper = limit(measure.range.upper, measure.range.upper_open);
    double lower = limit(measure.range.lower, measure.range.lower_open);
    const double step = round_number((upper - lower) / steps);
    if (lower == 0.0 && measure.range.lower_open) lower = step;
    std::string title = compare::capital(flag);
    std::replace(title.begin(), title.end(), '-', ' ');
    to_.push_back({{"key", flag},
                   {"title", title},
                   {"meaning", meaning},
                   {"unit", unit},
                   {"value", read_in(from_.*member, unit)},
                   {"lower", lower},
                   {"upper", upper},
                   {"step", step}});
  }
  template <class N>
  void number(const char*, std::optional<N> T::*, const Measure&, Need, const char*) {}
  template <class... Rest>
  void integer(const Rest&...) {}
  template <class... Rest>
  void choice(const Rest&...) {}

 private:
  Json& to_;
  const T& from_;
  std::string prefix_;
  double start_;
};

/// A slider for each parameter of a form. Bounds that lie far beyond what is usual are for the box beside it.
Json parameters_json(const bekker_wong::EffectForm& form) {
  constexpr double steps = 200, usual = 4, far = 12;
  Json all = Json::array();
  for (const bekker_wong::EffectParameter& parameter : form.parameters) {
    const double per_si = compare::per_unit(parameter.unit), start = parameter.fallback * per_si;
    double lower = parameter.lower * per_si, upper = parameter.upper * per_si;
    if (start != 0.0 && upper > far * std::abs(start)) upper = round_number(usual * std::abs(start));
    if (lower < -upper) lower = -upper;
    all.push_back({{"key", parameter.name},
                   {"title", parameter.name},
                   {"meaning", parameter.meaning},
                   {"unit", parameter.unit == "-" ? "" : parameter.unit},
                   {"value", read_in(parameter.fallback, parameter.unit)},
                   {"lower", lower},
                   {"upper", upper},
                   {"step", round_number((upper - lower) / steps)}});
  }
  return all;
}

/// A value of the condition that most questions leave out, and that only some effects hear of.
struct Heard {
  const char* key;
  const char* meaning;
  const char* unit;
  double start;  ///< in that unit: where the effects' defaults have the soil as declared
  double lower, upper, step;
};

constexpr Heard heard_values[] = {{"pass", "1: undisturbed soil", "", 1, 1, 10, 1},
                                  {"moisture", "water content by mass", "%", 8, 0, 30, 0.5},
                                  {"position", "mean distance along the bin", "m", 0, -10, 10, 0.1},
                                  {"run", "order in which the runs were made", "", 1, 0, 100, 1}};

double given_value(const OperatingCondition& at, const Heard& heard) {
  const std::string key = heard.key;
  if (key == "pass") return at.pass;
  if (key == "run") return at.run ? *at.run : heard.start;
  const std::optional<double>& value = key == "moisture" ? at.moisture : at.position;
  return value ? read_in(*value, heard.unit) : heard.start;
}

Json hearing_ids(const std::string& key) {
  Json ids = Json::array();
  for (const bekker_wong::EffectForm& form : bekker_wong::effect_catalogue())
    if (compare::hears_of(form, key) && (ids.empty() || ids.back() != form.id)) ids.push_back(form.id);
  return ids;
}

void add_heard_values(Json& numbers, const OperatingCondition& at) {
  for (const Heard& heard : heard_values)
    numbers.push_back({{"key", heard.key},
                       {"title", compare::capital(heard.key)},
                       {"meaning", heard.meaning},
                       {"unit", heard.unit},
                       {"value", given_value(at, heard)},
                       {"lower", heard.lower},
                       {"upper", heard.upper},
                       {"step", heard.step},
                       {"effects", hearing_ids(heard.key)}});
}

}  // namespace

std::string shown_unit(const std::string& unit) { return unit == "-" ? "%" : unit; }

std::string without_blanks(std::string text) {
  std::erase(text, ' ');
  return text;
}

std::string key_of(const std::string& prefix, const char* key) { return flag_of(prefix, key).substr(2); }

std::string effect_word(const EffectChoice& choice, const Soil& soil) {
  const bekker_wong::EffectForm& form = bekker_wong::find_form(choice);
  std::string word = form.id + ":" + form.form;
  for (const bekker_wong::EffectParameter& parameter : form.parameters) {
    const auto given = choice.parameters.find(parameter.name);
    if (given == choice.parameters.end() || given->second == parameter.fallback) continue;
    const double n = soil.semi_empirical ? soil.semi_empirical->exponent.value : 1.0;
    word += "," + parameter.name + "=" + without_blanks(write_quantity(given->second, parameter.unit, n));
  }
  return word;
}

Json effects_json(const Case& question) {
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
    for (const EffectChoice& choice : question.study.models.front().effects)
      if (choice.id == form.id) all.back()["on"] = effect_word(choice, question.scenario.soil);
  }
  return all;
}

Json numbers_json(const Case& question) {
  Json numbers = Json::array();
  NumbersOf<OperatingCondition> of_condition(numbers, question.study.conditions.front(), "", 0.1);
  describe(of_condition, std::type_identity<OperatingCondition>{});
  NumbersOf<Lugs> of_lugs(numbers, question.scenario.tire.lugs, "lug-", 0.02 * question.scenario.tire.radius);
  describe(of_lugs, std::type_identity<Lugs>{});
  add_heard_values(numbers, question.study.conditions.front());
  return numbers;
}

Json effect_values_json(const Case& question) {
  Json all = Json::array();
  for (const EffectChoice& choice : question.study.models.front().effects) {
    const bekker_wong::EffectForm& form = bekker_wong::find_form(choice);
    Json values = Json::array();
    for (const bekker_wong::EffectParameter& parameter : form.parameters) {
      const auto given = choice.parameters.find(parameter.name);
      values.push_back(
          {{"key", parameter.name},
           {"value", read_in(given == choice.parameters.end() ? parameter.fallback : given->second, parameter.unit)}});
    }
    all.push_back({{"id", form.id}, {"form", form.form}, {"parameters", values}});
  }
  return all;
}

}  // namespace soilbin::cli
