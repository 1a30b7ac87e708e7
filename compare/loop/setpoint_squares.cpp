#include "compare/loop/setpoint_squares.hpp"

#include <algorithm>

namespace soilbin::compare {

SetpointSquares::SetpointSquares(int conditions) : sums_(conditions) {}

void SetpointSquares::add(int condition, double residual) {
  Sums& s = sums_[condition];
  s.sum += residual, s.squares += residual * residual, s.count += 1;
}

double SetpointSquares::between() const {
  double total = 0.0;
  for (const Sums& s : sums_) total += s.square_of_mean();
  return total;
}

double SetpointSquares::largest() const {
  double most = 0.0;
  for (const Sums& s : sums_) most = std::max(most, s.square_of_mean());
  return most;
}

double SetpointSquares::within() const {
  double total = 0.0;
  for (const Sums& s : sums_) total += std::max(0.0, s.squares - s.square_of_mean());
  return total;
}

double SetpointSquares::setpoints() const {
  return static_cast<double>(std::count_if(sums_.begin(), sums_.end(), [](const Sums& s) { return s.count > 0; }));
}

double SetpointSquares::reruns() const {
  double values = 0.0;
  for (const Sums& s : sums_) values += s.count;
  return values - setpoints();
}

}  // namespace soilbin::compare
