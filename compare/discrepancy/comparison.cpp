#include "compare/discrepancy/comparison.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "bekker_wong/effect.hpp"
#include "compare/doubts/doubts.hpp"
#include "compare/doubts/grain_doubts.hpp"
#include "compare/sweep/varying.hpp"
#include "scenario/errors.hpp"

namespace soilbin::compare {
namespace {

/// Rows of one pair and channel are neighbours: a tally each.
std::vector<Tally> tallies_of(const std::vector<Difference>& rows) {
  std::vector<Tally> all;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const Difference& d = rows[i];
    if (all.empty() || all.back().side != d.side || all.back().reference != d.reference ||
        all.back().channel != d.channel)
      all.push_back({.side = d.side, .reference = d.reference, .channel = d.channel, .worst = i});
    Tally& t = all.back();
    ++t.values;
    t.differ += d.finding == DifferenceFinding::difference;
    t.in_scatter += d.finding == DifferenceFinding::within_scatter;
    t.in_errors += d.finding == DifferenceFinding::within_errors;
    t.unknown += d.finding == DifferenceFinding::not_judged;
    t.bias += d.difference;
    t.rms += d.difference * d.difference;
    t.rms_share += d.share * d.share;
    t.expected_rms += d.std_error * d.std_error;
    if (std::abs(d.share) > std::abs(rows[t.worst].share)) t.worst = i;
  }
  for (Tally& t : all) {
    const auto n = static_cast<double>(t.values);
    t.bias /= n;
    for (double* square : {&t.rms, &t.rms_share, &t.expected_rms}) *square = std::sqrt(*square / n);
  }
  return all;
}

void add_sides_without_results(Comparison& comparison) {
  for (std::size_t s = 0; s < comparison.sides.size(); ++s) {
    const std::vector<SidePoint>& points = comparison.sides[s].points;
    NotCompared missing{NotCompared::What::no_result, s};
    for (std::size_t i = 0; i < points.size(); ++i)
      if (!points[i].result) missing.conditions.push_back(i);
    if (missing.conditions.empty()) continue;
    missing.why = points[missing.conditions.front()].error;
    comparison.not_compared.push_back(std::move(missing));
  }
}

/// Effects of a rig, of a tire that yields and of water: dry grains under a rigid wheel have none of them.
std::set<std::string> impossible_in_grains() {
  std::set<std::string> ids;
  for (const bekker_wong::EffectForm& form : bekker_wong::effect_catalogue())
    if (form.measurement || bekker_wong::depends_on(form, "inflation_pressure") ||
        bekker_wong::depends_on(form, "moisture"))
      ids.insert(form.id);
  return ids;
}

/// The case as the loop's declared model, without a run.
Campaign declared(const Side& side, const Case& question, const std::vector<EffectChoice>& effects) {
  check_soil_for_loop(question.scenario.soil);
  Campaign campaign;
  campaign.name = question.study.name + "-" + side.label;
  campaign.wheel = question.scenario.tire;
  campaign.soil = *question.scenario.soil.semi_empirical;
  campaign.bin = question.scenario.bin;
  campaign.effects = effects;
  if (side.kind == SideKind::grains) campaign.impossible = impossible_in_grains();
  return campaign;
}

/// Which sides are held against which: every analytic one against grains and measurements, grains against measurements,
/// and, where there is neither, the analytic ones against each other.
std::vector<std::pair<std::size_t, std::size_t>> pairs_of(const std::vector<Side>& sides) {
  std::vector<std::pair<std::size_t, std::size_t>> pairs;
  for (std::size_t reference = 0; reference < sides.size(); ++reference) {
    if (sides[reference].kind == SideKind::analytic) continue;
    for (std::size_t side = 0; side < sides.size(); ++side)
      if (sides[side].kind < sides[reference].kind) pairs.emplace_back(side, reference);
  }
  if (pairs.empty())
    for (std::size_t reference = 0; reference < sides.size(); ++reference)
      for (std::size_t side = reference + 1; side < sides.size(); ++side) pairs.emplace_back(side, reference);
  return pairs;
}

}  // namespace

void check_soil_for_loop(const Soil& soil) {
  if (!soil.semi_empirical)
    throw InputError(
        "soil '" + soil.name +
        "' has no semi_empirical values, which the loop needs\n  hint: --soil SOIL takes them from another "
        "soil, as bevameter writes one; --no-loop compares without the loop");
}

