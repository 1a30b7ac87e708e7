// sidewall_bulldozing: at yaw or on a cross slope the wheel's side pushes soil.
//
// At yaw the wheel moves sideways and its wall shoves the soil beside the rut: a side force beyond the tread's shear,
// toward the side to which the wheel points, growing with sinkage. On a cross slope at zero yaw the wheel leans on the
// soil at its lower side, which takes a part of the load's share along the slope: the force points uphill and never
// exceeds that share (amplitude 1). Vertical component and torque: none, as in the sources.
//
// How much of the resistance is called up: 1 - exp(-|q|) with q = j_y/K + D/R, j_y the sideways travel since the entry,
// D the load's share along the slope, R the whole resistance. Ishigami 2007 takes all of it at once.
#include <algorithm>
#include <cmath>
#include <limits>

#include "bekker_wong/earth_pressure.hpp"
#include "bekker_wong/effects/forms.hpp"

namespace soilbin::bekker_wong {
namespace {

/// Depth of the tread's edge under the surface at node i [m].
double edge_depth(const Rolling& r, int i) {
  return std::max(0.0, r.outline.radius * (std::cos(r.patch.theta[i]) - std::cos(r.patch.angles.entry)));
}

/// Share of the load along the cross slope, positive where the soil must hold the wheel from the right [N].
double downhill_share(const Surroundings& around) {
  return around.at.load * std::cos(around.at.longitudinal_incline) * std::sin(around.at.transverse_incline);
}

double ishigami(const Rolling& r, int i) {
  const double h = edge_depth(r, i);
  return hegedus_force(r.soil, h) * (1 - h * std::cos(r.patch.theta[i]) / r.outline.radius);
}

double wedge(const Rolling& r, int i) { return passive_force(r.soil, edge_depth(r, i)) * std::cos(r.patch.theta[i]); }

/// j_y/K, or its limit where the wheel is locked.
double sideways_travel(const Rolling& r, int i) {
  const double j_y = r.patch.j_y[i];
  if (!r.around.motion.locked) return j_y / r.patch.modulus[i];
  return std::abs(r.around.motion.lateral) > 1e-12 ? std::copysign(std::numeric_limits<double>::infinity(), j_y) : 0.0;
}

/// Force by metre of arc from `Resistance`, called up node by node.
template <double (*Resistance)(const Rolling&, int)>
class Wall final : public Effect {
 public:
  explicit Wall(const std::vector<double>& p) : amplitude_(p[0]) {}
  void added_forces(ForceLedger& ledger, const Rolling& r) const override {
    const double downhill = downhill_share(r.around);
    if (amplitude_ == 0.0 || (r.around.motion.lateral == 0.0 && downhill == 0.0)) return;
    double whole = 0.0;
    for (int i = 0; i < r.patch.count; ++i) whole += r.patch.arc[i] * Resistance(r, i);
    if (!(whole > 0.0)) return;
    double force = 0.0;
    for (int i = 0; i < r.patch.count; ++i) {
      const double q = sideways_travel(r, i) + downhill / whole;
      force += r.patch.arc[i] * Resistance(r, i) * std::copysign(-std::expm1(-std::abs(q)), q);
    }
    ledger.add({.name = "sidewall_bulldozing", .lateral = amplitude_ * force});
  }

 private:
  double amplitude_;
};

/// A share of the mean ground pressure on the buried area of the wall, times the sine of the angle at which the tread's
/// motion crosses the wheel's plane.
class SideArea final : public Effect {
 public:
  explicit SideArea(const std::vector<double>& p) : amplitude_(p[0]) {}
  void added_forces(ForceLedger& ledger, const Rolling& r) const override {
    const Kinematics& motion = r.around.motion;
    const double downhill = downhill_share(r.around);
    if (amplitude_ == 0.0 || (motion.lateral == 0.0 && downhill == 0.0)) return;
    double area = 0.0, length = 0.0;
    for (int i = 0; i < r.patch.count; ++i) {
      area += r.patch.arc[i] * std::cos(r.patch.theta[i]) * edge_depth(r, i);
      length += r.patch.arc[i] * r.patch.normal_cosine[i];
    }
    const double whole = area * r.around.normal_load / (r.outline.width * length);
    if (!(whole > 0.0)) return;
    const double sine = motion.locked ? motion.lateral : motion.lateral / std::hypot(1.0, motion.lateral);
    const double leaning = std::copysign(-std::expm1(-std::abs(downhill) / whole), downhill);
    ledger.add({.name = "sidewall_bulldozing", .lateral = amplitude_ * whole * (sine + leaning)});
  }

 private:
  double amplitude_;
};

}  // namespace

std::vector<EffectForm> sidewall_bulldozing_forms() {
  const std::string id = "sidewall_bulldozing";
  return {
      {.id = id,
       .form = "ishigami",
       .equation = "F = a Int R_b(h) (r - h cos theta) (1 - exp(-|q|)) d theta, h = r (cos theta - cos theta_1), "
                   "R_b: Hegedus",
       .source = "after Ishigami, Miwa, Nagatani, Yoshida 2007, J. Field Robotics 24:233 (there fully called up)",
       .parameters = {{"a", "-", 1.0, 0.0, 10.0, "multiplier of the published side force"}},
       .make = maker<Wall<ishigami>>()},
      {.id = id,
       .form = "passive_wedge",
       .equation = "F = a Int (gamma h^2 N_phi/2 + 2 c h sqrt(N_phi)) (1 - exp(-|q|)) r cos theta d theta",
       .source = "after Wong, Theory of Ground Vehicles, ch. 2 (Rankine's passive pressure on the wall)",
       .parameters = {{"a", "-", 1.0, 0.0, 20.0, "multiplier of the passive force"}},
       .make = maker<Wall<wedge>>()},
      {.id = id,
       .form = "side_area",
       .equation = "F = a A_side (W/A) sin(psi_s), tan(psi_s) = v_y/(r w)",
       .source = "stated: a share of the mean ground pressure on the wall's buried area",
       .parameters = {{"a", "-", 0.5, 0.0, 10.0, "side pressure over mean ground pressure"}},
       .make = maker<SideArea>()},
  };
}

}  // namespace soilbin::bekker_wong
