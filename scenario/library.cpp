#include "scenario/library.hpp"

#include <set>
#include <system_error>

namespace soilbin {
namespace {

namespace fs = std::filesystem;

fs::path file_of(const fs::path& folder, Shelf shelf, const std::string& name) {
  const fs::path on_shelf = folder / folder_of(shelf);
  return shelf == Shelf::measured ? on_shelf / name / "campaign.yaml" : on_shelf / (name + ".yaml");
}

}  // namespace

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
