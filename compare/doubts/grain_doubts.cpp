#include "compare/doubts/grain_doubts.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <numbers>

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
  if (largest)
    return fmt::format(": they are estimated to change {} against infinitely fine ones ({})", in_words(*largest),
                       in_words(where));
  return beyond.empty() ? "" : fmt::format(": by how much that changes the answer is not known, since {}", beyond);
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
      "the grains' rolling law '{}' makes answers depend on the time step: below the angular speed mu_r R* F_N dt/I* a "
      "contact is a dashpot of I*/dt, whatever mu_r. At the longest step, {:.3g} ms, two mean grains that 100 N press "
      "together are so below {:.2g} rad/s. At a quarter of the step a tire of 0.5 m radius at 4 kN, 20 % slip pulled "
      "1183 ± 43 N in place of 773 ± 19 N. rolling_resistance: elastic_plastic does not depend on it",
      with_twist ? "directional_with_twist" : "directional", 1e3 * step, speed);
  if (with_twist) text += ". This law also resists spin about the contact's normal, which the published one does not";
  return text;
}

}  // namespace

bool grains_are_coarse(const Scenario& scenario, const std::vector<ModelAnswers>& study) {
  return scenario.soil.granular && are_coarse(count_grains(scenario, study));
}

std::string coarse_grain_doubt(const Scenario& scenario, const std::vector<ModelAnswers>& study) {
  if (!scenario.soil.granular) return "";
  const GrainCounts counts = count_grains(scenario, study);
  if (!are_coarse(counts)) return "";
  std::string lengths = fmt::format("{:.2g} lie across it ({} wanted)", counts.width, grains_wanted);
  if (counts.contact) lengths += fmt::format(", {:.2g} along its contact ({})", *counts.contact, grains_wanted);
  if (counts.lug) lengths += fmt::format(", {:.2g} in a lug's height ({})", *counts.lug, grains_wanted_in_a_lug);
  return fmt::format(
      "the grains are coarse for this wheel{}. Of their mean diameter, {:.3g} mm, {}: see "
      "docs/lab/grain-size.md",
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

std::vector<std::string> grain_doubts(const Scenario& scenario, const std::vector<ModelAnswers>& study) {
  std::vector<std::string> doubts;
  if (!scenario.soil.granular) return doubts;
  for (const std::string& doubt : {coarse_grain_doubt(scenario, study), depends_on_the_step(*scenario.soil.granular)})
    if (!doubt.empty()) doubts.push_back(doubt);
  return doubts;
}

}  // namespace soilbin::compare
