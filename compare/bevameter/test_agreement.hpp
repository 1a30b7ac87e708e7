// Whether plate tests on one soil agree with each other: which of them bears so much more or less than the others do
// that it was made on another soil, or is written in another unit.
//
//   const std::vector<TestLevel> levels = {{0.05, std::log(9e5)}, {0.05, std::log(9.2e5)}, {0.05, std::log(9e6)}};
//   for (const TestApart& one : tests_apart(levels, 1.0)) one.test, one.factor;  // the third: 10
//
// Each test's ln k (at the n of all) is held against those of the others: their mean, and a slope over ln b that
// Bekker's form makes -1 to 0. What remains scatters by a standard deviation that is known from the tests and, as much
// as four more tests would tell, from what re-tests scatter (a moderated t: Smyth 2004, Stat. Appl. Genet. Mol. Biol.
// 3:3).
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

namespace soilbin::compare {

/// Of one test.
struct TestLevel {
  double radius = 0.0;      ///< b [m]
  double ln_modulus = 0.0;  ///< ln k at the n of all tests [ln N/m^(n+2)]
};

/// A test that bears other pressures than the others let expect.
struct TestApart {
  std::size_t test = 0;    ///< its place among those given
  double factor = 1.0;     ///< its pressures over those that the others let expect at the same sinkage [-]
  bool set_aside = false;  ///< noise does not put it there: chance below thresholds::outlier_level over their number
  std::string unit{};  ///< what its numbers would be in, if a unit explains it: "its sinkage in cm for mm"; else empty
};

/// Those that are apart, the farthest first; n: their common exponent. Set aside are no more than a quarter of the
/// tests (one of three), and never the only two.
std::vector<TestApart> tests_apart(std::span<const TestLevel> tests, double n);

}  // namespace soilbin::compare
