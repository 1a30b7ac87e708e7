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

TEST(Incline, AngleOfRestInvertsThePublishedFitOfTheStoppingThickness) {
  const auto published = [](double angle) {  // h_stop of Weinhart et al. 2012
    const auto tan = [](double degrees) { return std::tan(degrees * degree); };
    return 3.836 * (tan(32.257) - tan(angle)) / (tan(angle) - tan(17.561));
  };
  for (const double angle : {19.0, 22.0, 24.0, 26.0, 31.0})
    EXPECT_NEAR(stopping_angle(published(angle)) / degree, angle, 1e-9);
  EXPECT_NEAR(stopping_angle(0) / degree, 32.257, 1e-9) << "a single grain";
  EXPECT_NEAR(stopping_angle(1e9) / degree, 17.561, 1e-6) << "a deep layer";
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
