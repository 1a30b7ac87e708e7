// A query of a served page, "slip=20%25&effect=none", as flags of a command, and read by the command's own code.
#pragma once

#include <CLI/CLI.hpp>
#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "scenario/library.hpp"

namespace soilbin::cli {

/// A flag of a command without its dashes, and its value: {"load", "80N"}.
using Flag = std::pair<std::string, std::string>;

/// "load=80N&slip=20%25". Throws InputError for a part without a value and a '%' without its two digits.
std::vector<Flag> flags_of(const std::string& query);

bool holds(const std::vector<Flag>& flags, const std::string& key);

/// Takes the flags of this name out; the last one counts.
std::optional<std::string> take(std::vector<Flag>& flags, const std::string& key);

/// A query reads no file: throws InputError for a soil or tire that is none of the library's.
void refuse_files(const std::vector<Flag>& query, const Library& library);

/// {"estimate", "paper-straight", "--slip=20%"}: the command, what it is asked of ("": nothing), and the flags of the
/// start that the query neither says otherwise nor takes away with another one (`goes`); then the query's.
std::vector<std::string> words_of(const std::string& command, const std::string& name, const std::vector<Flag>& start,
                                  const std::vector<Flag>& query, const std::function<bool(const Flag&)>& goes);

/// Parses the words behind the command by the flags of an app that is called as the command is. Throws InputError with
/// a hint.
void read_words(CLI::App& app, const std::vector<std::string>& words);

}  // namespace soilbin::cli
