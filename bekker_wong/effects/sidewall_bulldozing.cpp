// sidewall_bulldozing: at yaw or on a cross slope the wheel's side pushes soil.
//
// At yaw the wheel moves sideways and its wall shoves the soil beside the rut: a side force beyond the tread's shear,
// toward the side to which the wheel points, growing with sinkage. On a cross slope at zero yaw the wheel leans on the
// soil at its lower side, which takes a part of the load's share along the slope: the force points uphill and never
// exceeds that share (amplitude 1). Vertical component and torque: none, as in the sources, except where the wall rubs.
//
// How much of the resistance is called up: 1 - exp(-|q|) with q = j_y/K + D/R, j_y the sideways travel since the entry,
// D the load's share along the slope, R the whole resistance. Ishigami 2007 takes all of it at once.
#include <array>
#include <cmath>
#include <limits>

#include "bekker_wong/earth_pressure.hpp"
#include "bekker_wong/effects/edge.hpp"
#include "bekker_wong/effects/forms.hpp"
#include "bekker_wong/node_functions.hpp"

namespace soilbin::bekker_wong {
namespace {

/// Share of the load along the cross slope, positive where the soil must hold the wheel from the right [N].
double downhill_share(const Surroundings& around) {
  return around.at.load * std::cos(around.at.longitudinal_incline) * std::sin(around.at.transverse_incline);
}

/// Load over the contact's level area [Pa].
double mean_ground_pressure(const Rolling& r) {
  double length = 0.0;
  for (int i = 0; i < r.patch.count; ++i) length += r.patch.arc[i] * r.patch.normal_cosine[i];
  return r.around.normal_load / (r.outline.width * length);
}

/// Resistances by metre of arc.
struct Ishigami {
  explicit Ishigami(const Rolling& r) : soil(hegedus_wall(r.soil)), radius(r.outline.radius) {}
  double operator()(const Edge& e) const { return soil(e.depth) * (1 - e.depth * e.cosine / radius); }
  static constexpr double acts_at = 1.0 / 3;  ///< share of the depth above the rim
  WallResistance soil;
  double radius;
};

struct Wedge {
  explicit Wedge(const Rolling& r) : soil(passive_wall(r.soil)) {}
  double operator()(const Edge& e) const { return soil(e.depth) * e.cosine; }
  static constexpr double acts_at = 1.0 / 3;
  WallResistance soil;
};

/// The mean ground pressure on all of the buried wall.
struct GroundPressure {
  explicit GroundPressure(const Rolling& r) : pressure(mean_ground_pressure(r)) {}
  double operator()(const Edge& e) const { return pressure * e.depth * e.cosine; }
  static constexpr double acts_at = 0.5;
  double pressure;
};

/// j_y, or its limit where the wheel is locked [m].
double sideways_travel(const Rolling& r, std::size_t i) {
  const double j_y = r.patch.j_y[i];
  if (!r.around.motion.locked) return j_y;
  return std::abs(r.around.motion.lateral) > 1e-12 ? std::copysign(std::numeric_limits<double>::infinity(), j_y) : 0.0;
}

/// What soil that presses on the wall with `pressing` [N] at a node does to a wall that slides along it with the
/// coefficient of friction mu; adds to `sum`. acts_at: how far above the rim, as a share of the depth.
void rub(AddedForce& sum, double mu, double pressing, double acts_at, const Edge& e, const Rolling& r) {
  const double arm = r.outline.radius - acts_at * e.depth;
  const double turns = r.around.motion.rim() * arm / r.outline.radius;
  const double back = turns * e.cosine - r.around.motion.forward, down = turns * e.sine;  // of the wall over the soil
  const double speed = std::sqrt(back * back + down * down);
  if (!(speed > 1e-12)) return;
  const double forward = mu * pressing * back / speed, upward = mu * pressing * down / speed;
  sum.forward += forward, sum.vertical += upward, sum.torque += arm * (forward * e.cosine + upward * e.sine);
}

/// Force by metre of arc from `Resistance`, called up node by node; p[1], if there: the wall's coefficient of friction.
template <class Resistance>
class SideWall final : public Effect {
 public:
  explicit SideWall(const std::vector<double>& p) : amplitude_(p[0]), friction_(p.size() > 1 ? p[1] : 0.0) {}
  bool lifts() const override { return amplitude_ != 0.0 && friction_ > 0.0; }
  void added_forces(ForceLedger& ledger, const Rolling& r) const override {
    const double downhill = downhill_share(r.around);
    if (amplitude_ == 0.0 || (r.around.motion.lateral == 0.0 && downhill == 0.0)) return;
    const Resistance resistance(r);
    const Rim rim(r);
    std::array<Edge, ContactPatch::capacity> edges;
    ContactPatch::Array resisting, travel, way, called_up;
    const auto count = static_cast<std::size_t>(r.patch.count);
    double whole = 0.0;
    for (std::size_t i = 0; i < count; ++i) {
      edges[i] = rim.at(static_cast<int>(i));
      whole += resisting[i] = r.patch.arc[i] * resistance(edges[i]);
    }
    if (!(whole > 0.0)) return;
    for (std::size_t i = 0; i < count; ++i) {
      travel[i] = sideways_travel(r, i) + r.patch.modulus[i] * (downhill / whole);  // q K
      way[i] = std::abs(travel[i]);
    }
    mobilised_share({way.data(), count}, r.patch.of(&ContactPatch::modulus), {called_up.data(), count});
    AddedForce sum{.name = "sidewall_bulldozing"};
    for (std::size_t i = 0; i < count; ++i) {
      const double force = amplitude_ * resisting[i] * std::copysign(called_up[i], travel[i]);
      sum.lateral += force;
      if (friction_ > 0.0) rub(sum, friction_, std::abs(force), Resistance::acts_at, edges[i], r);
    }
    ledger.add(sum);
  }

