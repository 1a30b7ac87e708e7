// A run as the stages of a step see it: setup, state, and what follows from both and is made anew after each search
// for pairs. Every stage is a function of a World (step.hpp); Simulation is the one who owns it.
#pragma once

#include <vector>

#include "dem/engine/energy_ledger.hpp"
#include "dem/engine/kernels/kernels.hpp"
#include "dem/engine/sleeping.hpp"
#include "dem/engine/state.hpp"

namespace soilbin::dem {

/// The law's constants for each pair of materials, as kernels read them: 16 doubles each.
class LawTable {
 public:
  void fill(const Materials& materials, const ContactLaws& laws, double largest_radius);
  int kind(int a, int b) const { return a * materials_ + b; }
  const LawConstants<double>& operator[](int kind) const { return rows_[kind].constants; }
  const double* rows() const { return &rows_.data()->constants.normal; }
  int materials() const { return materials_; }

 private:
  struct alignas(64) Row {
    LawConstants<double> constants;
  };
  static_assert(sizeof(Row) == 16 * sizeof(double));
  AlignedVector<Row> rows_;
  int materials_ = 0;
};

/// How far apart things are that a search must find [m].
struct Margins {
  double motion = 0;    ///< by which a grain may come nearer before the next search
  double adhesion = 0;  ///< jkr: how far apart a contact still holds
  double both() const { return motion + adhesion; }
};

/// Bounds on how fast the points of turning bodies are: farthest distances from where a body turns.
struct Extents {
  std::vector<double> bodies;  ///< extent of each; -1: it has a plane
  Vec3 middle;                 ///< of a ball round all grains at the last search, for planes
  double around_middle = 0;

  /// How far from a body at `position` its points are that a grain may touch before the next search [m].
  double reach(std::size_t body, const Vec3& position, double margin) const {
    return bodies[body] < 0 ? length(position - middle) + around_middle + margin : bodies[body];
  }
};

struct World {
  Setup setup;
  State state;

  // Made from the setup.
  LawTable laws;
  Kernels kernels{};
  int threads = 1;
  Margins margins;

  // Made by the last search.
  KeptContacts kept;  ///< room for it
  Extents extents;
  Sleeping sleeping;
  EnergyLedger ledger;
  std::vector<int> blocks;    ///< of slabs that are worked on at once: first slab of each, and the end
  bool searched_now = false;  ///< in this step

  // Made in a step.
  Placed placed;
  PairSweep sweep{};
  std::vector<PairFindings> found;                           ///< of each slab
  std::vector<SlabSpeed> speeds;                             ///< of the grains of each slab
  std::vector<std::vector<SurfaceContact>> surfaces_before;  ///< contacts with surfaces of the step before, a slab each

  int slabs() const { return static_cast<int>(state.slab_rows.size()) - 1; }
  /// Kind of a grain's contact with another, or with a surface.
  int kind(std::uint32_t a, std::uint32_t b) const {
    return laws.kind(state.grains.material[a], state.grains.material[b]);
  }
  int kind(const NearSurface& near) const {
    return laws.kind(state.grains.material[near.grain], state.bodies[near.body].surfaces[near.surface].material);
  }
};

}  // namespace soilbin::dem
