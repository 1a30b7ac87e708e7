// Classes made from the descriptions that the file formats use (scenario/description.hpp): a key of a case file and an
// attribute in Python have one name, one meaning, one range. Attributes are SI where files carry units.
#pragma once

#include <fmt/core.h>

#include <map>

#include "notebooks/bindings/bindings.hpp"
#include "scenario/description.hpp"
#include "scenario/errors.hpp"
#include "scenario/nearest_word.hpp"
#include "scenario/number_check.hpp"
#include "scenario/yes_no.hpp"

namespace soilbin::python {

/// "radius to the tread base [m], above 0 m"
std::string field_doc(const std::string& meaning, const Measure& measure);

/// What a number among a class's attributes measures, and whether it is a whole one.
struct Measured {
  Measure measure;
  bool whole = false;
};
using Measures = std::map<std::string, Measured>;

/// Throws InputError for a text that no file can hold: with control characters, or a name of several lines.
void check_text(const std::string& key, const std::string& text);

/// Adds an attribute for each key of T's description.
template <class T>
class FieldsOf {
 public:
  explicit FieldsOf(py::class_<T>& to) : to_(to) {}

  std::vector<std::string> required;
  Measures measures;  ///< of the numbers among them

  void text(const char* key, std::string T::*member, Need need, const char* meaning) {
    note(key, need);
    const std::string name = key;
    to_.def_property(
        key, [member](const T& self) { return self.*member; },
        [member, name](T& self, const std::string& text) {
          check_text(name, text);
          self.*member = text;
        },
        meaning);
  }
  void number(const char* key, double T::*member, const Measure& measure, Need need, const char* meaning) {
    checked<double>(key, member, measure, need, meaning, [](double x) { return std::optional(x); });
  }
  void number(const char* key, std::optional<double> T::*member, const Measure& measure, Need need,
              const char* meaning) {
    checked<std::optional<double>>(key, member, measure, need, meaning, [](auto x) { return x; });
  }
  void number(const char* key, Estimate T::*member, const Measure& measure, Need need, const char* meaning) {
    checked<Estimate>(key, member, measure, need, meaning, [](const Estimate& x) { return std::optional(x.value); });
  }
  void number(const char* key, std::optional<Estimate> T::*member, const Measure& measure, Need need,
              const char* meaning) {
    checked<std::optional<Estimate>>(key, member, measure, need, meaning,
                                     [](const auto& x) { return x ? std::optional(x->value) : std::nullopt; });
  }
  void exponent(const char* key, Estimate T::*member, const Range& range, Need need, const char* meaning) {
    number(key, member, Measure{"-", range}, need, meaning);
  }
  void assumed_sd(const char* key, std::optional<double> T::*member, const char* meaning) {
    number(key, member, Measure{"-", {.lower = 0.0}}, Need::optional, meaning);
  }
  template <class N>
  void integer(const char* key, N T::*member, int lowest, Need need, const char* meaning) {
    const Measure measure{"-", {.lower = static_cast<double>(lowest)}};
    checked<N>(key, member, measure, need, meaning, [](const N& x) {
      if constexpr (std::is_same_v<N, int>)
        return std::optional<double>(x);
      else
        return x ? std::optional<double>(*x) : std::nullopt;
    });
  }
  template <class E>
  void choice(const char* key, E T::*member, Need need, const char* meaning) {
    plain(key, member, need, meaning);
  }
  void choice(const char* key, YesNo T::*member, Need need, const char* meaning) {
    note(key, need);
    to_.def_property(
        key, [member](const T& self) { return self.*member == YesNo::yes; },
        [member](T& self, bool yes) { self.*member = yes ? YesNo::yes : YesNo::no; }, meaning);
  }
  template <class U>
  void group(const char* key, U T::*member, Need need, const char* meaning) {
    plain(key, member, need, meaning);
  }
  template <class U>
  void list(const char* key, std::vector<U> T::*member, Need need, const char* meaning) {
    plain(key, member, need, meaning);
  }
  void part(const char* key, std::optional<Soil> T::*member, Need need, const char* meaning) {
    plain(key, member, need, meaning);
  }

 private:
  template <class U>
  void plain(const char* key, U T::*member, Need need, const char* meaning) {
    note(key, need);
    to_.def_readwrite(key, member, meaning);
  }

