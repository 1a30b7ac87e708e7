// A moving patch of soil: of a bed that repeats itself along the track without end, only the stretch around the wheel
// is simulated, and it goes along with the wheel. Grains enter ahead of it as they have settled, and leave behind it.
//
//   MovingPatch patch(tile_of(bed.setup, bed.state), {.behind = 0.3, .ahead = 0.4, .slab = 0.05});  // [m]
//   Simulation simulation = patch.open(setup, bed.state);
//   patch.follow(simulation, axle_x);  // between any two steps
//
// The tile is a bed that has settled with a periodic length (BedRecipe::periodic), so that copies of it, shifted by
// whole lengths, fit each other. The patch reaches from `rear()` to `front()` and stands still between two advances. At
// both ends a slab of grains is held: ahead those of the next slab, at the places where they have settled; behind those
// that the wheel has left, where they were when the patch went on. So neither end is a wall, and the soil meets its own
// continuation there. When the axle has gone on by a slab, the slab held ahead is let go, with what its contacts
// remember of the tile, and the slab beyond it comes in and is held; behind, the next slab is held and the one held so
// far leaves. What the tile itself holds, such as the grains on its floor, stays held. What is let go is in equilibrium
// where the wheel has not moved the soil yet: `disturbed()` tells.
//
// A later pass goes over the rut of the one before. A patch that keeps its rut writes each grain down as it is held
// behind the wheel, with what its contacts remember, and at its end all the others; `rut()` then takes the tile's
// place, and enters ahead of the wheel at the next pass.
//
// Compare the moving patches of Chrono (Tasora et al. 2016; Projectchrono reference manual, "Chrono::Vehicle, granular
// terrain"), which take away and add loose grains; here nothing falls into place again.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <vector>

#include "dem/archive/note_text.hpp"
#include "dem/bed/surface_height.hpp"
#include "dem/engine/simulation.hpp"

namespace soilbin::dem {

/// A grain of a tile, 0 <= x < length, or a sphere of a clump whose centre of mass lies there.
struct TileGrain {
  Vec3 position;
  double radius = 0;  ///< [m]
  double mass = 0;    ///< [kg]; of a clump's sphere the clump's; held_mass where it is held in the tile too
  std::int32_t material = 0;
  std::uint32_t clump = lone;
};

/// A contact of two grains of a tile, of which the second is that of `image` tiles on.
struct TileContact {
  std::uint32_t first = 0, second = 0;
  std::int32_t image = 0;
  std::array<double, memory_size> memory{};
};

/// A contact with a surface of the bed's body.
struct TileOnSurface {
  std::uint32_t grain = 0;
  std::uint16_t body = 0, surface = 0;
  Vec3 normal;
  std::array<double, memory_size> memory{};
};

/// A bed that has settled with a periodic length along x, and what its contacts remember.
struct Tile {
  double length = 0;  ///< [m]
  std::vector<TileGrain> grains;
  std::vector<TileContact> contacts;
  std::vector<TileOnSurface> on_surfaces;
  Clumps clumps;  ///< at rest; the row of a member is its number among the grains

  /// Where a grain is in the copy that lies `image` lengths on [m].
  Vec3 place(std::int64_t image, std::uint32_t grain) const {
    Vec3 at = grains[grain].position;
    at.x += static_cast<double>(image) * length;
    return at;
  }
  /// The x by which it enters and leaves: a clump goes as a whole [m].
  double x_of(std::int64_t image, std::uint32_t grain) const {
    const TileGrain& it = grains[grain];
    const double x = it.clump == lone ? it.position.x : clumps.all[it.clump].motion.position.x;
    return x + static_cast<double>(image) * length;
  }
  /// Radius of the largest grain, of a clump of the ball about its centre of mass that holds it [m].
  double largest() const;
};

/// Throws InputError for a domain that is not periodic along x, and for meshes among the bodies.
Tile tile_of(const Setup& setup, const State& state);

/// [m]
struct PatchSize {
  double behind = 0, ahead = 0;  ///< of the axle, to where grains are held; behind grows by a slab between two advances
  double slab = 0;               ///< by which the patch advances; as thick as what is held at each end
};

enum class KeepsRut { no, yes };

class MovingPatch {
 public:
  /// The axle begins at x = behind. Throws InputError for a slab thinner than the largest grain's diameter.
  MovingPatch(Tile tile, const PatchSize& size, KeepsRut keeps = KeepsRut::no);

