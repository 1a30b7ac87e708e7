// A layer on a rough incline: comes to rest below the published angle, flows above it.
#include "dem/verification/incline.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "scenario/errors.hpp"
#include "scenario/unit.hpp"

namespace soilbin::dem {
namespace {

InclineLayer thin_layer(double angle) {
  InclineLayer layer;
  layer.angle = angle * degree;
  layer.layers = 6;
  layer.length = layer.width = 7;
  layer.base_from = 4;
  layer.dt = 2e-4;
  layer.longest = 40;
  return layer;
}

TEST(Incline, FitOfTheStoppingThicknessIsInvertedAndDivergesAtItsEnds) {
  for (const double angle : {19.0, 22.0, 26.0})
    EXPECT_NEAR(stopping_angle(stopping_thickness(angle * degree)) / degree, angle, 1e-9);
  EXPECT_GT(stopping_thickness(17.562 * degree), 1e4);
  EXPECT_NEAR(stopping_thickness(32.257 * degree), 0, 1e-9);
  // 3.836 (tan 32.257 deg - tan 24 deg)/(tan 24 deg - tan 17.561 deg).
  EXPECT_NEAR(stopping_thickness(24 * degree), 3.836 * (0.631124 - 0.445229) / (0.445229 - 0.316470), 1e-3);
}

TEST(Incline, RefusesWhatIsNoLayer) {
  for (const auto& spoil : std::vector<void (*)(InclineLayer&)>{
           [](InclineLayer& l) { l.angle = 0; }, [](InclineLayer& l) { l.layers = 0; },
           [](InclineLayer& l) { l.base_from = 1; }, [](InclineLayer& l) { l.longest = 0; }}) {
    InclineLayer layer = thin_layer(24);
    spoil(layer);
    EXPECT_THROW(run_incline(layer), InputError);
  }
}

TEST(SlowIncline, AThinLayerRestsWellBelowThePublishedAngleAndFlowsWellAbove) {
  InclineLayer slow = thin_layer(20);
  slow.longest = 150;  // of ten such layers the last rested at 54
  const InclineOutcome low = run_incline(slow);
  ASSERT_TRUE(low.rests);
  const double published = stopping_angle(low.thickness) / degree;  // 23.9 for 5.7 d
  EXPECT_GT(published, 20 + 2);
  EXPECT_LT(published, 27 - 2);
  const InclineOutcome high = run_incline(thin_layer(27));
  EXPECT_FALSE(high.rests);
  EXPECT_GT(high.speed.value, 0.3);
}

}  // namespace
}  // namespace soilbin::dem
