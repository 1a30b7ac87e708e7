#include "cli/decision_flags.hpp"

#include <fmt/core.h>

#include <algorithm>

#include "cli/flag_values.hpp"
#include "cli/versions.hpp"
#include "compare/sweep/varying.hpp"
#include "scenario/errors.hpp"
#include "scenario/nearest_word.hpp"

namespace soilbin::cli {
namespace {

using compare::Setpoint;

/// A member of the condition that setpoints can be picked by.
struct Axis {
  std::string name;
  double OperatingCondition::*member;
  Measure measure;
};

Axis axis_called(const std::string& name) {
  std::vector<Axis> axes;
  each_member<OperatingCondition>([&](const char* key, auto member, const auto& measure, const char*) {
    if constexpr (std::is_same_v<decltype(member), double OperatingCondition::*>)
      axes.push_back({key, member, measure});
  });
  std::vector<std::string> right;
  for (const Axis& axis : axes) {
    if (axis.name == name) return axis;
    right.push_back(axis.name);
  }
  throw InputError("--decide-at: " + none_of(name, right));
}

std::string conditions_of(const std::vector<Setpoint>& setpoints) {
  constexpr std::size_t shown = 8;
  std::string text;
  for (std::size_t k = 0; k < setpoints.size() && k < shown; ++k)
    text += (k == 0 ? "" : "; ") + compare::in_words(setpoints[k].at);
  return setpoints.size() > shown ? text + "; ..." : text;
}

std::vector<Setpoint> picked(const std::vector<std::string>& texts, const compare::Campaign& campaign) {
  const std::vector<Setpoint> all = compare::setpoints_of(campaign);
  std::vector<Setpoint> kept = all;
  for (const std::string& text : texts) {
    const std::size_t equals = text.find('=');
    const Axis axis = axis_called(text.substr(0, equals));
    const std::string range = equals == std::string::npos ? "" : text.substr(equals + 1);
    const auto [lower, upper] = read_range("--decide-at " + axis.name, range, axis.measure);
    kept = compare::between(kept, axis.member, lower, upper);
  }
  if (kept.empty())
    throw InputError(
        fmt::format("--decide-at: {} has no setpoint there\n  hint: it has {}", campaign.name, conditions_of(all)));
  return kept;
}

}  // namespace

void DecisionFlags::add_to(CLI::App& command) {
  const char* group = "Decided by the soil bin";
  CLI::Option* decide = add_value(command, "--decide", campaign, "CAMPAIGN",
                                  "let the soil bin choose the candidate nearest to this campaign")
                            ->group(group);
  add_value(command, "--decide-at", at, "NAME=LOW..HIGH", "only at its setpoints between these; repeatable")
      ->needs(decide)
      ->group(group);
  add_value(command, "--bed-packings", packings, "N", "beds on which each candidate runs, from --seed on; 1")
      ->check(whole_number(1, compare::most_packings))
      ->needs(decide)
      ->group(group);
  const std::vector<CLI::Option*> before = command.get_options();
  bin.add_measures_to(command);
  bin.add_starting_to(command);
  for (CLI::Option* option : command.get_options())
    if (std::ranges::find(before, option) == before.end()) option->needs(decide)->group(group);
}

compare::TrialQuestion DecisionFlags::question(const Workplace& place) const {
  compare::TrialQuestion question;
  question.campaign = find_campaign(place, campaign);
  question.setpoints = picked(at, question.campaign);
  if (question.campaign.bin) {
    set_where_given("--bed-depth", bin.text("--bed-depth"), {"m", above_zero}, question.campaign.bin->depth);
    set_where_given("--bed-width", bin.text("--bed-width"), {"m", above_zero}, question.campaign.bin->width);
  }
  return question;
}

compare::TrialSettings DecisionFlags::settings(std::uint64_t seed, std::filesystem::path records) const {
  compare::TrialSettings settings;
  settings.bin = settings_of(bin);
  settings.bin.packing = seed;
  settings.packings = packings;
  settings.records = std::move(records);
  settings.version = SOILBIN_VERSION, settings.source = source_state();
  return settings;
}

}  // namespace soilbin::cli
