#include "compare/doubts/grain_doubts.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "bekker_wong/closed_forms.hpp"
#include "compare/doubts/grain_resolution.hpp"
#include "compare/sweep/varying.hpp"
#include "dem/bed/settled_bed.hpp"

namespace soilbin::compare {
namespace {

/// Answers of grains, or where there are none those of other models: at which grains would be asked.
template <class Use>
void each_answer_for_grains(const std::vector<ModelAnswers>& study, const Use& use) {
  const bool of_grains = std::any_of(study.begin(), study.end(), [](const ModelAnswers& model) {
    return model.choice.model == ModelKind::dem && any_result({model});
  });
  for (const ModelAnswers& model : study)
    for (const Answer& answer : model.answers)
      if (answer.result && (!of_grains || model.choice.model == ModelKind::dem))
        use(answer, of_grains ? SinkageOf::grains : SinkageOf::another_model);
}

/// By how much coarse grains change an answer: where the study of it reaches, at the condition where that is most.
std::string by_how_much(const Scenario& scenario, const std::vector<ModelAnswers>& study) {
  std::optional<ResolutionError> largest;
  OperatingCondition where;
  std::string beyond;
  each_answer_for_grains(study, [&](const Answer& answer, SinkageOf whose) {
    ResolutionError error = resolution_error(scenario, answer.at, answer.result->sinkage.value, whose);
    if (!error.known() && beyond.empty()) beyond = error.beyond;
    if (!error.known() || (largest && std::abs(error.drawbar_pull.value) <= std::abs(largest->drawbar_pull.value)))
      return;
    largest = std::move(error), where = answer.at;
  });
  if (largest) return fmt::format(": estimated error {} ({})", in_words(*largest), in_words(where));
  return beyond.empty() ? "" : fmt::format(": the error is unknown, since {}", beyond);
}

bool are_coarse(const GrainCounts& counts) {
  const bool few = counts.width < grains_wanted || counts.contact.value_or(grains_wanted) < grains_wanted;
  return few || counts.lug.value_or(grains_wanted_in_a_lug) < grains_wanted_in_a_lug;
}

/// The angular speed below which two mean grains that 100 N press together are damped by I*/dt instead of by mu_r.
std::string depends_on_the_step(const GranularSoil& grains) {
  const bool resisted = grains.grain_grain.rolling_friction > 0.0 || grains.grain_tire.rolling_friction > 0.0;
  const bool with_twist = grains.rolling_resistance == RollingResistance::directional_with_twist;
  if ((grains.rolling_resistance != RollingResistance::directional && !with_twist) || !resisted) return "";
  const double r = mean_diameter(grains) / 2.0, step = dem::longest_step(grains);
  const double mass = 4.0 / 3.0 * std::numbers::pi * grains.grain_density * r * r * r, inertia = 0.2 * mass * r * r;
  const double speed = grains.grain_grain.rolling_friction * r / 2.0 * 100.0 * step / inertia;
  std::string text = fmt::format(
      "with the rolling law '{}' answers depend on the time step: below the angular speed mu_r R* F_N dt/I* a contact "
      "is "
      "a dashpot of I*/dt, whatever mu_r. At the longest step, {:.3g} ms, two mean grains that 100 N press "
      "together are so below {:.2g} rad/s. At a quarter of the step a tire of 0.5 m radius at 4 kN, 20 % slip pulled "
      "1183 ± 43 N in place of 773 ± 19 N. rolling_resistance: elastic_plastic does not depend on it",
      with_twist ? "directional_with_twist" : "directional", 1e3 * step, speed);
  if (with_twist) text += ". This law also resists spin about the contact's normal, which the published one does not";
  return text;
}

/// E* of two of these grains [Pa].
double reduced_modulus(const GranularSoil& grains) {
  return grains.youngs_modulus / (2.0 * (1.0 - grains.poisson_ratio * grains.poisson_ratio));
}

/// Mean overlap of equal grains of a packing, over their radius, under a pressure of so many E*. By Rumpf a contact
/// bears F = pi d^2 p/(phi Z), here with phi Z = 0.6 * 6 (chosen), and by Hertz delta = (3 F/(4 E* sqrt(R*)))^(2/3),
/// R* = d/4: 2.39 (p/E*)^(2/3).
double overlap_under(double pressure) {
  constexpr double contacts = 0.6 * 6.0;                              // phi Z
  const double force = 4.0 * std::numbers::pi * pressure / contacts;  // of grains of radius 1
  return std::pow(3.0 * force / (4.0 * std::sqrt(0.5)), 2.0 / 3.0);
}

/// The pressure over E* that takes grains so deep.
double pressure_for(double overlap) { return std::pow(overlap / overlap_under(1.0), 1.5); }

/// The overlap at which Hertz's force holds the linear cohesion, pi k_c R* delta, over the radius.
double overlap_by_cohesion(const GranularSoil& grains) {
  const double root = 0.75 * std::numbers::pi * grains.grain_grain.cohesion / reduced_modulus(grains);
  return 0.5 * root * root;
}

/// An overlap over the radius, in words.
std::string of_radius(double overlap) {
  return overlap < 1.0 ? fmt::format("about {:.2g} % of their radius", 100 * overlap) : "more than their radius";
}

std::string modulus_text(double modulus) {
  if (modulus < 1e3) return fmt::format("{:.3g} Pa", modulus);
  return modulus < 1e6 ? fmt::format("{:.3g} kPa", modulus / 1e3) : fmt::format("{:.3g} MPa", modulus / 1e6);
}

std::string cohesion_doubt(const GranularSoil& grains) {
  if (!(grains.youngs_modulus > 0.0)) return "";
  const double overlap = overlap_by_cohesion(grains);
  if (!(overlap > deep_overlap)) return "";
  const double holds = reduced_modulus(grains) * std::sqrt(2.0 * deep_overlap) / (0.75 * std::numbers::pi);
  return fmt::format(
      "the cohesion of grain_grain, {:.6g} kJ/m^3, alone pulls these grains into each other by {}: Hertz's law holds "
      "for small overlaps; less than {:.3g} kJ/m^3 keeps it below {:.0f} %",
      grains.grain_grain.cohesion / 1e3, of_radius(overlap), holds / 1e3, 100 * deep_overlap);
}

/// The largest pressure under the wheel: over its width and the contact of the answers, at least a grain long; where
/// there are none, over half a radius (chosen).
struct Pressed {
  double pressure = 0.0;
  OperatingCondition at;
};

Pressed largest_pressure(const Scenario& scenario, const std::vector<OperatingCondition>& conditions,
                         const std::vector<ModelAnswers>& study) {
  const Tire& tire = scenario.tire;
  const double grain = mean_diameter(*scenario.soil.granular);
  Pressed most;
  const auto press = [&](const OperatingCondition& at, double contact) {
    const double pressure = at.load / (tire.width * std::max(contact, grain));
    if (pressure > most.pressure) most = {pressure, at};
  };
  each_answer_for_grains(study, [&](const Answer& answer, SinkageOf) {
    press(answer.at, bekker_wong::contact_length(std::max(0.0, answer.result->sinkage.value), tire.radius));
  });
  if (most.pressure == 0.0)
    for (const OperatingCondition& at : conditions) press(at, tire.radius / 2.0);
  return most;
}

}  // namespace

std::string soft_grain_doubt(const Scenario& scenario, const std::vector<OperatingCondition>& conditions,
                             const std::vector<ModelAnswers>& study) {
  if (!scenario.soil.granular || !(scenario.soil.granular->youngs_modulus > 0.0)) return "";
  const GranularSoil& grains = *scenario.soil.granular;
  const Pressed most = largest_pressure(scenario, conditions, study);
  const double overlap = overlap_under(most.pressure / reduced_modulus(grains));
  if (!(overlap > deep_overlap)) return "";
  const double needed = most.pressure / pressure_for(deep_overlap) / reduced_modulus(grains) * grains.youngs_modulus;
  return fmt::format(
      "grains this soft, {}, are pressed into each other by {} under the wheel's {:.2g} kPa ({}): Hertz's law holds "
      "for small overlaps, and a run stops at 50 %; a youngs_modulus of {:.2g} MPa or more keeps them below {:.0f} %",
      modulus_text(grains.youngs_modulus), of_radius(overlap), most.pressure / 1e3, in_words(most.at), needed / 1e6,
      100 * deep_overlap);
}

std::string narrow_bed_doubt(const Tire& tire, double bed_width) {
  const double widths = bed_width / tire.width;
  if (!(widths < wide_bed * (1 - 1e-9))) return "";
  return fmt::format(
      "the bed is {:.3g} tire widths wide, and its walls hold the soil: at 2 widths the paper's tire pulled 17 ± 4 % "
      "more "
      "than at 2.6; take {:.3g} m or more",
      widths, 2.6 * tire.width);
}

std::vector<std::string> grain_value_doubts(const GranularSoil& grains) {
  std::vector<std::string> doubts;
  const double density = grains.grain_density;
  if (density > 0.0 && (density < 500.0 || density > 8000.0))
    doubts.push_back(fmt::format("grain_density = {:.4g} kg/m^3 is outside 500 .. 8000: quartz has 2650, steel 7850{}",
                                 density, density < 10.0 ? "; is it meant in g/cm^3, 1000 times as much?" : ""));
  for (const auto& [name, pair] : {std::pair{"grain_grain", &grains.grain_grain}, {"grain_tire", &grains.grain_tire}})
    if (pair->sliding_friction > 1.5)
      doubts.push_back(fmt::format("sliding_friction of {} = {:.4g} is above 1.5: rock on rock has 0.4 .. 1", name,
                                   pair->sliding_friction));
  if (grains.radius_min > 0.0 && grains.radius_max > 5.0 * grains.radius_min)
    doubts.push_back(fmt::format(
        "radius_max is {:.2g} times radius_min, more than 5: the smallest grains set the time step and the number of "
        "grains, the largest the size of the bed, so runs take very long",
        grains.radius_max / grains.radius_min));
  for (const std::string& doubt : {cohesion_doubt(grains), depends_on_the_step(grains)})
    if (!doubt.empty()) doubts.push_back(doubt);
  return doubts;
}

bool grains_are_coarse(const Scenario& scenario, const std::vector<ModelAnswers>& study) {
  return scenario.soil.granular && are_coarse(count_grains(scenario, study));
}

std::string coarse_grain_doubt(const Scenario& scenario, const std::vector<ModelAnswers>& study) {
  if (!scenario.soil.granular) return "";
  const GrainCounts counts = count_grains(scenario, study);
  if (!are_coarse(counts)) return "";
  std::string lengths = fmt::format("{:.2g} across its width ({} wanted)", counts.width, grains_wanted);
  if (counts.contact) lengths += fmt::format(", {:.2g} along its contact ({})", *counts.contact, grains_wanted);
  if (counts.lug) lengths += fmt::format(", {:.2g} in a lug's height ({})", *counts.lug, grains_wanted_in_a_lug);
  return fmt::format("the grains are coarse for this wheel{}. Mean diameter {:.3g} mm: {}. See docs/lab/grain-size.md",
                     by_how_much(scenario, study), 1000 * counts.diameter, lengths);
}

GrainCounts count_grains(const Scenario& scenario, const std::vector<ModelAnswers>& study) {
  const Tire& tire = scenario.tire;
  GrainCounts counts;
  counts.diameter = mean_diameter(*scenario.soil.granular);
  counts.width = tire.width / counts.diameter;
  if (is_lugged(tire)) counts.lug = tire.lugs.height / counts.diameter;
  each_answer_for_grains(study, [&](const Answer& answer, SinkageOf) {
    const double count = bekker_wong::contact_length(answer.result->sinkage.value, tire.radius) / counts.diameter;
    if (!(count > 0.0) || (counts.contact && !(count < *counts.contact))) return;  // a wheel may stand on their tops
    counts.contact = count, counts.at = answer.at;
  });
  return counts;
}

std::vector<std::string> grain_doubts(const Scenario& scenario, const std::vector<OperatingCondition>& conditions,
                                      const std::vector<ModelAnswers>& study) {
  if (!scenario.soil.granular) return {};
  std::vector<std::string> doubts = grain_value_doubts(*scenario.soil.granular);
  for (const std::string& doubt : {soft_grain_doubt(scenario, conditions, study), coarse_grain_doubt(scenario, study)})
    if (!doubt.empty()) doubts.push_back(doubt);
  return doubts;
}

}  // namespace soilbin::compare
