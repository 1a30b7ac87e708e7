// A wheel on dry sand, with and without one effect: what the tests of the effects of bed, soil and rig share.
#pragma once

#include <gtest/gtest.h>

#include <cmath>

#include "bekker_wong/effect.hpp"
#include "bekker_wong/model.hpp"
#include "bekker_wong/rolling_wheel.hpp"
#include "scenario/unit.hpp"
#include "tests/fixtures.hpp"

namespace soilbin::bekker_wong::bed {

inline constexpr double radius = 0.25, width = 0.1;

/// Wong's dry sand.
inline SoilValues sand() { return values_of(test::dry_sand()); }

inline OperatingCondition driven(double load = 800, double slip = 0.2) { return test::condition(load, slip); }

inline Tire smooth_tire(double r = radius, double b = width) { return test::smooth_wheel(r, b); }

inline RollingWheel wheel_on(const SoilValues& soil, const EffectList& effects = {}, std::optional<Bin> bin = {}) {
  return {smooth_tire(), soil, effects, bin};
}

inline Reading roll(const SoilValues& soil, const EffectList& effects, const OperatingCondition& at,
                    std::optional<Bin> bin = {}) {
  return wheel_on(soil, effects, bin).roll(at).reading;
}

inline Reading base(const OperatingCondition& at) { return roll(sand(), {}, at); }

inline Reading with(const EffectChoice& choice, const OperatingCondition& at, std::optional<Bin> bin = {}) {
  return roll(sand(), make_effects({choice}), at, bin);
}

inline void expect_same_bits(const Reading& a, const Reading& b) {
  EXPECT_EQ(a.drawbar_pull, b.drawbar_pull);
  EXPECT_EQ(a.torque, b.torque);
  EXPECT_EQ(a.sinkage, b.sinkage);
  EXPECT_EQ(a.lateral_force, b.lateral_force);
}

/// Every form at its defaults leaves this condition as it is.
inline void expect_silent(const std::string& id, const OperatingCondition& at) {
  for (const EffectForm& form : effect_catalogue()) {
    if (form.id != id) continue;
    SCOPED_TRACE(form.form);
    expect_same_bits(with({id, form.form, {}}, at), base(at));
  }
}

}  // namespace soilbin::bekker_wong::bed
