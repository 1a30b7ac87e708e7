// Where the energy of a run is, and where it went.
#pragma once

#include "dem/engine/kernels/grain_rows.hpp"

namespace soilbin::dem {

/// Energy that left the motion since the start [J], summed step by step where Numerics::ledger is set. Exact: counted
/// at the mean of the velocities half a step before and after, which is what the motion got. By the velocity before
/// alone: good to the first order in the step, and only where spins don't turn round from step to step, so not under
/// the rolling laws `directional` and `directional_with_twist` (docs/lab/element-tests.md).
struct EnergyLosses {
  double damping = 0;        ///< lost in normal dashpots; exact
  double shear_damping = 0;  ///< part of into_slide: lost in tangential dashpots; by the velocity before alone
  double sliding = 0;        ///< part of into_slide: lost in sliders; by the velocity before alone
  double into_slide = 0;     ///< taken by tangential springs, dashpots and sliders together; exact
  double into_roll = 0;      ///< taken by rolling resistance, its springs included; exact
  double adhesion = 0;       ///< left in contacts of jkr when they broke
  double added = 0;          ///< brought by what was added, removed or changed between steps, and at the start

  /// Adds what was lost in a step of dt [s].
  void add(const LostPower& lost, double dt) {
    damping += lost.damping * dt;
    shear_damping += lost.shear_damping * dt;
    sliding += lost.sliding * dt;
    into_slide += lost.into_slide * dt;
    into_roll += lost.into_roll * dt;
  }
};

/// Where the energy is [J].
struct EnergyBalance {
  double kinetic = 0;         ///< of grains, and of bodies where they move freely
  double potential = 0;       ///< of grains, and of bodies that weigh and are free to fall; 0 at z = 0
  double elastic = 0;         ///< of normal springs, cohesion included
  double tangential = 0;      ///< of tangential springs
  double rolling = 0;         ///< of rolling springs
  double work_of_drives = 0;  ///< done since the start by what drives bodies, and by what is applied to them
  EnergyLosses ledger;

  /// Zero but for the error of the time step: what is there, plus what left, less what came. So it stands where
  /// Numerics::ledger was set from the start; else it is constant. The error adds up with the second order in dt, and
  /// with the first where light bodies move freely: contacts with those are counted by the body's velocity half a step
  /// early. What doesn't add up is half a step's loss: the rest is told at t, what left only up to t - dt/2.
  double total() const {
    return kinetic + potential + elastic + ledger.damping + ledger.into_slide + ledger.into_roll + ledger.adhesion -
           work_of_drives - ledger.added;
  }
};

}  // namespace soilbin::dem
