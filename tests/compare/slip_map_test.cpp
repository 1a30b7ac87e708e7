// Soils as Gazebo's LookupWheelSlip reads them: the file is decoded and looked up as the plugin does, and each place
// gives the compliances that were fitted for its soil.
#include <gmock/gmock.h>
#include <zlib.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "compare/export/wheel_slip.hpp"
#include "compare/telling/reports.hpp"
#include "scenario/errors.hpp"

namespace soilbin::compare {
namespace {

WheelSlipFit fit_of(const char* soil, double lateral, double longitudinal, double friction, double across = 0.5) {
  WheelSlipFit fit;
  fit.question.scenario.soil.name = soil;
  fit.question.study.models = {{ModelKind::bekker_wong, {}, "bekker_wong"}};
  fit.normal_load = 65.0, fit.radius = 0.09;
  fit.lateral.compliance = lateral, fit.lateral.friction = across;
  fit.longitudinal.compliance = longitudinal, fit.longitudinal.friction = friction;
  return fit;
}

std::vector<WheelSlipFit> three_soils() {
  return {fit_of("sand", 1.3, 3.5, 0.07), fit_of("clay", 0.2, 0.4, 0.6), fit_of("mud", 5.0, 3.6, 0.031)};
}

std::uint32_t number_at(const std::string& bytes, std::size_t at) {
  std::uint32_t value = 0;
  for (std::size_t i = 0; i < 4; ++i) value = value << 8 | static_cast<unsigned char>(bytes[at + i]);
  return value;
}

/// What gz::common::Image has of a file of true colour without filters: rows from the top, three bytes a pixel.
struct ImageInGazebo {
  unsigned width = 0, height = 0;
  std::string rgb;

