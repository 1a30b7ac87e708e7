#include "compare/failure_map/incline_map.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <vector>

#include "compare/design/factor.hpp"
#include "compare/doubts/doubts.hpp"
#include "compare/doubts/grain_resolution.hpp"
#include "compare/recorded/record.hpp"
#include "compare/sweep/answers.hpp"
#include "scenario/errors.hpp"
#include "scenario/estimate.hpp"
#include "scenario/mapping_writer.hpp"
#include "scenario/traction_channels.hpp"

namespace soilbin::compare {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// A drawbar pull [N] at values of the factors; nothing where there is no answer.
using PullAt = std::function<std::optional<Estimate>(const VectorXd&)>;

PullAt quick_pull(const InclineMap& map, ModelKind kind) {
  return [map, model = std::shared_ptr(make_model(kind)), kind](const VectorXd& values) -> std::optional<Estimate> {
    Scenario scenario = scenario_at(map, values);
    if (kind != ModelKind::bekker_wong) scenario.effects.clear();
    if (!is_lugged(scenario.tire))  // the effect would assume lugs
      std::erase_if(scenario.effects, [](const EffectChoice& effect) { return effect.id == "lug_thrust"; });
    const Answer answer = ask(*model, scenario, condition_at(map, values));
    return answer.result ? std::optional(Estimate{answer.result->drawbar_pull.value, 0}) : std::nullopt;
  };
}

using RunAt = std::function<std::optional<Experiment>(const VectorXd&)>;

/// A run with an answer.
RunAt runs_of(const VirtualTest& grains, ExperimentStore& store, std::uint64_t packing) {
  return [&grains, &store, packing](const VectorXd& values) -> std::optional<Experiment> {
    std::optional<Experiment> run = obtain(grains, {values, packing}, store);
    if (run && run->results.empty()) run.reset();
    return run;
  };
}

/// By the twin of a run: the grains' pull less that of infinitely fine ones.
PullAt error_by_twins(const MapGrains& grains) {
  return [grains, fine = runs_of(*grains.runs, *grains.store, grains.packing),
          coarse = runs_of(*grains.coarser, *grains.store, grains.packing)](const VectorXd& values) {
    const std::optional<Experiment> run = grains.waits() ? std::nullopt : fine(values);
    const std::optional<Experiment> twin = run || grains.waits() ? coarse(values) : std::nullopt;
    if (!run || !twin) return std::optional<Estimate>();
    return std::optional(error_by_twin(run->results.front(), twin->results.front(), coarser_by));
  };
}

/// Carried over from the study of grain sizes, as far as that reaches.
PullAt error_by_study(const InclineMap& map, const MapGrains& grains) {
  constexpr std::size_t sinkage = 2;  // of grain_channels()
  return [map, grains, runs = runs_of(*grains.runs, *grains.store, grains.packing)](const VectorXd& values) {
    if (grains.waits() || !map.scenario.soil.granular) return std::optional<Estimate>();
    const std::optional<Experiment> run = runs(values);
    if (!run) return std::optional<Estimate>();
    const ResolutionError error =
        resolution_error(scenario_at(map, values), condition_at(map, values), run->results.at(sinkage).value);
    return error.known() ? std::optional(error.drawbar_pull) : std::nullopt;
  };
}

/// What a model needs of the map's soil and wheel.
void check_model(const InclineMap& map, ModelKind kind) {
  const Soil& soil = map.scenario.soil;
  if (kind == ModelKind::cone_index)
    throw InputError("a map takes bekker_wong, rft or dem: cone_index knows neither lugs nor cross slopes");
  if (kind == ModelKind::bekker_wong && !soil.semi_empirical)
    throw InputError(
        "soil '" + soil.name +
        "' has no semi-empirical values for the analytic model\n  hint: soilbin bevameter gives them from the grains");
  if (kind == ModelKind::rft && !soil.semi_empirical && !soil.resistive_force)
    throw InputError("soil '" + soil.name + "' has no values for the model rft\n  hint: a section resistive_force");
  if (kind != ModelKind::bekker_wong && map.factors.at(map_lug_height).upper > 0 &&
      !(map.scenario.tire.lugs.count && map.scenario.tire.lugs.thickness))
    throw InputError("tire '" + map.scenario.tire.name +
                     "' tells no count and thickness of lugs, which runs with lugs need\n  hint: a lugged tire; the "
                     "map varies its lugs' height");
}

}  // namespace

std::string name_of(Incline incline) {
  return std::string(word_of(incline)) + (incline == Incline::yaw ? "" : " incline");
}

Scenario scenario_at(const InclineMap& map, const VectorXd& values) {
  Scenario scenario = map.scenario;
  scenario.tire.lugs.height = values[map_lug_height];
  return scenario;
}

