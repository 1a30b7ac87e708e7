// Orthogonal arrays: few runs in which every pair of factors meets every pair of levels equally often.
#pragma once

#include <string>
#include <vector>

namespace soilbin::compare {

/// A small finite field GF(q) as tables, from which the arrays are made. Its elements are 0 .. q - 1; 0 and 1 are what
/// they are called.
class GaloisField {
 public:
  /// q: a prime up to 31 (arithmetic modulo q), or 4 (polynomials over GF(2) modulo x^2 + x + 1; the element's bit k is
  /// the coefficient of x^k). Throws std::invalid_argument for any other.
  explicit GaloisField(int q);

  int size() const { return size_; }
  int sum(int a, int b) const { return sums_[a * size_ + b]; }
  int product(int a, int b) const { return products_[a * size_ + b]; }

 private:
  int size_;
  std::vector<int> sums_, products_;
};

/// Runs x factors of levels 0 .. levels - 1.
struct LevelTable {
  int levels = 0;
  std::vector<std::vector<int>> rows;

  int runs() const { return static_cast<int>(rows.size()); }
  int columns() const { return rows.empty() ? 0 : static_cast<int>(rows.front().size()); }
};

/// The array of q^2 runs, q + 1 factors and strength 2 over GF(q) (Bose 1938, Sankhya 3:323; Bush 1952, Ann. Math.
/// Stat. 23:426): run (a, b) has the levels a, b, and b + m a for m = 1 .. q - 1. q = 3, 4, 5 are Taguchi's L9(3^4),
/// L16(4^5) and L25(5^6), in his order of rows and columns. Throws std::invalid_argument where GaloisField does.
LevelTable orthogonal_array(int levels);

/// The arrays that have a name: "L9", "L16", "L25". Throws InputError with the nearest right name.
LevelTable named_array(const std::string& name);

/// The first `columns` columns; what is left out is free for the error. Throws InputError where there are too few.
LevelTable first_columns(const LevelTable& table, int columns);

/// Whether every pair of columns holds every pair of levels equally often (strength 2), and so every column every
/// level.
bool is_balanced(const LevelTable& table);

}  // namespace soilbin::compare
