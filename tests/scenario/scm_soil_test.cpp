// Soils as Chrono's SCM terrain has them: its own example is read, and what is missing or wrong is said with its place.
#include "scenario/scm_soil.hpp"

#include <gmock/gmock.h>

#include <numbers>

#include "scenario/case.hpp"
#include "scenario/errors.hpp"
#include "scenario/soil_parameters.hpp"
#include "tests/scenario/refusal.hpp"

namespace soilbin::test {
namespace {

using testing::AllOf;
using testing::HasSubstr;

/// In the layout of the examples of Chrono's co-simulation, with its comment.
const std::string scm_example = R"(// a terrain
{
  "Type": "SCM",
  "Patch dimensions": {"Length": 4, "Width": 1},
  "Grid spacing": 0.05,
  "Soil parameters": {
    "Bekker Kphi": 2e6, "Bekker Kc": 1500, "Bekker n exponent": 1.1,
    "Mohr cohesive limit": 250, "Mohr friction limit": 30, "Janosi shear coefficient": 0.01,
    "Elastic stiffness": 4e7, "Damping": 3e4
  },
  "Simulation settings": {"Proxy contact radius": 0.002, "Fix proxies": true}
}
)";

std::string scm_with(const std::string& from, const std::string& to) {
  std::string text = scm_example;
  return text.replace(text.find(from), from.size(), to);
}

std::string said_of(const std::string& text) {
  return test::refusal([&] { parse_soil({"scm.json", text}); });
}

TEST(ScmSoil, ReadsChronosOwnExampleInSi) {
  const Soil soil = parse_soil({"there/scm.json", scm_example});
  EXPECT_EQ(soil.name, "scm");
  const SemiEmpiricalSoil& semi = *soil.semi_empirical;
  EXPECT_EQ(semi.k_phi.value, 2e6);
  EXPECT_EQ(semi.k_c.value, 1500.0);
  EXPECT_EQ(semi.exponent.value, 1.1);
  EXPECT_EQ(semi.cohesion.value, 250.0);
  EXPECT_NEAR(semi.friction_angle.value, std::numbers::pi / 6, 1e-15);
  EXPECT_EQ(semi.shear_modulus.value, 0.01);
  for (const SoilParameter& p : bevameter_parameters) EXPECT_EQ((semi.*p.value).std_error, 0.0) << p.name;
  EXPECT_EQ(semi.stress_angle_c1.std_error, usual_stress_angle_c1.std_error);
  EXPECT_EQ(semi.sources.at("stress_angle_c1"), usual_stress_angle_source);
}

TEST(ScmSoil, SaysEverythingThatIsMissing) {
  EXPECT_THAT(said_of(scm_with("\"Bekker Kc\": 1500, ", "")),
              AllOf(HasSubstr("scm.json:6"), HasSubstr("lacks Bekker Kc"), HasSubstr("Kc in N/m^(n+1)")));
  EXPECT_THAT(said_of(scm_with("\"Soil parameters\"", "\"Soil\"")), HasSubstr("no section 'Soil parameters'"));
  EXPECT_THAT(said_of("[1]"), HasSubstr("no section 'Soil parameters'"));
}

TEST(ScmSoil, SaysWhatIsWrongAndWhere) {
  EXPECT_THAT(said_of(scm_with("1500", "\"1500\"")), AllOf(HasSubstr("scm.json:7"), HasSubstr("expected a number")));
  EXPECT_THAT(said_of(scm_with(": 30", ": 95")),
              AllOf(HasSubstr("scm.json:8"), HasSubstr("Mohr friction limit' is 95")));
  EXPECT_THAT(said_of(scm_with(": 250", ": 1e999")), HasSubstr("a number that is too large"));
  EXPECT_THAT(said_of(scm_with(": 250", ": -250")), HasSubstr("'Mohr cohesive limit' is -250"));
  EXPECT_THAT(said_of(scm_with("\"Type\": \"SCM\",", "\"Type\" \"SCM\",")),
              AllOf(HasSubstr("scm.json:3"), HasSubstr("no JSON")));
  EXPECT_THAT(said_of(scm_with("\"Type\": \"SCM\",", R"("soilbin": {"sd": {"Bekker Kc": -1}},)")),
              HasSubstr("below 0"));
}

TEST(ScmSoil, TakesAStiffnessThatScmKeeps) {
  SemiEmpiricalSoil soft;
  soft.k_phi.value = 1e5;
  EXPECT_EQ(scm_choices(soft).elastic_stiffness, 5e7);
  soft.k_phi.value = 2e7;
  EXPECT_EQ(scm_choices(soft).elastic_stiffness, 4e8) << "above Kphi, or SCM takes that";
}

TEST(ScmSoil, IsToldFromOtherJsonByItsSection) {
  EXPECT_TRUE(names_json("a/b.JSON"));
  EXPECT_FALSE(names_json("soil.yaml"));
  EXPECT_FALSE(is_scm_soil("there-is-no-such-file.json"));
}

}  // namespace
}  // namespace soilbin::test
