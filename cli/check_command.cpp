// soilbin check: is this file valid, and does it make physical sense?
#include <fmt/core.h>

#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>

#include "cli/commands.hpp"
#include "cli/flag_values.hpp"
#include "cli/outputs.hpp"
#include "compare/calibrate/experiment_store.hpp"
#include "compare/doubts/doubts.hpp"
#include "compare/doubts/grain_doubts.hpp"
#include "compare/recorded/step_pair.hpp"
#include "compare/sweep/varying.hpp"
#include "compare/vehicle/vehicle_doubts.hpp"
#include "cone_index/vehicle.hpp"
#include "scenario/mapping_reader.hpp"
#include "scenario/nearest_word.hpp"
#include "scenario/scm_soil.hpp"
#include "scenario/yaml_node.hpp"

namespace soilbin::cli {
namespace {

namespace fs = std::filesystem;

/// What a file turned out to be, and what is doubtful in it.
struct CheckedFile {
  std::string what;
  compare::Doubts doubts;
};

/// A name of any shelf, a file, or a campaign's folder.
fs::path file_named(const std::string& name, const Workplace& place) {
  std::error_code error;
  if (name.find('/') == std::string::npos && !name.ends_with(".yaml")) {
    std::vector<std::string> names;
    for (const Shelf shelf : all_shelves) {
      if (const auto file = place.library.find(shelf, name)) return *file;
      for (std::string& known : place.library.names(shelf)) names.push_back(std::move(known));
    }
    if (!fs::exists(name, error))
      throw InputError("no file and nothing in the library is called '" + clipped(name) + "'" +
                       did_you_mean_name(name, names));
  }
  return compare::campaign_file(name);
}

CheckedFile checked_soil(const Soil& soil) {
  compare::Doubts doubts = compare::doubts(soil);
  if (soil.granular) append(doubts, compare::grain_value_doubts(*soil.granular));
  return {fmt::format("soil '{}'", soil.name), doubts};
}

/// A key that files of one format alone have at their top.
struct TellingKey {
  const char *key, *format;
};
constexpr TellingKey telling_keys[] = {{"data", compare::campaign_format},
                                       {"columns", compare::campaign_format},
                                       {"wheel", compare::campaign_format},
                                       {"study", case_format},
                                       {"drive", case_format},
                                       {"tire", case_format},
                                       {"radius", tire_format},
                                       {"semi_empirical", soil_format},
                                       {"granular", soil_format},
                                       {"resistive_force", soil_format},
                                       {"beds", soil_format},
                                       {"cone_index", soil_format},
                                       {"cone_index_gradient", soil_format},
                                       {"clearance", cone_index::vehicle_format},
                                       {"tire_width", cone_index::vehicle_format},
                                       {"axles", compare::vehicle_case_format}};

/// Throws InputError for a file that does not say its format, with the one that its name and keys tell.
void refuse_without_format(const fs::path& file) {
  const SourceText source = read_source_text(file, largest_yaml);
  const YamlNode document = parse_yaml(source);
  if (!document.is_mapping() || document.find("format")) return;
  std::string format = file.filename() == "campaign.yaml" ? compare::campaign_format : "";
  for (const TellingKey& telling : telling_keys)
    if (format.empty() && document.find(telling.key)) format = telling.format;
  if (format.empty())
    source.refuse(
        0, "key 'format' is missing",
        "its first line, one of format: " + listed({case_format, compare::campaign_format, tire_format, soil_format,
                                                    compare::vehicle_case_format, cone_index::vehicle_format}));
  expect_format(document, format, Reading{&source, std::nullopt, nullptr, ""});
}

CheckedFile judge(const fs::path& file, const Workplace& place) {
  if (file.extension() == ".json") {
    if (is_scm_soil(file)) return checked_soil(read_soil(file));
    if (compare::is_experiment_store(file)) {
      const compare::ExperimentStore store(file);
      return {"store of " + compare::counted(store.size(), "experiment"), {}};
    }
    const compare::Record record = compare::read_record(file);
    return {"record: " + compare::counted(record.runs.size(), "run") + " of the model " + record.model,
            compare::step_doubts(record)};
  }
  const bool rows = (file.extension() == ".csv" || file.extension() == ".CSV");  // refused with a hint at the campaign
  const std::string format = rows ? compare::campaign_format : format_of(file);
  if (format.empty()) refuse_without_format(file);
  if (format == compare::campaign_format) {
    const compare::Campaign campaign = compare::read_campaign(file, place.library, place.effects);
    return {fmt::format("campaign '{}': {} of {}", campaign.name, compare::counted(campaign.runs.size(), "run"),
                        in_words(campaign.wheel)),
            compare::doubts(campaign)};
  }
  if (format == tire_format) {
    const Tire tire = read_tire(file);
    return {fmt::format("tire {}", in_words(tire)), compare::doubts(tire)};
  }
  if (format == soil_format) return checked_soil(read_soil(file));
  if (format == cone_index::vehicle_format) {
    const cone_index::Vehicle vehicle = cone_index::parse_vehicle(read_source_text(file, largest_yaml));
    cone_index::vehicle_cone_index(vehicle);  // refuses what no vehicle can be
    return {fmt::format("vehicle '{}'", vehicle.name.empty() ? file.stem().string() : vehicle.name), {}};
  }
  if (format == compare::vehicle_case_format) {
    const compare::VehicleCase vehicle =
        compare::parse_vehicle_case(read_source_text(file, largest_yaml), place.library, place.effects);
    compare::Doubts doubts = compare::doubts(vehicle);
    append(doubts, compare::doubts(vehicle.soil));
    for (const compare::VehicleAxle& axle : vehicle.axles) append(doubts, compare::doubts(axle.tire));
    return {fmt::format("vehicle '{}': {} on {}", vehicle.name, compare::counted(vehicle.axles.size(), "axle"),
                        compare::in_words(vehicle.soil)),
            once_each(doubts)};
  }
  const Case question =
      read_case(file, place.library, place.effects);  // refuses any other format with the nearest word
  std::string asks;
  if (!question.study.conditions.empty())
    asks = compare::counted(question.study.models.size(), "model") + " at " +
           compare::counted(question.study.conditions.size(), "condition");
  if (question.drive) asks += (asks.empty() ? "" : ", ") + std::string("a drive");
  return {fmt::format("case '{}': {} on {}, {}", question.name, in_words(question.scenario.tire),
                      compare::in_words(question.scenario.soil), asks),
          compare::doubts(question)};
}

int check(const std::string& name, bool json, const Session& session) {
  const CheckedFile checked = judge(file_named(name, session.place), session.place);
  if (json) {
    nlohmann::ordered_json document = {{"format", "soilbin-check/1"}, {"valid", true}, {"what", checked.what}};
    document["warnings"] = nlohmann::ordered_json::array();  // an empty list where there are none
    print_json(std::move(document), checked.doubts);
    return done;
  }
  fmt::print("valid: {}\n", checked.what);
  for (const std::string& line : in_words(checked.doubts)) fmt::print("warning: {}\n", line);
  if (checked.doubts.empty()) fmt::print("no warnings\n");
  return done;
}

}  // namespace

void add_check(CLI::App& app, Session& session) {
  CLI::App* command =
      app.add_subcommand("check", "is a case, campaign, tire, soil or vehicle valid, and does it make sense?");
  const auto name = std::make_shared<std::string>();
  const auto json = std::make_shared<bool>(false);
  add_value(*command, "file", *name, "CASE|CAMPAIGN", "a file, a campaign's folder, or a name of the library")
      ->required();
  command->add_flag("--json", *json, "as JSON");
  command->callback([=, &session] { session.action = [=, &session] { return check(*name, *json, session); }; });
}

}  // namespace soilbin::cli
