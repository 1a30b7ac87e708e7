// slope_weakening: soil on a slope is weaker, part of its strength already holds it up.
//
// The slope's share of the load is in the base model. Measured traction falls further: a wheel with 20 deg of traction
// on the flat needs far more slip than that on a 20 deg slope (NASA). i is the ground's steepest angle,
// cos(i) = cos(alpha) cos(beta_t).
#include <algorithm>
#include <cmath>

#include "bekker_wong/effects/forms.hpp"
#include "bekker_wong/effects/scaled_soil.hpp"

namespace soilbin::bekker_wong {
namespace {

/// tan^2 i = 1/(cos^2 alpha cos^2 beta) - 1 = tan^2 alpha + tan^2 beta/cos^2 alpha: exactly 0 on level ground.
double steepest_tangent(const OperatingCondition& at) {
  return std::hypot(std::tan(at.longitudinal_incline),
                    std::tan(at.transverse_incline) / std::cos(at.longitudinal_incline));
}

double steepest_sine(const OperatingCondition& at) {
  const double t = steepest_tangent(at);
  return t / std::sqrt(1 + t * t);
}

/// tan(phi) - a tan(i).
class Friction final : public Effect {
 public:
  explicit Friction(const std::vector<double>& p) : amplitude_(p[0]) {}
  void soil(SoilValues& soil, const Surroundings& around) const override {
    const double lost = amplitude_ * steepest_tangent(around.at), friction = std::tan(soil.friction_angle);
    if (lost == 0.0 || friction == 0.0) return;
    scale_friction(soil, at_least_share(1 - lost / friction));
  }

 private:
  double amplitude_;
};

/// c and tan(phi) times 1 - a sin(i).
class Strength final : public Effect {
 public:
  explicit Strength(const std::vector<double>& p) : amplitude_(p[0]) {}
  void soil(SoilValues& soil, const Surroundings& around) const override {
    scale_strength(soil, at_least_share(1 - amplitude_ * steepest_sine(around.at)));
  }

 private:
  double amplitude_;
};

/// Strength less a sigma times the slope in the direction in which the wheel pushes the soil: weaker where it pushes
/// downhill, stronger uphill.
class Directional final : public Effect {
 public:
  explicit Directional(const std::vector<double>& p) : amplitude_(p[0]) {}
  void strength(ContactPatch& patch, const SoilValues&, const Outline&, const Surroundings& around) const override {
    const OperatingCondition& at = around.at;
    // the slope's shear over its pressure, by the load's direction; its length is tan(i)
    const double along = amplitude_ * std::tan(at.longitudinal_incline) / std::cos(at.transverse_incline);
    const double across = amplitude_ * std::tan(at.transverse_incline);
    if (along == 0.0 && across == 0.0) return;
    // uphill (along travel, and to its left) in the wheel's axes
    const double c = std::cos(at.yaw), s = std::sin(at.yaw);
    const double forward = along * c + across * s, left = across * c - along * s;
    for (int i = 0; i < patch.count; ++i) {
      const double j = std::hypot(patch.j_x[i], patch.j_y[i]);
      if (j == 0.0) continue;
      const double taken = patch.sigma[i] * (forward * patch.j_x[i] + left * patch.j_y[i]) / j;
      patch.strength[i] = std::max(patch.strength[i] - taken, least_share * patch.strength[i]);
    }
  }

 private:
  double amplitude_;
};

/// k times 1 - a sin(i).
class Bearing final : public Effect {
 public:
  explicit Bearing(const std::vector<double>& p) : amplitude_(p[0]) {}
  void soil(SoilValues& soil, const Surroundings& around) const override {
    scale_stiffness(soil, at_least_share(1 - amplitude_ * steepest_sine(around.at)));
  }

 private:
  double amplitude_;
};

}  // namespace

std::vector<EffectForm> slope_weakening_forms() {
  const std::string id = "slope_weakening";
  return {
      {.id = id,
       .form = "friction",
       .equation = "tan(phi) - a tan(i), cos(i) = cos(alpha) cos(beta_t)",
       .source = "stated here: a = 1 gives an infinite slope's reserve of friction",
       .parameters = {{"a", "-", 0.5, 0.0, 2.0, "share of the slope's own shear taken from the friction"}},
       .make = maker<Friction>()},
      {.id = id,
       .form = "strength",
       .equation = "c and tan(phi) times 1 - a sin(i)",
       .source = "stated here: the whole strength falls with the steepest angle",
       .parameters = {{"a", "-", 0.5, 0.0, 3.0, "relative loss of strength over sin(i)"}},
       .make = maker<Strength>()},
      {.id = id,
       .form = "directional",
       .equation = "strength - a sigma (tan(alpha)/cos(beta_t), tan(beta_t)).(j/|j|): weaker where the wheel pushes "
                   "soil downhill",
       .source = "stated here: the slope's shear adds to the wheel's as a vector",
       .parameters = {{"a", "-", 0.5, 0.0, 1.5, "share of the slope's shear that adds to the wheel's"}},
       .make = maker<Directional>()},
      {.id = id,
       .form = "bearing",
       .equation = "k times 1 - a sin(i)",
       .source = "stated here: a line; Meyerhof 1957, Proc. 4th ICSMFE 1:384, has charts of a foundation's bearing "
                 "capacity on slopes",
       .parameters = {{"a", "-", 0.5, 0.0, 3.0, "relative loss of stiffness over sin(i)"}},
       .make = maker<Bearing>()},
  };
}

}  // namespace soilbin::bekker_wong
