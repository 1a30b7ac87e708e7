// soilbin list: what the library holds, and the catalogue of effects.
#include <fmt/core.h>

#include <cmath>
#include <memory>

#include "bekker_wong/effect.hpp"
#include "bekker_wong/effects/provenance.hpp"
#include "cli/commands.hpp"
#include "cli/text_output.hpp"
#include "compare/report/result_json.hpp"
#include "scenario/errors.hpp"
#include "scenario/nearest_word.hpp"
#include "scenario/unit.hpp"

namespace soilbin::cli {
namespace {

using Json = nlohmann::ordered_json;

/// Rows of a listing: the table for people, the array for programs.
struct Listing {
  TextTable table;
  Json json = Json::array();
};

/// Reads an entry and adds its row; a file that can't be read is listed with its error.
template <class Add>
void add_entry(Listing& listing, const std::string& name, std::size_t columns, const Add& add) {
  try {
    add();
  } catch (const InputError& error) {
    const std::string what = error.what();
    std::vector<std::string> row = {name, "unreadable: " + what.substr(0, what.find('\n'))};
    row.resize(columns);
    listing.table.add(std::move(row));
    listing.json.push_back({{"name", name}, {"error", what}});
  }
}

Listing soils(const Workplace& place) {
  std::vector<std::string> header = {"soil"};
  for (const SoilParameter& p : bevameter_parameters) header.push_back(with_unit(p));
  header.emplace_back("source");
  Listing all{TextTable(header)};
  for (const std::string& name : place.library.names(Shelf::soils))
    add_entry(all, name, header.size(), [&] {
      const Soil soil = find_soil(name, place.library);
      std::vector<std::string> row = {name};
      Json entry = {{"name", name}};
      for (const SoilParameter& p : bevameter_parameters) {
        row.push_back(soil.semi_empirical ? number((*soil.semi_empirical).*p.value, p.per_si) : "-");
        if (soil.semi_empirical) entry[p.name] = ((*soil.semi_empirical).*p.value).value;
      }
      row.push_back(clipped(soil.source));
      all.table.add(std::move(row));
      if (!soil.semi_empirical) return;
      entry["granular"] = soil.granular.has_value(), entry["source"] = soil.source;
      all.json.push_back(std::move(entry));
    });
  return all;
}

Listing tires(const Workplace& place) {
  Listing all{TextTable({"tire", "radius [mm]", "width [mm]", "lugs", "source"})};
  for (const std::string& name : place.library.names(Shelf::tires))
    add_entry(all, name, 5, [&] {
      const Tire tire = find_tire(name, place.library);
      std::string lugs = "none";
      if (is_lugged(tire))
        lugs = fmt::format("{} of {} mm", tire.lugs.count ? std::to_string(*tire.lugs.count) : "some",
                           number(1000 * tire.lugs.height));
      all.table.add({name, number(1000 * tire.radius), number(1000 * tire.width), lugs, clipped(tire.source)});
      all.json.push_back({{"name", name},
                          {"radius", tire.radius},
                          {"width", tire.width},
                          {"lug_height", tire.lugs.height},
                          {"source", tire.source}});
    });
  return all;
}

Listing studies(const Workplace& place) {
  Listing all{TextTable({"study", "tire", "soil", "models", "conditions", "question"})};
  for (const std::string& name : place.library.names(Shelf::studies))
    add_entry(all, name, 6, [&] {
      const Case question = find_case(place, name);
      const bool drive_alone = question.study.conditions.empty();
      all.table.add({name, question.scenario.tire.name, question.scenario.soil.name,
                     drive_alone ? "drive" : std::to_string(question.study.models.size()),
                     drive_alone ? "-" : std::to_string(question.study.conditions.size()), question.description});
      all.json.push_back({{"name", name},
                          {"tire", question.scenario.tire.name},
                          {"soil", question.scenario.soil.name},
                          {"models", question.study.models.size()},
                          {"conditions", question.study.conditions.size()},
                          {"drive", question.drive.has_value()},
                          {"description", question.description}});
    });
  return all;
}

Listing campaigns(const Workplace& place) {
  Listing all{TextTable({"campaign", "runs", "measured"})};
  for (const std::string& name : place.library.names(Shelf::measured))
    add_entry(all, name, 3, [&] {
      const compare::Campaign campaign = find_campaign(place, name);
      std::vector<std::string> channels;
      for (const compare::ChannelView& channel : compare::channel_views)
        for (const compare::Run& run : campaign.runs)
          if (run.*channel.measured) {
            channels.emplace_back(channel.title);
            break;
          }
      all.table.add({name, std::to_string(campaign.runs.size()), listed(channels)});
      all.json.push_back({{"name", name}, {"runs", campaign.runs.size()}, {"channels", channels}});
    });
  return all;
}

Json effect_json(const bekker_wong::EffectForm& form) {
  Json parameters = Json::array();
  for (const bekker_wong::EffectParameter& p : form.parameters)
    parameters.push_back({{"name", p.name},
                          {"unit", p.unit},
                          {"default", p.fallback},
                          {"lower", p.lower},
                          {"upper", p.upper},
                          {"meaning", p.meaning}});
  Json presumes = Json::array();
  for (const bekker_wong::Presumption& p : form.presumes) presumes.push_back({{"key", p.key}, {"value", p.rule}});
  return {{"id", form.id},
          {"form", form.form},
          {"equation", form.equation},
          {"source", form.source},
          {"provenance", in_words(provenance_of(form))},
          {"of", form.measurement ? "measurement" : "wheel"},
          {"parameters", parameters},
          {"presumes", presumes}};
}

/// A value of a parameter in its own unit; units that need the soil's exponent are left in SI.
std::string in_unit(double value, const std::string& unit) {
  if (!std::isfinite(value)) return value < 0 ? "-inf" : "inf";
  try {
    return write_quantity(value, unit);
  } catch (const InputError&) {
    return fmt::format("{:.6g} (SI)", value);
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
      fmt::print("      presumes {} = {} where the tire declares none\n", p.key, p.rule);
  }
  if (json) fmt::print("{}", compare::json_text({{"format", "soilbin-list/1"}, {"effects", all}}));
  return done;
}

int list(const std::string& what, bool json, const Session& session) {
  static const std::vector<std::pair<std::string, Listing (*)(const Workplace&)>> shelves = {
      {"soils", soils}, {"tires", tires}, {"studies", studies}, {"measured", campaigns}};
  if (what == "effects") return print_effects(json);
  std::vector<std::string> right = {"effects"};
  for (const auto& [name, make] : shelves) {
    right.push_back(name);
    if (name != what) continue;
    const Listing listing = make(session.place);
    if (json)
      fmt::print("{}", compare::json_text({{"format", "soilbin-list/1"}, {name, listing.json}}));
    else
      fmt::print("{}", listing.table.text());
    return done;
  }
  throw InputError("can't list '" + clipped(what) + "'" + did_you_mean(what, right) + "\n  hint: one of " +
                   listed(right));
}

}  // namespace

void add_list(CLI::App& app, Session& session) {
  CLI::App* command = app.add_subcommand("list", "what there is: soils, tires, effects, studies, measured");
  const auto what = std::make_shared<std::string>();
  const auto json = std::make_shared<bool>(false);
  command->add_option("what", *what, "soils, tires, effects, studies or measured")->type_name("WHAT")->required();
  command->add_flag("--json", *json, "as JSON, in SI");
  command->callback([=, &session] { session.action = [=, &session] { return list(*what, *json, session); }; });
}

}  // namespace soilbin::cli
