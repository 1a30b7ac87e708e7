// The bevameter gives back the soil that made its curves.
#include "compare/bevameter/bevameter.hpp"

#include <fmt/core.h>
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "scenario/case.hpp"
#include "scenario/errors.hpp"
#include "scenario/soil_parameters.hpp"
#include "scenario/unit.hpp"

namespace soilbin::compare {
namespace {

constexpr double n = 1.1, k_c = 990, k_phi = 1.53e6, c = 1040, phi = 28 * degree, K = 0.02;

/// Plates of three radii on a soil whose modulus is `share` of the one above.
PlateSet plates(double share = 1) {
  PlateSet set;
  for (const double radius : {0.05, 0.1, 0.15}) {
    bekker_wong::PlateCurve curve{.radius = radius, .pressure = {}, .sinkage = {}};
    for (const double z : {0.01, 0.02, 0.04, 0.06}) {
      curve.sinkage.push_back(z);
      curve.pressure.push_back(share * (k_c / radius + k_phi) * std::pow(z, n));
    }
    set.push_back(curve);
  }
  return set;
}

ShearCurve sheared(double normal) {
  ShearCurve curve{.normal_stress = normal, .displacement = {}, .shear_stress = {}};
  for (int k = 1; k <= 40; ++k) {
    const double j = 0.003 * k;
    curve.displacement.push_back(j);
    curve.shear_stress.push_back((c + normal * std::tan(phi)) * (1 - std::exp(-j / K)));
  }
  return curve;
}

const std::vector<ShearCurve> three_stresses{sheared(5e3), sheared(10e3), sheared(20e3)};

TEST(Bevameter, GivesBackTheSoil) {
  const std::vector<PlateSet> sets{plates()};
  const BevameterFit fit = fit_bevameter(sets, three_stresses);
  EXPECT_NEAR(fit.soil.exponent.value, n, 1e-9);
  EXPECT_NEAR(fit.soil.k_c.value, k_c, 1e-3);
  EXPECT_NEAR(fit.soil.k_phi.value, k_phi, 1);
  EXPECT_NEAR(fit.soil.cohesion.value, c, 0.01);
  EXPECT_NEAR(fit.soil.friction_angle.value, phi, 1e-6);
  EXPECT_NEAR(fit.soil.shear_modulus.value, K, 1e-7);
  EXPECT_NEAR(fit.pressure_error, 0, 1e-9);
}

TEST(Bevameter, ScatterOfSetsIsTheErrorOfTheMean) {
  // Moduli of 0.9, 1 and 1.1: mean 1, standard deviation 0.1, error 0.1/sqrt(3).
  const std::vector<PlateSet> sets{plates(0.9), plates(1), plates(1.1)};
  const BevameterFit fit = fit_bevameter(sets, three_stresses);
  EXPECT_NEAR(fit.soil.k_phi.value, k_phi, 1);
  EXPECT_NEAR(fit.soil.k_phi.std_error, 0.1 * k_phi / std::sqrt(3.0), 1);
  EXPECT_NEAR(fit.soil.exponent.std_error, 0, 1e-9);
}

// Plates whose pressure grows with depth alone, whatever their size, are those of resistive force theory.
TEST(Bevameter, GivesXiNOfPlatesThatKnowNoSize) {
  const double xi_n = 1.2e6, slope = 0.875 * xi_n;  // of a level plate: f3(0, -1, 1)
  PlateSet set;
  for (const double b : {0.05, 0.1}) {
    bekker_wong::PlateCurve curve{b, {}, {}};
    for (int k = 1; k <= 20; ++k) curve.sinkage.push_back(0.002 * k), curve.pressure.push_back(slope * 0.002 * k);
    set.push_back(curve);
  }
  const BevameterFit fit = fit_bevameter(std::vector{set, set}, three_stresses);
  EXPECT_NEAR(fit.xi_n.value / xi_n, 1, 2e-3);  // 0.875 is rounded
  EXPECT_NEAR(fit.xi_n.std_error, 0, 1e-6 * xi_n);
  EXPECT_NEAR(fit.soil.exponent.value, 1, 1e-9);
}

TEST(Bevameter, WritesASoilThatReadsBack) {
  const std::vector<PlateSet> sets{plates()};
  Soil soil;
  soil.name = "grains";
  const Soil out = with_bevameter(soil, fit_bevameter(sets, three_stresses), 1500, "virtual bevameter");
  const Soil again = parse_soil({.file = "soil.yaml", .text = write_soil(out)});
  ASSERT_TRUE(again.semi_empirical);
  EXPECT_EQ(again.semi_empirical->k_phi.value, out.semi_empirical->k_phi.value);
  EXPECT_EQ(again.semi_empirical->sources.at("k_phi"), "virtual bevameter");
  EXPECT_EQ(again.semi_empirical->stress_angle_c1.value, 0.18);
  ASSERT_TRUE(again.resistive_force);
  EXPECT_EQ(again.resistive_force->xi_n.value, out.resistive_force->xi_n.value);
  EXPECT_EQ(again.resistive_force->sources.at("xi_n"), "virtual bevameter");
}

/// Plates and rings of any soil, as their readings scatter by a share.
struct AnySoil {
  std::mt19937_64 random;
  double between(double low, double high) { return std::uniform_real_distribution(low, high)(random); }
  double scattered(double value, double share) { return value * (1 + share * between(-1, 1)); }

