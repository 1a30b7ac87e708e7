// A number in a file carries its unit; what is written reads back to the same bits.
#include "scenario/quantity.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <bit>
#include <cmath>
#include <cstdint>
#include <numbers>

#include "tests/scenario/refusal.hpp"

namespace soilbin {
namespace {

using test::refusal;
using testing::AllOf;
using testing::HasSubstr;

using std::numbers::pi;

double si(const std::string& text, const std::string& unit, std::optional<double> n = std::nullopt) {
  return read_quantity(text, {unit, any_value}, n);
}

TEST(Quantity, DecimalUnitsAreReadAsTheNearestDouble) {
  EXPECT_EQ(si("11 mm", "m"), 0.011);
  EXPECT_EQ(si("3.63 kPa", "Pa"), 3630.0);
  EXPECT_EQ(si("31.75 MPa", "Pa"), 31.75e6);
  EXPECT_EQ(si("20 %", "-"), 0.2);
  EXPECT_EQ(si("0.2", "-"), 0.2);
  EXPECT_EQ(si("1600 kg/m^3", "kg/m^3"), 1600.0);
  EXPECT_EQ(si("1.6 g/cm^3", "kg/m^3"), 1600.0);
  EXPECT_EQ(si("4kN", "N"), 4000.0);
  EXPECT_EQ(si("-1.5e-3 m", "m"), -0.0015);
  EXPECT_EQ(si("+.5 m", "m"), 0.5);
}

TEST(Quantity, UnitsWithOtherFactors) {
  EXPECT_DOUBLE_EQ(si("10 rpm", "rad/s"), pi / 3);
  EXPECT_DOUBLE_EQ(si("5 deg", "rad"), pi / 36);
  EXPECT_DOUBLE_EQ(si("36 km/h", "m/s"), 10.0);
  EXPECT_DOUBLE_EQ(si("1 mph", "m/s"), 0.44704);
  EXPECT_DOUBLE_EQ(si("24.7 in", "m"), 24.7 * 0.0254);
  EXPECT_DOUBLE_EQ(si("2006 lbf", "N"), 2006 * 4.4482216152605);
  EXPECT_DOUBLE_EQ(si("0.1 psi", "Pa"), 689.4757293168361);
  EXPECT_DOUBLE_EQ(si("120 N m", "Nm"), 120.0);
  EXPECT_DOUBLE_EQ(si("1 kN*mm", "N m"), 1.0);
  EXPECT_DOUBLE_EQ(si("1065 kJ/m^3", "kPa"), 1065e3);  // an energy density is a pressure
  EXPECT_DOUBLE_EQ(si("0.5 MJ", "J"), 5e5);
  EXPECT_DOUBLE_EQ(si("2 (m/s)^2", "m^2/s^2"), 2.0);
  EXPECT_DOUBLE_EQ(si("7\u00b0", "rad"), 7 * pi / 180);
  EXPECT_DOUBLE_EQ(si("3 cm\u00b2", "m^2"), 3e-4);
}

TEST(Quantity, UnitsOfSinkageModuliDependOnTheExponent) {
  EXPECT_EQ(si("0.99 kN/m^(n+1)", "N/m^(n+1)"), 990.0);
  EXPECT_EQ(si("1528.43 kN/m^(n+2)", "kN/m^(n+2)"), 1528430.0);
  EXPECT_EQ(si("0.99 kN/m^2.1", "kN/m^(n+1)", 1.1), 990.0) << "spelled out at n = 1.1";
  EXPECT_DOUBLE_EQ(si("1 N/mm^(n+1)", "N/m^(n+1)", 1.0), 1e6);
  EXPECT_DOUBLE_EQ(si("1 N/mm^(n+1)", "N/m^(n+1)", 0.5), std::pow(10.0, 4.5));
  EXPECT_THAT(refusal([] { si("1 N/mm^(n+1)", "N/m^(n+1)"); }), HasSubstr("needs the soil's exponent n"));
  EXPECT_THAT(refusal([] { si("0.99 kN/m^(n+2)", "kN/m^(n+1)", 1.1); }), HasSubstr("expected a cohesive modulus"));
  EXPECT_THAT(refusal([] { si("0.99 kN/m^2", "kN/m^(n+1)", 1.1); }), HasSubstr("is a pressure"));
}

// As rigs, papers, handbooks and LaTeX have them.
TEST(Quantity, UnitsOfSinkageModuliAreReadAsPeopleSpellThem) {
  constexpr double n = 1.1, psi = 6894.757293168361, inch = 0.0254, foot = 0.3048;
  for (const char* unit : {"kPa/m^n", "kPa/m^(n)", "kPa/m^{n}", "kPa m^-n", "kN m^-(n+2)", "kN m^(-n-2)", "kN/m^{n+2}",
                           "kN/m\u207f\u207a\u00b2", "kPa/m\u207f", "kN m\u207b\u207f\u207b\u00b2"}) {
    EXPECT_EQ(si(std::string("1500 ") + unit, "kN/m^(n+2)", n), 1.5e6) << unit;
  }
  const auto expect_near = [](double value, double right) { EXPECT_NEAR(value, right, 1e-12 * right); };
  expect_near(si("3 psi/in^n", "kN/m^(n+2)", n), 3 * psi / std::pow(inch, n));
  expect_near(si("3 lb/in^(n+2)", "kN/m^(n+2)", n), 3 * psi / std::pow(inch, n));  // a pound-force
  expect_near(si("3 lb/in^(n+1)", "kN/m^(n+1)", n), 3 * psi / std::pow(inch, n - 1));
  expect_near(si("3 lb/ft^2", "kPa"), 3 * psi * inch * inch / foot / foot);
  expect_near(si("62.4 lb/ft^3", "kg/m^3"), 62.4 * 0.45359237 / std::pow(foot, 3));  // a mass, where one is asked
  EXPECT_DOUBLE_EQ(si("2 m\u00b2", "m^2"), 2.0);
  EXPECT_EQ(si("1600 kg/m3", "kg/m^3"), 1600.0);  // as letters without superscripts have it
  EXPECT_EQ(si("1.6g/cm3", "kg/m^3"), si("1.6 g/cm^3", "kg/m^3"));
  EXPECT_EQ(si("1.62 m/s2", "m/s^2"), 1.62);
  EXPECT_EQ(si("100 kN/m2", "kPa"), 1e5);
  EXPECT_DOUBLE_EQ(si("2 s\u207b\u00b9", "1/s"), 2.0);
}

TEST(Quantity, ARefusalOfAnotherDimensionNamesIt) {
  EXPECT_THAT(refusal([] { si("20 lb/in^(n+3)", "kN/m^(n+2)", 1.1); }),
              HasSubstr("'lb/in^(n+3)' is kg*m^(-3-1*n) in base units"));
  EXPECT_THAT(refusal([] { si("100 J/m^2", "kJ/m^3"); }),
              AllOf(HasSubstr("expected an energy density, such as '20 kJ/m^3'"), HasSubstr("is an energy per area")));
  EXPECT_THAT(refusal([] { si("100 J/m^2", "kPa"); }), HasSubstr("'J/m^2' is an energy per area"));
}

TEST(Quantity, ARefusalSaysWhatWasExpected) {
  EXPECT_EQ(refusal([] { si("0.25", "m"); }), "expected a length, such as '11 mm', not '0.25': it has no unit");
  EXPECT_EQ(refusal([] { si("3 kPa", "m"); }), "expected a length, such as '11 mm', not '3 kPa': 'kPa' is a pressure");
  EXPECT_THAT(refusal([] { si("11 mn", "m"); }), HasSubstr("unknown unit 'mn', did you mean 'm"));
  EXPECT_THAT(refusal([] { si("5 mm", "-"); }), HasSubstr("expected a plain number or a percentage"));
  EXPECT_THAT(refusal([] { si("5 mm", "deg"); }), HasSubstr("expected an angle, such as '5 deg'"));
  EXPECT_THAT(refusal([] { si("20 lb", "N"); }), HasSubstr("a pound-force is written 'lbf'"));
  EXPECT_THAT(refusal([] { si("1,5 m", "m"); }), HasSubstr("a decimal point is '.'"));
}

TEST(Quantity, RubbishIsRefused) {
  for (const char* text :
       {"",        " ",        "mm",      "m 3",   "1 m m m)", "1 m)",      "1 (m",   "1 m^",    "1 m^(n",  "1 m^x",
        "1 m;",    "1 2 m",    "0x10 m",  "--1 m", "1..2 m",   "1e m",      "nan m",  "inf m",   "-inf m",  ".nan",
        "1e999 m", "1e-999 m", "1 m/",    "1 *m",  "1 m^99",   "1 m^(n*n)", "1 m^{n", "1 m^(n}", "1 m^--2", "1 m\u207a",
        "1 m!",    "one m",    "1 m # x", "1 m1",  "1 m20",    "1 m2.5",    "1 m23"})
    EXPECT_THROW(si(text, "m"), InputError) << "'" << text << "'";
  EXPECT_THAT(refusal([] { si("nan", "m"); }), HasSubstr("finite"));
  EXPECT_THROW(si(std::string(100'000, '('), "m"), InputError);
  EXPECT_THROW(si("1 " + std::string(90, '('), "m"), InputError);
  EXPECT_THROW(si(std::string(100'000, '9') + " m", "m"), InputError);
}

TEST(Quantity, ARangeIsTold) {
  const Measure width{"mm", above_zero};
  EXPECT_EQ(refusal([&] { read_quantity("0 mm", width); }), "'0 mm' is out of range: must be above 0 mm");
  const Measure slip{"-", {.lower = -1.0, .upper = 1.0}};
  EXPECT_EQ(refusal([&] { read_quantity("120 %", slip); }), "'120 %' is out of range: must be -1 .. 1");
}

TEST(Quantity, IsWrittenShortest) {
  EXPECT_EQ(write_quantity(0.011, "mm"), "11 mm");
  EXPECT_EQ(write_quantity(3630.0, "kPa"), "3.63 kPa");
  EXPECT_EQ(write_quantity(990.0, "kN/m^(n+1)"), "0.99 kN/m^(n+1)");
  EXPECT_EQ(write_quantity(si("5 deg", "rad"), "deg"), "5 deg");
  EXPECT_EQ(write_quantity(0.2, "-"), "0.2");
  EXPECT_EQ(write_quantity(0.0, "m"), "0 m");
  EXPECT_EQ(write_quantity(-0.0, "m"), "-0 m");
  EXPECT_EQ(write_quantity(1e-300, "m"), "1e-300 m");
}

TEST(Quantity, BaseUnitsAreReadable) {
  for (const char* unit : {"kN/m^(n+1)", "kPa", "rpm", "deg", "kg/m^3", "m^(2*n-1)", "-", "1/s"}) {
    const Unit parsed = parse_unit(unit, 1.1);
    EXPECT_TRUE(same_dimension(parse_unit(base_unit(parsed.dimension)).dimension, parsed.dimension)) << unit;
  }
}

/// Any finite double, by its bits, that is no subnormal (whose decimals may underflow in a smaller unit).
rc::Gen<double> finite_double() {
  return rc::gen::suchThat(
      rc::gen::map(rc::gen::arbitrary<std::uint64_t>(),
                   [](std::uint64_t bits) { return std::bit_cast<double>(bits * 0x9E3779B97F4A7C15ULL); }),
      [](double x) { return std::isfinite(x) && std::abs(x) > 1e-280 && std::abs(x) < 1e280; });
}

TEST(Quantity, WrittenAndReadGivesTheSameBits) {
  EXPECT_TRUE(rc::check("any double in any unit", [] {
    const std::string unit =
        *rc::gen::element<std::string>("mm", "kPa", "deg", "rpm", "%", "-", "kN/m^(n+2)", "km/h", "psi", "N/mm^(n+1)");
    const double n = 0.1 * *rc::gen::inRange(1, 20);
    const double value = *finite_double();
    const double again = read_quantity(write_quantity(value, unit, n), {unit, any_value}, n);
    RC_ASSERT(std::bit_cast<std::uint64_t>(again) == std::bit_cast<std::uint64_t>(value));
  }));
}

TEST(Quantity, ReadingNeverCrashes) {
  EXPECT_TRUE(rc::check("any text is read or refused", [] {
    const auto text = *rc::gen::container<std::string>(
        rc::gen::elementOf(std::string("0123456789.eE+-*/^()n mkNPadgsr%\xc2\xb5\xb0")));
    try {
      RC_ASSERT(std::isfinite(read_quantity(text, {"kPa", any_value}, 1.1)));
    } catch (const InputError& error) {
      RC_ASSERT(std::string(error.what()) != "");
    }
  }));
}

TEST(Quantity, APercentageWithoutItsSignIsGuessed) {
  const Measure slip{"-", {.lower = -1.0, .upper = 1.0}};
  EXPECT_THAT(test::refusal([&] { read_quantity("20", slip); }), testing::HasSubstr("did you mean '20%'?"));
  EXPECT_THAT(test::refusal([&] { read_quantity("2000", slip); }), testing::Not(testing::HasSubstr("did you mean")));
  EXPECT_THAT(test::refusal([&] { read_quantity("-20", slip); }), testing::HasSubstr("did you mean '-20%'?"));
  const Measure poisson_ratio{"-", {.lower = -1.0, .upper = 0.5}};
  EXPECT_THAT(test::refusal([&] { read_quantity("0.6", poisson_ratio); }),
              testing::Not(testing::HasSubstr("did you mean")));
  const Measure exponent{"-", {.lower = 0.05, .upper = 5.0}};
  EXPECT_THAT(test::refusal([&] { read_quantity("9.42", exponent); }), testing::Not(testing::HasSubstr("did you mean")))
      << "no share";
}

// tan 5.7106 deg = 0.1.
TEST(Quantity, AGradeIsToldAsAnAngle) {
  const Measure incline{"deg", any_value};
  EXPECT_THAT(test::refusal([&] { read_quantity("10 %", incline); }),
              testing::HasSubstr("which as a grade is 5.711 deg"));
  EXPECT_THAT(test::refusal([&] { read_quantity("-100%", incline); }), testing::HasSubstr("is -45 deg"));
  for (const auto& [text, unit] : {std::pair{"10", "deg"}, {"10 %", "N"}})
    EXPECT_THAT(test::refusal([&, text = text, unit = unit] {
                  read_quantity(text, {unit, any_value});
                }),
                testing::Not(testing::HasSubstr("grade")));
}

TEST(Quantity, AMisspeltUnitIsFirstComparedWithThoseOfItsDimension) {
  const auto told = [](const char* text, const char* unit) {
    return test::refusal([&] { read_quantity(text, {unit, {}}); });
  };
  EXPECT_THAT(told("18 lbs", "N"), testing::HasSubstr("did you mean 'lbf'?"));
  EXPECT_THAT(told("18 lbs", "kg"), testing::HasSubstr("did you mean 'lb'?"));
  EXPECT_THAT(told("18 kpa", "Pa"), testing::HasSubstr("did you mean 'kPa'?"));
}

}  // namespace
}  // namespace soilbin
