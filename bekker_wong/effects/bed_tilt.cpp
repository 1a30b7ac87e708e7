// bed_tilt: the bed is not level, a share of the load leaks into drawbar pull.
//
// W sin(a) of the load lies along a bed that tilts by a. 1 deg of it is 1.7 % of the load: as much as a light wheel's
// whole drawbar pull. The leak is proportional to the load and blind to slip. a is counted like the inclines.
#include <cmath>

#include "bekker_wong/effects/forms.hpp"
#include "bekker_wong/effects/instrument_channels.hpp"
#include "scenario/unit.hpp"

namespace soilbin::bekker_wong {
namespace {

/// The load's share along travel at a longitudinal incline of `extra` more [N].
double leak_along(const OperatingCondition& at, double extra) {
  return -at.load * (std::sin(at.longitudinal_incline + extra) - std::sin(at.longitudinal_incline));
}

/// The load's share to the left of travel at a transverse incline of `extra` more [N].
double leak_across(const OperatingCondition& at, double extra) {
  const double share = std::sin(at.transverse_incline + extra) - std::sin(at.transverse_incline);
  return -at.load * std::cos(at.longitudinal_incline) * share;
}

class Along final : public Effect {
 public:
  explicit Along(const std::vector<double>& p) : tilt_(p[0]) {}
  void sensor(Reading& reading, const Surroundings& around) const override {
    add_force_of_travel(reading, leak_along(around.at, tilt_), 0.0, around.at);
  }

 private:
  double tilt_;
};

class Across final : public Effect {
 public:
  explicit Across(const std::vector<double>& p) : tilt_(p[0]) {}
  void sensor(Reading& reading, const Surroundings& around) const override {
    add_force_of_travel(reading, 0.0, leak_across(around.at, tilt_), around.at);
  }

 private:
  double tilt_;
};

/// The bed leans in any direction: along, and across by a multiple of that.
class AlongAndAcross final : public Effect {
 public:
  explicit AlongAndAcross(const std::vector<double>& p) : tilt_(p[0]), across_(p[0] * p[1]) {}
  void sensor(Reading& reading, const Surroundings& around) const override {
    add_force_of_travel(reading, leak_along(around.at, tilt_), leak_across(around.at, across_), around.at);
  }

 private:
  double tilt_, across_;
};

/// The bed sags or crowns: its slope grows along the bin, level at x_ref.
class Sagging final : public Effect {
 public:
  explicit Sagging(const std::vector<double>& p) : growth_(p[0]), level_(p[1]) {}
  void sensor(Reading& reading, const Surroundings& around) const override {
    if (!around.at.position) return;
    const double tilt = std::atan(growth_ * (*around.at.position - level_));
    add_force_of_travel(reading, leak_along(around.at, tilt), 0.0, around.at);
  }

 private:
  double growth_, level_;
};

/// The bed truly tilts: the leak, and only W cos(alpha + a) cos(beta_t) presses on the ground.
class AlongWithLoad final : public Effect {
 public:
  explicit AlongWithLoad(const std::vector<double>& p) : tilt_(p[0]) {}
  void added_forces(ForceLedger& ledger, const Rolling& rolling) const override {
    if (tilt_ == 0.0) return;
    const OperatingCondition& at = rolling.around.at;
    const double less = std::cos(at.longitudinal_incline) - std::cos(at.longitudinal_incline + tilt_);
    const double leak = leak_along(at, tilt_);
    ledger.add({.name = "bed_tilt",
                .forward = leak * std::cos(at.yaw),
                .lateral = -leak * std::sin(at.yaw),
                .vertical = at.load * std::cos(at.transverse_incline) * less});
  }

 private:
  double tilt_;
};

}  // namespace

std::vector<EffectForm> bed_tilt_forms() {
  const std::string id = "bed_tilt", source = "stated here: statics";
  return {
      {.id = id,
       .form = "along",
       .equation = "F_DP - W [sin(alpha + a) - sin(alpha)]",
       .source = source,
       .parameters = {{"a", "deg", 0.5 * degree, -10 * degree, 10 * degree, "tilt along travel, uphill positive"}},
       .measurement = true,
       .form_tolerance = 0.05,
       .steady_only = of_an_instrument,
       .make = maker<Along>()},
      {.id = id,
       .form = "across",
       .equation = "F_y - W cos(alpha) [sin(beta_t + a) - sin(beta_t)]",
       .source = source,
       .parameters = {{"a", "deg", 0.5 * degree, -10 * degree, 10 * degree, "cross tilt, left side up positive"}},
       .measurement = true,
       .form_tolerance = 0.05,
       .steady_only = of_an_instrument,
       .make = maker<Across>()},
      {.id = id,
       .form = "along_with_load",
       .equation = "F_DP - W [sin(alpha + a) - sin(alpha)]; normal load W cos(alpha + a) cos(beta_t)",
       .source = source,
       .parameters = {{"a", "deg", 0.5 * degree, -10 * degree, 10 * degree, "tilt along travel, uphill positive"}},
       .measurement = true,
       .form_tolerance = 0.05,
       .steady_only = of_an_instrument,
       .make = maker<AlongWithLoad>()},
      {.id = id,
       .form = "along_and_across",
       .equation = "F_DP - W [sin(alpha + a) - sin(alpha)], F_y - W cos(alpha) [sin(beta_t + e a) - sin(beta_t)]",
       .source = source,
       .parameters = {{"a", "deg", 0.5 * degree, -10 * degree, 10 * degree, "tilt along travel, uphill positive"},
                      {"e", "-", 0.0, -9.0, 9.0, "cross tilt over the tilt along travel", "", 1.0}},
       .measurement = true,
       .form_tolerance = 0.05,
       .steady_only = of_an_instrument,
       .make = maker<AlongAndAcross>()},
      {.id = id,
       .form = "sagging",
       .equation = "along, by a tilt of atan(a (x - x_ref)); nothing where a run has no position",
       .source = "stated here: the least even bed, of constant curvature",
       .parameters = {{"a", "1/m", 0.005, -0.2, 0.2, "curvature of the bed along the bin"},
                      {"x_ref", "m", 0.0, -1e4, 1e4, "where the bed is level", "position", 1.0}},
       .measurement = true,
       .form_tolerance = 0.05,
       .steady_only = of_an_instrument,
       .make = maker<Sagging>()},
  };
}

}  // namespace soilbin::bekker_wong
