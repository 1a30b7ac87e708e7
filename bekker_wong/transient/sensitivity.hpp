// How the distance travelled depends on the soil's values, beside the drive itself.
#pragma once

#include <array>
#include <string_view>
#include <vector>

#include "bekker_wong/transient/driven_wheel.hpp"

namespace soilbin::bekker_wong {

/// A soil value that a drive may be differentiated by.
struct SoilParameter {
  std::string_view name;  ///< as in files
  Estimate SemiEmpiricalSoil::*value;
};
inline constexpr std::array<SoilParameter, 5> drive_parameters = {{
    {"exponent", &SemiEmpiricalSoil::exponent},
    {"k_phi", &SemiEmpiricalSoil::k_phi},
    {"cohesion", &SemiEmpiricalSoil::cohesion},
    {"friction_angle", &SemiEmpiricalSoil::friction_angle},
    {"shear_modulus", &SemiEmpiricalSoil::shear_modulus},
}};

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
