// Designs of experiments that fill the unit cube evenly: Latin hypercubes.
#pragma once

#include <Eigen/Dense>
#include <cstdint>

namespace soilbin::compare {

/// A Latin hypercube: `points` rows in the open unit cube of `dimensions`; each column has one point in each of
/// `points` equal slices, at a random place within it (McKay, Beckman and Conover 1979, Technometrics 21:239). The same
/// seed gives the same bits.
Eigen::MatrixXd latin_hypercube(int points, int dimensions, std::uint64_t seed);

/// A Latin hypercube whose points keep apart: of a seeded start, `swaps` exchanges of one coordinate of two points,
/// each kept where it lowers the sum of distance^-10 (phi_p of Morris and Mitchell 1995, J. Stat. Plan. Inference
/// 43:381). Points lie in the middle of their slices. Work grows as points * swaps.
Eigen::MatrixXd maximin_latin_hypercube(int points, int dimensions, std::uint64_t seed, int swaps = 2000);

}  // namespace soilbin::compare