  std::vector<PlateSet> sets(double share) {
    std::vector<PlateSet> all(std::uniform_int_distribution<std::size_t>(1, 3)(random));
    const double exponent = between(0.02, 6), cohesive = between(-3e3, 3e4), frictional = between(1e4, 1e8);
    for (PlateSet& set : all)
      for (const double radius : {0.05, 0.1, 0.15}) {
        bekker_wong::PlateCurve curve{.radius = radius, .pressure = {}, .sinkage = {}};
        for (const double z : {0.01, 0.02, 0.04, 0.06}) {
          curve.sinkage.push_back(z);
          curve.pressure.push_back(scattered((cohesive / radius + frictional) * std::pow(z, exponent), share));
        }
        set.push_back(curve);
      }
    return all;
  }

  std::vector<ShearCurve> rings(double share) {
    std::vector<ShearCurve> all;
    const double bond = between(-2e3, 5e3), slope = between(-0.2, 1.5), stretch = std::exp(between(-9, 0));
    for (const double normal : {5e3, 10e3, 20e3}) {
      ShearCurve& curve = all.emplace_back(ShearCurve{.normal_stress = normal, .displacement = {}, .shear_stress = {}});
      for (int k = 1; k <= 12; ++k) {
        const double j = 0.01 * k;
        curve.displacement.push_back(j);
        curve.shear_stress.push_back(scattered((bond + normal * slope) * (1 - std::exp(-j / stretch)), share));
      }
    }
    return all;
  }
};

// Whatever the plates and the ring give, the soil that is written of it is read, to the same bits. What no soil's file
// may hold (an exponent of 6, a friction angle below 0) is refused before it is written.
TEST(Bevameter, WhatItWritesIsRead) {
  int read = 0, refused = 0;
  for (std::uint64_t seed = 1; seed <= 300; ++seed) {
    AnySoil any{std::mt19937_64(seed)};
    const double share = any.between(0, 0.3);
    const std::vector<PlateSet> sets = any.sets(share);
    const std::vector<ShearCurve> rings = any.rings(share);
    Soil soil, out;
    soil.name = "grains";
    try {
      out = with_bevameter(soil, fit_bevameter(sets, rings), any.between(500, 3000), "virtual");
    } catch (const InputError&) {
      ++refused;
      continue;
    }
    SCOPED_TRACE(fmt::format("seed {}:\n{}", seed, write_soil(out)));
    Soil again;
    ASSERT_NO_THROW(again = parse_soil({.file = "soil.yaml", .text = write_soil(out)}));
    for (const SoilParameter& p : soil_parameters) {
      EXPECT_EQ(((*again.semi_empirical).*p.value).value, ((*out.semi_empirical).*p.value).value) << p.name;
      EXPECT_EQ(((*again.semi_empirical).*p.value).std_error, ((*out.semi_empirical).*p.value).std_error) << p.name;
    }
    EXPECT_EQ(again.semi_empirical->density, out.semi_empirical->density);
    ++read;
  }
  EXPECT_GT(read, 100);
  EXPECT_GT(refused, 20);
}

TEST(Bevameter, RefusesTooLittle) {
  const std::vector<PlateSet> sets{plates()}, one{{plates().front()}};
  EXPECT_THROW(fit_bevameter(sets, std::vector<ShearCurve>{sheared(5e3)}), InputError);
  EXPECT_THROW(fit_bevameter(one, three_stresses), InputError);
  EXPECT_THROW(fit_bevameter({}, three_stresses), InputError);
  ShearCurve at_zero = sheared(5e3);
  at_zero.displacement.front() = 0;
  EXPECT_THROW(fit_janosi(at_zero), InputError);
}

}  // namespace
}  // namespace soilbin::compare
