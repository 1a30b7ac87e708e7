// The columns of a campaign's CSV: what each measures, and how a cell becomes a member of a Run.
#pragma once

#include <functional>
#include <map>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "compare/measured/campaign.hpp"
#include "scenario/csv.hpp"
#include "scenario/quantity.hpp"

namespace soilbin::compare {

/// A quantity that a column can hold.
struct RunColumn {
  enum class Content { number, whole_number, label };
  std::string quantity;   ///< as `columns:` names it: "drawbar_pull"
  std::string canonical;  ///< the header without any `columns:`: "drawbar_pull_N"
  Content content = Content::number;
  Measure measure{};                        ///< unit of the canonical column, range
  bool required = false;                    ///< the column, and a value in every row
  bool channel = false;                     ///< measured, not set
  std::string beside{};                     ///< canonical name of the channel whose scatter or error it tells
  std::function<void(Run&, double)> set{};  ///< SI; empty for labels
  std::function<std::optional<double>(const Run&)> get{};  ///< what to write; no value: an empty cell
};

/// Every column of the format (docs/reference/campaigns.md), in its order.
const std::vector<RunColumn>& run_columns();

/// A column of an actual file.
struct ColumnChoice {
  const RunColumn* column = nullptr;
  std::string unit;  ///< of the numbers in it
};

/// The column whose quantity a header begins with, the longest; nothing for none. Capitals do not count, and blanks and
/// hyphens stand for underscores: "Drawbar pull [kN]".
const RunColumn* column_begun_by(const std::string& header);

/// The unit that a header ends in, such as "km/h" in "speed_km_h"; "" where it ends in none of the right dimension.
std::string unit_at_the_end(const std::string& header, const RunColumn& column);

/// What a header that is a quantity with a unit of its own holds: "drawbar_pull_kN", "Slip [%]"; of a plain number or a
/// label the quantity alone will do.
std::optional<ColumnChoice> column_by_its_name(const std::string& header);

/// What a column of a spreadsheet most likely holds, by its heading and its cells.
struct LikelyColumn {
  std::string header;
  const RunColumn* column = nullptr;  ///< none: nothing that is compared, such as remarks
  std::string unit{};                 ///< of the numbers in it; "": its heading tells none
};

/// A guess for each column of a table: by the quantity or by what spreadsheets call it ("Weight N", "Depth mm", "Test
/// no."). No two are of one quantity; one that the quantity names goes before one that is guessed. A column of a number
/// has nothing else in its cells. Slips above 1 are in per cent, and loads in kg are weights (kgf).
std::vector<LikelyColumn> likely_columns(const CsvTable& table);

/// "{quantity: load, unit: kN}": a guess in the form of `columns:`; `unknown` where the heading tells no unit.
std::string renaming_of(const LikelyColumn& column, const std::string& unknown);

/// Turns the table's rows into runs. Throws InputError at the cell for whatever can't be one.
std::vector<Run> read_runs(const CsvTable& table, std::span<const ColumnChoice> columns, const SourceText& source);

/// The CSV of a campaign: the columns that hold anything and those of the quantities `to_fill_in`, under the names and
/// in the units of `named`, canonical where it has none.
std::string write_runs(const std::vector<Run>& runs, const std::set<std::string_view>& to_fill_in = {},
                       const std::map<std::string, DataColumn>& named = {});

}  // namespace soilbin::compare
