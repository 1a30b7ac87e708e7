#include "compare/measured/campaign_schema.hpp"

#include "compare/measured/campaign.hpp"
#include "compare/measured/run_columns.hpp"
#include "scenario/schema.hpp"
#include "scenario/schema_visitor.hpp"

namespace soilbin::compare {
namespace {

using nlohmann::ordered_json;

ordered_json columns_schema() {
  std::vector<std::string> quantities;
  for (const RunColumn& column : run_columns()) quantities.push_back(column.quantity);
  ordered_json column = empty_object_schema();
  column["properties"] = {{"quantity", words_schema(quantities, "what the column holds")},
                          {"unit", text_schema("of the numbers in it, such as 'N'")}};
  column["required"] = {"quantity"};
  return {{"type", "object"}, {"additionalProperties", column}, {"description", "columns with names of their own"}};
}

}  // namespace

ordered_json campaign_schema(const EffectVocabulary& effects) {
  ordered_json campaign = object_schema<Campaign>();
  ordered_json wheel = named_or(object_schema<Tire>()), soil = soil_part_schema(object_schema<SemiEmpiricalSoil>());
  wheel["description"] = "the wheel that was tested";
  soil["description"] = "what plate and shear tests say: value and sd";
  campaign["properties"]["wheel"] = std::move(wheel), campaign["properties"]["soil"] = std::move(soil);
  for (const char* key : {"wheel", "soil"}) campaign["required"].push_back(key);
  ordered_json model = empty_object_schema();
  model["properties"]["effects"] = effects_schema(effects);
  campaign["properties"]["model"] = model;
  campaign["properties"]["columns"] = columns_schema();
  campaign["properties"]["ignored"] = {{"type", "array"},
                                       {"items", {{"type", "string"}}},
                                       {"description", "columns of the data file that are left aside"}};
  campaign["properties"]["format"] = {{"const", campaign_format}};
  campaign["required"].push_back("format");
  ordered_json schema = {{"$schema", "https://json-schema.org/draft/2020-12/schema"}, {"title", "A soilbin campaign"}};
  schema.update(campaign);
  return schema;
}

}  // namespace soilbin::compare
