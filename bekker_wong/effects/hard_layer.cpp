// hard_layer: the bin's floor or a firm layer stiffens the soil with depth.
//
// Soil between the wheel and something hard has less room to give way: pressure grows faster than z^n. A heavy wheel,
// which reaches deeper, sinks less than the plain law says; a light one hardly notices.
#include <algorithm>
#include <cmath>

#include "bekker_wong/effects/forms.hpp"

namespace soilbin::bekker_wong {
namespace {

/// f below u_end, continued from there as a line with slope: laws that are singular at u = 1 stay finite and monotone.
double with_tail(double u, double u_end, double (*f)(double), double slope) {
  return u <= u_end ? f(u) : f(u_end) + slope * (u - u_end);
}

double hyperbola(double u) { return 1 / (1 - u); }      // slope 1/(1 - u)^2: 100 at 0.9
double logarithm(double u) { return -std::log1p(-u); }  // slope 1/(1 - u): 20 at 0.95

/// Depth of what is hard [m]: the bin's floor where the bin is known, else the parameter.
double floor_depth(const Surroundings& around, double fallback) {
  return around.bin && around.bin->depth > 0.0 ? around.bin->depth : fallback;
}

/// sigma = k z^n/(1 - a z/z_w).
class Hyperbolic final : public Effect {
 public:
  explicit Hyperbolic(const std::vector<double>& p) : amplitude_(p[0]), depth_(p[1]) {}
  PressureLaw pressure_law() const override { return PressureLaw::by_depth; }
  void pressure(ContactPatch& patch, const SoilValues&, const Outline&, const Surroundings& around) const override {
    const double per_depth = amplitude_ / floor_depth(around, depth_);
    for (int i = 0; i < patch.count; ++i)
      patch.sigma[i] *= with_tail(per_depth * patch.depth[i], 0.9, hyperbola, 100.0);
  }

 private:
  double amplitude_, depth_;
};

/// sigma = k z^n - p_w ln(1 - z/z_w).
class Logarithmic final : public Effect {
 public:
  explicit Logarithmic(const std::vector<double>& p) : pressure_(p[0]), depth_(p[1]) {}
  PressureLaw pressure_law() const override { return PressureLaw::by_depth; }
  void pressure(ContactPatch& patch, const SoilValues&, const Outline&, const Surroundings& around) const override {
    const double z_w = floor_depth(around, depth_);
    for (int i = 0; i < patch.count; ++i)
      patch.sigma[i] += pressure_ * with_tail(patch.depth[i] / z_w, 0.95, logarithm, 20.0);
  }

 private:
  double pressure_, depth_;
};

/// sigma = k z^n (1 + a (z/d - 1)^2) below the depth d of a firm layer; above it nothing.
class Transition final : public Effect {
 public:
  explicit Transition(const std::vector<double>& p) : amplitude_(p[0]), depth_(p[1]) {}
  PressureLaw pressure_law() const override { return PressureLaw::by_depth; }
  void pressure(ContactPatch& patch, const SoilValues&, const Outline&, const Surroundings&) const override {
    for (int i = 0; i < patch.count; ++i) {
      const double beyond = std::max(0.0, patch.depth[i] / depth_ - 1);
      patch.sigma[i] *= 1 + amplitude_ * beyond * beyond;
    }
  }

 private:
  double amplitude_, depth_;
};

}  // namespace

std::vector<EffectForm> hard_layer_forms() {
  const std::string id = "hard_layer";
  const EffectParameter z_w = {.name = "depth",
                               .unit = "m",
                               .fallback = 0.2,
                               .lower = 0.01,
                               .upper = 5.0,
                               .meaning = "z_w, depth of what is hard; the bin's where known",
                               .is_the_bins = true};
  return {
      {.id = id,
       .form = "hyperbolic",
       .equation = "sigma = k z^n/(1 - a z/z_w), a line beyond a z/z_w = 0.9",
       .source = "stated here: stiffness over the soil's free height",
       .parameters = {{"a", "-", 1.0, 0.0, 20.0, "z_w over the depth at which the soil is rigid"}, z_w},
       .make = maker<Hyperbolic>()},
      {.id = id,
       .form = "logarithmic",
       .equation = "sigma = k z^n - p_w ln(1 - z/z_w), a line beyond z/z_w = 0.95",
       .source =
           "after Wong and Preston-Thomas 1983, J. Terramechanics 20(1):1 (snow over an ice layer; there the logarithm "
           "stands alone, here it adds to k z^n)",
       .parameters = {{"p_w", "kPa", 2e4, 0.0, 1e6, "pressure that the layer adds at 63 % of z_w"}, z_w},
       .make = maker<Logarithmic>()},
      {.id = id,
       .form = "transition",
       .equation = "sigma = k z^n [1 + a (z/d - 1)^2] below d",
       .source = "stated here: a firm layer under a soft one",
       .parameters = {{"a", "-", 1.0, 0.0, 50.0, "relative growth of the stiffness at twice the layer's depth"},
                      {"d", "mm", 0.02, 0.001, 1.0, "depth at which the firm layer begins"}},
       .make = maker<Transition>()},
  };
}

}  // namespace soilbin::bekker_wong
