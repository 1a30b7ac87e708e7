// soilbin schema: the file formats as JSON Schema, for editors.
#include <memory>

#include "cli/commands.hpp"
#include "cli/flag_values.hpp"
#include "cli/outputs.hpp"
#include "compare/measured/campaign.hpp"
#include "compare/recorded/record.hpp"
#include "cone_index/vehicle.hpp"
#include "scenario/errors.hpp"
#include "scenario/nearest_word.hpp"
#include "scenario/schema.hpp"
#include "scenario/schema_visitor.hpp"

namespace soilbin::cli {
namespace {

int schema(const std::string& what, const Session& session) {
  if (what == "case")
    print_json(case_schema(session.place.effects));
  else if (what == "tire")
    print_json(tire_schema());
  else if (what == "soil")
    print_json(soil_schema());
  else if (what == "campaign")
    print_json(compare::campaign_schema(session.place.effects));
  else if (what == "vehicle")
    print_json(document_schema(cone_index::vehicle_format, "A soilbin vehicle", object_schema<cone_index::Vehicle>()));
  else if (what == "recorded")
    print_json(compare::record_schema());
  else
    throw InputError("no schema '" + clipped(what) + "'" +
                     did_you_mean(what, {"case", "tire", "soil", "campaign", "vehicle", "recorded"}) +
                     "\n  hint: one of case, tire, soil, campaign, vehicle, recorded");
  return done;
}

}  // namespace

void add_schema(CLI::App& app, Session& session) {
  CLI::App* command =
      app.add_subcommand("schema", "a file format as JSON Schema: case, tire, soil, campaign, vehicle, recorded");
  const auto what = std::make_shared<std::string>("case");
  add_value(*command, "format", *what, "FORMAT", "case (the default), tire, soil, campaign, vehicle or recorded");
  command->callback([=, &session] { session.action = [=, &session] { return schema(*what, session); }; });
}

}  // namespace soilbin::cli
