// What a bed is like: void ratio, density, coordination, measured away from walls, floor and surface.
#pragma once

#include <vector>

#include "dem/bed/insertion.hpp"
#include "dem/bed/surface_height.hpp"
#include "dem/engine/simulation.hpp"

namespace soilbin::dem {

/// Inner measures of the bin; the floor is z = 0, x and y start at 0 [m].
struct BedSize {
  double length = 2.5;  ///< along x
  double width = 0.8;   ///< along y
  double depth = 0.3;   ///< of the soil in it
};

/// How far a bed is from rest, by mean velocities and mean forces over a few steps. Rotation is left out and means are
/// taken because `directional` rolling resistance turns its couple round from step to step, so grains at rest tremble.
struct Unrest {
  double kinetic = 0;     ///< mean energy of a grain's straight motion over its weight times the mean diameter
  double unbalanced = 0;  ///< mean size of a grain's net force over the mean force of a contact
};

/// Vertical stress on a level cut through the bed, over the core of its
/// footprint.
struct StressAtDepth {
  double depth = 0;   ///< under the surface [m]
  double stress = 0;  ///< carried by contacts that the cut goes through [Pa]
  double weight = 0;  ///< of what lies above the cut over its area: rho_bulk g depth [Pa]
};

struct BedReport {
  std::size_t grains = 0;
  double height = 0;        ///< mean height of the surface, seen from above [m]
  double roughness = 0;     ///< standard deviation of that height [m]
  double void_ratio = 0;    ///< volume of voids over volume of grains, in the core
  double bulk_density = 0;  ///< in the core [kg/m^3]
  double coordination = 0;  ///< mean number of contacts a grain has, in the core
  double rattlers = 0;      ///< share of grains of the core with less than two contacts
  double overlap = 0;       ///< mean overlap over the mean diameter
  std::vector<StressAtDepth> stress;
  std::vector<double> void_ratio_along;  ///< in slices of the core along x
  Unrest unrest;
  double settling_time = 0;  ///< simulated until it was at rest [s]
};

/// Lower bounds are in a region, upper ones are not.
bool inside(const Region& region, const Vec3& at);

/// Counts the points of a lattice in a region that lie inside of grains.
class SolidLattice {
 public:
  SolidLattice(const Region& region, double spacing);
  void add(const Vec3& centre, double radius);
  /// Share of its points [0 .. 1].
  double share() const;

 private:
  Region region_;
  int nx_, ny_, nz_;
  Vec3 step_;
  std::vector<bool> filled_;
};

/// Share of a region that is inside of grains, counted on a lattice of points.
double solid_fraction(const Grains& grains, const Region& region, double spacing);

/// The part of the bed at least two mean diameters (but at most a quarter of
/// each side) from its bounds.
Region core(const BedSize& size, double height, double mean_diameter);

/// What adds up to the unrest of grains over a time [s].
struct UnrestSums {
  double kinetic = 0, net = 0, weight = 0, diameters = 0, grains = 0;
  double forces = 0, contacts = 0;  ///< sizes of the contacts' forces at the end [N], and their number

  void add(double mass, double radius, const Vec3& displacement, const Vec3& change_of_velocity, double g, double time);
  /// Means over many grains; rest where there are none.
  Unrest means() const;
};

/// Where grains are and how they move, by id, before some steps; and the unrest of those that are free over these. The
/// net force is what changed the velocities.
std::vector<Motion> watched(const Simulation& simulation);
Unrest unrest_since(const Simulation& simulation, const std::vector<Motion>& before, int steps);
/// Runs the simulation on by these steps.
Unrest unrest(Simulation& simulation, int steps = 16);
/// void ratio = 1/(share of grains) - 1; infinity without grains.
double void_ratio_of(double solid);

/// Takes a simulation to run on with. Gravity is taken along -z.
BedReport report_on(Simulation simulation, const BedSize& size);

}  // namespace soilbin::dem
