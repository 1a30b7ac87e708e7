// interface_limit: the wheel's surface slides on the soil before the soil itself shears.
//
// A smooth or wet wheel grips the soil less than the soil grips itself. With the amplitude a the interface offers
// c_a = (1 - a) c and tan(delta) = (1 - a) tan(phi); a = 0 is a wheel as rough as the soil. Less shear carries less of
// the load too, so the wheel sinks a little deeper. The forms differ in slip: the cap bites only where much strength is
// called up, the series gradually, the reduced strength everywhere.
#include <algorithm>

#include "bekker_wong/effects/forms.hpp"

namespace soilbin::bekker_wong {
namespace {

/// tau <= c_a + sigma tan(delta), a cap on what is mobilised.
class Cap final : public Effect {
 public:
  explicit Cap(const std::vector<double>& p) : kept_(1 - p[0]) {}
  void mobilise(ContactPatch& patch, std::span<const double>, const SoilValues&, const Surroundings&) const override {
    if (kept_ == 1.0) return;  // no limit, whatever calls up more than Janosi's share
    for (double& m : patch.of(&ContactPatch::mobilised)) m = std::min(m, kept_);
  }

 private:
  double kept_;
};

/// The interface shears by Janosi's law with its own strength.
class ReducedStrength final : public Effect {
 public:
  explicit ReducedStrength(const std::vector<double>& p) : kept_(1 - p[0]) {}
  void strength(ContactPatch& patch, const SoilValues&, const Outline&, const Surroundings&) const override {
    for (double& strength : patch.of(&ContactPatch::strength)) strength *= kept_;
  }

 private:
  double kept_;
};

/// Soil and interface in series, each giving way as it is loaded: m/(1 + a m/(1 - a)) runs from m to 1 - a.
class Series final : public Effect {
 public:
  explicit Series(const std::vector<double>& p) : weakness_(p[0] / (1 - p[0])) {}
  void mobilise(ContactPatch& patch, std::span<const double>, const SoilValues&, const Surroundings&) const override {
    for (double& m : patch.of(&ContactPatch::mobilised)) m /= 1 + weakness_ * m;
  }

 private:
  double weakness_;
};

}  // namespace

std::vector<EffectForm> interface_limit_forms() {
  const std::string id = "interface_limit";
  const std::string meaning = "1 - tan(delta)/tan(phi) = 1 - c_a/c: strength that the interface lacks";
  return {
      {.id = id,
       .form = "cap",
       .equation = "tau <= c_a + sigma tan(delta), c_a = (1 - a) c, tan(delta) = (1 - a) tan(phi)",
       .source = "after Wong and Reece 1967, J. Terramechanics 4(1):81 (soil-wheel friction below the soil's own)",
       .parameters = {{"a", "-", 0.3, 0.0, 0.95, meaning}},
       .make = maker<Cap>()},
      {.id = id,
       .form = "reduced_strength",
       .equation = "tau = (c_a + sigma tan(delta)) (1 - exp(-j/K))",
       .source = "after Wong, Theory of Ground Vehicles, ch. 2 (rubber-soil shear: adhesion and interface friction)",
       .parameters = {{"a", "-", 0.3, 0.0, 0.95, meaning}},
       .make = maker<ReducedStrength>()},
      {.id = id,
       .form = "series",
       .equation = "1/tau = 1/tau_soil + a/((1 - a)(c + sigma tan(phi)))",
       .source = "stated: a gradual cap with the same limit",
       .parameters = {{"a", "-", 0.3, 0.0, 0.95, meaning}},
       .make = maker<Series>()},
  };
}

}  // namespace soilbin::bekker_wong
