// What a case file may say, and what each mistake in it is answered with.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "scenario/case.hpp"
#include "scenario/fitted_errors.hpp"
#include "scenario/unit.hpp"
#include "tests/scenario/fake_vocabulary.hpp"
#include "tests/scenario/refusal.hpp"

namespace soilbin {
namespace {

using test::FakeVocabulary;
using test::refusal;
using testing::AllOf;
using testing::HasSubstr;
using testing::StartsWith;

const std::string good = R"(format: soilbin-case/1
name: example
tire:
  radius: 250 mm
  width: 100 mm
  lugs: {height: 8 mm, count: 24, pattern: chevron}
soil:
  moisture: 3.81 %
  semi_empirical:
    exponent: {value: 1.1, sd: 0.05, source: plates}
    k_c: 0.99 kN/m^(n+1)
    k_phi: {value: 1528 kN/m^(n+2), sd: 150 kN/m^(n+2)}
    cohesion: 1.04 kPa
    friction_angle: 28 deg
    shear_modulus: 20 mm
    stress_angle_c1: 18 %
    stress_angle_c2: 0.32
bin: {depth: 0.5 m, width: 1 m}
study:
  models:
    - bekker_wong
    - model: bekker_wong
      label: dug in
      effects:
        - slip_sinkage
        - {id: lug_thrust, form: blade, parameters: {angle: 20 deg}}
  conditions:
    load: 2 kN
    slip: [0, 20 %]
)";

Case parse(const std::string& text) {
  return parse_case(make_source_text(text, "case.yaml"), Library({SOILBIN_SOURCE_DIR "/cases"}), FakeVocabulary());
}

std::string refused(const std::string& text) {
  return refusal([&] { parse(text); });
}

/// The good case with one piece of its text replaced.
std::string with(const std::string& old_text, const std::string& new_text) {
  std::string text = good;
  const std::size_t at = text.find(old_text);
  if (at == std::string::npos) ADD_FAILURE() << "no '" << old_text << "' in the example";
  return text.replace(at, old_text.size(), new_text);
}

TEST(CaseReader, ReadsEveryPartInSi) {
  const Case c = parse(good);
  EXPECT_EQ(c.name, "example");
  EXPECT_EQ(c.scenario.tire.radius, 0.25);
  EXPECT_EQ(c.scenario.tire.lugs.count, 24);
  EXPECT_EQ(c.scenario.tire.lugs.pattern, LugPattern::chevron);
  EXPECT_EQ(c.scenario.soil.moisture, 0.0381);
  const SemiEmpiricalSoil& soil = *c.scenario.soil.semi_empirical;
  EXPECT_EQ(soil.exponent.std_error, 0.05);
  EXPECT_EQ(soil.sources.at("exponent"), "plates");
  EXPECT_EQ(soil.k_c.value, 990.0);
  EXPECT_EQ(soil.k_phi.std_error, 150e3);
  EXPECT_DOUBLE_EQ(soil.friction_angle.value, 28 * degree);
  EXPECT_EQ(soil.stress_angle_c1.value, 0.18);
  EXPECT_FALSE(soil.density);
  EXPECT_EQ(bulk_density(soil), presumed_bulk_density);
  EXPECT_EQ(c.scenario.bin->depth, 0.5);
  ASSERT_EQ(c.study.conditions.size(), 2u);
  EXPECT_EQ(c.study.conditions[1].slip, 0.2);
  EXPECT_EQ(c.study.conditions[1].load, 2000.0);
}

// An assumption for values whose source gives no standard deviation: said once, below an sd that is written.
TEST(CaseReader, AnAssumedDeviationHoldsForValuesWithoutTheirOwn) {
  const Case c = parse(with("    k_c: 0.99", "    assumed_sd: 10 %\n    k_c: 0.99"));
  const SemiEmpiricalSoil& soil = *c.scenario.soil.semi_empirical;
  EXPECT_EQ(soil.assumed_sd, 0.1);
  EXPECT_EQ(soil.k_c.std_error, 0.1 * 990.0);
  EXPECT_EQ(soil.friction_angle.std_error, 0.1 * soil.friction_angle.value);
  EXPECT_EQ(soil.exponent.std_error, 0.05) << "its own, and none is assumed for n";
  EXPECT_EQ(soil.k_phi.std_error, 150e3) << "its own";
  EXPECT_TRUE(has_assumed_sd(soil, soil.k_c));
  EXPECT_FALSE(has_assumed_sd(soil, soil.k_phi));
  const SemiEmpiricalSoil known =
      *parse(with("    k_c: 0.99 kN/m^(n+1)",
                  "    assumed_sd: 10 %\n    k_c: {value: 0.99 kN/m^(n+1), sd: 0 kN/m^(n+1)}"))
           .scenario.soil.semi_empirical;
  EXPECT_EQ(known.k_c.std_error, 0.0) << "written as exact";
  const SemiEmpiricalSoil exact = without_assumed_sd(soil);
  EXPECT_EQ(exact.k_c.std_error, 0.0);
  EXPECT_EQ(exact.k_phi.std_error, 150e3);
  EXPECT_FALSE(exact.assumed_sd);
}

TEST(CaseReader, ResolvesFormsAndParametersOfEffects) {
  const Case c = parse(good);
  ASSERT_EQ(c.study.models.size(), 2u);
  EXPECT_EQ(c.study.models[0].label, "bekker_wong");
  const std::vector<EffectChoice>& effects = c.study.models[1].effects;
  ASSERT_EQ(effects.size(), 2u);
  EXPECT_EQ(effects[0].form, "lyasko");
  EXPECT_EQ(effects[0].parameters.at("a"), 1.0) << "the form's default";
  EXPECT_DOUBLE_EQ(effects[1].parameters.at("angle"), 20 * degree);
}

TEST(CaseReader, AMisspeltKeyIsShownWithTheRightOne) {
  EXPECT_EQ(refused(with("  radius: 250 mm", "  raduis: 250 mm")),
            "case.yaml:4:3: unknown key 'raduis', did you mean 'radius'?\n"
            "  4 |   raduis: 250 mm\n"
            "    |   ^\n"
            "  hint: keys here: name, source, radius, width, lugs, inflation_pressure, carcass_pressure, deflection, "
            "section_height, construction");
  EXPECT_THAT(refused(with("tire:", "wheel:")), HasSubstr("unknown key 'wheel', did you mean 'tire'?"));
  EXPECT_THAT(refused("format: soilbin-case/1\nsoil dry-sand\n"),
              HasSubstr("case.yaml:2:1: 'soil dry-sand' has no colon behind 'soil'"));
  EXPECT_THAT(refused(with("count", "cuont")), HasSubstr("case.yaml:6:24: unknown key 'cuont', did you mean 'count'?"));
  EXPECT_THAT(refused(with("name: example", "nmae: example")),
              StartsWith("case.yaml:2:1: unknown key 'nmae', did you mean 'name'?"));
}

// Both models of a soil stand on one ground.
TEST(CaseReader, GravityIsThatOfTheSoil) {
  const std::string last = "    stress_angle_c2: 0.32\n", moon = last + "    gravity: 1.62 m/s^2\n";
  const std::string grains =
      "  granular:\n    {radius_min: 5 mm, radius_max: 6 mm, grain_density: 2500 kg/m^3, youngs_modulus: 5 MPa,\n"
      "     poisson_ratio: 0.25, grain_grain: {restitution: 0.5, sliding_friction: 0.5, rolling_friction: 0.1},\n"
      "     grain_tire: {restitution: 0.5, sliding_friction: 0.5, rolling_friction: 0.1}}\n";
  EXPECT_EQ(gravity_of(parse(good).scenario.soil), 9.80665);
  EXPECT_EQ(gravity_of(parse(with(last, moon)).scenario.soil), 1.62);
  EXPECT_THAT(refused(with(last, moon + grains)), HasSubstr("gravity must be the same"));
  EXPECT_THAT(refused(with(last, last + "    gravity: 1.62 m/s\n")), HasSubstr("m/s^2"));
}

TEST(CaseReader, UnitsAreDemanded) {
  EXPECT_THAT(refused(with("250 mm", "0.25")),
              StartsWith("case.yaml:4:11: expected a length, such as '11 mm', not '0.25': it has no unit"));
  EXPECT_THAT(refused(with("100 mm", "100 kPa")), StartsWith("case.yaml:5:10: expected a length"));
  EXPECT_THAT(refused(with("0.99 kN/m^(n+1)", "0.99 kN/m^(n+2)")), HasSubstr("expected a cohesive modulus"));
  EXPECT_THAT(refused(with("load: 2 kN", "load: 200 kg")), HasSubstr("'kg' is a mass, which weighs 1.961 kN on Earth"));
  EXPECT_THAT(refused(with("angle: 20 deg", "angle: 20")), HasSubstr("expected an angle"));
}

TEST(CaseReader, OutOfRangeIsRefused) {
  EXPECT_THAT(refused(with("250 mm", "-250 mm")),
              HasSubstr("case.yaml:4:11: '-250 mm' is out of range: must be above 0 mm"));
  EXPECT_THAT(refused(with("28 deg", "90 deg")), HasSubstr("must be at least 0 deg and below 90 deg"));
  EXPECT_THAT(refused(with("20 %]", "120 %]")), HasSubstr("must be -1 .. 1"));
  EXPECT_THAT(refused(with("count: 24", "count: 0")), HasSubstr("0 is out of range: must be at least 1"));
  EXPECT_THAT(refused(with("sd: 0.05", "sd: -0.05")), HasSubstr("must be at least 0"));
  EXPECT_THAT(refused(with("angle: 20 deg", "angle: 120 deg")), HasSubstr("out of range"));
}

TEST(CaseReader, IntegersAreIntegers) {
  EXPECT_THAT(refused(with("count: 24", "count: 24.0")), HasSubstr("expected a whole number, such as '2', not '24.0'"));
  EXPECT_THAT(refused(with("count: 24", "count: 1e2")), HasSubstr("expected a whole number"));
  EXPECT_THAT(refused(with("count: 24", "count: 99999999999999999999")), HasSubstr("expected a whole number"));
}

TEST(CaseReader, WrongKindsOfNodesAreNamed) {
  EXPECT_THAT(refused(with("radius: 250 mm", "radius: [250 mm]")), HasSubstr("not a list"));
  EXPECT_THAT(refused(with("radius: 250 mm", "radius:")), HasSubstr("nothing stands behind 'radius'"));
  EXPECT_THAT(refused(with("{height: 8 mm, count: 24, pattern: chevron}", "yes")),
              HasSubstr("expected a mapping of keys"));
  EXPECT_THAT(refused("- a\n"), HasSubstr("expected a mapping that begins with 'format: soilbin-case/1', not a list"));
  EXPECT_THAT(refused(with("cohesion: 1.04 kPa", "cohesion: {valeu: 1 kPa}")), HasSubstr("did you mean 'value'?"));
  EXPECT_THAT(refused(with("radius: 250 mm", "radius: {value: 250 mm, sd: 1 mm}")),
              HasSubstr("'radius' is taken as exact: it has no 'sd'"));
}

TEST(CaseReader, MissingKeysAreNamed) {
  EXPECT_THAT(refused(with("  radius: 250 mm\n", "")),
              AllOf(HasSubstr("key 'radius' is missing"), HasSubstr("hint: radius: radius to the tread base")));
  EXPECT_THAT(refused(with("    load: 2 kN\n", "")), HasSubstr("key 'load' is missing"));
  EXPECT_THAT(refused("format: soilbin-case/1\nname: x\n"), HasSubstr("key 'tire' is missing"));
  EXPECT_THAT(refused(with("name: example", "name: \"\"")), HasSubstr("the name is empty"));
}

TEST(CaseReader, FormatsAreChecked) {
  EXPECT_THAT(refused(with("soilbin-case/1", "soilbin-case/2")),
              StartsWith("case.yaml:1:9: unknown format 'soilbin-case/2': expected 'soilbin-case/1'"));
  EXPECT_THAT(refused(with("soilbin-case/1", "soilbin-vehicle-case/1")),
              HasSubstr("hint: that is a vehicle on a soil: soilbin vehicle case.yaml"));
  EXPECT_THAT(refused(with("soilbin-case/1", "soilbin-soil/1")), HasSubstr("hint: that is a soil: --soil case.yaml"));
  EXPECT_THAT(refused("name: x\n"), HasSubstr("key 'format' is missing"));
}

TEST(CaseReader, WordsAreCheckedAgainstTheRightOnes) {
  EXPECT_THAT(refused(with("chevron", "chevrom")), AllOf(HasSubstr("unknown word 'chevrom', did you mean 'chevron'?"),
                                                         HasSubstr("one of: straight, chevron")));
  EXPECT_THAT(refused(with("    - bekker_wong\n", "    - beker_wong\n")), HasSubstr("did you mean 'bekker_wong'?"));
}

TEST(CaseReader, EffectsAreCheckedAgainstTheVocabulary) {
  EXPECT_THAT(refused(with("- slip_sinkage", "- slip_sinkgae")),
              AllOf(StartsWith("case.yaml:25:11: unknown word 'slip_sinkgae', did you mean 'slip_sinkage'?")));
  EXPECT_THAT(refused(with("form: blade", "form: blades")), HasSubstr("did you mean 'blade'?"));
  EXPECT_THAT(refused(with("{angle:", "{angel:")), HasSubstr("unknown key 'angel', did you mean 'angle'?"));
  EXPECT_THAT(refused(with("- slip_sinkage", "- lug_thrust")), HasSubstr("effect 'lug_thrust' is listed twice"));
  EXPECT_THAT(refused(with("- slip_sinkage", "- slip_sinkage:ding")),
              AllOf(HasSubstr("'slip_sinkage:ding' is how a flag spells an effect"),
                    HasSubstr("hint: in a file: {id: slip_sinkage, form: ding}")));
  EXPECT_THAT(refused(with("- slip_sinkage", "- slip_sinkage:ding,n1=0.3,x=2 mm")),
              HasSubstr("{id: slip_sinkage, form: ding, parameters: {n1: 0.3, x: 2 mm}}"));
}

/// The good case with errors of a fit under its second model.
std::string fitted(const std::string& errors) {
  return with("      label: dug in\n", "      label: dug in\n      errors:\n" + errors);
}

TEST(CaseReader, ErrorsOfAFitNameWhatErrsTogether) {
  const std::string text = fitted(
      "        - parameter: k_phi\n"
      "        - {parameter: lug_thrust.angle, sd: 3 deg, correlations: [-0.9]}\n");
  const Case c = parse(text);
  const std::vector<FittedError>& errors = c.study.models[1].errors;
  ASSERT_EQ(errors.size(), 2U);
  EXPECT_FALSE(errors[0].std_error) << "it stands with the soil";
  EXPECT_DOUBLE_EQ(*errors[1].std_error, 3 * degree);
  EXPECT_EQ(correlation(errors, 0, 1), -0.9);
  const std::string written = write_case(c, FakeVocabulary());
  EXPECT_EQ(write_case(parse(written), FakeVocabulary()), written);
  EXPECT_THAT(written, HasSubstr("correlations: [-0.9]"));
}

TEST(CaseReader, ErrorsOfAFitAreChecked) {
  EXPECT_THAT(refused(fitted("        - parameter: k_pi\n")), HasSubstr("did you mean 'k_phi'"));
  EXPECT_THAT(refused(fitted("        - parameter: lug_thrust.angle\n")), HasSubstr("has no sd"));
  EXPECT_THAT(refused(fitted("        - {parameter: k_phi, sd: 1}\n")), HasSubstr("stands with the soil"));
  EXPECT_THAT(refused(fitted("        - parameter: k_phi\n        - parameter: k_phi\n")), HasSubstr("listed twice"));
  const std::string two = "        - parameter: k_phi\n        - {parameter: k_c, correlations: ";
  EXPECT_THAT(refused(fitted(two + "[]}\n")), HasSubstr("expected a list of 1 correlations"));
  EXPECT_THAT(refused(fitted(two + "[1.2]}\n")), HasSubstr("1.2"));
  EXPECT_THAT(refused(fitted(two + "[0.9]}\n        - {parameter: exponent, correlations: [0.9, -0.9]}\n")),
              HasSubstr("contradict each other"));
}

TEST(CaseReader, AModelNeedsItsSectionOfTheSoil) {
  EXPECT_THAT(refused(with("    - bekker_wong\n", "    - dem\n")),
              HasSubstr("model 'dem' needs the soil's 'granular' section"));
  const std::string soil =
      good.substr(good.find("  semi_empirical"), good.find("bin:") - good.find("  semi_empirical"));
  EXPECT_THAT(refused(with(soil, "")), HasSubstr("a soil needs 'semi_empirical', 'granular', 'resistive_force', "));
}

TEST(CaseReader, TiresAndSoilsCanBeNamed) {
  const std::string tire = good.substr(good.find("tire:"), good.find("soil:\n") - good.find("tire:"));
  EXPECT_EQ(parse(with(tire, "tire: paper-lugged\n")).scenario.tire.radius, 0.496);
  EXPECT_THAT(refused(with(tire, "tire: paper-luged\n")),
              AllOf(StartsWith("case.yaml:3:7: no tire 'paper-luged' in the library, did you mean 'paper-lugged'?"),
                    HasSubstr("hint: soilbin list tires shows the ")));
  EXPECT_THAT(refused(with(tire, "tire: ./nothing.yaml\n")), HasSubstr("no such tire file"));
  EXPECT_THAT(refused(with(tire, "tire: /dev/zero\n")), HasSubstr("no such tire file"));
  EXPECT_THAT(refused(with(tire, "tire: [a]\n")), HasSubstr("a name of the library, or a path; not a list"));
}

TEST(CaseReader, AMistakeInANamedFileIsReportedInThatFile) {
  const SourceText tire = make_source_text("format: soilbin-tire/1\nradius: 1 m\nwidht: 1 m\n", "tires/t.yaml");
  EXPECT_THAT(refusal([&] { parse_tire(tire); }),
              StartsWith("tires/t.yaml:3:1: unknown key 'widht', did you mean 'width'?"));
  EXPECT_EQ(parse_tire(make_source_text("format: soilbin-tire/1\nradius: 1 m\nwidth: 1 m\n", "tires/t.yaml")).name,
            "t");
}

TEST(CaseReader, FindsByNameOrSaysWhatThereIs) {
  const Library library({SOILBIN_SOURCE_DIR "/cases"});
  EXPECT_EQ(find_soil("dry-sand", library).semi_empirical->k_phi.value, 1528430.0);
  EXPECT_THAT(refusal([&] { find_soil("dry-snad", library); }), HasSubstr("did you mean 'dry-sand'?"));
  EXPECT_THAT(refusal([&] { find_soil("wet loam", library); }),
              AllOf(HasSubstr("did you mean 'sandy-loam-wet'?"), HasSubstr("hint: soilbin list soils shows the "),
                    testing::Not(HasSubstr("lunar"))));
}

}  // namespace
}  // namespace soilbin
