// A tire maker's load-deflection table: how it is read, what is refused in it, and what it says between its rows.
#include "scenario/deflection_table.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "scenario/case.hpp"
#include "tests/scenario/refusal.hpp"

namespace soilbin {
namespace {

namespace fs = std::filesystem;
using test::refusal;
using testing::AllOf;
using testing::HasSubstr;

/// A tire of stiffness K_0 + K_1 p, measured at some loads and pressures.
constexpr double k_0 = 100e3, k_1 = 1.5;
double made(double load, double pressure) { return load / (k_0 + k_1 * pressure); }

DeflectionTable made_table() {
  DeflectionTable table{"made", {}};
  for (const double pressure : {300e3, 100e3, 200e3})
    for (const double load : {20e3, 5e3, 10e3}) table.rows.push_back({load, pressure, made(load, pressure)});
  return table;
}

// Interpolated stiffness meets a tire of that law exactly, at the rows, between them and down to no load.
TEST(DeflectionTable, MeetsALinearTireBetweenItsRows) {
  const DeflectionTable table = made_table();
  for (const double load : {1.0, 5e3, 7.5e3, 20e3})
    for (const double pressure : {100e3, 120e3, 200e3, 287e3, 300e3})
      EXPECT_NEAR(deflection_of(table, load, pressure), made(load, pressure), 1e-12 * made(load, pressure));
}

// Beyond the rows the edge's stiffness holds.
TEST(DeflectionTable, KeepsTheStiffnessOfItsEdge) {
  const DeflectionTable table = made_table();
  EXPECT_DOUBLE_EQ(deflection_of(table, 40e3, 150e3), 40e3 / (k_0 + k_1 * 150e3));
  EXPECT_DOUBLE_EQ(deflection_of(table, 10e3, 900e3), made(10e3, 300e3));
  EXPECT_DOUBLE_EQ(deflection_of(table, 10e3, 0.0), made(10e3, 100e3));
  for (const auto& [load, pressure] : {std::pair{4e3, 150e3}, {21e3, 150e3}, {10e3, 99e3}, {10e3, 301e3}})
    EXPECT_FALSE(covers(table, load, pressure));
  for (const auto& [load, pressure] : {std::pair{5e3, 100e3}, {20e3, 300e3}, {11e3, 250e3}})
    EXPECT_TRUE(covers(table, load, pressure));
  EXPECT_EQ(in_words(table), "9 rows, 5 .. 20 kN, 100 .. 300 kPa");
}

// A row's rise from the one before: more load, more deflection, however uneven the rows.
TEST(DeflectionTable, RisesWithTheLoad) {
  const DeflectionTable table{"", {{1e3, 1e5, 0.010}, {2e3, 1e5, 0.011}, {9e3, 1e5, 0.030}}};
  double before = 0.0;
  for (int i = 1; i <= 200; ++i) {
    const double f = deflection_of(table, 50.0 * i, 1e5);
    EXPECT_GT(f, before);
    before = f;
  }
}

class TireFile : public testing::Test {
 protected:
  TireFile() { fs::create_directories(folder_); }
  ~TireFile() override { fs::remove_all(folder_); }
  const fs::path& folder() const { return folder_; }
  void write(const std::string& name, const std::string& text) const { std::ofstream(folder_ / name) << text; }
  Tire read(const std::string& table) const {
    write("table.csv", table);
    write("tire.yaml", "format: soilbin-tire/1\nradius: 600 mm\nwidth: 400 mm\ndeflection: table.csv\n");
    return read_tire(folder_ / "tire.yaml");
  }

 private:
  fs::path folder_ = fs::path(testing::TempDir()) /  // two tests may run at once
                     (std::string("deflection-table-") + testing::UnitTest::GetInstance()->current_test_info()->name());
};

TEST_F(TireFile, NamesATable) {
  const Tire tire = read("load_kN,pressure_bar,deflection_mm\n10,1.5,25\n20,1.5,50\n");
  ASSERT_TRUE(tire.deflection);
  EXPECT_EQ(tire.deflection->source, "table.csv");
  EXPECT_EQ(tire.deflection->rows.size(), 2U);
  EXPECT_DOUBLE_EQ(deflection_of(*tire.deflection, 15e3, 150e3), 0.0375);
  EXPECT_THAT(in_words(tire), HasSubstr("load-deflection table of 2 rows"));
  const Tire other = read("deflection [in];load [lbf];pressure (psi)\n1,5;2000;20\n");
  EXPECT_DOUBLE_EQ(other.deflection->rows.front().deflection, 0.0381);
}

TEST_F(TireFile, RefusesWhatIsNoTable) {
  const std::pair<const char*, std::vector<const char*>> wrong[] = {
      {"load_kN,pressure_kPa\n1,1\n", {"table.csv:1:1", "no column 'deflection'", "such as 'deflection_mm'"}},
      {"load_kN,pressure,deflection_mm\n1,1,1\n", {"column 'pressure': expected a pressure", "'pressure_kPa'"}},
      {"load_mm,pressure_kPa,deflection_mm\n1,1,1\n", {"column 'load_mm': expected a force"}},
      {"load_kN,pressure_kPa,deflection_mm,area_m2\n1,1,1,1\n", {"column 'area_m2' is not read here"}},
      {"load_kN,pressure_kPa,deflection_mm\n1,1,much\n", {"table.csv:2:5", "expected a finite number"}},
      {"load_kN,pressure_kPa,deflection_mm\n-1,1,1\n", {"table.csv:2:1", "above 0 kN"}},
      {"load_kN,pressure_kPa,deflection_mm\n1,1,700\n", {"700 mm under 1 kN at 1 kPa: more than its radius"}},
      {"load_kN,pressure_kPa,deflection_mm\n1,1,2\n2,1,2\n", {"a larger load deflects it more"}},
      {"load_kN,pressure_kPa,deflection_mm\n1,1,2\n1,2,3\n", {"a higher pressure deflects it less"}},
      {"load_kN,pressure_kPa,deflection_mm\n1,1,2\n1,1,2\n", {"two rows of one load and pressure"}},
      {"load_kN,pressure_kPa,deflection_mm\n", {"a load-deflection table needs a row"}}};
  for (const auto& [table, says] : wrong) {
    const std::string why = refusal([&] { read(table); });
    for (const char* part : says) EXPECT_THAT(why, HasSubstr(part)) << table;
  }
  write("lost.yaml", "format: soilbin-tire/1\nradius: 600 mm\nwidth: 400 mm\ndeflection: no.csv\n");
  EXPECT_THAT(refusal([&] { read_tire(folder() / "lost.yaml"); }),
              AllOf(HasSubstr("no such file: 'no.csv'"), HasSubstr("lost.yaml:4")));
}

}  // namespace
}  // namespace soilbin
