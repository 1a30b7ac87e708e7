// The words of a command line: as a person can type them again, and which of them is misspelt.
#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

namespace soilbin::cli {

/// "soilbin WORD..." as a person can type it again: words that a shell would take apart are quoted.
std::string command_line(const std::vector<std::string>& words);

/// What is wrong with the words of a command ("estimate ") that CLI11 refuses, in ours, with a hint; where something is
/// missing, `example` is a part of it.
std::string refusal_of(const CLI::ParseError& error, const std::string& command, const std::string& example = "");

/// The first example in the help of the command that these words name; "" for none.
std::string example_of(const CLI::App& app, const std::vector<std::string>& words);

/// Names the flag before the first word that is "", as an unset variable of the shell gives it; "" for none.
std::string empty_text(const std::vector<std::string>& words);

/// Names the first of the words that looks like a flag ("--...", up to "--") and is none of the command's, with the
/// nearest right one and a hint; "" for none.
std::string unknown_flag(const CLI::App& command, const std::vector<std::string>& words);

}  // namespace soilbin::cli
