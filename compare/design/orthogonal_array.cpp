#include "compare/design/orthogonal_array.hpp"

#include <fmt/core.h>

#include <algorithm>

#include "compare/design/galois_field.hpp"
#include "scenario/errors.hpp"
#include "scenario/nearest_word.hpp"
#include "scenario/source_text.hpp"

namespace soilbin::compare {

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
