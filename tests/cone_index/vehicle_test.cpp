// Vehicle cone index, mean maximum pressure, go or no go.
#include "cone_index/vehicle.hpp"

#include <gtest/gtest.h>

#include "scenario/errors.hpp"

namespace soilbin::cone_index {
namespace {

constexpr double in = 0.0254, lbf = 4.4482216152605, horsepower = 745.6998715822702, per_psi = 6894.757293168361;

/// M1152A1: 13,450 lb on four 37 x 12.5 in, clearance 17.4 in, 190 hp, automatic.
Vehicle hmmwv() {
  Vehicle v;
  v.weight = 13450 * lbf, v.axles = 2, v.tires = 4;
  v.tire_width = 12.5 * in, v.tire_diameter = 37 * in, v.clearance = 17.4 * in, v.power = 190 * horsepower;
  return v;
}

TEST(VehicleConeIndex, MeetsAnIndependentCalculationOfTheHmmwv) {
  const VehicleConeIndex index = vehicle_cone_index(hmmwv());
  EXPECT_NEAR(index.mobility_index, 83.82, 0.01);
  EXPECT_NEAR(index.one_pass, 191.649e3, 5);      // with 2.14 in place of 3.74: 191.592 kPa
  EXPECT_NEAR(index.fifty_passes, 435.842e3, 2);  // with 3.74 in place of 3.67: 435.847 kPa
}

// MI = 20, where the fits' constants show: 11.48 + 4 - 39.2/23.74 and 28.23 + 8.6 - 92.67/23.67 psi.
TEST(VehicleConeIndex, HasTheConstantsOfPriddyAndWilloughby) {
  Vehicle light = hmmwv();
  const auto index_less_20 = [&](double weight) {
    light.weight = weight;
    return vehicle_cone_index(light).mobility_index - 20.0;
  };
  double low = 500 * lbf, high = 13450 * lbf;
  while (high - low > 1e-9 * high) (index_less_20(0.5 * (low + high)) < 0 ? low : high) = 0.5 * (low + high);
  light.weight = low;
  EXPECT_NEAR(vehicle_cone_index(light).mobility_index, 20.0, 1e-6);
  EXPECT_NEAR(vehicle_cone_index(light).one_pass / per_psi, 13.8288, 1e-4);
  EXPECT_NEAR(vehicle_cone_index(light).fifty_passes / per_psi, 32.9149, 1e-4);
}

TEST(VehicleConeIndex, HasTheFactorsOfTheManual) {
  const MobilityFactors f = vehicle_cone_index(hmmwv()).factors;
  EXPECT_NEAR(f.contact_pressure, 13450 / (12.5 * 18.5 * 4), 1e-9);
  EXPECT_NEAR(f.weight, 0.033 * 6.725 + 1.05, 1e-9);
  EXPECT_NEAR(f.tire, 0.225, 1e-12);
  EXPECT_NEAR(f.wheel_load, 13.45 / 4, 1e-9);
  EXPECT_NEAR(f.clearance, 1.74, 1e-12);
}

TEST(VehicleConeIndex, CountsChainsGearsAndAWeakEngine) {
  const double plain = vehicle_cone_index(hmmwv()).mobility_index;
  Vehicle manual = hmmwv(), weak = hmmwv(), chained = hmmwv();
  manual.transmission = Transmission::manual;
  weak.power = 67 * horsepower;  // 6.725 tons: 9.96 hp a ton
  chained.chains = YesNo::yes;
  EXPECT_NEAR(vehicle_cone_index(manual).mobility_index, 1.05 * plain, 1e-9);
  EXPECT_NEAR(vehicle_cone_index(weak).mobility_index, 1.05 * plain, 1e-9);
  EXPECT_LT(vehicle_cone_index(chained).mobility_index, plain);
}

TEST(VehicleConeIndex, HasTheWeightFactorOfEachStretch) {
  // X = 1, 10, 15 and 25 kip an axle
  const double expected[][2] = {{1, 0.553}, {10, 1.38}, {15, 1.71}, {25, 3.835}};
  for (const auto& [kip, factor] : expected) {
    Vehicle v = hmmwv();
    v.weight = 2000 * kip * lbf;
    EXPECT_NEAR(vehicle_cone_index(v).factors.weight, factor, 1e-9) << kip;
  }
}

TEST(VehicleConeIndex, OfAHeavyVehicleFollowsThePower) {
  Vehicle heavy = hmmwv();
  heavy.weight *= 2;
  const VehicleConeIndex index = vehicle_cone_index(heavy);
  ASSERT_GT(index.mobility_index, 115);
  EXPECT_NEAR(index.one_pass, per_psi * 4.1 * std::pow(index.mobility_index, 0.446), 1e-6);
}

TEST(VehicleConeIndex, FallsWithTheDeflectionOfItsTires) {
  Vehicle soft = hmmwv();
  soft.section_height = 0.26, soft.deflection = 0.3 * 0.26;
  const VehicleConeIndex index = vehicle_cone_index(soft);
  EXPECT_NEAR(index.one_pass, 191.649e3 * std::pow(0.5, 0.25), 50);
  EXPECT_NEAR(index.fifty_passes, 435.8e3, 50);
}

TEST(VehicleConeIndex, RefusesAVehicleThatCannotBe) {
  Vehicle v = hmmwv();
  v.driven_axles = 3;
  EXPECT_THROW(vehicle_cone_index(v), InputError);
  v = hmmwv(), v.weight = 0;
  EXPECT_THROW(vehicle_cone_index(v), InputError);
  v = hmmwv(), v.clearance = 10;  // metres: the index would be below 0
  v.weight = 100 * lbf;
  EXPECT_THROW(vehicle_cone_index(v), InputError);
}

TEST(MeanMaximumPressure, IsRowlandsWithTheFactorGiven) {
  Vehicle v = hmmwv();
  v.deflection = 0.05, v.mmp_factor = 2.0;
  const double b = v.tire_width, d = v.tire_diameter;
  const double expected = 2.0 * v.weight / (4 * std::pow(b, 0.85) * std::pow(d, 1.15) * std::sqrt(0.05 / d));
  EXPECT_NEAR(mean_maximum_pressure(v)->value, expected, 1e-6);
  EXPECT_TRUE(mean_maximum_pressure(v)->declared);
}

TEST(MeanMaximumPressure, IsOfOneValueOverTheSectionHeightAndOverTheDiameter) {
  Vehicle v = hmmwv();
  v.deflection = 0.05, v.section_height = 0.26;
  const double b = v.tire_width, d = v.tire_diameter;
  const double by_height = 3.65 * v.weight / (4 * std::pow(b, 0.85) * std::pow(d, 1.15) * std::sqrt(0.05 / 0.26));
  EXPECT_NEAR(mean_maximum_pressure(v)->value, by_height, 1e-6);
}

TEST(MeanMaximumPressure, GrowsWhereFewerAxlesAreDriven) {
  for (int axles = 2; axles <= 4; ++axles)
    for (int driven = 1; driven < axles; ++driven)
      EXPECT_GT(*rowlands_factor(axles, driven), *rowlands_factor(axles, driven + 1)) << axles << " " << driven;
}

TEST(MeanMaximumPressure, IsNotThereWithoutADeflection) {
  EXPECT_FALSE(mean_maximum_pressure(hmmwv()));
  Vehicle v = hmmwv();
  v.axles = 5, v.tires = 10, v.deflection = 0.05, v.section_height = 0.26;
  EXPECT_FALSE(mean_maximum_pressure(v)) << "no K for five axles";
}

TEST(Mobility, SaysGoWhereTheSoilIsStrongerThanTheVehicleNeeds) {
  const Mobility m = mobility_of(hmmwv(), Estimate{300e3, 30e3});
  ASSERT_TRUE(m.passages);
  const auto& [once, often] = *m.passages;
  EXPECT_TRUE(once.go);
  EXPECT_NEAR(once.excess.value, 108.4e3, 50);
  EXPECT_EQ(once.excess.std_error, 30e3);
  EXPECT_FALSE(once.is_close());
  EXPECT_FALSE(often.go);
  EXPECT_NEAR(often.excess.value, -135.8e3, 50);
  EXPECT_TRUE(mobility_of(hmmwv(), Estimate{200e3, 30e3}).passages->at(0).is_close());
}

TEST(Mobility, HasNoVerdictWithoutASoil) { EXPECT_FALSE(mobility_of(hmmwv(), std::nullopt).passages); }

}  // namespace
}  // namespace soilbin::cone_index
