// A measured campaign as a side: whose wheel it was, which runs count where, and how sure their means are.
#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "compare/discrepancy/side.hpp"
#include "compare/fit/factorizations.hpp"
#include "compare/measured/campaign.hpp"
#include "scenario/errors.hpp"
#include "scenario/estimate.hpp"
#include "scenario/unit.hpp"
#include "scenario/yawed_frames.hpp"

namespace soilbin::compare {
namespace {

void check_wheel(const Campaign& campaign, const Tire& asked) {
  const Tire& measured = campaign.wheel;
  constexpr double same = 0.05;
  const auto differ = [](double a, double b) { return std::abs(a - b) > same * b; };
  const bool lugs =
      differ(measured.lugs.height, asked.lugs.height) ||
      (is_lugged(asked) && measured.lugs.count && asked.lugs.count && *measured.lugs.count != *asked.lugs.count);
  const bool tells_pressures =
      std::ranges::any_of(campaign.runs, [](const Run& run) { return run.at.inflation_pressure.has_value(); });
  if (!lugs && !differ(measured.radius, asked.radius) && !differ(measured.width, asked.width) &&
      (tells_pressures || !differ(measured.inflation_pressure.value_or(0.0), asked.inflation_pressure.value_or(0.0))))
    return;
  throw InputError(
      fmt::format("campaign '{}' measured {}, the study asks of {}\n  hint: a study with the campaign's wheel",
                  campaign.name, in_words(measured), in_words(asked)));
}

/// A run's condition with its slip as another condition tells it.
OperatingCondition as_defined_by(OperatingCondition run, const OperatingCondition& asked) {
  run.slip = slip_by(run.slip, run.yaw, run.slip_by, asked.slip_by);
  run.slip_by = asked.slip_by;
  return run;
}

/// How far two inflation pressures are apart, in multiples of what still counts as near; 0 where one is not known.
double pressures_apart(const OperatingCondition& run, const OperatingCondition& b) {
  if (!run.inflation_pressure || !b.inflation_pressure) return 0.0;
  const double difference = std::abs(*run.inflation_pressure - *b.inflation_pressure);
  return difference == 0.0 ? 0.0 : difference / (near_load * *b.inflation_pressure);
}

/// A condition with its tire's own inflation pressure where it tells none.
OperatingCondition pumped(OperatingCondition at, const Tire& tire) {
  if (!at.inflation_pressure) at.inflation_pressure = tire.inflation_pressure;
  return at;
}

/// How far a run is from a condition, in units of what counts as near; above 1: not near.
double apart(const OperatingCondition& run, const OperatingCondition& b) {
  if (run.pass != b.pass) return std::numeric_limits<double>::infinity();
  const OperatingCondition a = as_defined_by(run, b);
  return std::max({std::abs(a.load - b.load) / (near_load * b.load), std::abs(a.slip - b.slip) / near_slip,
                   std::abs(a.longitudinal_incline - b.longitudinal_incline) / near_angle,
                   std::abs(a.transverse_incline - b.transverse_incline) / near_angle,
                   std::abs(a.yaw - b.yaw) / near_angle, pressures_apart(a, b)});
}

/// A run with its slip and forces as the condition tells them; without forces that can't be turned.
Run as_asked(Run run, const OperatingCondition& asked) {
  const ForceFrame measured = run.at.force_frame;
  run.at = as_defined_by(run.at, asked);
  run.at.force_frame = asked.force_frame;
  if (measured == asked.force_frame) return run;
  if (run.drawbar_pull && run.lateral_force) {
    const GroundForce force = turned({*run.drawbar_pull, *run.lateral_force}, run.at.yaw, measured, asked.force_frame);
    run.drawbar_pull = force.forward, run.lateral_force = force.left;
  } else if (std::abs(run.at.yaw) > near_angle) {
    run.drawbar_pull.reset(), run.lateral_force.reset();
  }
  return run;
}

/// A campaign's runs as the study asks for them.
struct SortedRuns {
  std::vector<Run> asked;              ///< in the campaign's order, each as its nearest condition tells it
  std::vector<std::size_t> condition;  ///< that each counts at; none: near no condition
  static constexpr std::size_t none = std::numeric_limits<std::size_t>::max();
};

SortedRuns sorted(const Campaign& campaign, const std::vector<OperatingCondition>& conditions, const Tire& asked) {
  SortedRuns sorted;
  for (const Run& run : campaign.runs) {
    const auto away = [&, at = pumped(run.at, campaign.wheel)](const auto& a) { return apart(at, pumped(a, asked)); };
    const auto nearest = std::ranges::min_element(conditions, {}, away);
    const bool counts = nearest != conditions.end() && away(*nearest) <= 1.0;
    sorted.asked.push_back(nearest == conditions.end() ? run : as_asked(run, *nearest));
    sorted.condition.push_back(counts ? static_cast<std::size_t>(nearest - conditions.begin()) : SortedRuns::none);
  }
  return sorted;
}

/// Runs of one setpoint each: of one label, wherever the study counts them, or, without one, of one condition of it.
std::vector<std::vector<const Run*>> setpoints_of(const Campaign& campaign, const SortedRuns& sorted) {
  enum class By { label, condition, none };
  const Observations seen = observe(campaign);
  std::map<std::pair<By, std::size_t>, std::vector<const Run*>> by_name;
  for (std::size_t i = 0; i < sorted.asked.size(); ++i) {
    const auto label = static_cast<std::size_t>(seen.condition[i]);
    const auto name = sorted.condition[i] == SortedRuns::none ? std::pair(By::none, label)
                      : sorted.asked[i].setpoint              ? std::pair(By::label, label)
                                                              : std::pair(By::condition, sorted.condition[i]);
    by_name[name].push_back(&sorted.asked[i]);
  }
  std::vector<std::vector<const Run*>> setpoints;
  for (auto& [name, runs] : by_name) setpoints.push_back(std::move(runs));
  return setpoints;
}

/// What limits a mean of these runs. `forces`: of how many of them a force was measured.
Doubts doubts_of(const std::vector<const Run*>& runs, std::size_t forces, const NoiseFloor& noise) {
  Doubts doubts;
  const auto kept = static_cast<std::size_t>(
      std::ranges::count_if(runs, [](const Run* run) { return run->drawbar_pull || run->lateral_force; }));
  if (kept < forces)
    doubts.push_back({runs.front()->at.force_frame == ForceFrame::travel ? DoubtKind::forces_not_turned_to_travel
                                                                         : DoubtKind::forces_not_turned_to_wheel,
                      {forces - kept, runs.size()}});
  std::string unknown;
  for (std::size_t c = 0; c < channel_views.size(); ++c)
    if (noise.channels[c].freedom == 0.0 && !values_of(runs, c).empty())
      unknown += fmt::format("{}{}", unknown.empty() ? "" : ", ", channel_views[c].title);
  if (!unknown.empty()) doubts.push_back({DoubtKind::no_reruns, {unknown}});
  const auto other = [&](const Run* run) { return run->setpoint != runs.front()->setpoint; };
  if (std::ranges::any_of(runs, other)) doubts.push_back({DoubtKind::mixed_setpoints});
  return doubts;
}

/// The efficiency at the mean slip that was run, where the channels that it takes were measured.
double measured_efficiency(TractionResult means, const std::vector<const Run*>& runs, double radius) {
  const auto count = static_cast<double>(runs.size());
  means.at.slip = means.at.load = 0.0;
  for (const Run* run : runs) means.at.slip += run->at.slip / count, means.at.load += run->at.load / count;
  return tractive_efficiency(means, radius);
}

SidePoint measured_point(const std::vector<const Run*>& runs, const OperatingCondition& at, double radius,
                         const NoiseFloor& noise) {
  SidePoint point;
  point.runs = runs.size();
  point.has = {};
  if (runs.empty()) {
    point.error = "not measured";
    return point;
  }
  TractionResult result;
  result.at = at;
  result.entry_angle = result.exit_angle = result.max_stress_angle = not_a_number;
  for (std::size_t c = 0; c < channel_views.size(); ++c) {
    Estimate& mean = result.*channel_views[c].predicted = {not_a_number, 0.0};
    const std::vector<double> values = values_of(runs, c);
    point.has[c] = !values.empty();
    if (values.empty()) continue;
    mean.value = mean_of(values).value;
    if (noise.channels[c].freedom == 0.0) continue;
    point.scatter[c] = noise.channels[c].sd(mean.value);
    point.freedom[c] = noise.channels[c].freedom;
    mean.std_error = point.scatter[c] / std::sqrt(static_cast<double>(values.size()));
  }
  result.tractive_efficiency = measured_efficiency(result, runs, radius);
  point.result = result;
  return point;
}

}  // namespace

Side side_of(const Campaign& campaign, const Case& question) {
  check_wheel(campaign, question.scenario.tire);
  const std::vector<OperatingCondition>& conditions = question.study.conditions;
  const SortedRuns runs = sorted(campaign, conditions, question.scenario.tire);
  Side side{campaign.name + " (measured)", SideKind::measured, {}};
  side.noise = rerun_noise(setpoints_of(campaign, runs));
  for (std::size_t i = 0; i < conditions.size(); ++i) {
    std::vector<const Run*> members;
    std::size_t forces = 0;
    for (std::size_t k = 0; k < runs.asked.size(); ++k)
      if (runs.condition[k] == i) {
        members.push_back(&runs.asked[k]);
        forces += campaign.runs[k].drawbar_pull || campaign.runs[k].lateral_force;
      }
    side.points.push_back(measured_point(members, conditions[i], campaign.wheel.radius, *side.noise));
    if (!members.empty()) side.points.back().doubts = doubts_of(members, forces, *side.noise);
  }
  for (std::size_t k = 0; k < runs.asked.size(); ++k)
    if (runs.condition[k] != SortedRuns::none) side.runs.push_back(campaign.runs[k]);
  if (side.runs.empty())
    throw InputError(
        fmt::format("no run of campaign '{}' is near a condition of study '{}'\n  hint: within {:.0f} % of the load, "
                    "{:.3g} % slip and {:.2g} deg",
                    campaign.name, question.study.name, 100 * near_load, 100 * near_slip, near_angle / degree));
  return side;
}

namespace {

using Setpoints = std::vector<std::vector<const Run*>>;

/// One channel's runs of one setpoint: their mean, squares about it, and how many are beyond the first.
struct Reruns {
  double mean = 0.0, squares = 0.0, freedom = 0.0;
};

std::vector<Reruns> reruns_of(const Setpoints& setpoints, std::size_t channel) {
  std::vector<Reruns> all;
  for (const auto& setpoint : setpoints) {
    const std::vector<double> values = values_of(setpoint, channel);
    if (values.size() < 2) continue;
    const double freedom = static_cast<double>(values.size() - 1);
    all.push_back({mean_of(values).value, freedom * std::pow(spread_of(values), 2), freedom});
  }
  return all;
}

/// The size of a noise of this shape that makes the re-runs likeliest, and -2 ln of their likelihood there.
std::pair<double, double> fitted_size(const std::vector<Reruns>& reruns, const ChannelNoise& shape) {
  double squares = 0.0, freedom = 0.0, log_shape = 0.0;
  for (const Reruns& r : reruns) {
    squares += r.squares / std::pow(shape.sd(r.mean), 2);
    freedom += r.freedom;
    log_shape += 2 * r.freedom * std::log(shape.sd(r.mean));
  }
  const double size = std::sqrt(squares / freedom);
  return {size, 2 * freedom * std::log(size) + log_shape};
}

ChannelNoise noise_of(const std::vector<Reruns>& reruns) {
  constexpr double enough_to_show_growth = 20, convincing = 4;  // degrees of freedom; of -2 ln likelihood
  ChannelNoise noise;
  double mean_square = 0.0;
  for (const Reruns& r : reruns) noise.freedom += r.freedom, mean_square += r.freedom * r.mean * r.mean;
  if (noise.freedom == 0.0) return noise;
  mean_square /= noise.freedom;
  ChannelNoise shape;
  shape.floor = 1.0;
  auto [size, lowest] = fitted_size(reruns, shape);
  noise.floor = noise.rerun_sd = size;
  if (noise.freedom < enough_to_show_growth || !(size > 0.0) || !(mean_square > 0.0)) return noise;
  lowest -= convincing;
  for (const double share : {0.49, 0.98}) {  // of the variance that grows, at the root mean square signal
    shape.floor = std::sqrt(1 - share), shape.growth = std::sqrt(share / mean_square);
    const auto [grown, deviance] = fitted_size(reruns, shape);
    if (deviance < lowest) lowest = deviance, noise.floor = grown * shape.floor, noise.growth = grown * shape.growth;
  }
  return noise;
}

/// Residuals about the setpoints' means in units of the noise: a row each run, NaN where a channel says nothing.
Eigen::MatrixXd residuals_of(const Setpoints& setpoints, const NoiseFloor& noise) {
  Eigen::Index rows = 0;
  for (const auto& setpoint : setpoints) rows += static_cast<Eigen::Index>(setpoint.size());
  Eigen::MatrixXd all = Eigen::MatrixXd::Constant(rows, channel_count, not_a_number);
  Eigen::Index row = 0;
  for (const auto& setpoint : setpoints) {
    for (std::size_t c = 0; c < channel_views.size(); ++c) {
      const std::vector<double> values = values_of(setpoint, c);
      if (values.size() < 2) continue;
      const double mean = mean_of(values).value;
      for (std::size_t k = 0; k < setpoint.size(); ++k)
        if (const auto& value = setpoint[k]->*channel_views[c].measured)
          all(row + static_cast<Eigen::Index>(k), static_cast<Eigen::Index>(c)) =
              (*value - mean) / noise.channels[c].sd(mean);
    }
    row += static_cast<Eigen::Index>(setpoint.size());
  }
  return all;
}

Eigen::Matrix4d correlation_of(const Eigen::MatrixXd& residuals) {
  Eigen::Matrix4d correlation = Eigen::Matrix4d::Identity();
  for (Eigen::Index a = 0; a < channel_count; ++a)
    for (Eigen::Index b = 0; b < a; ++b) {
      double ab = 0, aa = 0, bb = 0;
      for (Eigen::Index i = 0; i < residuals.rows(); ++i) {
        const double x = residuals(i, a), y = residuals(i, b);
        if (std::isfinite(x) && std::isfinite(y)) ab += x * y, aa += x * x, bb += y * y;
      }
      if (aa > 0 && bb > 0) correlation(a, b) = correlation(b, a) = ab / std::sqrt(aa * bb);
    }
  // Few re-runs, or a channel computed from another, give no matrix to invert: then channels count as independent.
  const Eigen::Matrix4d above_least = correlation - 1e-6 * Eigen::Matrix4d::Identity();
  return Cholesky(above_least).exists() ? correlation : Eigen::Matrix4d::Identity();
}

}  // namespace

std::vector<double> values_of(const std::vector<const Run*>& runs, std::size_t channel) {
  std::vector<double> values;
  for (const Run* run : runs)
    if (const auto& value = run->*channel_views[channel].measured) values.push_back(*value);
  return values;
}

NoiseFloor rerun_noise(const Setpoints& setpoints) {
  NoiseFloor noise;
  for (std::size_t c = 0; c < channel_views.size(); ++c) {
    noise.channels[c] = noise_of(reruns_of(setpoints, c));
    for (const auto& setpoint : setpoints)
      noise.channels[c].measured = noise.channels[c].measured || !values_of(setpoint, c).empty();
  }
  for (const auto& setpoint : setpoints) noise.rerun_freedom += static_cast<int>(setpoint.size()) - 1;
  noise.correlation = correlation_of(residuals_of(setpoints, noise));
  return noise;
}

}  // namespace soilbin::compare
