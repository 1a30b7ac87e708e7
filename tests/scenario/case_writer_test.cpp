// The resolved case: write, read, write gives the same bytes, whatever the case.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <limits>

#include "scenario/case.hpp"
#include "scenario/mapping_writer.hpp"
#include "scenario/yaml_node.hpp"
#include "tests/scenario/fake_vocabulary.hpp"
#include "tests/scenario/refusal.hpp"

namespace soilbin {
namespace {

using test::FakeVocabulary;

Case read_back(const std::string& text) {
  return parse_case(make_source_text(text, "resolved.yaml"), Library(), FakeVocabulary());
}

rc::Gen<double> between(double lower, double upper) {
  return rc::gen::map(rc::gen::inRange<long>(1, 1'000'000'007),
                      [=](long k) { return lower + (upper - lower) * static_cast<double>(k) / 1'000'000'007.0; });
}

rc::Gen<std::string> text() {
  return rc::gen::map(rc::gen::container<std::vector<std::string>>(rc::gen::element<std::string>(
                          "a", "Z", "0", " ", ":", "#", "\"", "'", "\\", "\n", "\t", "-", "{", "}", "[", ",", "&", "*",
                          "!", "|", "%", "\u00e4", "\u20ac", "null", "true", "~", "\r")),
                      [](const std::vector<std::string>& pieces) {
                        std::string all;
                        for (const std::string& piece : pieces) all += piece;
                        return all;
                      });
}

/// Of one line.
rc::Gen<std::string> name() {
  return rc::gen::map(text(), [](std::string all) {
    std::erase_if(all, [](char c) { return c == '\n' || c == '\r' || c == '\t'; });
    return all;
  });
}

Estimate any_estimate(double lower, double upper) {
  return {*between(lower, upper), *rc::gen::arbitrary<bool>() ? *between(0, upper) : 0.0};
}

Tire any_tire() {
  Tire tire;
  tire.name = *name();
  tire.source = *text();
  tire.radius = *between(0.01, 2);
  tire.width = *between(0.01, 1);
  tire.lugs = {
      *between(0, 0.1), std::nullopt, std::nullopt,
      *rc::gen::element(LugPattern::straight, LugPattern::chevron, LugPattern::slanted, LugPattern::staggered)};
  if (*rc::gen::arbitrary<bool>()) tire.lugs.angle = *between(0, 1.2);
  if (*rc::gen::arbitrary<bool>()) {
    const double load = *between(1, 1e5), pressure = *between(0, 1e6), deflection = tire.radius * *between(0.01, 0.4);
    tire.deflection = DeflectionTable{*text(), {{load, pressure, deflection}, {2 * load, pressure, 2 * deflection}}};
  }
  if (*rc::gen::arbitrary<bool>()) tire.lugs.count = *rc::gen::inRange(1, 100);
  if (*rc::gen::arbitrary<bool>()) tire.inflation_pressure = *between(0, 1e6);
  if (*rc::gen::arbitrary<bool>()) tire.carcass_pressure = any_estimate(0, 1e5);
  if (*rc::gen::arbitrary<bool>()) tire.construction = *rc::gen::element(Construction::bias_ply, Construction::radial);
  if (*rc::gen::arbitrary<bool>()) tire.sources["lugs.height"] = "a" + *text();
  return tire;
}

SemiEmpiricalSoil any_semi_empirical() {
  SemiEmpiricalSoil soil{any_estimate(0.1, 2), any_estimate(-1e6, 1e6), any_estimate(1, 1e9),
                         any_estimate(0, 1e5), any_estimate(0, 1.5),    any_estimate(1e-4, 0.1),
                         any_estimate(0, 1),   any_estimate(-1, 1),     *between(100, 3000)};
  if (*rc::gen::arbitrary<bool>()) {
    soil.assumed_sd = *between(0, 1);
    soil.k_phi.std_error = *soil.assumed_sd * soil.k_phi.value;
  }
  if (*rc::gen::arbitrary<bool>()) soil.sources["k_c"] = "b" + *text();
  return soil;
}

GranularSoil any_granular() {
  GranularSoil soil;
  soil.radius_min = *between(1e-4, 1e-2);
  soil.radius_max = soil.radius_min * *between(1, 3);
  soil.grain_density = *between(500, 4000);
  soil.youngs_modulus = *between(1e5, 1e9);
  soil.poisson_ratio = *between(-0.9, 0.5);
  soil.grain_tire = {*between(0, 1), *between(0, 2), *between(0, 1)};
  soil.sources["grain_tire.restitution"] = "Table 3";
  if (*rc::gen::arbitrary<bool>())
    soil.cohesion_law = GrainCohesion::jkr, soil.grain_grain.work_of_adhesion = *between(1e-3, 10);
  return soil;
}

OperatingCondition any_condition() {
  OperatingCondition at;
  at.load = *between(1, 1e5);
  at.slip = *between(-1, 1);
  at.speed = *between(0, 10);
  at.longitudinal_incline = *between(-1, 1);
  at.yaw = *between(-1.5, 1.5);
  at.pass = *rc::gen::inRange(1, 9);
  at.slip_by = *rc::gen::element(SlipBy::wheel_plane_speed, SlipBy::travel_speed);
  if (*rc::gen::arbitrary<bool>()) at.moisture = *between(0, 1);
  if (*rc::gen::arbitrary<bool>()) at.run = *rc::gen::inRange(0, 100);
  if (*rc::gen::arbitrary<bool>()) at.inflation_pressure = *between(0, 1e6);
  return at;
}

ModelChoice any_model() {
  ModelChoice choice;
  choice.label = "m" + *name();
  if (*rc::gen::arbitrary<bool>()) choice.effects.push_back({"slip_sinkage", "reece", {{"h", *between(0, 0.2)}}});
  if (*rc::gen::arbitrary<bool>()) choice.effects.push_back({"exit_angle", "unloading", {{"k_u", *between(0, 1e11)}}});
  if (*rc::gen::arbitrary<bool>()) choice.misfit = {*between(0, 1e3), 0.0, *between(0, 0.1), *between(0, 1e3)};
  return choice;
}

Case any_case() {
  Case c;
  c.name = "c" + *name();
  c.description = *text();
  c.scenario.tire = any_tire();
  c.scenario.soil.name = *name();
  c.scenario.soil.semi_empirical = any_semi_empirical();
  if (*rc::gen::arbitrary<bool>()) c.scenario.soil.granular = any_granular();
  if (*rc::gen::arbitrary<bool>()) c.scenario.bin = Bin{*between(0.1, 2), *between(0.1, 2)};
  c.study.name = *name();
  for (int i = *rc::gen::inRange(1, 3); i > 0; --i) c.study.models.push_back(any_model());
  for (int i = *rc::gen::inRange(1, 4); i > 0; --i) c.study.conditions.push_back(any_condition());
  return c;
}

TEST(CaseWriter, WriteReadWriteGivesTheSameBytes) {
  EXPECT_TRUE(rc::check("any case", [] {
    const std::string once = write_case(any_case(), FakeVocabulary());
    RC_ASSERT(write_case(read_back(once), FakeVocabulary()) == once);
  }));
}

TEST(CaseWriter, ReadingWhatWasWrittenGivesTheSameBits) {
  EXPECT_TRUE(rc::check("any case", [] {
    const Case c = any_case();
    const Case again = read_back(write_case(c, FakeVocabulary()));
    RC_ASSERT(again.name == c.name);
    RC_ASSERT(again.description == c.description);
    RC_ASSERT(again.scenario.tire.radius == c.scenario.tire.radius);
    RC_ASSERT(again.scenario.tire.construction == c.scenario.tire.construction);
    RC_ASSERT(again.scenario.tire.sources == c.scenario.tire.sources);
    RC_ASSERT(again.scenario.soil.semi_empirical->k_phi.value == c.scenario.soil.semi_empirical->k_phi.value);
    RC_ASSERT(again.scenario.soil.semi_empirical->friction_angle.std_error ==
              c.scenario.soil.semi_empirical->friction_angle.std_error);
    RC_ASSERT(again.scenario.soil.semi_empirical->sources == c.scenario.soil.semi_empirical->sources);
    RC_ASSERT(again.scenario.soil.granular.has_value() == c.scenario.soil.granular.has_value());
    RC_ASSERT(again.study.models[0].label == c.study.models[0].label);
    RC_ASSERT(again.study.conditions.size() == c.study.conditions.size());
    RC_ASSERT(again.study.conditions[0].yaw == c.study.conditions[0].yaw);
    RC_ASSERT(again.study.conditions[0].run == c.study.conditions[0].run);
    RC_ASSERT(again.study.conditions[0].inflation_pressure == c.study.conditions[0].inflation_pressure);
    RC_ASSERT(again.study.models[0].misfit == c.study.models[0].misfit);
    const auto carcass = [](const Case& of) { return of.scenario.tire.carcass_pressure.value_or(Estimate{-1, 0}); };
    RC_ASSERT(carcass(again).value == carcass(c).value);
    RC_ASSERT(carcass(again).std_error == carcass(c).std_error);
  }));
}

TEST(CaseWriter, TiresAndSoilsAlone) {
  EXPECT_TRUE(rc::check("any tire and soil", [] {
    Tire tire = any_tire();
    tire.name = "t" + tire.name;
    RC_ASSERT(write_tire(parse_tire(make_source_text(write_tire(tire), "t.yaml"))) == write_tire(tire));
    Soil soil;
    soil.name = "s" + *name();
    soil.moisture = *between(0, 1);
    soil.sources["moisture"] = "oven";
    soil.granular = any_granular();
    RC_ASSERT(write_soil(parse_soil(make_source_text(write_soil(soil), "s.yaml"))) == write_soil(soil));
  }));
}

TEST(CaseWriter, AConstructionThatNobodyToldIsNotWritten) {
  const auto read = [](const std::string& more) {
    return parse_tire(
        make_source_text("format: soilbin-tire/1\nname: t\nradius: 0.5 m\nwidth: 0.2 m\n" + more, "t.yaml"));
  };
  EXPECT_EQ(read("construction: radial\n").construction, Construction::radial);
  for (const char* more : {"", "construction: unknown\n"}) {
    EXPECT_EQ(read(more).construction, std::nullopt);
    EXPECT_EQ(write_tire(read(more)).find("construction"), std::string::npos);
  }
  EXPECT_THROW(read("construction: woven\n"), InputError);
}

// Whatever is written is read: a number that no file may hold (a fit that went wrong) is refused where it is written.
TEST(CaseWriter, WhatNoReaderTakesIsNotWritten) {
  const auto refused = [](Estimate SemiEmpiricalSoil::*member, Estimate value) {
    Soil soil;
    soil.name = "fitted";
    SemiEmpiricalSoil& values = soil.semi_empirical.emplace();
    values.exponent = {1, 0.1}, values.k_phi = {1e6, 1e5}, values.friction_angle = {0.5, 0.05};
    values.shear_modulus = {0.02, 0.0}, values.stress_angle_c1 = {0.2, 0.1}, values.stress_angle_c2 = {0.3, 0.1};
    EXPECT_NO_THROW(parse_soil(make_source_text(write_soil(soil), "s.yaml")));
    values.*member = value;
    return test::refusal([&] { write_soil(soil); });
  };
  using S = SemiEmpiricalSoil;
  constexpr double none = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THAT(refused(&S::exponent, {7, 0.1}), testing::HasSubstr("exponent: 7 is out of range"));
  EXPECT_THAT(refused(&S::exponent, {2.66, none}), testing::HasSubstr("sd of exponent: nan is no number"));
  EXPECT_THAT(refused(&S::k_phi, {none, 0}), testing::HasSubstr("k_phi: nan is no number"));
  EXPECT_THAT(refused(&S::friction_angle, {-0.1, 0.1}), testing::HasSubstr("friction_angle: -0.1 is out of range"));
  EXPECT_THAT(refused(&S::shear_modulus, {0.0, 0.1}), testing::HasSubstr("shear_modulus: 0 is out of range"));
}

TEST(CaseWriter, AnyTextIsAScalar) {
  EXPECT_TRUE(rc::check("any text", [] {
    const std::string any = *text();
    const YamlNode node = parse_yaml(make_source_text("key: " + yaml_scalar(any) + "\n", "t.yaml"));
    RC_ASSERT(node.find("key")->scalar == any);
    RC_ASSERT(node.find("key")->is_scalar());
  }));
}

TEST(CaseWriter, WritesNoTextThatNobodyReads) {
  for (const char* text : {"\x01", "a\x1b[2J", "\x7f", "\u009b"}) EXPECT_THROW(yaml_scalar(text), InputError) << text;
}

}  // namespace
}  // namespace soilbin
