// moisture: strength changes with water content.
//
// Water binds grains by suction until it fills the pores; past that it lubricates. Around a campaign's mean w_ref the
// change may have either sign, so amplitudes are signed. d = (w - w_ref) in percentage points, water content by mass.
// Where a run has no moisture the effect does nothing.
#include <algorithm>

#include "bekker_wong/effects/forms.hpp"
#include "bekker_wong/effects/scaled_soil.hpp"

namespace soilbin::bekker_wong {
namespace {

constexpr double point = 0.01;  // a percentage point of water content

/// What a change of water content does to a soil; d in percentage points.
using Change = void (*)(SoilValues&, double amplitude, double d);

template <Change change>
class Wetted final : public Effect {
 public:
  explicit Wetted(const std::vector<double>& p) : amplitude_(p[0]), reference_(p[1]) {}
  void soil(SoilValues& soil, const Surroundings& around) const override {
    if (around.at.moisture) change(soil, amplitude_, (*around.at.moisture - reference_) / point);
  }

 private:
  double amplitude_, reference_;
};

void add_cohesion(SoilValues& soil, double a, double d) { soil.cohesion = std::max(0.0, soil.cohesion + a * d); }
void grow_cohesion(SoilValues& soil, double a, double d) { soil.cohesion *= bounded_exp(a * d); }
void change_friction(SoilValues& soil, double a, double d) { scale_friction(soil, at_least_share(1 + a * d)); }
void grow_stiffness(SoilValues& soil, double a, double d) { scale_stiffness(soil, bounded_exp(a * d)); }
void grow_all(SoilValues& soil, double a, double d) {
  scale_stiffness(soil, bounded_exp(a * d));
  scale_strength(soil, bounded_exp(a * d));
}

void fall_from_optimum(SoilValues& soil, double a, double d) {
  const double left = bounded_exp(-a * d * d);
  scale_stiffness(soil, left);
  soil.cohesion *= left;
}

/// c = c_0 + a [q(w) - q(w_ref)], q = 1 - ((w - w_p)/w_p)^2: suction's cohesion is 0 when dry, 1 at w_p, 0 at 2 w_p.
class Capillary final : public Effect {
 public:
  explicit Capillary(const std::vector<double>& p) : amplitude_(p[0]), reference_(p[1]), peak_(p[2]) {}
  void soil(SoilValues& soil, const Surroundings& around) const override {
    if (!around.at.moisture) return;
    const double here = *around.at.moisture / peak_ - 1, there = reference_ / peak_ - 1;
    soil.cohesion = std::max(0.0, soil.cohesion + amplitude_ * (there * there - here * here));
  }

 private:
  double amplitude_, reference_, peak_;
};

}  // namespace

std::vector<EffectForm> moisture_forms() {
  const std::string id = "moisture";
  const EffectParameter reference = {"w_ref", "%", 0.08, 0.0, 1.0, "water content of the declared soil", "moisture"};
  return {
      {.id = id,
       .form = "cohesion",
       .equation = "c = c_0 + a d, not below 0",
       .source = "stated here: the line through suction's cohesion about the campaign's mean",
       .parameters = {{"a", "kPa", 100.0, -2e4, 2e4, "cohesion gained a percentage point of water"}, reference},
       .make = maker<Wetted<add_cohesion>>()},
      {.id = id,
       .form = "cohesion_exponential",
       .equation = "c = c_0 exp(a d)",
       .source = "stated here: cohesion of a wetting loam falls by equal shares",
       .parameters = {{"a", "-", -0.1, -2.0, 2.0, "logarithmic growth of the cohesion a percentage point"}, reference},
       .make = maker<Wetted<grow_cohesion>>()},
      {.id = id,
       .form = "capillary",
       .equation = "c = c_0 + a [q(w) - q(w_ref)], q = 1 - ((w - w_p)/w_p)^2, not below 0",
       .source = "stated here: cohesion by suction rises to a peak, then falls",
       .parameters = {{"a", "kPa", 500.0, -1e5, 1e5, "cohesion by suction at its peak"},
                      reference,
                      {"w_p", "%", 0.12, 0.01, 0.6, "water content at the peak"}},
       .make = maker<Capillary>()},
      {.id = id,
       .form = "friction",
       .equation = "tan(phi) times 1 + a d",
       .source = "stated here: water lubricates",
       .parameters = {{"a", "-", -0.03, -1.0, 1.0, "relative growth of the friction a percentage point"}, reference},
       .make = maker<Wetted<change_friction>>()},
      {.id = id,
       .form = "stiffness",
       .equation = "k times exp(a d)",
       .source = "stated here: stiffness falls by equal shares (as cone index with water content)",
       .parameters = {{"a", "-", -0.05, -1.0, 1.0, "logarithmic growth of the stiffness a point"}, reference},
       .make = maker<Wetted<grow_stiffness>>()},
      {.id = id,
       .form = "softening",
       .equation = "k, c, tan(phi) times exp(a d)",
       .source = "stated here: the whole soil changes alike",
       .parameters = {{"a", "-", -0.03, -1.0, 1.0, "logarithmic growth of all three a percentage point"}, reference},
       .make = maker<Wetted<grow_all>>()},
      {.id = id,
       .form = "optimum",
       .equation = "k and c times exp(-a (w - w_o)^2), w in percentage points",
       .source = "stated here: a soil is strongest at one water content; after Proctor 1933, Engineering News-Record "
                 "111, for whom that is its density",
       .parameters = {{"a", "-", 0.005, -1.0, 1.0, "logarithmic loss a squared percentage point from the optimum"},
                      {"w_o", "%", 0.08, 0.0, 1.0, "optimum water content", "moisture", 1.0}},
       .make = maker<Wetted<fall_from_optimum>>()},
  };
}

}  // namespace soilbin::bekker_wong
