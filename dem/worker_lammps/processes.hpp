// What the processes of a run tell each other.
//
//   sum_up(world, {&sum, 1});                                      // of all, on each
//   const std::vector<PairContact> all = gathered(world, mine);    // of all, on each
#pragma once

#include <mpi.h>

#include <algorithm>
#include <cstdint>
#include <span>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

namespace soilbin::dem {

inline constexpr std::size_t grains_at_once = 100'000;  ///< on their way between processes

/// Sums over all processes, in their places; the same bits on each.
void sum_up(MPI_Comm world, std::span<double> numbers);

/// What the first of the processes that found a fault says of it; "" where none did. All call it.
std::string fault_of_any(MPI_Comm world, const std::string& mine);

/// The values of all processes, on each.
template <class T>
std::vector<T> gathered(MPI_Comm world, const std::vector<T>& mine) {
  static_assert(std::is_trivially_copyable_v<T>);
  int size = 0, bytes = static_cast<int>(mine.size() * sizeof(T));
  MPI_Comm_size(world, &size);
  std::vector<int> sizes(size), begins(size);
  MPI_Allgather(&bytes, 1, MPI_INT, sizes.data(), 1, MPI_INT, world);
  int sum = 0;
  for (int k = 0; k < size; ++k) begins[k] = std::exchange(sum, sum + sizes[k]);
  std::vector<T> all(static_cast<std::size_t>(sum) / sizeof(T));
  MPI_Allgatherv(mine.data(), bytes, MPI_BYTE, all.data(), sizes.data(), begins.data(), MPI_BYTE, world);
  return all;
}

/// Hands a list of the first process to all, in parts that have room everywhere.
template <class T, class Visit>
void in_parts(MPI_Comm world, const std::vector<T>& of_first, const Visit& visit) {
  static_assert(std::is_trivially_copyable_v<T>);
  int rank = 0;
  MPI_Comm_rank(world, &rank);
  std::uint64_t total = of_first.size();
  MPI_Bcast(&total, 1, MPI_UINT64_T, 0, world);
  for (std::size_t from = 0; from < total; from += grains_at_once) {
    std::vector<T> part(std::min<std::size_t>(grains_at_once, total - from));
    if (rank == 0) std::copy_n(of_first.begin() + static_cast<std::ptrdiff_t>(from), part.size(), part.begin());
    MPI_Bcast(part.data(), static_cast<int>(part.size() * sizeof(T)), MPI_BYTE, 0, world);
    visit(part);
  }
}

}  // namespace soilbin::dem
