#include "cli/outputs.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cstdio>
#include <filesystem>
#include <stdexcept>

#include "cli/commands.hpp"
#include "cli/flag_values.hpp"
#include "cli/picture.hpp"
#include "cli/progress.hpp"
#include "cli/versions.hpp"
#include "compare/report/json_fields.hpp"
#include "scenario/atomic_file.hpp"
#include "scenario/csv.hpp"
#include "scenario/errors.hpp"
#include "scenario/source_text.hpp"

namespace soilbin::cli {
namespace {

struct DrawingFormat {
  const char* ending;
  std::string (*from_svg)(const std::string& svg);
};

constexpr std::array<DrawingFormat, 3> drawing_formats = {
    {{".svg", [](const std::string& svg) { return svg; }}, {".png", png_of}, {".pdf", pdf_of}}};

/// ".csv" of "a.CSV".
std::string ending_of(const std::string& name) {
  std::string ending = std::filesystem::path(name).extension().string();
  std::ranges::transform(ending, ending.begin(), [](unsigned char c) { return std::tolower(c); });
  return ending;
}

/// nullptr where the ending tells none.
const DrawingFormat* drawing_format_of(const std::string& name) {
  const std::string ending = ending_of(name);
  const auto found =
      std::ranges::find_if(drawing_formats, [&](const DrawingFormat& format) { return format.ending == ending; });
  return found == drawing_formats.end() ? nullptr : &*found;
}

}  // namespace

void Outputs::write(const std::string& name, const std::function<void()>& write) {
  if (name.empty()) return;
  try {
    write();
  } catch (const std::runtime_error& error) {
    complete_ = false;
    clear_progress_line();
    fmt::print(stderr, "soilbin: {}\n", error.what());
  }
}

void Outputs::file(const std::string& name, const std::function<std::string()>& content) {
  write(name, [&] {
    write_file_atomically(name, content());
    clear_progress_line();
    std::fflush(stdout);  // what is told before stands before it, in a log of both too
    fmt::print(stderr, "wrote {}\n", name);
  });
}

std::string CsvOutput::in_dialect(std::string csv) const {
  return decimal_comma ? with_decimal_commas(csv) : std::move(csv);
}

void CsvOutput::needs_a_file(bool other_given, const char* other) const {
  if (decimal_comma && file.empty() && !other_given)
    throw InputError(
        fmt::format("--decimal-comma needs --csv or {}\n  hint: it is about the files that these write", other));
}

void Outputs::csv(const CsvOutput& asked, const std::function<std::string()>& content) {
  file(asked.file, [&] { return asked.in_dialect(content()); });
}

void Outputs::drawing(const std::string& name, const std::function<compare::Sheet()>& sheet) {
  file(name, [&] { return drawing_format_of(name)->from_svg(compare::svg(sheet())); });
}

void Outputs::table_or_drawing(const std::string& name, const std::function<std::string()>& csv,
                               const std::function<std::string()>& drawing) {
  const DrawingFormat* format = drawing_format_of(name);
  file(name, [&] { return format != nullptr ? format->from_svg(drawing()) : csv(); });
}

int Outputs::status(int so_far) const { return complete_ && answered_ ? so_far : failed; }

CLI::Option* add_decimal_comma(CLI::App& command, CsvOutput& csv) {
  return command.add_flag("--decimal-comma", csv.decimal_comma,
                          "CSV for spreadsheets of countries with a decimal comma: 4,4;80");
}

std::string why_no_csv(const std::string& name) {
  const std::string ending = ending_of(name);
  if (!ending.starts_with(".xls") && ending != ".ods") return "";
  return fmt::format("'{}' is no CSV by its ending\n  hint: name it .csv, which a spreadsheet opens", clipped(name));
}

void add_csv(CLI::App& command, CsvOutput& csv, const char* meaning) {
  CLI::Option* const file = add_file(command, "--csv", csv.file, "FILE.csv", meaning)->check(why_no_csv);
  add_decimal_comma(command, csv)->needs(file);
}

void add_plot(CLI::App& command, std::string& name, const char* meaning) {
  const auto refused = [](const std::string& given) {
    return drawing_format_of(given) != nullptr
               ? ""
               : fmt::format("'{}' names no format by its ending\n  hint: .svg, .png or .pdf", clipped(given));
  };
  add_file(command, "--plot", name, "FILE.svg|png|pdf", meaning)->check(refused);
}

void OutputFlags::add_to(CLI::App& command, const Meanings& meanings) {
  if (meanings.plot) add_plot(command, plot, meanings.plot);
  add_file(command, meanings.page, report, "FILE.html", "save a page to open in a browser");
  add_folder(command, "--markdown", markdown, "write it as Markdown with its figures and their data", {"case.yaml"});
  if (meanings.csv) {
    add_file(command, "--csv", csv.file, "FILE.csv", meanings.csv)->check(why_no_csv);
    add_decimal_comma(command, csv);
    command.parse_complete_callback([this] { csv.needs_a_file(!markdown.empty(), "--markdown"); });
  }
  command.add_flag("--json", json, meanings.json);
}

Outputs publish(compare::Report report, const OutputFlags& asked, const compare::Doubts& doubts,
                const Session& session) {
  print_warnings(doubts);
  const compare::PageAbout about{session.command, versions(), in_words(doubts)};
  if (report.data)
    report.data = [answer = report.data, &doubts] {
      nlohmann::ordered_json document = answer();
      add_warnings(document, doubts);
      return document;
    };
  Outputs outputs;
  outputs.csv(asked.csv, report.csv);
  outputs.drawing(asked.plot, report.sheet);
  outputs.write(asked.report, [&] {
    write_file_atomically(asked.report, compare::page_of(report, about));
    fmt::print(stderr, "wrote {}: open it in a browser\n", asked.report);
  });
  outputs.write(asked.markdown, [&] {
    compare::write_markdown(asked.markdown, report, about, asked.csv.decimal_comma);
    fmt::print(stderr, "wrote {}\n", (std::filesystem::path(asked.markdown) / "report.md").string());
  });
  if (asked.json)
    print_json(report.data());
  else
    fmt::print("{}", compare::text_of(report));
  if (report.no_answer.empty()) return outputs;
  fmt::print(stderr, "soilbin: {}\n", report.no_answer);
  outputs.has_no_answer();
  return outputs;
}

void print_warnings(const compare::Doubts& doubts) {
  for (const std::string& line : in_words(doubts)) fmt::print(stderr, "warning: {}\n", line);
}

void print_json(nlohmann::ordered_json document, const compare::Doubts& doubts) {
  compare::add_warnings(document, doubts);
  fmt::print("{}", compare::json_text(document));
}

}  // namespace soilbin::cli
