// Plate tests of several beds in one file, fitted apart: by the bed's preparation, its density, a box; as the beds of a
// soil (scenario/beds.hpp), and how n and the pressure change with the dry density, where three densities or more were
// pressed by one size of plate.
//
//   const PlateGroups groups = fit_groups(csv, {.by = "preparation"});
//   groups.all.front().value, groups.all.front().fit.exponent.estimate  // "loose", n
//
// n and the pressure P at the sinkage z = b are taken as powers of the dry density, n = n_0 (rho/rho_0)^m and so for P.
// A power of the dry density is the form that Ayers and Perumpral (1982, Trans. ASAE 25:1169) found for the cone index;
// that n and P follow it too is ours. P is the modulus of Reece's form p = P (z/b)^n (1965, Proc. Inst. Mech. Eng.
// 180:45): z = b lies among the readings, so n and P err nearly independently, as n and k at 1 m do not.
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "compare/bevameter/measured_plates.hpp"
#include "scenario/soil.hpp"
#include "scenario/source_text.hpp"

namespace soilbin::compare {

/// The tests that share what a column holds.
struct PlateGroup {
  std::string value;  ///< "" where the column is empty
  std::vector<MeasuredPlate> tests;
  MeasuredPlatesFit fit;
  std::optional<double> density{};  ///< [kg/m^3], where all of its tests have this one
};

/// y = y_0 (rho/rho_0)^power, y_0 with the share that it errs by; these two are independent at rho_0.
struct PowerOfDensity {
  double reference = 0.0, share = 0.0;  ///< y_0 and its standard error over it
  Estimate power;
};

struct DensityTrend {
  double density = 0.0;                ///< rho_0, the geometric mean of the groups' [kg/m^3]
  double lowest = 0.0, highest = 0.0;  ///< [kg/m^3]
  double radius = 0.0;                 ///< b [m]
  PowerOfDensity exponent, pressure;   ///< n [-], P [Pa]
  std::size_t densities = 0;
};

struct PlateGroups {
  std::string by;                       ///< the column
  std::vector<PlateGroup> all;          ///< in the order of the file
  std::optional<DensityTrend> trend{};  ///< of three densities or more
  /// n, k_c and k_phi of the groups that have a density, loosest first; none where two share one, where their plates
  /// differ in size, or where no soil has a k_phi or an n. Of one size of plate k_c is 0.
  std::vector<SemiEmpiricalSoil> beds{};
  std::optional<SemiEmpiricalSoil> at{};  ///< at the density that was asked for
};

/// The line of ln y over ln rho, all groups with one weight, errors by what the groups scatter about it where that is
/// more than their own, with Student's t. `errors`: of ln y. Throws InputError for fewer than three densities.
PowerOfDensity fit_power_of_density(const std::vector<double>& densities, const std::vector<double>& values,
                                    const std::vector<double>& errors);

struct GroupedPlates {
  std::string by;  ///< a column of the file
  std::vector<std::pair<std::string, std::string>> only{};
  std::optional<double> diameter{};
  PressureWindow window{};
  std::optional<double> density{};  ///< asked for [kg/m^3]
};

/// Reads the file as read_plates does, a group for each value of the column, and fits each as fit_measured_plates does.
/// Throws InputError, which names the group, and for a density out of reach of the beds, or asked of fewer than two.
PlateGroups fit_groups(const SourceText& csv, const GroupedPlates& asked);

}  // namespace soilbin::compare
