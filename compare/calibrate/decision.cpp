#include "compare/calibrate/decision.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "compare/fit/observations.hpp"

namespace soilbin::compare {
namespace {

constexpr double apart_by = 2.0;  // standard errors

/// Mean and squares about it, of one channel at one setpoint.
struct Cells {
  int count = 0;
  double mean = 0.0, squares = 0.0;
  void add(double value) {
    const double off = value - mean;
    mean += off / ++count;
    squares += off * (value - mean);
  }
};

struct Gathered {
  OperatingCondition sum;
  int runs = 0;
  OfChannels<Cells> cells;
};

/// Rows of a campaign by setpoint. What is set once a setpoint is the first row's; what a rig only aims at is averaged.
std::vector<Gathered> gather(const Campaign& campaign) {
  const Observations all = observe(campaign);
  std::vector<Gathered> gathered(static_cast<std::size_t>(all.conditions));
  for (std::size_t row = 0; row < all.rows.size(); ++row) {
    Gathered& into = gathered[all.condition[row]];
    OperatingCondition at = all.rows[row];
    if (into.runs++ > 0) {
      at = into.sum;
      for (double OperatingCondition::*aimed :
           {&OperatingCondition::load, &OperatingCondition::slip, &OperatingCondition::speed})
        at.*aimed += all.rows[row].*aimed;
    }
    into.sum = at;
  }
  for (const Cell& cell : all.cells) gathered[all.condition[cell.row]].cells[cell.channel].add(cell.value);
  return gathered;
}

/// Standard deviation of a channel within setpoints that were run again; 0 without any.
double rerun_sd(const std::vector<Gathered>& gathered, std::size_t channel) {
  double squares = 0.0, freedom = 0.0;
  for (const Gathered& one : gathered)
    squares += one.cells[channel].squares, freedom += std::max(0, one.cells[channel].count - 1);
  return freedom > 0 ? std::sqrt(squares / freedom) : 0.0;
}

/// simulated - measured as a share of the load, with both errors and its weight in E^2.
struct ScaledResidual {
  double off = 0.0, simulated_sd = 0.0, measured_sd = 0.0, weight = 0.0;
};
/// Misses of a candidate: a setpoint each, a channel each; without weight where there is nothing to compare.
using ScaledResiduals = std::vector<OfChannels<ScaledResidual>>;

ScaledResiduals scaled_residuals_of(const std::vector<Setpoint>& setpoints, const std::vector<Answer>& answers,
                                    double radius) {
  OfChannels<int> count{};
  for (const Setpoint& setpoint : setpoints)
    for (std::size_t c = 0; c < count.size(); ++c) count[c] += setpoint.measured[c].has_value();
  const auto channels = std::ranges::count_if(count, [](int n) { return n > 0; });
  ScaledResiduals residuals(setpoints.size());
  for (std::size_t s = 0; s < setpoints.size(); ++s)
    for (std::size_t c = 0; c < count.size(); ++c) {
      if (!setpoints[s].measured[c]) continue;
      const Estimate measured = *setpoints[s].measured[c];
      const Estimate simulated = (*answers[s].result).*channel_views[c].predicted;
      const double scale = channel_scale(channel_views[c], setpoints[s].at.load, radius);
      residuals[s][c] = {(simulated.value - measured.value) / scale, simulated.std_error / scale,
                         measured.std_error / scale, 1.0 / static_cast<double>(channels * count[c])};
    }
  return residuals;
}

double squares_of(const ScaledResiduals& residuals) {
  double sum = 0.0;
  for (const auto& setpoint : residuals)
    for (const ScaledResidual& residual : setpoint) sum += residual.weight * residual.off * residual.off;
  return sum;
}

/// Sum over setpoints of (sum over channels of 2 w |off| sd)^2: the channels of one run err together.
double variance_of(std::size_t setpoints, const auto& term) {
  double variance = 0.0;
  for (std::size_t s = 0; s < setpoints; ++s) {
    double sum = 0.0;
    for (std::size_t c = 0; c < channel_views.size(); ++c) sum += 2 * term(s, c);
    variance += sum * sum;
  }
  return variance;
}

/// sqrt(E^2) and its error, d(E^2)/(2 E).
Estimate root_of(double squares, double variance) {
  const double root = std::sqrt(squares);
  return {root, root > 0 ? std::sqrt(variance) / (2 * root) : 0.0};
}

double weight_in(const ScaledResiduals& residuals, std::size_t channel) {
  double sum = 0.0;
  for (const auto& setpoint : residuals) sum += setpoint[channel].weight;
  return sum;
}

void tell_errors(const ScaledResiduals& residuals, Trial& trial) {
  const auto own = [&](std::size_t s, std::size_t c) {
    const ScaledResidual& residual = residuals[s][c];
    return residual.weight * std::abs(residual.off) * std::hypot(residual.simulated_sd, residual.measured_sd);
  };
  trial.error = root_of(squares_of(residuals), variance_of(residuals.size(), own));
  for (std::size_t channel = 0; channel < channel_views.size(); ++channel) {
    const double weight = weight_in(residuals, channel);
    if (!(weight > 0)) continue;
    double squares = 0.0;
    for (const auto& setpoint : residuals)
      squares += setpoint[channel].weight / weight * setpoint[channel].off * setpoint[channel].off;
    trial.errors[channel] = root_of(squares, variance_of(residuals.size(), [&](std::size_t s, std::size_t c) {
                                      return c == channel ? own(s, c) / weight : 0.0;
                                    }));
  }
}

bool clearly_farther(const ScaledResiduals& farther, const ScaledResiduals& nearest) {
  const std::size_t n = farther.size();
  const double variance = variance_of(n,
                                      [&](std::size_t s, std::size_t c) {
                                        const ScaledResidual& k = farther[s][c];
                                        return k.weight * std::abs(k.off) * k.simulated_sd;
                                      }) +
                          variance_of(n,
                                      [&](std::size_t s, std::size_t c) {
                                        const ScaledResidual& b = nearest[s][c];
                                        return b.weight * std::abs(b.off) * b.simulated_sd;
                                      }) +
                          variance_of(n, [&](std::size_t s, std::size_t c) {
                            const ScaledResidual& k = farther[s][c];
                            return k.weight * std::abs(k.off - nearest[s][c].off) * k.measured_sd;
                          });
  return squares_of(farther) - squares_of(nearest) > apart_by * std::sqrt(variance);
}

bool all_answered(const std::vector<Answer>& answers) {
  return std::ranges::all_of(answers, [](const Answer& one) { return one.result.has_value(); });
}

}  // namespace

std::vector<Setpoint> setpoints_of(const Campaign& campaign) {
  const std::vector<Gathered> gathered = gather(campaign);
  std::vector<Setpoint> setpoints;
  for (const Gathered& one : gathered) {
    Setpoint setpoint{one.sum, one.runs, {}};
    setpoint.at.load /= one.runs, setpoint.at.slip /= one.runs, setpoint.at.speed /= one.runs;
    setpoint.at.moisture.reset(), setpoint.at.position.reset(), setpoint.at.run.reset();
    setpoint.at.inflation_pressure.reset();
    bool any = false;
    for (std::size_t c = 0; c < channel_views.size(); ++c)
      if (const Cells& cells = one.cells[c]; cells.count > 0)
        setpoint.measured[c] = {cells.mean, rerun_sd(gathered, c) / std::sqrt(cells.count)}, any = true;
    if (any) setpoints.push_back(setpoint);
  }
  return setpoints;
}

std::vector<Setpoint> between(const std::vector<Setpoint>& setpoints, double OperatingCondition::*member, double lower,
                              double upper) {
  std::vector<Setpoint> kept;
  for (const Setpoint& setpoint : setpoints)
    if (setpoint.at.*member >= lower && setpoint.at.*member <= upper) kept.push_back(setpoint);
  return kept;
}

bool Decision::decided() const {
  return std::ranges::any_of(trials, [](const Trial& trial) { return trial.error.has_value(); });
}

int Decision::tied() const {
  return static_cast<int>(
      std::ranges::count_if(trials, [](const Trial& trial) { return trial.error && !trial.apart; }));
}

Decision decide(std::string campaign, std::vector<Setpoint> setpoints, std::vector<std::vector<Answer>> answers,
                double radius) {
  Decision decision{std::move(campaign), std::move(setpoints), {}};
  std::vector<ScaledResiduals> residuals;
  for (std::vector<Answer>& row : answers) {
    if (row.size() != decision.setpoints.size())
      throw std::invalid_argument("whoever decides between candidates gives an answer for each setpoint");
    Trial& trial = decision.trials.emplace_back(Trial{std::move(row), {}, {}});
    residuals.emplace_back();
    if (!all_answered(trial.answers)) continue;
    residuals.back() = scaled_residuals_of(decision.setpoints, trial.answers, radius);
    tell_errors(residuals.back(), trial);
  }
  if (!decision.decided()) return decision;
  const auto error = [&](std::size_t k) { return decision.trials[k].error; };
  for (std::size_t k = 0; k < residuals.size(); ++k)
    if (error(k) && (!error(decision.nearest) || error(k)->value < error(decision.nearest)->value))
      decision.nearest = k;
  for (std::size_t k = 0; k < residuals.size(); ++k)
    if (error(k)) decision.trials[k].apart = clearly_farther(residuals[k], residuals[decision.nearest]);
  decision.chosen = decision.nearest;
  for (std::size_t k = residuals.size(); k-- > 0;)
    if (error(k) && !decision.trials[k].apart) decision.chosen = k;
  return decision;
}

std::string candidate_name(std::size_t candidate) {
  return fmt::format("({})", static_cast<char>('a' + static_cast<char>(candidate)));
}

}  // namespace soilbin::compare
