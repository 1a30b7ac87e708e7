#include "compare/report/shell_words.hpp"

#include <fmt/core.h>

#include <algorithm>

namespace soilbin::compare {
namespace {

bool is_control(char c) { return (static_cast<unsigned char>(c) < 0x20U) || c == 0x7F; }

/// A word in quotes. One with control characters is spelt $'...', as bash has it, so that it stays on its line.
std::string quoted_word(const std::string& word) {
  const bool spelt = std::ranges::any_of(word, is_control);
  std::string quoted = spelt ? "$'" : "'";
  for (const char c : word)
    if (is_control(c))
      quoted += fmt::format("\\{:03o}", static_cast<unsigned>(c));
    else if (c == '\'')
      quoted += spelt ? "\\'" : "'\\''";
    else
      quoted += spelt && c == '\\' ? "\\\\" : std::string(1, c);
  return quoted + "'";
}

}  // namespace

std::string shell_words(const std::vector<std::string>& words) {
  std::string line;
  for (const std::string& word : words) {
    const bool bare =
        !word.empty() &&
        word.find_first_not_of("abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789-_=+.,:/%@") ==
            std::string::npos;
    line += (line.empty() ? "" : " ") + (bare ? word : quoted_word(word));
  }
  return line;
}

}  // namespace soilbin::compare
