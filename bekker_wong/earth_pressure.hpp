// Passive earth pressure: the force of the soil on a wall that pushes into it, by Rankine and by Hegedus, and the
// factors of Bekker's bulldozing resistance. Forces are per metre of the wall's width [N/m]; depth [m] >= 0 of the
// wall's foot under the surface. Every one is 0 at depth 0 and finite for 0 <= phi < 90 deg.
#pragma once

#include "bekker_wong/contact_patch.hpp"

namespace soilbin::bekker_wong {

/// Specific weight gamma = rho g [N/m^3].
double specific_weight(const SoilValues& soil);

/// N_phi = tan^2(45 deg + phi/2), Rankine's passive factor [-].
double flow_value(const SoilValues& soil);

/// What a soil does to a pushing wall, per metre of its width: cohesive d + weighty d^2 + surcharged q d [N/m], with
/// the surcharge q [Pa] on the soil's surface. Made once a soil, asked for many depths.
struct WallResistance {
  double cohesive = 0.0, weighty = 0.0, surcharged = 0.0;
  double operator()(double depth, double surcharge = 0.0) const {
    return depth * (cohesive + weighty * depth + surcharged * surcharge);
  }
};

/// Rankine's passive force on a vertical wall, gamma d^2 N_phi/2 + q d N_phi + 2 c d sqrt(N_phi) (Wong, Theory of
/// Ground Vehicles, ch. 2).
WallResistance passive_wall(const SoilValues& soil);
inline double passive_force(const SoilValues& soil, double depth, double surcharge = 0.0) {
  return passive_wall(soil)(depth, surcharge);
}

/// Hegedus' bulldozing resistance D_1 (c d + D_2 gamma d^2/2) with D_1 = cot X + tan(X + phi),
/// D_2 = cot X + cot^2 X tan phi, X = 45 deg - phi/2 (Hegedus 1960, as in Ishigami et al. 2007). Knows no surcharge.
WallResistance hegedus_wall(const SoilValues& soil);
inline double hegedus_force(const SoilValues& soil, double depth) { return hegedus_wall(soil)(depth); }

/// Terzaghi's bearing capacity factors as Bekker's bulldozing resistance takes them:
/// K_c = (N_c - tan phi) cos^2 phi, K_gamma = (2 N_gamma/tan phi + 1) cos^2 phi.
struct BearingFactors {
  double k_c, k_gamma;
};
BearingFactors bearing_factors(double friction_angle);

}  // namespace soilbin::bekker_wong
