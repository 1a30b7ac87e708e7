#include "compare/fit/bounded_fit.hpp"

#include <algorithm>
#include <cmath>

#include "compare/fit/descent.hpp"

namespace soilbin::compare {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

/// Index of k_phi, which stiffens the soil; nothing where the campaign takes it as known.
std::optional<Index> k_phi_of(const std::vector<FreeParameter>& parameters) {
  const auto k_phi = std::ranges::find_if(parameters, [](const auto& p) { return p.name == "k_phi"; });
  return k_phi == parameters.end() ? std::nullopt : std::optional(k_phi - parameters.begin());
}

/// Indices of the parameters that no bound holds: those off their bounds, by more than a last digit, and those pushed
/// inward.
std::vector<int> free_of_bounds(const WheelPredictor& predictor, const VectorXd& theta, const VectorXd& downhill) {
  std::vector<int> free;
  for (Index i = 0; i < theta.size(); ++i) {
    const FreeParameter& p = predictor.parameters()[i];
    const double last_digit = 1e-9 * p.scale;
    const bool held =
        (theta[i] <= p.lower + last_digit && downhill[i] < 0) || (theta[i] >= p.upper - last_digit && downhill[i] > 0);
    if (!held) free.push_back(static_cast<int>(i));
  }
  return free;
}

/// Puts the descent at `start`, or where that carries too little of some load, at a soil with k_phi raised step by
/// step, up to a hundredfold.
bool put_near(Descent& descent, const WheelPredictor& predictor, VectorXd start) {
  const auto k_phi = k_phi_of(predictor.parameters());
  for (int attempt = 0; attempt < 21; ++attempt) {
    if (descent.move_to(start, true)) return true;
    if (!k_phi) return false;
    const double sd = predictor.parameters()[*k_phi].prior_sd;
    start[*k_phi] = std::max(start[*k_phi] * 1.25, start[*k_phi] + 0.25 * sd);
  }
  return false;
}

/// The way from a soil that falls short to a firmer one: k_phi where it is free, else what costs chi2 least; its
/// longest part as long as the parameter's scale, k_phi's not less than its value. Empty where there is none.
VectorXd way_to_firmer(const Descent& descent, const WheelPredictor& predictor) {
  const std::vector<FreeParameter>& parameters = predictor.parameters();
  if (const auto k_phi = k_phi_of(parameters)) {
    const double length = std::max(std::abs(descent.theta()[*k_phi]), parameters[*k_phi].scale);
    return length * VectorXd::Unit(descent.theta().size(), *k_phi);
  }
  VectorXd way = descent.strengthening_direction();
  double longest = 0.0;
  for (Index i = 0; i < way.size(); ++i) longest = std::max(longest, std::abs(way[i]) / parameters[i].scale);
  return longest > 0.0 ? VectorXd(way / longest) : VectorXd();
}

/// From a soil that falls short of a load by little to one that carries all, as far as it takes, to a tenth of that.
bool stiffen(Descent& descent, const WheelPredictor& predictor) {
  const VectorXd from = descent.theta(), way = way_to_firmer(descent, predictor);
  if (way.size() == 0) return false;
  const auto firmer = [&](double share) { return predictor.within_bounds(from + share * way); };
  constexpr double farthest = 10.0;
  double least = 0.0, enough = 1e-3;
  for (; enough < farthest && !descent.would_carry(firmer(enough)); enough *= 2) least = enough;
  while (enough - least > 0.1 * enough)
    (descent.would_carry(firmer(0.5 * (least + enough))) ? enough : least) = 0.5 * (least + enough);
  for (; enough < farthest; enough *= 1.1)
    if (descent.move_to(firmer(enough), false)) return true;
  return false;
}

}  // namespace

std::optional<Fit> fit(const WheelPredictor& predictor, const VectorXd& values, const Whitening& whitening,
                       const VectorXd& start, BalanceMemory near) {
  Descent descent(predictor, values, whitening, std::move(near));
  if (!put_near(descent, predictor, start)) return std::nullopt;
  descent.minimise();
  Fit end;
  end.restart = descent.theta();
  if (!descent.carries() && !stiffen(descent, predictor)) return std::nullopt;
  AugmentedLine line = descent.line();
  const Index rows = line.residual.size() - predictor.rows();  // nothing falls short
  line.residual.conservativeResize(rows), line.columns.conservativeResize(rows, Eigen::NoChange);
  end.theta = descent.theta();
  end.prediction = descent.prediction();
  end.jacobian = descent.jacobian();
  end.column_parameter = free_of_bounds(predictor, end.theta, line.columns.transpose() * line.residual);
  end.columns = line.columns(Eigen::all, end.column_parameter);
  end.residual = line.residual;
  end.chi2 = line.residual.squaredNorm();
  end.chi2_cells = line.residual.head(values.size()).squaredNorm();
  end.balance = descent.balance();
  return end;
}

}  // namespace soilbin::compare
