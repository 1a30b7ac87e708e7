// soilbin init: a commented case or campaign to start from.
#include <fmt/core.h>
#include <fmt/ranges.h>

#include <filesystem>
#include <memory>
#include <optional>

#include "cli/commands.hpp"
#include "cli/flag_values.hpp"
#include "compare/measured/run_columns.hpp"
#include "compare/report/javascript.hpp"
#include "compare/report/shell_words.hpp"
#include "compare/report/table.hpp"
#include "scenario/atomic_file.hpp"
#include "scenario/errors.hpp"
#include "scenario/file_bytes.hpp"
#include "scenario/mapping_writer.hpp"

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

/// Throws InputError where the rows are in the folder already and campaign.yaml is not, with what writes it.
void offer_to_take(const fs::path& rows, const std::string& folder) {
  if (is_there(rows) && !is_there(fs::path(folder) / "campaign.yaml"))
    throw InputError(
        fmt::format("{} is there already and stays as it is\n  hint: {} writes the campaign.yaml for it", rows.string(),
                    compare::shell_words({"soilbin", "init", "--campaign", folder, "--from", rows.string()})));
}

int init_campaign(const std::string& folder) {
  offer_to_take(fs::path(folder) / "runs.csv", folder);
  const fs::path file = free_place(folder, "campaign.yaml"), rows = free_place(folder, "runs.csv");
  write_file_atomically(rows, starter("runs.csv"));
  write_file_atomically(file, schema_line("campaign") + starter("campaign.yaml"));
  fmt::print("wrote {} and {}, with example rows\nnext: soilbin check {}\n", file.string(), rows.string(), folder);
  return done;
}

/// Puts a text in the place of the first of these marks.
void fill_in_mark(std::string& text, const std::string& mark, const std::string& in_its_place) {
  text.replace(text.find(mark), mark.size(), in_its_place);
}

bool lacks_unit(const compare::LikelyColumn& column) {
  return column.unit.empty() && column.column->measure.unit != "-";
}

/// Lines of `columns:` and `ignored:`, by guess; a column that its name tells needs none.
std::string columns_by_guess(const std::vector<compare::LikelyColumn>& columns) {
  std::string lines;
  std::vector<std::string> aside;
  for (const compare::LikelyColumn& column : columns) {
    const std::string header = yaml_scalar(column.header);
    if (!column.column)
      aside.push_back(header);
    else if (!compare::column_by_its_name(column.header))
      lines += fmt::format("  {}: {}{}\n", header, compare::renaming_of(column, ""),
                           lacks_unit(column) ? "   # in which unit, such as " + column.column->measure.unit : "");
  }
  std::string text = lines.empty() ? "columns: {}\n" : "columns:\n" + lines;
  return aside.empty() ? text : text + fmt::format("ignored: [{}]\n", fmt::join(aside, ", "));
}

std::string guesses_in_words(const std::vector<compare::LikelyColumn>& columns) {
  compare::Table table{"", {"column", "holds", "unit"}, {true, true, true}};
  for (const compare::LikelyColumn& column : columns)
    if (column.column)
      table.add({column.header, column.column->quantity, lacks_unit(column) ? "?" : column.unit});
    else
      table.add({column.header, "left aside", ""});
  return compare::as_text(table);
}

/// campaign.yaml for rows that somebody has: they are copied into the folder, unless they are there.
int init_campaign_from(const std::string& rows, const std::string& folder) {
  const fs::path file = free_place(folder, "campaign.yaml");
  const SourceText csv = read_source_text(rows, largest_csv);
  const std::vector<compare::LikelyColumn> columns = compare::likely_columns(parse_csv(csv));
  const fs::path name = fs::path(rows).filename();
  std::error_code error;
  const bool there = fs::equivalent(rows, fs::path(folder) / name, error);
  if (!there) write_file_atomically(free_place(folder, name.c_str()), csv.text);
  std::string text = starter("campaign-of-rows.yaml");
  fill_in_mark(text, "COLUMNS\n", columns_by_guess(columns));
  fill_in_mark(text, "ROWS", yaml_scalar(name.string()));
  fill_in_mark(text, "NAME", yaml_scalar(fs::absolute(file).lexically_normal().parent_path().filename().string()));
  write_file_atomically(file, schema_line("campaign") + text);
  fmt::print("wrote {}{}\n\n{}\nnext: look at the columns and fill in wheel and soil in {}, then soilbin check {}\n",
             file.string(), there ? "" : ", with a copy of the rows beside it", guesses_in_words(columns),
             file.string(), folder);
  return done;
}

}  // namespace

void add_init(CLI::App& app, Session& session) {
  CLI::App* command = app.add_subcommand("init", "write a commented case or campaign to start from; never overwrites");
  const auto folder = std::make_shared<std::string>(".");
  const auto campaign = std::make_shared<bool>(false);
  add_value(*command, "folder", *folder, "DIR", "folder to write into, made where it is missing; by default this one");
  const auto rows = std::make_shared<std::string>();
  CLI::Option* const is_campaign =
      command->add_flag("--campaign", *campaign, "a campaign with example rows, in place of a case");
  add_value(*command, "--from", *rows, "FILE.csv",
            "a campaign of these rows in place of the example's: what its columns hold is guessed from their headings")
      ->needs(is_campaign);
  command->footer(
      "Example: soilbin init mine --campaign\n"
      "         soilbin init mine --campaign --from runs.csv");
  command->callback([=, &session] {
    session.action = [=] {
      return !rows->empty() ? init_campaign_from(*rows, *folder)
             : *campaign    ? init_campaign(*folder)
                            : init_case(*folder);
    };
  });
}

}  // namespace soilbin::cli
