#include "compare/fit/bounded_fit.hpp"

#include <algorithm>
#include <cmath>

#include "compare/fit/factorizations.hpp"
#include "compare/fit/thresholds.hpp"

namespace soilbin::compare {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

/// Rows of the priors: (prior - theta)/sd.
VectorXd prior_residual(const std::vector<FreeParameter>& parameters, const VectorXd& theta) {
  std::vector<double> rows;
  for (std::size_t i = 0; i < parameters.size(); ++i)
    if (std::isfinite(parameters[i].prior_sd))
      rows.push_back((parameters[i].prior - theta[i]) / parameters[i].prior_sd);
  return Eigen::Map<VectorXd>(rows.data(), rows.size());
}

MatrixXd prior_columns(const std::vector<FreeParameter>& parameters) {
  const Index n = parameters.size();
  MatrixXd rows = MatrixXd::Zero(n, n);
  Index row = 0;
  for (Index i = 0; i < n; ++i) {
    const FreeParameter& p = parameters[i];
    if (std::isfinite(p.prior_sd)) rows(row++, i) = p.scale / p.prior_sd;
  }
  return rows.topRows(row);
}

/// Gain far below what any decision turns on.
double negligible(double chi2) { return std::max(2e-3, 1e-4 * chi2); }

/// Columns that span the ways along all of these walls.
MatrixXd along(const MatrixXd& walls, const std::vector<int>& touched) {
  const Index n = walls.cols();
  if (touched.empty()) return MatrixXd::Identity(n, n);
  return orthogonal_complement(walls(touched, Eigen::all).transpose());
}

/// The walls that are touched and that the way downhill leads into.
std::vector<int> active_walls(const MatrixXd& walls, const VectorXd& room, const VectorXd& downhill) {
  std::vector<int> touched;
  for (Index w = 0; w < room.size(); ++w)
    if (room[w] <= 0.0) touched.push_back(static_cast<int>(w));
  while (!touched.empty()) {
    const MatrixXd normals = walls(touched, Eigen::all).transpose();
    const VectorXd push = least_squares(normals, downhill);
    Index least = 0;
    if (push.minCoeff(&least) >= 0.0) break;
    touched.erase(touched.begin() + least);
  }
  return touched;
}

/// The step of the damped normal equations, from wall to wall: where it meets one, it goes on along it.
VectorXd damped_step(const AugmentedLine& l, const MatrixXd& walls, const VectorXd& room, double damping) {
  VectorXd step = VectorXd::Zero(l.columns.cols());
  MatrixXd normal = l.columns.transpose() * l.columns;
  const VectorXd drag = damping * normal.diagonal().array() + 1e-10;
  normal.diagonal() += drag;
  const VectorXd downhill = l.columns.transpose() * l.residual;
  std::vector<int> touched = active_walls(walls, room, downhill);
  for (Index leg = 0; leg <= step.size(); ++leg) {
    const MatrixXd free = along(walls, touched);
    if (free.cols() == 0) break;
    const VectorXd way =
        free * Ldlt(free.transpose() * normal * free).solve(VectorXd(free.transpose() * (downhill - normal * step)));
    double reach = 1.0;
    int stops = -1;
    for (Index w = 0; w < room.size(); ++w) {
      const double nearer = walls.row(w).dot(way), left = room[w] - walls.row(w).dot(step);
      const bool new_one = std::ranges::find(touched, w) == touched.end();
      if (new_one && nearer > 1e-12 && left < reach * nearer)
        reach = std::max(0.0, left / nearer), stops = static_cast<int>(w);
    }
    step += reach * way;
    if (stops < 0) break;
    touched.push_back(stops);
  }
  return step;
}

/// What the linearised model expects of a step in chi2.
double promised_gain(const AugmentedLine& l, const VectorXd& step) {
  return l.residual.squaredNorm() - (l.residual - l.columns * step).squaredNorm();
}

}  // namespace

Descent::Descent(const WheelPredictor& predictor, const VectorXd& values, const Whitening& whitening,
                 BalanceMemory near)
    : predictor_(predictor), values_(values), whitening_(whitening) {
  here_.memory = std::move(near);
  const Index n = predictor.parameters().size();
  scale_.resize(n);
  for (Index i = 0; i < n; ++i) scale_[i] = predictor.parameters()[i].scale;
  const std::vector<Wall> walls = predictor.walls();
  walls_.resize(walls.size(), n);
  limits_.resize(walls_.rows());
  for (Index w = 0; w < limits_.size(); ++w) {
    const Wall& wall = walls[w];
    const VectorXd normal = wall.normal.cwiseProduct(scale_);
    walls_.row(w) = normal.transpose() / normal.norm();
    limits_[w] = wall.limit / normal.norm();
  }
}

VectorXd Descent::residual(const Point& at) const {
  const VectorXd cells = whitening_(VectorXd(values_ - at.prediction));
  const VectorXd prior = prior_residual(predictor_.parameters(), at.theta);
  const std::vector<double>& s = at.memory.shortfall;
  VectorXd residual(cells.size() + prior.size() + s.size());
  residual << cells, prior, Eigen::Map<const VectorXd>(s.data(), s.size()) / -thresholds::load_deficit_sd;
  return residual;
}

