#include "resistive_force/model.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <tuple>
#include <utility>

#include "resistive_force/response.hpp"
#include "scenario/errors.hpp"
#include "scenario/number_check.hpp"
#include "scenario/tractive_efficiency.hpp"
#include "scenario/yawed_frames.hpp"

namespace soilbin::resistive_force {
namespace {

/// What of a tire its elements are made of.
auto outline(const Tire& tire) {
  const Lugs& l = tire.lugs;
  return std::tuple(tire.radius, tire.width, l.height, l.count, l.thickness, l.pattern, l.angle);
}

/// A force along the ground in the axes that the condition asks for, less gravity's part along it.
GroundForce asked(const SoilForces& forces, const OperatingCondition& at) {
  const double a = at.longitudinal_incline, b = at.transverse_incline;
  const GroundForce net{forces.pull - at.load * std::sin(a), forces.left - at.load * std::cos(a) * std::sin(b)};
  return turned(net, at.yaw, ForceFrame::travel, at.force_frame);
}

/// A change of the soil's forces, in the axes that the condition asks for.
GroundForce turned_change(const SoilForces& change, const OperatingCondition& at) {
  return turned({change.pull, change.left}, at.yaw, ForceFrame::travel, at.force_frame);
}

/// What the surface friction changes, over one standard deviation to both sides: it caps the traction of one element
/// after another, so a derivative would know one side alone. A side without a balance is left out.
Balance::Slopes by_friction(const PushedWheel& wheel, const Balance& here, const ResistiveForceSoil& soil) {
  const double friction = soil.surface_friction.value, sd = soil.surface_friction.std_error;
  const auto at = [&](double changed) -> std::optional<std::pair<double, Balance>> {
    try {
      return std::pair{changed, wheel.balance({soil.xi_n.value, changed})};
    } catch (const NoSolution&) {
      return {};
    }
  };
  const auto [low, a] = at(std::max(0.0, friction - sd)).value_or(std::pair{friction, here});
  const auto [high, b] = at(friction + sd).value_or(std::pair{friction, here});
  if (!(high > low)) return {};
  const double per = 1.0 / (high - low);
  return {per * (b.sinkage - a.sinkage),
          {per * (b.forces.pull - a.forces.pull), per * (b.forces.left - a.forces.left),
           per * (b.forces.vertical - a.forces.vertical), per * (b.forces.torque - a.forces.torque)}};
}

void add_errors(TractionResult& result, const PushedWheel& wheel, const Balance& balance,
                const ResistiveForceSoil& soil) {
  const auto add = [&](const Balance::Slopes& slopes, double sd) {
    if (!(sd > 0.0)) return;
    const GroundForce force = turned_change(slopes.forces, result.at);
    for (auto [estimate, slope] :
         {std::pair{&result.drawbar_pull, force.forward}, std::pair{&result.torque, slopes.forces.torque},
          std::pair{&result.sinkage, slopes.sinkage}, std::pair{&result.lateral_force, force.left}})
      estimate->std_error = std::hypot(estimate->std_error, sd * slope);
  };
  add(balance.by_xi_n, soil.xi_n.std_error);
  if (soil.surface_friction.std_error > 0.0) add(by_friction(wheel, balance, soil), soil.surface_friction.std_error);
}

/// Parts of the pull: tread base, lugs, sides, slope.
void add_budget(TractionResult& result, const PushedWheel& wheel, const Balance& balance, const Medium& medium) {
  const OperatingCondition& at = result.at;
  const std::array<SoilForces, 3> parts = wheel.forces_of_parts(medium, balance.sinkage);
  constexpr std::array<const char*, 3> names = {"tread", "lugs", "sides"};
  double scale = at.load;
  for (std::size_t k = 0; k < parts.size(); ++k) {
    const double part = turned_change(parts[k], at).forward;
    if (part == 0.0) continue;
    result.budget.push_back({names[k], part});
    scale += std::abs(part);
  }
  if (const double slope = asked({}, at).forward; slope != 0.0) result.budget.push_back({"slope", slope});
  double rest = result.drawbar_pull.value;
  for (const Contribution& part : result.budget) rest -= part.force;
  result.budget_rest = {rest, 1e-10 * scale};  // sums of some thousand elements in another order
}

void add_stresses(TractionResult& result, const PushedWheel& wheel, const Medium& medium, const Tire& tire) {
  for (const StripStress& s : wheel.strips(medium, result.sinkage.value))
    result.patch.push_back({s.theta, s.normal, s.shear, s.lateral});
  result.entry_angle = std::acos(std::clamp(1 - result.sinkage.value / tire.radius, -1.0, 1.0));
  if (result.patch.empty()) return;
  result.exit_angle = result.patch.front().theta;
  result.max_stress_angle =
      std::ranges::max_element(result.patch, {}, [](const StressSample& s) { return s.normal; })->theta;
}

}  // namespace

ResistiveForceSoil resistive_force_of(const Soil& soil) {
  if (soil.resistive_force) return *soil.resistive_force;
  if (!soil.semi_empirical)
    throw InputError("soil '" + soil.name +
                     "' has no resistive_force values, which rft needs, and no semi_empirical ones to estimate them "
                     "from");
  const SemiEmpiricalSoil& s = *soil.semi_empirical;
  constexpr double share = 0.3, friction_sd = 0.1;
  const double xi_n = estimated_xi_n(bulk_density(s), std::tan(s.friction_angle.value), gravity_of(s));
  return {.xi_n = {xi_n, share * xi_n},
          .surface_friction = {std::tan(2.0 / 3.0 * s.friction_angle.value), friction_sd}};
}

std::shared_ptr<const TreadElements> ResistiveForce::elements_of(const Tire& tire) const {
  if (drawn_) return drawn_;
  const std::lock_guard lock(mutex_);
  if (!elements_ || outline(last_) != outline(tire)) {
    elements_ = std::make_shared<const TreadElements>(tread_elements(tire));
    last_ = tire;
  }
  return elements_;
}

TractionResult ResistiveForce::evaluate(const Scenario& scenario, const OperatingCondition& at) const {
  check_numbers(at);
  const ResistiveForceSoil soil = resistive_force_of(scenario.soil);
  if (!(soil.xi_n.value > 0.0))
    throw InputError("soil '" + scenario.soil.name + "' has no friction: rft is for soils that have nothing else");
  const Medium medium{soil.xi_n.value, soil.surface_friction.value};
  const PushedWheel wheel(*elements_of(scenario.tire), scenario.tire, at);
  const Balance balance = wheel.balance(medium);

  TractionResult result;
  result.at = at;
  const GroundForce force = asked(balance.forces, at);
  result.drawbar_pull.value = force.forward;
  result.lateral_force.value = force.left;
  result.torque.value = balance.forces.torque;
  result.sinkage.value = balance.sinkage;
  add_errors(result, wheel, balance, soil);
  constexpr double rounding = 1e-12;  // of the load: what triangles that are no mirror images leave of a balance
  if (std::abs(force.left) < rounding * at.load && result.lateral_force.std_error < rounding * at.load)
    result.lateral_force = {};
  result.tractive_efficiency = tractive_efficiency(result, scenario.tire.radius);
  add_budget(result, wheel, balance, medium);
  add_stresses(result, wheel, medium, scenario.tire);
  return result;
}

}  // namespace soilbin::resistive_force
