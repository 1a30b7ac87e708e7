// soil_gradient: the soil's strength varies along the bin.
//
// A bed is never prepared evenly from end to end. d = x - x_ref is counted from the campaign's mean position. Where a
// run has no position the effect does nothing.
#include "bekker_wong/effects/forms.hpp"
#include "bekker_wong/effects/scaled_soil.hpp"

namespace soilbin::bekker_wong {
namespace {

using Scale = void (*)(SoilValues&, double factor);
using Shape = double (*)(double amplitude, double d);

double grown_linearly(double a, double d) { return at_least_share(1 + a * d); }
double grown_exponentially(double a, double d) { return bounded_exp(a * d); }
double bay(double a, double d) { return bounded_exp(a * d * d); }

void scale_both(SoilValues& soil, double factor) {
  scale_stiffness(soil, factor);
  scale_strength(soil, factor);
}

template <Scale scale, Shape shape>
class Gradient final : public Effect {
 public:
  explicit Gradient(const std::vector<double>& p) : amplitude_(p[0]), reference_(p[1]) {}
  void soil(SoilValues& soil, const Surroundings& around) const override {
    if (around.at.position) scale(soil, shape(amplitude_, *around.at.position - reference_));
  }

 private:
  double amplitude_, reference_;
};

}  // namespace

std::vector<EffectForm> soil_gradient_forms() {
  const std::string id = "soil_gradient", source = "stated here";
  const EffectParameter reference = {"x_ref", "m", 0.0, -1e4, 1e4, "where the soil is as declared", "position"};
  return {
      {.id = id,
       .form = "stiffness",
       .equation = "k times 1 + a d",
       .source = source,
       .parameters = {{"a", "1/m", 0.1, -5.0, 5.0, "relative growth of the stiffness a metre"}, reference},
       .measurement = true,
       .make = maker<Gradient<scale_stiffness, grown_linearly>>()},
      {.id = id,
       .form = "stiffness_exponential",
       .equation = "k times exp(a d)",
       .source = source,
       .parameters = {{"a", "1/m", 0.1, -5.0, 5.0, "logarithmic growth of the stiffness a metre"}, reference},
       .measurement = true,
       .make = maker<Gradient<scale_stiffness, grown_exponentially>>()},
      {.id = id,
       .form = "strength",
       .equation = "c and tan(phi) times 1 + a d",
       .source = source,
       .parameters = {{"a", "1/m", 0.05, -5.0, 5.0, "relative growth of the shear strength a metre"}, reference},
       .measurement = true,
       .make = maker<Gradient<scale_strength, grown_linearly>>()},
      {.id = id,
       .form = "stiffness_and_strength",
       .equation = "k, c and tan(phi) times 1 + a d",
       .source = source,
       .parameters = {{"a", "1/m", 0.05, -5.0, 5.0, "relative growth of stiffness and strength a metre"}, reference},
       .measurement = true,
       .make = maker<Gradient<scale_both, grown_linearly>>()},
      {.id = id,
       .form = "stiffness_bay",
       .equation = "k times exp(a d^2)",
       .source = source,
       .parameters = {{"a", "1/m^2", 0.05, -5.0, 5.0, "growth of the stiffness away from x_ref"},
                      {"x_ref", "m", 0.0, -1e4, 1e4, "middle of the bay", "position", 1.0}},
       .measurement = true,
       .make = maker<Gradient<scale_stiffness, bay>>()},
  };
}

}  // namespace soilbin::bekker_wong
