// A soil that was measured at several densities: what it is at each of them, between them and beyond.
#include "scenario/beds.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <utility>

#include "scenario/case.hpp"
#include "scenario/soil_parameters.hpp"
#include "tests/scenario/fake_vocabulary.hpp"
#include "tests/scenario/refusal.hpp"

namespace soilbin {
namespace {

using test::refusal;
using testing::AllOf;
using testing::HasSubstr;

/// Sand at 1400, 1500 and 1600 kg/m^3; c is one measurement for all of them.
std::vector<SemiEmpiricalSoil> three_beds() {
  std::vector<SemiEmpiricalSoil> beds(3);
  const double exponents[] = {0.9, 0.7, 0.3}, moduli[] = {1e6, 2e6, 3e6}, angles[] = {0.5, 0.55, 0.65},
               shears[] = {0.02, 0.012, 0.006};
  for (std::size_t i = 0; i < 3; ++i) {
    SemiEmpiricalSoil& bed = beds[i];
    bed.density = 1400.0 + 100.0 * static_cast<double>(i);
    bed.exponent = {exponents[i], 0.1}, bed.k_phi = {moduli[i], 0.1 * moduli[i]};
    bed.k_c = {0.02 * static_cast<double>(i + 1) * moduli[i], 0.01 * moduli[i]};
    bed.cohesion = {1e3, 200}, bed.friction_angle = {angles[i], 0.02}, bed.shear_modulus = {shears[i], 0.001};
    bed.stress_angle_c1 = {0.3, 0.1}, bed.stress_angle_c2 = {0.2, 0.1};
  }
  return beds;
}

void expect_same(const SemiEmpiricalSoil& one, const SemiEmpiricalSoil& other) {
  for (const SoilParameter& p : soil_parameters) {
    EXPECT_EQ((one.*p.value).value, (other.*p.value).value) << p.name;
    EXPECT_EQ((one.*p.value).std_error, (other.*p.value).std_error) << p.name;
  }
  EXPECT_EQ(one.density, other.density);
}

TEST(Beds, AtItsOwnDensityABedIsItself) {
  const auto beds = three_beds();
  for (const SemiEmpiricalSoil& bed : beds) expect_same(bed_at(beds, *bed.density), bed);
}

// p = (k_c/b + k_phi) z^n at b = 76 mm: where k_c/k_phi is shared, ln p is linear in ln rho at each depth.
TEST(Beds, PressureIsAPowerOfTheDensityAtEachDepth) {
  auto beds = three_beds();
  for (SemiEmpiricalSoil& bed : beds) bed.k_c.value = 0.03 * bed.k_phi.value;
  const auto log_pressure = [&](double density, double depth) {
    const SemiEmpiricalSoil at = bed_at(beds, density);
    return std::log((at.k_c.value / 0.076 + at.k_phi.value) * std::pow(depth, at.exponent.value));
  };
  for (const double depth : {0.005, 0.08})
    for (const double density : {1420.0, 1450.0, 1499.0}) {
      const double w = std::log(density / 1400) / std::log(1500.0 / 1400);
      EXPECT_NEAR(log_pressure(density, depth), (1 - w) * log_pressure(1400, depth) + w * log_pressure(1500, depth),
                  1e-12);
    }
}

TEST(Beds, ValuesRunMonotonicallyFromBedToBed) {
  const auto beds = three_beds();
  SemiEmpiricalSoil last = beds.front();
  for (double density = 1405; density <= 1600; density += 5) {
    const SemiEmpiricalSoil at = bed_at(beds, density);
    EXPECT_LT(at.exponent.value, last.exponent.value);
    EXPECT_GT(at.k_phi.value, last.k_phi.value);
    EXPECT_GT(at.k_c.value / at.k_phi.value, last.k_c.value / last.k_phi.value);
    EXPECT_GT(at.friction_angle.value, last.friction_angle.value);
    EXPECT_LT(at.shear_modulus.value, last.shear_modulus.value);
    last = at;
  }
}

TEST(Beds, WhatAllBedsShareIsOneMeasurement) {
  const SemiEmpiricalSoil at = bed_at(three_beds(), 1450);
  EXPECT_EQ(at.cohesion.value, 1e3);
  EXPECT_EQ(at.cohesion.std_error, 200) << "not the mean of two errors";
  EXPECT_FALSE(at.sources.contains("cohesion"));
  EXPECT_EQ(at.sources.at("exponent"), "between the beds of 1400 and 1500 kg/m^3");
}

// Halfway in ln rho: w = 1/2, so the beds' 0.1 make 0.1/sqrt 2. Scatter r of n: 0.2 and 0.4 over x_1 and x_2; a bridge
// of length x_1 has r x_1/4 in its middle.
TEST(Beds, ErrorsHoldWhatTheBedsScatter) {
  const double x1 = std::log(1500.0 / 1400), x2 = std::log(1600.0 / 1500);
  const double r = (0.2 * 0.2 / x1 + 0.4 * 0.4 / x2) / 2;
  const Estimate n = bed_at(three_beds(), std::sqrt(1400.0 * 1500)).exponent;
  EXPECT_NEAR(n.value, 0.8, 1e-12);
  EXPECT_NEAR(n.std_error, std::sqrt(0.005 + r * x1 / 4), 1e-12);
}

// Beyond the densest bed n stays, and its variance is the bed's and r times the way in ln rho; farther off it is
// refused.
TEST(Beds, BeyondThemErrorsGrowAndValuesEnd) {
  const double x1 = std::log(1500.0 / 1400), x2 = std::log(1600.0 / 1500);
  const double r = (0.2 * 0.2 / x1 + 0.4 * 0.4 / x2) / 2;
  const auto beds = three_beds();
  const SemiEmpiricalSoil at = bed_at(beds, 1700);
  EXPECT_NEAR(at.exponent.value, 0.3, 1e-12);
  EXPECT_NEAR(at.exponent.std_error, std::sqrt(0.01 + r * std::log(1700.0 / 1600)), 1e-12);
  EXPECT_EQ(at.sources.at("exponent"), "of the bed of 1600 kg/m^3, the nearest that was tested");
  EXPECT_NEAR(reached(beds).lowest, 1400.0 * 1400 / 1600, 1e-9);
  EXPECT_THAT(refusal([&] { bed_at(beds, 1200); }),
              "1200 kg/m^3 is out of reach of beds that were tested at 1400 to 1600 kg/m^3: their values are taken for "
              "1225 to 1829 kg/m^3");
}

// n and k z_i^n err apart at 50 and at 80 mm; between the beds they do so at the geometric mean, where half of each
// bed's error of the pressure stands, and what its own reference lies off times its error of n.
TEST(Beds, AnExponentKeepsItsReferenceSinkage) {
  std::vector<SemiEmpiricalSoil> beds(3, three_beds().front());
  const double references[] = {0.05, 0.08, 0.08};
  for (std::size_t i = 0; i < 3; ++i) {
    beds[i].density = 1400.0 + 100.0 * static_cast<double>(i), beds[i].reference_sinkage = references[i];
    beds[i].k_phi.std_error *= 1.0 + 1e-12 * static_cast<double>(i);  // three measurements
    beds[i].exponent.std_error *= 1.0 + 1e-12 * static_cast<double>(i);
  }
  const SemiEmpiricalSoil at = bed_at(beds, std::sqrt(1400.0 * 1500));
  ASSERT_TRUE(at.reference_sinkage);
  EXPECT_NEAR(*at.reference_sinkage, std::sqrt(0.05 * 0.08), 1e-9);
  EXPECT_NEAR(at.k_phi.value, 1e6, 1e-3);
  const double off = std::log(0.08 / 0.05) / 2 * 0.1;
  EXPECT_NEAR(at.k_phi.std_error / at.k_phi.value, std::hypot(0.1, off) / std::sqrt(2.0), 1e-9);
  EXPECT_NEAR(at.exponent.std_error, 0.1 / std::sqrt(2.0), 1e-9);
  EXPECT_EQ(bed_at(beds, 1650).reference_sinkage, 0.08);
}

TEST(Beds, ValuesMoveAsTheirErrorsDo) {
  SemiEmpiricalSoil soil = three_beds().front();
  const SemiEmpiricalSoil declared = soil;
  soil.reference_sinkage = 0.05;
  const auto pressure = [](const SemiEmpiricalSoil& of, double z) {
    return (of.k_c.value / 0.1 + of.k_phi.value) * std::pow(z, of.exponent.value);
  };
  move_value(soil, soil_parameter("exponent"), 1.2, 0.9);
  EXPECT_EQ(soil.exponent.value, 1.2);
  EXPECT_NEAR(pressure(soil, 0.05), pressure(declared, 0.05), 1e-9 * pressure(declared, 0.05));
  move_value(soil, soil_parameter("k_phi"), 2 * declared.k_phi.value, 0.9);
  move_value(soil, soil_parameter("k_c"), 2 * declared.k_c.value, 0.9);
  EXPECT_NEAR(pressure(soil, 0.05), 2 * pressure(declared, 0.05), 1e-9 * pressure(declared, 0.05))
      << "moved in any order";
  SemiEmpiricalSoil plain = declared;
  move_value(plain, soil_parameter("exponent"), 1.2, 0.9);
  EXPECT_EQ(plain.k_phi.value, declared.k_phi.value) << "without a reference each value moves alone";
}

const std::string file_of_beds = R"(format: soilbin-soil/1
name: sand
density: 1500 kg/m^3
beds:
  - {density: 1400 kg/m^3, exponent: {value: 0.9, sd: 0.1}, k_c: 0 kN/m^(n+1), k_phi: 1000 kN/m^(n+2),
     cohesion: 0 kPa, friction_angle: 30 deg, shear_modulus: 10 mm}
  - {density: 1500 kg/m^3, exponent: {value: 0.7, sd: 0.1}, k_c: 0 kN/m^(n+1), k_phi: 2000 kN/m^(n+2),
     cohesion: 0 kPa, friction_angle: 30 deg, shear_modulus: 10 mm}
)";

std::string replaced(std::string text, const std::string& what, const std::string& by) {
  return text.replace(text.find(what), what.size(), by);
}

Soil soil_in(const std::string& text) { return parse_soil(make_source_text(text, "sand.yaml")); }

TEST(Beds, AFileSaysWhichBedIsAskedAbout) {
  const Soil sand = soil_in(file_of_beds);
  expect_same(*sand.semi_empirical, sand.beds[1]);
  EXPECT_EQ(sand.semi_empirical->k_phi.value, 2e6) << "units of the bed's own n";
}

TEST(Beds, AreWrittenWithTheValuesOfTheBedThatIsAskedAbout) {
  Soil sand = soil_in(file_of_beds);
  set_density(sand, 1433);
  EXPECT_EQ(sand.name, "sand at 1433 kg/m^3");
  const Soil again = soil_in(write_soil(sand));
  expect_same(*again.semi_empirical, *sand.semi_empirical);
  EXPECT_EQ(write_soil(again), write_soil(sand));
  set_density(sand, 1460);
  EXPECT_EQ(sand.name, "sand at 1460 kg/m^3") << "one density in a name";
}

TEST(Beds, FilesOfBedsThatMakeNoSenseAreRefused) {
  const auto refused = [](const std::string& what, const std::string& by) {
    return refusal([&] { soil_in(replaced(file_of_beds, what, by)); });
  };
  EXPECT_THAT(refused("density: 1500 kg/m^3\nbeds", "beds"), HasSubstr("'beds' needs 'density' beside it"));
  EXPECT_THAT(refused("density: 1500 kg/m^3\nbeds", "density: 1900 kg/m^3\nbeds"), HasSubstr("out of reach"));
  EXPECT_THAT(refused("{density: 1400", "{density: 1500"), HasSubstr("stands behind a denser one"));
  EXPECT_THAT(refused("{density: 1400 kg/m^3, ", "{"), HasSubstr("each of the 'beds' needs its 'density'"));
  EXPECT_THAT(refused("1000 kN", "-1 kN"), HasSubstr("needs a k_phi above 0"));
  EXPECT_THAT(refusal([] { soil_in("format: soilbin-soil/1\ndensity: 1500 kg/m^3\ncone_index: 300 kPa\n"); }),
              HasSubstr("'density' picks among 'beds', and there are none"));
}

TEST(Beds, MadeInCodeAreHeldToTheSameRules) {
  Soil sand;
  sand.beds = three_beds();
  std::swap(sand.beds[0], sand.beds[2]);
  EXPECT_THAT(refusal([&] { set_density(sand, 1450); }), HasSubstr("stands behind a denser one"));
}

std::string case_on(const std::string& soil) {
  return "format: soilbin-case/1\nname: t\ntire: {radius: 0.3 m, width: 0.2 m}\nsoil: " + soil +
         "\nstudy: {conditions: {load: 1 kN, slip: 20 %}}\n";
}

TEST(Beds, ACaseNamesASoilAndItsDensity) {
  const Library library({SOILBIN_SOURCE_DIR "/cases"});
  const test::FakeVocabulary effects;
  const auto asked = [&](const std::string& soil) {
    return parse_case(make_source_text(case_on(soil), "case.yaml"), library, effects);
  };
  const Soil library_soil = find_soil("cullinan-sand", library);
  const Case at = asked("{from: cullinan-sand, density: 1450 kg/m^3}");
  expect_same(*at.scenario.soil.semi_empirical, bed_at(library_soil.beds, 1450));
  const Case again = parse_case(make_source_text(write_case(at, effects), "again.yaml"), library, effects);
  expect_same(*again.scenario.soil.semi_empirical, *at.scenario.soil.semi_empirical);
  EXPECT_THAT(refusal([&] { asked("{from: cullinan-sand, density: 900 kg/m^3}"); }),
              AllOf(HasSubstr("case.yaml:4:"), HasSubstr("out of reach of beds that were tested at 1390 to 1538")));
  EXPECT_THAT(refusal([&] { asked("{from: dry-sand, density: 1450 kg/m^3}"); }),
              HasSubstr("soil 'dry-sand' has values at one density alone"));
  EXPECT_THAT(refusal([&] { asked("{from: cullinan-sand}"); }), HasSubstr("'density' is missing"));
}

}  // namespace
}  // namespace soilbin
