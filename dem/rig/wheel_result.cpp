#include "dem/rig/wheel_result.hpp"

#include <algorithm>

#include "scenario/estimate.hpp"
#include "scenario/mean_value.hpp"
#include "scenario/tractive_efficiency.hpp"

namespace soilbin::dem {
namespace {

/// What the answer is made of, sample by sample.
struct Channels {
  std::vector<double> pull, lateral, torque, sinkage;
};

Channels channels_of(std::span<const WheelSample> samples, const WheelMotion& motion, ForceFrame frame) {
  return {.pull = series_of(samples, [&](auto& s) { return net_force(s.force, motion, frame).drawbar_pull; }),
          .lateral = series_of(samples, [&](auto& s) { return net_force(s.force, motion, frame).lateral; }),
          .torque = series_of(samples, [&](auto& s) { return -dot(s.moment, motion.axle); }),
          .sinkage = series_of(samples, [](auto& s) { return s.sinkage; })};
}

template <class Read>
double mean_of(std::span<const WheelSample> samples, const Read& read) {
  double sum = 0;
  for (const WheelSample& sample : samples) sum += read(sample);
  return sum / static_cast<double>(samples.size());
}

PowerBalance power_of(std::span<const WheelSample> samples, const WheelMotion& motion, bool ledger) {
  PowerBalance power;
  power.drive = mean_of(samples, [&](auto& s) { return -dot(s.moment, motion.axle) * s.rotation; });
  power.pull = mean_of(samples, [&](auto& s) { return (s.force.x + motion.load.x) * s.speed; });
  power.climb = mean_of(samples, [&](auto& s) { return -motion.load.x * s.speed; });
  power.into_soil = mean_of(samples, [](auto& s) { return s.into_soil; });
  power.heave = mean_of(samples, [&](auto& s) { return s.force.z * s.heave; });
  power.rest = power.drive - power.pull - power.climb - power.heave - power.into_soil;
  const double time = samples.back().time - samples.front().time;
  if (!ledger || time <= 0) return power;
  const EnergyLosses &a = samples.front().ledger, &b = samples.back().ledger;
  power.losses.damping = (b.damping - a.damping) / time;
  power.losses.shear_damping = (b.shear_damping - a.shear_damping) / time;
  power.losses.sliding = (b.sliding - a.sliding) / time;
  power.losses.into_slide = (b.into_slide - a.into_slide) / time;
  power.losses.into_roll = (b.into_roll - a.into_roll) / time;
  return power;
}

/// Parts of the drawbar pull, from the forces at the ends of the samples.
std::vector<Contribution> budget_of(const TreadForces& sum, double count, const WheelMotion& motion, ForceFrame frame) {
  const auto along = [&](const Vec3& force) {
    return frame == ForceFrame::travel ? force.x : dot(force, motion.heading);
  };
  std::vector<Contribution> budget = {
      {"shear_thrust", along(sum.thrust / count * motion.heading)},
      {"compaction_resistance", along(sum.resistance / count * motion.heading)},
  };
  if (frame == ForceFrame::travel && motion.heading.y != 0)
    budget.push_back({"side_force", along(sum.side / count * motion.axle)});
  if (const double slope = along({motion.load.x, motion.load.y, 0}); slope != 0) budget.push_back({"slope", slope});
  return budget;
}

/// The pull is a mean over all steps, its parts are over the samples' ends. The bound comes from the scatter of that
/// difference about its mean, sample by sample, so that it doesn't grow with a part that is wrong.
BudgetRest rest_of(const TractionResult& result, std::span<const WheelSample> samples, const WheelMotion& motion) {
  BudgetRest rest{result.drawbar_pull.value, not_a_number};
  for (const Contribution& part : result.budget) rest.force -= part.force;
  if (samples.size() < 2) return rest;
  const std::vector<double> missed = series_of(samples, [&](const WheelSample& s) {
    const Vec3 at_end = (s.tread.thrust + s.tread.resistance) * motion.heading + s.tread.side * motion.axle;
    return net_force(s.force - at_end, motion, result.at.force_frame).drawbar_pull;
  });
  constexpr double standard_errors = 4;  // they rest on as few as eight blocks: chance passes it once in 190
  rest.bound = standard_errors * mean_with_error(missed).std_error;
  return rest;
}

void tell_stresses(TractionResult& result, std::span<const WheelSample> samples, const WheelMotion& motion,
                   const Tire& tire) {
  TreadForces sum;
  for (const WheelSample& sample : samples) sum += sample.tread;
  const double count = static_cast<double>(samples.size());
  result.patch = tread_stress(sum, count, tire);
  result.budget = budget_of(sum, count, motion, result.at.force_frame);
  result.budget_rest = rest_of(result, samples, motion);
  if (result.patch.empty()) return;
  const auto most = std::max_element(result.patch.begin(), result.patch.end(),
                                     [](const auto& a, const auto& b) { return a.normal < b.normal; });
  result.exit_angle = result.patch.front().theta;
  result.max_stress_angle = most->theta;
  result.entry_angle = result.patch.back().theta;
}

}  // namespace

bool pull_is_known(std::span<const WheelSample> samples, const Tire& tire, const OperatingCondition& at,
                   const Rig& rig) {
  const Channels all = channels_of(samples, wheel_motion(at, tire.radius), at.force_frame);
  const SteadyPart part = steady_part({all.pull, all.torque, all.sinkage});
  if (samples.size() - part.from < 16 || part.drift > most_steady_drift) return false;
  return mean_with_error(std::span(all.pull).subspan(part.from)).std_error <= rig.until_error * at.load;
}

void summarise(WheelRun& run, const Tire& tire, const OperatingCondition& at, const Rig& rig) {
  const WheelMotion motion = wheel_motion(at, tire.radius);
  const Channels all = channels_of(run.samples, motion, at.force_frame);
  const SteadyPart part = steady_part({all.pull, all.torque, all.sinkage});
  run.steady_from = part.from, run.drift = part.drift;
  const std::span<const WheelSample> steady = std::span(run.samples).subspan(run.steady_from);
  const Channels kept = channels_of(steady, motion, at.force_frame);
  run.steady = steady.size() >= 16 && run.drift <= most_steady_drift;

  TractionResult& result = run.result;
  result.at = at;
  result.drawbar_pull = mean_with_error(kept.pull);
  result.torque = mean_with_error(kept.torque);
  result.sinkage = mean_with_error(kept.sinkage);
  result.lateral_force = mean_with_error(kept.lateral);
  const double speed = mean_of(steady, [](auto& s) { return s.speed; });
  const double rotation = mean_of(steady, [](auto& s) { return s.rotation; });
  const double in_plane = at.slip_by == SlipBy::wheel_plane_speed ? speed * motion.heading.x : speed;
  if (rig.drive_torque) result.at.slip = slip_of(in_plane, rotation, tire.radius);
  result.tractive_efficiency = tractive_efficiency(result, tire.radius);
  run.moment = {mean_of(steady, [](auto& s) { return s.moment.x; }),
                mean_of(steady, [](auto& s) { return s.moment.y; }),
                mean_of(steady, [](auto& s) { return s.moment.z; })};
  run.power = power_of(steady, motion, rig.ledger);
  tell_stresses(result, steady, motion, tire);
}

}  // namespace soilbin::dem
