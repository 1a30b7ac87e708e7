#include "scenario/named_parts.hpp"

#include <fmt/core.h>

#include <type_traits>

#include "scenario/beds.hpp"
#include "scenario/case.hpp"
#include "scenario/mapping_reader.hpp"
#include "scenario/nearest_word.hpp"
#include "scenario/scm_soil.hpp"
#include "scenario/tire_size.hpp"

namespace soilbin {
namespace {

namespace fs = std::filesystem;

/// What differs between tires and soils when a case names one.
template <class T>
struct Kind;

template <>
struct Kind<Tire> {
  static constexpr Shelf shelf = Shelf::tires;
  static constexpr const char* word = "tire";
  static constexpr const char* format = tire_format;
};

template <>
struct Kind<Soil> {
  static constexpr Shelf shelf = Shelf::soils;
  static constexpr const char* word = "soil";
  static constexpr const char* format = soil_format;
};

void check_parts(const Tire& tire, const YamlNode& node, const Reading& reading) {
  if (const std::string why = why_no_gaps(tire); !why.empty()) reading.refuse(node, why, "fewer or thinner lugs");
}
void check_parts(const Soil&, const YamlNode&, const Reading&) {}

template <class T>
T read_checked(const YamlNode& node, const Reading& reading, const std::vector<std::string>& beside = {}) {
  T value = read_mapping<T>(node, reading, beside);
  check_parts(value, node, reading);
  return value;
}

template <class T>
T parse_file(const SourceText& source) {
  if constexpr (std::is_same_v<T, Soil>)
    if (names_json(source.file)) return parse_scm_soil(source);
  const YamlNode document = parse_yaml(source);
  const Reading reading{&source, std::nullopt, nullptr, ""};
  expect_format(document, Kind<T>::format, reading);
  T value = read_checked<T>(document, reading, {"format"});
  if (value.name.empty()) value.name = fs::path(source.file).stem().string();
  return value;
}

template <class T>
T read_file(const fs::path& path) {
  return parse_file<T>(read_source_text(path, largest_yaml));
}

bool looks_like_path(const std::string& name) {
  return name.find('/') != std::string::npos || name.ends_with(".yaml") || name.ends_with(".json");
}

template <class T>
std::string not_found(const std::string& name, const Library& library) {
  return fmt::format("no {} '{}' in the library{}", Kind<T>::word, clipped(name),
                     did_you_mean_name(name, library.names(Kind<T>::shelf)));
}

template <class T>
std::string names_hint(const Library& library) {
  const std::string there = what_there_is(Kind<T>::shelf, library.names(Kind<T>::shelf));
  return std::is_same_v<T, Tire> ? there + "; or a size, such as 600/65R28, 18.4-38 or 16.00R20" : there;
}

bool is_file(const fs::path& path) {
  std::error_code error;
  return fs::is_regular_file(path, error);
}

/// A tire whose size is given in place of a name: of the library, else by its size alone. Soils have none.
template <class T>
std::optional<T> find_by_size(const std::string& name, const Library& library) {
  if constexpr (std::is_same_v<T, Tire>) {
    const std::string stored = library_name_of_size(name);
    if (stored.empty()) return std::nullopt;
    if (const auto file = library.find(Shelf::tires, stored)) return read_file<Tire>(*file);
    std::optional<Tire> sized = tire_of_size(name);
    for (const std::string& known : library.names(Shelf::tires))
      if (sized && nearly_same_size(name, known))
        sized->source += fmt::format("; nearly this size in the library: {}", known);
    return sized;
  }
  return std::nullopt;
}

template <class T>
T find_by_name(const std::string& name, const Library& library) {
  if (const auto file = library.find(Kind<T>::shelf, name)) return read_file<T>(*file);
  if (is_file(name)) return read_file<T>(name);
  if (auto sized = find_by_size<T>(name, library)) return *std::move(sized);
  if (looks_like_path(name)) return read_file<T>(name);
  throw InputError(not_found<T>(name, library) + "\n  hint: " + names_hint<T>(library));
}

/// {from: cullinan-sand, density: 1450 kg/m^3}.
Soil read_bed(const YamlNode& node, const Library& library, const Reading& reading) {
  expect_keys(node, {"from", "density"}, reading);
  const YamlNode& from = *value_of(node, "from", Need::required, "a soil with 'beds'", reading);
  const YamlNode& density = *value_of(node, "density", Need::required, "of the bed that is asked about", reading);
  Soil soil = read_soil_part(from, library, reading);
  const double asked = read_scalar(density, {"kg/m^3", above_zero}, reading).value;
  try {
    set_density(soil, asked);
  } catch (const InputError& error) {
    reading.refuse(density, error.what());
  }
  return soil;
}

/// A tire or soil of a case: a mapping, a name of the library, or a path relative to the case file.
template <class T>
T read_part(const YamlNode& node, const Library& library, const Reading& reading) {
  if constexpr (std::is_same_v<T, Soil>)
    if (names_a_bed(node)) return read_bed(node, library, reading);
  if (node.is_mapping()) return read_checked<T>(node, reading);
  if (!node.is_scalar())
    reading.refuse(node, fmt::format("expected a {}: a mapping, a name of the library, or a path; not {}",
                                     Kind<T>::word, node.kind_name()));
  const std::string& name = node.scalar;
  if (name.find('\0') != std::string::npos) reading.refuse(node, "a name or path can't hold a zero byte");
  const fs::path beside = fs::path(reading.source->file).parent_path() / name;
  if (const auto file = library.find(Kind<T>::shelf, name)) return read_file<T>(*file);
  if (is_file(beside)) return read_file<T>(beside);
  try {
    if (auto sized = find_by_size<T>(name, library)) return *std::move(sized);
  } catch (const InputError& error) {
    reading.refuse(node, error.what());
  }
  if (looks_like_path(name)) reading.refuse(node, fmt::format("no such {} file", Kind<T>::word));
  reading.refuse(node, not_found<T>(name, library), names_hint<T>(library));
}

}  // namespace

bool names_a_bed(const YamlNode& node) { return node.is_mapping() && node.find("from") != nullptr; }

Tire read_tire_part(const YamlNode& node, const Library& library, const Reading& reading) {
  return read_part<Tire>(node, library, reading);
}
Soil read_soil_part(const YamlNode& node, const Library& library, const Reading& reading) {
  return read_part<Soil>(node, library, reading);
}

Tire read_tire(const fs::path& path) { return read_file<Tire>(path); }
Tire parse_tire(const SourceText& source) { return parse_file<Tire>(source); }
Soil read_soil(const fs::path& path) { return read_file<Soil>(path); }
Soil parse_soil(const SourceText& source) { return parse_file<Soil>(source); }
Tire find_tire(const std::string& name, const Library& library) { return find_by_name<Tire>(name, library); }
Soil find_soil(const std::string& name, const Library& library) { return find_by_name<Soil>(name, library); }

}  // namespace soilbin
