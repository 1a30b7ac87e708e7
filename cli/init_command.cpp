// soilbin init: a commented case or campaign to start from.
#include <fmt/core.h>

#include <filesystem>
#include <memory>
#include <optional>

#include "cli/commands.hpp"
#include "cli/flag_values.hpp"
#include "compare/report/javascript.hpp"
#include "scenario/atomic_file.hpp"
#include "scenario/errors.hpp"

namespace soilbin::cli {

/// The files of cli/written; made by the build.
std::vector<compare::EmbeddedFile> written_files();

namespace {

namespace fs = std::filesystem;

std::string starter(const char* name) { return compare::embedded(written_files(), name); }

/// Where a file of this name may be written in the folder. Throws InputError where it is there, or can't be.
fs::path free_place(const std::string& folder, const char* name) {
  const fs::path file = fs::path(folder) / name;
  std::error_code error;
  if (fs::exists(fs::symlink_status(file, error)))
    throw InputError(file.string() + " is there already and stays as it is; name another folder: soilbin init DIR");
  if (fs::exists(folder, error) && !fs::is_directory(folder, error))
    throw InputError(folder + " is a file; a folder is expected");
  return file;
}

/// The line by which an editor finds the format's schema.
std::string schema_line(const char* format) {
  const std::optional<fs::path> schema = schema_file(format);
  return schema ? fmt::format("# yaml-language-server: $schema={}\n", schema->string()) : "";
}

int init_case(const std::string& folder) {
  const fs::path file = free_place(folder, "case.yaml");
  write_file_atomically(file, schema_line("case") + starter("case.yaml"));
  fmt::print("wrote {}\nnext: soilbin run {}\n", file.string(), file.string());
  return done;
}

int init_campaign(const std::string& folder) {
  const fs::path file = free_place(folder, "campaign.yaml"), rows = free_place(folder, "runs.csv");
  write_file_atomically(rows, starter("runs.csv"));
  write_file_atomically(file, schema_line("campaign") + starter("campaign.yaml"));
  fmt::print("wrote {} and {}, with example rows\nnext: soilbin check {}\n", file.string(), rows.string(), folder);
  return done;
}

}  // namespace

void add_init(CLI::App& app, Session& session) {
  CLI::App* command = app.add_subcommand("init", "write a commented case or campaign to start from; never overwrites");
  const auto folder = std::make_shared<std::string>(".");
  const auto campaign = std::make_shared<bool>(false);
  add_value(*command, "folder", *folder, "DIR", "folder to write into, made where it is missing; by default this one");
  command->add_flag("--campaign", *campaign, "a campaign with example rows, in place of a case");
  command->footer("Example: soilbin init mine --campaign");
  command->callback(
      [=, &session] { session.action = [=] { return *campaign ? init_campaign(*folder) : init_case(*folder); }; });
}

}  // namespace soilbin::cli
