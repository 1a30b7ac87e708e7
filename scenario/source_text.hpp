// A text file as a person wrote it, kept whole so that an error can show the line it speaks of.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>
#include <utility>

#include "scenario/errors.hpp"

namespace soilbin {

/// Text of a file. Places in it are byte offsets; an error turns them into line and column (in characters, from 1).
struct SourceText {
  std::string file;  ///< as errors name it
  std::string text;  ///< UTF-8, without a byte order mark

  SourcePosition position(std::size_t offset) const;
  /// The line that holds the offset, with a caret under it; a long line is cut to the surroundings.
  std::string excerpt(std::size_t offset) const;
  /// Throws InputError "file:line:column: message", with the excerpt and the hint. A message that ends in a hint of its
  /// own (error_and_hint) has it behind the excerpt.
  [[noreturn]] void refuse(std::size_t offset, const std::string& message, const std::string& hint = "") const;
};

/// Takes a text that must be UTF-8 without control characters (tab, line feed and carriage return are welcome).
/// A byte order mark is dropped. Throws InputError at the first byte that is wrong.
SourceText make_source_text(std::string text, const std::string& file);

/// Reads a regular file of at most `largest` bytes. Throws InputError for a missing or unreadable file, a folder, a
/// device, a file that is too large, and a text that make_source_text refuses.
SourceText read_source_text(const std::filesystem::path& path, std::size_t largest);

/// "what is wrong\n  hint: what to do" in two; the second is "" where there is no hint.
std::pair<std::string, std::string> error_and_hint(const std::string& told);

/// Where a text holds its first control character, U+0000 .. U+001F or U+007F .. U+009F but for tab, line feed and
/// carriage return; npos for none.
std::size_t find_control(std::string_view text);

/// A word from a file, cut to a length that fits in a message.
std::string clipped(std::string_view word);

}  // namespace soilbin
