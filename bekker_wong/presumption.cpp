#include "bekker_wong/presumption.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <string>
#include <utility>

#include "bekker_wong/effect.hpp"
#include "scenario/quantity.hpp"

namespace soilbin::bekker_wong {

double Presumption::operator()(const Tire& tire) const {
  const std::optional<double> value = declared(tire);
  return value ? *value : presumed(tire);
}

std::vector<Presumed> presumed(const EffectForm& form, const Tire& tire) {
  std::vector<Presumed> all;
  for (const Presumption& p : form.presumes) {
    if (p.declared(tire)) continue;
    const double value = p.presumed(tire);
    // 5.5 mm, not 5.5000000000000005 mm
    const double shown = read_number(fmt::format("{:.6g}", value)).value_or(value);
    std::string words = fmt::format("{} = {}", p.name, write_quantity(shown, std::string(p.unit)));
    if (!words.ends_with(fmt::format("= {}", p.rule))) words += fmt::format(" ({})", p.rule);
    all.push_back({std::string(p.key), value, std::move(words), std::string(p.else_do)});
  }
  return all;
}

bool errs_by_carcass(const Tire& tire, const std::vector<EffectChoice>& effects) {
  return tire.carcass_pressure && tire.carcass_pressure->std_error > 0.0 &&
         std::ranges::any_of(
             effects, [](const EffectChoice& choice) { return depends_on(find_form(choice), carcass_pressure_key); });
}

std::vector<std::string> presumptions(const std::vector<EffectChoice>& choices, const Tire& tire) {
  struct OfEffect {
    std::string id;
    std::vector<std::string> values;
    std::string else_do;
  };
  std::vector<OfEffect> by_effect;
  for (const EffectChoice& choice : choices)
    for (const Presumed& value : presumed(find_form(choice), tire)) {
      auto of = std::find_if(by_effect.begin(), by_effect.end(), [&](const auto& e) { return e.id == choice.id; });
      if (of == by_effect.end()) of = by_effect.insert(of, {choice.id, {}, {}});
      if (!value.else_do.empty()) of->else_do = "; " + value.else_do;
      if (std::find(of->values.begin(), of->values.end(), value.words) == of->values.end())
        of->values.push_back(value.words);
    }
  std::vector<std::string> sentences;
  for (const auto& [id, values, else_do] : by_effect) {
    std::string name = id, listed;
    std::replace(name.begin(), name.end(), '_', ' ');
    for (const std::string& value : values) listed += (listed.empty() ? "" : ", ") + value;
    sentences.push_back(fmt::format("{} assumes {}, which the tire does not declare{}.", name, listed, else_do));
  }
  return sentences;
}

}  // namespace soilbin::bekker_wong
