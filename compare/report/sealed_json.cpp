#include "compare/report/sealed_json.hpp"

#include <fmt/core.h>

#include <algorithm>

#include "compare/report/json_fields.hpp"
#include "scenario/atomic_file.hpp"
#include "scenario/checksum.hpp"

namespace soilbin::compare {
namespace {

constexpr const char* seal_key = "seal";

/// Where brackets are nested too deep; npos: nowhere. Looks at brackets outside of texts alone.
std::size_t too_deep(const std::string& text) {
  int depth = 0;
  bool quoted = false;
  for (std::size_t at = 0; at < text.size(); ++at) {
    const char c = text[at];
    if (quoted && c == '\\')
      ++at;
    else if (c == '"')
      quoted = !quoted;
    else if (!quoted && (c == '[' || c == '{') && ++depth > deepest_json)
      return at;
    else if (!quoted && (c == ']' || c == '}'))
      --depth;
  }
  return std::string::npos;
}

/// Learns where the library stops, and why.
class Locator : public nlohmann::json_sax<Json> {
 public:
  std::size_t at = 0;
  bool number = false;

  bool null() override { return true; }
  bool boolean(bool) override { return true; }
  bool number_integer(std::int64_t) override { return true; }
  bool number_unsigned(std::uint64_t) override { return true; }
  bool number_float(double, const std::string&) override { return true; }
  bool string(std::string&) override { return true; }
  bool binary(Json::binary_t&) override { return true; }
  bool start_object(std::size_t) override { return true; }
  bool key(std::string&) override { return true; }
  bool end_object() override { return true; }
  bool start_array(std::size_t) override { return true; }
  bool end_array() override { return true; }
  bool parse_error(std::size_t position, const std::string& token, const Json::exception& error) override {
    number = dynamic_cast<const Json::out_of_range*>(&error) != nullptr;
    const std::size_t back = number ? token.size() : 1;
    at = position > back ? position - back : 0;
    return false;
  }
};

std::string without_seal(const Json& object) {
  Json bare = object;
  bare.erase(seal_key);
  return bare.dump(-1, ' ', false, Json::error_handler_t::replace);
}

}  // namespace

void need_readable_size(const std::filesystem::path& file, std::string_view text) {
  if (text.size() <= largest_json) return;
  throw CannotWrite(fmt::format(
      "{}: would be {:.0f} MiB, and no more than {} MiB are read again\n  hint: keep further runs in a record "
      "of their own, and name this one with --known",
      file.string(), static_cast<double>(text.size()) / (1U << 20U), largest_json >> 20U));
}

Json parse_json(const SourceText& source, const std::string& hint) {
  if (const std::size_t at = too_deep(source.text); at != std::string::npos)
    source.refuse(at, fmt::format("nested deeper than {} levels", deepest_json), hint);
  try {
    return Json::parse(source.text);
  } catch (const Json::exception&) {
    Locator locator;
    Json::sax_parse(source.text, &locator);
    source.refuse(std::min(locator.at, source.text.size()),
                  locator.number ? "this number is too large" : "this is no JSON", hint);
  }
}

void put_seal(Json& object) { object[seal_key] = fnv1a_digits(without_seal(object)); }

Seal check_seal(const Json& object, const std::string& place, const std::string& hint) {
  const auto found = object.find(seal_key);
  if (!object.is_object() || found == object.end()) return Seal::none;
  if (*found == fnv1a_digits(without_seal(object))) return Seal::whole;
  throw InputError(
      fmt::format("{}: its seal doesn't fit: it was changed after it was written\n  hint: {}", place, hint));
}

}  // namespace soilbin::compare
