// What a cone penetrometer and a tire's measures tell of a driven wheel: mobility numbers, and gross traction and
// motion resistance over the load by them. Dimensions are those of a pneumatic tire; all ratios are fits to tests.
//
//   const TireMeasures tire{.diameter = 0.704, .width = 0.226, .section_height = 0.15, .deflection = 0.02};  // [m]
//   const double number = brixius_number(310e3, tire, 3892);  // 10.76, of a cone index [Pa] and a load [N]
//   brixius(number, 0.1).net()                                // 0.198 of the load
#pragma once

#include "scenario/tire.hpp"

namespace soilbin::cone_index {

/// What the relations read of a tire [m], all > 0.
struct TireMeasures {
  double diameter = 0.0;        ///< d, unloaded, over the lugs
  double width = 0.0;           ///< b, of the section
  double section_height = 0.0;  ///< h, from the rim to the tread
  double deflection = 0.0;      ///< delta, on firm ground under the load; below h
};

/// Forces along the ground over the load [-], and how they change with the mobility number.
struct Ratios {
  double gross = 0.0;       ///< gross traction: torque over rolling radius and load
  double resistance = 0.0;  ///< motion resistance
  double gross_slope = 0.0, resistance_slope = 0.0;

  double net() const { return gross - resistance; }
  double net_slope() const { return gross_slope - resistance_slope; }
};

/// Brixius's mobility number of fine-grained soil [-],
///
///   B_n = (CI b d/W) (1 + 5 delta/h)/(1 + 3 b/d),
///
/// CI: cone index [Pa], > 0; W: load [N], > 0. After Brixius (1987), Traction prediction equations for bias ply tires,
/// ASAE paper 87-1622.
double brixius_number(double cone_index, const TireMeasures& tire, double load);

/// At a slip s of 0 .. 1 and B_n > 0,
///
///   gross = 0.88 (1 - e^(-0.1 B_n)) (1 - e^(-q s)) + r,   resistance = m/B_n + r + 0.5 s/sqrt(B_n),
///
/// of bias-ply tires, and of an unknown construction, q = 7.5, r = 0.04, m = 1, after Brixius (1987); of radial ones
/// q = 9.5, r = 0.0325, m = 0.9, after Zoz and Grisso (2003), Traction and tractor performance, ASAE 913C0403, from
/// memory; a public code (MAVS, brixius.cpp) has the r and m of radial tires and q = 10.5.
///
/// r is what the tire itself takes to roll: the torque gives it, and it does not reach the drawbar, so it stands in
/// both and cancels. MAVS, after Pan et al. 2004, has it in the resistance alone: its net traction is r less.
Ratios brixius(double number, double slip, std::optional<Construction> construction = std::nullopt);

/// Turnage's mobility number of sand [-],
///
///   N_s = G (b d)^1.5/W delta/h,
///
/// G: growth of the cone index with depth [Pa/m], > 0. After Turnage (1972), WES.
double turnage_number(double gradient, const TireMeasures& tire, double load);

/// At a slip s of 0 .. 1 and N_s > 0,
///
///   gross = X (N_s + 10)/(N_s + 10 + Y),  X = 0.66, Y = 4.71 + 1.72/s,
///
/// as the documentation of MAVS gives it (it names Mason et al. 2018, J. Terramechanics 79, whose relation in MAVS's
/// code is another); and at 20 % slip net = 0.53 - 4.5/(N_s + 3.7), from memory of the literature, after Turnage
/// (1984). Resistance is what the two leave at 20 % slip, and taken as that at every slip (our choice: no source that
/// we could read gives a motion resistance that fits them). It falls from 0.34 at N_s = 5 to 0.09 at 50 and rises to
/// 0.13 on very firm sand.
Ratios turnage(double number, double slip);

}  // namespace soilbin::cone_index
