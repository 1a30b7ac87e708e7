#include "cli/workplace.hpp"

#include <fmt/core.h>

#include <cstdlib>

#include "compare/vehicle/vehicle.hpp"
#include "scenario/errors.hpp"
#include "scenario/source_text.hpp"
#include "scenario/yaml_node.hpp"

namespace soilbin::cli {
namespace fs = std::filesystem;

namespace {

/// What an installation keeps beside the program, in ../share/soilbin; empty where nothing tells where that is.
fs::path installed_share(const std::string& what) {
  std::error_code error;
  const fs::path program = fs::read_symlink("/proc/self/exe", error);
  return error ? fs::path() : (program.parent_path() / "../share/soilbin" / what).lexically_normal();
}

}  // namespace

fs::path this_program() { return fs::read_symlink("/proc/self/exe"); }

Workplace find_workplace() {
  Workplace place;
  place.folders = case_folders(installed_share("cases"), SOILBIN_SOURCE_CASES);
  place.library = Library(place.folders);
  return place;
}

std::optional<fs::path> schema_file(const std::string& format) {
  std::error_code error;
  for (const fs::path& folder : {installed_share("schema"), fs::path(SOILBIN_SOURCE_SCHEMAS)})
    if (const fs::path file = folder / (format + ".json"); fs::is_regular_file(file, error)) return file;
  return std::nullopt;
}

std::string format_of(const fs::path& file) {
  const YamlNode document = parse_yaml(read_source_text(file, largest_yaml));
  const YamlNode* format = document.is_mapping() ? document.find("format") : nullptr;
  return format != nullptr && format->is_scalar() ? format->scalar : "";
}

bool names_a_vehicle(const Workplace& place, const std::string& name) {
  const bool is_path = name.find('/') != std::string::npos || name.ends_with(".yaml");
  if (!is_path && place.library.find(Shelf::studies, name)) return false;
  if (!is_path && place.library.find(Shelf::vehicles, name)) return true;
  std::error_code error;
  return fs::is_regular_file(name, error) && format_of(name) == compare::vehicle_case_format;
}

Case find_case(const Workplace& place, const std::string& name) {
  return read_case(find_file(place.library, Shelf::studies, name), place.library, place.effects);
}

Case find_study(const Workplace& place, const std::string& name) {
  Case question = find_case(place, name);
  if (question.study.conditions.empty())
    throw InputError(
        fmt::format("{}: the case has no study, it asks for a drive\n  hint: soilbin drive {}", name, name));
  return question;
}

fs::path place_of_record(const Workplace& place, const std::string& study) {
  const fs::path asked = find_file(place.library, Shelf::studies, study);
  return asked.parent_path() / "recorded" / asked.stem().concat(".json");
}

fs::path find_record(const Workplace& place, const std::string& study) {
  const fs::path file = place_of_record(place, study);
  if (fs::exists(file)) return file;
  throw InputError(
      fmt::format("there are no recorded runs of '{}': no file {}\n  hint: soilbin run {} --model dem --record "
                  "FILE.json makes them",
                  clipped(study), file.string(), clipped(study)));
}

fs::path find_record(const Workplace& place, const std::string& study, const std::string& recorded) {
  if (recorded == library_record) return find_record(place, study);
  const bool a_name = recorded.find('/') == recorded.npos && !recorded.ends_with(".json") && !fs::exists(recorded);
  return a_name ? find_record(place, recorded) : fs::path(recorded);
}

compare::Campaign find_campaign(const Workplace& place, const std::string& name, compare::CampaignUse use) {
  return compare::read_campaign(find_file(place.library, Shelf::measured, name), place.library, place.effects, use);
}

std::map<std::string, compare::DataColumn> declared_columns(const Workplace& place, const std::string& name) {
  return compare::declared_columns(find_file(place.library, Shelf::measured, name), place.library, place.effects);
}

fs::path user_cache() {
  std::error_code unseen;
  if (const char* cache = std::getenv("XDG_CACHE_HOME"); cache && fs::path(cache).is_absolute())
    return fs::path(cache) / "soilbin";
  if (const char* home = std::getenv("HOME"); home && fs::is_directory(home, unseen))
    return fs::path(home) / ".cache/soilbin";
  return {};
}

}  // namespace soilbin::cli
