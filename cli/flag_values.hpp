// Values as flags give them: numbers with units, ranges, lists. Each error names its flag.
#pragma once

#include <CLI/CLI.hpp>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "scenario/estimate.hpp"
#include "scenario/quantity.hpp"

namespace soilbin::cli {

/// The parts of a text, those that are empty too: one part where `between` isn't in it.
std::vector<std::string> split(std::string_view text, std::string_view between);

/// A number [SI]. Throws InputError that names the flag.
double read_flag(const std::string& flag, const std::string& text, const Measure& measure);

/// "30+-2 deg" as {"30 deg", "2 deg"}; the second is empty where none is given.
std::pair<std::string, std::string> value_and_deviation(std::string text);

/// A value with or without its standard deviation, "30+-2kPa"; without one it keeps that of `before`. Throws InputError
/// that names the flag.
Estimate read_estimate_flag(const std::string& flag, const std::string& text, const Measure& measure,
                            const std::optional<Estimate>& before);

/// Sets a number [SI] where the flag was given. Throws InputError that names the flag.
void set_where_given(const std::string& flag, const std::string& text, const Measure& measure, auto& number) {
  if (!text.empty()) number = read_flag(flag, text, measure);
}

/// Throws InputError for a --model that is none of these.
void check_model(const std::string& name, const std::vector<std::string>& right);

/// "LOW..HIGH" [SI], the lower end below the upper one. Throws InputError that names the flag.
std::pair<double, double> read_range(const std::string& flag, const std::string& text, const Measure& measure);

/// The values of a flag that takes several, each as text that read_flag reads: "20%"; a list, "0,10,20%"; a range of
/// seven values, "0%..60%", or in steps, "0%..60%:5%". A number without a unit takes the last one's. Throws InputError
/// that names the flag, for a range that is none; the values themselves are read later.
std::vector<std::string> several_values(const std::string& flag, const std::string& text, const Measure& measure);

/// "COLUMN=VALUE" as a pair, such as box=large-box. Throws InputError that names the flag.
std::vector<std::pair<std::string, std::string>> column_values(const std::string& flag,
                                                               const std::vector<std::string>& texts);

/// What --threads 0 means: the number of cores, at least 1.
int all_cores();

/// For flags that are whole numbers of at least `lower`, and at most `upper`.
CLI::Validator whole_number(long long lower, long long upper = std::numeric_limits<long long>::max());

/// A flag that takes a value, or an argument without a name; `type` and `meaning` as the help has them.
CLI::Option* add_value(CLI::App& command, const std::string& flag, auto& value, const std::string& type,
                       const std::string& meaning) {
  return command.add_option(flag, value, meaning)->type_name(type);
}

/// A flag that may be given again, each time with one value.
CLI::Option* add_repeatable(CLI::App& command, const std::string& flag, std::vector<std::string>& values,
                            const std::string& type, const std::string& meaning);

/// A flag that names a file to write: tries the place before any work is done, and refuses what can't become one.
/// Folders that are missing are made when the file is written. `type`: as the help has it, "FILE.csv". A command that
/// reads the same file is refused (announce_output).
CLI::Option* add_file(CLI::App& command, const char* flag, std::string& name, const char* type, const char* meaning);

/// A flag that names a file which the command reads first, so that nothing of it is lost.
CLI::Option* add_kept_file(CLI::App& command, const char* flag, std::string& name, const char* type,
                           const char* meaning);

/// A flag that names a folder for written files; `written`: those of them that the command may also read.
CLI::Option* add_folder(CLI::App& command, const char* flag, std::string& name, const char* meaning,
                        const std::vector<std::string>& written = {});

}  // namespace soilbin::cli
