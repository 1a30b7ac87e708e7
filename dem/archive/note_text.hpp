// Values as the text of a note in a restart, exact both ways: numbers in full precision with blanks between, words by
// their length. What a struct holds is said once, for writing and reading:
//
//   template <class Notes> void archive(Notes& notes, Vec3& v) { notes(v.x, v.y, v.z); }
#pragma once

#include <fmt/core.h>

#include <array>
#include <charconv>
#include <iterator>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include "dem/surface/vec3.hpp"
#include "scenario/errors.hpp"

namespace soilbin::dem {

template <class Notes>
void archive(Notes& notes, Vec3& v) {
  notes(v.x, v.y, v.z);
}

class NoteWriter {
 public:
  static constexpr bool reads = false;
  template <class... T>
  void operator()(T&... values) {
    (put(values), ...);
  }
  const std::string& text() const { return text_; }

 private:
  template <class T>
  void put(T& value) {
    if constexpr (std::is_enum_v<T> || std::is_same_v<T, bool>)
      fmt::format_to(std::back_inserter(text_), "{} ", static_cast<long long>(value));
    else if constexpr (std::is_arithmetic_v<T>)
      fmt::format_to(std::back_inserter(text_), "{} ", value);
    else
      archive(*this, value);
  }
  void put(std::string& words) { fmt::format_to(std::back_inserter(text_), "{} {} ", words.size(), words); }
  template <class T>
  void put(std::optional<T>& value) {
    bool is = value.has_value();
    put(is);
    if (is) put(*value);
  }
  template <class T, std::size_t n>
  void put(std::array<T, n>& values) {
    for (T& value : values) put(value);
  }
  template <class T>
  void put(std::vector<T>& values) {
    std::size_t size = values.size();
    put(size);
    for (T& value : values) put(value);
  }

  std::string text_;
};

/// Throws InputError, told with the note's name, where the text doesn't hold what is asked for.
class NoteReader {
 public:
  static constexpr bool reads = true;
  NoteReader(std::string name, std::string_view text) : name_(std::move(name)), text_(text) {}
  template <class... T>
  void operator()(T&... values) {
    (get(values), ...);
  }
  void end() const {
    if (!text_.empty()) refuse();
  }

 private:
  template <class T>
  void get(T& value) {
    if constexpr (std::is_enum_v<T> || std::is_same_v<T, bool>) {
      long long number = 0;
      get(number);
      value = static_cast<T>(number);
    } else if constexpr (std::is_arithmetic_v<T>) {
      const auto [end, error] = std::from_chars(text_.data(), text_.data() + text_.size(), value);
      if (error != std::errc()) refuse();
      skip(static_cast<std::size_t>(end - text_.data()));
    } else {
      archive(*this, value);
    }
  }
  void get(std::string& words) {
    const std::size_t size = length();
    words = text_.substr(0, size);
    skip(size);
  }
  template <class T>
  void get(std::optional<T>& value) {
    bool is = false;
    get(is);
    value.reset();
    if (is) get(value.emplace());
  }
  template <class T, std::size_t n>
  void get(std::array<T, n>& values) {
    for (T& value : values) get(value);
  }
  template <class T>
  void get(std::vector<T>& values) {
    values.resize(length());
    for (T& value : values) get(value);
  }
  /// Reads the number of entries that follow, which take a place each at least.
  std::size_t length() {
    std::size_t size = 0;
    get(size);
    if (size > text_.size()) refuse();
    return size;
  }
  /// Past `size` places and the blank behind them.
  void skip(std::size_t size) {
    if (size >= text_.size() || text_[size] != ' ') refuse();
    text_.remove_prefix(size + 1);
  }
  [[noreturn]] void refuse() const {
    throw InputError({name_, 0, 0}, "doesn't hold what is looked for", "",
                     "go on with the soilbin that wrote it, or remove it to start anew");
  }

  std::string name_;
  std::string_view text_;
};

}  // namespace soilbin::dem
