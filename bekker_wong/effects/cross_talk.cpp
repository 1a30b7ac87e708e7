// cross_talk: one channel leaks into another.
//
// A multi-axis cell's axes are never quite apart, and a cell that is mounted askew sees a neighbour's force. Torques
// become forces, and forces torques, by the wheel's radius, so that every share is a plain number. A leak of the load
// into drawbar pull or lateral force would look like a bed out of level and is left to that; into the depth gauge the
// load leaks by the frame's yielding.
#include <cmath>

#include "bekker_wong/effects/forms.hpp"
#include "scenario/unit.hpp"

namespace soilbin::bekker_wong {
namespace {

/// Where a leak goes, what it adds at a share of 1, and how that reads.
struct Leak {
  const char* form;
  const char* equation;
  double Reading::*into;
  double (*from)(const Reading&, const Surroundings&);
};

double pull(const Reading& r, const Surroundings&) { return r.drawbar_pull; }
double side(const Reading& r, const Surroundings&) { return r.lateral_force; }
double rim_force(const Reading& r, const Surroundings& around) { return r.torque / around.tire.radius; }
double pull_moment(const Reading& r, const Surroundings& around) { return r.drawbar_pull * around.tire.radius; }
double side_moment(const Reading& r, const Surroundings& around) { return r.lateral_force * around.tire.radius; }

constexpr Leak leaks[] = {
    {"drawbar_pull_from_lateral_force", "F_DP + a F_y", &Reading::drawbar_pull, side},
    {"drawbar_pull_from_torque", "F_DP + a M/r", &Reading::drawbar_pull, rim_force},
    {"lateral_force_from_drawbar_pull", "F_y + a F_DP", &Reading::lateral_force, pull},
    {"lateral_force_from_torque", "F_y + a M/r", &Reading::lateral_force, rim_force},
    {"torque_from_drawbar_pull", "M + a r F_DP", &Reading::torque, pull_moment},
    {"torque_from_lateral_force", "M + a r F_y", &Reading::torque, side_moment},
};

class Leaking final : public Effect {
 public:
  Leaking(const Leak& leak, double share) : leak_(leak), share_(share) {}
  void sensor(Reading& reading, const Surroundings& around) const override {
    reading.*leak_.into += share_ * leak_.from(reading, around);
  }

 private:
  const Leak& leak_;
  double share_;
};

/// The force cell is turned by a about the vertical axis, to the left: it shows F_DP cos a + F_y sin a along its first
/// axis and F_y cos a - F_DP sin a along its second.
class Turned final : public Effect {
 public:
  explicit Turned(const std::vector<double>& p) : cosine_(std::cos(p[0])), sine_(std::sin(p[0])) {}
  void sensor(Reading& reading, const Surroundings&) const override {
    const double forward = reading.drawbar_pull, left = reading.lateral_force;
    reading.drawbar_pull = forward * cosine_ + left * sine_;
    reading.lateral_force = left * cosine_ - forward * sine_;
  }

 private:
  double cosine_, sine_;
};

/// The frame yields under the load: the depth gauge shows a more at 1 kN, never less, for what gives way stands between
/// the gauge and the wheel.
class Yielding final : public Effect {
 public:
  explicit Yielding(const std::vector<double>& p) : amplitude_(p[0]) {}
  void sensor(Reading& reading, const Surroundings& around) const override {
    reading.sinkage += amplitude_ * (around.at.load / 1000.0);
  }

 private:
  double amplitude_;
};

}  // namespace

std::vector<EffectForm> cross_talk_forms() {
  const std::string id = "cross_talk";
  std::vector<EffectForm> forms;
  for (const Leak& leak : leaks)
    forms.push_back(
        {.id = id,
         .form = leak.form,
         .equation = leak.equation,
         .source = "stated here",
         .parameters = {{"a", "-", 0.03, -0.5, 0.5, "share that leaks"}},
         .measurement = true,
         .form_tolerance = 0.08,
         .steady_only = of_an_instrument,
         .make = [&leak](const std::vector<double>& p) { return std::make_unique<const Leaking>(leak, p[0]); }});
  forms.push_back({.id = id,
                   .form = "turned_cell",
                   .equation = "F_DP cos(a) + F_y sin(a); F_y cos(a) - F_DP sin(a)",
                   .source = "stated here",
                   .parameters = {{"a", "deg", 2 * degree, -30 * degree, 30 * degree, "turn of the cell, to the left"}},
                   .measurement = true,
                   .form_tolerance = 0.08,
                   .steady_only = of_an_instrument,
                   .make = maker<Turned>()});
  forms.push_back({.id = id,
                   .form = "sinkage_from_load",
                   .equation = "z + a W/(1 kN)",
                   .source = "stated here",
                   .parameters = {{"a", "mm", 0.001, 0.0, 0.2, "yielding of the frame at a load of 1 kN"}},
                   .measurement = true,
                   .form_tolerance = 0.08,
                   .steady_only = of_an_instrument,
                   .make = maker<Yielding>()});
  return forms;
}

}  // namespace soilbin::bekker_wong
