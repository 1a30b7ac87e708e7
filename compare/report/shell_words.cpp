#include "compare/report/shell_words.hpp"

namespace soilbin::compare {

std::string shell_words(const std::vector<std::string>& words) {
  std::string line;
  for (const std::string& word : words) {
    const bool bare =
        !word.empty() &&
        word.find_first_not_of("abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789-_=+.,:/%@") ==
            std::string::npos;
    std::string quoted = word;
    for (std::size_t at = quoted.find('\''); at != std::string::npos; at = quoted.find('\'', at + 4))
      quoted.replace(at, 1, "'\\''");
    line += (line.empty() ? "" : " ") + (bare ? word : "'" + quoted + "'");
  }
  return line;
}

}  // namespace soilbin::compare
