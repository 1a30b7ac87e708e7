// How the distance travelled depends on the soil's values, beside the drive itself.
#pragma once

#include <array>

#include "bekker_wong/transient/driven_wheel.hpp"
#include "scenario/soil_parameters.hpp"

namespace soilbin::bekker_wong {

/// What a drive may be differentiated by. Steps are relative: none of these may be 0.
inline constexpr std::array<SoilParameter, 5> drive_parameters = {
    soil_parameter("exponent"), soil_parameter("k_phi"), soil_parameter("cohesion"), soil_parameter("friction_angle"),
    soil_parameter("shear_modulus")};

/// Distance travelled after the drive's duration [m] and its derivatives by drive_parameters [m per SI unit].
struct TravelSensitivity {
  double travelled = 0.0;
  std::array<double, drive_parameters.size()> by_value{};
};

/// By CVODES' forward sensitivities; the rates' derivatives along them are central differences. The motor must stay
/// within its limits and the wheel on one soil. The start's own derivative is taken by central differences.
TravelSensitivity travel_sensitivity(const Scenario& scenario, const Drive& drive, const DriveNumerics& numerics = {});

/// The same by central differences of whole drives, `step` the relative change of each value.
TravelSensitivity travel_differences(const Scenario& scenario, const Drive& drive, double step,
                                     const DriveNumerics& numerics = {});

}  // namespace soilbin::bekker_wong