  explicit ImageInGazebo(const std::string& png) {
    EXPECT_EQ(png.substr(0, 8), "\x89PNG\r\n\x1a\n");
    std::string packed;
    for (std::size_t at = 8; at < png.size();) {
      const std::uint32_t length = number_at(png, at);
      const std::string kind = png.substr(at + 4, 4), data = png.substr(at + 8, length);
      EXPECT_EQ(number_at(png, at + 8 + length),
                crc32(0, reinterpret_cast<const Bytef*>(png.data() + at + 4), length + 4));
      if (kind == "IHDR") {
        width = number_at(data, 0), height = number_at(data, 4);
        EXPECT_EQ(data.substr(8), std::string("\x08\x02\x00\x00\x00", 5)) << "8 bits, true colour, not interlaced";
      }
      if (kind == "IDAT") packed += data;
      at += 12 + length;
    }
    std::string rows((3 * width + 1) * height, '\0');
    uLongf size = rows.size();
    EXPECT_EQ(uncompress(reinterpret_cast<Bytef*>(rows.data()), &size, reinterpret_cast<const Bytef*>(packed.data()),
                         packed.size()),
              Z_OK);
    EXPECT_EQ(size, rows.size());
    for (std::size_t row = 0; row < height; ++row) {
      EXPECT_EQ(rows[row * (3 * width + 1)], '\0') << "no filter";
      rgb += rows.substr(row * (3 * width + 1) + 1, 3 * width);
    }
  }
};

/// LookupWheelSlip::UpdateParams for a wheel at x, y: the pixel by rounding, its row by the picture's height, the
/// values by the steps from 128.
MappedSlip in_gazebo(const ImageInGazebo& image, const SlipMap& sdf, double x, double y) {
  const auto u = static_cast<int>(std::round((x + sdf.size / 2) * image.width / sdf.size));
  const auto v = static_cast<int>(std::round((sdf.size / 2 - y) * image.height / sdf.size));
  const std::size_t index = (static_cast<std::size_t>(v) * image.height + static_cast<std::size_t>(u)) * 3;
  const auto value = [&](double nominal, std::size_t channel, double delta) {
    return std::max(0.0, nominal + (static_cast<unsigned char>(image.rgb[index + channel]) - 128) * delta);
  };
  constexpr double friction_of_wheel_slip = 1.0;  // frictionCoeffPrimary and Secondary of WheelSlip.cc
  return {value(sdf.nominal.lateral, 0, sdf.step.lateral), value(sdf.nominal.longitudinal, 1, sdf.step.longitudinal),
          value(friction_of_wheel_slip, 2, sdf.step.friction)};
}

TEST(SlipMap, GivesEachSoilsFitInItsStripeToHalfAStep) {
  const std::vector<WheelSlipFit> fits = three_soils();
  const SlipMap map = slip_map(fits, {.size = 12.0, .pixels = 60});
  const ImageInGazebo image(rgb_png(picture_of(map)));
  EXPECT_EQ(image.width, 60U);
  EXPECT_EQ(image.height, 60U) << "a square: the plugin steps over rows by the height";
  for (std::size_t soil = 0; soil < fits.size(); ++soil)
    for (const double along : {-1.8, 0.0, 1.6})
      for (const double y : {-5.8, 0.0, 5.9}) {
        const MappedSlip found = in_gazebo(image, map, -4.0 + 4.0 * static_cast<double>(soil) + along, y);
        EXPECT_NEAR(found.lateral, fits[soil].lateral.compliance, map.step.lateral / 2 + 1e-12);
        EXPECT_NEAR(found.longitudinal, fits[soil].longitudinal.compliance, map.step.longitudinal / 2 + 1e-12);
        EXPECT_NEAR(found.friction, fits[soil].longitudinal.friction, map.step.friction / 2 + 1e-12);
        EXPECT_EQ(found.lateral, slip_at(map, map.soils[soil].colour).lateral);
      }
}

// 127 colours lie on either side of 128: the farthest soil is one of their ends, and exact.
TEST(SlipMap, HasTheSmallestStepsThatReachEverySoil) {
  const SlipMap map = slip_map(three_soils());
  EXPECT_NEAR(map.step.lateral, (5.0 - 1.3) / 127, 1e-15);
  EXPECT_NEAR(map.step.longitudinal, (3.5 - 0.4) / 127, 1e-15);
  EXPECT_NEAR(map.step.friction, (1 - 0.031) / 127, 1e-15);
  EXPECT_THAT(map.soils[0].colour, testing::ElementsAre(128, 128, testing::_)) << "WheelSlip has its compliances";
  EXPECT_EQ(map.soils[1].colour[1], 1);
  EXPECT_EQ(map.soils[2].colour[0], 255);
  EXPECT_EQ(map.soils[2].colour[2], 1);
  EXPECT_NEAR(slip_at(map, map.soils[2].colour).lateral, 5.0, 1e-12);
}

TEST(SlipMap, IsNeverBelowZero) {
  const SlipMap map = slip_map(three_soils());
  EXPECT_EQ(slip_at(map, {0, 128, 128}).lateral, 0.0) << "1.3 less 128 steps of 0.03";
}

TEST(SlipMap, OfOneSoilHasItsFrictionAlone) {
  const SlipMap map = slip_map({fit_of("sand", 1.3, 3.5, 0.07)});
  EXPECT_EQ(map.step.lateral, 0.0);
  const MappedSlip found = slip_at(map, map.soils.front().colour);
  EXPECT_EQ(found.longitudinal, 3.5);
  EXPECT_NEAR(found.friction, 0.07, 1e-12);
}

TEST(SlipMap, RefusesWhatIsNoMap) {
  EXPECT_THROW(slip_map({}), InputError);
  EXPECT_THROW(slip_map(three_soils(), {.size = 0.0}), InputError);
  EXPECT_THROW(slip_map(three_soils(), {.size = 1.0, .pixels = 2}), InputError);
  std::vector<WheelSlipFit> two_loads = three_soils();
  two_loads.back().normal_load = 70.0;
  EXPECT_THROW(slip_map(two_loads), InputError);
}

TEST(SlipMap, IsToldWithItsColoursAndTheFrictionThatItLacks) {
  const std::vector<WheelSlipFit> fits = three_soils();
  const SlipMap map = slip_map(fits);
  const Report report = report_on(fits.front(), map, "ground.png");
  EXPECT_THAT(text_of(report),
              testing::AllOf(testing::HasSubstr("<slip_map>ground.png</slip_map>"), testing::HasSubstr("128 128"),
                             testing::HasSubstr("one friction for both directions"),
                             testing::HasSubstr("<friction_delta>0.00762992126</friction_delta>")));
  EXPECT_EQ(report.data()["map"]["soils"][1]["colour"][1], 1);
}

}  // namespace
}  // namespace soilbin::compare
