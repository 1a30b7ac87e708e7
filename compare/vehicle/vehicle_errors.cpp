#include "compare/vehicle/vehicle_errors.hpp"

#include <algorithm>
#include <cmath>

#include "scenario/errors.hpp"

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

SteadyErrors errors_of_steady(const VehicleCase& question, const std::vector<VehicleWheel>& wheels, const Model& model,
                              const VehicleCondition& at) {
  constexpr std::size_t of_all = 4, of_wheel = 5;
  const VehicleNumbers errors =
      errors_of(wheels, of_all + of_wheel * wheels.size(), [&](const std::vector<VehicleWheel>& changed) {
        const SteadyVehicle vehicle = SteadyVehicles(question, changed, model).pulling(at);
        VehicleNumbers all = {vehicle.slip, vehicle.pull, vehicle.power.into_wheels, vehicle.steering};
        for (const SteadyWheel& wheel : vehicle.wheels) {
          const TractionResult& r = wheel.result;
          for (const double one : {wheel.normal_load, r.at.slip, r.drawbar_pull.value, r.torque.value, r.sinkage.value})
            all.push_back(one);
        }
        return all;
      });
  SteadyErrors all{errors[0], errors[1], errors[2], errors[3], {}};
  for (std::size_t i = of_all; i < errors.size(); i += of_wheel)
    all.wheels.push_back({errors[i], errors[i + 1], errors[i + 2], errors[i + 3], errors[i + 4]});
  return all;
}

}  // namespace soilbin::compare
