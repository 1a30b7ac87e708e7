// What finished runs say about every point within the factors' bounds: surrogates of the targets, and how likely each
// point meets them.
#pragma once

#include <vector>

#include "compare/calibrate/calibration.hpp"

namespace soilbin::compare {

class LikelyPoints {
 public:
  struct Settings {
    double within = 0.03;    ///< share of each target that counts as meeting it
    int cloud = 4096;        ///< points of a Latin hypercube that are looked at
    std::uint64_t seed = 1;  ///< of cloud and surrogates
  };

  /// One surrogate a target, of all runs with results. Throws NoSolution where these are too few.
  LikelyPoints(const VirtualTest& test, const std::vector<CalibrationRun>& runs, const Settings& settings);

  /// Of cloud and tried points, the one with the largest chance; where no chance is above 1e-9, the one nearest to the
  /// targets by chi square. A point whose nearest run gave no result is not proposed.
  Candidate likeliest() const;
  /// The likeliest of the points that were run with a result.
  Candidate likeliest_tried() const;
  /// At most `count` points whose predictions are near every target: the likeliest, then each time the one farthest
  /// from those taken, so that they differ as the paper's do.
  std::vector<Candidate> spread_out(double near, int count) const;
  /// At most `count` points that were run and are predicted near every target, the likeliest first.
  std::vector<Candidate> tried_near(double near, int count) const;

  std::vector<LeaveOneOut> held_out() const;
  std::vector<double> extra_sd() const;
  double smallest_chi_square() const;
  /// Mean and sd of the factors under weights exp(-chi^2/2) over the cloud, and what that tells beyond the flat prior:
  /// 1 - sd/(width/sqrt 12), at least 0.
  void weigh(std::vector<Estimate>& parameters, std::vector<double>& learned) const;

 private:
  Candidate look_at(const Eigen::VectorXd& values) const;
  bool is_near(const Candidate& candidate, double near) const;
  bool is_nearest_to_a_failure(const Candidate& candidate) const;

  const VirtualTest& test_;
  Settings settings_;
  std::vector<Surrogate> surrogates_;
  std::vector<Candidate> cloud_, tried_;
  std::vector<Eigen::VectorXd> failed_;  ///< values of runs without a result
};

}  // namespace soilbin::compare
