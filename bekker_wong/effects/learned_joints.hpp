// Learned effects as Effects: how a function g of the conditions, learned from runs, changes pull, side force, torque,
// sinkage, stiffness or strength (bekker_wong/learned.hpp).
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <memory>
#include <string_view>
#include <utility>

#include "bekker_wong/effect.hpp"
#include "bekker_wong/effects/scaled_soil.hpp"

namespace soilbin::bekker_wong {

/// g of a condition; empty: no change, to the bit.
using LearnedChange = std::function<double(const OperatingCondition&)>;

/// g is held so that a fit's wild guess still has an answer.
inline double held_change(double g) {
  constexpr double largest = 2.0;
  return std::clamp(g, -largest, largest);
}

template <class Joint>
class Learned final : public Effect {
 public:
  explicit Learned(LearnedChange g) : g_(std::move(g)) {}
  bool lifts() const override { return false; }
  void soil(SoilValues& soil, const Surroundings& around) const override {
    if constexpr (requires { Joint::soil(soil, 0.0); })
      if (g_) Joint::soil(soil, std::exp(g_(around.at)));
  }
  void added_forces(ForceLedger& ledger, const Rolling& rolling) const override {
    if constexpr (requires { Joint::force(rolling, 0.0); })
      if (g_) ledger.add(Joint::force(rolling, rolling.around.normal_load * g_(rolling.around.at)));
  }
  void sensor(Reading& reading, const Surroundings& around) const override {
    if constexpr (requires { Joint::sensor(reading, 0.0); })
      if (g_) Joint::sensor(reading, std::exp(g_(around.at)));
  }

 private:
  LearnedChange g_;
};

struct LearnedPull {
  static AddedForce force(const Rolling&, double size) { return {.name = "learned", .forward = size}; }
};
struct LearnedSide {
  static AddedForce force(const Rolling& rolling, double size) {
    return {.name = "learned", .lateral = size * std::sin(rolling.around.at.yaw)};
  }
};
struct LearnedTurning {
  static AddedForce force(const Rolling& rolling, double size) {
    return {.name = "learned", .torque = size * rolling.outline.radius};
  }
};
struct LearnedDepth {
  static void sensor(Reading& reading, double factor) { reading.sinkage *= factor; }
};
struct LearnedStiffness {
  static void soil(SoilValues& soil, double factor) { scale_stiffness(soil, factor); }
};
struct LearnedStrength {
  static void soil(SoilValues& soil, double factor) { scale_strength(soil, factor); }
};

struct LearnedJoint {
  std::string_view name, equation;
  std::unique_ptr<const Effect> (*make)(LearnedChange);
};

template <class Where>
std::unique_ptr<const Effect> joined(LearnedChange g) {
  return std::make_unique<const Learned<Where>>(std::move(g));
}

inline constexpr std::array<LearnedJoint, 6> learned_joints = {{
    {"drawbar_pull", "force W_n a g along the wheel's plane", joined<LearnedPull>},
    {"lateral_force", "force W_n a g sin(yaw) across it", joined<LearnedSide>},
    {"torque", "torque W_n r a g", joined<LearnedTurning>},
    {"sinkage", "measured sinkage times exp(a g)", joined<LearnedDepth>},
    {"stiffness", "k times exp(a g)", joined<LearnedStiffness>},
    {"strength", "c and tan(phi) times exp(a g)", joined<LearnedStrength>},
}};

}  // namespace soilbin::bekker_wong
