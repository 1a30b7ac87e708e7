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
#include "compare/telling/reports.hpp"
#include "dem/verification/fast_engine.hpp"
#include "dem/verification/incline.hpp"
#include "scenario/errors.hpp"
#include "scenario/nearest_word.hpp"
#include "scenario/source_text.hpp"

namespace soilbin::cli {
namespace {

using dem::VerificationRow;

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

struct VerifyFlags {
  std::optional<std::uint64_t> incline;
  std::string containing;
  OutputFlags outputs;
};

int verify(const VerifyFlags& asked, const Session& session) {
  std::vector<VerificationRow> rows =
      asked.incline ? dem::incline_rows(*asked.incline, show_dem_progress)
                    : dem::rows_of(cases_named(asked.containing), dem::start_fast_engine, shown_progress());
  clear_progress_line();
  if (!asked.incline)
    std::erase_if(rows,
                  [&](const VerificationRow& row) { return row.name.find(asked.containing) == std::string::npos; });
  return publish(compare::report_on(rows), asked.outputs, {}, session)
      .status(std::ranges::all_of(rows, &VerificationRow::pass) ? done : failed);
}

}  // namespace

void add_verify(CLI::App& app, Session& session) {
  CLI::App* command = app.add_subcommand("verify", "the discrete element engine against published numbers");
  const auto asked = std::make_shared<VerifyFlags>();
  CLI::Option* const layers = add_value(*command, "--incline", asked->incline, "SEED",
                                        "instead: layers on a rough incline, of this seed (a quarter of an hour)");
  add_value(*command, "--case", asked->containing, "TEXT", "only cases whose name contains this")->excludes(layers);
  asked->outputs.add_to(*command, {.json = "soilbin-verify/1, for programs"});
  command->callback([=, &session] { session.action = [=, &session] { return verify(*asked, session); }; });
}

}  // namespace soilbin::cli
