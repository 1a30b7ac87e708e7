// The analytic wheel in balance with its load: the angles at which the soil carries it, and the stresses and forces
// then.
//
//   const RolledWheel wheel = RollingWheel(tire, soil_values, effects).roll({.load = 4000, .slip = 0.2});
//   wheel.reading.drawbar_pull, wheel.sinkage    // [N], [m]
//   wheel.patch.of(&ContactPatch::sigma)         // normal stress at each node [Pa]
#pragma once

#include <functional>
#include <optional>
#include <span>

#include "bekker_wong/contact_patch.hpp"
#include "bekker_wong/effect.hpp"
#include "scenario/errors.hpp"
#include "scenario/scenario.hpp"

namespace soilbin::bekker_wong {

struct FirstRoot;
struct NodeLayout;

/// Fills j_x and j_y of a patch whose geometry is there, in place of the steady motion's: for a wheel whose motion
/// changes while it is in contact.
using DisplacementFill = std::function<void(ContactPatch&, const Outline&)>;

/// Forces at one trial sinkage, in the wheel's axes, without the slope's share of the load.
struct WheelForces {
  double thrust = 0.0;      ///< b Int tau_x cos ds [N]
  double compaction = 0.0;  ///< -b Int sigma sin ds [N]: the compaction resistance, negative
  double side = 0.0;        ///< b Int tau_y ds [N], to the left
  double vertical = 0.0;    ///< load carried: b Int (sigma cos + tau_x sin) ds + added [N]
  double torque = 0.0;      ///< [N m], added torques included
  ForceLedger added;
};

/// A wheel in balance: angles, stresses, forces, readings.
struct RolledWheel {
  OperatingCondition at;
  Kinematics motion;
  ContactPatch patch;
  WheelForces forces;
  double balance_angle = 0.0;  ///< theta_1 that balances the load [rad]
  double sinkage = 0.0;        ///< z [m]
  double stress_share = 1.0;   ///< of the soil's stresses at this depth, where effects settled the wheel: they carry W
  bool gives_way = false;      ///< nothing balances: this is the wheel where the soil carries most
  double shortfall = 0.0;      ///< then: ln(load/most that the soil carries)
  Reading unmeasured;          ///< the same four channels before the sensor joint
  Reading reading;             ///< what conventions.md calls F_DP, M, z, F_y, after the sensor joint
};

/// Where a search for the balance may begin.
struct NearBalance {
  double angle = 0.0;      ///< theta_1 of this wheel on a soil nearby [rad]; 0: none is known
  double steepness = 0.0;  ///< d ln(load carried)/d ln(theta_1) there [-]; 0: not known
};

/// Why a tire that flattens carries less than its load [N], whatever the soil.
NoSolution crushed_tire(double carried, double load);

/// Deepest sinkage at which the model balances a load, as a share of the radius.
inline constexpr double max_sinkage_share = 0.9;
/// Deepest sinkage to which an effect may settle the wheel: the contact then reaches above the axle.
inline constexpr double max_settled_share = 1.5;

/// The Bekker / Wong-Reece wheel: a rigid wheel on soil, with effects (Wong and Reece 1967;
/// docs/reference/conventions.md). A value without hidden state; const members may be called from any number of
/// threads.
class RollingWheel {
 public:
  /// Throws InputError where a value is missing or outside its range (radius, width, K > 0; n > 0; 0 <= phi < 90 deg).
  RollingWheel(const Tire& tire, const SoilValues& soil, EffectList effects = {}, std::optional<Bin> bin = {});

  /// The balanced wheel. Throws InputError for an impossible condition, NoSolution where the wheel would sink deeper
  /// than 0.9 r or no sinkage carries the load.
  RolledWheel roll(const OperatingCondition& at) const;

