// Writes the files that a command was asked for (a page, a drawing, a table) at its end. Whether they can be written is
// tried before the work, by the flags themselves (add_file in flag_values.hpp, add_plot).
#pragma once

#include <CLI/CLI.hpp>
#include <functional>
#include <nlohmann/json.hpp>
#include <string>

#include "compare/doubts/doubt.hpp"
#include "compare/report/number_text.hpp"
#include "compare/report/report.hpp"
#include "compare/report/table.hpp"

namespace soilbin::cli {

/// A CSV that a command was asked for, and how people's spreadsheets read it.
struct CsvOutput {
  std::string file{};
  bool decimal_comma = false;  ///< semicolons between cells, decimal commas

  /// The text as it was asked for.
  std::string in_dialect(std::string csv) const;
  /// Throws InputError for --decimal-comma where no CSV is written: neither by --csv nor by `other`.
  void needs_a_file(bool other_given, const char* other) const;
};

/// Writes files at the end of a command. One that can't be written is told on standard error, and the others are still
/// written and the answer printed: the work isn't lost for a disk that is full.
class Outputs {
 public:
  /// Calls `write`, which writes what was named, where anything was.
  void write(const std::string& name, const std::function<void()>& write);
  /// Writes a text and says so on standard error.
  void file(const std::string& name, const std::function<std::string()>& content);
  void csv(const CsvOutput& asked, const std::function<std::string()>& content);
  /// A drawing in the format that the name's ending says.
  void drawing(const std::string& name, const std::function<compare::Sheet()>& sheet);
  /// The drawing, an SVG, where the name ends as one; else the CSV.
  void table_or_drawing(const std::string& name, const std::function<std::string()>& csv,
                        const std::function<std::string()>& drawing);

  bool complete() const { return complete_; }
  /// The command's exit status: `so_far`, or `failed` where a file is missing or there is no answer.
  int status(int so_far) const;
  void has_no_answer() { answered_ = false; }

 private:
  bool complete_ = true, answered_ = true;
};

/// Why a name is no CSV's: a spreadsheet refuses a text under the endings of its own formats; "" for none. For check().
std::string why_no_csv(const std::string& name);

/// Adds --csv, which names a file to write: tried as by add_file; and --decimal-comma, its dialect.
void add_csv(CLI::App& command, CsvOutput& csv, const char* meaning);
/// Adds --decimal-comma alone, to a command that writes CSVs by another flag too.
CLI::Option* add_decimal_comma(CLI::App& command, CsvOutput& csv);

/// Adds --plot, which names a drawing: tried as by add_file (flag_values.hpp), with an ending that tells a format,
/// .svg, .png or .pdf.
void add_plot(CLI::App& command, std::string& name, const char* meaning);

struct Session;

/// How a command gives its answer out.
struct OutputFlags {
  bool json = false;
  std::string plot, report, markdown;
  CsvOutput csv;

  struct Meanings {
    const char* json;            ///< "soilbin-drive/1, in SI"
    const char* plot = nullptr;  ///< nullptr: the answer has no drawing of its own
    const char* csv = nullptr;   ///< nullptr: it has no samples
    const char* page = "--report";
  };
  /// Adds --json, the page's flag, --markdown and, where they have a meaning, --plot and --csv.
  void add_to(CLI::App& command, const Meanings& meanings);
};

/// Tells the doubts on standard error, writes the files that were asked for, and prints the answer as text or
/// JSON; what has none says why.
Outputs publish(compare::Report report, const OutputFlags& asked, const compare::Doubts& doubts,
                const Session& session);

// What every command prints: warnings on standard error, documents of JSON on standard output.

using compare::as_text;
using compare::number;
using compare::Table;
using compare::TableCell;

/// Each on a line of its own to stderr, as `soilbin check` tells them: "warning: ...".
void print_warnings(const compare::Doubts& doubts);

/// A document on standard output, with what is doubtful in it.
void print_json(nlohmann::ordered_json document, const compare::Doubts& doubts = {});

}  // namespace soilbin::cli
