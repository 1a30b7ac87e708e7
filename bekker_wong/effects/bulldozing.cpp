// bulldozing: a bow wave before the wheel resists.
//
// The soil that the wheel shoves ahead is pushed to passive failure over the depth z of the rut. All forms take force
// from the drawbar pull, none from the torque or the balance of the load: the bow wave presses through the axle. It
// grows with sinkage, so with load; on the base model's flat sinkage it hardly changes with slip, except in the form
// whose wave is carried away under a spinning wheel.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "bekker_wong/earth_pressure.hpp"
#include "bekker_wong/effects/forms.hpp"

namespace soilbin::bekker_wong {
namespace {

double hegedus(const Rolling& r) { return r.outline.width * hegedus_force(r.soil, r.sinkage); }

double rankine(const Rolling& r) { return r.outline.width * passive_force(r.soil, r.sinkage); }

/// A wave that stands only before a wheel that advances: the spinning wheel carries the soil away under itself.
double advancing(const Rolling& r) { return rankine(r) * (1 - std::max(0.0, r.around.motion.slip)); }

/// The bow wave stands across the wheel's plane; at yaw psi the wheel meets it with the share cos(psi) of its travel.
double met(const Rolling& r) { return std::max(0.0, std::cos(r.around.at.yaw)); }

/// Rankine's force at the depth h = r/5, by a power of z/h.
class PowerOfSinkage final : public Effect {
 public:
  explicit PowerOfSinkage(const std::vector<double>& p) : amplitude_(p[0]), power_(p[1]) {}
  bool lifts() const override { return false; }
  void added_forces(ForceLedger& ledger, const Rolling& r) const override {
    if (amplitude_ == 0.0 || !(r.sinkage > 0.0)) return;
    const double depth = r.around.tire.radius / 5;
    const double force = r.outline.width * passive_force(r.soil, depth) * std::pow(r.sinkage / depth, power_);
    ledger.add({.name = "bulldozing", .forward = -amplitude_ * met(r) * force});
  }

 private:
  double amplitude_, power_;
};

/// alpha = acos(1 - 2z/D), by its half angle: not 0 for any z > 0; l_0 = z tan^2(45 deg - phi/2). The last two terms
/// are the wedge's ends, so they are not times b.
double bekker(const Rolling& r) {
  const double z = r.sinkage, phi = r.soil.friction_angle, gamma = specific_weight(r.soil);
  const double alpha = 2 * std::asin(std::sqrt(z / (2 * r.outline.radius))), l0 = z / flow_value(r.soil);
  const BearingFactors k = bearing_factors(phi);
  return r.outline.width * std::sin(alpha + phi) / (2 * std::sin(alpha) * std::cos(phi)) * z *
             (2 * r.soil.cohesion * k.k_c + gamma * z * k.k_gamma) +
         l0 * l0 * l0 * gamma / 3 * (std::numbers::pi / 2 - phi) +
         r.soil.cohesion * l0 * l0 * (1 + std::sqrt(flow_value(r.soil)));
}

template <double (*Resistance)(const Rolling&)>
class BowWave final : public Effect {
 public:
  explicit BowWave(const std::vector<double>& p) : amplitude_(p[0]) {}
  bool lifts() const override { return false; }
  void added_forces(ForceLedger& ledger, const Rolling& r) const override {
    if (amplitude_ == 0.0 || !(r.sinkage > 0.0)) return;
    ledger.add({.name = "bulldozing", .forward = -amplitude_ * met(r) * Resistance(r)});
  }

 private:
  double amplitude_;
};

}  // namespace

std::vector<EffectForm> bulldozing_forms() {
  const std::string id = "bulldozing";
  const std::string meaning = "multiplier of the published resistance";
  return {
      {.id = id,
       .form = "hegedus",
       .equation = "R = a b D1 (c z + D2 gamma z^2/2), D1 = cot X + tan(X + phi), D2 = cot X + cot^2 X tan(phi)",
       .source = "Hegedus 1960, as in Ishigami et al. 2007, J. Field Robotics 24:233; X = 45 deg - phi/2",
       .parameters = {{"a", "-", 1.0, 0.0, 10.0, meaning}},
       .make = maker<BowWave<hegedus>>()},
      {.id = id,
       .form = "bekker",
       .equation = "R = a [b sin(al + phi)/(2 sin(al) cos(phi)) (2 z c K_c + gamma z^2 K_gamma) + "
                   "l0^3 gamma (pi/2 - phi)/3 + c l0^2 (1 + tan(45 + phi/2))], al = acos(1 - z/r)",
       .source = "after Bekker 1969, Introduction to Terrain-Vehicle Systems (general shear failure)",
       .parameters = {{"a", "-", 0.3, 0.0, 5.0, meaning}},
       .make = maker<BowWave<bekker>>()},
      {.id = id,
       .form = "rankine",
       .equation = "R = a b (gamma z^2 N_phi/2 + 2 c z sqrt(N_phi))",
       .source = "after Wong, Theory of Ground Vehicles, ch. 2 (passive wedge over the rut's depth)",
       .parameters = {{"a", "-", 1.0, 0.0, 20.0, meaning}},
       .make = maker<BowWave<rankine>>()},
      {.id = id,
       .form = "advancing",
       .equation = "R = a b (gamma z^2 N_phi/2 + 2 c z sqrt(N_phi)) (1 - max(0, s))",
       .source = "stated: the passive wedge, times the share of the travel that pushes it",
       .parameters = {{"a", "-", 1.0, 0.0, 20.0, meaning}},
       .make = maker<BowWave<advancing>>()},
      {.id = id,
       .form = "power",
       .equation = "R = a b (gamma h^2 N_phi/2 + 2 c h sqrt(N_phi)) (z/h)^e, h = r/5",
       .source = "stated: a passive force's growth with depth, 1 for cohesion, 2 for weight, 3 for a wedge's ends",
       .parameters = {{"a", "-", 1.0, 0.0, 20.0, "multiplier of Rankine's resistance at a depth of r/5"},
                      {.name = "e",
                       .unit = "-",
                       .fallback = 2.0,
                       .lower = 1.0,
                       .upper = 3.0,
                       .meaning = "power of the sinkage",
                       .spread = 0.5}},
       .make = maker<PowerOfSinkage>()},
  };
}

}  // namespace soilbin::bekker_wong
