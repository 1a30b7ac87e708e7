// A library of case files: tires, soils, studies, measured campaigns and vehicles in folders, found by name.
//
//   const Library library({"cases"});                 // a folder with tires/, soils/, studies/, ...
//   library.names(Shelf::soils)                       // "clayey-soil", "cmu-sand", ...
//   find_file(library, Shelf::tires, "rover-wheel")   // cases/tires/rover-wheel.yaml
#pragma once

#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace soilbin {

/// The folders of a library of cases.
enum class Shelf { studies, measured, vehicles, tires, soils };

/// Each, in the order in which a name is looked for that may stand on several: a question before its parts.
inline constexpr std::array all_shelves = {Shelf::studies, Shelf::measured, Shelf::vehicles, Shelf::tires,
                                           Shelf::soils};

/// Looks names up in folders that hold tires/, soils/, studies/, vehicles/ (NAME.yaml) and measured/
/// (NAME/campaign.yaml); the first folder that has a name wins.
class Library {
 public:
  explicit Library(std::vector<std::filesystem::path> folders = {}) : folders_(std::move(folders)) {}

  /// A library with a file's folder, and the folder above it, searched before this one's.
  Library beside(const std::filesystem::path& file) const;
  /// The file behind a name, or no value. A name holds no path separator.
  std::optional<std::filesystem::path> find(Shelf shelf, const std::string& name) const;
  /// Every name on a shelf, sorted, each once.
  std::vector<std::string> names(Shelf shelf) const;

 private:
  std::vector<std::filesystem::path> folders_;
};

/// Name of a shelf's folder: "tires".
std::string_view folder_of(Shelf shelf);

/// Folders of cases in the order in which they are searched, as far as they are there: those of $SOILBIN_CASES
/// (separated by ':'), that of an installation, the source tree's.
std::vector<std::filesystem::path> case_folders(const std::filesystem::path& installed,
                                                const std::filesystem::path& sources);

/// What stands on a shelf, for a hint: "there are rover, tractor, truck", or where a line does not hold the names
/// "soilbin list soils shows the 29 that there are".
std::string what_there_is(Shelf shelf, const std::vector<std::string>& names);

/// The file behind a name on a shelf, or a path to a file (or, for a campaign, its folder). A name without '/' and
/// '.yaml' is looked up in the library first. Throws InputError with the nearest name.
std::filesystem::path find_file(const Library& library, Shelf shelf, const std::string& name);

}  // namespace soilbin
