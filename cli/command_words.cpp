#include "cli/command_words.hpp"

#include <fmt/core.h>

#include <algorithm>

#include "scenario/nearest_word.hpp"
#include "scenario/source_text.hpp"

namespace soilbin::cli {

std::string command_line(const std::vector<std::string>& words) {
  std::string line = "soilbin";
  for (const std::string& word : words) {
    const bool bare = !word.empty() && word.find_first_not_of(
                                           "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ"
                                           "0123456789-_=+.,:/%@") == std::string::npos;
    std::string quoted = word;
    for (std::size_t at = quoted.find('\''); at != std::string::npos; at = quoted.find('\'', at + 4))
      quoted.replace(at, 1, "'\\''");
    line += bare ? " " + word : " '" + quoted + "'";
  }
  return line;
}

namespace {

/// Words that people use, and the flag that means them.
constexpr std::pair<std::string_view, std::string_view> everyday_words[] = {{"--slope", "--longitudinal-incline"},
                                                                            {"--incline", "--longitudinal-incline"},
                                                                            {"--grade", "--longitudinal-incline"},
                                                                            {"--pitch", "--longitudinal-incline"},
                                                                            {"--cross-slope", "--transverse-incline"},
                                                                            {"--side-slope", "--transverse-incline"},
                                                                            {"--bank", "--transverse-incline"},
                                                                            {"--slip-angle", "--yaw"},
                                                                            {"--steering", "--yaw"},
                                                                            {"--weight", "--load"},
                                                                            {"--velocity", "--speed"},
                                                                            {"--pressure", "--inflation-pressure"}};

/// What a command has for a flag that it doesn't know, or "".
std::string suggestion(const std::string& flag, const std::vector<std::string>& flags) {
  for (const auto& [word, meant] : everyday_words)
    if (flag == word && std::find(flags.begin(), flags.end(), meant) != flags.end())
      return fmt::format(", did you mean '{}'?", meant);
  return did_you_mean(flag, flags);
}

}  // namespace

std::string unknown_flag(const CLI::App& command, const std::vector<std::string>& words) {
  std::vector<std::string> flags;
  for (const CLI::Option* option : command.get_options())
    for (const std::string& name : option->get_lnames()) flags.push_back("--" + name);
  for (const std::string& word : words) {
    if (word == "--") break;
    const std::string flag = word.substr(0, word.find('='));
    if (!flag.starts_with("--") || std::find(flags.begin(), flags.end(), flag) != flags.end()) continue;
    return fmt::format("'{}' has no option '{}'{}\n  hint: see soilbin {} --help", command.get_name(), clipped(flag),
                       suggestion(flag, flags), command.get_name());
  }
  return "";
}

}  // namespace soilbin::cli
