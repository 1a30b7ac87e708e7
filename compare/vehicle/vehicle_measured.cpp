#include "compare/vehicle/vehicle_measured.hpp"

#include <algorithm>
#include <cmath>
#include <set>

#include "bekker_wong/gsl.hpp"
#include "compare/vehicle/vehicle_errors.hpp"
#include "scenario/csv_columns.hpp"
#include "scenario/unit.hpp"

namespace soilbin::compare {
namespace {

/// What of a vehicle is asked at one slip.
struct AskedState {
  double slip = 0.0;
  VehicleCondition at{};
};

/// The condition with the slope on which the vehicle travels steadily at a slip, with the pull that is asked: outward
/// from level ground, upward where it pulls more there. Throws VehicleGaveOut.
VehicleCondition climbed_at(const SteadyVehicles& vehicles, VehicleCondition at, double slip) {
  const auto spare = [&](double slope) {
    at.slope = slope;
    return vehicles.at_slip(at, slip).pull - at.pull;
  };
  constexpr double step = 5 * degree, steepest_sought = 70 * degree;
  double here = 0.0;
  const bool climbs = spare(here) > 0.0;
  while (std::abs(here) < steepest_sought) {
    const double next = here + (climbs ? step : -step);
    if ((spare(next) > 0.0) != climbs) {
      at.slope = gsl::bracketed_root(spare, std::min(here, next), std::max(here, next), 1e-12,
                                     1e-12 * vehicles.weight(), "the slope at a slip");
      return at;
    }
    here = next;
  }
  throw VehicleGaveOut(climbs ? GaveOut::slides : GaveOut::pull, std::nullopt, "no slope at which it travels so");
}

/// Left at the hitch [N]; not a number where there is no balance.
double pull_or_none(const SteadyVehicles& vehicles, const AskedState& asked) {
  try {
    return vehicles.at_slip(asked.at, asked.slip).pull;
  } catch (const VehicleGaveOut&) {
    return not_a_number;
  }
}

/// How the pull at a slip changes with the slope [N/rad]. Throws VehicleGaveOut.
double pull_per_slope(const SteadyVehicles& vehicles, const AskedState& asked) {
  constexpr double step = 1e-4;
  VehicleCondition up = asked.at, down = asked.at;
  up.slope += step, down.slope -= step;
  return (vehicles.at_slip(up, asked.slip).pull - vehicles.at_slip(down, asked.slip).pull) / (2 * step);
}

/// A channel by the pull at a slip: its value, and how it changes with the pull [1/N] there.
struct ChannelOfPull {
  double value = 0.0, per_newton = 0.0;
};

ChannelOfPull channel_by_pull(VehicleChannel channel, const SteadyVehicles& vehicles, const AskedState& asked,
                              double pull) {
  switch (channel) {
    case VehicleChannel::slope:
      return {asked.at.slope, -1.0 / pull_per_slope(vehicles, asked)};
    case VehicleChannel::drawbar_pull:
      break;
    case VehicleChannel::traction_angle: {
      const double share = pull / vehicles.weight();
      return {std::atan(share), 1.0 / (1.0 + share * share) / vehicles.weight()};
    }
  }
  return {pull, 1.0};
}

/// The states, and the error of the mean of the first `count` of them.
struct Modelled {
  std::vector<ModelledState> states{};
  double mean_error = 0.0;
};

Modelled model_states(const VehicleCase& question, const std::vector<VehicleWheel>& wheels, const Model& model,
                      VehicleChannel channel, std::vector<AskedState> asked, std::size_t count) {
  const SteadyVehicles vehicles(question, wheels, model);
  Modelled modelled;
  std::vector<double> per_newton(asked.size(), 0.0);
  for (std::size_t i = 0; i < asked.size(); ++i) {
    ModelledState& state = modelled.states.emplace_back(ModelledState{asked[i].slip});
    try {
      if (channel == VehicleChannel::slope) asked[i].at = climbed_at(vehicles, asked[i].at, state.slip);
      state.vehicle = vehicles.at_slip(asked[i].at, state.slip);
      const ChannelOfPull one = channel_by_pull(channel, vehicles, asked[i], state.vehicle->pull);
      state.value = Estimate{one.value, not_a_number}, per_newton[i] = one.per_newton;
    } catch (const VehicleGaveOut& error) {
      state.failure = as_failure(error);
    }
  }
  const VehicleNumbers errors = errors_of(wheels, asked.size() + 1, [&](const std::vector<VehicleWheel>& changed) {
    const SteadyVehicles others(question, changed, model);
    VehicleNumbers numbers(asked.size() + 1, 0.0);
    double answered = 0.0;
    for (std::size_t i = 0; i < asked.size(); ++i) {
      if (!modelled.states[i].value) continue;
      numbers[i] = per_newton[i] * pull_or_none(others, asked[i]);
      if (i < count) numbers.back() += numbers[i], answered += 1.0;
    }
    numbers.back() /= answered;
    return numbers;
  });
  for (std::size_t i = 0; i < asked.size(); ++i)
    if (auto& value = modelled.states[i].value) value->std_error = errors[i];
  modelled.mean_error = errors.back();
  return modelled;
}

}  // namespace

MeasuredVehicle read_measured_vehicle(const SourceText& csv) {
  constexpr Range slips{.lower = -1.0, .upper = 1.0, .lower_open = true};
  const std::vector<std::vector<double>> rows =
      read_csv_columns(csv, {{"slip", {"-", slips}},
                             {"slope", {"deg", inclines}, Need::optional},
                             {"drawbar_pull", {"N", any_value}, Need::optional},
                             {"traction_angle", {"deg", inclines}, Need::optional}});
  if (rows.empty()) csv.refuse(0, "no row holds a measured state");
  MeasuredVehicle measured{csv.file};
  const auto holds = [&](VehicleChannel channel) {
    return !std::isnan(rows.front()[1 + static_cast<std::size_t>(channel)]);
  };
  const bool pull = holds(VehicleChannel::drawbar_pull), angle = holds(VehicleChannel::traction_angle);
  measured.tells_slopes = holds(VehicleChannel::slope);
  constexpr const char* one_of = "beside the slip: slope_deg, drawbar_pull_N or traction_angle_deg, in any unit";
  if (pull && angle) csv.refuse(0, "two columns hold a pull: drawbar_pull and traction_angle", one_of);
  if (!pull && !angle && !measured.tells_slopes) csv.refuse(0, "no column holds what was measured", one_of);
  if (pull) measured.channel = VehicleChannel::drawbar_pull;
  if (angle) measured.channel = VehicleChannel::traction_angle;
  for (const std::vector<double>& row : rows) {
    MeasuredState& state =
        measured.states.emplace_back(MeasuredState{row[0], row[1 + static_cast<std::size_t>(measured.channel)]});
    if (measured.tells_slopes && measured.channel != VehicleChannel::slope) state.slope = row[1];
  }
  return measured;
}

MeasuredAnswers beside_measured(const VehicleCase& question, const std::vector<VehicleWheel>& wheels,
                                const Model& model, const MeasuredVehicle& measured) {
  MeasuredAnswers answers{question, wheels, measured};
  const VehicleCondition& at = question.condition;
  std::vector<AskedState> asked;
  std::set<double> slips;
  for (const MeasuredState& state : measured.states) {
    AskedState& one = asked.emplace_back(AskedState{state.slip, at});
    if (state.slope) one.at.slope = *state.slope;
    slips.insert(state.slip);
  }
  const std::size_t count = asked.size();
  const bool on_unlike_slopes = std::ranges::any_of(
      measured.states, [&](const MeasuredState& state) { return state.slope != measured.states.front().slope; });
  if (!on_unlike_slopes) {
    constexpr double apart = 0.05;
    const double last = *slips.rbegin();
    for (int i = 0; i * apart < last; ++i) slips.insert(i * apart);
    const VehicleCondition there = asked.front().at;
    for (const double slip : slips) asked.push_back({slip, there});
  }
  Modelled modelled = model_states(question, wheels, model, measured.channel, std::move(asked), count);
  const auto end = modelled.states.begin() + static_cast<std::ptrdiff_t>(count);
  answers.curve.assign(end, modelled.states.end());
  answers.modelled.assign(modelled.states.begin(), end);

  double sum = 0.0, squares = 0.0;
  for (std::size_t i = 0; i < count; ++i)
    if (const std::optional<double> off = answers.difference(i))
      ++answers.answered, sum += *off, squares += *off * *off;
  const double all = answers.answered > 0 ? static_cast<double>(answers.answered) : not_a_number;
  answers.rms = std::sqrt(squares / all), answers.mean = {sum / all, modelled.mean_error};
  return answers;
}

}  // namespace soilbin::compare