  /// The patch as it begins: setup and bodies, gravity and time are the tile's; `way`: that the axle goes, at most [m].
  Simulation open(Setup setup, const State& tile, double way) const;
  /// Advances the patch by as many slabs as the axle has gone on.
  void follow(Simulation& simulation, double axle);
  /// The patch where it began, now of the rut that it has left so far, up to where its grains are held ahead; it keeps
  /// that of the next pass where `keeps` says so. No wheel may touch a grain. What has been thrown off the held grains
  /// behind is lost. `way`: that the axle goes now, at most what it went before [m].
  Simulation back_over_its_rut(const Simulation& simulation, double way, KeepsRut keeps);

  double rear() const { return static_cast<double>(advances_) * size_.slab; }  ///< x from which on grains are free [m]
  double front() const { return front(advances_); }                            ///< x up to which they are [m]
  std::int64_t advances() const { return advances_; }
  /// Grains that had been thrown onto what is held ahead, and left where others came in.
  std::int64_t thrown() const { return thrown_; }
  /// How far the grains just behind the slab that was let go had moved from where they had settled: their mean, of the
  /// advance where it was largest so far [m].
  double disturbed() const { return disturbed_; }
  /// Grains in the patch at once, about.
  double grains() const;

  /// The undisturbed surface, seen from above, anywhere along the track.
  SurfaceHeight undisturbed(const Footprint& over, double spacing) const;

  /// For StagedRun::keep.
  template <class Notes>
  void state(Notes& notes);

 private:
  double front(std::int64_t advances) const {
    return size_.behind + size_.ahead + static_cast<double>(advances) * size_.slab;
  }
  GrainId id(std::int64_t image, std::uint32_t grain) const;
  Vec3 home(GrainId id) const;
  void bring_contacts(double from, double to, Exchange& change,
                      const std::function<bool(double first, double second)>& wanted) const;
  void bring_grains(double from, double to, double free_from, double free_to, Exchange& change) const;
  void bring_clump(std::int64_t image, const Clump& clump, Exchange& change) const;
  void advance(Simulation& simulation);
  void note_disturbance(const Simulation& simulation, double from, double to);
  void write_down(const Simulation& simulation, double from, double to);

  Tile tile_;         ///< that enters ahead: settled, or of the pass before
  Tile undisturbed_;  ///< as it has settled, where a rut has taken its place
  PatchSize size_;
  bool keeps_ = false;
  Tile rut_;                     ///< of this pass, as far as it is left behind
  std::vector<GrainId> in_rut_;  ///< who its grains are in this pass
  std::int64_t advances_ = 0, thrown_ = 0;
  double disturbed_ = 0;
};

template <class Notes>
void archive(Notes& notes, TileGrain& g) {
  notes(g.position, g.radius, g.mass, g.material, g.clump);
}
template <class Notes>
void archive(Notes& notes, TileContact& c) {
  notes(c.first, c.second, c.image, c.memory);
}
template <class Notes>
void archive(Notes& notes, TileOnSurface& c) {
  notes(c.grain, c.body, c.surface, c.normal, c.memory);
}

template <class Notes>
void archive(Notes& notes, Clump& c) {
  Rotation& r = c.motion.rotation;
  notes(c.mass, c.inertia, c.motion.position, r.w, r.x, r.y, r.z, c.first, c.count);
}
template <class Notes>
void archive(Notes& notes, ClumpMember& m) {
  notes(m.arm, m.row);
}

template <class Notes>
void archive(Notes& notes, Tile& t) {
  notes(t.length, t.grains, t.contacts, t.on_surfaces, t.clumps.all, t.clumps.members);
}

template <class Notes>
void MovingPatch::state(Notes& notes) {
  notes(advances_, thrown_, disturbed_, keeps_, in_rut_, tile_, undisturbed_, rut_);
}

}  // namespace soilbin::dem
