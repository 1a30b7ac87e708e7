#include "compare/doubts/grain_doubts.hpp"

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
void each_answer_for_grains(const std::vector<ModelAnswers>& study, const auto& use) {
  const bool of_grains = std::any_of(study.begin(), study.end(), [](const ModelAnswers& model) {
    return model.choice.model == ModelKind::dem && any_result({model});
  });
  for (const ModelAnswers& model : study)
    for (const Answer& answer : model.answers)
      if (answer.result && (!of_grains || model.choice.model == ModelKind::dem))
        use(answer, of_grains ? SinkageOf::grains : SinkageOf::another_model);
}

/// By how much coarse grains change an answer, where the study of it reaches: most, and at which condition.
struct CoarseGrainsDo {
  std::optional<ResolutionError> largest{};
  std::optional<OperatingCondition> at{};
  std::string beyond{};  ///< why nothing is known; "" too where nothing was asked
};

CoarseGrainsDo what_coarse_grains_do(const Scenario& scenario, const std::vector<ModelAnswers>& study) {
  CoarseGrainsDo most;
  each_answer_for_grains(study, [&](const Answer& answer, SinkageOf whose) {
    ResolutionError error = resolution_error(scenario, answer.at, answer.result->sinkage.value, whose);
    const std::optional<ResolutionError>& largest = most.largest;
    if (!error.known() && most.beyond.empty()) most.beyond = error.beyond;
    if (!error.known() || (largest && std::abs(error.drawbar_pull.value) <= std::abs(largest->drawbar_pull.value)))
      return;
    most.largest = std::move(error), most.at = answer.at;
  });
  if (most.largest) most.beyond.clear();
  return most;
}

bool are_coarse(const GrainCounts& counts) {
  const bool few = counts.width < grains_wanted || counts.contact.value_or(grains_wanted) < grains_wanted;
  return few || counts.lug.value_or(grains_wanted_in_a_lug) < grains_wanted_in_a_lug;
}

