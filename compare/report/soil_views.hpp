// The values of a semi-empirical soil as people read them.
#pragma once

#include <array>
#include <stdexcept>
#include <string>
#include <string_view>

#include "scenario/soil.hpp"
#include "scenario/unit.hpp"

namespace soilbin::compare {

/// One value: its names, the unit in which people read it, and where it stands.
struct SoilView {
  std::string_view name;   ///< in files: "friction_angle"
  std::string_view title;  ///< for people: "friction angle"
  std::string_view unit;   ///< "deg"; "-" of a plain number
  double per_si;           ///< units per SI unit
  Estimate SemiEmpiricalSoil::*value;
};

/// Those that a test of the soil gives with an error.
inline constexpr std::array<SoilView, 8> soil_views = {{
    {"exponent", "n", "-", 1.0, &SemiEmpiricalSoil::exponent},
    {"k_c", "k_c", "kN/m^(n+1)", 1e-3, &SemiEmpiricalSoil::k_c},
    {"k_phi", "k_phi", "kN/m^(n+2)", 1e-3, &SemiEmpiricalSoil::k_phi},
    {"cohesion", "cohesion c", "kPa", 1e-3, &SemiEmpiricalSoil::cohesion},
    {"friction_angle", "friction angle", "deg", 1 / degree, &SemiEmpiricalSoil::friction_angle},
    {"shear_modulus", "shear modulus K", "mm", 1e3, &SemiEmpiricalSoil::shear_modulus},
    {"stress_angle_c1", "c1", "-", 1.0, &SemiEmpiricalSoil::stress_angle_c1},
    {"stress_angle_c2", "c2", "-", 1.0, &SemiEmpiricalSoil::stress_angle_c2},
}};

/// Throws std::out_of_range for a name that is none of them.
inline const SoilView& soil_view(std::string_view name) {
  for (const SoilView& view : soil_views)
    if (view.name == name) return view;
  throw std::out_of_range("a soil value of no such name: " + std::string(name));
}

}  // namespace soilbin::compare
