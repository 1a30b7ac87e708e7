#include "compare/experiments/convergence.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "compare/experiments/run_plan.hpp"
#include "compare/measured/campaign.hpp"
#include "compare/report/number_text.hpp"
#include "compare/sweep/result_json.hpp"
#include "scenario/errors.hpp"

namespace soilbin::compare {
namespace {

namespace fs = std::filesystem;

/// One choice changed.
fs::path file_of(const fs::path& record, std::string variant) {
  if (record.empty()) return {};
  std::ranges::replace(variant, ' ', '-');
  return record.parent_path() / (record.stem().string() + "." + variant + record.extension().string());
}

struct Variant {
  std::string name;  ///< "bed twice as long"
  dem::DemSettings settings;
  Scenario scenario;

  Case asked_of(Case question) const {
    question.scenario = scenario;
    return question;
  }
  /// In a file of its own beside the record.
  RunKeeping kept(RunKeeping keeping) const {
    keeping.record = file_of(keeping.record, name);
    return keeping;
  }
};

/// Difference of a channel to the first run, in standard errors of the difference; nothing for the first itself, and
/// where either has no result.
std::optional<double> in_errors(const RecordedRun& first, const RecordedRun& run, const ChannelView& channel) {
  if (&first == &run || !first.answer.result || !run.answer.result) return std::nullopt;
  const Estimate &a = (*first.answer.result).*channel.predicted, &b = (*run.answer.result).*channel.predicted;
  return (b.value - a.value) / std::hypot(a.std_error, b.std_error);
}

/// The choices as they are, first, then each changed: another packing, length, width and depth of the bed, warm-up,
/// time step, mesh of the tire, sampling time, skin.
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
  add("another bed sample").settings.packing += 1;
  size(add("bed twice as long"), &dem::BedSize::length, 2);
  size(add("bed twice as wide"), &dem::BedSize::width, 2);
  size(add("bed twice as deep"), &dem::BedSize::depth, 2);
  size(add("bed half as deep"), &dem::BedSize::depth, 0.5);
  warm_up(add("warm-up twice as long"), 2);
  warm_up(add("warm-up half as long"), 0.5);
  add("time step halved").settings = at_half_step(settings, scenario);
  add("tire mesh twice as fine").settings.rig.meshing.edge /= 2;
  add("tire mesh twice as coarse").settings.rig.meshing.edge *= 2;
  add("samples twice as long").settings.rig.sampling *= 2;
  add("samples half as long").settings.rig.sampling /= 2;
  add("skin doubled").settings.rig.skin *= 2;
  add("skin halved").settings.rig.skin /= 2;
  return all;
}

OperatingCondition only_condition(const dem::DemSettings& settings, const Case& question) {
  if (question.study.conditions.size() != 1)
    throw InputError(
        fmt::format("--converge takes one condition, not {}\n  hint: pick it, such as --load 4kN --slip 20%",
                    question.study.conditions.size()));
  dem::DemModel(settings).check(question.scenario);
  return question.study.conditions.front();
}

}  // namespace

std::vector<PlannedVariant> plan_variants(const dem::DemSettings& settings, const Case& question,
                                          const RunKeeping& keeping) {
  const OperatingCondition at = only_condition(settings, question);
  std::vector<PlannedVariant> plan;
  for (const Variant& variant : variants_of(settings, question.scenario)) {
    PlannedVariant& planned = plan.emplace_back(PlannedVariant{.name = variant.name});
    try {
      dem::DemModel(variant.settings).check(variant.scenario);
      const RunPlan of = plan_of(variant.asked_of(question), variant.settings, {{at, variant.settings.packing}},
                                 variant.kept(keeping));
      planned.recorded = of.runs.front().recorded, planned.seconds = of.runs.front().seconds;
      planned.settles = !of.unsettled.empty() && !planned.recorded;
    } catch (const InputError& refused) {
      planned.refused = refused.what();
    }
  }
  return plan;
}

std::string plan_text(const std::vector<PlannedVariant>& plan) {
  Table table{"", {"choice", "time", "bed"}};
  double seconds = 0;
  std::size_t left = 0;
  std::string refusals;
  for (const PlannedVariant& variant : plan) {
    const bool possible = variant.refused.empty(), made = possible && !variant.recorded;
    table.add({variant.name,
               made       ? duration_text(variant.seconds)
               : possible ? std::string("recorded")
                          : std::string("-"),
               variant.settles ? "to settle" : ""});
    if (made) ++left, seconds += variant.seconds;
    if (!possible) refusals += fmt::format("{}: {}\n", variant.name, variant.refused);
  }
  return fmt::format("{}\n{}{} to make, about {} beside the beds, one after the other\n", as_text(table), refusals,
                     counted(left, "run"), duration_text(seconds));
}

std::vector<VariantRun> run_variants(const dem::DemSettings& settings, const Case& question,
                                     const EffectVocabulary& effects, const RunKeeping& keeping) {
  const OperatingCondition at = only_condition(settings, question);
  std::vector<VariantRun> runs;
  for (const Variant& variant : variants_of(settings, question.scenario)) {
    RunStore store = store_of(variant.settings, variant.asked_of(question), effects, variant.kept(keeping));
    SoilBinRuns bin(variant.settings, keeping);
    try {
      runs.push_back({variant.name, obtain({at, variant.settings.packing}, variant.scenario, store, bin)});
    } catch (const InputError& refused) {
      runs.push_back(
          {variant.name,
           {.answer = {at, std::nullopt, refused.what()}, .source = {}, .power = {}, .rut = {}, .flow = {}}});
    }
  }
  return runs;
}

Table convergence_table(const std::vector<VariantRun>& runs) {
  Table table{"", {"choice"}};
  for (const std::size_t c : channels_in_plane)
    table.header.insert(table.header.end(),
                        {fmt::format("{} [{}]", channel_views[c].title, channel_views[c].unit), "differs [errors]"});
  table.header.emplace_back("time [s]");
  for (const auto& [name, run] : runs) {
    std::vector<TableCell> row = {name};
    for (const std::size_t c : channels_in_plane) {
      const ChannelView& channel = channel_views[c];
      const auto& result = run.answer.result;
      const std::optional<double> differs = in_errors(runs.front().run, run, channel);
      row.push_back(result ? number((*result).*channel.predicted, channel.per_si) : "-");
      row.push_back(differs ? fmt::format("{:.1f}", *differs) : "-");
    }
    row.push_back(fmt::format("{:.0f}", run.seconds));
    table.add(std::move(row));
  }
  return table;
}

nlohmann::ordered_json convergence_json(const std::vector<VariantRun>& runs) {
  Json rows = Json::array();
  for (const auto& [name, run] : runs) {
    Json row = {{"choice", name}, {"seconds", run.seconds}};
    row.update(to_json(run.answer));
    for (const std::size_t c : channels_in_plane)
      if (const auto differs = in_errors(runs.front().run, run, channel_views[c]))
        row["differs"][std::string(channel_views[c].name)] = finite(*differs);
    rows.push_back(std::move(row));
  }
  return {{"format", "soilbin-convergence/1"}, {"rows", rows}};
}

}  // namespace soilbin::compare
