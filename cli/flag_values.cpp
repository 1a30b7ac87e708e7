#include "cli/flag_values.hpp"

#include <fmt/core.h>

#include <filesystem>
#include <stdexcept>

#include "scenario/atomic_file.hpp"
#include "scenario/errors.hpp"
#include "scenario/source_text.hpp"

namespace soilbin::cli {

std::vector<std::string> split(std::string_view text, std::string_view between) {
  std::vector<std::string> parts;
  std::size_t from = 0;
  for (std::size_t at; (at = text.find(between, from)) != std::string_view::npos; from = at + between.size())
    parts.emplace_back(text.substr(from, at - from));
  parts.emplace_back(text.substr(from));
  return parts;
}

double read_flag(const std::string& flag, const std::string& text, const Measure& measure) {
  try {
    return read_quantity(text, measure);
  } catch (const InputError& error) {
    throw InputError(fmt::format("{}: {}", flag, error.what()));
  }
}

void set_where_given(const std::string& flag, const std::string& text, const Measure& measure, double& number) {
  if (!text.empty()) number = read_flag(flag, text, measure);
}

std::pair<double, double> read_range(const std::string& flag, const std::string& text, const Measure& measure) {
  const std::vector<std::string> ends = split(text, "..");
  if (ends.size() != 2)
    throw InputError(fmt::format("{}: expected LOW..HIGH with units, not '{}'", flag, clipped(text)));
  const std::pair range{read_flag(flag, ends[0], measure), read_flag(flag, ends[1], measure)};
  if (!(range.first < range.second))
    throw InputError(fmt::format("{}: the lower end must be below the upper one, not '{}'", flag, clipped(text)));
  return range;
}

CLI::Validator writable_file() {
  const auto problem = [](const std::string& name) -> std::string {
    namespace fs = std::filesystem;
    std::error_code none;
    const fs::path path(name), folder = path.parent_path();
    if (fs::is_directory(path, none))
      return fmt::format("'{}' is a folder, where a file is to be written", clipped(name));
    if (!folder.empty() && !fs::is_directory(folder, none))
      return fmt::format("there is no folder '{}'\n  hint: mkdir -p '{}'", folder.string(), folder.string());
    try {
      try_to_write(path);
    } catch (const std::runtime_error& error) {
      return error.what();
    }
    return "";
  };
  return {[problem](std::string& name) { return problem(name); }, ""};
}

CLI::Validator writable_folder() {
  const auto problem = [](const std::string& name) -> std::string {
    namespace fs = std::filesystem;
    std::error_code none;
    for (fs::path path(name); !path.empty(); path = path.parent_path()) {
      if (fs::is_directory(path, none)) return "";
      if (fs::exists(path, none))
        return fmt::format(
            "'{}' is a file, where a folder is to be made\n  hint: name a new folder, or one that is there",
            clipped(path.string()));
      if (path == path.parent_path()) break;
    }
    return "";
  };
  return {[problem](std::string& name) { return problem(name); }, ""};
}

}  // namespace soilbin::cli
