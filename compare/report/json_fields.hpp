// Members of a struct as JSON, said once: a function `fields(visitor, value)` names each key with its member, and the
// visitors here write it, read it back and make its JSON Schema. SI throughout; a number that is not finite is null.
//
// A visitor offers number, whole, flag, text, numbers, group (an object of its own), added_group (the same, which files
// written before it was thought of lack) and list (objects of one kind).
#pragma once

#include <cmath>
#include <functional>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "scenario/errors.hpp"
#include "scenario/estimate.hpp"

namespace soilbin::compare {

using Json = nlohmann::ordered_json;

/// SI, as null where it is not finite.
inline Json finite(double value) { return std::isfinite(value) ? Json(value) : Json(nullptr); }

inline Json or_null(const std::optional<double>& value) { return value ? Json(*value) : Json(nullptr); }

inline Json estimate_json(const Estimate& estimate) {
  return {{"value", finite(estimate.value)}, {"std_error", finite(estimate.std_error)}};
}

inline Json or_null(const std::optional<Estimate>& estimate) {
  return estimate ? estimate_json(*estimate) : Json(nullptr);
}

/// A list with what `make` gives of each value, in their order.
template <class Values, class Make>
Json list_of(const Values& values, const Make& make) {
  Json list = Json::array();
  for (const auto& value : values) list.push_back(std::invoke(make, value));
  return list;
}

/// The text of a document: indented, and never an exception for bytes that are not UTF-8.
inline std::string json_text(const Json& document) {
  return document.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

class WriteJson {
 public:
  explicit WriteJson(Json& to) : to_(to) {}

  void number(std::string_view key, double value, const char*, const char*) { to_[std::string(key)] = finite(value); }
  void whole(std::string_view key, auto value, const char*) { to_[std::string(key)] = value; }
  void flag(std::string_view key, bool value, const char*) { to_[std::string(key)] = value; }
  void text(std::string_view key, const std::string& value, const char*) { to_[std::string(key)] = value; }
  void numbers(std::string_view key, const std::vector<double>& values, const char*, const char*) {
    to_[std::string(key)] = list_of(values, finite);
  }
  void group(std::string_view key, const char*, const auto& members) {
    WriteJson inner(to_[std::string(key)] = Json::object());
    members(inner);
  }
  void added_group(std::string_view key, const char* meaning, const auto& members) { group(key, meaning, members); }
  template <class T, class Members>
  void list(std::string_view key, const std::vector<T>& values, const char*, const Members& members) {
    Json& all = to_[std::string(key)] = Json::array();
    for (const T& value : values) {
      WriteJson inner(all.emplace_back(Json::object()));
      members(inner, value);
    }
  }

 private:
  Json& to_;
};

/// Every key that is named must be there, but for an added_group, which then stays as it is. Throws InputError that
/// names the place: "file.json: runs[3].torque: ...".
class ReadJson {
 public:
  ReadJson(const Json& from, std::string place) : from_(from), place_(std::move(place)) {
    if (!from_.is_object()) throw InputError(place_ + ": expected an object");
  }

  void number(std::string_view key, double& value, const char*, const char*) { value = as_number(at(key), below(key)); }
  template <class N>
  void whole(std::string_view key, N& value, const char*) {
    const Json& found = at(key);
    if (!found.is_number_unsigned()) refuse(below(key), "a whole number");
    value = found.get<N>();
  }
  void flag(std::string_view key, bool& value, const char*) {
    if (!at(key).is_boolean()) refuse(below(key), "true or false");
    value = at(key).get<bool>();
  }
  void text(std::string_view key, std::string& value, const char*) {
    if (!at(key).is_string()) refuse(below(key), "a text");
    value = at(key).get<std::string>();
  }
  void numbers(std::string_view key, std::vector<double>& values, const char*, const char*) {
    if (!at(key).is_array()) refuse(below(key), "a list of numbers");
    values.clear();
    for (const Json& value : at(key)) values.push_back(as_number(value, below(key)));
  }
  void group(std::string_view key, const char*, const auto& members) {
    ReadJson inner(at(key), below(key));
    members(inner);
  }
  void added_group(std::string_view key, const char* meaning, const auto& members) {
    if (has(key)) group(key, meaning, members);
  }
  template <class T, class Members>
  void list(std::string_view key, std::vector<T>& values, const char*, const Members& members) {
    if (!at(key).is_array()) refuse(below(key), "a list");
    values.clear();
    for (const Json& value : at(key)) {
      ReadJson inner(value, below(key) + "[" + std::to_string(values.size()) + "]");
      members(inner, values.emplace_back());
    }
  }

  bool has(std::string_view key) const { return from_.contains(std::string(key)); }
  const Json& at(std::string_view key) const {
    const auto found = from_.find(std::string(key));
    if (found == from_.end()) throw InputError(below(key) + " is missing");
    return *found;
  }
  std::string below(std::string_view key) const {
    return place_ + (place_.ends_with(": ") ? "" : ".") + std::string(key);
  }

  [[noreturn]] static void refuse(const std::string& place, const std::string& expected) {
    throw InputError(place + ": expected " + expected);
  }

 private:
  static double as_number(const Json& value, const std::string& place) {
    if (value.is_null()) return not_a_number;
    if (!value.is_number()) refuse(place, "a number, or null");
    return value.get<double>();
  }

  const Json& from_;
  std::string place_;
};

/// JSON Schema of an object; every key named is required, but for an added_group.
class FieldsSchema {
 public:
  Json schema = {{"type", "object"}, {"properties", Json::object()}, {"required", Json::array()}};

  void number(std::string_view key, double, const char* unit, const char* meaning) {
    add(key, {{"type", {"number", "null"}}}, in_words(unit, meaning));
  }
  template <class N>
  void whole(std::string_view key, N, const char* meaning) {
    add(key, {{"type", "integer"}, {"minimum", 0}}, meaning);
  }
  void flag(std::string_view key, bool, const char* meaning) { add(key, {{"type", "boolean"}}, meaning); }
  void text(std::string_view key, const std::string&, const char* meaning) { add(key, {{"type", "string"}}, meaning); }
  void numbers(std::string_view key, const std::vector<double>&, const char* unit, const char* meaning) {
    add(key, {{"type", "array"}, {"items", {{"type", {"number", "null"}}}}}, in_words(unit, meaning));
  }
  void group(std::string_view key, const char* meaning, const auto& members) {
    FieldsSchema inner;
    members(inner);
    add(key, std::move(inner.schema), meaning);
  }
  void added_group(std::string_view key, const char* meaning, const auto& members) {
    group(key, meaning, members);
    schema["required"].erase(schema["required"].size() - 1);
  }
  template <class T, class Members>
  void list(std::string_view key, const std::vector<T>&, const char* meaning, const Members& members) {
    FieldsSchema inner;
    T value{};
    members(inner, value);
    add(key, {{"type", "array"}, {"items", std::move(inner.schema)}}, meaning);
  }
  void add(std::string_view key, Json property, const std::string& meaning) {
    property["description"] = meaning;
    schema["properties"][std::string(key)] = std::move(property);
    schema["required"].push_back(std::string(key));
  }

 private:
  static std::string in_words(const char* unit, const char* meaning) {
    return std::string(meaning) + " [" + unit + "]";
  }
};

}  // namespace soilbin::compare
