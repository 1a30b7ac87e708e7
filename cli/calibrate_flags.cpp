#include "cli/calibrate_flags.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <tuple>
#include <utility>

#include "cli/flag_values.hpp"
#include "cli/versions.hpp"
#include "compare/sweep/varying.hpp"
#include "scenario/csv.hpp"
#include "scenario/errors.hpp"
#include "scenario/nearest_word.hpp"

namespace soilbin::cli {
namespace {

using compare::ContactKind;
using compare::Factor;
using compare::Target;

/// "NAME=REST" of a flag, NAME one of `right`.
std::pair<std::string, std::string> named(const std::string& flag, const std::string& text,
                                          const std::vector<std::string>& right) {
  const std::size_t equals = text.find('=');
  const std::string name = text.substr(0, equals);
  if (std::ranges::find(right, name) == right.end()) throw InputError(flag + ": " + none_of(name, right));
  return {name, equals == std::string::npos ? "" : text.substr(equals + 1)};
}

/// "VALUE[,SD]" of --target.
Estimate read_target(const std::string& name, const std::string& text, const std::string& unit, const Range& range) {
  const std::vector<std::string> parts = split(text, ",");
  Estimate target{read_flag("--target " + name, parts[0], {unit, range}), 0.0};
  if (parts.size() > 1) target.std_error = read_flag("--target " + name, parts[1], {unit, zero_or_more});
  return target;
}

/// The soil's own phi and c for sand on sand; what --target names, where it names any.
std::vector<Target> targets_of(const ContactTestFlags& asked, ContactKind kind, const Soil& soil) {
  std::vector<Target> targets;
  for (const std::string& text : asked.targets) {
    const auto [name, value] = named("--target", text, compare::target_names(kind));
    const std::string unit = compare::unit_of_target(name);
    targets.push_back({name, read_target(name, value, unit, above_zero), unit});
  }
  return targets.empty() ? compare::targets_of(soil, kind) : targets;
}

/// Features of the measured curves, all or those of --features.
std::vector<Target> features_of(const ContactTestFlags& asked, const std::vector<compare::CompressionCurve>& curves) {
  std::vector<std::string> known;
  for (int k = 0; k < compare::curve_features; ++k)
    known.emplace_back(compare::name_of(static_cast<compare::CurveFeature>(k)));
  std::vector<compare::CurveFeature> features;
  for (const std::string& text : split(asked.features, ",")) {
    if (text.empty()) continue;
    const std::string name = named("--features", text, known).first;
    features.push_back(static_cast<compare::CurveFeature>(std::ranges::find(known, name) - known.begin()));
  }
  return compare::targets_of(curves, features);
}

/// With the values, or errors, that --target puts in place of measured ones.
std::vector<Target> with_own_values(std::vector<Target> targets, const ContactTestFlags& asked) {
  std::vector<std::string> names;
  for (const Target& target : targets) names.push_back(target.name);
  for (const std::string& text : asked.targets) {
    const auto [name, value] = named("--target", text, names);
    Target& target = *std::ranges::find(targets, name, &Target::name);
    target.measured = read_target(name, value, target.unit, {});
    if (target.measured.std_error > 0) target.tolerance = compare::met_within * target.measured.std_error;
  }
  return targets;
}

std::vector<Factor> usual_factors_of(const compare::ContactQuestion& question, const GranularSoil& soil) {
  if (!question.plates.empty()) return compare::usual_factors_of_plates(soil);
  return question.curves.empty() ? compare::usual_factors(question.kind, soil)
                                 : compare::usual_factors_of_curves(question.curves);
}

/// The usual factors, with the bounds of --vary and without those of --keep.
std::vector<Factor> factors_of(const ContactTestFlags& asked, std::vector<Factor> factors) {
  std::vector<std::string> names;
  for (const Factor& factor : factors) names.push_back(factor.name);
  for (const std::string& text : asked.bounds) {
    const auto [name, range] = named("--vary", text, names);
    for (Factor& factor : factors)
      if (factor.name == name) {
        const Measure measure{factor.unit, factor.name == "restitution" ? fractions : zero_or_more};
        std::tie(factor.lower, factor.upper) = read_range("--vary " + name, range, measure);
      }
  }
  for (const std::string& text : asked.kept) {
    const std::string name = named("--keep", text, names).first;
    std::erase_if(factors, [&](const Factor& factor) { return factor.name == name; });
  }
  return factors;
}

}  // namespace

compare::ContactKind ContactTestFlags::kind() const {
  named("--contact", contact, {"sand", "tire"});
  return contact == "sand" ? ContactKind::grain_grain : ContactKind::grain_tire;
}

Soil ContactTestFlags::soil_with_grains(const Workplace& place) const {
  Soil found = find_soil(soil, place.library);
  grains_of(found);
  if (rolling.empty()) return found;
  found.granular->rolling_resistance = rolling_named(rolling);
  found.granular->grain_grain.rolling_stiffness = found.granular->grain_tire.rolling_stiffness = 0.0;
  return found;
}

compare::VirtualTest ContactTestFlags::test(const Soil& of, std::function<void(const dem::Progress&)> progress) const {
  compare::ContactQuestion question;
  question.kind = kind();
  const std::string test = named("--test", strength_test, {"triaxial", "direct-shear", "plate"}).first;
  if (test == "plate") {
    question.test = compare::SandTest::plate;
    question.plates = measured.plates();
    question.targets =
        with_own_values(compare::targets_of(question.plates, compare::points_of(question.plates)), *this);
  } else {
    question.test = test == "triaxial" ? compare::SandTest::triaxial : compare::SandTest::direct_shear;
    if (measured.given()) question.curves = measured.triaxial();
    question.targets = measured.given() ? with_own_values(features_of(*this, question.curves), *this)
                                        : targets_of(*this, question.kind, of);
  }
  question.factors = factors_of(*this, usual_factors_of(question, grains_of(of)));
  question.packings = packings, question.across = across;
  question.settling_friction = read_settling_friction(settling_friction, question.settling_friction);
  question.stresses.clear();
  for (const std::string& stress : split(stresses, ","))
    question.stresses.push_back(read_flag("--stresses", stress, {"kPa", above_zero}));
  named("--strength", strength, {"peak", "residual"});
  question.strength = strength == "peak" ? compare::Strength::peak : compare::Strength::residual;
  question.how.threads = threads;
  question.how.progress = std::move(progress);
  question.how.tell = print_beside_progress;
  check_threads(threads);
  return compare::contact_test(of, question);
}

void ContactTestFlags::add_to(CLI::App& command) {
  add_value(command, "soil", soil, "SOIL", "a soil of the library, or a file; with grains")->required();
  add_value(command, "--contact", contact, "sand|tire",
            "sand on sand, by the triaxial cell, direct shear or plates; or tire on sand, by the tilting board");
  add_value(command, "--test", strength_test, "triaxial|direct-shear|plate",
            "sand on sand: by which test; take the one that measured the target");
  add_value(command, "--target", targets, "NAME=VALUE[,SD]",
            "what was measured; repeatable; for sand, by default, the soil's own");
  measured.add_to(command,
                  "measured drained triaxial tests: strength, stiffness and volume change are the targets; or, with "
                  "--test plate, measured plates: their pressures");
  add_value(command, "--features", features, "NAME,NAME,...",
            "--curves: only these of peak_angle, end_angle, half_strain, volume, void_ratio")
      ->needs("--curves");
  add_value(command, "--vary", bounds, "NAME=LOW..HIGH",
            "bounds of a number of the contact, in place of the usual ones; repeatable");
  add_value(command, "--keep", kept, "NAME", "keep this number as the soil has it; repeatable");
  add_value(command, "--strength", strength, "peak|residual", "sand on sand: strength that the test is read by");
  add_value(command, "--stresses", stresses, "P,P,...",
            "sand on sand: confining stresses of the cell, normal ones of the shear box; 10kPa,20kPa,40kPa");
  add_value(command, "--settling-friction", settling_friction, settling_type,
            "how the sheared sample, or the soil bin's bed, settles: loose, medium, dense, or a share of friction; 1");
  add_value(command, "--rolling", rolling, "LAW",
            "law of rolling resistance: elastic_plastic, directional, directional_with_twist; the soil's own");
  add_value(command, "--across", across, "N", "grains along a side of the board, 16")->check(whole_number(1, 1000));
  add_value(command, "--packings", packings, "N", "number of samples of each experiment; cell and shear box 1, board 4")
      ->check(whole_number(1, compare::most_packings));
  add_value(command, "--threads", threads, "N", "number of threads; 0: one for each core, fewer for few grains");
}

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
