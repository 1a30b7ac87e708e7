// The shear displacement along a contact that need not be steady: carried with the rim from entry to exit while the rim
// slides over the soil.
//
// Along theta the rim moves backward at w, so dj/dt - w dj/dtheta = v_j with j(theta_1) = 0; where nothing changes with
// time that is Wong and Reece's j (1967), by integration over theta. u = (theta_1 - theta)/(theta_1 - theta_2) keeps
// the nodes in the contact while its ends move: dj/dt at fixed u = v_j - c dj/du,
// c = (w + dtheta/dt at fixed u)/(theta_1 - theta_2).
#pragma once

#include <span>

namespace soilbin::bekker_wong {

/// Values at u_i = (i + 1)/N, i = 0 .. N - 1, with 0 at u = 0 (fresh soil). N >= 6.
using ShearLine = std::span<const double>;

/// dj/du at node i by differences of third order biased against the stream: the stream runs from entry to exit where
/// with_stream, else the other way. Second order at the first node.
double slope_at(ShearLine j, int i, bool with_stream);

/// j at 0 <= u <= 1 by the cubic through the four nearest values.
double value_at(ShearLine j, double u);

}  // namespace soilbin::bekker_wong
