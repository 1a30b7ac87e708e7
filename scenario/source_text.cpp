#include "scenario/source_text.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <string_view>

#include "scenario/file_bytes.hpp"

namespace soilbin {
namespace {

bool continues_character(char c) { return (static_cast<unsigned char>(c) & 0xC0U) == 0x80U; }

std::size_t count_characters(std::string_view text) {
  return static_cast<std::size_t>(
      std::count_if(text.begin(), text.end(), [](char c) { return !continues_character(c); }));
}

/// Bytes of the UTF-8 character at the front of a text, 0 where there is none that is well formed (RFC 3629).
std::size_t character_length(std::string_view text) {
  const auto byte = [&](std::size_t i) { return i < text.size() ? static_cast<unsigned char>(text[i]) : 0U; };
  const unsigned first = byte(0);
  if (first < 0x80U) return 1;
  const std::size_t length = first >= 0xF0U ? 4 : first >= 0xE0U ? 3 : 2;
  if (first < 0xC2U || first > 0xF4U || text.size() < length) return 0;
  for (std::size_t i = 1; i < length; ++i)
    if (!continues_character(text[i])) return 0;
  const bool overlong = (first == 0xE0U && byte(1) < 0xA0U) || (first == 0xF0U && byte(1) < 0x90U);
  const bool surrogate = first == 0xEDU && byte(1) > 0x9FU;
  const bool too_large = first == 0xF4U && byte(1) > 0x8FU;
  return overlong || surrogate || too_large ? 0 : length;
}

/// Whether a text begins with a control character that no text needs.
bool begins_with_control(std::string_view text) {
  const auto byte = static_cast<unsigned char>(text.front());
  const bool of_two_bytes = byte == 0xC2U && text.size() > 1 && static_cast<unsigned char>(text[1]) < 0xA0U;
  return (byte < 0x20U && byte != '\t' && byte != '\n' && byte != '\r') || byte == 0x7FU || of_two_bytes;
}

}  // namespace

SourcePosition SourceText::position(std::size_t offset) const {
  const std::string_view before = std::string_view(text).substr(0, std::min(offset, text.size()));
  const std::size_t newline = before.rfind('\n');
  const std::size_t begin = newline == std::string_view::npos ? 0 : newline + 1;
  const auto line = 1 + std::count(before.begin(), before.end(), '\n');
  return {file, static_cast<int>(line), static_cast<int>(1 + count_characters(before.substr(begin)))};
}

std::string SourceText::excerpt(std::size_t offset) const {
  constexpr std::size_t most_before = 80, most_after = 60;
  const std::size_t at = std::min(offset, text.size());
  const std::size_t newline = at == 0 ? std::string::npos : text.rfind('\n', at - 1);
  std::size_t begin = newline == std::string::npos ? 0 : newline + 1;
  std::size_t end = std::min(text.find('\n', at), text.size());
  if (at - begin > most_before) begin = at - most_before;
  while (begin < at && continues_character(text[begin])) ++begin;
  if (end - at > most_after) end = at + most_after;
  while (end > at && end < text.size() && continues_character(text[end])) --end;
  std::string line = text.substr(begin, end - begin);
  std::replace(line.begin(), line.end(), '\t', ' ');
  line.erase(std::remove(line.begin(), line.end(), '\r'), line.end());
  const std::string number = std::to_string(position(at).line);
  const std::size_t caret = count_characters(std::string_view(text).substr(begin, at - begin));
  return fmt::format("  {} | {}\n  {} | {}^", number, line, std::string(number.size(), ' '), std::string(caret, ' '));
}

void SourceText::refuse(std::size_t offset, const std::string& message, const std::string& hint) const {
  const auto [what, own_hint] = error_and_hint(message);
  throw InputError(position(offset), what, text.empty() ? "" : excerpt(offset), hint.empty() ? own_hint : hint);
}

std::pair<std::string, std::string> error_and_hint(const std::string& told) {
  constexpr std::string_view mark = "\n  hint: ";
  const std::size_t hint = told.find(mark);
  return {told.substr(0, hint), hint == told.npos ? "" : told.substr(hint + mark.size())};
}

SourceText make_source_text(std::string text, const std::string& file) {
  constexpr std::string_view byte_order_mark = "\xEF\xBB\xBF";
  if (text.starts_with(byte_order_mark)) text.erase(0, byte_order_mark.size());
  SourceText source{file, std::move(text)};
  const std::string_view all = source.text;
  for (std::size_t at = 0; at < all.size();) {
    const std::size_t length = character_length(all.substr(at, 4));
    if (length != 0 && !begins_with_control(all.substr(at, 2))) {
      at += length;
      continue;
    }
    const SourcePosition where = source.position(at);  // no excerpt: its bytes are not fit to print
    throw InputError(where,
                     fmt::format("byte 0x{:02x} is no text: the file must be UTF-8 without control characters",
                                 static_cast<unsigned>(static_cast<unsigned char>(all[at]))),
                     "", all.starts_with("PK") ? "a spreadsheet: export it as CSV" : "save it as text in UTF-8");
  }
  return source;
}

SourceText read_source_text(const std::filesystem::path& path, std::size_t largest) {
  const std::string name = path.string();
  return make_source_text(read_bytes(path, largest), name.substr(0, name.find('\n')));
}

std::size_t find_control(std::string_view text) {
  for (std::size_t at = 0; at < text.size(); ++at)
    if (begins_with_control(text.substr(at, 2))) return at;
  return std::string_view::npos;
}

std::string clipped(std::string_view word) {
  constexpr std::size_t most = 60;
  if (word.size() <= most) return std::string(word);
  std::size_t end = most;
  while (end > 0 && continues_character(word[end])) --end;
  return std::string(word.substr(0, end)) + "...";
}

}  // namespace soilbin
