// interface_limit: the wheel's surface slides on the soil before the soil itself shears.
//
// A smooth or wet wheel grips the soil less than the soil grips itself. With the amplitude a the interface offers
// c_a = (1 - a) c and tan(delta) = (1 - a) tan(phi); a = 0 is a wheel as rough as the soil. Less shear carries less of
// the load too, so the wheel sinks a little deeper. The forms differ in slip: the cap bites only where much strength is
// called up, the series gradually, the reduced strength everywhere.
#include <algorithm>
#include <cmath>

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

/// A wall that takes adhesion and friction apart, t = (1 - q a) c + (1 - a) sigma tan(phi), and that is reached with
/// the power h: 1/m^h = 1/m_soil^h + 1/t^h - 1 in shares of the soil's strength. q = 1: h = 1 is the series, large h
/// the cap.
class Wall final : public Effect {
 public:
  explicit Wall(const std::vector<double>& p)
      : friction_(1 - p[0]), adhesion_(std::max(0.0, 1 - p[0] * p[1])), power_(p[2]) {}
  void mobilise(ContactPatch& patch, std::span<const double>, const SoilValues& soil,
                const Surroundings&) const override {
    if (friction_ == 1.0) return;
    const double slope = std::tan(soil.friction_angle);
    for (int i = 0; i < patch.count; ++i) {
      const double soils = patch.strength[i], m = patch.mobilised[i];
      if (!(soils > 0.0) || !(m > 0.0)) continue;
      const double walls = adhesion_ * soil.cohesion + friction_ * std::max(0.0, patch.sigma[i]) * slope;
      const double share = std::max(walls / soils, smallest_share);
      patch.mobilised[i] = m / std::pow(1 + std::pow(m / share, power_) - std::pow(m, power_), 1 / power_);
    }
  }

 private:
  static constexpr double smallest_share = 1e-3;
  double friction_, adhesion_, power_;
};

/// A film that shears at a stress of its own whatever presses on it, in series with the soil.
class Film final : public Effect {
 public:
  explicit Film(const std::vector<double>& p) : compliance_(p[0]) {}
  void mobilise(ContactPatch& patch, std::span<const double>, const SoilValues&, const Surroundings&) const override {
    for (int i = 0; i < patch.count; ++i)
      patch.mobilised[i] /= 1 + compliance_ * patch.mobilised[i] * patch.strength[i];
  }

 private:
  double compliance_;
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
      {.id = id,
       .form = "wall",
       .equation = "1/tau^h = 1/tau_soil^h + 1/t^h - 1/t_soil^h, t = c_a + sigma tan(delta), "
                   "t_soil = c + sigma tan(phi), tan(delta) = (1 - a) tan(phi), c_a = (1 - q a) c",
       .source = "after Potyondy 1961, Geotechnique 11(4):339 (adhesion and wall friction fall apart); h stated",
       .parameters = {{"a", "-", 0.3, 0.0, 0.95, "1 - tan(delta)/tan(phi): friction that the wall lacks"},
                      {.name = "q",
                       .unit = "-",
                       .fallback = 1.5,
                       .lower = 0.0,
                       .upper = 10.0,
                       .meaning = "adhesion that the wall lacks, over the friction that it lacks",
                       .spread = 1.0},
                      {.name = "h",
                       .unit = "-",
                       .fallback = 3.0,
                       .lower = 1.0,
                       .upper = 12.0,
                       .meaning = "how late and sharply the limit is reached",
                       .spread = 2.0}},
       .make = maker<Wall>()},
      {.id = id,
       .form = "film",
       .equation = "1/tau = 1/tau_soil + a",
       .source = "stated: a wet or tacky surface that shears at 1/a whatever presses on it",
       .parameters = {{"a", "1/kPa", 5e-5, 0.0, 5e-3, "the reciprocal of the film's shear strength"}},
       .make = maker<Film>()},
  };
}

}  // namespace soilbin::bekker_wong
