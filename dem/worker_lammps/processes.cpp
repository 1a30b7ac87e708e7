#include "dem/worker_lammps/processes.hpp"

#include <array>

namespace soilbin::dem {

void sum_up(MPI_Comm world, std::span<double> numbers) {
  int rank = 0;
  MPI_Comm_rank(world, &rank);
  const int count = static_cast<int>(numbers.size());
  MPI_Reduce(rank == 0 ? MPI_IN_PLACE : numbers.data(), numbers.data(), count, MPI_DOUBLE, MPI_SUM, 0, world);
  MPI_Bcast(numbers.data(), count, MPI_DOUBLE, 0, world);
}

std::string fault_of_any(MPI_Comm world, const std::string& mine) {
  int rank = 0, size = 0;
  MPI_Comm_rank(world, &rank), MPI_Comm_size(world, &size);
  int who = mine.empty() ? size : rank;
  MPI_Allreduce(MPI_IN_PLACE, &who, 1, MPI_INT, MPI_MIN, world);
  if (who == size) return "";
  std::array<char, 1000> words{};
  mine.copy(words.data(), words.size() - 1);
  MPI_Bcast(words.data(), static_cast<int>(words.size()), MPI_CHAR, who, world);
  return words.data();
}

}  // namespace soilbin::dem
