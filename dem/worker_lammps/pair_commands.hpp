// The engine's laws between two grains as LAMMPS's pair_style granular computes them: the same Hertz, Mindlin and
// rolling resistance, in LAMMPS's words.
//
//   for (const std::string& line : pair_commands(setup, rolling)) lammps.command(line);
//
// | engine (docs/theory/dem-laws.md)                     | LAMMPS |
// |-------------------------------------------------------|--------------------------------------------------------------|
// | F_e = (4/3) E* a delta, a = sqrt(R* delta)            | hertz/material, the same | | g_n = 2 sqrt(5/6) beta sqrt(2
// E* a m*)                | damping tsuji: alpha(e) sqrt(m* (4/3) E* a), so alpha =      | | | sqrt(5) beta; e is
// chosen so that Tsuji's polynomial gives it | | k_t = 8 G* a, g_t = g_n 2 sqrt(G*/E*)                 | mindlin NULL,
// damping as a share of g_n                      | | elastic_plastic: k = 2.25 k_n (mu_r R*)^2, k_n of the | sds: one k
// for all contacts, that of the bed's mean contact  | |   contact; couple at most mu_r R* F_N                 | radius;
// the same limit                                     | | linear cohesion                                       | none:
// the worker adds it (linear_pull)                       |
//
// What differs: where a contact slides, the engine keeps the dashpot's share in the slider and LAMMPS does not; while
// two grains part, F_N is 0 in the engine and the size of the pull in LAMMPS; the engine turns the tangential memory
// with the spin about the normal, LAMMPS does not. Sources: LAMMPS's documentation of pair_style granular, and tests of
// two grains beside the engine (tests/dem/lammps).
#pragma once

#include <string>
#include <vector>

#include "dem/engine/grains.hpp"
#include "dem/engine/state.hpp"

namespace soilbin::dem {

/// sds's constants, one for all contacts.
struct RollingSpring {
  double stiffness = 0;  ///< k [N/m]
  double damping = 0;    ///< [N s/m]
};

/// The spring of a typical contact of these grains: two of the mean radius and mass, whose contact circle has the
/// radius `contact` [m]. `setup`'s first material is the grains'.
RollingSpring rolling_spring(const Setup& setup, const Grains& grains, double contact);

/// Mean radius of the contact circles of a bed's grains on each other [m]; without contacts that of two mean grains
/// which overlap by a thousandth of their radius.
double mean_contact_radius(const Setup& setup, const State& state);

/// pair_style and pair_coeff for grains of the setup's first material. Throws InputError for laws that LAMMPS has no
/// counterpart of: hooke, jkr, directional and torsion_spring rolling, twisting.
std::vector<std::string> pair_commands(const Setup& setup, const RollingSpring& rolling);

/// The restitution for which Tsuji's polynomial, 1.2728 - 4.2783 e + 11.087 e^2 - 22.348 e^3 + 27.467 e^4 - 18.022 e^5
/// + 4.8218 e^6, gives this alpha in 0 .. 2.24. Below 0 where restitution is: only the polynomial reads it.
double tsuji_restitution(double alpha);

}  // namespace soilbin::dem
