#include "compare/design/factor.hpp"

namespace soilbin::compare {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

double level_value(const Factor& factor, int level, int levels) {
  return factor.lower + (factor.upper - factor.lower) * level / (levels - 1);
}

VectorXd to_unit(const std::vector<Factor>& factors, const VectorXd& values) {
  VectorXd unit(values.size());
  for (Index j = 0; j < values.size(); ++j) {
    const Factor& factor = factors.at(static_cast<std::size_t>(j));
    unit[j] = (values[j] - factor.lower) / (factor.upper - factor.lower);
  }
  return unit;
}

VectorXd from_unit(const std::vector<Factor>& factors, const VectorXd& unit) {
  VectorXd values(unit.size());
  for (Index j = 0; j < unit.size(); ++j) {
    const Factor& factor = factors.at(static_cast<std::size_t>(j));
    values[j] = factor.lower + (factor.upper - factor.lower) * unit[j];
  }
  return values;
}

MatrixXd unit_points(const LevelTable& design) {
  MatrixXd points(design.runs(), design.columns());
  for (int i = 0; i < design.runs(); ++i)
    for (int j = 0; j < design.columns(); ++j)
      points(i, j) = static_cast<double>(design.rows[i][j]) / (design.levels - 1);
  return points;
}

}  // namespace soilbin::compare
