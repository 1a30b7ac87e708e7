// The order of the runs of a test, drawn: otherwise what drifts meanwhile looks like what was varied.
#pragma once

#include <cstddef>
#include <cstdint>
#include <numeric>
#include <random>
#include <utility>
#include <vector>

namespace soilbin::compare {

/// 0 .. count - 1 in an order drawn from the seed (Fisher and Yates), the same bits everywhere.
inline std::vector<std::size_t> drawn_order(std::size_t count, std::uint64_t seed) {
  std::vector<std::size_t> order(count);
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::mt19937_64 random(seed);
  for (std::size_t k = count; k > 1; --k) std::swap(order[k - 1], order[random() % k]);
  return order;
}

}  // namespace soilbin::compare
