#include "compare/design/galois_field.hpp"

#include <fmt/core.h>

#include <stdexcept>

namespace soilbin::compare {
namespace {

bool is_prime(int q) {
  for (int d = 2; d * d <= q; ++d)
    if (q % d == 0) return false;
  return q >= 2;
}

/// Of polynomials over GF(2), modulo x^2 + x + 1.
int product_in_gf4(int a, int b) {
  int product = ((b & 1) ? a : 0) ^ ((b & 2) ? a << 1 : 0);
  if (product & 4) product ^= 0b111;
  return product;
}

}  // namespace

GaloisField::GaloisField(int q) : size_(q) {
  if (q != 4 && (q > 31 || !is_prime(q)))
    throw std::invalid_argument(fmt::format("no table of a field with {} elements", q));
  for (int a = 0; a < q; ++a)
    for (int b = 0; b < q; ++b) {
      sums_.push_back(q == 4 ? a ^ b : (a + b) % q);
      products_.push_back(q == 4 ? product_in_gf4(a, b) : a * b % q);
    }
}

}  // namespace soilbin::compare
