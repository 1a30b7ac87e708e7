// The eight parameters of a semi-empirical soil as one table: names, symbols, units, ranges and meanings; and its
// values without an error. Reader, writer, schema, flags, fits, error propagation, tables and pages all go over them.
//
//   for (const SoilParameter& p : soil_parameters)
//     fmt::print("{} = {} {}\n", p.title, (soil.*p.value).value * p.per_si, p.unit);  // "cohesion c = 1.04 kPa"
#pragma once

#include <array>
#include <cmath>
#include <numbers>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>

#include "scenario/quantity.hpp"
#include "scenario/soil.hpp"

namespace soilbin {

/// One parameter: its names, its unit, what a file may hold, and where it stands.
struct SoilParameter {
  const char* name;     ///< in files: "friction_angle"
  const char* symbol;   ///< in equations: "phi"
  const char* title;    ///< for people: "friction angle"
  const char* unit;     ///< in files and tables: "deg"; "-": a plain number
  double per_si;        ///< units per SI unit
  Range range;          ///< what a file may hold [SI]
  const char* meaning;  ///< in the schema
  Estimate SemiEmpiricalSoil::*value;

  Measure measure() const { return {unit, range}; }
};

/// In the order in which files are written: n first, on which the units of k_c and k_phi depend.
inline constexpr std::array<SoilParameter, 8> soil_parameters = [] {
  using S = SemiEmpiricalSoil;
  constexpr double per_kilo = 1e-3, per_milli = 1e3;
  constexpr Range exponents{.lower = 0.05, .upper = 5.0}, c1s{.lower = 0.0, .upper = 1.0},
      c2s{.lower = -1.0, .upper = 2.0}, angles{.lower = 0.0, .upper = std::numbers::pi / 2, .upper_open = true};
  return std::array<SoilParameter, 8>{{
      {"exponent", "n", "n", "-", 1.0, exponents, "n of p = (k_c/b + k_phi) z^n", &S::exponent},
      {"k_c", "k_c", "k_c", "kN/m^(n+1)", per_kilo, any_value, "cohesive modulus", &S::k_c},
      {"k_phi", "k_phi", "k_phi", "kN/m^(n+2)", per_kilo, any_value, "frictional modulus", &S::k_phi},
      {"cohesion", "c", "cohesion c", "kPa", per_kilo, zero_or_more, "cohesion c of tau_max = c + p tan phi",
       &S::cohesion},
      {"friction_angle", "phi", "friction angle", "deg", 1 / degree, angles, "angle of shearing resistance phi",
       &S::friction_angle},
      {"shear_modulus", "K", "shear modulus K", "mm", per_milli, above_zero, "Janosi's shear deformation modulus K",
       &S::shear_modulus},
      {"stress_angle_c1", "c1", "c1", "-", 1.0, c1s, "c1 of theta_m = (c1 + c2 |s|) theta_1", &S::stress_angle_c1},
      {"stress_angle_c2", "c2", "c2", "-", 1.0, c2s, "c2 of theta_m = (c1 + c2 |s|) theta_1", &S::stress_angle_c2},
  }};
}();

/// A value of a soil that has no standard deviation and may be absent.
struct ExactSoilValue {
  const char* name;     ///< in files and tables: "density"
  const char* unit;     ///< the SI unit, in files and tables: "kg/m^3"
  const char* meaning;  ///< in the schema
  const char* example;  ///< of a flag
  std::optional<double> SemiEmpiricalSoil::*value;

  Measure measure() const { return {unit, above_zero}; }
};

inline constexpr const char* gravity_meaning = "that pulls on soil and wheel; absent: Earth's";

inline constexpr std::array<ExactSoilValue, 3> exact_soil_values = {{
    {"density", "kg/m^3", "bulk density", "1600kg/m^3", &SemiEmpiricalSoil::density},
    {"gravity", "m/s^2", gravity_meaning, "1.62m/s^2", &SemiEmpiricalSoil::gravity},
    {"reference_sinkage", "m", "sinkage whose pressure an error of n leaves as it is; absent: 1 m", "50mm",
     &SemiEmpiricalSoil::reference_sinkage},
}};

/// n, k_c, k_phi, c, phi and K: what plates and sheared rings measure.
inline constexpr std::span<const SoilParameter, 6> bevameter_parameters = std::span(soil_parameters).first<6>();

/// Throws std::out_of_range for a name that is none of them.
constexpr const SoilParameter& soil_parameter(std::string_view name) {
  for (const SoilParameter& parameter : soil_parameters)
    if (parameter.name == name) return parameter;
  throw std::out_of_range("a soil parameter of no such name: " + std::string(name));
}

/// By what k_c and k_phi change where n moves from one value to another and the pressure at the reference sinkage z_0
/// [m] stays, k z_0^n = constant [-].
inline double modulus_factor(double reference_sinkage, double from, double to) {
  return std::pow(reference_sinkage, from - to);
}
inline double modulus_factor(const SemiEmpiricalSoil& soil, double from, double to) {
  return modulus_factor(soil.reference_sinkage.value_or(1.0), from, to);
}

/// Moves a value as its error does: k_c and k_phi follow n, and are themselves moved as they are at the declared n.
inline void move_value(SemiEmpiricalSoil& soil, const SoilParameter& p, double to, double declared_exponent) {
  using S = SemiEmpiricalSoil;
  const double n = soil.exponent.value;
  const bool is_modulus = p.value == &S::k_c || p.value == &S::k_phi;
  (soil.*p.value).value = is_modulus ? to * modulus_factor(soil, declared_exponent, n) : to;
  if (p.value != &S::exponent) return;
  soil.k_c.value *= modulus_factor(soil, n, to), soil.k_phi.value *= modulus_factor(soil, n, to);
}

/// Whether this value's standard deviation is the share that its soil assumes, and no measured one.
inline bool has_assumed_sd(const SemiEmpiricalSoil& soil, const Estimate& value) {
  return value.std_error > 0.0 && value.std_error == soil.assumed_sd.value_or(0.0) * std::abs(value.value);
}

/// The soil with the values exact whose standard deviation is only assumed.
inline SemiEmpiricalSoil without_assumed_sd(SemiEmpiricalSoil soil) {
  for (const SoilParameter& p : soil_parameters)
    if (has_assumed_sd(soil, soil.*p.value)) (soil.*p.value).std_error = 0.0;
  soil.assumed_sd.reset();
  return soil;
}

}  // namespace soilbin