OperatingCondition condition_at(const InclineMap& map, const VectorXd& values) {
  OperatingCondition at = map.base;
  at.load = values[map_load], at.slip = values[map_slip];
  at.longitudinal_incline = at.transverse_incline = at.yaw = 0;
  (map.incline == Incline::longitudinal ? at.longitudinal_incline
   : map.incline == Incline::transverse ? at.transverse_incline
                                        : at.yaw) = values[map_angle];
  return at;
}

std::vector<Target> grain_channels() {
  std::vector<Target> targets;
  for (const TractionChannel& channel : traction_channels)
    targets.push_back({std::string(channel.name), {}, std::string(channel.unit)});
  return targets;
}

FailureQuestion failure_question(const InclineMap& map, const MapGrains& grains, double tolerance) {
  if (map.of == map.against)
    throw InputError("a map of a model against itself\n  hint: --of and --against name two models");
  check_model(map, map.of), check_model(map, map.against);
  FailureQuestion question;
  question.name = name_of(map.incline);
  question.factors = map.factors;
  question.tolerance = tolerance;
  question.waits = [grains] { return grains.waits(); };
  const auto pull = [&](ModelKind kind) -> PullAt {
    if (kind != ModelKind::dem) return quick_pull(map, kind);
    return [runs = runs_of(*grains.runs, *grains.store, grains.packing)](const VectorXd& values) {
      const std::optional<Experiment> run = runs(values);
      return run ? std::optional(run->results.front()) : std::nullopt;
    };
  };
  question.difference = [of = pull(map.of), against = pull(map.against)](const VectorXd& values) {
    const std::optional<Estimate> first = of(values), second = first ? against(values) : std::nullopt;
    if (!second) return std::optional<Estimate>();
    const double load = values[map_load];
    return std::optional(
        Estimate{(first->value - second->value) / load, std::hypot(first->std_error, second->std_error) / load});
  };
  if (grains.runs)
    question.resolution_error = [of_pull = grains.coarser ? error_by_twins(grains) : error_by_study(map, grains),
                                 sign = map.of == ModelKind::dem ? 1.0 : -1.0](const VectorXd& values) {
      const std::optional<Estimate> error = of_pull(values);
      const double load = values[map_load];
      return error ? std::optional(Estimate{sign * error->value / load, error->std_error / load}) : std::nullopt;
    };
  return question;
}

std::vector<LugGain> lug_gains(const InclineMap& map, const FailureQuestion& question, const FailureMap& rows) {
  const std::vector<Factor>& factors = question.factors;
  const Factor& lugs = factors.at(map_lug_height);
  if (!(lugs.upper > lugs.lower) || map.of == ModelKind::dem) return {};
  const PullAt pull = quick_pull(map, map.of);
  std::vector<LugGain> gains;
  for (int load = 0; load < 3; ++load)
    for (int angle = 0; angle < 2; ++angle)
      for (int slip = 0; slip < 3; ++slip) {
        VectorXd high(4);
        high << level_value(factors[map_load], load, 3), lugs.upper, level_value(factors[map_angle], angle, 2),
            level_value(factors[map_slip], slip, 3);
        VectorXd low = high;
        low[map_lug_height] = lugs.lower;
        const std::optional<Estimate> with = pull(high), without = pull(low);
        if (!with || !without) continue;
        const Estimate differ_with = rows.at(question, high), differ_without = rows.at(question, low);
        const double of = (with->value - without->value) / high[map_load];
        gains.push_back({high, of,
                         Estimate{of - (differ_with.value - differ_without.value),
                                  std::hypot(differ_with.std_error, differ_without.std_error)}});
      }
  return gains;
}

double FreshCheck::sigma() const {
  if (!found) return not_a_number;
  return (found->value - predicted.value) / std::hypot(found->std_error, predicted.std_error);
}

std::vector<FreshCheck> check_fresh(const FailureQuestion& question, const FailureMap& map, int count,
                                    std::uint64_t seed) {
  constexpr std::uint64_t of_checks = 1'000'000;  // far from the seeds of designs and clouds
  const MatrixXd fresh = latin_hypercube(count, static_cast<int>(question.factors.size()), seed + of_checks);
  const double between_runs = map.surrogate->mode().hyperparameters().extra_sd;
  std::vector<FreshCheck> checks;
  for (Index i = 0; i < fresh.rows(); ++i)
    checks.push_back({from_unit(question.factors, fresh.row(i)), {}, std::nullopt});
  for (FreshCheck& check : checks) {
    question.look();
    check.predicted = map.at(question, check.values);
    check.predicted.std_error = std::hypot(check.predicted.std_error, between_runs);
    check.found = question.difference(check.values);
  }
  return checks;
}

