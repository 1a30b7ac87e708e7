#pragma once

namespace soilbin::dem {

/// Energy that left the motion since the start [J], summed step by step where Numerics::ledger is set.
struct Ledger {
  double damping = 0;        ///< lost in normal dashpots
  double shear_damping = 0;  ///< lost in tangential dashpots
  double sliding = 0;        ///< lost in sliders
  double into_slide = 0;     ///< taken by tangential springs, dashpots and sliders together
  double into_roll = 0;      ///< taken by rolling resistance, its springs included
  double added = 0;          ///< brought by grains that were added, less that of grains removed

  /// Takes powers [W] in the order of Losses, for a step.
  void add(const double (&powers)[5], double dt) {
    damping += powers[0] * dt;
    shear_damping += powers[1] * dt;
    sliding += powers[2] * dt;
    into_slide += powers[3] * dt;
    into_roll += powers[4] * dt;
  }
};

/// Where the energy is [J].
struct EnergyBalance {
  double kinetic = 0;         ///< of grains, and of bodies that move freely
  double potential = 0;       ///< of grains, and of bodies that weigh, from z = 0 of gravity's direction
  double elastic = 0;         ///< of normal springs, cohesion included
  double tangential = 0;      ///< of tangential springs
  double rolling = 0;         ///< of rolling springs
  double work_of_bodies = 0;  ///< done on the grains by bodies since the start
  Ledger ledger;

  /// Constant but for the error of the time step: what is there, plus what left, less what came.
  double total() const {
    return kinetic + potential + elastic + ledger.damping + ledger.into_slide + ledger.into_roll - work_of_bodies -
           ledger.added;
  }
};

}  // namespace soilbin::dem