  /// Rolls on failing soil too, which carries the load at no sinkage down to 0.9 r: then the wheel at the depth at
  /// which the soil carries most: its readings go on smoothly from those of the last load carried. For fits, which may
  /// cross such soils. Where a balance nearby is known with its steepness, to 1e-8 of the load. Throws InputError for
  /// an impossible condition, NoSolution where an effect would settle the wheel deeper than max_settled_share.
  RolledWheel roll_or_give_way(const OperatingCondition& at, const NearBalance& near = {}) const;

  /// The wheel at a given theta_1 [rad], balanced or not: forces.vertical says what it carries. For derivatives by the
  /// implicit function theorem and for looking at the balance. Where an effect settles the wheel, all other forces are
  /// those of its settled place with stresses that carry the load of `at`.
  RolledWheel at_entry_angle(const OperatingCondition& at, double theta_1) const;
  /// The wheel at theta_1 on given nodes: for differences between wheels, which must not change nodes in between.
  RolledWheel at_entry_angle(const OperatingCondition& at, double theta_1, const NodeLayout& nodes) const;
  /// The nodes that the wheel's stresses ask for at theta_1 [rad].
  NodeLayout nodes(const OperatingCondition& at, double theta_1) const;

  /// What presses on the ground where the motion is not steady: `displacement` gives j, theta_1 [rad] the depth;
  /// nothing is balanced, settled or read. The slip of `at` is what effects and angles look at. The patch is left
  /// filled.
  WheelForces hold(const OperatingCondition& at, double theta_1, const DisplacementFill& displacement,
                   ContactPatch& patch) const;

  /// The tread at theta_1 - since_entry [rad], which grow from the entry to the exit: of the patch the geometry alone,
  /// with arcs a radian [m] and, of a carcass that flattens, the belt's travel over r in since_entry.
  void tread(const OperatingCondition& at, double theta_1, std::span<const double> since_entry,
             ContactPatch& patch) const;

  /// Outline after the effects, and the contact's angles at theta_1 [rad].
  Outline outline(const OperatingCondition& at) const;
  ContactAngles angles(const OperatingCondition& at, double theta_1) const;

  const SoilValues& soil() const { return soil_; }
  const Tire& tire() const { return tire_; }

 private:
  struct Prepared;
  Prepared prepare(const OperatingCondition& at) const;
  ContactAngles angles(const Prepared&, double theta_1) const;
  void fill_patch(const Prepared&, double theta_1, ContactPatch&, const DisplacementFill& displacement = {}) const;
  NodeLayout layout_at(const Prepared&, double theta_1) const;
  WheelForces integrate(const Prepared&, const ContactPatch&) const;
  static double pressed(const Prepared&, const ContactPatch&);
  double lifted(const Prepared&, const ContactPatch&) const;
  double carrying_share(const Prepared&, const ContactPatch&) const;
  double vertical(const Prepared&, const ContactPatch&) const;
  /// Finds ln(theta_1) and leaves the patch filled for it; refines p's node layout on the way. Looks from `known`
  /// where that is known, and then for no higher place than the one that a climb from there leads to.
  FirstRoot balance(Prepared& p, const NearBalance& known, ContactPatch& patch) const;
  double static_angle(const Prepared&) const;
  bool is_smallest(const Prepared&, double log_theta) const;
  [[noreturn]] void refuse(const Prepared&, double highest, ContactPatch& patch) const;
  /// Forces, where the wheel settles and readings of a wheel whose patch is filled for theta_1; gives the load that it
  /// carried before it settled.
  double finish(const Prepared&, double theta_1, RolledWheel&) const;
  /// The sinkage that the effects make of one that balances the load, and the wheel moved there.
  double settled(const Prepared&, const ContactPatch&, double sinkage) const;
  void settle(const Prepared&, double deeper, RolledWheel&) const;
  void read(const Prepared&, RolledWheel&) const;

  Tire tire_;
  SoilValues soil_;
  EffectList effects_;
  std::optional<Bin> bin_;
};

}  // namespace soilbin::bekker_wong
