// soilbin verify: the discrete element engine against published numbers and closed forms.
#include <fmt/core.h>

#include <algorithm>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "cli/commands.hpp"
#include "cli/flag_values.hpp"
#include "cli/outputs.hpp"
#include "cli/progress.hpp"
#include "cli/soil_bin.hpp"
#include "compare/report/json_fields.hpp"
#include "dem/verification/fast_engine.hpp"
#include "dem/verification/incline.hpp"
#include "scenario/errors.hpp"
#include "scenario/nearest_word.hpp"
#include "scenario/source_text.hpp"

namespace soilbin::cli {
namespace {

using Json = nlohmann::ordered_json;
using dem::VerificationRow;

Json json_of(const std::vector<VerificationRow>& rows) {
  Json all = Json::array();
  for (const VerificationRow& row : rows)
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

void print_table(const std::vector<VerificationRow>& rows) {
  Table table{"", {"case", "published", "ours", "error", "tolerance", "unit", ""}};
  for (const VerificationRow& row : rows)
    table.add({row.name, fmt::format("{:.6g}", row.published), fmt::format("{:.6g}", row.ours),
               fmt::format("{:.2g}", row.error()), fmt::format("{:.2g}", row.tolerance), row.unit,
               row.pass() ? "ok" : "FAILED"});
  fmt::print("{}", as_text(table));
}

/// The cases of which a name contains the text. Throws InputError with the nearest name where there is none.
std::vector<dem::VerificationCase> cases_named(const std::string& containing) {
  std::vector<dem::VerificationCase> chosen;
  std::vector<std::string> names;
  for (const dem::VerificationCase& one : dem::verification_cases()) {
    names.insert(names.end(), one.names.begin(), one.names.end());
    if (std::ranges::any_of(one.names,
                            [&](const std::string& name) { return name.find(containing) != std::string::npos; }))
      chosen.push_back(one);
  }
  if (!chosen.empty()) return chosen;
  throw InputError(fmt::format("--case: no case's name contains '{}'{}\n  hint: there are {}", clipped(containing),
                               did_you_mean(containing, names), listed(names)));
}

int verify(bool json, std::optional<std::uint64_t> incline, const std::string& containing) {
  std::vector<VerificationRow> rows =
      incline ? dem::incline_rows(*incline, show_dem_progress)
              : dem::rows_of(cases_named(containing), dem::start_fast_engine, shown_progress());
  clear_progress_line();
  if (!incline)
    std::erase_if(rows, [&](const VerificationRow& row) { return row.name.find(containing) == std::string::npos; });
  const auto passed = std::ranges::count_if(rows, [](const auto& row) { return row.pass(); });
  if (json) {
    print_json(json_of(rows));
  } else {
    print_table(rows);
    fmt::print("{} of {} cases within their tolerance\n", passed, rows.size());
  }
  return passed == static_cast<std::ptrdiff_t>(rows.size()) ? done : failed;
}

}  // namespace

void add_verify(CLI::App& app, Session& session) {
  CLI::App* command = app.add_subcommand("verify", "the discrete element engine against published numbers");
  const auto containing = std::make_shared<std::string>();
  const auto json = std::make_shared<bool>(false);
  const auto incline = std::make_shared<std::optional<std::uint64_t>>();
  CLI::Option* const layers = add_value(*command, "--incline", *incline, "SEED",
                                        "instead: layers on a rough incline, of this seed (a quarter of an hour)");
  add_value(*command, "--case", *containing, "TEXT", "only cases whose name contains this")->excludes(layers);
  command->add_flag("--json", *json, "soilbin-verify/1, for programs");
  command->callback([=, &session] { session.action = [=] { return verify(*json, *incline, *containing); }; });
}

}  // namespace soilbin::cli
