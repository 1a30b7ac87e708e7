// LAMMPS's own library interface, wrapped once: a handle that closes itself, commands, and the arrays of the grains
// that this process holds. LAMMPS ends the process at a command it refuses (Debian builds it without exceptions), so
// nothing that must go on after an error may include this: soilbin-lammps is a program of its own.
//
//   Lammps lammps(MPI_COMM_WORLD);
//   lammps.command("atom_style sphere");
//   for (int row = 0; row < lammps.count(); ++row) lammps.rows().radius[row] = 0.01;
#pragma once

#include <mpi.h>

#include <span>
#include <string>

#include "dem/surface/vec3.hpp"

namespace soilbin::dem {

class Lammps {
 public:
  /// On all processes of `world`; writes nothing to the screen but its errors, which go to `log`, where that is given.
  explicit Lammps(MPI_Comm world, const std::string& log = "");
  Lammps(const Lammps&) = delete;
  Lammps& operator=(const Lammps&) = delete;
  ~Lammps();

  void command(const std::string& line) const;

  /// What a fix external calls: step, rows, their ids, and where forces on them go [N].
  using ForceCall = void (*)(void* who, std::int64_t step, int rows, int* ids, double** x, double** force);
  void call_for_forces(const std::string& fix, ForceCall call, void* who) const;

  /// Puts grains in: each process takes those that lie in its part of the box. All processes give the same.
  void add_grains(std::span<const int> ids, std::span<const Vec3> positions, std::span<const Vec3> velocities) const;

  int count() const;        ///< rows of this process: its own grains
  int with_ghosts() const;  ///< rows of its own and of copies of others' behind them
  double total() const;     ///< grains of all processes

  /// This process's part of the box [m]: each place of the box is in one.
  struct Part {
    Vec3 lower, upper;
  };
  Part part() const;
  /// Takes grains away, by rows of this process; LAMMPS must be set up anew before its next step.
  void remove_grains(std::span<const int> rows) const;
  /// What a fix keeps of each own grain, row by row.
  double** kept_by(const std::string& fix) const;

  /// Rows of own grains and, behind them, of copies. Pointers hold until the next step.
  struct Rows {
    int* id;
    double *radius, *mass;
    double **position, **velocity, **spin, **torque;
  };
  Rows rows() const;

  /// The pairs of grains that LAMMPS looks at, grain by grain; each pair once on a process that holds one of the two.
  class Neighbours {
   public:
    int size() const;
    /// Row of the k-th grain and rows of its neighbours, behind the mask that clears what LAMMPS marks in them.
    int of(int k, std::span<const int>& rows) const;
    static constexpr int mask = 0x1FFFFFFF;  ///< NEIGHMASK of LAMMPS's lmptype.h

   private:
    friend class Lammps;
    Neighbours(void* handle, int list) : handle_(handle), list_(list) {}
    void* handle_;
    int list_;
  };
  /// Pairs of pair_style gran/hooke. Only while forces are computed, or after.
  Neighbours neighbours() const;
  /// Whether they were listed anew, and grains went to other processes and rows, just before these forces; the same on
  /// all processes.
  bool listed_anew() const;

  /// Memory of this process [MB], as LAMMPS counts its arrays.
  double memory() const;

 private:
  void* handle_;
};

/// A row of LAMMPS's arrays of three.
inline Vec3 vec(const double* a) { return {a[0], a[1], a[2]}; }

}  // namespace soilbin::dem
