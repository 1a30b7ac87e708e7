// The tables of soil parameters and traction channels: their units, ranges and names hold in the files made by them.
#include <fmt/core.h>
#include <gtest/gtest.h>

#include <cmath>

#include "scenario/case.hpp"
#include "scenario/description.hpp"
#include "scenario/soil_parameters.hpp"
#include "scenario/traction_channels.hpp"
#include "tests/scenario/refusal.hpp"

namespace soilbin {
namespace {

using test::refusal;

Soil plain_soil() {
  Soil soil;
  soil.semi_empirical = SemiEmpiricalSoil{};
  for (const SoilParameter& p : soil_parameters) (*soil.semi_empirical).*p.value = {0.5, 0.0};
  return soil;
}

Soil soil_with(const SoilParameter& parameter, double value) {
  Soil soil = plain_soil();
  ((*soil.semi_empirical).*parameter.value).value = value;
  return soil;
}

double read_back(const Soil& soil, const SoilParameter& parameter) {
  const Soil again = parse_soil(make_source_text(write_soil(soil), "soil.yaml"));
  return ((*again.semi_empirical).*parameter.value).value;
}

TEST(SoilParameters, AreTheKeysOfASoil) {
  std::vector<std::string> names;
  for (const SoilParameter& p : soil_parameters) names.emplace_back(p.name);
  names.insert(names.begin() + 1, "assumed_sd");
  for (const ExactSoilValue& exact : exact_soil_values) names.emplace_back(exact.name);
  EXPECT_EQ(keys_of<SemiEmpiricalSoil>(), names);
  EXPECT_EQ(&soil_parameter("k_phi"), &soil_parameters[2]);
  EXPECT_THROW(soil_parameter("k"), std::out_of_range);
}

TEST(SoilParameters, UnitsPerSiAreThoseOfTheirUnit) {
  for (const SoilParameter& p : soil_parameters) {
    const std::string one = p.measure().unit == "-" ? "1" : fmt::format("1 {}", p.unit);
    EXPECT_NEAR(p.per_si * read_quantity(one, {p.unit, any_value}, 1.1), 1.0, 1e-15) << p.name;
  }
}

// A bound of the table is a bound of the files: itself admissible unless open, and nothing beyond it.
TEST(SoilParameters, RangesAreWhatFilesHold) {
  for (const SoilParameter& p : soil_parameters) {
    const auto check = [&](double bound, bool open, double beyond) {
      if (!std::isfinite(bound)) return;
      if (open)
        EXPECT_NE(refusal([&] { read_back(soil_with(p, bound), p); }), "") << p.name;
      else
        EXPECT_EQ(read_back(soil_with(p, bound), p), bound) << p.name;
      EXPECT_NE(refusal([&] { read_back(soil_with(p, beyond), p); }), "") << p.name;
    };
    check(p.range.lower, p.range.lower_open, p.range.lower - 1e-6);
    check(p.range.upper, p.range.upper_open, p.range.upper + 1e-6);
  }
}

TEST(Neighbours, StayInTheRange) {
  constexpr Range closed{.lower = 0.0, .upper = 1.0}, open{.lower = 0.0, .lower_open = true};
  const auto both = [](double x, double step, const Range& range) {
    const Neighbours n = neighbours(x, step, range);
    return std::pair(n.below, n.above);
  };
  EXPECT_EQ(both(0.5, 0.25, closed), std::pair(0.25, 0.75));
  EXPECT_EQ(both(0.0, 0.25, closed), std::pair(0.0, 0.25));
  EXPECT_EQ(both(0.125, 0.25, closed), std::pair(0.0, 0.375)) << "on the bound";
  EXPECT_EQ(both(1.0, 0.25, closed), std::pair(0.75, 1.0));
  EXPECT_EQ(both(0.125, 0.25, open), std::pair(0.125, 0.375)) << "the bound itself is not admissible";
}

TEST(TractionChannels, UnitsAgree) {
  for (const TractionChannel& channel : traction_channels) {
    const double si = read_quantity(fmt::format("1 {}", channel.unit), {channel.si_unit, any_value});
    EXPECT_NEAR(channel.per_si * si, 1.0, 1e-15) << channel.name;
    EXPECT_EQ(parse_unit(channel.si_unit).decimal, 0) << channel.name << ": files are in SI";
  }
}

TEST(TractionChannels, NameTheColumnsOfFiles) {
  std::string columns;
  for (const TractionChannel& channel : traction_channels) columns += column_of(channel) + " ";
  EXPECT_EQ(columns, "drawbar_pull_N torque_Nm sinkage_m lateral_force_N ");
  EXPECT_EQ(column_of(traction_channels[1], "se"), "torque_se_Nm");
}

}  // namespace
}  // namespace soilbin
