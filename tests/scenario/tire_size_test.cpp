// Sizes of tires: what they tell, what is assumed and told, and what is no size.
#include "scenario/tire_size.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "scenario/case.hpp"
#include "tests/scenario/fake_vocabulary.hpp"
#include "tests/scenario/refusal.hpp"

namespace soilbin {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

Library sized_library() { return Library({std::filesystem::path(SOILBIN_SOURCE_DIR) / "cases"}); }

struct ToldSize {
  const char* size;
  double radius, width;  ///< [mm]
};

TEST(TireSize, TellsRadiusAndWidth) {
  const std::vector<ToldSize> all = {
      {"600/65R28", 14 * 25.4 + 0.65 * 600, 600},        // mm, %, in
      {"385/65R22.5", 11.25 * 25.4 + 0.65 * 385, 385},   //
      {"710/45-26.5", 13.25 * 25.4 + 0.45 * 710, 710},   // crossed plies
      {"IF 600/70 R 30", 15 * 25.4 + 0.70 * 600, 600},   // more deflection
      {"vf710/60r42 161D", 21 * 25.4 + 0.6 * 710, 710},  // with a service description
      {"205/55ZR16", 8 * 25.4 + 0.55 * 205, 205},        //
      {"12.5/80-18", 9 * 25.4 + 0.8 * 12.5 * 25.4, 12.5 * 25.4},
      {"66x43.00-25", 33 * 25.4, 43 * 25.4},
  };
  for (const ToldSize& told : all) {
    SCOPED_TRACE(told.size);
    const auto tire = tire_of_size(told.size);
    ASSERT_TRUE(tire);
    EXPECT_NEAR(1000 * tire->radius, told.radius, 1e-9);
    EXPECT_NEAR(1000 * tire->width, told.width, 1e-9);
    EXPECT_FALSE(is_lugged(*tire));
    EXPECT_FALSE(tire->inflation_pressure);
    EXPECT_THAT(tire->source, AllOf(testing::StartsWith(std::string(by_size_alone)), Not(HasSubstr("assumed"))));
  }
  EXPECT_EQ(tire_of_size("IF 600/70 R 30")->name, "IF600/70R30");
}

TEST(TireSize, TellsHowThePliesRun) {
  for (const char* radial : {"600/65R28", "205/55ZR16", "16.00R20"})
    EXPECT_EQ(tire_of_size(radial)->construction, Construction::radial) << radial;
  for (const char* crossed : {"18.4-38", "710/45-26.5", "8.25D15", "66x43.00-25"})
    EXPECT_EQ(tire_of_size(crossed)->construction, Construction::bias_ply) << crossed;
}

// Sizes in inches tell no height of the sides: what is taken is said, and is near what tires of such sizes measure:
// the 14.00R20 of Project Chrono 1258 mm, data sheets of earthmovers' tires 1276 (12.00R24) and, with a tread that is
// 50 mm deeper than others', 1666 mm (23.5R25).
TEST(TireSize, SaysWhatItAssumes) {
  EXPECT_NEAR(*tire_of_size("20.8-38")->section_height, 0.85 * 20.8 * 0.0254, 1e-12);
  EXPECT_NEAR(tire_of_size("20.8-38")->radius, 19 * 0.0254 + 0.85 * 20.8 * 0.0254, 1e-12);
  EXPECT_THAT(tire_of_size("20.8-38")->source, HasSubstr("sides of 85 % of that (assumed: the size tells none)"));
  EXPECT_THAT(tire_of_size("12.00R24")->source, HasSubstr("sides of 105 % of that (assumed"));
  EXPECT_THAT(tire_of_size("185R14")->source, HasSubstr("sides of 82 % of that (assumed"));
  EXPECT_NEAR(tire_of_size("14.00R20")->radius, 1.258 / 2, 0.01 * 0.629);
  EXPECT_NEAR(tire_of_size("12.00R24")->radius, 1.276 / 2, 0.03 * 0.638);
  EXPECT_NEAR(tire_of_size("23.5R25")->radius, (1.666 - 0.1) / 2, 0.06 * 0.8);
}

TEST(TireSize, AStoredOneGoesFirst) {
  EXPECT_EQ(library_name_of_size("600/65 r28"), "600-65R28");
  for (const char* size : {"16.00R20", "16.00r20", "600/65R28", "18.4-38"}) {
    const Tire tire = find_tire(size, sized_library());
    EXPECT_TRUE(is_lugged(tire)) << size;
    EXPECT_THAT(tire.source, Not(HasSubstr(std::string(by_size_alone))));
  }
  EXPECT_EQ(find_tire("600/70R28", sized_library()).name, "600/70R28");
  const Case asked = parse_case({"a.yaml",
                                 "format: soilbin-case/1\nname: a\ntire: 480/70R34\nsoil: dry-sand\n"
                                 "study: {conditions: {load: 4 kN, slip: 20 %}}\n"},
                                sized_library(), test::FakeVocabulary());
  EXPECT_NEAR(asked.scenario.tire.radius, 17 * 0.0254 + 0.7 * 0.48, 1e-12);
}

// One sign less or more is another tire by its size: who meant the one that is stored reads of it.
TEST(TireSize, NamesAStoredOneOfNearlyItsSize) {
  for (const char* size : {"14.00R21", "14R20", "14.00-20"})
    EXPECT_THAT(find_tire(size, sized_library()).source, HasSubstr("; nearly this size in the library: 14.00R20"))
        << size;
  EXPECT_THAT(find_tire("18.4R38", sized_library()).source, HasSubstr("nearly this size in the library: 18.4-38"));
  for (const char* size : {"12.00R20", "14.00R24", "540/65R30"})
    EXPECT_THAT(find_tire(size, sized_library()).source, Not(HasSubstr("nearly"))) << size;
  EXPECT_TRUE(nearly_same_size("14R20", "14.00-21"));
  EXPECT_FALSE(nearly_same_size("14R20", "14/80R20")) << "sides of another height";
  EXPECT_FALSE(nearly_same_size("14R20", "rover-wheel"));
}

TEST(TireSize, RefusesWhatNoTireHas) {
  const std::vector<std::pair<const char*, const char*>> wrong = {
      {"600/650R28", "sides of 650 % of the width is not from 20 to 110"},
      {"600/65R280", "a rim of 280 in is not from 4 to 63 in"},
      {"6000/65R28", "a width of 6000 mm is not from 100 to 1500 mm"},
      {"600/65", "it is read as width"},
      {"600/65R", "it is read as width"},
      {"18.4-", "it is read as width"},
      {"30.5L-32", "it is read as width"},
      {"18..4-38", "it is read as width"},
      {"20x43.00-25", "an outer diameter of 20 in"},
  };
  for (const auto& [size, why] : wrong)
    EXPECT_THAT(test::refusal([&, size = size] { find_tire(size, sized_library()); }),
                AllOf(HasSubstr(std::string("tire size '") + size), HasSubstr(why),
                      HasSubstr("hint: such as 600/65R28 (mm, %, in), 18.4-38 or 16.00R20")));
  EXPECT_THAT(test::refusal([] {
                parse_case({"a.yaml", "format: soilbin-case/1\nname: a\ntire: 600/650R28\nsoil: dry-sand\n"},
                           sized_library(), test::FakeVocabulary());
              }),
              AllOf(HasSubstr("a.yaml:3:7: tire size '600/650R28'"), HasSubstr("hint: such as")));
}

TEST(TireSize, IsNoPathAndNoName) {
  for (const char* name :
       {"", "rover-wheel", "paper-lugged", "tires/600.yaml", "./600", "3-wheel", "x600/65R28", "600"})
    EXPECT_FALSE(tire_of_size(name)) << name;
  EXPECT_THAT(test::refusal([] { find_tire("rover-wheeel", sized_library()); }),
              HasSubstr("did you mean 'rover-wheel'?"));
  EXPECT_FALSE(tire_of_size(std::string(5000, '1') + "/65R28"));
}

}  // namespace
}  // namespace soilbin
