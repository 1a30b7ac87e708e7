#include "compare/design/orthogonal_array.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <stdexcept>

#include "scenario/errors.hpp"
#include "scenario/nearest_word.hpp"
#include "scenario/source_text.hpp"

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

LevelTable orthogonal_array(int levels) {
  const GaloisField field(levels);
  LevelTable table{levels, {}};
  for (int a = 0; a < levels; ++a)
    for (int b = 0; b < levels; ++b) {
      std::vector<int> row{a, b};
      for (int m = 1; m < levels; ++m) row.push_back(field.sum(b, field.product(m, a)));
      table.rows.push_back(std::move(row));
    }
  return table;
}

LevelTable named_array(const std::string& name) {
  if (name == "L9") return orthogonal_array(3);
  if (name == "L16") return orthogonal_array(4);
  if (name == "L25") return orthogonal_array(5);
  const std::vector<std::string> names{"L9", "L16", "L25"};
  throw InputError(fmt::format("unknown orthogonal array '{}'{}\n  hint: there are {}", clipped(name),
                               did_you_mean(name, names), listed(names)));
}

LevelTable first_columns(const LevelTable& table, int columns) {
  if (columns > table.columns())
    throw InputError(
        fmt::format("{} factors need an array of as many columns, and this one has {}", columns, table.columns()));
  LevelTable part = table;
  for (std::vector<int>& row : part.rows) row.resize(static_cast<std::size_t>(columns));
  return part;
}

bool is_balanced(const LevelTable& table) {
  const std::size_t levels = static_cast<std::size_t>(table.levels),
                    columns = static_cast<std::size_t>(table.columns());
  for (std::size_t i = 0; i < columns; ++i)
    for (std::size_t j = i + 1; j < columns; ++j) {
      std::vector<int> met(levels * levels, 0);
      for (const std::vector<int>& row : table.rows)
        ++met[static_cast<std::size_t>(row[i]) * levels + static_cast<std::size_t>(row[j])];
      if (std::ranges::adjacent_find(met, std::not_equal_to<>()) != met.end()) return false;
    }
  return true;
}

}  // namespace soilbin::compare
