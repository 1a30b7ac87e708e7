#include "compare/discrepancy/side.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <tuple>

#include "compare/recorded/step_pair.hpp"
#include "compare/sweep/varying.hpp"
#include "scenario/nearest_word.hpp"

namespace soilbin::compare {
namespace {

/// Parts of the pull that leave more than rounding or sampling does: one of them is wrong or missing.
void doubt_budget(SidePoint& point) {
  if (!point.result) return;
  const BudgetRest& rest = point.result->budget_rest;
  if (std::abs(rest.force) > rest.bound) point.doubts.push_back({DoubtKind::budget_rest, {rest.force, rest.bound}});
}

}  // namespace

std::vector<ModelChoice> analytic_choices(const Study& study) {
  std::vector<ModelChoice> choices = {{ModelKind::bekker_wong, {}, "bekker_wong"}};
  for (const ModelChoice& choice : study.models)
    if (choice.model == ModelKind::rft || choice.model == ModelKind::cone_index ||
        (choice.model == ModelKind::bekker_wong && !choice.effects.empty()))
      choices.push_back(choice);
  return choices;
}

bool add_choice(std::vector<ModelChoice>& choices, std::vector<EffectChoice> effects) {
  const auto same_effect = [](const EffectChoice& a, const EffectChoice& b) {
    return std::tie(a.id, a.form, a.parameters) == std::tie(b.id, b.form, b.parameters);
  };
  const auto same = [&](const ModelChoice& other) {
    return other.model == ModelKind::bekker_wong && std::ranges::is_permutation(other.effects, effects, same_effect);
  };
  if (std::ranges::any_of(choices, same)) return false;
  choices.push_back({ModelKind::bekker_wong, std::move(effects), ""});
  return true;
}

std::vector<Side> analytic_sides(Case question, const std::vector<ModelChoice>& choices, const Progress& progress) {
  std::vector<Side> sides;
  if (!question.scenario.soil.semi_empirical) return sides;
  question.study.models = choices;
  for (const ModelAnswers& answers : run_study(question, progress)) sides.push_back(side_of(answers));
  return sides;
}

Side side_of(const ModelAnswers& answers) {
  Side side{answers.choice.label, answers.choice.model == ModelKind::dem ? SideKind::grains : SideKind::analytic, {}};
  if (side.kind == SideKind::analytic) side.choice = answers.choice;
  for (const Answer& answer : answers.answers) {
    SidePoint point;
    point.result = answer.result;
    point.error = answer.error;
    if (answer.result && side.kind == SideKind::grains) {
      for (std::size_t c = 0; c < channel_views.size(); ++c)
        point.scatter[c] = ((*answer.result).*channel_views[c].predicted).std_error;
      point.doubts.push_back({DoubtKind::one_run});
    }
    doubt_budget(point);
    side.points.push_back(std::move(point));
  }
  return side;
}

namespace {

/// What all runs of a side tell of their scatter.
struct ScatterOfAll {
  ToldScatter told;
  bool is_known = false;  ///< whether any condition has several packings
};

SidePoint combine(const std::vector<const RecordedRun*>& runs, const ScatterOfAll& all) {
  SidePoint point;
  std::vector<const RecordedRun*> solved;
  for (const RecordedRun* run : runs)
    if (run->answer.result) solved.push_back(run);
  point.runs = solved.size();
  if (solved.empty()) {
    point.error = runs.empty() ? "not run" : runs.front()->answer.error;
    return point;
  }
  point.result = told_answer(solved, all.told);
  for (std::size_t c = 0; c < channel_views.size(); ++c) {
    const RunScatter one = scatter_of_a_run(solved, all.told, c);
    point.scatter[c] = one.deviation, point.freedom[c] = one.freedom;
  }
  if (solved.size() < runs.size())
    point.doubts.push_back({DoubtKind::runs_without_result, {runs.size() - solved.size(), runs.size()}});
  double most = 0.0, void_ratios = 0.0;
  for (const RecordedRun* run : solved) {
    void_ratios += run->bed.void_ratio;
    if (!run->steady) ++point.unsteady;
    point.drift = std::max(point.drift, run->drift);
    if (std::isfinite(run->drift)) most = std::max(most, run->drift);
  }
  point.void_ratio = void_ratios > 0 ? void_ratios / static_cast<double>(solved.size()) : not_a_number;
  if (point.unsteady > 0) point.doubts.push_back({DoubtKind::unsteady_runs, {point.unsteady, solved.size(), most}});
  if (solved.size() == 1 && !all.is_known) point.doubts.push_back({DoubtKind::one_bed_sample});
  doubt_budget(point);
  return point;
}

ScatterOfAll scatter_of_all(const std::vector<RecordedRun>& runs) {
  const bool is_known = std::ranges::any_of(
      channel_views, [&](const ChannelView& channel) { return packing_scatter(runs, channel.predicted).has_value(); });
  return {told_scatter(runs), is_known};
}

std::vector<const RecordedRun*> at_condition(const std::vector<RecordedRun>& runs, const OperatingCondition& at) {
  std::vector<const RecordedRun*> members;
  for (const RecordedRun& run : runs)
    if (alike(run.answer.at, at)) members.push_back(&run);
  return members;
}

}  // namespace

Side side_of(const std::string& label, const std::vector<RecordedRun>& runs,
             const std::vector<OperatingCondition>& conditions, const std::vector<RecordedRun>& coarser) {
  Side side{label, SideKind::grains, {}};
  const ScatterOfAll scatters = scatter_of_all(runs), of_twins = scatter_of_all(coarser);
  side.scatter_known = scatters.is_known;
  for (const OperatingCondition& at : conditions) {
    SidePoint& point = side.points.emplace_back(combine(at_condition(runs, at), scatters));
    const std::vector<const RecordedRun*> twins = at_condition(coarser, at);
    if (twins.empty() || !point.result) continue;
    if (const SidePoint twin = combine(twins, of_twins); twin.result)
      point.by_twin = error_by_twin(*point.result, *twin.result, coarser_by);
  }
  return side;
}

ResolutionError resolution_error(const Scenario& scenario, const OperatingCondition& at, const SidePoint& point) {
  if (point.by_twin) return *point.by_twin;
  return resolution_error(scenario, at, point.result->sinkage.value, SinkageOf::grains, point.void_ratio);
}

void tell_twins(Doubts& doubts, const std::vector<SidePoint>& points,
                const std::vector<OperatingCondition>& conditions) {
  const auto pull = [](const SidePoint& point) {
    return point.by_twin ? std::abs(point.by_twin->drawbar_pull.value) : -1.0;
  };
  const auto most = std::ranges::max_element(points, {}, pull);
  if (most == points.end() || !most->by_twin) return;
  for (Doubt& doubt : doubts)
    if (doubt.kind == DoubtKind::coarse_grains) {
      doubt.says[0] = in_words(*most->by_twin), doubt.says[1] = "";
      doubt.at = conditions[static_cast<std::size_t>(most - points.begin())];
    }
}

GrainSide grain_side(const std::vector<RecordedRun>& runs, const std::vector<OperatingCondition>& conditions,
                     const std::filesystem::path& record, const std::vector<RecordedRun>& coarser) {
  std::set<std::string> packings, sources;
  double seconds = 0.0;
  for (const RecordedRun& run : runs) {
    packings.insert(std::to_string(run.packing));
    if (!run.source.empty()) sources.insert(run.source);
    seconds += run.seconds;
  }
  GrainSide grains{side_of("dem", runs, conditions, coarser),
                   {{"runs of grains", fmt::format("{}, {:.0f} s in all", runs.size(), seconds)},
                    {"bed samples (seeds)", listed({packings.begin(), packings.end()})},
                    {"sources of the runs", listed({sources.begin(), sources.end()})}}};
  if (record.empty()) return grains;
  const Record kept = read_record(record);
  grains.facts.emplace_back("record", record.string());
  if (const std::string note = unsealed_note(kept, record); !note.empty())
    grains.facts.emplace_back("seals of the record's runs", note);
  grains.facts.emplace_back("hash of the record's inputs", inputs_key(kept.inputs));
  grains.side.doubts = step_doubts(kept);
  return grains;
}

Doubts bed_density_doubts(const Soil& soil, const std::vector<RecordedRun>& runs) {
  constexpr double alike_within = 0.03;  // of the density (chosen: a third of what loose and dense sand differ by)
  if (!soil.semi_empirical || !soil.semi_empirical->density) return {};
  double sum = 0.0, count = 0.0;
  for (const RecordedRun& run : runs)
    if (run.bed.bulk > 0.0) sum += run.bed.bulk, ++count;
  const double declared = *soil.semi_empirical->density, bed = sum / count;
  if (count == 0.0 || std::abs(bed / declared - 1.0) <= alike_within) return {};
  return {Doubt{DoubtKind::bed_density, {bed < declared ? "looser" : "denser", bed, declared}}};
}

}  // namespace soilbin::compare
