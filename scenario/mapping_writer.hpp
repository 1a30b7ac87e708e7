// Writes a described struct (description.hpp) as YAML. Every key that has a value is written, defaults included. What
// no reader would take is not written: a number out of its range, or none, is an InputError that names its key.
#pragma once

#include <cmath>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include "scenario/description.hpp"
#include "scenario/number_check.hpp"

namespace soilbin {

/// A text as a YAML scalar: plain where that is safe, else in double quotes.
std::string yaml_scalar(std::string_view text);

/// Lines of YAML in block style, two blanks a level.
class YamlLines {
 public:
  void value(std::string_view key, std::string_view scalar);  ///< key: scalar
  void open(std::string_view key);                            ///< key: and a level in
  void close();
  void open_item();  ///< the next line begins an item of a list; its other keys follow a level in
  void item(std::string_view scalar);
  const std::string& text() const { return text_; }

 private:
  void begin_line();

  std::string text_;
  int depth_ = 0;
  bool item_pending_ = false;
};

/// What the writer knows on its way down.
struct Writing {
  YamlLines* lines = nullptr;
  std::optional<double> n;                                      ///< the soil's exponent, once written
  const std::map<std::string, std::string>* sources = nullptr;  ///< of the innermost struct that keeps them
  std::string path;
  double assumed_sd = 0;  ///< share of a value that is its standard deviation where none is written
};

/// 'key: number' or 'key: {value: number, sd: ..., source: ...}'; `silent_sd`, which a reader takes
/// where no sd stands, is left out.
void write_estimate(const std::string& key, const Estimate& estimate, const std::string& unit, Writing& writing,
                    double silent_sd = 0.0);

/// How files spell an enum's value.
template <class E>
std::string_view word_of(E value) {
  for (const Word<E>& word : words_of(std::type_identity<E>{}))
    if (word.value == value) return word.text;
  return "";
}

template <class T>
void write_members(const T& from, Writing& writing);

/// The visitor that writes a T.
template <class T>
class WriteFrom {
 public:
  WriteFrom(const T& from, Writing& writing) : from_(from), writing_(writing) {}

  void text(const char* key, std::string T::*member, Need need, const char*) {
    if (need == Need::required || !(from_.*member).empty()) writing_.lines->value(key, yaml_scalar(from_.*member));
  }

  void number(const char* key, double T::*member, const Measure& measure, Need, const char*) {
    check_number(key, from_.*member, measure);
    write_estimate(key, {from_.*member, 0.0}, measure.unit, writing_);
  }

  void number(const char* key, std::optional<double> T::*member, const Measure& measure, Need, const char*) {
    if (!(from_.*member)) return;
    check_number(key, *(from_.*member), measure);
    write_estimate(key, {*(from_.*member), 0.0}, measure.unit, writing_);
  }

  void number(const char* key, Estimate T::*member, const Measure& measure, Need, const char*) {
    const Estimate& estimate = from_.*member;
    check_number(key, estimate.value, measure);
    check_number((std::string("sd of ") + key).c_str(), estimate.std_error, {measure.unit, zero_or_more});
    write_estimate(key, estimate, measure.unit, writing_, writing_.assumed_sd * std::abs(estimate.value));
  }

  void number(const char* key, std::optional<Estimate> T::*member, const Measure& measure, Need, const char*) {
    if (from_.*member) write_estimate(key, *(from_.*member), measure.unit, writing_);
  }

  void exponent(const char* key, Estimate T::*member, const Range& range, Need need, const char* meaning) {
    number(key, member, Measure{"-", range}, need, meaning);
    writing_.n = (from_.*member).value;
  }

  void assumed_sd(const char* key, std::optional<double> T::*member, const char* meaning) {
    number(key, member, Measure{}, Need::optional, meaning);
    writing_.assumed_sd = (from_.*member).value_or(0.0);
  }

  void integer(const char* key, int T::*member, int, Need, const char*) {
    writing_.lines->value(key, std::to_string(from_.*member));
  }

  void integer(const char* key, std::optional<int> T::*member, int, Need, const char*) {
    if (from_.*member) writing_.lines->value(key, std::to_string(*(from_.*member)));
  }

  template <class E>
  void choice(const char* key, E T::*member, Need, const char*) {
    writing_.lines->value(key, word_of(from_.*member));
  }

  template <class E>
  void choice(const char* key, std::optional<E> T::*member, Need, const char*) {
    if (from_.*member) writing_.lines->value(key, word_of(*(from_.*member)));
  }

  template <class U>
  void group(const char* key, U T::*member, Need, const char*) {
    descend(key, from_.*member);
  }

  template <class U>
  void group(const char* key, std::optional<U> T::*member, Need, const char*) {
    if (from_.*member) descend(key, *(from_.*member));
  }

  template <class U>
  void list(const char* key, std::vector<U> T::*member, Need, const char*) {
    if ((from_.*member).empty()) return;
    writing_.lines->open(key);
    for (const U& inner : from_.*member) {
      Writing below = writing_;
      below.path = writing_.path + key + ".";
      writing_.lines->open_item();
      write_members(inner, below);
      writing_.lines->close();
    }
    writing_.lines->close();
  }

  void part(const char* key, std::optional<Soil> T::*member, Need, const char*) {
    if (from_.*member) descend(key, *(from_.*member));
  }

 private:
  void descend(const char* key, const auto& inner) {
    Writing below = writing_;
    below.path = writing_.path + key + ".";
    writing_.lines->open(key);
    write_members(inner, below);
    writing_.lines->close();
  }

  const T& from_;
  Writing& writing_;
};

/// Writes the described keys of T at the current level.
template <class T>
void write_members(const T& from, Writing& writing) {
  if constexpr (requires { from.sources; }) {
    writing.sources = &from.sources;
    writing.path.clear();
  }
  WriteFrom<T> visitor(from, writing);
  describe(visitor, std::type_identity<T>{});
}

/// Writes a struct below a key of its own.
void write_group(std::string_view key, const auto& from, YamlLines& lines) {
  lines.open(key);
  Writing writing{&lines, std::nullopt, nullptr, ""};
  write_members(from, writing);
  lines.close();
}

}  // namespace soilbin
