// The visitor that turns a description into a JSON Schema of an object.
#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <type_traits>

#include "scenario/description.hpp"

namespace soilbin {

/// A number in text: '11 mm', or a bare number where the measure is a plain one.
nlohmann::ordered_json quantity_schema(const Measure& measure, const std::string& meaning);
/// Schema of a number, or of {value, source} and, where `with_deviation`, an sd.
nlohmann::ordered_json number_schema(const Measure& measure, const std::string& meaning, bool with_deviation);
nlohmann::ordered_json integer_schema(int lowest, const std::string& meaning);
nlohmann::ordered_json words_schema(const std::vector<std::string>& words, const std::string& meaning);
nlohmann::ordered_json text_schema(const std::string& meaning);
/// A tire or soil that a case names, or writes out.
nlohmann::ordered_json named_or(nlohmann::ordered_json inline_part);
/// A soil likewise, and of one with beds {from, density}.
nlohmann::ordered_json soil_part_schema(nlohmann::ordered_json inline_part);
/// A file of this format that holds an object.
nlohmann::ordered_json document_schema(const char* format, const char* title, nlohmann::ordered_json object);
/// An object with no other keys than those added to "properties".
nlohmann::ordered_json empty_object_schema();

template <class T>
nlohmann::ordered_json object_schema();

/// Collects properties and required keys of T.
template <class T>
class SchemaOf {
 public:
  nlohmann::ordered_json schema = empty_object_schema();

  void text(const char* key, std::string T::*, Need need, const char* meaning) { add(key, need, text_schema(meaning)); }

  void number(const char* key, double T::*, const Measure& measure, Need need, const char* meaning) {
    add(key, need, number_schema(measure, meaning, false));
  }

  void number(const char* key, std::optional<double> T::*, const Measure& measure, Need need, const char* meaning) {
    add(key, need, number_schema(measure, meaning, false));
  }

  void number(const char* key, Estimate T::*, const Measure& measure, Need need, const char* meaning) {
    add(key, need, number_schema(measure, meaning, true));
  }

  void number(const char* key, std::optional<Estimate> T::*, const Measure& measure, Need need, const char* meaning) {
    add(key, need, number_schema(measure, meaning, true));
  }

  void exponent(const char* key, Estimate T::*, const Range& range, Need need, const char* meaning) {
    add(key, need, number_schema(Measure{"-", range}, meaning, true));
  }

  void assumed_sd(const char* key, std::optional<double> T::*member, const char* meaning) {
    number(key, member, Measure{"-", {.lower = 0.0}}, Need::optional, meaning);
  }

  template <class N>
  void integer(const char* key, N T::*, int lowest, Need need, const char* meaning) {
    add(key, need, integer_schema(lowest, meaning));
  }

  template <class E>
  void choice(const char* key, E T::*, Need need, const char* meaning) {
    add(key, need, words_schema(all_words<E>(), meaning));
  }

  template <class U>
  void group(const char* key, U T::*, Need need, const char* meaning) {
    add_group<U>(key, need, meaning);
  }

  template <class U>
  void group(const char* key, std::optional<U> T::*, Need need, const char* meaning) {
    if constexpr (std::is_null_pointer_v<std::decay_t<decltype(rows_in_csv<U>)>>)
      add_group<U>(key, need, meaning);
    else
      add(key, need, {{"anyOf", {text_schema("path of a CSV"), object_schema<U>()}}, {"description", meaning}});
  }

  template <class U>
  void list(const char* key, std::vector<U> T::*, Need need, const char* meaning) {
    add(key, need, {{"type", "array"}, {"items", object_schema<U>()}, {"description", meaning}});
  }

  void part(const char* key, std::optional<Soil> T::*, Need need, const char* meaning) {
    nlohmann::ordered_json soil = soil_part_schema(object_schema<Soil>());
    soil["description"] = meaning;
    add(key, need, std::move(soil));
  }

 private:
  template <class U>
  void add_group(const char* key, Need need, const char* meaning) {
    nlohmann::ordered_json inner = object_schema<U>();
    inner["description"] = meaning;
    add(key, need, std::move(inner));
  }

  void add(const char* key, Need need, nlohmann::ordered_json property) {
    schema["properties"][key] = std::move(property);
    if (need == Need::required) schema["required"].push_back(key);
  }
};

template <class T>
nlohmann::ordered_json object_schema() {
  SchemaOf<T> visitor;
  describe(visitor, std::type_identity<T>{});
  return visitor.schema;
}

}  // namespace soilbin
