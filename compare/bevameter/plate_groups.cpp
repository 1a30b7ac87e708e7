#include "compare/bevameter/plate_groups.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "bekker_wong/gsl.hpp"
#include "compare/bevameter/plate_tests.hpp"
#include "scenario/beds.hpp"
#include "scenario/csv.hpp"
#include "scenario/errors.hpp"
#include "scenario/soil_parameters.hpp"

namespace soilbin::compare {
namespace {

constexpr std::size_t fewest_densities = 3;

std::optional<double> common_density(const std::vector<MeasuredPlate>& tests) {
  const std::optional<double> density = tests.front().density;
  const bool shared =
      std::ranges::all_of(tests, [&](const MeasuredPlate& test) { return test.density && test.density == density; });
  return shared ? density : std::nullopt;
}

/// How the values follow density, where three groups or more have one and one size of plate pressed them all.
std::optional<DensityTrend> trend_of(const std::vector<PlateGroup>& groups) {
  std::vector<double> densities, exponents, errors_of_n, pressures, errors_of_p;
  DensityTrend trend;
  for (const PlateGroup& group : groups) {
    if (!group.density) continue;
    const MeasuredPlatesFit& fit = group.fit;
    if (!fit.one_size() || (trend.radius > 0.0 && fit.radii.front() != trend.radius)) return std::nullopt;
    trend.radius = fit.radii.front();
    if (std::ranges::find(densities, *group.density) == densities.end()) ++trend.densities;
    const double n = fit.exponent.estimate.value, k = fit.k_phi.estimate.value;
    densities.push_back(*group.density);
    exponents.push_back(n), pressures.push_back(k * std::pow(trend.radius, n));
    errors_of_n.push_back(std::hypot(fit.exponent.between_tests, fit.exponent.between_readings) / n);
    errors_of_p.push_back(std::hypot(fit.k_phi.between_tests, fit.k_phi.between_readings) / k);
  }
  if (trend.densities < fewest_densities) return std::nullopt;
  trend.lowest = std::ranges::min(densities), trend.highest = std::ranges::max(densities);
  for (const double density : densities) trend.density += std::log(density) / static_cast<double>(densities.size());
  trend.density = std::exp(trend.density);
  trend.exponent = fit_power_of_density(densities, exponents, errors_of_n);
  trend.pressure = fit_power_of_density(densities, pressures, errors_of_p);
  return trend;
}

std::vector<SemiEmpiricalSoil> beds_of(const std::vector<PlateGroup>& groups) {
  std::vector<SemiEmpiricalSoil> beds;
  const PlateGroup* first = nullptr;
  for (const PlateGroup& group : groups) {
    if (!group.density) continue;
    if (!first) first = &group;
    const MeasuredPlatesFit& fit = group.fit;
    if (fit.radii != first->fit.radii || !(fit.k_phi.estimate.value > 0.0)) return {};
    if (!soil_parameter("exponent").range.holds(fit.exponent.estimate.value)) return {};
    SemiEmpiricalSoil& bed = beds.emplace_back();
    bed.exponent = fit.exponent.estimate, bed.k_phi = fit.k_phi.estimate, bed.density = group.density;
    bed.reference_sinkage = fit.reference_sinkage;
    if (!fit.one_size()) bed.k_c = fit.k_c.estimate;
  }
  std::ranges::sort(beds, {}, [](const SemiEmpiricalSoil& bed) { return *bed.density; });
  const auto same = [](const SemiEmpiricalSoil& one, const SemiEmpiricalSoil& other) {
    return one.density == other.density;
  };
  if (beds.size() < 2 || std::ranges::adjacent_find(beds, same) != beds.end()) return {};
  return beds;
}

}  // namespace

PowerOfDensity fit_power_of_density(const std::vector<double>& densities, const std::vector<double>& values,
                                    const std::vector<double>& errors) {
  const auto count = static_cast<double>(densities.size());
  if (densities.size() < fewest_densities)
    throw InputError(fmt::format("a power of the density needs {} densities", fewest_densities));
  // Equal weights about the mean of ln rho, where the two parameters are independent: the groups' errors differ less
  // than they are known.
  double middle = 0.0, mean = 0.0, xx = 0.0, xy = 0.0, told = 0.0;
  for (const double density : densities) middle += std::log(density) / count;
  for (std::size_t i = 0; i < values.size(); ++i) {
    const double x = std::log(densities[i]) - middle, y = std::log(values[i]);
    mean += y / count, xx += x * x, xy += x * y, told += errors[i] * errors[i] / count;
  }
  if (!(xx > 0.0)) throw InputError("a power of the density needs beds of different densities");
  const double power = xy / xx;
  double left = 0.0;
  for (std::size_t i = 0; i < values.size(); ++i)
    left += std::pow(std::log(values[i]) - mean - power * (std::log(densities[i]) - middle), 2);
  const double freedom = count - 2, scatter = left / freedom,
               variance = std::max(told, scatter * std::pow(gsl::student_factor(freedom), 2));
  return {
      .reference = std::exp(mean), .share = std::sqrt(variance / count), .power = {power, std::sqrt(variance / xx)}};
}

PlateGroups fit_groups(const SourceText& csv, const GroupedPlates& asked) {
  PlateGroups groups{.by = asked.by, .all = {}};
  const CsvTable table = parse_csv(csv, most_plate_rows);
  for (const std::string& value : values_of_column(table, csv, "--by", asked.by)) {
    std::vector<std::pair<std::string, std::string>> only = asked.only;
    only.emplace_back(asked.by, value);
    PlateGroup group{.value = value, .tests = read_plates(csv, table, only, asked.diameter), .fit = {}};
    if (group.tests.empty()) continue;  // --only leaves nothing of it
    try {
      group.fit = fit_measured_plates(group.tests, asked.window);
    } catch (const InputError& error) {
      throw InputError(fmt::format("{} '{}': {}", asked.by, clipped(value), error.what()));
    }
    group.density = common_density(group.tests);
    groups.all.push_back(std::move(group));
  }
  groups.trend = trend_of(groups.all);
  groups.beds = beds_of(groups.all);
  if (!asked.density) return groups;
  if (groups.beds.empty())
    throw InputError(
        "--density: these tests are no beds of several densities\n  hint: it needs a column dry_density_kg/m^3, two "
        "densities or more, each pressed by the same sizes of plates, and --by that column or the preparation");
  groups.at = bed_at(groups.beds, *asked.density);
  return groups;
}

}  // namespace soilbin::compare
