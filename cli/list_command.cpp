// soilbin list: what the library holds, and the catalogue of effects.
#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <memory>

#include "bekker_wong/effect.hpp"
#include "bekker_wong/effects/provenance.hpp"
#include "cli/commands.hpp"
#include "cli/flag_values.hpp"
#include "cli/outputs.hpp"
#include "compare/measured/campaign.hpp"
#include "compare/report/json_fields.hpp"
#include "compare/vehicle/vehicle.hpp"
#include "scenario/contents.hpp"
#include "scenario/errors.hpp"
#include "scenario/nearest_word.hpp"

namespace soilbin::cli {
namespace {

using Json = nlohmann::ordered_json;

/// Rows of a listing: the table for people, the array for programs.
struct Listing {
  Table table;
  Json json = Json::array();
};

/// What a shelf holds of a name: cells of the table between the name and what it is, keys beside "name".
struct ShelfRow {
  std::vector<TableCell> cells;
  Json json;
  std::string question = {};  ///< what it is, in its own file's words
};

/// A shelf as `soilbin list` shows it.
struct ShelfView {
  Shelf shelf;
  std::string title;                 ///< over its names in the list of all shelves
  std::vector<std::string> columns;  ///< of `row`
  ShelfRow (*row)(const std::string& name, const Workplace& place);
  std::string note = {};  ///< below the table
};

ShelfRow soil_row(const std::string& name, const Workplace& place) {
  const Soil soil = find_soil(name, place.library);
  ShelfRow row;
  for (const SoilParameter& p : bevameter_parameters) {
    if (!soil.semi_empirical) {
      row.cells.emplace_back("-");
      continue;
    }
    const Estimate& value = (*soil.semi_empirical).*p.value;
    row.cells.push_back(number(value, p.per_si) + (has_assumed_sd(*soil.semi_empirical, value) ? "*" : ""));
    row.json[p.name] = value.value;
  }
  row.cells.emplace_back(soil.granular ? "yes" : "no");
  row.json["granular"] = soil.granular.has_value(), row.json["source"] = soil.source;
  return row;
}

ShelfRow tire_row(const std::string& name, const Workplace& place) {
  const Tire tire = find_tire(name, place.library);
  std::string lugs = "none";
  if (is_lugged(tire))
    lugs = fmt::format("{} of {} mm", tire.lugs.count ? std::to_string(*tire.lugs.count) : "some",
                       number(1000 * tire.lugs.height));
  ShelfRow row{{number(1000 * tire.radius), number(1000 * tire.width), lugs,
                tire.inflation_pressure ? number(*tire.inflation_pressure / 1000) : "-"},
               {{"radius", tire.radius}, {"width", tire.width}, {"lug_height", tire.lugs.height}}};
  if (tire.lugs.count) row.json["lug_count"] = *tire.lugs.count;
  if (tire.inflation_pressure) row.json["inflation_pressure"] = *tire.inflation_pressure;
  row.json["source"] = tire.source;
  return row;
}

ShelfRow study_row(const std::string& name, const Workplace& place) {
  const Case question = find_case(place, name);
  const bool drive_only = question.study.conditions.empty();
  return {{question.scenario.tire.name, question.scenario.soil.name,
           drive_only ? "drive" : std::to_string(question.study.models.size()),
           drive_only ? "-" : std::to_string(question.study.conditions.size())},
          {{"tire", question.scenario.tire.name},
           {"soil", question.scenario.soil.name},
           {"models", question.study.models.size()},
           {"conditions", question.study.conditions.size()},
           {"drive", question.drive.has_value()}},
          question.description};
}

ShelfRow campaign_row(const std::string& name, const Workplace& place) {
  const compare::Campaign campaign = find_campaign(place, name);
  std::vector<std::string> channels;
  for (const compare::ChannelView& channel : compare::channel_views)
    for (const compare::Run& run : campaign.runs)
      if (run.*channel.measured) {
        channels.emplace_back(channel.title);
        break;
      }
  return {{std::to_string(campaign.runs.size()), listed(channels)},
          {{"runs", campaign.runs.size()}, {"channels", channels}}};
}

ShelfRow vehicle_row(const std::string& name, const Workplace& place) {
  const compare::VehicleCase vehicle = compare::find_vehicle_case(name, place.library, place.effects);
  std::vector<std::string> tires;
  for (const compare::VehicleAxle& axle : vehicle.axles)
    if (std::ranges::find(tires, axle.tire.name) == tires.end()) tires.push_back(axle.tire.name);
  return {{number(vehicle.mass), std::to_string(vehicle.axles.size()), listed(tires), vehicle.soil.name},
          {{"mass", vehicle.mass},
           {"axles", vehicle.axles.size()},
           {"tires", tires},
           {"soil", vehicle.soil.name},
           {"source", vehicle.source}}};
}

const std::vector<ShelfView>& shelf_views() {
  static const std::vector<ShelfView> views = [] {
    std::vector<std::string> soil_columns;
    for (const SoilParameter& p : bevameter_parameters) soil_columns.push_back(compare::heading(p.symbol, p.unit));
    soil_columns.emplace_back("grains");
    return std::vector<ShelfView>{
        {Shelf::soils, "Soils", soil_columns, soil_row,
         "\n*: an assumed standard deviation; the source of the value gives none\n"},
        {Shelf::tires, "Tires and wheels", {"radius [mm]", "width [mm]", "lugs", "pressure [kPa]"}, tire_row},
        {Shelf::vehicles, "Vehicles", {"mass [kg]", "axles", "tires", "soil"}, vehicle_row},
        {Shelf::studies, "Studies", {"tire", "soil", "models", "conditions"}, study_row},
        {Shelf::measured, "Measured campaigns", {"runs", "measured"}, campaign_row}};
  }();
  return views;
}

/// Adds the row of a name; a file that can't be read is listed with its error.
void add_row(Listing& listing, const ShelfView& view, const std::string& section, const ContentsLine& line,
             const Workplace& place) {
  try {
    ShelfRow row = view.row(line.name, place);
    const std::string meaning = line.meaning.empty() ? row.question : line.meaning;
    row.cells.insert(row.cells.begin(), line.name);
    row.cells.push_back(meaning);
    listing.table.add(std::move(row.cells));
    Json entry = {{"name", line.name}};
    entry.update(row.json);
    entry["section"] = section, entry["description"] = meaning;
    listing.json.push_back(std::move(entry));
  } catch (const InputError& error) {
    const std::string what = error.what();
    std::vector<TableCell> cells = {line.name, "unreadable: " + what.substr(0, what.find('\n'))};
    cells.resize(view.columns.size() + 2);
    listing.table.add(std::move(cells));
    listing.json.push_back({{"name", line.name}, {"error", what}});
  }
}

Listing listing_of(const ShelfView& view, const Workplace& place) {
  std::vector<std::string> header = view.columns;
  header.insert(header.begin(), "name");
  header.emplace_back("what it is");
  Listing listing{Table{"", header}};
  for (const ContentsSection& section : contents_of(place.folders, view.shelf)) {
    listing.table.add({section.title});
    for (const ContentsLine& line : section.lines) add_row(listing, view, section.title, line, place);
  }
  return listing;
}

/// Every name of every shelf, with a line on what it is.
int print_shelves(bool json, const Workplace& place) {
  Json document = {{"format", "soilbin-list/1"}};
  std::string text;
  for (const ShelfView& view : shelf_views()) {
    Table table{"", {"", "", ""}};
    Json names = Json::array();
    for (const ContentsSection& section : contents_of(place.folders, view.shelf)) {
      table.add({"  " + section.title});
      for (const ContentsLine& line : section.lines) {
        const std::string meaning = line.meaning.empty() ? view.row(line.name, place).question : line.meaning;
        table.add({"  ", line.name, meaning});
        names.push_back({{"name", line.name}, {"section", section.title}, {"description", meaning}});
      }
    }
    const std::string folder(folder_of(view.shelf));
    text += fmt::format("{}{} (soilbin list {}){}", text.empty() ? "" : "\n", view.title, folder, as_text(table));
    document[folder] = std::move(names);
  }
  text += fmt::format("\nEffects: {} variants (soilbin list effects)\n", bekker_wong::effect_catalogue().size());
  fmt::print("{}", json ? compare::json_text(document) : text);
  return done;
}

Json effect_json(const bekker_wong::EffectForm& form) {
  const Json parameters = compare::list_of(form.parameters, [](const bekker_wong::EffectParameter& p) {
    return Json{{"name", p.name},   {"unit", p.unit},   {"default", p.fallback},
                {"lower", p.lower}, {"upper", p.upper}, {"meaning", p.meaning}};
  });
  const Json presumes = compare::list_of(form.presumes, [](const bekker_wong::Presumption& p) {
    return Json{{"key", p.key}, {"value", p.rule}};
  });
  return {{"id", form.id},
          {"form", form.form},
          {"equation", form.equation},
          {"source", form.source},
          {"provenance", in_words(provenance_of(form))},
          {"of", form.measurement ? "measurement" : "wheel"},
          {"parameters", parameters},
          {"presumes", presumes},
          {"sinkage_from_rut_floor", form.sinkage_from_rut_floor}};
}

/// A value of a parameter in its own unit, as people read it; units that need the soil's exponent are left in SI.
std::string in_unit(double value, const std::string& unit) {
  if (!std::isfinite(value)) return value < 0 ? "-inf" : "inf";
  try {
    return fmt::format("{:.4g}{}", value * compare::per_unit(unit), compare::unit_behind(unit));
  } catch (const InputError&) {
    return fmt::format("{:.4g} (SI)", value);
  }
}

int print_effects(bool json) {
  Json all = Json::array();
  std::string id;
  for (const bekker_wong::EffectForm& form : bekker_wong::effect_catalogue()) {
    if (json) {
      all.push_back(effect_json(form));
      continue;
    }
    if (form.id != id)
      fmt::print("{}{}{}\n", id.empty() ? "" : "\n", form.id, form.measurement ? "  (of the measurement)" : "");
    id = form.id;
    fmt::print("  {}\n      {}\n      {}\n", form.form, form.equation, form.source);
    for (const bekker_wong::EffectParameter& p : form.parameters)
      fmt::print("      {} = {}, from {} to {}: {}\n", p.name, in_unit(p.fallback, p.unit), in_unit(p.lower, p.unit),
                 in_unit(p.upper, p.unit), p.meaning);
    for (const bekker_wong::Presumption& p : form.presumes)
      fmt::print("      assumes {} = {} if the tire declares none\n", p.key, p.rule);
  }
  if (json) print_json({{"format", "soilbin-list/1"}, {"effects", all}});
  return done;
}

int list(const std::string& what, bool json, bool names, const Session& session) {
  if (names && json) throw InputError("--names and --json exclude each other");
  if (names && (what.empty() || what == "effects"))
    throw InputError("--names lists one shelf\n  hint: soilbin list soils --names");
  if (what.empty()) return print_shelves(json, session.place);
  if (what == "effects") return print_effects(json);
  std::vector<std::string> right = {"effects"};
  for (const ShelfView& view : shelf_views()) {
    const std::string name(folder_of(view.shelf));
    right.push_back(name);
    if (name != what) continue;
    if (names) {
      for (const std::string& one : session.place.library.names(view.shelf)) fmt::print("{}\n", one);
      return done;
    }
    const Listing listing = listing_of(view, session.place);
    if (json)
      print_json({{"format", "soilbin-list/1"}, {name, listing.json}});
    else
      fmt::print("{}{}", as_text(listing.table), view.note);
    return done;
  }
  for (const ShelfView& view : shelf_views())
    if (const auto file = session.place.library.find(view.shelf, what))
      throw InputError(fmt::format("'{0}' is in the list of {1}\n  hint: soilbin list {1}; the whole of it: {2}", what,
                                   folder_of(view.shelf), file->string()));
  throw InputError("can't list '" + clipped(what) + "'" + did_you_mean(what, right) + "\n  hint: one of " +
                   listed(right));
}

}  // namespace

void add_list(CLI::App& app, Session& session) {
  CLI::App* command = app.add_subcommand("list", "what there is: soils, tires, vehicles, effects, studies, measured");
  const auto what = std::make_shared<std::string>();
  const auto json = std::make_shared<bool>(false);
  add_value(*command, "what", *what, "WHAT",
            "soils, tires, vehicles, effects, studies or measured; without it: every name, with a line on what it is");
  command->add_flag("--json", *json, "as JSON, in SI");
  const auto names = std::make_shared<bool>(false);
  command->add_flag("--names", *names, "the names of a shelf alone, a line each");
  command->callback([=, &session] { session.action = [=, &session] { return list(*what, *json, *names, session); }; });
}

}  // namespace soilbin::cli
