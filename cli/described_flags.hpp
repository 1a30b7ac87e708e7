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
  std::replace(key.begin(), key.end(), '_', '-');
  return "--" + prefix + key;
}

/// Flags for the described numbers, whole numbers and choices of T.
template <class T>
class DescribedFlags {
 public:
  /// Adds "--<prefix><key>" for every key.
  void add_to(CLI::App& app, const std::string& heading, const std::string& prefix = "") {
    prefix_ = prefix;
    Adder adder{*this, app, heading};
    describe(adder, std::type_identity<T>{});
  }

  bool given(const std::string& key) const { return !texts_.at(key).empty(); }
  bool any_given() const {
    return std::any_of(texts_.begin(), texts_.end(), [](const auto& entry) { return !entry.second.empty(); });
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
    Setter setter{*this, into, only};
    describe(setter, std::type_identity<T>{});
  }

 private:
  struct Adder {
    DescribedFlags& flags;
    CLI::App& app;
    const std::string& heading;

    void add(const char* key, const std::string& kind, const char* meaning) {
      app.add_option(flag_of(flags.prefix_, key), flags.texts_[key], meaning)->type_name(kind)->group(heading);
    }
    void text(const char*, std::string T::*, Need, const char*) {}
    template <class N>
    void number(const char* key, N T::*, const Measure& measure, Need, const char* meaning) {
      add(key, measure.unit == "-" ? "NUMBER|%" : measure.unit, meaning);
    }
    template <class N>
    void integer(const char* key, N T::*, int, Need, const char* meaning) {
      add(key, "WHOLE", meaning);
    }
    template <class E>
    void choice(const char* key, E T::*, Need, const char* meaning) {
      add(key, fmt::format("{}", fmt::join(all_words<E>(), "|")), meaning);
    }
    template <class U>
    void group(const char*, U, Need, const char*) {}
  };

  struct Setter {
    const DescribedFlags& flags;
    T& into;
    const std::string& only;

    const std::string* text_of(const char* key) const {
      if (!only.empty() && only != key) return nullptr;
      const std::string& text = flags.texts_.at(key);
      return text.empty() ? nullptr : &text;
    }
    void text(const char*, std::string T::*, Need, const char*) {}
    template <class N>
    void number(const char* key, N T::*member, const Measure& measure, Need, const char*) {
      if (const std::string* given = text_of(key))
        into.*member = read_flag(flag_of(flags.prefix_, key), *given, measure);
    }
    template <class N>
    void integer(const char* key, N T::*member, int lowest, Need, const char*) {
      const std::string* given = text_of(key);
      if (given == nullptr) return;
      const auto value = read_number(*given);
      constexpr double largest = 1e9;
      if (!value || !(*value >= lowest && *value <= largest) || *value != static_cast<int>(*value))
        throw InputError(flag_of(flags.prefix_, key) + ": expected a whole number of at least " +
                         std::to_string(lowest) + ", not '" + *given + "'");
      into.*member = static_cast<int>(*value);
    }
    template <class E>
    void choice(const char* key, E T::*member, Need, const char*) {
      const std::string* given = text_of(key);
      if (given == nullptr) return;
      const std::optional<E> value = value_named<E>(*given);
      if (!value)
        throw InputError(flag_of(flags.prefix_, key) + ": '" + *given + "' is none of " + listed(all_words<E>()) +
                         did_you_mean(*given, all_words<E>()));
      into.*member = *value;
    }
    template <class U>
    void group(const char*, U, Need, const char*) {}
  };

  std::string prefix_;
  std::map<std::string, std::string> texts_;
};

}  // namespace soilbin::cli
