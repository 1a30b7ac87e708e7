#include "scenario/library.hpp"

#include <fmt/core.h>

#include <cstdlib>
#include <set>
#include <sstream>
#include <system_error>

#include "scenario/errors.hpp"
#include "scenario/nearest_word.hpp"
#include "scenario/source_text.hpp"

namespace soilbin {
namespace {

namespace fs = std::filesystem;

fs::path file_of(const fs::path& folder, Shelf shelf, const std::string& name) {
  const fs::path on_shelf = folder / folder_of(shelf);
  return shelf == Shelf::measured ? on_shelf / name / "campaign.yaml" : on_shelf / (name + ".yaml");
}

std::string kind_of(Shelf shelf) {
  switch (shelf) {
    case Shelf::tires:
      return "tire";
    case Shelf::soils:
      return "soil";
    case Shelf::studies:
      return "study";
    case Shelf::measured:
      return "campaign";
    case Shelf::vehicles:
      return "vehicle";
  }
  return "";
}

/// What to do with a name that is asked for on the wrong shelf. Who asks for a campaign has no flag for a tire or soil.
std::string where_it_goes(Shelf shelf, Shelf asked, const std::string& name, const std::string& there) {
  if (asked != Shelf::measured && (shelf == Shelf::tires || shelf == Shelf::soils))
    return fmt::format("--{} {} takes it; {}", kind_of(shelf), name, there);
  if (shelf == Shelf::vehicles) return fmt::format("soilbin vehicle {} takes it; {}", name, there);
  return there;
}

void add_where_present(const fs::path& folder, std::vector<fs::path>& folders) {
  std::error_code error;
  if (fs::is_directory(folder, error)) folders.push_back(folder);
}

}  // namespace

std::vector<fs::path> case_folders(const fs::path& installed, const fs::path& sources) {
  std::vector<fs::path> folders;
  if (const char* named = std::getenv("SOILBIN_CASES"); named != nullptr) {
    std::istringstream parts(named);
    for (std::string part; std::getline(parts, part, ':');)
      if (!part.empty()) add_where_present(part, folders);
  }
  if (!installed.empty()) add_where_present(installed, folders);
  add_where_present(sources, folders);
  return folders;
}

std::string what_there_is(Shelf shelf, const std::vector<std::string>& names) {
  constexpr std::size_t few = 12;
  if (names.empty()) return "the library is empty; see soilbin doctor";
  if (names.size() <= few) return "there are " + listed(names);
  return fmt::format("soilbin list {} shows the {} that there are", folder_of(shelf), names.size());
}

fs::path find_file(const Library& library, Shelf shelf, const std::string& name) {
  const bool is_path = name.find('/') != std::string::npos || name.ends_with(".yaml");
  if (is_path) return name;
  if (const auto file = library.find(shelf, name)) return *file;
  std::error_code error;
  if (fs::exists(name, error)) return name;
  const std::vector<std::string> names = library.names(shelf);
  const std::string there = what_there_is(shelf, names);
  for (const Shelf other : all_shelves)
    if (other != shelf && library.find(other, name))
      throw InputError(fmt::format("no {} '{}' in the library: that is a {}\n  hint: {}", kind_of(shelf), name,
                                   kind_of(other), where_it_goes(other, shelf, name, there)));
  std::string meant = did_you_mean_name(name, names);
  for (const Shelf other : all_shelves)
    if (const std::string near = nearest_word(name, library.names(other)); meant.empty() && !near.empty())
      meant = fmt::format(", did you mean the {} '{}'?", kind_of(other), near);
  throw InputError(fmt::format("no {} '{}' in the library, and no such file{}\n  hint: {}", kind_of(shelf),
                               clipped(name), meant, there));
}

std::string_view folder_of(Shelf shelf) {
  switch (shelf) {
    case Shelf::tires:
      return "tires";
    case Shelf::soils:
      return "soils";
    case Shelf::studies:
      return "studies";
    case Shelf::measured:
      return "measured";
    case Shelf::vehicles:
      return "vehicles";
  }
  return "";
}

Library Library::beside(const fs::path& file) const {
  const fs::path folder = file.has_parent_path() ? file.parent_path() : fs::path(".");
  std::vector<fs::path> folders = {folder, folder / ".."};
  folders.insert(folders.end(), folders_.begin(), folders_.end());
  return Library(std::move(folders));
}

std::optional<fs::path> Library::find(Shelf shelf, const std::string& name) const {
  if (name.empty() || name.find('/') != std::string::npos || name.find('\0') != std::string::npos) return std::nullopt;
  for (const fs::path& folder : folders_) {
    const fs::path file = file_of(folder, shelf, name);
    std::error_code error;
    if (fs::is_regular_file(file, error)) return file;
  }
  return std::nullopt;
}

std::vector<std::string> Library::names(Shelf shelf) const {
  std::set<std::string> names;
  for (const fs::path& folder : folders_) {
    std::error_code error;
    for (const auto& entry : fs::directory_iterator(folder / folder_of(shelf), error)) {
      const fs::path& path = entry.path();
      const std::string name = shelf == Shelf::measured ? path.filename().string() : path.stem().string();
      if (shelf != Shelf::measured && path.extension() != ".yaml") continue;
      if (fs::is_regular_file(file_of(folder, shelf, name), error)) names.insert(name);
    }
  }
  return {names.begin(), names.end()};
}

}  // namespace soilbin
