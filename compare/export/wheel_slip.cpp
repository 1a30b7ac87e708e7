#include "compare/export/wheel_slip.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "scenario/errors.hpp"
#include "scenario/unit.hpp"

namespace soilbin::compare {
namespace {

double squares_of(const std::vector<SlipPoint>& points, double compliance, double friction) {
  double sum = 0.0;
  for (const SlipPoint& point : points)
    sum += std::pow(wheel_slip_force(point.slip, compliance, friction) - point.force_share, 2);
  return sum;
}

/// The smallest of a sum of squares over the logarithm of the compliance: the best of a fine grid, then golden section
/// between its neighbours.
double best_compliance(const std::vector<SlipPoint>& points, double friction) {
  constexpr int steps = 400;
  constexpr double lowest = -4.0, highest = 3.0;  // of log10
  const auto of = [&](double exponent) { return squares_of(points, std::pow(10.0, exponent), friction); };
  int best = 0;
  for (int i = 1; i <= steps; ++i)
    if (of(lowest + (highest - lowest) * i / steps) < of(lowest + (highest - lowest) * best / steps)) best = i;
  const double step = (highest - lowest) / steps;
  double from = lowest + step * (best - 1), to = from + 2 * step;
  constexpr double golden = 0.6180339887498949;
  for (int i = 0; i < 60; ++i) {
    const double a = to - golden * (to - from), b = from + golden * (to - from);
    (of(a) < of(b) ? to : from) = of(a) < of(b) ? b : a;
  }
  return std::pow(10.0, 0.5 * (from + to));
}

/// Where the wheel pulls nothing, straight between two slips, and each slip above it. Sets what it takes there.
std::vector<SlipPoint> pulling_points(WheelSlipFit& fit) {
  std::vector<SlipPoint> points;
  const TractionResult* before = nullptr;
  for (const Answer& answer : fit.answers[0].answers) {
    if (!answer.result) continue;
    const TractionResult& now = *answer.result;
    const double pull = now.drawbar_pull.value;
    if (points.empty() && pull > 0.0) {
      const double share = before == nullptr ? 0.0 : pull / (pull - before->drawbar_pull.value);  // of the way back
      const TractionResult& from = before == nullptr ? now : *before;
      fit.idle_slip = before == nullptr ? 0.0 : now.at.slip - share * (now.at.slip - from.at.slip);
      fit.idle_torque = before == nullptr ? 0.0 : now.torque.value - share * (now.torque.value - from.torque.value);
      points.push_back({0.0, 0.0});
    }
    if (!points.empty()) points.push_back({now.at.slip - fit.idle_slip, pull / fit.normal_load});
    before = &now;
  }
  if (points.size() < 2)
    throw NoSolution(before == nullptr ? "no solution: " + fit.answers[0].answers.front().error
                                       : "the wheel pulls at no slip up to 60 %: it can't travel by itself, and the "
                                         "plugin has no force for it");
  return points;
}

}  // namespace

double wheel_slip_force(double slip, double compliance, double friction) {
  if (compliance == 0.0) return slip == 0.0 ? 0.0 : std::copysign(friction, slip);
  return std::clamp(slip / compliance, -friction, friction);
}

SlipLine fitted_line(std::vector<SlipPoint> points) {
  SlipLine line;
  line.points = std::move(points);
  for (const SlipPoint& point : line.points) line.friction = std::max(line.friction, point.force_share);
  if (!(line.friction > 0.0)) throw NoSolution("no slip gives a force: there is no line to fit");
  line.compliance = best_compliance(line.points, line.friction);
  for (const SlipPoint& point : line.points)
    line.largest_error = std::max(
        line.largest_error, std::abs(wheel_slip_force(point.slip, line.compliance, line.friction) - point.force_share));
  line.rms_error =
      std::sqrt(squares_of(line.points, line.compliance, line.friction) / static_cast<double>(line.points.size()));
  return line;
}

WheelSlipFit wheel_slip_of(Case question, const MakeModel& make) {
  if (question.study.models.size() != 1)
    throw InputError("one model is fitted\n  hint: --effect NAME for the analytic wheel with that effect alone");
  if (question.study.conditions.size() != 1)
    throw InputError(
        "one condition is fitted: give one --load and one --slip, that of the wheel when it is pushed aside");
  const OperatingCondition at = question.study.conditions.front();
  if (at.longitudinal_incline != 0.0 || at.transverse_incline != 0.0 || at.yaw != 0.0)
    throw InputError(
        "the compliance is that on level ground without yaw: Gazebo turns forces by itself\n"
        "  hint: leave --yaw and the inclines out");
  if (!(at.slip > -1.0 && at.slip < 1.0)) throw InputError("--slip: between -100 % and 100 %, both not included");
  WheelSlipFit fit;
  const ModelChoice& choice = question.study.models.front();
  const std::unique_ptr<const Model> model = make(choice.model);
  const Scenario scenario = seen_by(choice, question.scenario);
  fit.normal_load = at.load, fit.radius = question.scenario.tire.radius, fit.lateral_slip = at.slip;
  std::vector<OperatingCondition> forward, sideways;
  for (int percent = 0; percent <= 60; percent += 5) {
    forward.push_back(at);
    forward.back().slip = percent / 100.0;
  }
  for (int degrees = 2; degrees <= 20; degrees += 2) {
    sideways.push_back(at);
    sideways.back().yaw = degrees * degree;
    sideways.back().slip_by = SlipBy::wheel_plane_speed;
    sideways.back().force_frame = ForceFrame::wheel;
  }
  std::vector<SlipPoint> across;
  fit.answers = {{choice, sweep(*model, scenario, forward)}, {choice, sweep(*model, scenario, sideways)}};
  std::vector<SlipPoint> along = pulling_points(fit);
  // Across: v sin(yaw), where v cos(yaw) = r w (1 - s) driven and r w/(1 + s) braked. A wheel that points to the left
  // of its travel is pushed to the left of its plane: the force is against the slip.
  const double forward_share = at.slip >= 0.0 ? 1.0 - at.slip : 1.0 / (1.0 + at.slip);
  for (const Answer& answer : fit.answers[1].answers)
    if (answer.result)
      across.push_back(
          {std::tan(answer.at.yaw) * forward_share, std::abs(answer.result->lateral_force.value) / at.load});
  if (across.empty()) throw NoSolution("no solution at any yaw: " + fit.answers[1].answers.front().error);
  fit.longitudinal = fitted_line(std::move(along));
  fit.lateral = fitted_line(std::move(across));
  fit.question = std::move(question);
  return fit;
}

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
