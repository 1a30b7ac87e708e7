// exit_angle: soil stays in contact behind the axle, or leaves early.
//
// The base model ends the contact under the axle (theta_2 = 0). Soil that rebounds holds the wheel up further back
// (theta_2 < 0): less drawbar-opposing stress for the same load, so drawbar pull rises and sinkage falls.
#include <algorithm>
#include <cmath>

#include "bekker_wong/effects/forms.hpp"

namespace soilbin::bekker_wong {
namespace {

/// theta_m must stay between the exit and the entry, off both so that neither segment vanishes by rounding.
void keep_order(ContactAngles& a) {
  const double margin = 0.02 * (a.entry - a.exit);
  a.max_stress = std::clamp(a.max_stress, std::min(a.exit, 0.0) == a.exit ? a.exit : a.exit + margin, a.entry - margin);
}

/// theta_2 = -acos(1 - lambda z/r): the soil behind the wheel rises to the share lambda of the sinkage.
class Rebound final : public Effect {
 public:
  explicit Rebound(const std::vector<double>& p) : share_(p[0]) {}
  void angles(ContactAngles& a, const Outline&, const Surroundings&) const override {
    if (share_ == 0.0) return;
    const double half = std::sin(0.5 * a.entry);  // 1 - cos(theta_1) = 2 half^2
    a.exit = -2 * std::asin(std::min(1.0, std::sqrt(share_) * half));
    keep_order(a);
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
    a.exit = -share_ * a.entry;
    keep_order(a);
  }

 private:
  double share_;
};

}  // namespace

std::vector<EffectForm> exit_angle_forms() {
  return {
      {.id = "exit_angle",
       .form = "rebound",
       .equation = "theta_2 = -acos(1 - lambda z/r)",
       .source = "after Ishigami, Miwa, Nagatani, Yoshida 2007, J. Field Robotics 24:233",
       .parameters = {{"lambda", "-", 0.3, 0.0, 1.1, "height of the soil behind the wheel over the sinkage"}},
       .make = maker<Rebound>()},
      {.id = "exit_angle",
       .form = "proportional",
       .equation = "theta_2 = -c3 theta_1",
       .source = "after Wong and Reece 1967, J. Terramechanics 4(1):81 (exit angle taken as a share of the entry's)",
       .parameters = {{"c3", "-", 0.2, -0.5, 0.9, "exit angle behind the axle over the entry angle; < 0: leaves early"}},
       .make = maker<Proportional>()},
  };
}

}  // namespace soilbin::bekker_wong
