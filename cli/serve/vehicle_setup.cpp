#include "cli/serve/vehicle_setup.hpp"

#include <CLI/CLI.hpp>
#include <utility>

#include "cli/serve/controls.hpp"
#include "cli/serve/setup.hpp"
#include "cli/vehicle_question.hpp"
#include "compare/report/json_fields.hpp"
#include "compare/sweep/varying.hpp"
#include "scenario/mapping_writer.hpp"

namespace soilbin::cli {
namespace {

using Json = nlohmann::ordered_json;

template <class E>
Json choice_json(const char* key, const char* title, E value) {
  return {{"key", key}, {"title", title}, {"value", word_of(value)}, {"words", all_words<E>()}};
}

/// Lists of words that the page offers.
Json choices_json(const compare::VehicleCase& vehicle) {
  Json choices = Json::array({choice_json("drive-line", "Drive line", vehicle.drive_line)});
  if (vehicle.axles.size() == 1) return choices;
  choices.push_back(choice_json("centre-differential", "Centre differential",
                                vehicle.centre_differential.value_or(compare::Differential::locked)));
  for (const Word<compare::DriveLine>& line : words_of(std::type_identity<compare::DriveLine>{}))
    if (compare::without_differentials(line.value).empty()) choices.back()["drive_lines"].push_back(line.text);
  return choices;
}

}  // namespace

VehicleSetup::VehicleSetup(const Workplace& place, std::string name, std::vector<Flag> flags)
    : place_(place), name_(std::move(name)), start_(std::move(flags)) {
  force_unit_ = force_unit_of(ask({}).question);
}

AskedVehicle VehicleSetup::ask(const std::vector<Flag>& query, AskedOf what) const {
  refuse_files(query, place_.library);
  const bool other_soil = holds(query, "soil");
  AskedVehicle asked;
  asked.words = words_of("vehicle", name_, start_, query,
                         [&](const Flag& flag) { return other_soil && is_soil_flag(flag.first); });
  CLI::App app("", asked.words.front());
  app.set_help_flag("");
  const VehicleQuestion flags(app);
  read_words(app, asked.words);
  asked.question = flags.ask(place_);
  asked.wheels = wheels_of(asked.question);
  asked.notes = declare_tires(asked.wheels, flags.left_out());
  if (what == AskedOf::drive) {
    flags.refuse_what_its_drive_says(asked.question.drive);
    asked.words.emplace_back("--drive");
  }
  return asked;
}

Json VehicleSetup::document() const {
  const compare::VehicleCase vehicle = ask({}).question;
  return {{"format", "soilbin-serve/1"},
          {"vehicle", vehicle.name},
          {"soil", compare::in_words(vehicle.soil)},
          {"soils", soils_json(place_.library)},
          {"numbers", vehicle_numbers_json(vehicle, force_unit_)},
          {"choices", choices_json(vehicle)},
          {"axles", compare::list_of(vehicle.axles,
                                     [](const compare::VehicleAxle& axle) {
                                       return Json{{"name", axle.name}, {"driven", axle.driven == YesNo::yes}};
                                     })},
          {"effects", effects_json(vehicle.effects, vehicle.soil)}};
}

}  // namespace soilbin::cli
