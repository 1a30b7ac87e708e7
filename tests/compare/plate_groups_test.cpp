// Plates of several beds in one file: each fitted apart, and what they give at a density that no bed had.

#include "compare/bevameter/plate_groups.hpp"

#include <fmt/core.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "bekker_wong/gsl.hpp"
#include "compare/bevameter/measured_shear.hpp"
#include "compare/doubt_matchers.hpp"
#include "compare/doubts/doubts.hpp"
#include "compare/telling/reports.hpp"
#include "scenario/case.hpp"
#include "tests/scenario/refusal.hpp"

namespace soilbin::compare {
namespace {

using test::refusal;
using testing::AllOf;
using testing::HasSubstr;
using testing::StartsWith;

// y = 3 (rho/rho_0)^5 gives itself back. In ln rho three beds a tenth apart lie at -h, 0 and h: the told errors of 6 %
// are 6 %/sqrt 3 of y_0 and 6 %/(h sqrt 2) of the power.
TEST(PowersOfDensity, GiveBackWhatMadeThem) {
  const std::vector<double> densities = {1500 / 1.1, 1500, 1500 * 1.1};
  std::vector<double> values;
  for (const double density : densities) values.push_back(3 * std::pow(density / 1500, 5));
  const PowerOfDensity power = fit_power_of_density(densities, values, {0.06, 0.06, 0.06});
  EXPECT_NEAR(power.reference, 3, 1e-12);
  EXPECT_NEAR(power.power.value, 5, 1e-10);
  EXPECT_NEAR(power.share, 0.06 / std::sqrt(3.0), 1e-12);
  EXPECT_NEAR(power.power.std_error, 0.06 / (std::log(1.1) * std::sqrt(2.0)), 1e-10);
}

// The middle bed is off by 30 % where 1 % were told: of a line through three, ln 1.3 leaves 2/3 of its square for the
// one degree of freedom, and Student's t of one degree makes 1.84 of it.
TEST(PowersOfDensity, ErrByWhatTheBedsScatter) {
  const PowerOfDensity power = fit_power_of_density({1500 / 1.1, 1500, 1500 * 1.1}, {1, 1.3, 1}, {0.01, 0.01, 0.01});
  const double scatter = std::log(1.3) * std::sqrt(2.0 / 3) * gsl::student_factor(1);
  EXPECT_NEAR(power.power.value, 0, 1e-10);
  EXPECT_NEAR(power.share, scatter / std::sqrt(3.0), 1e-10);
}

TEST(PowersOfDensity, NeedThreeBeds) {
  EXPECT_THAT(refusal([] { fit_power_of_density({1400, 1500}, {1, 2}, {0.1, 0.1}); }), HasSubstr("needs 3 densities"));
}

/// Beds of these densities pressed once each by a plate of 0.1 m: n = 0.6 (rho/1500)^-4, 200 kPa (rho/1500)^6 at z = b.
SourceText beds(const std::vector<double>& densities) {
  std::string csv = "bed,dry_density_kg/m^3,plate_diameter_mm,sinkage_mm,pressure_kPa\n";
  for (const double density : densities)
    for (int z = 2; z <= 60; z += 2)
      csv += fmt::format("{},{},100,{},{:.8g}\n",
                         density < 1500   ? "loose"
                         : density > 1500 ? "dense"
                                          : "medium",
                         density, z,
                         200 * std::pow(density / 1500, 6) * std::pow(z / 50.0, 0.6 * std::pow(density / 1500, -4)));
  return make_source_text(csv, "beds.csv");
}

TEST(PlateGroups, EachValueOfAColumnIsFittedApart) {
  const PlateGroups groups = fit_groups(beds({1400, 1500, 1600}), {.by = "bed"});
  ASSERT_EQ(groups.all.size(), 3u);
  for (const PlateGroup& group : groups.all) {
    EXPECT_EQ(group.tests.size(), 1u);
    EXPECT_NEAR(group.fit.exponent.estimate.value, 0.6 * std::pow(*group.density / 1500, -4), 1e-6) << group.value;
  }
  EXPECT_THAT(doubts(groups), testing::ElementsAre(test::tells(DoubtKind::one_plate_size, {50}))) << "once, not thrice";
}

// The answer is what a soil file of these beds gives: n and ln k_phi linear in ln rho between the neighbours.
TEST(PlateGroups, ABedBetweenTheDensitiesIsInterpolated) {
  const PlateGroups groups =
      fit_groups(beds({1600, 1400, 1500}), {.by = "dry_density_kg/m^3", .density = std::sqrt(1400.0 * 1500)});
  ASSERT_EQ(groups.beds.size(), 3U);
  EXPECT_EQ(groups.beds.front().density, 1400) << "loosest first, wherever it stands in the file";
  ASSERT_TRUE(groups.at);
  const SemiEmpiricalSoil &loose = groups.beds[0], &medium = groups.beds[1];
  EXPECT_NEAR(groups.at->exponent.value, (loose.exponent.value + medium.exponent.value) / 2, 1e-12);
  EXPECT_NEAR(groups.at->k_phi.value, std::sqrt(loose.k_phi.value * medium.k_phi.value), 1e-3);
  EXPECT_GT(groups.at->exponent.std_error, loose.exponent.std_error / std::sqrt(2.0)) << "and what beds scatter";
  EXPECT_EQ(report_on(groups, "beds.csv").data()["at_density"]["modulus"]["value"], groups.at->k_phi.value);
}

TEST(PlateGroups, AreToldAsTheBedsOfASoil) {
  const PlateGroups groups = fit_groups(beds({1400, 1500, 1600}), {.by = "bed"});
  EXPECT_THAT(
      text_of(report_on(groups, "beds.csv")),
      AllOf(HasSubstr("n goes as its power -4.0"), HasSubstr("beds:\n  - density: 1400 kg/m^3\n    exponent: {")));
  const PlateGroups asked = fit_groups(beds({1400, 1500, 1600}), {.by = "bed", .density = 1450});
  EXPECT_THAT(text_of(report_on(asked, "beds.csv")), AllOf(HasSubstr("For a soil file, at 1450 kg/m^3"),
                                                           HasSubstr("--density 1450kg/m^3; presumed: one size")));
}

TEST(PlateGroups, ADensityBeyondTheBedsIsDoubted) {
  const PlateGroups groups = fit_groups(beds({1400, 1500, 1600}), {.by = "bed", .density = 1700});
  EXPECT_THAT(doubts(groups),
              testing::Contains(test::tells(DoubtKind::beyond_densities_of_plates, {1700, 1400, 1600})));
}

TEST(PlateGroups, TwoDensitiesMakeBedsAndNoTrend) {
  const PlateGroups two = fit_groups(beds({1400, 1600}), {.by = "bed", .density = 1500});
  EXPECT_FALSE(two.trend);
  EXPECT_TRUE(two.at);
  EXPECT_THAT(refusal([] { fit_groups(beds({1400}), {.by = "bed", .density = 1500}); }),
              StartsWith("--density: these tests are no beds of several densities"));
  EXPECT_THAT(refusal([] {
                fit_groups(beds({1400, 1600}), {.by = "bad"});
              }),
              AllOf(StartsWith("--by: beds.csv has no column 'bad'"), HasSubstr("did you mean 'bed'?")));
}

const std::string cullinan = SOILBIN_SOURCE_DIR "/cases/measured/cullinan/";

// Five preparations of one sand: the denser, the smaller n; the pressure grows faster with depth than a power in the
// loose beds, and slower in the densest, whose holds give a k_u some ten times its secant of 12 MN/m^3.
TEST(PlateGroups, CullinanSandIsNoSinglePowerLaw) {
  const PlateGroups groups =
      fit_groups(read_source_text(cullinan + "plates.csv", largest_plate_csv), {.by = "preparation"});
  ASSERT_EQ(groups.all.size(), 5u);
  for (std::size_t i = 1; i < groups.all.size(); ++i)
    EXPECT_LT(groups.all[i].fit.exponent.estimate.value, groups.all[i - 1].fit.exponent.estimate.value);
  EXPECT_TRUE(tell_of(doubts(groups.all.front().fit), DoubtKind::curve_stiffens));
  EXPECT_TRUE(tell_of(doubts(groups.all.back().fit), DoubtKind::curve_flattens));
  int stops = 0;
  for (const PlateReadingsAside& one : groups.all.back().fit.aside)
    if (const std::optional<double>& k_u = one.readings.unloading_stiffness) {
      EXPECT_GT(*k_u, 50e6);
      EXPECT_LT(*k_u, 300e6);
      ++stops;
    }
  EXPECT_GE(stops, 2);
  ASSERT_TRUE(groups.trend);
  EXPECT_EQ(groups.trend->densities, 3u);
}

/// A number as a file holds it: to half of its last digit, of the sd's second one.
void expect_in_file(const Estimate& file, const Estimate& fit, const char* what) {
  EXPECT_NEAR(file.value, fit.value, 0.05 * file.std_error) << what;
  EXPECT_NEAR(file.std_error, fit.std_error, 0.05 * file.std_error) << what;
}

// The library's soil is what the commands in its file give.
TEST(PlateGroups, TheLibrarysCullinanSandIsItsFits) {
  const MeasuredShearFit sheared =
      fit_measured_shear(read_shear(read_source_text(cullinan + "shear.csv", largest_plate_csv)));
  ASSERT_TRUE(sheared.one_stress);
  const PlateGroups groups =
      fit_groups(read_source_text(cullinan + "plates.csv", largest_plate_csv), {.by = "preparation"});
  const std::vector<SemiEmpiricalSoil> known = read_soil(SOILBIN_SOURCE_DIR "/cases/soils/cullinan-sand.yaml").beds;
  ASSERT_EQ(known.size(), 3U);
  ASSERT_EQ(groups.beds.size(), 3U);
  for (std::size_t i = 0; i < known.size(); ++i) {
    EXPECT_EQ(known[i].density, groups.beds[i].density);
    expect_in_file(known[i].exponent, groups.beds[i].exponent, "n");
    expect_in_file(known[i].k_phi, groups.beds[i].k_phi, "k");
    EXPECT_NEAR(*known[i].reference_sinkage, *groups.beds[i].reference_sinkage, 1e-4);
    expect_in_file(known[i].friction_angle, sheared.friction_angle, "phi");
    expect_in_file(known[i].shear_modulus, sheared.shear_modulus, "K");
  }
}

}  // namespace
}  // namespace soilbin::compare