/// The angular speed below which two mean grains that 100 N press together are damped by I*/dt instead of by mu_r.
Doubts step_dependent_rolling(const GranularSoil& grains) {
  const bool resisted = grains.grain_grain.rolling_friction > 0.0 || grains.grain_tire.rolling_friction > 0.0;
  const bool with_twist = grains.rolling_resistance == RollingResistance::directional_with_twist;
  if ((grains.rolling_resistance != RollingResistance::directional && !with_twist) || !resisted) return {};
  const double r = mean_diameter(grains) / 2.0, step = dem::longest_step(grains);
  const double mass = 4.0 / 3.0 * std::numbers::pi * grains.grain_density * r * r * r, inertia = 0.2 * mass * r * r;
  const double speed = grains.grain_grain.rolling_friction * r / 2.0 * 100.0 * step / inertia;
  const char* law = with_twist ? "directional_with_twist" : "directional";
  return {Doubt{DoubtKind::rolling_depends_on_step, {law, 1e3 * step, speed, with_twist ? law : ""}}};
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

/// The overlap at which jkr's adhesion and elasticity balance between two mean grains, a^2/(3 R*) with a^3 =
/// (9/2) pi w R*^2/E* (Johnson, Kendall and Roberts 1971), over the radius.
double overlap_by_adhesion(const GranularSoil& grains) {
  const double r = mean_diameter(grains) / 2.0, reduced = r / 2.0;
  const double cube =
      4.5 * std::numbers::pi * grains.grain_grain.work_of_adhesion * reduced * reduced / reduced_modulus(grains);
  return std::pow(cube, 2.0 / 3.0) / (3.0 * reduced) / r;
}

Doubts adhesion_doubts(const GranularSoil& grains) {
  const double overlap = overlap_by_adhesion(grains), work = grains.grain_grain.work_of_adhesion;
  if (!(overlap > deep_overlap)) return {};
  const double holds = work * std::pow(deep_overlap / overlap, 1.5);
  return {Doubt{DoubtKind::cohesion_presses_grains,
                {"work_of_adhesion", work, "J/m^2", overlap, holds, "J/m^2", 100 * deep_overlap}}};
}

Doubts cohesion_doubts(const GranularSoil& grains) {
  if (!(grains.youngs_modulus > 0.0)) return {};
  if (grains.cohesion_law == GrainCohesion::jkr) return adhesion_doubts(grains);
  const double overlap = overlap_by_cohesion(grains);
  if (!(overlap > deep_overlap)) return {};
  const double holds = reduced_modulus(grains) * std::sqrt(2.0 * deep_overlap) / (0.75 * std::numbers::pi);
  return {Doubt{
      DoubtKind::cohesion_presses_grains,
      {"cohesion", grains.grain_grain.cohesion / 1e3, "kJ/m^3", overlap, holds / 1e3, "kJ/m^3", 100 * deep_overlap}}};
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

Doubts soft_grain_doubts(const Scenario& scenario, const std::vector<OperatingCondition>& conditions,
                         const std::vector<ModelAnswers>& study) {
  if (!scenario.soil.granular || !(scenario.soil.granular->youngs_modulus > 0.0)) return {};
  const GranularSoil& grains = *scenario.soil.granular;
  const Pressed most = largest_pressure(scenario, conditions, study);
  const double overlap = overlap_under(most.pressure / reduced_modulus(grains));
  if (!(overlap > deep_overlap)) return {};
  const double needed = most.pressure / pressure_for(deep_overlap) / reduced_modulus(grains) * grains.youngs_modulus;
  return {Doubt{DoubtKind::soft_grains,
                {grains.youngs_modulus, overlap, most.pressure / 1e3, needed / 1e6, 100 * deep_overlap},
                most.at}};
}

Doubts narrow_bed_doubts(const Tire& tire, double bed_width) {
  const double widths = bed_width / tire.width;
  if (!(widths < wide_bed * (1 - 1e-9))) return {};
  return {Doubt{DoubtKind::narrow_bed, {widths, 2.6 * tire.width}}};
}

Doubts grain_value_doubts(const GranularSoil& grains) {
  Doubts doubts;
  const double density = grains.grain_density;
  if (density > 0.0 && (density < 500.0 || density > 8000.0))
    doubts.push_back(
        {density < 10.0 ? DoubtKind::grain_density_in_g_cm3 : DoubtKind::unusual_grain_density, {density}});
  for (const auto& [name, pair] : {std::pair{"grain_grain", &grains.grain_grain}, {"grain_tire", &grains.grain_tire}})
    if (pair->sliding_friction > 1.5)
      doubts.push_back({DoubtKind::unusual_sliding_friction, {name, pair->sliding_friction}});
  if (grains.radius_min > 0.0 && grains.radius_max > 5.0 * grains.radius_min)
    doubts.push_back({DoubtKind::wide_grain_radii, {grains.radius_max / grains.radius_min}});
  append(doubts, cohesion_doubts(grains));
  append(doubts, step_dependent_rolling(grains));
  return doubts;
}

bool grains_are_coarse(const Scenario& scenario, const std::vector<ModelAnswers>& study) {
  return scenario.soil.granular && are_coarse(count_grains(scenario, study));
}

Doubts coarse_grain_doubts(const Scenario& scenario, const std::vector<ModelAnswers>& study) {
  if (!scenario.soil.granular) return {};
  const GrainCounts counts = count_grains(scenario, study);
  if (!are_coarse(counts)) return {};
  const CoarseGrainsDo most = what_coarse_grains_do(scenario, study);
  const auto if_any = [](const auto& length, double value) { return length ? Said(value) : Said(""); };
  return {
      Doubt{DoubtKind::coarse_grains,
            {most.largest ? in_words(*most.largest) : "", most.beyond, 1000 * counts.diameter, counts.width,
             grains_wanted, if_any(counts.contact, counts.contact.value_or(0)), if_any(counts.contact, grains_wanted),
             if_any(counts.lug, counts.lug.value_or(0)), if_any(counts.lug, grains_wanted_in_a_lug)},
            most.at}};
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

Doubts grain_doubts(const Scenario& scenario, const std::vector<OperatingCondition>& conditions,
                    const std::vector<ModelAnswers>& study) {
  if (!scenario.soil.granular) return {};
  Doubts doubts = grain_value_doubts(*scenario.soil.granular);
  append(doubts, soft_grain_doubts(scenario, conditions, study));
  append(doubts, coarse_grain_doubts(scenario, study));
  return doubts;
}

}  // namespace soilbin::compare
