#include "cli/workplace.hpp"

#include <fmt/core.h>

#include <cstdlib>
#include <sstream>

#include "scenario/errors.hpp"
#include "scenario/nearest_word.hpp"

namespace soilbin::cli {
namespace fs = std::filesystem;

Workplace find_workplace() {
  Workplace place;
  std::error_code error;
  const fs::path program = fs::read_symlink("/proc/self/exe", error);
  const fs::path installed = error ? fs::path() : program.parent_path() / "../share/soilbin/cases";
  place.folders = case_folders(installed.lexically_normal(), SOILBIN_SOURCE_CASES);
  place.library = Library(place.folders);
  return place;
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
      fmt::format("there are no recorded runs of '{}': no file {}\n  hint: soilbin run {} --model dem "
                  "--record FILE.json makes them",
                  clipped(study), file.string(), clipped(study)));
}

fs::path find_record(const Workplace& place, const std::string& study, const std::string& recorded) {
  return recorded == library_record ? find_record(place, study) : fs::path(recorded);
}

compare::Campaign find_campaign(const Workplace& place, const std::string& name, compare::CampaignUse use) {
  return compare::read_campaign(find_file(place.library, Shelf::measured, name), place.effects, use);
}

fs::path user_cache() {
  if (const char* cache = std::getenv("XDG_CACHE_HOME")) return fs::path(cache) / "soilbin";
  if (const char* home = std::getenv("HOME"); home && fs::is_directory(home)) return fs::path(home) / ".cache/soilbin";
  return {};
}

}  // namespace soilbin::cli
