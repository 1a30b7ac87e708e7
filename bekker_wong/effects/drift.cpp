// drift: the soil or an instrument drifts from run to run.
//
// A bed dries or settles, a cell warms up. The change is a line in the order of the runs, or one that slows down as
// settling and warming do. d = run - run_ref is counted from the campaign's mean run, and so is
// L = ln(1 + run) - ln(1 + run_ref), runs below 0 counting as 0. Where a run has no number the effect does nothing.
#include <algorithm>
#include <cmath>

#include "bekker_wong/effects/forms.hpp"
#include "bekker_wong/effects/instrument_channels.hpp"
#include "bekker_wong/effects/scaled_soil.hpp"

namespace soilbin::bekker_wong {
namespace {

/// Progress of a run counted from the reference run.
using Clock = double (*)(double run, double reference);

double steady(double run, double reference) { return run - reference; }
double slowing(double run, double reference) {
  return std::log1p(std::max(0.0, run)) - std::log1p(std::max(0.0, reference));
}

using Scale = void (*)(SoilValues&, double factor);

template <Scale scale, Clock clock>
class SoilDrift final : public Effect {
 public:
  explicit SoilDrift(const std::vector<double>& p) : amplitude_(p[0]), reference_(p[1]) {}
  void soil(SoilValues& soil, const Surroundings& around) const override {
    if (around.at.run) scale(soil, at_least_share(1 + amplitude_ * clock(*around.at.run, reference_)));
  }

 private:
  double amplitude_, reference_;
};

class ZeroDrift final : public Effect {
 public:
  ZeroDrift(double Reading::*channel, Clock clock, const std::vector<double>& p)
      : channel_(channel), clock_(clock), amplitude_(p[0]), reference_(p[1]) {}
  void sensor(Reading& reading, const Surroundings& around) const override {
    if (around.at.run) reading.*channel_ += amplitude_ * clock_(*around.at.run, reference_);
  }

 private:
  double Reading::*channel_;
  Clock clock_;
  double amplitude_, reference_;
};

/// When the instruments were zeroed and the soil was tested is seldom known: before the first run, or in between.
EffectParameter reference_run() {
  return {"run_ref", "-", 1.0, -1e9, 1e9, "run in which all is as declared", "run", 1.0};
}

template <Scale scale, Clock clock>
EffectForm soil_form(const char* form, const char* equation, double usual, double limit, const char* meaning) {
  return {.id = "drift",
          .form = form,
          .equation = equation,
          .source = "stated here",
          .parameters = {{"a", "-", usual, -limit, limit, meaning}, reference_run()},
          .measurement = true,
          .steady_only = of_an_instrument,
          .make = maker<SoilDrift<scale, clock>>()};
}

EffectForm zero_form(const Channel& channel, Clock clock, const std::string& suffix, const std::string& progress,
                     double share, const char* meaning) {
  const double limit = share * channel.limit;
  const std::string name(channel.name);
  return {
      .id = "drift",
      .form = name + suffix,
      .equation = name + " + a " + progress,
      .source = "stated here",
      .parameters = {{"a", std::string(channel.unit), share * channel.usual, -limit, limit, meaning}, reference_run()},
      .measurement = true,
      .steady_only = of_an_instrument,
      .make = [value = channel.value, clock](const std::vector<double>& p) {
        return std::make_unique<const ZeroDrift>(value, clock, p);
      }};
}

}  // namespace

std::vector<EffectForm> drift_forms() {
  std::vector<EffectForm> forms = {
      soil_form<scale_stiffness, steady>("stiffness", "k times 1 + a d", 0.005, 1.0, "relative growth of k a run"),
      soil_form<scale_strength, steady>("strength", "c and tan(phi) times 1 + a d", 0.002, 1.0,
                                        "relative growth of the shear strength a run"),
      soil_form<scale_stiffness, slowing>("stiffness_log", "k times 1 + a L", 0.05, 5.0,
                                          "relative growth of k while the count of runs grows e-fold"),
      soil_form<scale_strength, slowing>("strength_log", "c and tan(phi) times 1 + a L", 0.02, 5.0,
                                         "relative growth of the shear strength while the count grows e-fold"),
  };
  for (const Channel& channel : measured_channels)
    forms.push_back(zero_form(channel, steady, "", "d", 0.02, "drift of the zero a run"));
  for (const Channel& channel : measured_channels)
    forms.push_back(zero_form(channel, slowing, "_log", "L", 0.5, "drift of the zero while the count grows e-fold"));
  return forms;
}

}  // namespace soilbin::bekker_wong
