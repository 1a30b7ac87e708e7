#include "compare/design/factor.hpp"

#include <cmath>

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

namespace {

/// Bits of the standard's engine, turned into numbers by hand: the standard's distributions differ between libraries.
class Draw {
 public:
  explicit Draw(std::uint64_t seed) : engine_(seed) {}
  double unit() { return (static_cast<double>(engine_() >> 11) + 0.5) * 0x1p-53; }
  Index below(Index n) { return static_cast<Index>(engine_() % static_cast<std::uint64_t>(n)); }

 private:
  std::mt19937_64 engine_;
};

/// place(random): where in its slice a point lies, 0 .. 1.
MatrixXd hypercube(int points, int dimensions, Draw& random, const auto& place) {
  MatrixXd cube(points, dimensions);
  std::vector<int> slice(static_cast<std::size_t>(points));
  for (int j = 0; j < dimensions; ++j) {
    std::iota(slice.begin(), slice.end(), 0);
    for (Index i = points - 1; i > 0; --i) std::swap(slice[i], slice[random.below(i + 1)]);
    for (int i = 0; i < points; ++i) cube(i, j) = (slice[i] + place(random)) / points;
  }
  return cube;
}

/// Sum of distance^-10 of one row to all but itself.
double crowding(const MatrixXd& points, Index row) {
  double sum = 0.0;
  for (Index i = 0; i < points.rows(); ++i)
    if (i != row) sum += std::pow((points.row(i) - points.row(row)).squaredNorm(), -5.0);
  return sum;
}

}  // namespace

MatrixXd latin_hypercube(int points, int dimensions, std::uint64_t seed) {
  Draw random(seed);
  return hypercube(points, dimensions, random, [](Draw& r) { return r.unit(); });
}

MatrixXd maximin_latin_hypercube(int points, int dimensions, std::uint64_t seed, int swaps) {
  Draw random(seed);
  MatrixXd cube = hypercube(points, dimensions, random, [](Draw&) { return 0.5; });
  if (points < 2) return cube;
  for (int k = 0; k < swaps; ++k) {
    const Index a = random.below(points), b = random.below(points), j = random.below(dimensions);
    if (a == b) continue;
    // The distance between a and b is the same before and after, so it may count twice.
    const double before = crowding(cube, a) + crowding(cube, b);
    std::swap(cube(a, j), cube(b, j));
    if (crowding(cube, a) + crowding(cube, b) >= before) std::swap(cube(a, j), cube(b, j));
  }
  return cube;
}

}  // namespace soilbin::compare
