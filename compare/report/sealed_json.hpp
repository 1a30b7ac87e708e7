// JSON files that soilbin wrote, read again: bounded in size and depth, and with seals that tell damage.
#pragma once

#include <cstddef>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>

#include "scenario/errors.hpp"
#include "scenario/source_text.hpp"

namespace soilbin::compare {

/// Largest record, store or other file kept in JSON [bytes].
inline constexpr std::size_t largest_json = 256U << 20U;

/// Throws CannotWrite for a text of the file that would be longer than that: it could not be read again.
void need_readable_size(const std::filesystem::path& file, std::string_view text);

/// Levels of lists and objects; ours have fewer than ten.
inline constexpr int deepest_json = 32;

/// Throws InputError with line, column and excerpt where the text is no JSON, is nested deeper than deepest_json, or
/// has a number beyond a double. `hint`: how such a file is made.
nlohmann::ordered_json parse_json(const SourceText& source, const std::string& hint);

/// Puts the checksum of an object's other members into its member "seal". The way in which the text is laid out doesn't
/// matter, the order of the members does.
void put_seal(nlohmann::ordered_json& object);

enum class Seal { whole, none };

/// Throws InputError that names the place where a seal doesn't fit. `hint`: what to do about it.
Seal check_seal(const nlohmann::ordered_json& object, const std::string& place, const std::string& hint);

/// Calls `read`; an exception of the JSON library becomes an InputError that names the place.
auto read_json_at(const std::string& place, const auto& read) {
  try {
    return read();
  } catch (const nlohmann::ordered_json::exception&) {
    throw InputError(place + ": a value is missing or of another kind than expected");
  }
}

}  // namespace soilbin::compare
