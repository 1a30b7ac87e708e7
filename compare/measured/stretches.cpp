#include "compare/measured/stretches.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "compare/measured/within_run_scatter.hpp"
#include "scenario/unit.hpp"

namespace soilbin::compare {
namespace {

/// What stretches cost, from sums over the rows before each.
class StretchCosts {
 public:
  StretchCosts(const std::vector<HeldSeries>& series, std::size_t first, std::size_t last) : first_(first) {
    for (const HeldSeries& one : series) {
      const double scale = one.tolerance, origin = one.values[first];
      Sums sums{{0.0}, {0.0}};
      for (std::size_t i = first; i < last; ++i) {
        const double x = (one.values[i] - origin) / scale;
        sums.linear.push_back(sums.linear.back() + x);
        sums.squares.push_back(sums.squares.back() + x * x);
      }
      all_.push_back(std::move(sums));
    }
  }

  /// Squares about the means of rows from .. to - 1.
  double operator()(std::size_t from, std::size_t to) const {
    const std::size_t a = from - first_, b = to - first_;
    double cost = 0.0;
    for (const Sums& sums : all_) {
      const double sum = sums.linear[b] - sums.linear[a];
      cost += std::max(0.0, sums.squares[b] - sums.squares[a] - sum * sum / static_cast<double>(b - a));
    }
    return cost;
  }

 private:
  struct Sums {
    std::vector<double> linear, squares;
  };
  std::size_t first_;
  std::vector<Sums> all_;
};

}  // namespace

double setpoint_tolerance(std::string_view quantity, std::string_view unit, double typical) {
  if (quantity == "slip") return 0.02;
  if (quantity == "moisture") return 0.01;
  if (unit == "deg") return 2 * degree;
  const double share = quantity == "speed" || quantity == "rotation" ? 0.1 : 0.05;
  return std::max(share * std::abs(typical), std::numeric_limits<double>::min());
}

double noise_in_steps(const std::vector<double>& values) {
  if (values.size() < 3) return 0.0;
  constexpr double median_step = 0.9538726;  // sqrt(2) times the third quartile of the normal distribution
  std::vector<double> steps;
  for (std::size_t i = 1; i < values.size(); ++i) steps.push_back(std::abs(values[i] - values[i - 1]));
  return upper_median(std::move(steps)) / median_step;
}

std::vector<std::size_t> stretch_starts(const std::vector<HeldSeries>& series, std::size_t first, std::size_t last) {
  if (last <= first) return {};
  if (series.empty()) return {first};
  constexpr std::size_t most_blocks = 2000;
  const StretchCosts cost(series, first, last);
  const double each = 20.0 + 5.0 * static_cast<double>(series.size());
  const std::size_t block = (last - first - 1) / most_blocks + 1, blocks = (last - first + block - 1) / block;
  const auto row_of = [&](std::size_t k) { return std::min(first + k * block, last); };
  std::vector<double> least(blocks + 1, 0.0);
  std::vector<std::size_t> begins(blocks + 1, 0);
  for (std::size_t end = 1; end <= blocks; ++end) {
    least[end] = std::numeric_limits<double>::infinity();
    for (std::size_t begin = 0; begin < end; ++begin) {
      const double total = least[begin] + cost(row_of(begin), row_of(end)) + each;
      if (total < least[end]) least[end] = total, begins[end] = begin;
    }
  }
  std::vector<std::size_t> starts;
  for (std::size_t end = blocks; end > 0; end = begins[end]) starts.push_back(row_of(begins[end]));
  std::ranges::reverse(starts);
  for (std::size_t k = 1; block > 1 && k < starts.size(); ++k) {
    const std::size_t before = starts[k - 1], after = k + 1 < starts.size() ? starts[k + 1] : last;
    std::size_t best = starts[k];
    double squares = cost(before, best) + cost(best, after);
    for (std::size_t row = std::max(before + 1, starts[k] - block); row < std::min(after, starts[k] + block); ++row) {
      const double other = cost(before, row) + cost(row, after);
      if (other < squares) squares = other, best = row;
    }
    starts[k] = best;
  }
  for (std::size_t k = 1; k < starts.size();) {  // a block across an end may have been a stretch of its own
    const std::size_t before = starts[k - 1], after = k + 1 < starts.size() ? starts[k + 1] : last;
    if (cost(before, after) - cost(before, starts[k]) - cost(starts[k], after) < each)
      starts.erase(starts.begin() + static_cast<std::ptrdiff_t>(k));
    else
      ++k;
  }
  return starts;
}

}  // namespace soilbin::compare
