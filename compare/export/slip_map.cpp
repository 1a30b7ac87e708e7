#include "compare/export/slip_map.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "scenario/errors.hpp"

namespace soilbin::compare {
namespace {

constexpr int nominal_colour = 128;
constexpr double most_steps = 127.0;  // up or down from there

/// What a channel of the map changes.
using MappedMember = double MappedSlip::*;
constexpr std::array<MappedMember, 3> red_green_blue = {&MappedSlip::lateral, &MappedSlip::longitudinal,
                                                        &MappedSlip::friction};

void require_one_wheel(const std::vector<WheelSlipFit>& fits) {
  if (fits.empty()) throw InputError("a map has at least one soil");
  for (const WheelSlipFit& fit : fits)
    if (fit.radius != fits.front().radius || fit.normal_load != fits.front().normal_load)
      throw InputError("a map is of one wheel under one load: the plugin has one radius and one normal force");
}

}  // namespace

SlipMap slip_map(const std::vector<WheelSlipFit>& fits, const SlipMapSize& asked) {
  require_one_wheel(fits);
  if (!(asked.size > 0.0)) throw InputError("a map's size is above 0 m");
  if (asked.pixels < static_cast<int>(fits.size()))
    throw InputError(fmt::format("{} soils need as many pixels, and the map has {}", fits.size(), asked.pixels));
  SlipMap map;
  map.size = asked.size, map.pixels = asked.pixels;
  map.nominal = {fits.front().lateral.compliance, fits.front().longitudinal.compliance, 1.0};
  for (const WheelSlipFit& fit : fits)
    map.soils.push_back({fit.question.scenario.soil.name,
                         {},
                         {fit.lateral.compliance, fit.longitudinal.compliance, fit.longitudinal.friction},
                         fit.lateral.friction});
  for (std::size_t channel = 0; channel < red_green_blue.size(); ++channel) {
    const MappedMember member = red_green_blue[channel];
    double& step = map.step.*member;
    for (const SlipMapSoil& one : map.soils)
      step = std::max(step, std::abs(one.fitted.*member - map.nominal.*member) / most_steps);
    for (SlipMapSoil& one : map.soils) {
      const double steps = step > 0.0 ? std::round((one.fitted.*member - map.nominal.*member) / step) : 0.0;
      one.colour[channel] = static_cast<unsigned char>(nominal_colour + static_cast<int>(steps));
    }
  }
  return map;
}

SlipMap slip_map(const WheelSlipFit& first, const std::vector<Soil>& others, const SlipMapSize& asked) {
  std::vector<WheelSlipFit> fits = {first};
  for (const Soil& soil : others) {
    Case question = first.question;
    question.scenario.soil = soil;
    try {
      fits.push_back(wheel_slip_of(std::move(question)));
    } catch (const NoSolution& none) {
      throw NoSolution(fmt::format("soil '{}': {}", soil.name, none.what()));
    }
  }
  return slip_map(fits, asked);
}

MappedSlip slip_at(const SlipMap& map, const std::array<unsigned char, 3>& colour) {
  MappedSlip found;
  for (std::size_t channel = 0; channel < red_green_blue.size(); ++channel) {
    const MappedMember member = red_green_blue[channel];
    found.*member = std::max(0.0, map.nominal.*member + (colour[channel] - nominal_colour) * map.step.*member);
  }
  return found;
}

RgbPicture picture_of(const SlipMap& map) {
  const auto pixels = static_cast<std::size_t>(map.pixels);
  RgbPicture picture{map.pixels, {}};
  for (std::size_t at = 0; at < pixels * pixels; ++at)
    picture.rgb.push_back(map.soils[(at % pixels) * map.soils.size() / pixels].colour);
  return picture;
}

}  // namespace soilbin::compare
