// Plates of several beds in one file: each fitted apart, and what they give at a density that no bed had.

#include "compare/bevameter/plate_groups.hpp"

#include <fmt/core.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "bekker_wong/gsl.hpp"
#include "compare/bevameter/measured_shear.hpp"
#include "compare/doubt_matchers.hpp"
#include "compare/doubts/plate_doubts.hpp"
#include "compare/report/json_fields.hpp"
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
  const Estimate at = power.at(1.1);
  EXPECT_NEAR(at.value, 3 * std::pow(1.1, 5), 1e-10);
  EXPECT_NEAR(at.std_error / at.value, 0.06 * std::sqrt(1.0 / 3 + 0.5), 1e-10);
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

TEST(PlateGroups, ABedBetweenTheDensitiesIsFoundByTheirPowers) {
  const PlateGroups groups = fit_groups(beds({1400, 1500, 1600}), {.by = "dry_density_kg/m^3", .density = 1450});
  ASSERT_TRUE(groups.at);
  const double r = 1450.0 / 1500, n = 0.6 * std::pow(r, -4);
  EXPECT_NEAR(groups.at->exponent.value, n, 1e-4);
  EXPECT_NEAR(groups.at->modulus.value, 200e3 * std::pow(r, 6) * std::pow(0.05, -n), 1e2);
  EXPECT_THAT(text_of(report_on(groups, "beds.csv")),
              AllOf(HasSubstr("n goes as its power -4.0"), HasSubstr("For a soil file, at 1450 kg/m^3"),
                    HasSubstr("--density 1450kg/m^3; b = 50 mm")));
  EXPECT_EQ(report_on(groups, "beds.csv").data()["at_density"]["dry_density"], 1450);
}

TEST(PlateGroups, ADensityBeyondTheBedsIsDoubted) {
  const PlateGroups groups = fit_groups(beds({1400, 1500, 1600}), {.by = "bed", .density = 1700});
  EXPECT_THAT(doubts(groups),
              testing::Contains(test::tells(DoubtKind::beyond_densities_of_plates, {1700, 1400, 1600})));
}

TEST(PlateGroups, TwoDensitiesMakeNoTrend) {
  EXPECT_FALSE(fit_groups(beds({1400, 1600}), {.by = "bed"}).trend);
  EXPECT_THAT(refusal([] {
                fit_groups(beds({1400, 1600}), {.by = "bed", .density = 1500});
              }),
              StartsWith("--density: these tests give no trend over the density"));
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

// The soils of the library are what the commands in their files give.
TEST(PlateGroups, TheLibrarysSoilsOfCullinanSandAreTheirFits) {
  const MeasuredShearFit sheared =
      fit_measured_shear(read_shear(read_source_text(cullinan + "shear.csv", largest_plate_csv)));
  ASSERT_TRUE(sheared.one_stress);
  const PlateGroups groups =
      fit_groups(read_source_text(cullinan + "plates.csv", largest_plate_csv), {.by = "preparation"});
  int soils = 0;
  for (const PlateGroup& group : groups.all) {
    if (!group.density) continue;
    const SemiEmpiricalSoil soil =
        *read_soil(fmt::format("{}/cases/soils/cullinan-sand-{:g}.yaml", SOILBIN_SOURCE_DIR, *group.density))
             .semi_empirical;
    EXPECT_EQ(soil.density, group.density);
    expect_in_file(soil.exponent, group.fit.exponent.estimate, "n");
    expect_in_file(soil.k_phi, group.fit.k_phi.estimate, "k");
    expect_in_file(soil.friction_angle, sheared.friction_angle, "phi");
    expect_in_file(soil.shear_modulus, sheared.shear_modulus, "K");
    ++soils;
  }
  EXPECT_EQ(soils, 3);
}

}  // namespace
}  // namespace soilbin::compare
