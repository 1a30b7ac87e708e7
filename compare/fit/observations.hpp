// A campaign as the loop sees it: rows, cells (one measured channel of one row), conditions, covariates.
#pragma once

#include <Eigen/Dense>
#include <string>
#include <vector>

#include "compare/measured/campaign.hpp"

namespace soilbin::compare {

/// Places in channel_views and in every array over channels.
enum Channel { drawbar_pull = 0, torque = 1, sinkage = 2, lateral_force = 3 };
inline constexpr int channel_count = 4;
static_assert(channel_count == channel_views.size() && channel_views[drawbar_pull].name == "drawbar_pull" &&
              channel_views[torque].name == "torque" && channel_views[sinkage].name == "sinkage" &&
              channel_views[lateral_force].name == "lateral_force");

/// One measured number.
struct Cell {
  int row = 0;      ///< of Observations::rows
  int channel = 0;  ///< Channel
  double value = 0.0;
  /// Error of the mean over the run, or its standard deviation in time where no run of the campaign tells an error
  /// [SI]; the channel's median where this run doesn't tell and others do, 0 where none does.
  double spread = 0.0;
};

/// What may explain a residual: one column of numbers over the rows, only where it varies.
struct Covariate {
  std::string name;
  Eigen::VectorXd values;  ///< a row each [SI]; standardised copies are made where needed
};

/// The part of a campaign that a fit looks at.
struct Observations {
  std::vector<OperatingCondition> rows;
  std::vector<int> condition;   ///< of each row: rows of one condition are re-runs of one setpoint
  std::vector<int> source_row;  ///< index into Campaign::runs
  std::vector<Cell> cells;      ///< ordered by row, then channel
  int conditions = 0;
  /// The block of each condition: those without a label, so near each other that they may be re-runs, share one and
  /// are left out together, so that no prediction rests on a re-run of what it predicts.
  std::vector<int> block;

  Eigen::VectorXd values() const;
  /// Rows per condition beyond the first, summed: the degrees of freedom that re-runs alone give.
  int rerun_freedom() const;
  int blocks() const;
  /// How many conditions share their block with another.
  int conditions_in_blocks() const;
};

/// All runs of a campaign. Rows share a condition where their setpoint labels agree or, without labels, where every
/// stated condition agrees.
Observations observe(const Campaign& campaign);

/// The rows for which keep[condition] holds (conditions keep their numbers' order, renumbered from 0).
Observations of_conditions(const Observations& all, const std::vector<bool>& keep);

Observations without_cells(const Observations& all, const std::vector<bool>& drop);

/// The cells in the order in which the runs were made, where every row tells its own; else as the file has them.
std::vector<Eigen::Index> cells_in_order_of_runs(const Observations& observations);

/// Every covariate that takes at least two values: slip, load, speed, pass, inflation pressure,
/// position, moisture, run, inclines, yaw.
std::vector<Covariate> covariates(const Observations& observations);

}  // namespace soilbin::compare