std::optional<Descent::Point> Descent::try_at(const VectorXd& theta, double limit) {
  Point point{.theta = theta, .prediction = {}, .memory = here_.memory};
  if (here_.theta.size() > 0) point.memory = here_.memory.moved_by(theta - here_.theta, slopes_);
  PartialChi2 chi2(whitening_);
  chi2.add(prior_residual(predictor_.parameters(), theta).squaredNorm());
  const double beyond = limit * (1 + 1e-9);  // more than another order of the sum makes of it
  const auto goes_on = [&](Index first, Index count, const VectorXd& prediction, double shortfall) {
    chi2.add(std::pow(shortfall / thresholds::load_deficit_sd, 2));
    chi2.add(first, values_.segment(first, count) - prediction.segment(first, count));
    return !chi2.exceeds(beyond);
  };
  const bool ended = !predictor_.predict(theta, point.prediction, point.memory, goes_on);
  here_.memory.order = point.memory.order;
  if (ended) return {};
  point.chi2 = residual(point).squaredNorm();
  return point;
}

bool Descent::stand_at(Point point) {
  auto slopes = predictor_.linearise(point.theta, point.memory);
  if (!slopes) return false;
  here_ = std::move(point), slopes_ = std::move(*slopes);
  return true;
}

bool Descent::move_to(VectorXd theta, bool gives_way) {
  here_.memory.gives_way = gives_way;
  for (Index w = 0; w < limits_.size(); ++w) {
    const double beyond = walls_.row(w).dot(theta.cwiseQuotient(scale_)) - limits_[w];
    if (beyond > 0.0) theta -= beyond * walls_.row(w).transpose().cwiseProduct(scale_);
  }
  auto point = try_at(theta);
  return point && stand_at(std::move(*point));
}

bool Descent::carries(const Point& at) {
  return std::ranges::all_of(at.memory.shortfall, [](double s) { return s == 0.0; });
}

bool Descent::would_carry(const VectorXd& theta) {
  const auto there = try_at(theta);
  return there && carries(*there);
}

BalanceMemory Descent::balance() const {
  BalanceMemory memory = here_.memory.moved_by(VectorXd::Zero(scale_.size()), slopes_);
  memory.gives_way = true;
  return memory;
}

AugmentedLine Descent::line() const {
  AugmentedLine l;
  l.residual = residual(here_);
  l.columns.resize(l.residual.size(), scale_.size());
  l.columns << whitening_(MatrixXd(slopes_.jacobian * scale_.asDiagonal())), prior_columns(predictor_.parameters()),
      slopes_.shortfall_slopes * (scale_ / thresholds::load_deficit_sd).asDiagonal();
  return l;
}

VectorXd Descent::strengthening_direction() const {
  const MatrixXd all = line().columns, kept = all.topRows(all.rows() - slopes_.shortfall_slopes.rows());
  MatrixXd cost = kept.transpose() * kept;
  cost.diagonal().array() += 1e-10;
  const VectorXd carries_more = -(slopes_.shortfall_slopes * scale_.asDiagonal()).colwise().sum().transpose();
  return Ldlt(cost).solve(carries_more).cwiseProduct(scale_);
}

/// How far each wall is, not less than 0; what a last digit leaves is nothing.
VectorXd Descent::room() const {
  const VectorXd left = limits_ - walls_ * here_.theta.cwiseQuotient(scale_);
  return left.unaryExpr([](double l) { return l < 1e-12 ? 0.0 : l; });
}

double Descent::step_down(const AugmentedLine& l) {
  constexpr int attempts = 12;
  const VectorXd room = this->room();
  double growth = 2.0;
  for (int attempt = 0; attempt < attempts; ++attempt) {
    const VectorXd step = damped_step(l, walls_, room, damping_);
    if (auto there = try_at(predictor_.within_bounds(here_.theta + step.cwiseProduct(scale_)), here_.chi2);
        there && there->chi2 < here_.chi2) {
      const double gain = here_.chi2 - there->chi2, kept = 2 * gain / promised_gain(l, step) - 1;
      if (stand_at(std::move(*there))) {
        damping_ = std::max(damping_ * std::max(0.1, 1 - kept * kept * kept), 1e-9);  // Nielsen's rule
        return gain;
      }
    }
    damping_ *= growth, growth *= 2;
  }
  return 0.0;
}

void Descent::minimise() {
  constexpr int most_steps = 60, most_slow_steps = 4;
  constexpr double slow = 3.0;  // times the negligible gain
  damping_ = 1e-3;
  for (int steps = 0, slow_steps = 0; steps < most_steps && slow_steps < most_slow_steps; ++steps) {
    const AugmentedLine l = line();
    if (promised_gain(l, damped_step(l, walls_, room(), 0.0)) < negligible(here_.chi2)) return;
    const double gain = step_down(l);
    if (gain == 0.0) return;
    slow_steps = gain < slow * negligible(here_.chi2) ? slow_steps + 1 : 0;
  }
}

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