 private:
  double amplitude_, friction_;
};

/// A share of the mean ground pressure on the buried area of the wall, times the sine of the angle at which the tread's
/// motion crosses the wheel's plane.
class SideArea final : public Effect {
 public:
  explicit SideArea(const std::vector<double>& p) : amplitude_(p[0]) {}
  bool lifts() const override { return false; }
  void added_forces(ForceLedger& ledger, const Rolling& r) const override {
    const Kinematics& motion = r.around.motion;
    const double downhill = downhill_share(r.around);
    if (amplitude_ == 0.0 || (motion.lateral == 0.0 && downhill == 0.0)) return;
    const Rim rim(r);
    double area = 0.0;
    for (int i = 0; i < r.patch.count; ++i) {
      const Edge e = rim.at(i);
      area += r.patch.arc[i] * e.cosine * e.depth;
    }
    const double whole = area * mean_ground_pressure(r);
    if (!(whole > 0.0)) return;
    const double sine = motion.lateral == 0.0 ? 0.0 : motion.lateral / std::hypot(motion.rim(), motion.lateral);
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
       .make = maker<SideWall<Ishigami>>()},
      {.id = id,
       .form = "passive_wedge",
       .equation = "F = a Int (gamma h^2 N_phi/2 + 2 c h sqrt(N_phi)) (1 - exp(-|q|)) r cos theta d theta",
       .source = "after Wong, Theory of Ground Vehicles, ch. 2 (Rankine's passive pressure on the wall)",
       .parameters = {{"a", "-", 1.0, 0.0, 20.0, "multiplier of the passive force"}},
       .make = maker<SideWall<Wedge>>()},
      {.id = id,
       .form = "rough_wedge",
       .equation =
           "passive_wedge; the wall rubs on that soil with mu, against its motion in the wheel's plane, a third "
           "of h above the rim",
       .source = "stated: after Wong, Theory of Ground Vehicles, ch. 2, with Coulomb's friction on the wall",
       .parameters = {{"a", "-", 3.0, 0.0, 40.0, "multiplier of the passive force"},
                      {"mu", "-", 0.3, 0.0, 1.0, "friction of the soil on the wall", {}, 0.1}},
       .make = maker<SideWall<Wedge>>()},
      {.id = id,
       .form = "rough_area",
       .equation = "F = a (W/A) Int h (1 - exp(-|q|)) r cos theta d theta; the wall rubs on that soil with mu, against "
                   "its motion in the wheel's plane, half of h above the rim",
       .source = "stated: a share of the mean ground pressure on the buried wall, with Coulomb's friction",
       .parameters = {{"a", "-", 0.5, 0.0, 20.0, "side pressure over mean ground pressure"},
                      {"mu", "-", 0.3, 0.0, 1.0, "friction of the soil on the wall", {}, 0.1}},
       .make = maker<SideWall<GroundPressure>>()},
      {.id = id,
       .form = "side_area",
       .equation = "F = a A_side (W/A) (sin(psi_s) + 1 - exp(-D/R)), tan(psi_s) = v_y/(r w), D = W cos(alpha) "
                   "sin(beta_t), R = A_side W/A",
       .source = "stated: a share of the mean ground pressure on the wall's buried area",
       .parameters = {{"a", "-", 0.5, 0.0, 10.0, "side pressure over mean ground pressure"}},
       .make = maker<SideArea>()},
  };
}

}  // namespace soilbin::bekker_wong
