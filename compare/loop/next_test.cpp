#include "compare/loop/next_test.hpp"

#include <algorithm>
#include <cmath>

#include "scenario/errors.hpp"

namespace soilbin::compare {

using Eigen::Index;
using Eigen::Matrix4d;
using Eigen::MatrixXd;
using Eigen::Vector4d;
using Eigen::VectorXd;

namespace {

void set_condition(OperatingCondition& at, const std::string& name, double value) {
  if (name == "slip") at.slip = value;
  if (name == "load") at.load = value;
  if (name == "speed") at.speed = value;
  if (name == "pass") at.pass = static_cast<int>(std::lround(value));
  if (name == "yaw") at.yaw = value;
  if (name == "longitudinal_incline") at.longitudinal_incline = value;
  if (name == "transverse_incline") at.transverse_incline = value;
  if (name == "position") at.position = value;
  if (name == "moisture") at.moisture = value;
}

/// A rival's predictor with its fit, and the covariance of its parameters.
struct Contender {
  std::set<std::string> ids;
  WheelPredictor predictor;
  VectorXd theta;
  std::vector<int> free;
  MatrixXd covariance;  ///< of the free parameters [SI]
};

Contender contender(const Campaign& campaign, const Identification& id, const std::vector<Term>& terms, const Fit& fit,
                    std::set<std::string> ids) {
  Contender c{std::move(ids), WheelPredictor(campaign, id.observations, terms), fit.theta, fit.column_parameter, {}};
  MatrixXd gram = fit.columns.transpose() * fit.columns;
  gram.diagonal().array() += 1e-9;
  c.covariance = gram.ldlt().solve(MatrixXd::Identity(gram.rows(), gram.cols()));
  for (Index i = 0; i < gram.rows(); ++i)
    for (Index j = 0; j < gram.cols(); ++j)
      c.covariance(i, j) *=
          c.predictor.parameters()[static_cast<std::size_t>(c.free[static_cast<std::size_t>(i)])].scale *
          c.predictor.parameters()[static_cast<std::size_t>(c.free[static_cast<std::size_t>(j)])].scale;
  return c;
}

Vector4d as_vector(const bekker_wong::Reading& r) { return {r.drawbar_pull, r.torque, r.sinkage, r.lateral_force}; }

/// Variance that each term's form may be wrong by: its contribution times the form's tolerance, channel by channel.
Matrix4d form_variance(const Contender& c, const OperatingCondition& at, const Vector4d& here) {
  Matrix4d variance = Matrix4d::Zero();
  for (int t = 0; t < static_cast<int>(c.predictor.terms().size()); ++t) {
    VectorXd theta = c.theta;
    theta[c.predictor.amplitude_index(t)] = 0.0;
    const double tolerance = c.predictor.terms()[static_cast<std::size_t>(t)].form->form_tolerance;
    const Vector4d contribution = here - as_vector(c.predictor.reading(theta, at));
    variance.diagonal() += tolerance * tolerance * contribution.cwiseAbs2();
  }
  return variance;
}

/// Prediction and its covariance from the parameters' uncertainty, by one-sided differences of 0.1 sd, and from the
/// tolerance of its forms.
std::pair<Vector4d, Matrix4d> predict(const Contender& c, const OperatingCondition& at) {
  const Vector4d here = as_vector(c.predictor.reading(c.theta, at));
  MatrixXd jacobian(4, static_cast<Index>(c.free.size()));
  for (std::size_t i = 0; i < c.free.size(); ++i) {
    const FreeParameter& p = c.predictor.parameters()[static_cast<std::size_t>(c.free[i])];
    double step = 1e-3 * p.scale;
    if (c.theta[c.free[i]] + step > p.upper) step = -step;
    VectorXd theta = c.theta;
    theta[c.free[i]] += step;
    jacobian.col(static_cast<Index>(i)) = (as_vector(c.predictor.reading(theta, at)) - here) / step;
  }
  return {here, jacobian * c.covariance * jacobian.transpose() + form_variance(c, at, here)};
}

/// Squared distance of two predictions over noise and their uncertainties, over the measured channels.
double squared_distance(const std::pair<Vector4d, Matrix4d>& a, const std::pair<Vector4d, Matrix4d>& b,
                        const NoiseFloor& noise) {
  std::vector<int> measured;
  for (int c = 0; c < channel_count; ++c)
    if (noise.channels[static_cast<std::size_t>(c)].measured) measured.push_back(c);
  const Index n = static_cast<Index>(measured.size());
  VectorXd gap(n);
  MatrixXd spread(n, n);
  for (Index i = 0; i < n; ++i) {
    const int ci = measured[static_cast<std::size_t>(i)];
    gap[i] = a.first[ci] - b.first[ci];
    for (Index j = 0; j < n; ++j) {
      const int cj = measured[static_cast<std::size_t>(j)];
      spread(i, j) = a.second(ci, cj) + b.second(ci, cj) +
                     noise.correlation(ci, cj) * noise.channels[static_cast<std::size_t>(ci)].sd(a.first[ci]) *
                         noise.channels[static_cast<std::size_t>(cj)].sd(a.first[cj]);
    }
  }
  return gap.dot(spread.ldlt().solve(gap));
}

/// Every combination of a few levels of each limited condition, at most about a thousand.
std::vector<OperatingCondition> grid(const Observations& observations, const Limits& limits) {
  OperatingCondition centre = observations.rows[observations.rows.size() / 2];
  centre.run.reset();
  std::vector<OperatingCondition> points = {centre};
  for (const auto& [name, range] : limits) {
    const int levels = name == "slip" ? 6 : name == "pass" ? static_cast<int>(range.second - range.first) + 1 : 3;
    std::vector<OperatingCondition> more;
    const int used = points.size() * static_cast<std::size_t>(levels) > 1000 ? 1 : levels;
    for (const OperatingCondition& p : points)
      for (int k = 0; k < used; ++k) {
        OperatingCondition at = p;
        const double share = used > 1 ? static_cast<double>(k) / (used - 1) : 0.5;
        set_condition(at, name, range.first + share * (range.second - range.first));
        more.push_back(at);
      }
    points = std::move(more);
  }
  return points;
}

}  // namespace

Limits limits_of(const Observations& observations) {
  Limits limits;
  for (const Covariate& c : covariates(observations)) {
    if (c.name == "run") continue;
    limits[c.name] = {c.values.minCoeff(), c.values.maxCoeff()};
  }
  auto& slip = limits.try_emplace("slip", 0.05, 0.6).first->second;
  slip.first = std::min(slip.first, 0.05);
  slip.second = std::max(slip.second, 0.6);
  return limits;
}

std::optional<NextTest> next_test(const Campaign& campaign, const Identification& id,
                                  const std::vector<std::size_t>& rivals, const Limits& limits) {
  std::vector<Contender> competing;
  for (const std::size_t w : rivals) {
    const Rival& rival = id.rivals[id.weights[w].best_rival];
    competing.push_back(contender(campaign, id, rival.terms, rival.fit, rival.ids));
  }
  if (competing.size() < 2) competing.push_back(contender(campaign, id, {}, id.base, {}));
  constexpr double decided = 2 * 3.0;  // 2 ln 20: what lies further apart than that is decided by one run
  std::optional<NextTest> best;
  double most = 0.0;
  for (const OperatingCondition& at : grid(id.observations, limits)) try {
      std::vector<std::pair<Vector4d, Matrix4d>> predictions;
      for (const Contender& c : competing) predictions.push_back(predict(c, at));
      double worth = 0.0, widest = 0.0;
      std::pair<std::size_t, std::size_t> apart{0, 1};
      for (std::size_t i = 0; i < competing.size(); ++i)
        for (std::size_t j = 0; j < i; ++j) {
          const double d = squared_distance(predictions[i], predictions[j], id.noise);
          worth += std::min(d, decided);
          if (d > widest) widest = d, apart = {j, i};
        }
      if (worth <= most || !(widest > 0)) continue;
      most = worth;
      best = NextTest{.at = at,
                      .quantities = {},
                      .separates = {competing[apart.first].ids, competing[apart.second].ids},
                      .runs = static_cast<int>(std::ceil(decided / widest)),
                      .distance = widest};
    } catch (const NoSolution&) {  // no balance there: not a condition to ask for
    } catch (const InputError&) {}
  if (!best || best->runs > 50) return std::nullopt;
  best->runs = std::max(best->runs, 1);
  for (const auto& [name, range] : limits) best->quantities.push_back(name);
  return best;
}

}  // namespace soilbin::compare
