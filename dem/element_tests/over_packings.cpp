#include "dem/element_tests/over_packings.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

namespace soilbin::dem {

Estimate over_packings(std::span<const Estimate> each) {
  std::vector<double> values;
  double squares = 0.0;
  for (const Estimate& one : each) values.push_back(one.value), squares += one.std_error * one.std_error;
  const Estimate mean = mean_of(values);
  return {mean.value, std::max(mean.std_error, std::sqrt(squares) / static_cast<double>(values.size()))};
}

}  // namespace soilbin::dem
