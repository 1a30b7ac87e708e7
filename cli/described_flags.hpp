// Command-line flags made from the descriptions that the file formats use (scenario/description.hpp), so that a key of
// a case file and a flag of the command have one name, one unit and one range.
#pragma once

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <map>
#include <string>
#include <type_traits>
#include <vector>

#include "cli/flag_values.hpp"
#include "scenario/description.hpp"
#include "scenario/errors.hpp"
#include "scenario/nearest_word.hpp"

namespace soilbin::cli {

/// "longitudinal_incline" -> "--longitudinal-incline"
inline std::string flag_of(const std::string& prefix, std::string key) {
  std::ranges::replace(key, '_', '-');
  return "--" + prefix + key;
}

/// Flags for the described numbers, whole numbers and choices of T.
template <class T>
class DescribedFlags {
 public:
  /// Adds "--<prefix><key>" for every key.
  void add_to(CLI::App& app, const std::string& heading, const std::string& prefix = "") {
    prefix_ = prefix;
    each_member<T>([&](const char* key, auto member, const auto& limits, const char* meaning) {
      using Limits = std::decay_t<decltype(limits)>;
      std::string kind;
      if constexpr (std::is_same_v<Limits, Measure>)
        kind = limits.unit == "-" ? "NUMBER|%" : limits.unit;
      else if constexpr (std::is_same_v<Limits, int>)
        kind = "WHOLE";
      else
        kind = fmt::format("{}", fmt::join(all_words<std::decay_t<decltype(T().*member)>>(), "|"));
      add_value(app, flag_of(prefix_, key), texts_[key], kind, meaning)->group(heading);
    });
  }

  bool given(const std::string& key) const { return !texts_.at(key).empty(); }
  bool any_given() const {
    return std::ranges::any_of(texts_, [](const auto& entry) { return !entry.second.empty(); });
  }

  /// The keys whose flags were given.
  std::vector<std::string> given_keys() const {
    std::vector<std::string> keys;
    for (const auto& [key, text] : texts_)
      if (!text.empty()) keys.push_back(key);
    return keys;
  }

  /// Sets the members whose flags were given; `only`: that of this key alone. Throws InputError that names the flag.
  void apply(T& into, const std::string& only = "") const {
    each_member<T>([&](const char* key, auto member, const auto& limits, const char*) {
      const std::string &text = texts_.at(key), flag = flag_of(prefix_, key);
      if (text.empty() || (!only.empty() && only != key)) return;
      using Limits = std::decay_t<decltype(limits)>;
      if constexpr (std::is_same_v<Limits, Measure>)
        into.*member = read_flag(flag, text, limits);
      else if constexpr (std::is_same_v<Limits, int>)
        into.*member = read_whole(flag, text, limits);
      else
        into.*member = read_choice<std::decay_t<decltype(into.*member)>>(flag, text);
    });
  }

 private:
  static int read_whole(const std::string& flag, const std::string& text, int lowest) {
    const auto value = read_number(text);
    constexpr double largest = 1e9;
    if (!value || !(*value >= lowest && *value <= largest) || *value != static_cast<int>(*value))
      throw InputError(flag + ": expected a whole number of at least " + std::to_string(lowest) + ", not '" + text +
                       "'");
    return static_cast<int>(*value);
  }
  template <class E>
  static E read_choice(const std::string& flag, const std::string& text) {
    if (const std::optional<E> value = value_named<E>(text)) return *value;
    throw InputError(flag + ": '" + text + "' is none of " + listed(all_words<E>()) +
                     did_you_mean(text, all_words<E>()));
  }

  std::string prefix_;
  std::map<std::string, std::string> texts_;
};

}  // namespace soilbin::cli