double rms_of(const std::vector<FreshCheck>& checks) {
  double squares = 0, count = 0;
  for (const FreshCheck& check : checks)
    if (check.found) squares += std::pow(check.found->value - check.predicted.value, 2), count += 1;
  return count > 0 ? std::sqrt(squares / count) : not_a_number;
}

namespace {

/// Where the models agree: without lugs at any slip, else also up to a slip; with any lugs; and the largest box of all.
std::vector<AgreementClause> agreements(const FailureQuestion& question, FailureMap& rows, int rounds) {
  std::vector<AgreementClause> clauses;
  const auto add = [&](const std::vector<Role>& roles) {
    if (question.waits()) return true;
    if (const auto clause = agreement(question, rows, roles, 9, rounds)) clauses.push_back(*clause);
    return !clauses.empty();
  };
  if (!add({Role::limited, Role::held, Role::limited, Role::whole}))
    add({Role::limited, Role::held, Role::limited, Role::limited});
  add({Role::limited, Role::limited, Role::limited, Role::whole});
  add({Role::bounded, Role::bounded, Role::bounded, Role::bounded});
  return clauses;
}

/// Doubts of both models at the conditions that were run, with the highest lugs.
Doubts doubts_at_rows(const FailureMapResult& result) {
  Case question;
  std::vector<Eigen::VectorXd> rows;
  for (const FailureRow& row : result.map.rows) {
    rows.push_back(row.values);
    question.study.conditions.push_back(condition_at(result.asked, row.values));
  }
  if (rows.empty()) return {};
  const auto height = [](const Eigen::VectorXd& values) { return values[map_lug_height]; };
  question.scenario = scenario_at(result.asked, *std::ranges::max_element(rows, {}, height));
  for (const ModelKind kind : {result.asked.of, result.asked.against})
    if (kind == ModelKind::bekker_wong)
      question.study.models.push_back({kind, question.scenario.effects, ""});
    else if (kind == ModelKind::rft)
      question.study.models.push_back({kind, {}, ""});
  question.scenario.effects.clear();
  const std::vector<ModelAnswers> study =
      run_study(question, [&](std::size_t, std::size_t) { result.question.look(); });
  if (result.asked.of == ModelKind::dem || result.asked.against == ModelKind::dem)
    question.study.models.push_back({ModelKind::dem, {}, ""});
  return doubts(question, study);
}

}  // namespace

FailureMapResult learn_map(const InclineMap& map, const MapGrains& grains, const MapLearning& how) {
  FailureMapResult result;
  result.asked = map;
  result.question = failure_question(result.asked, grains, how.tolerance);
  result.question.look = how.look;
  result.map = map_failures(result.question, how.runs);
  if (grains.waits()) return result;
  result.clauses = agreements(result.question, result.map, how.rounds);
  if (grains.waits()) return result;
  result.checks = check_fresh(result.question, result.map, how.fresh, how.runs.seed);
  result.lug_gains = lug_gains(result.asked, result.question, result.map);
  result.by_twins = grains.coarser != nullptr;
  result.shares = shares_of(result.question, result.map);
  return result;
}

Doubts doubts_of(const FailureMapResult& result, const MapGrains& grains) {
  Doubts all = doubts_at_rows(result);
  if (result.by_twins) std::erase_if(all, [](const Doubt& one) { return one.kind == DoubtKind::coarse_grains; });
  if (const std::size_t older = grains.runs ? grains.store->of_other_engines(*grains.runs) : 0; older > 0)
    all.push_back({DoubtKind::earlier_engine, {older}});
  return all;
}

MapShares shares_of(const FailureQuestion& question, const FailureMap& map) {
  constexpr int nodes = 9;
  const std::vector<Factor>& factors = question.factors;
  std::size_t all = 1;
  for (std::size_t j = 0; j < factors.size(); ++j) all *= nodes;
  std::size_t beyond = 0;
  std::array<std::size_t, 3> judged{};  // by Judged
  for (std::size_t i = 0; i < all; ++i) {
    question.look();
    Eigen::VectorXd values(static_cast<Eigen::Index>(factors.size()));
    std::size_t rest = i;
    for (std::size_t j = 0; j < factors.size(); ++j, rest /= nodes)
      values[j] = level_value(factors[j], static_cast<int>(rest % nodes), nodes);
    beyond += std::abs(map.at(question, values).value) > question.tolerance;
    ++judged[static_cast<std::size_t>(map.judged(question, values))];
  }
  const auto share = [all](std::size_t count) { return static_cast<double>(count) / static_cast<double>(all); };
  return {share(beyond), share(judged[0]), share(judged[1]), share(judged[2])};
}

}  // namespace soilbin::compare
