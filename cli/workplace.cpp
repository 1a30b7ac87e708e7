#include "cli/workplace.hpp"

#include <fmt/core.h>

#include <cstdlib>
#include <sstream>

#include "scenario/errors.hpp"
#include "scenario/nearest_word.hpp"

namespace soilbin::cli {
namespace {

namespace fs = std::filesystem;

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
  }
  return "";
}

void add_where_present(const fs::path& folder, std::vector<fs::path>& folders) {
  std::error_code error;
  if (fs::is_directory(folder, error)) folders.push_back(folder);
}

}  // namespace

Workplace find_workplace() {
  Workplace place;
  if (const char* named = std::getenv("SOILBIN_CASES"); named != nullptr) {
    std::istringstream parts(named);
    for (std::string part; std::getline(parts, part, ':');)
      if (!part.empty()) add_where_present(part, place.folders);
  }
  std::error_code error;
  const fs::path program = fs::read_symlink("/proc/self/exe", error);
  if (!error) add_where_present((program.parent_path() / "../share/soilbin/cases").lexically_normal(), place.folders);
  add_where_present(SOILBIN_SOURCE_CASES, place.folders);
  place.library = Library(place.folders);
  return place;
}

fs::path find_file(const Workplace& place, Shelf shelf, const std::string& name) {
  const bool is_path = name.find('/') != std::string::npos || name.ends_with(".yaml");
  if (is_path) return name;
  if (const auto file = place.library.find(shelf, name)) return *file;
  std::error_code error;
  if (fs::exists(name, error)) return name;
  const std::vector<std::string> names = place.library.names(shelf);
  throw InputError(
      fmt::format("no {} '{}' in the library, and no such file{}\n  hint: {}", kind_of(shelf), clipped(name),
                  did_you_mean(name, names),
                  names.empty() ? "the library is empty; see soilbin doctor" : "there are " + listed(names)));
}

Case find_case(const Workplace& place, const std::string& name) {
  return read_case(find_file(place, Shelf::studies, name), place.library, place.effects);
}

Case find_study(const Workplace& place, const std::string& name) {
  Case question = find_case(place, name);
  if (question.study.conditions.empty())
    throw InputError(
        fmt::format("{}: the case has no study, it asks for a drive\n  hint: soilbin drive {}", name, name));
  return question;
}

fs::path find_record(const Workplace& place, const std::string& study) {
  const fs::path asked = find_file(place, Shelf::studies, study);
  const fs::path file = asked.parent_path() / "recorded" / asked.stem().concat(".json");
  if (fs::exists(file)) return file;
  throw InputError(
      fmt::format("there are no recorded runs of '{}': no file {}\n  hint: soilbin run {} --model dem "
                  "--record FILE.json makes them",
                  clipped(study), file.string(), clipped(study)));
}

fs::path find_record(const Workplace& place, const std::string& study, const std::string& recorded) {
  return recorded == library_record ? find_record(place, study) : fs::path(recorded);
}

compare::Campaign find_campaign(const Workplace& place, const std::string& name) {
  return compare::read_campaign(find_file(place, Shelf::measured, name), place.effects);
}

fs::path user_cache() {
  if (const char* cache = std::getenv("XDG_CACHE_HOME")) return fs::path(cache) / "soilbin";
  if (const char* home = std::getenv("HOME"); home && fs::is_directory(home)) return fs::path(home) / ".cache/soilbin";
  return {};
}

}  // namespace soilbin::cli
