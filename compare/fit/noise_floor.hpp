// The noise of each channel, from what no smooth function of the conditions explains.
#pragma once

#include <Eigen/Dense>
#include <array>
#include <vector>

#include "compare/fit/observations.hpp"

namespace soilbin::compare {

/// Standard deviation of a channel's noise, sqrt(a^2 + b^2 f^2 + q^2 s^2) at prediction f in a run whose mean
/// has the error s, or whose channel scattered by s in time (Cell::spread), and what it rests on.
struct ChannelNoise {
  bool measured = false;  ///< the campaign holds this channel
  double floor = 0.0;     ///< a, in the channel's unit
  double growth = 0.0;    ///< b [-]
  double unsteady = 0.0;  ///< q [-]; 0 where runs don't tell how they scattered, or it says nothing
  double spread = 0.0;    ///< median of s over the runs: of a run that is still to be made
  double freedom = 0.0;   ///< degrees of freedom behind the estimate
  double rerun_sd = 0.0;  ///< pooled standard deviation within re-run setpoints alone; 0 without re-runs
  double sd(double prediction, double scatter = 0.0) const;
};

struct NoiseFloor {
  std::array<ChannelNoise, channel_count> channels;
  Eigen::Matrix4d correlation = Eigen::Matrix4d::Identity();  ///< between channels of one run
  int rerun_freedom = 0;                                      ///< rows that repeat a setpoint
  double freedom() const;                                     ///< of all channels together
  double typical_freedom() const;  ///< of one channel, the mean: each channel's scale is known no better
};

/// Removes the noise's scale and correlation: L^-1 with L L' = covariance of one row's cells, row by row.
class Whitening {
 public:
  Whitening(const Observations& observations, const NoiseFloor& noise, const Eigen::VectorXd& prediction);
  /// Whitens cells that are means, each of `counts` values.
  Whitening(const Observations& observations, const NoiseFloor& noise, const Eigen::VectorXd& prediction,
            const Eigen::VectorXd& counts);
  Eigen::MatrixXd operator()(const Eigen::MatrixXd& columns) const;
  Eigen::VectorXd operator()(const Eigen::VectorXd& column) const;
  /// This whitening with one more source of noise: whitened columns, each of a weight with a unit normal prior.
  Whitening beside(const Eigen::MatrixXd& columns) const;
  /// That term's columns in the cells' units; empty where there is none.
  Eigen::MatrixXd term() const;

 private:
  friend class PartialChi2;
  struct Block {
    Eigen::Index first;
    Eigen::MatrixXd inverse_factor;
  };
  template <class Columns>
  Columns whitened(const Columns& columns) const;

  std::vector<Block> blocks_;
  /// Beside a term of columns U = Q R: then v becomes v + Q (L^-1 - 1) Q' v, L L' = 1 + R R'. Empty: no term.
  Eigen::MatrixXd term_basis_, term_change_, term_columns_;
};

/// chi2 of the rows heard so far: never more than that of all rows. Beside a term it is that of these rows alone, with
/// the covariance 1 + U U' that the term's whitened columns U give them.
class PartialChi2 {
 public:
  explicit PartialChi2(const Whitening& whitening);
  /// The residuals of a row, whose cells begin at `first`. Rows come in any order, each once.
  void add(Eigen::Index first, const Eigen::VectorXd& residual);
  /// A square that has no part in the term.
  void add(double square) { squares_ += square; }
  bool exceeds(double limit) const;

 private:
  const Whitening& whitening_;
  double squares_ = 0.0;
  Eigen::MatrixXd information_;  ///< 1 + U'U of the rows heard; empty: no term
  Eigen::VectorXd projection_;   ///< U' times their whitened residuals
};

/// What a noise estimate starts from: the cells' residuals about the declared soil's linearised prediction,
/// e = y - f + J (theta - prior), their predictions, and the columns of the soil's values (and
/// of what else is fitted) in units of the priors' sd.
struct NoiseData {
  Eigen::VectorXd residual;
  Eigen::VectorXd prediction;
  Eigen::MatrixXd soil_columns;
};

struct NoiseEstimate {
  NoiseFloor floor;
  std::vector<double> chance;  ///< of each cell: that noise alone would set it farther off the smooth fit of the others
};

/// Maximum likelihood of noise + soil values within their priors + a smooth function of the conditions of unknown size
/// (a variance-component model, as in Patterson and Thompson 1971), channel by channel, with a weak prior on the noise
/// (thresholds::typical_noise_share). Re-runs count by having the same smooth function.
NoiseEstimate estimate_noise(const Observations& observations, const NoiseData& data);

}  // namespace soilbin::compare
