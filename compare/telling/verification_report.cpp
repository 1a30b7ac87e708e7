// The engine's verification, as it is told; soilbin-verify/1.
#include <fmt/core.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "compare/report/json_fields.hpp"
#include "compare/telling/reports.hpp"
#include "dem/verification/cases.hpp"

namespace soilbin::compare {
namespace {

Json rows_json(std::span<const dem::VerificationRow> rows) {
  Json all = Json::array();
  for (const dem::VerificationRow& row : rows)
    all.push_back({{"case", row.name},
                   {"published", row.published},
                   {"ours", row.ours},
                   {"error", row.error()},
                   {"tolerance", row.tolerance},
                   {"unit", row.unit},
                   {"source", row.source},
                   {"pass", row.pass()}});
  return {{"format", "soilbin-verify/1"}, {"rows", std::move(all)}};
}

/// On a page with the source of each published number; a line of a terminal has no room for it.
Table rows_table(std::span<const dem::VerificationRow> rows, bool with_sources) {
  Table table{"",
              {"case", "published", "ours", "error", "tolerance", "unit", ""},
              {true, false, false, false, false, false, true}};
  if (with_sources) table.header.push_back("source"), table.text_columns.push_back(true);
  for (const dem::VerificationRow& row : rows) {
    std::vector<TableCell> cells = {row.name,
                                    fmt::format("{:.6g}", row.published),
                                    fmt::format("{:.6g}", row.ours),
                                    fmt::format("{:.2g}", row.error()),
                                    fmt::format("{:.2g}", row.tolerance),
                                    row.unit,
                                    row.pass() ? "ok" : "FAILED"};
    if (with_sources) cells.push_back(row.source);
    table.add(std::move(cells));
  }
  return table;
}

}  // namespace

Report report_on(std::span<const dem::VerificationRow> rows) {
  const std::string met = fmt::format("{} of {} cases within their tolerance",
                                      std::ranges::count_if(rows, &dem::VerificationRow::pass), rows.size());
  Report report{"Verification of the discrete element engine", "Against published numbers and closed forms."};
  report.add(Sentences(std::vector<std::string>{met + "."}), Told::to_look_at);
  report.add("Cases", rows_table(rows, true), Told::to_look_at);
  report.add(rows_table(rows, false), Told::on_terminals);
  report.add(Prose{{met}}, Told::on_terminals);
  report.data = [rows] { return rows_json(rows); };
  return report;
}

}  // namespace soilbin::compare
