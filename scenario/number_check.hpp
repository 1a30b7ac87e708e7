// Whether the numbers of a struct made in code, which no reader has checked, are those that a file may hold.
//
//   check_numbers(OperatingCondition{.load = 80, .slip = 12});  // InputError: slip: 12 is out of range, ...
#pragma once

#include <cmath>
#include <string>
#include <type_traits>

#include "scenario/description.hpp"
#include "scenario/errors.hpp"

namespace soilbin {

/// The SI unit of a value that files write in this one: "mm" -> "m", "%" -> "-".
std::string si_unit_of(const std::string& unit);

/// Throws InputError that names the key where the value [SI] is out of the measure's range or not finite.
void check_number(const char* key, double value, const Measure& measure);

namespace number_check_detail {

template <class T>
struct Visitor {
  const T& of;

  void number(const char* key, auto member, const Measure& measure, Need, const char*) const {
    each(of.*member, [&](double value) { check_number(key, value, measure); });
  }
  void exponent(const char* key, auto member, const Range& range, Need, const char*) const {
    check_number(key, (of.*member).value, {"-", range});
  }
  void integer(const char* key, auto member, int lowest, Need, const char*) const {
    each(of.*member, [&](int value) { check_number(key, value, {"-", {.lower = static_cast<double>(lowest)}}); });
  }
  void group(const char*, auto member, Need, const char*) const;
  void list(const char*, auto member, Need, const char*) const;
  void text(const auto&...) const {}
  void assumed_sd(const auto&...) const {}
  void choice(const auto&...) const {}
  void part(const auto&...) const {}

  static void each(const auto& value, const auto& on) {
    if constexpr (requires { value.std_error; })
      on(value.value);
    else if constexpr (requires { value.has_value(); }) {
      if (value) each(*value, on);
    } else
      on(value);
  }
};

}  // namespace number_check_detail

/// Throws InputError that names the first number of `of`, or of what it holds, that lies outside its description's
/// range or is none; and where its members can't stand together (contradiction).
template <class T>
void check_numbers(const T& of) {
  const number_check_detail::Visitor<T> visitor{of};
  describe(visitor, std::type_identity<T>{});
  if (const std::string wrong = contradiction(of); !wrong.empty()) throw InputError(wrong);
}

template <class T>
void number_check_detail::Visitor<T>::group(const char*, auto member, Need, const char*) const {
  each(of.*member, [](const auto& part) { check_numbers(part); });
}

template <class T>
void number_check_detail::Visitor<T>::list(const char*, auto member, Need, const char*) const {
  for (const auto& one : of.*member) check_numbers(one);
}

}  // namespace soilbin
