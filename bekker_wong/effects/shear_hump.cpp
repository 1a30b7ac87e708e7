// shear_hump: shear stress peaks, then falls to a residual.
//
// Dense sand, bonded snow and turf break: beyond a displacement the strength falls. The part of the contact that has
// slid far loses grip, so drawbar pull and torque bend down at high slip where the base model's level off. Under a
// heavy wheel sand sticks to the tread behind the largest pressure and is carried along: the rear of the contact loses
// grip at little slip. Every form is Janosi's share 1 - exp(-x) times a factor that is 1 at amplitude 0; x = j/K.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "bekker_wong/effects/forms.hpp"

namespace soilbin::bekker_wong {
namespace {

/// (1 - exp(-y))/(1 - exp(-x)) at y = x/ratio, with its limit 1/ratio at x = 0.
double janosi_ratio(double x, double ratio) { return x > 0.0 ? std::expm1(-x / ratio) / std::expm1(-x) : 1 / ratio; }

/// Wong and Preston-Thomas: K_r {1 + [1/(K_r (1 - 1/e)) - 1] exp(1 - y)} (1 - exp(-y)), y = j/K_w; 1 at y = 1.
class WongHump final : public Effect {
 public:
  explicit WongHump(const std::vector<double>& p) : share_(p[0]), residual_(p[1]), ratio_(p[2]) {}
  void mobilise(ContactPatch& patch, std::span<const double> j, const SoilValues&,
                const Surroundings& around) const override {
    const double peak = 1 / (residual_ * (1 - 1 / std::numbers::e)) - 1;
    for (std::size_t i = 0; i < j.size(); ++i) {
      const double x = j[i] / patch.modulus[i], y = x / ratio_;
      const double factor =
          around.motion.locked ? residual_ : residual_ * (1 + peak * std::exp(1 - y)) * janosi_ratio(x, ratio_);
      patch.mobilised[i] *= 1 + share_ * (factor - 1);
    }
  }

 private:
  double share_, residual_, ratio_;
};

/// Janosi's rise, then an exponential loss of the share a over the displacement lambda K.
class Softening final : public Effect {
 public:
  explicit Softening(const std::vector<double>& p) : loss_(p[0]), ratio_(p[1]) {}
  void mobilise(ContactPatch& patch, std::span<const double> j, const SoilValues&,
                const Surroundings& around) const override {
    for (std::size_t i = 0; i < j.size(); ++i) {
      const double gone = around.motion.locked ? 1.0 : -std::expm1(-j[i] / (ratio_ * patch.modulus[i]));
      patch.mobilised[i] *= 1 - loss_ * gone;
    }
  }

 private:
  double loss_, ratio_;
};

/// (j/K_w) exp(1 - j/K_w), K_w = kappa K: no residual at all.
class Decay final : public Effect {
 public:
  explicit Decay(const std::vector<double>& p) : share_(p[0]), ratio_(p[1]) {}
  void mobilise(ContactPatch& patch, std::span<const double> j, const SoilValues&,
                const Surroundings& around) const override {
    for (std::size_t i = 0; i < j.size(); ++i) {
      const double x = j[i] / patch.modulus[i], y = x / ratio_;
      const double y_over_janosi = x > 0.0 ? y / -std::expm1(-x) : 1 / ratio_;
      const double factor = around.motion.locked ? 0.0 : y_over_janosi * std::exp(1 - y);
      patch.mobilised[i] *= 1 + share_ * (factor - 1);
    }
  }

 private:
  double share_, ratio_;
};

/// Soil that the tread carries along behind theta_m. A braked or locked wheel loses as much as one at no slip.
class Carried final : public Effect {
 public:
  explicit Carried(const std::vector<double>& p) : amplitude_(p[0]) {}
  void mobilise(ContactPatch& patch, std::span<const double> j, const SoilValues&,
                const Surroundings& around) const override {
    const double travel = std::min(1.0, 1 - around.motion.slip);
    const double left = std::max(0.0, 1 - amplitude_ * travel * travel * std::sin(patch.angles.entry));
    for (std::size_t i = 0; i < j.size(); ++i)
      if (patch.theta[i] < patch.angles.max_stress) patch.mobilised[i] *= left;
  }

 private:
  double amplitude_;
};

}  // namespace

std::vector<EffectForm> shear_hump_forms() {
  const std::string id = "shear_hump";
  return {
      {.id = id,
       .form = "wong",
       .equation =
           "m = (1 - a) (1 - exp(-j/K)) + a K_r {1 + [1/(K_r (1 - 1/e)) - 1] exp(1 - j/K_w)} (1 - exp(-j/K_w)), "
           "K_w = kappa K",
       .source = "after Wong and Preston-Thomas 1983, J. Terramechanics 19(4):225 (a = 1)",
       .parameters = {{"a", "-", 1.0, 0.0, 1.2, "share of the hump; 1 gives the published curve"},
                      {"K_r", "-", 0.6, 0.1, 0.95, "residual over peak shear stress"},
                      {"kappa", "-", 3.0, 0.2, 10.0, "displacement at the peak over Janosi's K"}},
       .make = maker<WongHump>()},
      {.id = id,
       .form = "softening",
       .equation = "m = (1 - exp(-j/K)) [1 - a (1 - exp(-j/(lambda K)))]",
       .source = "stated: Janosi's rise with an exponential fall to the residual 1 - a",
       .parameters = {{"a", "-", 0.4, 0.0, 0.95, "share of the strength lost at large displacement"},
                      {"lambda", "-", 3.0, 0.5, 20.0, "displacement over which it is lost, over Janosi's K"}},
       .make = maker<Softening>()},
      {.id = id,
       .form = "decay",
       .equation = "m = (1 - a) (1 - exp(-j/K)) + a (j/K_w) exp(1 - j/K_w), K_w = kappa K",
       .source = "after Wong, Theory of Ground Vehicles, ch. 2 (terrain that breaks without a residual; a = 1)",
       .parameters = {{"a", "-", 0.5, 0.0, 1.0, "share of the curve without residual"},
                      {"kappa", "-", 3.0, 0.2, 10.0, "displacement at the peak over Janosi's K"}},
       .make = maker<Decay>()},
      {.id = id,
       .form = "carried",
       .equation = "m = (1 - exp(-j/K)) max(0, 1 - a (1 - s)^2 sin(theta_1)) where theta < theta_m, s held above 0",
       .source = "stated: from the stresses of grains under heavy tires (docs/lab/calibration.md)",
       .parameters = {{"a", "-", 3.0, 0.0, 6.0, "share of the shear that soil carried along loses, over sin(theta_1)"}},
       .make = maker<Carried>()},
  };
}

}  // namespace soilbin::bekker_wong
