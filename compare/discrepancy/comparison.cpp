#include "compare/discrepancy/comparison.hpp"

#include <fmt/core.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "bekker_wong/effect.hpp"
#include "bekker_wong/gsl.hpp"
#include "compare/doubts/doubts.hpp"
#include "compare/doubts/grain_doubts.hpp"
#include "compare/fit/factorizations.hpp"
#include "compare/fit/wheel_predictor.hpp"
#include "compare/report/number_text.hpp"
#include "scenario/errors.hpp"
#include "scenario/estimate.hpp"
#include "scenario/fitted_errors.hpp"

namespace soilbin::compare {
namespace {

/// Rows of one pair and channel are neighbours: a tally each.
std::vector<Tally> tallies_of(const std::vector<Difference>& rows) {
  std::vector<Tally> all;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const Difference& d = rows[i];
    if (all.empty() || !d.is_of(all.back())) all.emplace_back(Tally{d}).worst = i;
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
    throw InputError("soil '" + soil.name +
                     "' has no semi_empirical values, which the loop needs\n  hint: --soil SOIL takes them from "
                     "another soil, as bevameter writes one; --no-loop compares without the loop");
}

Comparison compare_sides(const Case& question, std::vector<Side> sides) {
  std::ranges::stable_sort(sides, [](const Side& a, const Side& b) { return a.kind < b.kind; });
  Comparison comparison{
      question, curves_against_slip(question.study.conditions, Spread::exact), std::move(sides), {}, {}, {}, {}};
  for (const auto& [side, reference] : pairs_of(comparison.sides)) {
    const std::vector<Difference> rows =
        differences(comparison.sides, side, reference, question.study.conditions, question.scenario.tire);
    if (rows.empty()) {
      comparison.not_compared.push_back({NotCompared::What::no_shared_condition, side, reference});
      continue;
    }
    comparison.differences.insert(comparison.differences.end(), rows.begin(), rows.end());
    const Side &one = comparison.sides[side], &other = comparison.sides[reference];
    if (!is_by(one, ModelKind::bekker_wong) || other.kind == SideKind::analytic) continue;  // it moves that one's soil
    JointOutcome outcome = joint_test(other, question, *one.choice);
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
std::vector<ModelAnswers> answers_of(const Case& question, const std::vector<Side>& sides) {
  std::vector<ModelAnswers> study;
  for (const Side& side : sides) {
    if (side.kind == SideKind::measured) continue;
    study.push_back({side.choice.value_or(ModelChoice{ModelKind::dem, {}, side.label}), {}});
    for (std::size_t i = 0; i < side.points.size(); ++i)
      study.back().answers.push_back({question.study.conditions[i], side.points[i].result, side.points[i].error});
  }
  return study;
}

}  // namespace

bool tires_differ(const Comparison& comparison, std::size_t side, std::size_t reference) {
  const auto flexible = [&](std::size_t s) {
    const std::optional<ModelChoice>& choice = comparison.sides[s].choice;
    return choice && bekker_wong::is_flexible(choice->effects);
  };
  const auto rigid = [&](std::size_t s) { return comparison.sides[s].kind == SideKind::grains; };
  return (flexible(side) && rigid(reference)) || (rigid(side) && flexible(reference));
}

bool grains_are_coarse(const Comparison& comparison) {
  const auto of_grains = [](const Side& side) { return side.kind == SideKind::grains; };
  const Case& question = comparison.question;
  return std::ranges::any_of(comparison.sides, of_grains) &&
         grains_are_coarse(question.scenario, answers_of(question, comparison.sides));
}

Doubts doubts_of_sides(const Case& question, const std::vector<Side>& sides) {
  const std::vector<ModelAnswers> study = answers_of(question, sides);
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

namespace {

const TractionResult* result_of(const Comparison& comparison, std::size_t side, std::size_t condition) {
  const SidePoint& point = comparison.sides[side].points[condition];
  return point.result ? &*point.result : nullptr;
}

double force_of(const TractionResult& result, const std::string& name) {
  for (const Contribution& part : result.budget)
    if (part.name == name) return part.force;
  return not_a_number;
}

}  // namespace

BudgetTable budget_at(const Comparison& comparison, std::size_t condition) {
  BudgetTable table{condition, {}, {}};
  for (std::size_t s = 0; s < comparison.sides.size(); ++s) {
    const TractionResult* result = result_of(comparison, s, condition);
    if (result == nullptr || result->budget.empty()) continue;
    table.sides.push_back(s);
    for (const Contribution& part : result->budget)
      if (std::ranges::none_of(table.rows, [&](const BudgetRow& r) { return r.name == part.name; }))
        table.rows.push_back({part.name, {}});
  }
  for (BudgetRow& row : table.rows)
    for (const std::size_t s : table.sides)
      row.force.push_back(force_of(*result_of(comparison, s, condition), row.name));
  return table;
}

std::string part_in_words(const std::string& name) {
  static const std::map<std::string, std::string> known = {
      {"shear_thrust", "thrust of the sheared soil"},
      {"compaction_resistance", "compaction resistance (normal stresses)"},
      {"side_force", "side force of a yawed wheel"},
      {"slope", "gravity on the slope"},
      {"measurement", "what the instruments add"},
      {"bulldozing", "bulldozing ahead of the wheel"},
      {"sidewall_bulldozing", "bulldozing by the sidewalls"},
      {"lug_thrust", "thrust of the lugs' faces"},
  };
  const auto found = known.find(name);
  if (found != known.end()) return found->second;
  return spaced(name);
}

std::optional<BudgetGap> widest_part(const Comparison& comparison, std::size_t side, std::size_t reference,
                                     std::size_t condition) {
  const TractionResult *a = result_of(comparison, side, condition), *b = result_of(comparison, reference, condition);
  if (a == nullptr || b == nullptr || a->budget.empty() || b->budget.empty()) return std::nullopt;
  std::optional<BudgetGap> widest;
  for (const BudgetRow& row : budget_at(comparison, condition).rows) {
    // A part that one side doesn't name is a part that this side leaves out: 0.
    const double x = force_of(*a, row.name), y = force_of(*b, row.name);
    const BudgetGap gap{row.name, std::isnan(x) ? 0.0 : x, std::isnan(y) ? 0.0 : y};
    if (!widest || std::abs(gap.side - gap.reference) > std::abs(widest->side - widest->reference)) widest = gap;
  }
  return widest;
}

std::vector<SinkageSplit> sinkage_splits(const Comparison& comparison) {
  constexpr double no_slip = 1e-6;
  const std::vector<OperatingCondition>& conditions = comparison.question.study.conditions;
  const Curves& curves = comparison.curves;
  std::vector<SinkageSplit> splits;
  for (std::size_t s = 0; s < comparison.sides.size(); ++s) {
    std::map<std::size_t, double> at_rest;
    for (std::size_t i = 0; i < conditions.size(); ++i)
      if (const TractionResult* result = result_of(comparison, s, i); result && std::abs(conditions[i].slip) < no_slip)
        at_rest[curves.curve_of[i]] = result->sinkage.value;
    for (std::size_t i = 0; i < conditions.size(); ++i) {
      const TractionResult* result = result_of(comparison, s, i);
      const auto rest = at_rest.find(curves.curve_of[i]);
      if (result == nullptr || rest == at_rest.end() || !std::isfinite(result->sinkage.value)) continue;
      splits.push_back({s, i, rest->second, result->sinkage.value - rest->second});
    }
  }
  return splits;
}

std::size_t condition_of_largest_difference(const Comparison& comparison) {
  std::size_t condition = comparison.question.study.conditions.size() / 2;
  double most = 0.0;
  for (const Difference& d : comparison.differences)
    if (channel_views[d.channel].name == "drawbar_pull" && std::abs(d.share) > most)
      most = std::abs(d.share), condition = d.condition;
  return condition;
}

// The joint test of a comparison.

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

/// What the cells of the reference's campaign rest on.
struct Estimated {
  VectorXd errors;        ///< of each cell; a value that is not above zero where none is stated
  double channels = 0.0;  ///< whose correlation is estimated with them; 1 where each stands by itself
  double freedom = std::numeric_limits<double>::infinity();  ///< the fewest behind any of their errors
};

Estimated estimated_of(const Observations& observations, const Side& reference) {
  std::vector<const SidePoint*> solved;  // in the order of as_campaign's runs
  for (const SidePoint& point : reference.points)
    if (point.result) solved.push_back(&point);
  Estimated all{.errors = VectorXd(static_cast<Index>(observations.cells.size()))};
  std::set<int> channels;
  for (std::size_t k = 0; k < observations.cells.size(); ++k) {
    const Cell& cell = observations.cells[k];
    const SidePoint& point = *solved[static_cast<std::size_t>(observations.source_row[cell.row])];
    all.errors[static_cast<Index>(k)] = ((*point.result).*channel_views[cell.channel].predicted).std_error;
    all.freedom = std::min(all.freedom, point.freedom[cell.channel]);
    channels.insert(cell.channel);
  }
  all.channels = reference.noise ? static_cast<double>(channels.size()) : 1.0;
  return all;
}

/// Turns columns over the cells into units of the reference's errors, so that newtons and metres meet as equals, and
/// takes the correlation between a measured run's channels out.
class InErrors {
 public:
  InErrors(const Observations& observations, const Side& reference, const VectorXd& errors)
      : errors_(errors), correlation_(observations, of_size_one(reference), VectorXd::Zero(errors.size())) {}
  MatrixXd operator()(const MatrixXd& columns) const {
    return correlation_(MatrixXd(errors_.cwiseInverse().asDiagonal() * columns));
  }

 private:
  static NoiseFloor of_size_one(const Side& reference) {
    NoiseFloor noise;
    for (ChannelNoise& channel : noise.channels) channel.floor = 1.0;
    if (reference.noise) noise.correlation = reference.noise->correlation;
    return noise;
  }

  VectorXd errors_;
  Whitening correlation_;
};

/// R^(1/2) of the parameters' correlation matrix R.
MatrixXd root_of_correlation(const std::vector<std::string>& parameters, const std::vector<FittedError>& errors) {
  const Index n = std::ssize(parameters);
  MatrixXd together = MatrixXd::Identity(n, n);
  for (Index i = 0; i < n; ++i)
    for (Index k = 0; k < i; ++k) together(i, k) = together(k, i) = correlation(errors, parameters[i], parameters[k]);
  return Ldlt(together).square_root();
}

std::string why_not_tested(const Estimated& estimated) {
  if (estimated.errors.size() == 0) return "no value to test";
  if (!(estimated.errors.minCoeff() > 0.0)) return "a value has no standard error";
  const double needed = estimated.channels > 1 ? estimated.channels + 4 : 1;
  if (estimated.freedom < needed)
    return fmt::format("{:.0f} runs beyond the first of a condition; {:.0f} are needed for {:.0f} channels",
                       estimated.freedom, needed, estimated.channels);
  return "";
}

}  // namespace

double trace_tail(double trace, double values, double channels, double freedom) {
  if (channels == 1) return gsl::f_tail(trace / values, values, freedom);
  const double m = values / channels, rest = freedom - channels;
  const double b = (rest + m - 1) * (freedom - 1) / ((rest - 3) * rest);
  const double denominator = 4 + (values + 2) / (b - 1);
  const double size = values * (denominator - 2) / (denominator * (rest - 1));
  return gsl::f_tail(trace / (freedom * size), values, denominator);
}

JointOutcome joint_test(const Side& reference, const Case& question, const ModelChoice& model) {
  if (!question.scenario.soil.semi_empirical) return {std::nullopt, "the soil has no semi_empirical values"};
  const Campaign campaign = means_of(reference, question, model.effects);
  const Observations observations = observe(campaign);
  const WheelPredictor predictor(campaign, observations);
  const Estimated estimated = estimated_of(observations, reference);
  if (reference.kind == SideKind::grains && !reference.scatter_known && std::isinf(estimated.freedom))
    return {std::nullopt, "the scatter between bed samples is unknown: run two or more at some conditions"};
  if (std::string why = why_not_tested(estimated); !why.empty()) return {std::nullopt, why};
  VectorXd predicted;
  BalanceMemory balanced;
  const bool balances = predictor.predict(predictor.start(), predicted, balanced);
  const auto slopes = balances ? predictor.linearise(predictor.start(), balanced) : std::nullopt;
  if (!slopes) return {std::nullopt, "the model has no balance at some condition"};
  JointTest test;
  VectorXd sd(predictor.soil_parameters());
  for (int i = 0; i < predictor.soil_parameters(); ++i) {
    const FreeParameter& parameter = predictor.parameters()[i];
    sd[i] = parameter.prior_sd;
    test.soil.push_back(parameter.name);
  }
  const InErrors in_errors(observations, reference, estimated.errors);
  const VectorXd white = in_errors(predicted - observations.values());
  const MatrixXd columns = in_errors(slopes->jacobian.leftCols(predictor.soil_parameters()) * sd.asDiagonal() *
                                     root_of_correlation(test.soil, model.errors));
  // d' (1 + A A')^-1 d = d' d - (A' d)' (1 + A' A)^-1 (A' d): Woodbury's identity.
  const VectorXd along = columns.transpose() * white;
  MatrixXd inner = columns.transpose() * columns;
  inner.diagonal().array() += 1.0;
  test.values = static_cast<std::size_t>(white.size());
  test.chi2_soil_exact = white.squaredNorm();
  test.chi2 = test.chi2_soil_exact - along.dot(Ldlt(inner).solve(along));
  test.freedom = estimated.freedom;
  const auto values = static_cast<double>(test.values);
  test.p_errors_known = gsl::chi_square_tail(test.chi2, values);
  test.p_value =
      std::isinf(test.freedom) ? test.p_errors_known : trace_tail(test.chi2, values, estimated.channels, test.freedom);
  return {test, ""};
}

}  // namespace soilbin::compare
