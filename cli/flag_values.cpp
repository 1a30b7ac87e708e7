#include "cli/flag_values.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <charconv>
#include <filesystem>
#include <system_error>
#include <thread>

#include "scenario/atomic_file.hpp"
#include "scenario/condition_axes.hpp"
#include "scenario/errors.hpp"
#include "scenario/file_bytes.hpp"
#include "scenario/nearest_word.hpp"
#include "scenario/source_text.hpp"

namespace soilbin::cli {

std::vector<std::string> split(std::string_view text, std::string_view between) {
  std::vector<std::string> parts;
  std::size_t from = 0;
  for (std::size_t at; (at = text.find(between, from)) != std::string_view::npos; from = at + between.size())
    parts.emplace_back(text.substr(from, at - from));
  parts.emplace_back(text.substr(from));
  return parts;
}

double read_flag(const std::string& flag, const std::string& text, const Measure& measure) {
  try {
    return read_quantity(text, measure);
  } catch (const InputError& error) {
    throw InputError(fmt::format("{}: {}", flag, error.what()));
  }
}

std::pair<std::string, std::string> value_and_deviation(std::string text) {
  for (const char* sign : {"±", "+-"}) {
    const std::vector<std::string> parts = split(text, sign);
    if (parts.size() != 2) continue;
    const std::size_t digits = parts[1].find_first_not_of("0123456789.eE+- ");
    const std::string unit = digits == std::string::npos ? "" : parts[1].substr(digits);
    return {read_number(parts[0]) ? parts[0] + " " + unit : parts[0], parts[1]};
  }
  return {std::move(text), ""};
}

Estimate read_estimate_flag(const std::string& flag, const std::string& text, const Measure& measure,
                            const std::optional<Estimate>& before) {
  const auto [value, deviation] = value_and_deviation(text);
  Estimate estimate{read_flag(flag, value, measure), before ? before->std_error : 0.0};
  if (!deviation.empty()) estimate.std_error = read_flag(flag, deviation, {measure.unit, zero_or_more});
  return estimate;
}

void check_model(const std::string& name, const std::vector<std::string>& right) {
  if (std::ranges::find(right, name) == right.end())
    throw InputError("--model: unknown model '" + clipped(name) + "'" + did_you_mean(name, right) +
                     "\n  hint: bekker_wong is the analytic wheel, dem the grains; rft and cone_index are quick models "
                     "of their own");
}

std::pair<double, double> read_range(const std::string& flag, const std::string& text, const Measure& measure) {
  const std::vector<std::string> ends = split(text, "..");
  if (ends.size() != 2)
    throw InputError(fmt::format("{}: expected LOW..HIGH with units, not '{}'", flag, clipped(text)));
  const std::pair range{read_flag(flag, ends[0], measure), read_flag(flag, ends[1], measure)};
  if (!(range.first < range.second))
    throw InputError(fmt::format("{}: the lower end must be below the upper one, not '{}'", flag, clipped(text)));
  return range;
}

namespace {

/// "100,250" are two values: nobody writes 100.25 with a third decimal of 0.
bool are_round_and_rise(const std::string& low, const std::string& high) {
  constexpr std::size_t least = 3;
  const auto is_round = [](const std::string& text) {
    return text.size() >= least && text.find_first_not_of("0123456789") == text.npos && text.back() == '0';
  };
  return is_round(low) && is_round(high) && low.size() == high.size() && low < high;
}

/// "80,5N" may be two loads, or one with a decimal comma.
void refuse_decimal_comma(const std::string& flag, const std::vector<std::string>& numbers, const std::string& unit) {
  const std::string& whole = numbers.front();
  if (numbers.size() == 2 && are_round_and_rise(whole, numbers.back().substr(0, numbers.back().size() - unit.size())))
    return;
  const bool may_be_one = numbers.size() == 2 && whole.find_first_not_of("-0123456789") == whole.npos &&
                          numbers.back().find_first_of("0123456789") == 0;
  if (!may_be_one) return;
  const std::string& last = numbers.back();
  const std::string two =
      unit.empty() ? fmt::format("{}.0,{}.0", whole, last) : fmt::format("{}{},{}", whole, unit, last);
  throw InputError(
      fmt::format("{}: '{},{}' may be two values or one with a decimal comma\n  hint: '{}' are two, '{}.{}' is one",
                  flag, clipped(whole), clipped(last), clipped(two), clipped(whole), clipped(last)));
}

}  // namespace

std::vector<std::string> several_values(const std::string& flag, const std::string& text, const Measure& measure) {
  const std::vector<std::string> ends = split(text, "..");
  const bool is_range = ends.size() > 1;
  std::vector<std::string> numbers = split(ends.back(), is_range ? ":" : ",");
  if (is_range) numbers.insert(numbers.begin(), ends.begin(), ends.end() - 1);
  if (numbers.size() == 1) return numbers;
  if (std::ranges::any_of(numbers, &std::string::empty) || (is_range && (ends.size() > 2 || numbers.size() > 3)))
    throw InputError(fmt::format(
        "{}: expected a list or a range, not '{}'\n  hint: {}", flag, clipped(text),
        measure.unit == "-" ? "such as 0,10,20%, or 0%..60%, or in steps 0%..60%:5%"
                            : fmt::format("such as 1,2,5{0}, or 1..5{0}, or in steps 1..5:0.5{0}", measure.unit)));
  const std::string unit = numbers.back().substr(numbers.back().find_last_of("0123456789.") + 1);
  if (!is_range) refuse_decimal_comma(flag, numbers, unit);
  for (std::string& number : numbers)
    if (read_number(number)) number += unit;
  if (!is_range) return numbers;
  try {
    constexpr int usual_count = 7;
    const Quantity from = parse_quantity(numbers[0], measure);
    const double to = read_quantity(numbers[1], measure);
    const std::vector<double> values =
        numbers.size() == 2 ? numbers_by_count(from, to, usual_count)
                            : numbers_by_step(from, to, parse_quantity(numbers[2], {measure.unit, any_value}));
    if (values.size() < 2 || from.value == to) throw InputError("the range holds one value alone");
    numbers.clear();
    for (const double value : values) numbers.push_back(write_quantity(value, measure.unit));
    return numbers;
  } catch (const InputError& error) {
    throw InputError(fmt::format("{} {}: {}", flag, clipped(text), error.what()));
  }
}

std::vector<std::pair<std::string, std::string>> column_values(const std::string& flag,
                                                               const std::vector<std::string>& texts) {
  std::vector<std::pair<std::string, std::string>> all;
  for (const std::string& text : texts) {
    const std::size_t equals = text.find('=');
    if (equals == std::string::npos || equals == 0)
      throw InputError(fmt::format("{}: expected COLUMN=VALUE, such as box=large-box, not '{}'", flag, clipped(text)));
    all.emplace_back(text.substr(0, equals), text.substr(equals + 1));
  }
  return all;
}

int all_cores() { return static_cast<int>(std::max(1U, std::thread::hardware_concurrency())); }

CLI::Validator whole_number(long long lower, long long upper) {
  return {[=](std::string& text) -> std::string {
            long long value = 0;
            const char* end = text.data() + text.size();
            const auto read = std::from_chars(text.data(), end, value);
            if (read.ec == std::errc() && read.ptr == end && value >= lower && value <= upper) return "";
            const std::string range = upper < std::numeric_limits<long long>::max()
                                          ? fmt::format("from {} to {}", lower, upper)
                                          : fmt::format("of at least {}", lower);
            return fmt::format("expected a whole number {}, not '{}'", range, clipped(text));
          },
          ""};
}

CLI::Option* add_repeatable(CLI::App& command, const std::string& flag, std::vector<std::string>& values,
                            const std::string& type, const std::string& meaning) {
  return add_value(command, flag, values, type, meaning)->allow_extra_args(false);
}

CLI::Option* add_file(CLI::App& command, const char* flag, std::string& name, const char* type, const char* meaning) {
  const auto announced = [by = std::string(flag)](const std::string& given) {
    announce_output(given, by);
    return std::string();
  };
  return add_kept_file(command, flag, name, type, meaning)->check(announced);
}

CLI::Option* add_kept_file(CLI::App& command, const char* flag, std::string& name, const char* type,
                           const char* meaning) {
  const auto refused = [](const std::string& given) { return why_not_writable(given); };
  return add_value(command, flag, name, type, meaning)->check(refused);
}

CLI::Option* add_folder(CLI::App& command, const char* flag, std::string& name, const char* meaning,
                        const std::vector<std::string>& written) {
  const auto refused = [by = std::string(flag), written](const std::string& given) {
    for (const std::string& file : written) announce_output(std::filesystem::path(given) / file, by);
    return why_no_folder(given);
  };
  return add_value(command, flag, name, "DIR", meaning)->check(refused);
}

}  // namespace soilbin::cli
