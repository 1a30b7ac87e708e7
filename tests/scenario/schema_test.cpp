// The schema accepts what the reader accepts, in the shapes that a schema can tell.
#include "scenario/schema.hpp"

#include <gtest/gtest.h>

#include <regex>

#include "scenario/quantity.hpp"
#include "scenario/yaml_node.hpp"
#include "tests/scenario/fake_vocabulary.hpp"

namespace soilbin {
namespace {

using nlohmann::ordered_json;
using test::FakeVocabulary;

/// The part of draft 2020-12 that the schemas use.
bool valid(const ordered_json& schema, const ordered_json& value);

bool has_type(const std::string& type, const ordered_json& value) {
  if (type == "object") return value.is_object();
  if (type == "array") return value.is_array();
  if (type == "string") return value.is_string();
  if (type == "number") return value.is_number();
  if (type == "integer") return value.is_number_integer();
  return type == "boolean" && value.is_boolean();
}

bool type_matches(const ordered_json& type, const ordered_json& value) {
  if (type.is_string()) return has_type(type, value);
  for (const ordered_json& one : type)
    if (has_type(one, value)) return true;
  return false;
}

std::size_t matches(const ordered_json& schemas, const ordered_json& value) {
  std::size_t count = 0;
  for (const ordered_json& schema : schemas) count += valid(schema, value) ? 1 : 0;
  return count;
}

bool object_valid(const ordered_json& schema, const ordered_json& value) {
  for (const ordered_json& key : schema.value("required", ordered_json::array()))
    if (!value.contains(key.get<std::string>())) return false;
  for (const auto& [key, member] : value.items()) {
    const bool known = schema.contains("properties") && schema["properties"].contains(key);
    if (known && !valid(schema["properties"][key], member)) return false;
    if (!known && schema.contains("additionalProperties")) return false;
  }
  return true;
}

bool number_valid(const ordered_json& schema, double x) {
  return !(schema.contains("minimum") && x < schema["minimum"].get<double>()) &&
         !(schema.contains("maximum") && x > schema["maximum"].get<double>()) &&
         !(schema.contains("exclusiveMinimum") && x <= schema["exclusiveMinimum"].get<double>()) &&
         !(schema.contains("exclusiveMaximum") && x >= schema["exclusiveMaximum"].get<double>());
}

bool valid(const ordered_json& schema, const ordered_json& value) {
  if (schema.is_boolean()) return schema.get<bool>();
  if (schema.contains("type") && !type_matches(schema["type"], value)) return false;
  if (schema.contains("const") && schema["const"] != value) return false;
  if (schema.contains("enum") && std::find(schema["enum"].begin(), schema["enum"].end(), value) == schema["enum"].end())
    return false;
  if (schema.contains("anyOf") && matches(schema["anyOf"], value) == 0) return false;
  if (schema.contains("oneOf") && matches(schema["oneOf"], value) != 1) return false;
  if (schema.contains("not") && valid(schema["not"], value)) return false;
  if (schema.contains("pattern") && value.is_string() &&
      !std::regex_search(value.get<std::string>(), std::regex(schema["pattern"].get<std::string>())))
    return false;
  if (value.is_array() && schema.contains("minItems") && value.size() < schema["minItems"].get<std::size_t>())
    return false;
  if (value.is_array() && schema.contains("items"))
    for (const ordered_json& item : value)
      if (!valid(schema["items"], item)) return false;
  if (value.is_object() && !object_valid(schema, value)) return false;
  return !value.is_number() || number_valid(schema, value.get<double>());
}

/// A document as an editor's YAML reader sees it.
ordered_json as_json(const YamlNode& node) {
  ordered_json json;
  if (node.is_mapping()) json = ordered_json::object();
  if (node.is_sequence()) json = ordered_json::array();
  for (std::size_t i = 0; node.is_mapping() && i + 1 < node.items.size(); i += 2)
    json[node.items[i].scalar] = as_json(node.items[i + 1]);
  for (std::size_t i = 0; node.is_sequence() && i < node.items.size(); ++i) json.push_back(as_json(node.items[i]));
  if (!node.is_scalar()) return json;
  const std::optional<double> number = read_number(node.scalar);
  if (!number) return node.scalar;
  return *number == static_cast<int>(*number) ? ordered_json(static_cast<int>(*number)) : ordered_json(*number);
}

ordered_json file_as_json(const std::filesystem::path& path) {
  return as_json(parse_yaml(read_source_text(path, largest_yaml)));
}

TEST(Schema, EveryFileOfTheLibraryIsValid) {
  const Library library({SOILBIN_SOURCE_DIR "/cases"});
  for (const std::string& name : library.names(Shelf::tires))
    EXPECT_TRUE(valid(tire_schema(), file_as_json(*library.find(Shelf::tires, name)))) << name;
  for (const std::string& name : library.names(Shelf::soils))
    EXPECT_TRUE(valid(soil_schema(), file_as_json(*library.find(Shelf::soils, name)))) << name;
  for (const std::string& name : library.names(Shelf::studies))
    EXPECT_TRUE(valid(case_schema(FakeVocabulary()), file_as_json(*library.find(Shelf::studies, name)))) << name;
}

TEST(Schema, MistakesAreNot) {
  ordered_json tire = {{"format", "soilbin-tire/1"}, {"radius", "250 mm"}, {"width", "100 mm"}};
  EXPECT_TRUE(valid(tire_schema(), tire));
  for (const auto& [key, wrong] : std::vector<std::pair<std::string, ordered_json>>{
           {"raduis", "1 m"}, {"radius", 0.25}, {"radius", "0.25"}, {"format", "soilbin-soil/1"}, {"lugs", "none"}}) {
    ordered_json broken = tire;
    broken[key] = wrong;
    EXPECT_FALSE(valid(tire_schema(), broken)) << key << " " << wrong;
  }
  tire.erase("width");
  EXPECT_FALSE(valid(tire_schema(), tire)) << "a required key is missing";
}

TEST(Schema, AResolvedCaseIsValid) {
  const Library library({SOILBIN_SOURCE_DIR "/cases"});
  const FakeVocabulary effects;
  const Case c = read_case(*library.find(Shelf::studies, "rover-slip"), library, effects);
  const ordered_json resolved = as_json(parse_yaml(make_source_text(write_case(c, effects), "resolved.yaml")));
  EXPECT_TRUE(valid(case_schema(effects), resolved));
  ordered_json broken = resolved;
  broken["study"]["models"][1]["effects"][0]["id"] = "slip_sinkgae";
  EXPECT_FALSE(valid(case_schema(effects), broken));
  EXPECT_EQ(case_schema(effects)["$schema"], "https://json-schema.org/draft/2020-12/schema");
}

}  // namespace
}  // namespace soilbin
