#include "cli/serve/query.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <charconv>

#include "cli/command_words.hpp"
#include "cli/flag_values.hpp"
#include "scenario/errors.hpp"
#include "scenario/nearest_word.hpp"
#include "scenario/source_text.hpp"

namespace soilbin::cli {
namespace {

/// "a+b%20c" as "a b c". Throws InputError for a '%' without its two digits.
std::string decoded(const std::string& text) {
  std::string out;
  for (std::size_t at = 0; at < text.size(); ++at) {
    unsigned code = 0;
    if (text[at] != '%') {
      out += text[at] == '+' ? ' ' : text[at];
      continue;
    }
    const char* digits = text.data() + at + 1;
    if (text.size() < at + 3 || std::from_chars(digits, digits + 2, code, 16).ptr != digits + 2)
      throw InputError(fmt::format("'{}': a percent sign in an address is written %25", clipped(text)));
    out += static_cast<char>(code);
    at += 2;
  }
  return out;
}

std::string as_word(const Flag& flag) { return "--" + flag.first + "=" + flag.second; }

}  // namespace

std::vector<Flag> flags_of(const std::string& query) {
  std::vector<Flag> flags;
  for (const std::string& part : split(query, "&")) {
    if (part.empty()) continue;
    const std::size_t equals = part.find('=');
    if (equals == std::string::npos || equals + 1 == part.size())
      throw InputError(fmt::format("'{}' has no value\n  hint: such as load=80N", clipped(decoded(part))));
    flags.emplace_back(decoded(part.substr(0, equals)), decoded(part.substr(equals + 1)));
  }
  return flags;
}

bool holds(const std::vector<Flag>& flags, const std::string& key) {
  return std::ranges::any_of(flags, [&](const Flag& flag) { return flag.first == key; });
}

std::optional<std::string> take(std::vector<Flag>& flags, const std::string& key) {
  std::optional<std::string> text;
  std::erase_if(flags, [&](const Flag& flag) {
    if (flag.first == key) text = flag.second;
    return flag.first == key;
  });
  return text;
}

void refuse_files(const std::vector<Flag>& query, const Library& library) {
  for (const auto& [key, name] : query)
    for (const Shelf shelf : {Shelf::soils, Shelf::tires})
      if (key == (shelf == Shelf::soils ? "soil" : "tire") && !library.find(shelf, name)) {
        const std::vector<std::string> names = library.names(shelf);
        throw InputError(fmt::format("--{}: '{}' is none of the library's {}{}\n  hint: there are {}", key,
                                     clipped(name), folder_of(shelf), did_you_mean(name, names), listed(names)));
      }
}

std::vector<std::string> words_of(const std::string& command, const std::string& name, const std::vector<Flag>& start,
                                  const std::vector<Flag>& query, const std::function<bool(const Flag&)>& goes) {
  std::vector<std::string> words = {command};
  if (!name.empty()) words.push_back(name);
  for (const Flag& flag : start)
    if (!holds(query, flag.first) && !goes(flag)) words.push_back(as_word(flag));
  for (const Flag& flag : query) words.push_back(as_word(flag));
  return words;
}

void read_words(CLI::App& app, const std::vector<std::string>& words) {
  if (const std::string problem = unknown_flag(app, words); !problem.empty()) throw InputError(problem);
  try {
    app.parse(std::vector<std::string>(words.rbegin(), words.rend() - 1));
  } catch (const CLI::ParseError& error) {
    throw InputError(refusal_of(error, words.front() + " "));
  }
}

}  // namespace soilbin::cli
