// A check that refuses bodies whose surfaces meet in one plane (a seam). Each surface finds its own contacts with a
// grain, so a grain on a seam would be pressed by both: twice as hard as beside it.
#pragma once

#include "dem/surface/body.hpp"

namespace soilbin::dem {

/// Throws InputError, with both surfaces and a point of the seam, for a body of which
/// - two planes are the same, or
/// - a vertex of one mesh lies on another surface, and a triangle there faces the same way as that within 0.2 rad (any
///   way, where both are sheets).
/// So two boxes may stand on each other, but a floor is to be one mesh or plane. Meshes that cross in one plane without
/// a vertex on each other are not noticed, and surfaces of different bodies are not looked at: those that move against
/// each other, as the halves of a shear box do, press a grain in their gap each for itself.
void check_seams(const Body& body);

}  // namespace soilbin::dem
