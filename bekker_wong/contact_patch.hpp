// The contact between wheel and soil, as arrays over quadrature nodes. The stages that fill it (contact_stages.hpp)
// run in this order: geometry, pressure, displacement, strength, shear. Effects change the arrays in place between
// the stages; one virtual call handles all nodes.
#pragma once

#include <array>
#include <span>

#include "scenario/unit.hpp"

namespace soilbin::bekker_wong {

/// Values of the soil as the wheel meets it [SI]; effects at the soil joint change a copy of the declared ones.
struct SoilValues {
  double exponent = 1.0;        ///< n [-]
  double k_c = 0.0;             ///< [N/m^(n+1)]
  double k_phi = 0.0;           ///< [N/m^(n+2)]
  double cohesion = 0.0;        ///< c [Pa]
  double friction_angle = 0.0;  ///< phi [rad]
  double shear_modulus = 0.01;  ///< K [m]
  double c1 = 0.0;              ///< theta_m = (c1 + c2 |s|) theta_1
  double c2 = 0.0;
  double density = 1500.0;            ///< [kg/m^3]
  double gravity = standard_gravity;  ///< [m/s^2]
  double reference_sinkage = 1.0;     ///< whose pressure an error of n leaves as it is [m]; read by standard errors
  /// k_c/b + k_phi for a contact of width b [m].
  double pressure_modulus(double width) const { return k_c / width + k_phi; }
};

/// Where the wheel keeps the soil_parameters, in their order.
inline constexpr std::array<double SoilValues::*, 8> soil_members = {
    &SoilValues::exponent,       &SoilValues::k_c,           &SoilValues::k_phi, &SoilValues::cohesion,
    &SoilValues::friction_angle, &SoilValues::shear_modulus, &SoilValues::c1,    &SoilValues::c2};

/// Outline of the wheel; effects at the outline joint change it.
struct Outline {
  double radius = 0.0;        ///< of the circle that presses on the soil [m]
  double width = 0.0;         ///< [m]
  double shear_radius = 0.0;  ///< radius on which the soil shears and the torque's arm [m]
  double slip_radius = 0.0;   ///< radius whose slip it is: the shear circle meets the soil at v_x/(r w) times this [m]
};

/// Angles from the vertical, entry side positive [rad].
struct ContactAngles {
  double entry = 0.0;       ///< theta_1
  double max_stress = 0.0;  ///< theta_m
  double exit = 0.0;        ///< theta_2
};

/// Struct of arrays over the nodes; 256 nodes are four segments of 64, the most that the balance uses.
struct ContactPatch {
  static constexpr int capacity = 256;
  using Array = std::array<double, capacity>;

  int count = 0;
  ContactAngles angles;
  double deflection = 0.0;  ///< of a carcass that flattens: how far the lowest point stays above the circle's [m]
  // geometry
  Array theta;        ///< angle from the vertical [rad]
  Array normal_sine;  ///< direction of the surface's normal: sin and cos of its angle from the vertical
  Array normal_cosine;
  Array arc;           ///< quadrature weight times arc length [m]
  Array arm;           ///< arm of the shear stress about the axle [m]
  Array depth;         ///< depth that the pressure law sees [m]; behind theta_m that of the mirror angle theta_e
  Array circle_depth;  ///< depth of the circle there [m], where the tread of a carcass that flattens lies less deep
  Array since_entry;   ///< theta_1 - theta [rad]
  Array sine_drop;     ///< sin(theta_1) - sin(theta)
  // stresses
  Array sigma;         ///< normal stress [Pa]
  Array j_x, j_y;      ///< shear displacement in the wheel's plane and across it [m]; locked: direction only
  Array strength;      ///< shear strength of the soil [Pa]
  Array modulus;       ///< K [m]
  Array mobilised;     ///< share of the strength that the displacement calls up, 0 .. 1
  Array tau_x, tau_y;  ///< shear stress [Pa]

  /// The arrays are left unset: the stages fill the first `count` of each.
  ContactPatch() {}  // NOLINT(modernize-use-equals-default): = default would zero 30 kB in value-initialisation

  std::span<double> of(Array ContactPatch::*member) {
    return {(this->*member).data(), static_cast<std::size_t>(count)};
  }
  std::span<const double> of(Array ContactPatch::*member) const {
    return {(this->*member).data(), static_cast<std::size_t>(count)};
  }
};

}  // namespace soilbin::bekker_wong
