#include "compare/vehicle/go_map.hpp"

#include <algorithm>
#include <boost/math/special_functions/erf.hpp>
#include <cmath>

#include "compare/design/space_filling.hpp"
#include "compare/vehicle/doubtful_numbers.hpp"
#include "scenario/unit.hpp"

namespace soilbin::compare {
namespace {

std::vector<double> degrees_up_to(double last, double step) {
  std::vector<double> all;
  for (int i = 0; i * step <= last; ++i) all.push_back(i * step * degree);
  return all;
}

double standard_normal_at(double share) { return std::sqrt(2.0) * boost::math::erf_inv(2.0 * share - 1.0); }

/// A drawn number held within its range; an open bound is kept away from by a thousandth of the way to the declared
/// one.
double held_within(const Range& range, double x, double declared) {
  constexpr double away = 1e-3;
  if (range.holds(x)) return x;
  if (x > range.lower) return range.upper_open ? range.upper - away * (range.upper - declared) : range.upper;
  return range.lower_open ? range.lower + away * (declared - range.lower) : range.lower;
}

bool goes(const SteadyVehicles& vehicles, const VehicleCondition& at) {
  try {
    vehicles.pulling(at);
    return true;
  } catch (const NoSolution&) {
    return false;
  }
}

/// How many of the slopes, from the first, it goes on: by halves.
std::size_t slopes_gone(const SteadyVehicles& vehicles, const VehicleCondition& asked, double heading,
                        const std::vector<double>& slopes) {
  std::size_t gone = 0, beyond = slopes.size();
  while (gone < beyond) {
    const std::size_t middle = (gone + beyond) / 2;
    if (goes(vehicles, heading_on(asked, slopes[middle], heading)))
      gone = middle + 1;
    else
      beyond = middle;
  }
  return gone;
}

}  // namespace

VehicleCondition heading_on(const VehicleCondition& asked, double slope, double heading) {
  VehicleCondition at = asked;
  at.slope = std::asin(std::sin(slope) * std::cos(heading));
  at.cross_slope = std::asin(std::clamp(std::sin(slope) * std::sin(heading) / std::cos(at.slope), -1.0, 1.0));
  constexpr double none = 1e-12;  // straight down is straight
  if (std::abs(at.cross_slope) < none) at.cross_slope = 0.0;
  if (std::abs(at.slope) < none) at.slope = 0.0;
  return at;
}

GoMap go_map(const VehicleCase& question, const std::vector<VehicleWheel>& wheels, const Model& model, GoMapPlan plan) {
  if (plan.samples < 1) throw InputError("a map needs one sample or more");
  GoMap map;
  map.slopes = plan.slopes.empty() ? degrees_up_to(35.0, 5.0) : plan.slopes;
  map.headings = plan.headings.empty() ? degrees_up_to(180.0, 30.0) : plan.headings;
  const std::vector<DoubtfulNumber> doubtful = doubtful_numbers(wheels);
  map.samples = doubtful.empty() ? 1 : plan.samples;
  const Eigen::MatrixXd drawn = latin_hypercube(map.samples, std::max(1, static_cast<int>(doubtful.size())), plan.seed);
  map.cells.assign(map.slopes.size(), std::vector<GoCell>(map.headings.size()));
  for (int sample = 0; sample < map.samples; ++sample) {
    std::vector<VehicleWheel> changed = wheels;
    for (std::size_t i = 0; i < doubtful.size(); ++i) {
      const DoubtfulNumber& one = doubtful[i];
      const double z = standard_normal_at(drawn(sample, static_cast<int>(i)));
      changed = one.in(std::move(changed), held_within(one.range, one.value + one.sd * z, one.value));
    }
    const SteadyVehicles vehicles(question, changed, model);
    for (std::size_t k = 0; k < map.headings.size(); ++k) {
      const std::size_t gone = slopes_gone(vehicles, question.condition, map.headings[k], map.slopes);
      for (std::size_t i = 0; i < gone; ++i) map.cells[i][k].chance += 1.0;  // a count, until all are drawn
    }
    if (plan.progress) plan.progress(static_cast<std::size_t>(sample) + 1, static_cast<std::size_t>(map.samples));
  }
  for (std::vector<GoCell>& row : map.cells)
    for (GoCell& cell : row) {
      cell.chance /= map.samples;
      cell.std_error = std::sqrt(cell.chance * (1.0 - cell.chance) / map.samples);
    }
  return map;
}

}  // namespace soilbin::compare
