// pressure_dependent_shear_modulus: K changes with normal stress.
//
// The base model's K is one number; shear tests show it to grow (or fall) with the normal stress. The declared K then
// holds at a reference pressure p_0, and a heavier wheel needs more slip to call up the same share of the strength. At
// full slip nothing changes, at small slip drawbar pull and torque scale with 1/K: a trace in load times slip.
// p_0 is what the declared soil carries at a depth of 15 % of the radius, so that it suits small and large wheels
// alike. At which pressure the shear test found the declared K is seldom told: pivot times p_0.
#include <algorithm>
#include <cmath>

#include "bekker_wong/effects/forms.hpp"

namespace soilbin::bekker_wong {
namespace {

constexpr double reference_depth_over_radius = 0.15;
constexpr double lowest_ratio = 0.02, highest_ratio = 50.0;  // sigma/p_0 is held between them

double reference_pressure(const Surroundings& around) {
  const SoilValues& soil = around.declared;
  return soil.pressure_modulus(around.tire.width) *
         std::pow(reference_depth_over_radius * around.tire.radius, soil.exponent);
}

/// K = K_0 f(sigma/p_0)/f(pivot).
template <double (*Factor)(double amplitude, double pressure_ratio, double strength_ratio)>
class ChangedModulus final : public Effect {
 public:
  explicit ChangedModulus(const std::vector<double>& p) : amplitude_(p[0]), pivot_(p.size() > 1 ? p[1] : 1.0) {}
  void strength(ContactPatch& patch, const SoilValues& soil, const Outline&,
                const Surroundings& around) const override {
    if (amplitude_ == 0.0) return;
    const double p0 = reference_pressure(around), friction = std::tan(soil.friction_angle);
    const double strength_at_p0 = std::max(soil.cohesion + p0 * friction, 1e-9 * p0);
    const double at_pivot = Factor(amplitude_, pivot_, 1.0);
    for (int i = 0; i < patch.count; ++i) {
      const double ratio = std::clamp(patch.sigma[i] / p0, lowest_ratio, highest_ratio);
      patch.modulus[i] *=
          Factor(amplitude_, ratio, (soil.cohesion + ratio * p0 * friction) / strength_at_p0) / at_pivot;
    }
  }

 private:
  double amplitude_, pivot_;
};

double power(double m, double ratio, double) { return std::pow(ratio, m); }
double linear(double a, double ratio, double) { return 1 + a * ratio; }
double stiffness(double a, double, double strength_ratio) { return 1 + a * (strength_ratio - 1); }

EffectParameter pivot(double lower) {
  return {"b", "-", 1.0, lower, 5.0, "pressure over p0 at which K is the declared one", "", 0.7};
}

}  // namespace

std::vector<EffectForm> pressure_dependent_shear_modulus_forms() {
  const std::string id = "pressure_dependent_shear_modulus";
  return {
      {.id = id,
       .form = "power",
       .equation = "K = K0 (sigma/(b p0))^m, p0 = k (0.15 r)^n",
       .source = "after Janbu 1963 (stiffness as a power of stress), applied to Janosi's K",
       .parameters = {{"m", "-", 0.4, -1.0, 1.0, "exponent of the normal stress"}, pivot(0.05)},
       .make = maker<ChangedModulus<power>>()},
      {.id = id,
       .form = "linear",
       .equation = "K = K0 (1 + a sigma/p0)/(1 + a b), p0 = k (0.15 r)^n",
       .source = "stated: K = K_a + B sigma, with K0 its value at p0",
       .parameters = {{"a", "-", 1.0, 0.0, 20.0,
                       "share of K that grows with stress over the share that doesn't, at p0"},
                      pivot(0.0)},
       .make = maker<ChangedModulus<linear>>()},
      {.id = id,
       .form = "constant_stiffness",
       .equation = "K = K0 [1 - a + a tau_max(sigma)/tau_max(p0)], p0 = k (0.15 r)^n",
       .source = "stated: a = 1 keeps the slope tau_max/K of the shear curve at j = 0 the same at every stress",
       .parameters = {{"a", "-", 0.7, 0.0, 1.0, "share of the constant initial stiffness"}},
       .make = maker<ChangedModulus<stiffness>>()},
  };
}

}  // namespace soilbin::bekker_wong
