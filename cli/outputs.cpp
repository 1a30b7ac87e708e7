#include "cli/outputs.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <filesystem>
#include <stdexcept>

#include "cli/commands.hpp"
#include "cli/flag_values.hpp"
#include "cli/picture.hpp"
#include "cli/progress.hpp"
#include "scenario/atomic_file.hpp"
#include "scenario/source_text.hpp"

namespace soilbin::cli {
namespace {

struct DrawingFormat {
  const char* ending;
  std::string (*from_svg)(const std::string& svg);
};

constexpr std::array<DrawingFormat, 3> drawing_formats = {
    {{".svg", [](const std::string& svg) { return svg; }}, {".png", png_of}, {".pdf", pdf_of}}};

/// nullptr where the ending tells none.
const DrawingFormat* drawing_format_of(const std::string& name) {
  std::string ending = std::filesystem::path(name).extension().string();
  std::ranges::transform(ending, ending.begin(), [](unsigned char c) { return std::tolower(c); });
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
  write(name, [&] { write_file_atomically(name, content()); });
}

void Outputs::drawing(const std::string& name, const std::function<compare::Sheet()>& sheet) {
  file(name, [&] { return drawing_format_of(name)->from_svg(compare::svg(sheet())); });
}

int Outputs::status(int so_far) const { return complete_ ? so_far : failed; }

void add_plot(CLI::App& command, std::string& name, const char* meaning) {
  const auto refused = [](const std::string& given) {
    return drawing_format_of(given) != nullptr
               ? ""
               : fmt::format("'{}' names no format by its ending\n  hint: .svg, .png or .pdf", clipped(given));
  };
  add_file(command, "--plot", name, "FILE.svg|png|pdf", meaning)->check(refused);
}

}  // namespace soilbin::cli
