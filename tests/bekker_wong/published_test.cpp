// The base model where independent codes agree, on the soils of Wong's table, and against a closed form
// (docs/lab/verification.md).
#include <gtest/gtest.h>

#include <string>

#include "bekker_wong/agreed_points.hpp"
#include "bekker_wong/bed_fixture.hpp"
#include "bekker_wong/closed_forms.hpp"
#include "bekker_wong/effect.hpp"
#include "bekker_wong/model.hpp"
#include "bekker_wong/reference_wheel.hpp"
#include "bekker_wong/rolling_wheel.hpp"
#include "scenario/case.hpp"
#include "scenario/unit.hpp"

namespace soilbin::bekker_wong {
namespace {

using bed::driven;
using bed::smooth_tire;

// Two independent codes agree on each of these to the digits told.
TEST(AgreedPoints, AreTheModels) {
  for (const AgreedPoint& point : agreed_points()) {
    const Reading reading = reading_at(point);
    EXPECT_NEAR(reading.sinkage, point.sinkage.value, point.sinkage.half_unit) << point.name;
    EXPECT_NEAR(reading.drawbar_pull, point.drawbar_pull.value, point.drawbar_pull.half_unit) << point.name;
    EXPECT_NEAR(reading.torque, point.torque.value, point.torque.half_unit) << point.name;
    EXPECT_LE(worst_difference(point, reading), 1.0) << point.name;
  }
}

// A wheel that is off by one and a half units of a last digit is off by three halves of a unit.
TEST(AgreedPoints, CountInHalfUnitsOfTheLastDigit) {
  const AgreedPoint& point = agreed_points().front();
  const Reading told{point.drawbar_pull.value, point.torque.value, point.sinkage.value, 0.0};
  EXPECT_EQ(worst_difference(point, told), 0.0);
  Reading off = told;
  off.torque -= 3 * point.torque.half_unit;
  EXPECT_NEAR(worst_difference(point, off), 3.0, 1e-9);
}

/// Wong's table of soils: n, k_c and k_phi in kN units, c [kPa], phi [deg]; K, c1, c2 are not in it.
struct TableRow {
  const char* file;
  double n, k_c, k_phi, c, phi;
};
constexpr TableRow wong_table[] = {{"dry-sand", 1.1, 0.99, 1528.43, 1.04, 28},
                                   {"sandy-loam", 0.7, 5.27, 1515.04, 1.72, 29},
                                   {"clayey-soil", 0.5, 13.19, 692.15, 4.14, 13},
                                   {"upland-sandy-loam", 1.10, 74.6, 2080, 3.3, 33.7},
                                   {"snow", 1.6, 4.37, 196.72, 1.03, 19.7},
                                   {"lete-sand", 0.79, 102, 5301, 1.3, 31.1},
                                   {"sandy-loam-wet", 0.2, 2.56, 43.12, 1.38, 38},
                                   {"rubicon-sandy-loam", 0.66, 6.9, 752, 3.7, 29.8},
                                   {"north-gower-clayey-loam", 0.73, 41.6, 2471, 6.1, 26.6},
                                   {"grenville-loam", 1.01, 0.06, 5880, 3.1, 29.8},
                                   {"heavy-clay", 0.11, 1.84, 103.27, 20.69, 6},
                                   {"lean-clay", 0.15, 1.52, 119.61, 13.79, 11},
                                   {"snow-sweden", 1.44, 10.55, 66.08, 6, 20.7}};

TEST(Published, WongsSoilsAreTheCases) {
  for (const TableRow& row : wong_table) {
    SCOPED_TRACE(row.file);
    const Soil soil = read_soil(std::string(SOILBIN_SOURCE_DIR "/cases/soils/") + row.file + ".yaml");
    ASSERT_TRUE(soil.semi_empirical);
    const SoilValues values = values_of(*soil.semi_empirical);
    EXPECT_DOUBLE_EQ(values.exponent, row.n);
    EXPECT_DOUBLE_EQ(values.k_c, row.k_c * 1e3);
    EXPECT_DOUBLE_EQ(values.k_phi, row.k_phi * 1e3);
    EXPECT_DOUBLE_EQ(values.cohesion, row.c * 1e3);
    EXPECT_DOUBLE_EQ(values.friction_angle, row.phi * degree);
  }
}

// The paper's smooth soil-bin tire (r 250 mm, b 100 mm) on each of them, with a load that snow still carries.
TEST(Published, WongsSoilsAgreeWithTheReferenceWheel) {
  for (const TableRow& row : wong_table) {
    SCOPED_TRACE(row.file);
    const SoilValues soil{.exponent = row.n,
                          .k_c = row.k_c * 1e3,
                          .k_phi = row.k_phi * 1e3,
                          .cohesion = row.c * 1e3,
                          .friction_angle = row.phi * degree,
                          .shear_modulus = 0.02,
                          .c1 = 0.18,
                          .c2 = 0.32};
    const Reading found = RollingWheel(smooth_tire(0.25, 0.1), soil).roll(driven(200, 0.2)).reading;
    const reference::Answer expected = reference::Wheel(smooth_tire(0.25, 0.1), soil, driven(200, 0.2)).roll();
    EXPECT_NEAR(found.sinkage, static_cast<double>(expected.sinkage), 1e-8 * found.sinkage);
    EXPECT_NEAR(found.drawbar_pull, static_cast<double>(expected.drawbar_pull), 1e-8 * 200);
    EXPECT_NEAR(found.torque, static_cast<double>(expected.torque), 1e-8 * found.torque);
  }
}

TEST(Published, CriticalGroundPressure) {
  const SoilValues soil{.exponent = 0.7, .k_phi = 1541390};
  EXPECT_NEAR(critical_ground_pressure(soil, 0.3, 0.2, 3000), 140078, 0.5);
}

}  // namespace
}  // namespace soilbin::bekker_wong
