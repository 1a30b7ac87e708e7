// The base model and exit_angle against published inputs and closed forms (docs/verification.md).
#include <gtest/gtest.h>

#include <cmath>
#include <string>

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

// Two independent public codes agree on this point to all digits given.
TEST(Published, LightWheelAtSixtyPercentSlip) {
  const SoilValues soil{.exponent = 1,
                        .k_c = 1.4e3,
                        .k_phi = 8.2e5,
                        .cohesion = 170,
                        .friction_angle = 46 * degree,
                        .shear_modulus = 0.018,
                        .c1 = 0.4,
                        .c2 = 0.2};
  const RolledWheel w = RollingWheel(smooth_tire(0.1, 0.1), soil).roll(driven(40, 0.6));
  EXPECT_NEAR(w.reading.sinkage, 17.789e-3, 0.5e-6);
  EXPECT_NEAR(w.reading.drawbar_pull, 11.7861, 5e-5);
  EXPECT_NEAR(w.reading.torque, 2.3489, 5e-5);
}

TEST(Published, Ishigami2007WithAndWithoutRebound) {
  const SoilValues soil{.exponent = 1,
                        .k_c = 1370,
                        .k_phi = 8.14e5,
                        .cohesion = 800,
                        .friction_angle = 37.2 * degree,
                        .shear_modulus = 0.036,
                        .c1 = 0.4,
                        .c2 = 0.15};
  const Tire tire = smooth_tire(0.09, 0.11);
  const RolledWheel flat = RollingWheel(tire, soil).roll(driven(64.68, 0.2));
  EXPECT_NEAR(flat.reading.sinkage, 23.7341e-3, 5e-8);
  EXPECT_NEAR(flat.reading.drawbar_pull, -9.11318, 5e-6);
  EXPECT_NEAR(flat.reading.torque, 1.275805, 5e-7);
  const EffectList rebound = make_effects({{"exit_angle", "rebound", {{"lambda", 0.9}}}});
  const RolledWheel back = RollingWheel(tire, soil, rebound).roll(driven(64.68, 0.2));
  EXPECT_NEAR(back.reading.sinkage, 15.5711e-3, 5e-8);
  EXPECT_NEAR(back.reading.drawbar_pull, 10.05743, 5e-6);
  EXPECT_NEAR(back.reading.torque, 1.471679, 5e-7);
}

TEST(Published, Azimi2013) {
  const SoilValues soil{.exponent = 0.8,
                        .k_c = 0,
                        .k_phi = 4.1e5,
                        .cohesion = 234,
                        .friction_angle = 30 * degree,
                        .shear_modulus = 0.013,
                        .c1 = 0.18,
                        .c2 = 0.32};
  const RolledWheel w = RollingWheel(smooth_tire(0.15, 0.1), soil).roll(driven(165, 0.2));
  EXPECT_NEAR(w.reading.sinkage, 31.7033e-3, 5e-8);
  EXPECT_NEAR(w.reading.drawbar_pull, 15.6228, 5e-5);
  EXPECT_NEAR(w.reading.torque, 9.42284, 5e-6);
}

// Reece's form p = (k1 + k2 b)(z/b)^n is Bekker's with k = (k1 + k2 b)/b^n.
TEST(Published, WongReece1967CompactSand) {
  constexpr double psi = 6894.757293168361, inch = 0.0254, pound = 4.4482216152605;
  const double b = 6 * inch, n = 0.47;
  const SoilValues soil{.exponent = n,
                        .k_c = 0,
                        .k_phi = (20 * psi + 2.5 * psi / inch * b) / std::pow(b, n),
                        .cohesion = 0.1 * psi,
                        .friction_angle = 33.3 * degree,
                        .shear_modulus = 1.5 * inch,
                        .c1 = 0.43,
                        .c2 = 0.32};
  const RolledWheel w = RollingWheel(smooth_tire(24.7 * inch, b), soil).roll(driven(2006 * pound, 0.221));
  EXPECT_NEAR(w.reading.sinkage, 123.318e-3, 5e-7);
  EXPECT_NEAR(w.reading.drawbar_pull, 1292.51, 5e-3);
  EXPECT_NEAR(w.reading.torque, 2553.46, 5e-3);
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
                                   {"snow", 1.6, 4.37, 196.72, 1.03, 19.7}};

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
