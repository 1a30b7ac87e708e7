// The fit of a model to a campaign: least chi2 inside the parameters' bounds, with normal priors.
#pragma once

#include <Eigen/Dense>
#include <limits>
#include <optional>
#include <vector>

#include "compare/fit/noise_floor.hpp"
#include "compare/fit/wheel_predictor.hpp"

namespace soilbin::compare {

// Least squares within linear bounds ("walls") by Levenberg and Marquardt (Levenberg 1944, Marquardt 1963; damping
// after Nielsen 1999), which may cross soils that do not carry the wheel.

/// Residuals and what the parameters do to them. Rows: the whitened cells, one for each parameter with a prior, one for
/// each row of the campaign: what the soil falls short of its load.
struct AugmentedLine {
  Eigen::VectorXd residual;
  Eigen::MatrixXd columns;  ///< in units of the parameters' scale
};

/// One way from a start to the least chi2 near it. Where the soil does not carry the load of some rows, these are read
/// where it carries most, and chi2 grows by (ln(load/most carried)/thresholds::load_deficit_sd)^2 each: so chi2 is
/// smooth where the wheel would sink away, and a step need not stop there.
class Descent {
 public:
  /// near: what is known of the balances where it will begin.
  Descent(const WheelPredictor& predictor, const Eigen::VectorXd& values, const Whitening& whitening,
          BalanceMemory near = {});

  /// Puts it at theta, moved inside the walls; false where that is no soil for all of the rows. gives_way: may the soil
  /// give way, here and on the way from here?
  bool move_to(Eigen::VectorXd theta, bool gives_way);
  /// Goes downhill until the whole step of the linear model promises next to nothing.
  void minimise();

  /// Would the soil carry the wheel in every row at theta?
  bool would_carry(const Eigen::VectorXd& theta);
  /// Does it where this stands?
  bool carries() const { return carries(here_); }
  const Eigen::VectorXd& theta() const { return here_.theta; }
  const Eigen::VectorXd& prediction() const { return here_.prediction; }
  const Eigen::MatrixXd& jacobian() const { return slopes_.jacobian; }
  /// The balances there, to look from nearby; the soil may give way there.
  BalanceMemory balance() const;
  AugmentedLine line() const;
  /// Where some row falls short: the way that carries more at the least cost in chi2, of any length.
  Eigen::VectorXd strengthening_direction() const;

 private:
  struct Point {
    Eigen::VectorXd theta, prediction;
    BalanceMemory memory;
    double chi2 = 0.0;
  };
  Eigen::VectorXd residual(const Point& at) const;
  /// The point at theta; nothing where it is no soil for all rows, or where chi2 is surely greater than `limit`: then
  /// it was not read to the end.
  std::optional<Point> try_at(const Eigen::VectorXd& theta, double limit = std::numeric_limits<double>::infinity());
  static bool carries(const Point& at);
  /// Moves there if there are slopes there.
  bool stand_at(Point point);
  Eigen::VectorXd room() const;
  /// What one better step gained; 0 where none was found.
  double step_down(const AugmentedLine& line);

  const WheelPredictor& predictor_;
  const Eigen::VectorXd& values_;
  const Whitening& whitening_;
  Eigen::VectorXd scale_;
  Eigen::MatrixXd walls_;  ///< one a row, in units of scale
  Eigen::VectorXd limits_;
  Point here_;
  PredictionSlopes slopes_;  ///< there
  double damping_ = 1e-3;
};

/// The end of a fit. "Augmented" rows: the whitened cells, then one row a parameter with a prior.
struct Fit {
  Eigen::VectorXd theta;
  Eigen::VectorXd restart;            ///< where the way down ended, before the soil was made firm enough for every
                                      ///< condition: a start for the next fit, away from the bounds
  Eigen::VectorXd prediction;         ///< of the cells
  Eigen::MatrixXd jacobian;           ///< cells x parameters, unwhitened
  Eigen::VectorXd residual;           ///< augmented
  Eigen::MatrixXd columns;            ///< augmented Jacobian of the parameters that are not held by a bound, in
                                      ///< units of their scale; the wall of theta_m's law holds none
  std::vector<int> column_parameter;  ///< which parameter each column belongs to
  double chi2 = 0.0;                  ///< |residual|^2: cells and priors
  double chi2_cells = 0.0;
  BalanceMemory balance;  ///< at theta, to look from nearby; the soil may give way there
};

/// The least chi2 near `start` with a soil that carries the wheel in every condition; nothing where none is found. The
/// way there may cross soils that do not (Descent); where it ends at one, the soil is made firmer (k_phi, or where that
/// is known what costs chi2 least) until all is carried. near: what is known of the balances at the start.
std::optional<Fit> fit(const WheelPredictor& predictor, const Eigen::VectorXd& values, const Whitening& whitening,
                       const Eigen::VectorXd& start, BalanceMemory near = {});

}  // namespace soilbin::compare
