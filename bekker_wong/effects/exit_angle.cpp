// exit_angle: soil stays in contact behind the axle, or leaves early.
//
// The base model ends the contact under the axle (theta_2 = 0). Soil that rebounds holds the wheel up further back
// (theta_2 < 0): less drawbar-opposing stress for the same load, so drawbar pull rises and sinkage falls. The forms
// differ in load: the rebound grows as the root of lambda times theta_1, the fixed angle not at all.
#include <algorithm>
#include <cmath>

#include "bekker_wong/effects/forms.hpp"

namespace soilbin::bekker_wong {
namespace {

/// Moves the exit and keeps theta_m between it and the entry: off both by 2 % where the soil leaves early. Where a
/// carcass that gives way is in contact behind the axle, the contact ends no sooner than that.
void leave_at(ContactAngles& a, double exit) {
  const double flattened = a.exit;
  a.exit = flattened < 0.0 ? std::min(exit, flattened) : exit;
  if (exit <= 0.0) return;  // the base model's theta_m lies in 0 .. 0.98 theta_1
  const double margin = 0.02 * (a.entry - exit);
  a.max_stress = std::clamp(a.max_stress, exit + margin, a.entry - margin);
}

/// theta_2 = -acos(1 - lambda z/r): the soil behind the wheel rises to the share lambda of the sinkage.
class Rebound final : public Effect {
 public:
  explicit Rebound(const std::vector<double>& p) : share_(p[0]) {}
  void angles(ContactAngles& a, const Outline&, const Surroundings&) const override {
    if (share_ == 0.0) return;
    const double half = std::sin(0.5 * a.entry);  // 1 - cos(theta_1) = 2 half^2
    leave_at(a, -2 * std::asin(std::min(1.0, std::sqrt(share_) * half)));
  }

 private:
  double share_;
};

/// theta_2 = -c3 theta_1: a fixed share of the entry angle.
class Proportional final : public Effect {
 public:
  explicit Proportional(const std::vector<double>& p) : share_(p[0]) {}
  void angles(ContactAngles& a, const Outline&, const Surroundings&) const override {
    if (share_ == 0.0) return;
    leave_at(a, -share_ * a.entry);
  }

 private:
  double share_;
};

/// theta_2 = -theta_c, the same at every sinkage; at most theta_1.
class Fixed final : public Effect {
 public:
  explicit Fixed(const std::vector<double>& p) : angle_(p[0]) {}
  void angles(ContactAngles& a, const Outline&, const Surroundings&) const override {
    if (angle_ == 0.0) return;
    leave_at(a, -std::min(angle_, a.entry));
  }

 private:
  double angle_;
};

}  // namespace

std::vector<EffectForm> exit_angle_forms() {
  return {
      {.id = "exit_angle",
       .form = "rebound",
       .equation = "theta_2 = -acos(1 - lambda z/r)",
       .source = "Ishigami, Miwa, Nagatani, Yoshida 2007, J. Field Robotics 24:233",
       .parameters = {{"lambda", "-", 0.3, 0.0, 1.1, "height of the soil behind the wheel over the sinkage"}},
       .make = maker<Rebound>()},
      {.id = "exit_angle",
       .form = "proportional",
       .equation = "theta_2 = -c3 theta_1",
       .source = "after Ding, Gao, Deng, Nagatani, Yoshida 2011, J. Terramechanics 48:27 (theta_2 = c_3 theta_1)",
       .parameters = {{"c3", "-", 0.2, -0.5, 0.9, "exit angle over entry angle; negative: the soil leaves early"}},
       .make = maker<Proportional>()},
      {.id = "exit_angle",
       .form = "fixed",
       .equation = "theta_2 = -min(theta_c, theta_1)",
       .source = "stated: an exit angle that does not follow the sinkage",
       .parameters = {{"theta_c", "deg", 0.1, 0.0, 0.6, "exit angle behind the axle"}},
       .make = maker<Fixed>()},
  };
}

}  // namespace soilbin::bekker_wong
