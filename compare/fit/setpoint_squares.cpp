#include "compare/fit/setpoint_squares.hpp"

#include <algorithm>
#include <map>
#include <numeric>
#include <utility>

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
  return static_cast<double>(std::ranges::count_if(sums_, [](const Sums& s) { return s.count > 0; }));
}

double SetpointSquares::reruns() const {
  double values = 0.0;
  for (const Sums& s : sums_) values += s.count;
  return values - setpoints();
}

using Eigen::Index;
using Eigen::VectorXd;

namespace {

void shuffle_all(std::vector<Index>& items, std::mt19937_64& random) {
  for (std::size_t i = items.size(); i > 1; --i) std::swap(items[i - 1], items[random() % i]);
}

}  // namespace

SetpointPermutation::SetpointPermutation(const std::vector<int>& setpoint) {
  std::map<int, std::vector<Index>> places;
  for (std::size_t i = 0; i < setpoint.size(); ++i) places[setpoint[i]].push_back(i);
  std::map<std::size_t, Alike> by_size;
  for (const auto& [name, own] : places) {
    Alike& alike = by_size[own.size()];
    alike.size = own.size();
    alike.places.insert(alike.places.end(), own.begin(), own.end());
  }
  for (auto& [size, alike] : by_size) groups_.push_back(std::move(alike));
}

VectorXd SetpointPermutation::operator()(const VectorXd& values, std::mt19937_64& random) const {
  VectorXd moved(values.size());
  for (const Alike& alike : groups_) {
    std::vector<Index> setpoints(alike.places.size() / alike.size), own(alike.size);
    std::iota(setpoints.begin(), setpoints.end(), Index{0});
    shuffle_all(setpoints, random);
    auto to = alike.places.begin();
    for (const Index from : setpoints) {
      std::copy_n(alike.places.begin() + from * alike.size, alike.size, own.begin());
      shuffle_all(own, random);
      for (const Index place : own) moved[*to++] = values[place];
    }
  }
  return moved;
}

}  // namespace soilbin::compare
