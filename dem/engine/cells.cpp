#include "dem/engine/cells.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "scenario/errors.hpp"

namespace soilbin::dem {
namespace {

double component(const Vec3& a, int k) { return k == 0 ? a.x : k == 1 ? a.y : a.z; }

/// Cells along a side are no more than this, however far grains are apart; and of all, not many more than grains.
constexpr int most_cells_a_side = 1 << 16;

/// Sides of ten cells and less are left: a periodic one must keep four.
void thin_out(std::array<int, 3>& count, std::size_t grains) {
  const double most = 1024.0 + 2.0 * static_cast<double>(grains);
  while (static_cast<double>(count[0]) * count[1] * count[2] > most) *std::max_element(count.begin(), count.end()) /= 2;
}

}  // namespace

Cells::Cells(const Domain& domain, std::span<const Motion> grains, double reach) {
  std::array<double, 3> side{};
  for (int k = 0; k < 3; ++k) {
    double lower = component(domain.lower, k), upper = component(domain.upper, k);
    periodic_[k] = domain.periodic[k];
    if (periodic_[k]) {
      // Else a cell would be its own neighbour, or its neighbour twice.
      if (upper - lower < 4 * reach)
        throw InputError(
            fmt::format("a periodic side of {:.4g} m is shorter than four times the reach of a contact, {:.4g} m"
                        "\n  hint: lengthen the box, or make this side a wall",
                        upper - lower, 4 * reach));
    } else {
      double low = std::numeric_limits<double>::max(), high = std::numeric_limits<double>::lowest();
      for (const Motion& grain : grains) {
        low = std::min(low, component(grain.position, k));
        high = std::max(high, component(grain.position, k));
      }
      lower = std::max(lower, low);
      upper = std::min(upper, high);
    }
    side[k] = std::max(upper - lower, 0.0);
    count_[k] = static_cast<int>(std::clamp(std::floor(side[k] / reach), 1.0, double(most_cells_a_side)));
    lower_[k] = lower;
  }
  thin_out(count_, grains.size());
  for (int k = 0; k < 3; ++k) inverse_size_[k] = side[k] > 0 ? count_[k] / side[k] : 0;
  axis_ = static_cast<int>(std::max_element(count_.begin(), count_.end()) - count_.begin());
  inner_ = {axis_ == 0 ? 1 : 0, axis_ == 2 ? 1 : 2};
}

std::size_t Cells::cell_of(const Vec3& position) const {
  std::array<std::size_t, 3> k{};
  for (int i = 0; i < 3; ++i) {
    const double at = (component(position, i) - lower_[i]) * inverse_size_[i];
    k[i] = static_cast<std::size_t>(std::clamp(at, 0.0, count_[i] - 1.0));
  }
  return (k[axis_] * count_[inner_[0]] + k[inner_[0]]) * count_[inner_[1]] + k[inner_[1]];
}

std::vector<std::uint32_t> Cells::order(const Grains& grains) const {
  const std::size_t n = grains.count(), cells = cells_of_slab() * slab_count();
  std::vector<std::size_t> cell(n);
  std::vector<std::uint32_t> begin(cells + 1), order(n);
  for (std::size_t k = 0; k < n; ++k) ++begin[(cell[k] = cell_of(grains.motion[k].position)) + 1];
  for (std::size_t c = 0; c < cells; ++c) begin[c + 1] += begin[c];
  std::vector<std::uint32_t> next(begin.begin(), begin.end() - 1);
  for (std::size_t k = 0; k < n; ++k) order[next[cell[k]]++] = static_cast<std::uint32_t>(k);
  for (std::size_t c = 0; c < cells; ++c)
    std::sort(order.begin() + begin[c], order.begin() + begin[c + 1],
              [&](std::uint32_t a, std::uint32_t b) { return grains.id[a] < grains.id[b]; });
  return order;
}

void Cells::index(const Grains& sorted) {
  begin_.assign(cells_of_slab() * slab_count() + 1, 0);
  for (std::size_t k = 0; k < sorted.count(); ++k) ++begin_[cell_of(sorted.motion[k].position) + 1];
  for (std::size_t c = 0; c + 1 < begin_.size(); ++c) begin_[c + 1] += begin_[c];
}

}  // namespace soilbin::dem
