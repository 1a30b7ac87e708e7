#include "bekker_wong/model.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "bekker_wong/standard_errors.hpp"
#include "scenario/errors.hpp"
#include "scenario/number_check.hpp"
#include "scenario/soil_parameters.hpp"
#include "scenario/traction_channels.hpp"
#include "scenario/tractive_efficiency.hpp"

namespace soilbin::bekker_wong {

SoilValues values_of(const SemiEmpiricalSoil& soil) {
  SoilValues values{.density = bulk_density(soil),
                    .gravity = gravity_of(soil),
                    .reference_sinkage = soil.reference_sinkage.value_or(1.0)};
  for (std::size_t i = 0; i < soil_parameters.size(); ++i)
    values.*soil_members[i] = (soil.*soil_parameters[i].value).value;
  return values;
}

namespace {

/// Force (forward, lateral) in the wheel's axes -> its part of the drawbar pull in the axes asked for.
double along_travel(double forward, double lateral, const OperatingCondition& at) {
  if (at.force_frame == ForceFrame::wheel) return forward;
  return forward * std::cos(at.yaw) - lateral * std::sin(at.yaw);
}

std::vector<Contribution> budget_of(const RolledWheel& wheel) {
  const OperatingCondition& at = wheel.at;
  std::vector<Contribution> budget = {
      {"shear_thrust", along_travel(wheel.forces.thrust, 0.0, at)},
      {"compaction_resistance", along_travel(wheel.forces.compaction, 0.0, at)},
  };
  if (wheel.forces.side != 0.0 && at.force_frame == ForceFrame::travel)
    budget.push_back({"side_force", along_travel(0.0, wheel.forces.side, at)});
  for (const AddedForce& added : wheel.forces.added.rows())
    budget.push_back({std::string(added.name), along_travel(added.forward, added.lateral, at)});
  double slope = -at.load * std::sin(at.longitudinal_incline);
  if (at.force_frame == ForceFrame::wheel)
    slope = slope * std::cos(at.yaw) -
            at.load * std::cos(at.longitudinal_incline) * std::sin(at.transverse_incline) * std::sin(at.yaw);
  if (slope != 0.0) budget.push_back({"slope", slope});
  if (const double shown = wheel.reading.drawbar_pull - wheel.unmeasured.drawbar_pull; shown != 0.0)
    budget.push_back({"measurement", shown});
  return budget;
}

/// The parts and the pull are sums of the same forces in another order: what is left is rounding.
BudgetRest rest_of(const std::vector<Contribution>& budget, const RolledWheel& wheel) {
  const WheelForces& f = wheel.forces;
  double rest = wheel.reading.drawbar_pull, scale = std::abs(f.thrust) + std::abs(f.compaction) + std::abs(f.side);
  for (const Contribution& part : budget) rest -= part.force, scale += std::abs(part.force);
  for (const AddedForce& added : f.added.rows()) scale += std::abs(added.forward) + std::abs(added.lateral);
  return {rest, 16 * std::numeric_limits<double>::epsilon() * (scale + wheel.at.load)};
}

std::vector<StressSample> stresses_of(const ContactPatch& patch) {
  std::vector<StressSample> samples;
  samples.reserve(static_cast<std::size_t>(patch.count));
  for (int i = 0; i < patch.count; ++i)
    samples.push_back({patch.theta[i], patch.sigma[i], patch.tau_x[i], patch.tau_y[i]});
  std::sort(samples.begin(), samples.end(), [](const auto& a, const auto& b) { return a.theta < b.theta; });
  return samples;
}

}  // namespace

TractionResult traction_result(const RolledWheel& wheel, const Tire& tire, bool with_patch) {
  TractionResult result;
  result.at = wheel.at;
  for (std::size_t i = 0; i < traction_channels.size(); ++i)
    (result.*traction_channels[i].predicted).value = wheel.reading.*reading_members[i];
  result.tractive_efficiency = tractive_efficiency(result, tire.radius);
  result.entry_angle = wheel.patch.angles.entry;
  result.max_stress_angle = wheel.patch.angles.max_stress;
  result.exit_angle = wheel.patch.angles.exit;
  result.contact_area = 0.0;
  for (int i = 0; i < wheel.patch.count; ++i)
    result.contact_area += tire.width * wheel.patch.arc[i] * wheel.patch.normal_cosine[i];
  result.budget = budget_of(wheel);
  result.budget_rest = rest_of(result.budget, wheel);
  if (with_patch) result.patch = stresses_of(wheel.patch);
  return result;
}

TractionResult BekkerWong::evaluate(const Scenario& scenario, const OperatingCondition& at) const {
  if (!scenario.soil.semi_empirical)
    throw InputError("soil '" + scenario.soil.name + "' has no semi_empirical values, which bekker_wong needs");
  check_numbers(at);
  const EffectList effects = make_effects(scenario.effects);
  const RollingWheel wheel(scenario.tire, values_of(*scenario.soil.semi_empirical), effects, scenario.bin);
  const RolledWheel balanced = wheel.roll(at);
  TractionResult result = traction_result(balanced, scenario.tire, detail_.patch);
  if (detail_.errors) add_standard_errors(result, balanced, scenario, effects);
  return result;
}

}  // namespace soilbin::bekker_wong