Comparison compare_sides(const Case& question, const std::vector<ModelChoice>& choices, std::vector<Side> sides) {
  std::ranges::stable_sort(sides, [](const Side& a, const Side& b) { return a.kind < b.kind; });
  Comparison comparison{
      question, curves_against_slip(question.study.conditions, Spread::exact), std::move(sides), {}, {}, {}, {},
      choices};
  for (const auto& [side, reference] : pairs_of(comparison.sides)) {
    const std::vector<Difference> rows =
        differences(comparison.sides, side, reference, question.study.conditions, question.scenario.tire);
    if (rows.empty()) {
      comparison.not_compared.push_back({NotCompared::What::no_shared_condition, side, reference});
      continue;
    }
    comparison.differences.insert(comparison.differences.end(), rows.begin(), rows.end());
    if (side >= choices.size() || comparison.sides[side].kind != SideKind::analytic ||
        comparison.sides[reference].kind == SideKind::analytic ||
        choices[side].model != ModelKind::bekker_wong)  // whose soil alone the test moves
      continue;
    JointOutcome outcome = joint_test(comparison.sides[reference], question, choices[side]);
    if (outcome.test) {
      outcome.test->side = side, outcome.test->reference = reference;
      comparison.joint.push_back(std::move(*outcome.test));
    } else {
      comparison.not_compared.push_back({NotCompared::What::no_joint_test, side, reference, outcome.why_not});
    }
  }
  comparison.tallies = tallies_of(comparison.differences);
  add_sides_without_results(comparison);
  return comparison;
}

Campaign means_of(const Side& side, const Case& question, const std::vector<EffectChoice>& effects) {
  Campaign campaign = declared(side, question, effects);
  bool yawed = false;
  for (const OperatingCondition& at : question.study.conditions)
    yawed = yawed || at.yaw != 0.0 || at.transverse_incline != 0.0;
  for (std::size_t i = 0; i < side.points.size(); ++i) {
    const SidePoint& point = side.points[i];
    if (!point.result) continue;
    Run run;
    run.at = question.study.conditions[i];
    run.setpoint = fmt::format("C{}", i + 1);
    for (std::size_t c = 0; c < channel_views.size(); ++c)
      if (point.has[c] && (yawed || !channel_views[c].sideways))
        run.*channel_views[c].measured = ((*point.result).*channel_views[c].predicted).value;
    campaign.force_frame = run.at.force_frame;
    campaign.slip_by = run.at.slip_by;
    campaign.runs.push_back(std::move(run));
  }
  if (campaign.runs.empty()) throw InputError("'" + side.label + "' has no result at any condition");
  return campaign;
}

Campaign as_campaign(const Side& side, const Case& question) {
  if (side.runs.empty()) return means_of(side, question, {});
  Campaign campaign = declared(side, question, {});
  campaign.runs = side.runs;
  campaign.force_frame = side.runs.front().at.force_frame;
  campaign.slip_by = side.runs.front().at.slip_by;
  return campaign;
}

std::optional<LoopOfComparison> ask_loop(const Comparison& comparison, const LoopOptions& options) {
  const Side& reference = comparison.sides.back();
  if (reference.kind == SideKind::analytic) return std::nullopt;
  const Campaign campaign = as_campaign(reference, comparison.question);
  LoopOfComparison loop;
  if (reference.kind == SideKind::measured) loop.mistaken_columns = of_mistaken_columns(doubts_before_fit(campaign));
  loop.answer = run_loop(campaign, options);
  return loop;
}

namespace {

/// Sides that are models' as their answers.
std::vector<ModelAnswers> answers_of(const Case& question, const std::vector<ModelChoice>& choices,
                                     const std::vector<Side>& sides) {
  std::vector<ModelAnswers> study;
  for (std::size_t s = 0; s < sides.size(); ++s) {
    if (sides[s].kind == SideKind::measured) continue;
    const bool grains = sides[s].kind == SideKind::grains;
    study.push_back({grains ? ModelChoice{ModelKind::dem, {}, sides[s].label} : choices.at(s), {}});
    for (std::size_t i = 0; i < sides[s].points.size(); ++i)
      study.back().answers.push_back(
          {question.study.conditions[i], sides[s].points[i].result, sides[s].points[i].error});
  }
  return study;
}

}  // namespace

bool tires_differ(const Comparison& comparison, std::size_t side, std::size_t reference) {
  const auto flexible = [&](std::size_t s) {
    return comparison.sides[s].kind == SideKind::analytic && s < comparison.choices.size() &&
           bekker_wong::is_flexible(comparison.choices[s].effects);
  };
  const auto rigid = [&](std::size_t s) { return comparison.sides[s].kind == SideKind::grains; };
  return (flexible(side) && rigid(reference)) || (rigid(side) && flexible(reference));
}

bool grains_are_coarse(const Comparison& comparison) {
  const auto of_grains = [](const Side& side) { return side.kind == SideKind::grains; };
  const Case& question = comparison.question;
  return std::ranges::any_of(comparison.sides, of_grains) &&
         grains_are_coarse(question.scenario, answers_of(question, comparison.choices, comparison.sides));
}

Doubts doubts(const Case& question, const std::vector<ModelChoice>& choices, const std::vector<Side>& sides) {
  const std::vector<ModelAnswers> study = answers_of(question, choices, sides);
  Case asked = question;
  asked.study.models.clear();
  for (const ModelAnswers& model : study) asked.study.models.push_back(model.choice);
  Doubts of_models;
  for (const Side& side : sides)
    if (side.kind != SideKind::measured) append(of_models, side.doubts);
  Doubts all = doubts(asked, study, of_models);
  for (const Side& side : sides) tell_twins(all, side.points, question.study.conditions);
  return all;
}

}  // namespace soilbin::compare
