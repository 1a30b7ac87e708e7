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

Table rows_table(std::span<const dem::VerificationRow> rows) {
  Table table{"", {"case", "published", "ours", "error", "tolerance", "unit", ""}};
  for (const dem::VerificationRow& row : rows)
    table.add({row.name, fmt::format("{:.6g}", row.published), fmt::format("{:.6g}", row.ours),
               fmt::format("{:.2g}", row.error()), fmt::format("{:.2g}", row.tolerance), row.unit,
               row.pass() ? "ok" : "FAILED"});
  return table;
}

}  // namespace

Report report_on(std::span<const dem::VerificationRow> rows) {
  const std::string met = fmt::format("{} of {} cases within their tolerance",
                                      std::ranges::count_if(rows, &dem::VerificationRow::pass), rows.size());
  Report report{"Verification of the discrete element engine", "Against published numbers and closed forms."};
  report.add(Sentences(std::vector<std::string>{met + "."}), Told::to_look_at);
  report.add("Cases", rows_table(rows));
  report.notes = {met};
  report.data = [rows] { return rows_json(rows); };
  return report;
}

}  // namespace soilbin::compare
