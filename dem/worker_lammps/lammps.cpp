#include "dem/worker_lammps/lammps.hpp"

#define LAMMPS_LIB_MPI  // lammps_open with a communicator
#define LMP_UTILS_H     // its templates want an older fmt than Debian has; nothing of it is called here
#include <lammps/domain.h>
#include <lammps/lammps.h>
#include <lammps/library.h>
#include <lammps/neighbor.h>

#include <array>
#include <vector>

#include "scenario/errors.hpp"

namespace soilbin::dem {
namespace {

template <class T>
T of_atoms(void* handle, const char* name) {
  return static_cast<T>(lammps_extract_atom(handle, name));
}

}  // namespace

Lammps::Lammps(MPI_Comm world, const std::string& log) {
  std::array<std::string, 7> words{"soilbin-lammps",           "-screen", "none", "-log",
                                   log.empty() ? "none" : log, "-nocite", ""};
  std::vector<char*> pointers;
  for (std::size_t k = 0; k + 1 < words.size(); ++k) pointers.push_back(words[k].data());
  handle_ = lammps_open(static_cast<int>(pointers.size()), pointers.data(), world, nullptr);
  if (!handle_) throw InputError("LAMMPS could not be started");
}

Lammps::~Lammps() { lammps_close(handle_); }

void Lammps::command(const std::string& line) const { lammps_command(handle_, line.c_str()); }

void Lammps::call_for_forces(const std::string& fix, ForceCall call, void* who) const {
  lammps_set_fix_external_callback(handle_, fix.c_str(), call, who);
}

void Lammps::add_grains(std::span<const int> ids, std::span<const Vec3> positions,
                        std::span<const Vec3> velocities) const {
  static_assert(sizeof(Vec3) == 3 * sizeof(double));
  const std::vector<int> types(ids.size(), 1);
  lammps_create_atoms(handle_, static_cast<int>(ids.size()), ids.data(), types.data(), &positions.data()->x,
                      &velocities.data()->x, nullptr, 0);
}

int Lammps::count() const { return lammps_extract_setting(handle_, "nlocal"); }
int Lammps::with_ghosts() const { return lammps_extract_setting(handle_, "nall"); }
double Lammps::total() const { return lammps_get_natoms(handle_); }

Lammps::Part Lammps::part() const {
  const LAMMPS_NS::Domain& domain = *static_cast<LAMMPS_NS::LAMMPS*>(handle_)->domain;
  const double *low = domain.sublo, *high = domain.subhi;
  return {{low[0], low[1], low[2]}, {high[0], high[1], high[2]}};
}

void Lammps::remove_grains(std::span<const int> rows) const {
  constexpr int bit = 2;  // of the first group behind `all`: there is no other
  command("group gone empty");
  int* groups = of_atoms<int*>(handle_, "mask");
  for (const int row : rows) groups[row] |= bit;
  command("delete_atoms group gone compress no");
  command("group gone delete");
}

double** Lammps::kept_by(const std::string& fix) const {
  return static_cast<double**>(lammps_extract_fix(handle_, fix.c_str(), LMP_STYLE_ATOM, LMP_TYPE_ARRAY, 0, 0));
}

Lammps::Rows Lammps::rows() const {
  return {.id = of_atoms<int*>(handle_, "id"),
          .radius = of_atoms<double*>(handle_, "radius"),
          .mass = of_atoms<double*>(handle_, "rmass"),
          .position = of_atoms<double**>(handle_, "x"),
          .velocity = of_atoms<double**>(handle_, "v"),
          .spin = of_atoms<double**>(handle_, "omega"),
          .torque = of_atoms<double**>(handle_, "torque")};
}

Lammps::Neighbours Lammps::neighbours() const {
  return {handle_, lammps_find_pair_neighlist(handle_, "gran/hooke", 1, 0, 0)};
}

bool Lammps::listed_anew() const { return static_cast<LAMMPS_NS::LAMMPS*>(handle_)->neighbor->ago == 0; }

int Lammps::Neighbours::size() const { return list_ < 0 ? 0 : lammps_neighlist_num_elements(handle_, list_); }

int Lammps::Neighbours::of(int k, std::span<const int>& rows) const {
  int row = 0, count = 0;
  int* first = nullptr;
  lammps_neighlist_element_neighbors(handle_, list_, k, &row, &count, &first);
  rows = {first, static_cast<std::size_t>(count)};
  return row;
}

double Lammps::memory() const {
  std::array<double, 3> megabytes{};  // LAMMPS's own count, the C library's, the largest resident size
  lammps_memory_usage(handle_, megabytes.data());
  return megabytes[0];
}

}  // namespace soilbin::dem