  template <class U, class ValueOf>
  void checked(const char* key, U T::*member, const Measure& measure, Need need, const char* meaning,
               ValueOf value_of) {
    note(key, need);
    measures[key] = {measure, std::is_same_v<U, int> || std::is_same_v<U, std::optional<int>>};
    const std::string doc = field_doc(meaning, measure);
    to_.def_property(
        key, [member](const T& self) { return self.*member; },
        [=](T& self, const U& value) {
          if (const std::optional<double> number = value_of(value)) check_number(key, *number, measure);
          self.*member = value;
        },
        doc.c_str());
  }

  void note(const char* key, Need need) {
    if (need == Need::required) required.emplace_back(key);
  }

  py::class_<T>& to_;
};

/// What an attribute is set to: a quantity of pint as its number in SI, anything else as it is. Throws py::type_error
/// with the number to write for a text where a number is meant, and InputError for a quantity of the wrong dimension.
py::object in_si(const std::string& key, const py::object& value, const Measures& measures);

/// Sets one attribute. Raises AttributeError, with the nearest right word, for one that the class doesn't have, and
/// TypeError that says what is expected for a value of another kind.
void set_attribute(const py::object& self, const std::string& key, const py::object& value,
                   const std::vector<std::string>& known, const Measures& measures);

/// Raises TypeError, with the nearest right word, for a keyword that is no attribute of the class.
void check_keywords(py::handle type, const py::kwargs& given, const std::vector<std::string>& known);

/// Sets attributes of `self` from keyword arguments. Raises TypeError, with the nearest right word, for one that it
/// doesn't have.
void set_attributes(py::handle self, const py::kwargs& given, const std::vector<std::string>& known);

/// "Tire(radius=0.09, width=0.11)": what differs from a value made from nothing.
std::string described_text(py::handle self, py::handle plain, const std::vector<std::string>& keys);

/// The attributes of T's description, a constructor by keywords, replace() and a representation. `more`: attributes
/// beside the description's.
template <class T>
void described(py::class_<T>& to, const std::vector<std::string>& more = {}) {
  FieldsOf<T> fields(to);
  describe(fields, std::type_identity<T>{});
  std::vector<std::string> known = keys_of<T>();
  known.insert(known.end(), more.begin(), more.end());
  const auto fill = [known](T& value, const py::kwargs& given, bool is_new) {
    set_attributes(py::cast(&value, py::return_value_policy::reference), given, known);
    if (is_new) fill_in(value, [&](const char* key) { return given.contains(key); });
    if (const std::string wrong = contradiction(value); !wrong.empty()) throw InputError(wrong);
  };
  to.def(py::init([fill, known, required = fields.required](const py::kwargs& given) {
           check_keywords(py::type::of<T>(), given, known);  // a misspelt word before the one that it leaves missing
           for (const std::string& key : required)
             if (!given.contains(key.c_str())) throw py::type_error("missing keyword argument '" + key + "'");
           T value{};
           fill(value, given, true);
           return value;
         }),
         "By keywords: the attributes, in SI.");
  to.def(
      "replace",
      [fill](const T& self, const py::kwargs& given) {
        T value = self;
        fill(value, given, false);
        return value;
      },
      "A copy in which the attributes given are changed.");
  to.def("__setattr__",
         [known, measures = fields.measures](const py::object& self, const std::string& key, const py::object& value) {
           set_attribute(self, key, value, known, measures);
         });
  to.def("__copy__", [](const T& self) { return self; });
  to.def("__deepcopy__", [](const T& self, const py::dict&) { return self; });
  to.def("__repr__", [known](const py::object& self) {
    const T plain{};
    return described_text(self, py::cast(&plain, py::return_value_policy::reference), known);
  });
}

/// A class that is its description and nothing else.
template <class T>
void bind_described(py::module_& module, const char* name, const char* doc) {
  py::class_<T> bound(module, name, doc);
  described(bound);
}

/// An enum with the words that files use.
template <class E>
void bind_words(py::module_& module, const char* name, const char* doc) {
  py::enum_<E> bound(module, name, doc);
  for (const Word<E>& word : words_of(std::type_identity<E>{})) bound.value(std::string(word.text).c_str(), word.value);
}

}  // namespace soilbin::python
