// Arithmetic in small finite fields, from which orthogonal arrays are made (orthogonal_array.hpp).
#pragma once

#include <vector>

namespace soilbin::compare {

/// A finite field GF(q) as tables. Its elements are 0 .. q - 1; 0 and 1 are what they are called.
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

}  // namespace soilbin::compare
