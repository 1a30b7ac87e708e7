#include "cli/converge.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "cli/commands.hpp"
#include "cli/text_output.hpp"
#include "compare/measured/channels.hpp"
#include "compare/report/json_fields.hpp"
#include "compare/report/result_json.hpp"
#include "compare/sweep/varying.hpp"
#include "dem/rig/step_criteria.hpp"
#include "scenario/errors.hpp"

namespace soilbin::cli {
namespace {

namespace fs = std::filesystem;

constexpr std::array<std::size_t, 3> shown_channels = {0, 1, 2};  // pull, torque, sinkage

fs::path file_of(const std::string& record, const std::string& variant) {
  if (record.empty()) return {};
  std::string suffix = variant;
  std::replace(suffix.begin(), suffix.end(), ' ', '-');
  const fs::path file = record;
  return file.parent_path() / (file.stem().string() + "." + suffix + file.extension().string());
}

/// Difference to the first, in standard errors of the difference.
double in_errors(const Estimate& base, const Estimate& other) {
  return (other.value - base.value) / std::hypot(base.std_error, other.std_error);
}

std::string table(const std::vector<Variant>& variants, const std::vector<compare::RecordedRun>& runs) {
  std::vector<std::string> header = {"choice"};
  for (const std::size_t c : shown_channels) {
    const compare::ChannelView& channel = compare::channel_views[c];
    header.push_back(fmt::format("{} [{}]", channel.title, channel.unit)), header.emplace_back("differs [errors]");
  }
  header.emplace_back("time [s]");
  TextTable text(header);
  const auto& base = runs.front().answer.result;
  std::string notes;
  for (std::size_t k = 0; k < runs.size(); ++k) {
    const auto& result = runs[k].answer.result;
    std::vector<std::string> row = {variants[k].name};
    for (const std::size_t c : shown_channels) {
      const compare::ChannelView& channel = compare::channel_views[c];
      row.push_back(result ? number((*result).*channel.predicted, channel.per_si) : "-");
      row.push_back(result && base && k > 0
                        ? fmt::format("{:.1f}", in_errors((*base).*channel.predicted, (*result).*channel.predicted))
                        : "-");
    }
    row.push_back(fmt::format("{:.0f}", runs[k].seconds));
    text.add(std::move(row));
    if (!result) notes += fmt::format("{}: {}\n", variants[k].name, runs[k].answer.error);
  }
  return text.text() + notes;
}

nlohmann::ordered_json document(const std::vector<Variant>& variants, const std::vector<compare::RecordedRun>& runs) {
  compare::Json rows = compare::Json::array();
  const auto& base = runs.front().answer.result;
  for (std::size_t k = 0; k < runs.size(); ++k) {
    compare::Json row = {{"choice", variants[k].name}, {"seconds", runs[k].seconds}};
    row.update(compare::to_json(runs[k].answer));
    if (base && runs[k].answer.result && k > 0)
      for (const std::size_t c : shown_channels) {
        const compare::ChannelView& channel = compare::channel_views[c];
        row["differs"][std::string(channel.name)] =
            compare::finite(in_errors((*base).*channel.predicted, (*runs[k].answer.result).*channel.predicted));
      }
    rows.push_back(std::move(row));
  }
  return {{"format", "soilbin-convergence/1"}, {"rows", rows}};
}

}  // namespace

std::vector<Variant> variants_of(const dem::DemSettings& settings, const Scenario& scenario) {
  std::vector<Variant> all = {{"as it is", settings, scenario}};
  const auto add = [&](const char* name) -> Variant& { return all.emplace_back(name, settings, scenario); };
  const auto size = [](Variant& variant, double dem::BedSize::*side, double factor) {
    variant.settings.size.*side *= factor;
    if (!variant.scenario.bin) return;
    if (side == &dem::BedSize::width) variant.scenario.bin->width *= factor;
    if (side == &dem::BedSize::depth) variant.scenario.bin->depth *= factor;
  };
  const auto warm_up = [](Variant& variant, double factor) {
    dem::Rig& rig = variant.settings.rig;
    rig.lowering *= factor, rig.resting *= factor, rig.starting *= factor;
  };
  add("another packing").settings.packing += 1;
  size(add("bed twice as long"), &dem::BedSize::length, 2);
  size(add("bed twice as wide"), &dem::BedSize::width, 2);
  size(add("bed twice as deep"), &dem::BedSize::depth, 2);
  size(add("bed half as deep"), &dem::BedSize::depth, 0.5);
  warm_up(add("warm-up twice as long"), 2);
  warm_up(add("warm-up half as long"), 0.5);
  const dem::BedRecipe recipe = dem::DemModel(settings).recipe(scenario);
  add("time step halved").settings.rig.dt = dem::step_of(recipe, settings.rig) / 2;
  add("tire mesh twice as fine").settings.rig.meshing.edge /= 2;
  add("tire mesh twice as coarse").settings.rig.meshing.edge *= 2;
  add("samples twice as long").settings.rig.sampling *= 2;
  add("samples half as long").settings.rig.sampling /= 2;
  add("skin doubled").settings.rig.skin *= 2;
  add("skin halved").settings.rig.skin /= 2;
  return all;
}

int converge(const SoilBinFlags& flags, const Case& question, const EffectVocabulary& effects, bool json) {
  if (question.study.conditions.size() != 1)
    throw InputError(
        fmt::format("--converge takes one condition, not {}\n  hint: pick it, such as --load 4kN --slip 20%",
                    question.study.conditions.size()));
  const OperatingCondition at = question.study.conditions.front();
  const std::vector<Variant> variants = variants_of(settings_of(flags), question.scenario);
  std::vector<compare::RecordedRun> runs;
  for (const Variant& variant : variants) {
    Case changed = question;
    changed.scenario = variant.scenario;
    const compare::RunOnce run = run_with(variant.settings, changed, effects, file_of(flags.record, variant.name));
    try {
      runs.push_back(run(variant.scenario, at, variant.settings.packing));
    } catch (const InputError& refused) {  // a bed that would be too shallow or narrow: told in its row
      runs.push_back({.answer = {at, std::nullopt, refused.what()}, .source = {}, .power = {}, .rut = {}, .flow = {}});
    }
  }
  if (json)
    fmt::print("{}", compare::json_text(document(variants, runs)));
  else
    fmt::print("{}: {}\n\n{}", question.study.name, compare::in_words(at), table(variants, runs));
  forget_runs(runs, {});
  return runs.front().answer.result ? done : failed;
}

}  // namespace soilbin::cli
