#include "compare/calibrate/published_sets.hpp"

#include <fmt/core.h>

#include "compare/report/number_text.hpp"
#include "scenario/csv.hpp"
#include "scenario/nearest_word.hpp"
#include "scenario/quantity.hpp"

namespace soilbin::compare {
namespace {

std::string column_of(const Target& target) { return target.name + "_" + target.unit; }

std::size_t find_column(const CsvTable& table, const std::string& name, const SourceText& source) {
  std::vector<std::string> there;
  for (std::size_t i = 0; i < table.header.cells.size(); ++i) {
    if (table.header.cells[i].text == name) return i;
    there.push_back(table.header.cells[i].text);
  }
  source.refuse(0, fmt::format("no column '{}'", name), "there are " + listed(there));
}

double number_in(const CsvCell& cell, const std::string& unit, const SourceText& source) {
  const std::optional<double> value = read_number(cell.text);
  if (!value) source.refuse(cell.offset, fmt::format("'{}' is not a number", clipped(cell.text)));
  return *value / per_unit(unit);
}

}  // namespace

std::vector<PublishedSet> parse_published_sets(const SourceText& source, const VirtualTest& test) {
  const CsvTable table = parse_csv(source);
  const std::size_t name = find_column(table, "set", source);
  std::vector<PublishedSet> sets;
  for (const CsvRow& row : table.rows) {
    PublishedSet set{row.cells[name].text, Eigen::VectorXd(static_cast<Eigen::Index>(test.factors.size())), {}, {}};
    for (std::size_t j = 0; j < test.factors.size(); ++j)
      set.values[j] =
          number_in(row.cells[find_column(table, test.factors[j].name, source)], test.factors[j].unit, source);
    for (const Target& target : test.targets)
      set.published.push_back(number_in(row.cells[find_column(table, column_of(target), source)], target.unit, source));
    sets.push_back(std::move(set));
  }
  return sets;
}

void run_sets(std::vector<PublishedSet>& sets, const VirtualTest& test, std::uint64_t seed, ExperimentStore& store,
              const Watch& watch) {
  for (std::size_t i = 0; i < sets.size(); ++i) {
    tell(watch, fmt::format("set {} of {}", i + 1, sets.size()), i, sets.size());
    sets[i].ours = obtain(test, {sets[i].values, seed}, store).value();
  }
}

}  // namespace soilbin::compare
