// Squares of residuals between setpoints and within them: what a model lacks, and the noise.
#pragma once

#include <vector>

namespace soilbin::compare {

/// One channel's residuals, summed setpoint by setpoint.
class SetpointSquares {
 public:
  /// conditions: how many setpoints there may be.
  explicit SetpointSquares(int conditions);
  void add(int condition, double residual);

  double between() const;    ///< sum of n mean^2 over the setpoints
  double largest() const;    ///< the largest of these
  double within() const;     ///< sum of squares about the setpoints' means
  double setpoints() const;  ///< that have a value
  double reruns() const;     ///< values beyond each setpoint's first: the freedom of `within`

 private:
  struct Sums {
    double sum = 0.0, squares = 0.0, count = 0.0;
    double square_of_mean() const { return count > 0 ? sum * sum / count : 0.0; }
  };
  std::vector<Sums> sums_;
};

}  // namespace soilbin::compare
