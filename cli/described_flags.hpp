// Command-line flags made from the descriptions that the file formats use (scenario/description.hpp), so that a key of
// a case file and a flag of the command have one name, one unit and one range.
#pragma once

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <map>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "cli/flag_values.hpp"
#include "scenario/condition_axes.hpp"
#include "scenario/description.hpp"
#include "scenario/errors.hpp"
#include "scenario/nearest_word.hpp"

namespace soilbin::cli {

/// The value of an enumeration that a flag's text names. Throws InputError that names the flag and the right words.
template <class E>
E read_word(const std::string& flag, const std::string& text) {
  if (const std::optional<E> value = value_named<E>(text)) return *value;
  throw InputError(flag + ": " + none_of(text, all_words<E>()));
}

/// "longitudinal_incline" -> "--longitudinal-incline"
inline std::string flag_of(const std::string& prefix, std::string key) {
  std::ranges::replace(key, '_', '-');
  return "--" + prefix + key;
}

/// Whether a described member takes a standard deviation with its value.
template <class T, class Member>
inline constexpr bool has_deviation =
    std::is_same_v<std::decay_t<decltype(T().*std::declval<Member>())>, std::optional<Estimate>>;

/// Flags for the described numbers, whole numbers and choices of T.
template <class T>
class DescribedFlags {
 public:
  /// Adds "--<prefix><key>" for every key that is not among `without`.
  void add_to(CLI::App& app, const std::string& heading, const std::string& prefix = "",
              const std::vector<std::string>& without = {}) {
    prefix_ = prefix;
    each_member<T>([&](const char* key, auto member, const auto& limits, const char* meaning) {
      using Limits = std::decay_t<decltype(limits)>;
      std::string& text = texts_[key];
      if (std::ranges::find(without, key) != without.end()) return;
      std::string kind;
      if constexpr (std::is_same_v<Limits, Measure>)
        kind = (limits.unit == "-" ? "NUMBER|%" : limits.unit) + (has_deviation<T, decltype(member)> ? "[+-SD]" : "");
      else if constexpr (std::is_same_v<Limits, int>)
        kind = "WHOLE";
      else
        kind = fmt::format("{}", fmt::join(all_words<std::decay_t<decltype(T().*member)>>(), "|"));
      add_value(app, flag_of(prefix_, key), text, kind, meaning)->group(heading);
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

  /// These flags once for each combination of the values that they hold (several_values), those of the key `fastest`
  /// varying fastest. Throws InputError that names the flag, and for more than `most`, before they are made.
  std::vector<DescribedFlags> combinations(const std::string& fastest, std::size_t most = most_conditions) const {
    std::vector<DescribedFlags> all = {*this};
    const auto multiply = [&](const std::string& key, const std::vector<std::string>& values) {
      if (values.size() > most / all.size())
        throw InputError(fmt::format("{}: more than {} conditions", flag_of(prefix_, key), most));
      std::vector<DescribedFlags> product;
      for (const DescribedFlags& flags : all)
        for (const std::string& value : values) product.emplace_back(flags).texts_[key] = value;
      all = std::move(product);
    };
    const auto values_of = [&](const char* key, const auto& limits) {
      if constexpr (std::is_same_v<std::decay_t<decltype(limits)>, Measure>)
        return several_values(flag_of(prefix_, key), texts_.at(key), limits);
      else
        return split(texts_.at(key), ",");
    };
    for (const bool last : {false, true})
      each_member<T>([&](const char* key, auto, const auto& limits, const char*) {
        if (given(key) && (fastest == key) == last) multiply(key, values_of(key, limits));
      });
    return all;
  }

  /// Sets the members whose flags were given; `only`: that of this key alone. Throws InputError that names the flag.
  void apply(T& into, const std::string& only = "") const {
    each_member<T>([&](const char* key, auto member, const auto& limits, const char*) {
      const std::string &text = texts_.at(key), flag = flag_of(prefix_, key);
      if (text.empty() || (!only.empty() && only != key)) return;
      using Limits = std::decay_t<decltype(limits)>;
      if constexpr (std::is_same_v<std::decay_t<decltype(into.*member)>, std::optional<Estimate>>)
        into.*member = read_estimate_flag(flag, text, limits, into.*member);
      else if constexpr (std::is_same_v<Limits, Measure>)
        into.*member = read_flag(flag, text, limits);
      else if constexpr (std::is_same_v<Limits, int>)
        into.*member = read_whole(flag, text, limits);
      else
        into.*member = read_word<enum_of<std::decay_t<decltype(into.*member)>>>(flag, text);
    });
  }

 private:
  static int read_whole(const std::string& flag, const std::string& text, int lowest) {
    const auto value = read_number(text);
    constexpr int largest = 1'000'000'000;
    if (!value || !(*value >= lowest && *value <= largest) || *value != static_cast<int>(*value))
      throw InputError(
          fmt::format("{}: expected a whole number from {} to {}, not '{}'", flag, lowest, largest, clipped(text)));
    return static_cast<int>(*value);
  }

  std::string prefix_;
  std::map<std::string, std::string> texts_;
};

}  // namespace soilbin::cli
