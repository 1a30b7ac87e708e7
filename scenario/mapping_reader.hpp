// Reads a described struct (description.hpp) from a YAML mapping. Every refusal names file, line and column.
#pragma once

#include <functional>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include "scenario/csv_columns.hpp"
#include "scenario/description.hpp"
#include "scenario/yaml_node.hpp"

namespace soilbin {

struct Reading;
/// Reads a soil that is a mapping, a name of the library or a path.
using SoilReader = std::function<Soil(const YamlNode&, const Reading&)>;

/// What the reader knows on its way down a document.
struct Reading {
  const SourceText* source = nullptr;
  std::optional<double> n;                                ///< the soil's exponent, once read
  std::map<std::string, std::string>* sources = nullptr;  ///< where the `source:` of a number is kept, if anywhere
  std::string path;                                       ///< of this mapping inside the struct that keeps sources
  const SoilReader* soils = nullptr;                      ///< where descriptions have parts
  double assumed_sd = 0;  ///< share of a value that is its standard deviation where it has none of its own

  [[noreturn]] void refuse(const YamlNode& at, const std::string& message, const std::string& hint = "") const {
    source->refuse(at.offset, message, hint);
  }
};

/// Refuses a node that is no mapping, and the first key that is not among `keys`, with the nearest that is.
void expect_keys(const YamlNode& mapping, const std::vector<std::string>& keys, const Reading& reading);

/// The value behind a key; nullptr where it is absent and may be. Refuses an absent key that is required and a key
/// with nothing behind it.
const YamlNode* value_of(const YamlNode& mapping, const std::string& key, Need need, const std::string& meaning,
                         const Reading& reading);

/// A text of any number of lines: a description.
std::string read_text(const YamlNode& node, const Reading& reading);
/// A text of one line: a name, which is printed, becomes part of commands and names files.
std::string read_name(const YamlNode& node, const Reading& reading);
/// A scalar with its unit, for instance one of a list.
Quantity read_scalar(const YamlNode& node, const Measure& measure, const Reading& reading);
/// A scalar, or {value, source}.
double read_number(const YamlNode& node, const Measure& measure, const std::string& key, Reading& reading);
/// A scalar, or {value, sd, source}. Without sd: the share of the value that the file assumes, or 0.
Estimate read_estimate(const YamlNode& node, const Measure& measure, const std::string& key, Reading& reading);
/// A whole number of at least `lowest`.
int read_integer(const YamlNode& node, int lowest, const Reading& reading);
/// The place of a word among the right ones.
std::size_t read_word(const YamlNode& node, const std::vector<std::string>& right, const Reading& reading);

/// The rows of a CSV that a file names by a path relative to itself, as read_csv_columns reads them.
std::vector<std::vector<double>> read_named_csv(const YamlNode& path, const std::vector<CsvColumn>& columns,
                                                const Reading& reading);

/// Reads one word of an enum.
template <class E>
E read_choice(const YamlNode& node, const Reading& reading) {
  return words_of(std::type_identity<E>{})[read_word(node, all_words<E>(), reading)].value;
}

template <class T>
void read_into(const YamlNode& mapping, T& into, Reading& reading);

/// The visitor that fills a T from a mapping.
template <class T>
class ReadInto {
 public:
  ReadInto(const YamlNode& mapping, T& into, Reading& reading) : mapping_(mapping), into_(into), reading_(reading) {}

  void text(const char* key, std::string T::*member, Need need, const char* meaning) {
    if (const YamlNode* node = find(key, need, meaning))
      into_.*member = may_have_lines(key) ? read_text(*node, reading_) : read_name(*node, reading_);
  }

  template <class N>
  void number(const char* key, N T::*member, const Measure& measure, Need need, const char* meaning) {
    const YamlNode* node = find(key, need, meaning);
    if (node == nullptr) return;
    if constexpr (std::is_same_v<N, Estimate> || std::is_same_v<N, std::optional<Estimate>>)
      into_.*member = read_estimate(*node, measure, key, reading_);
    else
      into_.*member = read_number(*node, measure, key, reading_);
  }

  void exponent(const char* key, Estimate T::*member, const Range& range, Need need, const char* meaning) {
    number(key, member, Measure{"-", range}, need, meaning);
    reading_.n = (into_.*member).value;
  }

  void assumed_sd(const char* key, std::optional<double> T::*member, const char* meaning) {
    number(key, member, Measure{"-", zero_or_more}, Need::optional, meaning);
    reading_.assumed_sd = (into_.*member).value_or(0.0);
  }

  template <class N>
  void integer(const char* key, N T::*member, int lowest, Need need, const char* meaning) {
    if (const YamlNode* node = find(key, need, meaning)) into_.*member = read_integer(*node, lowest, reading_);
  }

