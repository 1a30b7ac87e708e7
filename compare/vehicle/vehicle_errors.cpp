#include "compare/vehicle/vehicle_errors.hpp"

#include <algorithm>
#include <cmath>

#include "scenario/errors.hpp"
#include "scenario/soil_parameters.hpp"
#include "scenario/unit.hpp"

namespace soilbin::compare {

VehicleNumbers errors_of(const std::vector<VehicleWheel>& wheels, std::size_t count, const VehicleNumbersOf& numbers) {
  constexpr double share_of_sd = 1e-3, least = 1e-6, most = 1e-2;
  VehicleNumbers variance(count, 0.0);
  for (const DoubtfulNumber& one : doubtful_numbers(wheels)) {
    const double size = std::abs(one.value);
    const double step = size > 0.0 ? std::clamp(share_of_sd * one.sd, least * size, most * size) : share_of_sd * one.sd;
    const Neighbours beside = neighbours(one.value, step, one.range);
    const auto with = [&](double value) { return numbers(one.in(wheels, value)); };
    try {
      const VehicleNumbers below = with(beside.below), above = with(beside.above);
      for (std::size_t i = 0; i < count; ++i)
        variance[i] += std::pow((above[i] - below[i]) / (beside.above - beside.below) * one.sd, 2);
    } catch (const NoSolution&) {
      return VehicleNumbers(count, not_a_number);
    }
  }
  for (double& one : variance) one = std::sqrt(one);
  return variance;
}

}  // namespace soilbin::compare
