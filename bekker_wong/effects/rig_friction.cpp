// rig_friction: bearings and drive train take torque.
//
// A torque cell between motor and bearing reads the soil's moment plus what the bearing takes; friction opposes the
// rotation, which is forward (w > 0) for driven and braked wheels alike, so it always adds. A locked wheel does not
// turn: nothing is added. Drawbar pull and sinkage do not know of it.
#include <cmath>

#include "bekker_wong/effects/forms.hpp"
#include "bekker_wong/effects/instrument_channels.hpp"

namespace soilbin::bekker_wong {
namespace {

using Parameters = std::vector<double>;

/// Torque that friction takes [N m].
using Loss = double (*)(const Parameters&, const Reading&, const Surroundings&);

template <Loss loss>
class Taken final : public Effect {
 public:
  explicit Taken(const Parameters& parameters) : parameters_(parameters) {}
  void sensor(Reading& reading, const Surroundings& around) const override {
    if (!around.motion.locked) reading.torque += loss(parameters_, reading, around);
  }

 private:
  Parameters parameters_;
};

double coulomb(const Parameters& p, const Reading&, const Surroundings&) { return p[0]; }
double bearing(const Parameters& p, const Reading&, const Surroundings& around) {
  return p[0] * around.at.load * around.tire.radius;
}
double seals_and_bearing(const Parameters& p, const Reading&, const Surroundings& around) {
  constexpr double kilonewton = 1000.0;
  return p[0] * std::pow(around.at.load / kilonewton, p[1]);
}
double viscous(const Parameters& p, const Reading&, const Surroundings& around) { return p[0] * rim_speed(around); }
double gears(const Parameters& p, const Reading& reading, const Surroundings&) {
  return p[0] * std::abs(reading.torque);
}

}  // namespace

std::vector<EffectForm> rig_friction_forms() {
  const std::string id = "rig_friction", source = "stated here: machine elements";
  return {
      {.id = id,
       .form = "coulomb",
       .equation = "M + a",
       .source = source,
       .parameters = {{"a", "N m", 1.0, 0.0, 1e4, "torque that seals and bearings take"}},
       .measurement = true,
       .form_tolerance = 0.15,
       .steady_only = of_an_instrument,
       .make = maker<Taken<coulomb>>()},
      {.id = id,
       .form = "load_proportional",
       .equation = "M + a W r",
       .source = source,
       .parameters = {{"a", "-", 0.01, 0.0, 0.5, "bearing's friction times its radius over the wheel's"}},
       .measurement = true,
       .form_tolerance = 0.15,
       .steady_only = of_an_instrument,
       .make = maker<Taken<bearing>>()},
      {.id = id,
       .form = "seals_and_bearing",
       .equation = "M + a (W/(1 kN))^e",
       .source = source,
       .parameters = {{"a", "N m", 1.0, 0.0, 1e4, "torque taken at a load of 1 kN"},
                      {"e", "-", 0.5, 0.0, 1.5, "0: seals alone; 1: a bearing alone"}},
       .measurement = true,
       .form_tolerance = 0.15,
       .steady_only = of_an_instrument,
       .make = maker<Taken<seals_and_bearing>>()},
      {.id = id,
       .form = "viscous",
       .equation = "M + a (r w)/(1 m/s), v/(r w) held above 0.02",
       .source = source,
       .parameters = {{"a", "N m", 1.0, 0.0, 1e4, "torque taken at a rim speed of 1 m/s"}},
       .measurement = true,
       .form_tolerance = 0.15,
       .steady_only = of_an_instrument,
       .conditions = {"speed"},
       .make = maker<Taken<viscous>>()},
      {.id = id,
       .form = "transmission",
       .equation = "M + a |M|",
       .source = source,
       .parameters = {{"a", "-", 0.05, 0.0, 1.0, "share of the torque lost in the gears"}},
       .measurement = true,
       .form_tolerance = 0.15,
       .steady_only = of_an_instrument,
       .make = maker<Taken<gears>>()},
  };
}

}  // namespace soilbin::bekker_wong