  template <class E>
  void choice(const char* key, E T::*member, Need need, const char* meaning) {
    if (const YamlNode* node = find(key, need, meaning)) into_.*member = read_choice<E>(*node, reading_);
  }

  /// Takes the word 'unknown' for an absent key.
  template <class E>
  void choice(const char* key, std::optional<E> T::*member, Need need, const char* meaning) {
    const YamlNode* node = find(key, need, meaning);
    if (node != nullptr && node->scalar != "unknown") into_.*member = read_choice<E>(*node, reading_);
  }

  template <class U>
  void group(const char* key, std::optional<U> T::*member, Need need, const char* meaning) {
    const YamlNode* node = find(key, need, meaning);
    if (node == nullptr) return;
    U& inner = (into_.*member).emplace();
    if constexpr (!std::is_null_pointer_v<std::decay_t<decltype(rows_in_csv<U>)>>) {
      if (node->is_scalar()) return read_rows(*node, inner.source, inner.*rows_in_csv<U>, inner);
    }
    descend(key, *node, inner);
  }

  template <class U>
  void group(const char* key, U T::*member, Need need, const char* meaning) {
    if (const YamlNode* node = find(key, need, meaning)) descend(key, *node, into_.*member);
  }

  template <class U>
  void list(const char* key, std::vector<U> T::*member, Need need, const char* meaning) {
    const YamlNode* node = find(key, need, meaning);
    if (node == nullptr) return;
    if (!node->is_sequence()) reading_.refuse(*node, "expected a list of mappings, not " + node->kind_name());
    for (const YamlNode& item : node->items) descend(key, item, (into_.*member).emplace_back());
  }

  void part(const char* key, std::optional<Soil> T::*member, Need need, const char* meaning) {
    if (const YamlNode* node = find(key, need, meaning)) into_.*member = (*reading_.soils)(*node, reading_);
  }

 private:
  /// Whether a text stands behind the key: what people write sentences for.
  static bool may_have_lines(std::string_view key) {
    return key == "description" || key == "source" || key == "quote" || key == "title" || key == "chosen";
  }

  const YamlNode* find(const char* key, Need need, const char* meaning) const {
    return value_of(mapping_, key, need, meaning, reading_);
  }

  template <class U>
  void descend(const std::string& key, const YamlNode& node, U& inner) {
    Reading below = reading_;
    below.path = reading_.path + key + ".";
    expect_keys(node, keys_of<U>(), below);
    read_into(node, inner, below);
  }

  /// Rows of numbers from the CSV that a scalar names.
  template <class Row, class Whole>
  void read_rows(const YamlNode& path, std::string& source, std::vector<Row>& rows, const Whole& whole) {
    std::vector<CsvColumn> columns;
    std::vector<double Row::*> members;
    each_member<Row>([&](const char* key, double Row::*member, const Measure& measure, const char*) {
      columns.push_back({key, measure});
      members.push_back(member);
    });
    for (const std::vector<double>& numbers : read_named_csv(path, columns, reading_)) {
      Row& row = rows.emplace_back();
      for (std::size_t i = 0; i < members.size(); ++i) row.*members[i] = numbers[i];
    }
    source = path.scalar;
    if (const std::string wrong = contradiction(whole); !wrong.empty()) reading_.refuse(path, wrong);
  }

  const YamlNode& mapping_;
  T& into_;
  Reading& reading_;
};

/// Reads the described keys of T from a mapping whose keys have been checked.
template <class T>
void read_into(const YamlNode& mapping, T& into, Reading& reading) {
  if constexpr (requires { into.sources; }) {
    reading.sources = &into.sources;
    reading.path.clear();
  }
  ReadInto<T> visitor(mapping, into, reading);
  describe(visitor, std::type_identity<T>{});
  fill_in(into, [&](const char* key) { return mapping.find(key) != nullptr; });
  if (const std::string wrong = contradiction(into); !wrong.empty()) reading.refuse(mapping, wrong);
}

/// Reads a T from a mapping that holds its keys and `others` (which the caller reads), and no key beside those.
template <class T>
T read_mapping(const YamlNode& mapping, const Reading& reading, const std::vector<std::string>& others = {}) {
  std::vector<std::string> keys = keys_of<T>();
  keys.insert(keys.begin(), others.begin(), others.end());
  expect_keys(mapping, keys, reading);
  T value;
  Reading below = reading;
  read_into(mapping, value, below);
  return value;
}

/// Checks that a document is a mapping whose `format` is the one expected, such as "soilbin-case/1".
void expect_format(const YamlNode& document, const std::string& format, const Reading& reading);

}  // namespace soilbin
