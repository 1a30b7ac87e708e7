// Factors: the numbers that a design of experiments varies, each with a name and bounds, and the unit cube that designs
// and surrogates work in.
#pragma once

#include <Eigen/Dense>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "compare/design/orthogonal_array.hpp"

namespace soilbin::compare {

/// A number that is varied between two bounds, lower < upper, both in SI.
struct Factor {
  std::string name;  ///< as in a file: "sliding_friction"
  double lower = 0.0;
  double upper = 1.0;
  std::string unit = "-";  ///< in which people read it
};

/// Levels spread evenly from the lower to the upper bound, both included. level: 0 .. levels - 1.
double level_value(const Factor& factor, int level, int levels);

/// A point of the box as one of the unit cube, and back.
Eigen::VectorXd to_unit(const std::vector<Factor>& factors, const Eigen::VectorXd& values);
Eigen::VectorXd from_unit(const std::vector<Factor>& factors, const Eigen::VectorXd& unit);

/// The design's runs as points of the unit cube, a row each.
Eigen::MatrixXd unit_points(const LevelTable& design);

// The order of the runs of a test, drawn: otherwise what drifts meanwhile looks like what was varied.

/// 0 .. count - 1 in an order drawn from the seed (Fisher and Yates), the same bits everywhere.
inline std::vector<std::size_t> drawn_order(std::size_t count, std::uint64_t seed) {
  std::vector<std::size_t> order(count);
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::mt19937_64 random(seed);
  for (std::size_t k = count; k > 1; --k) std::swap(order[k - 1], order[random() % k]);
  return order;
}

// Designs of experiments that fill the unit cube evenly: Latin hypercubes.

/// A Latin hypercube: `points` rows in the open unit cube of `dimensions`; each column has one point in each of
/// `points` equal slices, at a random place within it (McKay, Beckman and Conover 1979, Technometrics 21:239). The same
/// seed gives the same bits.
Eigen::MatrixXd latin_hypercube(int points, int dimensions, std::uint64_t seed);

/// A Latin hypercube whose points keep apart: of a seeded start, `swaps` exchanges of one coordinate of two points,
/// each kept where it lowers the sum of distance^-10 (phi_p of Morris and Mitchell 1995, J. Stat. Plan. Inference
/// 43:381). Points lie in the middle of their slices. Work grows as points * swaps.
Eigen::MatrixXd maximin_latin_hypercube(int points, int dimensions, std::uint64_t seed, int swaps = 2000);

}  // namespace soilbin::compare
