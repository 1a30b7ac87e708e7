// A failure map over load, lug height, angle and slip, for one kind of incline: a quick model against runs of grains,
// or two quick models. Runs are kept in a store of experiments, so that a map that was stopped goes on, and is drawn
// again without a run.
#pragma once

#include "compare/calibrate/experiment_store.hpp"
#include "compare/doubts/doubt.hpp"
#include "compare/failure_map/failure_map.hpp"
#include "scenario/case.hpp"

namespace soilbin::compare {

enum class Incline { longitudinal, transverse, yaw };
constexpr std::array<Word<Incline>, 3> words_of(std::type_identity<Incline>) {
  return {{{"longitudinal", Incline::longitudinal}, {"transverse", Incline::transverse}, {"yaw", Incline::yaw}}};
}
/// "longitudinal incline", "transverse incline", "yaw".
std::string name_of(Incline incline);

/// Where the factors of an incline's map stand.
enum MapFactor { map_load = 0, map_lug_height = 1, map_angle = 2, map_slip = 3 };

struct InclineMap {
  Scenario scenario;        ///< of its tire all but the lugs' height is kept; count and thickness are needed
  OperatingCondition base;  ///< speed, frames: what the factors don't set
  Incline incline = Incline::longitudinal;
  ModelKind of = ModelKind::bekker_wong, against = ModelKind::dem;
  std::vector<Factor> factors;  ///< by MapFactor [N], [m], [rad], [-]
};

/// The wheel and the condition at values of the factors.
Scenario scenario_at(const InclineMap& map, const Eigen::VectorXd& values);
OperatingCondition condition_at(const InclineMap& map, const Eigen::VectorXd& values);

/// What a run of grains is asked for; the first is the drawbar pull.
std::vector<Target> grain_channels();

/// Who answers for the grains of a map. What `runs` and the store have nothing for has no answer.
struct MapGrains {
  const VirtualTest* runs = nullptr;     ///< none where the map asks no grains
  const VirtualTest* coarser = nullptr;  ///< the runs with grains coarser_by times as large; none: not made
  ExperimentStore* store = nullptr;
  std::uint64_t packing = 1;  ///< seed of the bed
  bool waits() const { return (runs && runs->waits()) || (coarser && coarser->waits()); }
};

/// Drawbar pull of the map's first model (the analytic one with the scenario's effects) less that of the second, over
/// the load. The error is that of the run of grains on one packing: the soil's values are taken as declared, and the
/// scatter between packings is for the surrogate to find. The resolution error is that of the grains, by their coarser
/// twins, else by the study of grain sizes as far as that reaches. What `grains` points to must outlive the question.
/// Throws InputError for a wheel or soil that lacks what a model needs, and for two models that are one.
FailureQuestion failure_question(const InclineMap& map, const MapGrains& grains, double tolerance);

/// What lugs bring at a condition, by both models: the pull with the map's highest lugs less that with its lowest
/// [shares of the load].
struct LugGain {
  Eigen::VectorXd values;  ///< with the highest lugs
  double of = 0.0;         ///< by the map's first model, computed
  Estimate against;        ///< by the second, as the map has it; the two pulls' errors are taken as independent
};

/// At the ends and the middle of load and slip and the ends of the angle; where the first model has no answer, none.
/// Empty where the lugs do not vary or the first model is dem.
std::vector<LugGain> lug_gains(const InclineMap& map, const FailureQuestion& question, const FailureMap& rows);

/// A condition that the map had not seen when it predicted it.
struct FreshCheck {
  Eigen::VectorXd values;
  Estimate predicted;             ///< share of the load; the error that of a new run, its own left out
  std::optional<Estimate> found;  ///< nothing where either model has no answer
  double sigma() const;           ///< found less predicted over the root of both variances
};

/// Predicts and runs `count` conditions of a Latin hypercube of its own seed. The map does not learn from them.
std::vector<FreshCheck> check_fresh(const FailureQuestion& question, const FailureMap& map, int count,
                                    std::uint64_t seed);

/// Root mean square of found less predicted [share of the load]; NaN where nothing was found.
double rms_of(const std::vector<FreshCheck>& checks);

// A failure map learnt, with all that is to be said of it: where the models agree, how well the map knows, what there
// is to doubt. telling/failure_map_report.cpp tells it.
//
//   const FailureMapResult result = learn_map(map, {&runs, &coarser, &store}, {.tolerance = 0.1});
//   for (const AgreementClause& clause : result.clauses) clause.lower, clause.upper;

/// Shares of the box, over a grid of 9 nodes a factor.
struct MapShares {
  double beyond = 0.0;                                ///< |difference| is above the tolerance, by the map's own value
  double agree = 0.0, differ = 0.0, undecided = 0.0;  ///< FailureMap::judged
};

/// A map and what was found with it.
struct FailureMapResult {
  InclineMap asked;
  FailureQuestion question;
  FailureMap map;
  std::vector<AgreementClause> clauses;  ///< where the models agree
  std::vector<FreshCheck> checks;
  std::vector<LugGain> lug_gains;
  MapShares shares;
  bool by_twins = false;  ///< whether the resolution errors are the map's own
};

/// How a map is learnt.
struct MapLearning {
  FailureMapOptions runs{};            ///< which conditions are run
  int rounds = 4;                      ///< further runs for each clause (agreement)
  int fresh = 0;                       ///< conditions that are predicted, then run (check_fresh)
  double tolerance = 0.10;             ///< share of the load beyond which the models count as different
  std::function<void()> look = [] {};  ///< FailureQuestion::look
};

/// Throws what map_failures throws. Where `grains` waits for experiments, the result is not finished. What `grains`
/// points to must outlive the result.
FailureMapResult learn_map(const InclineMap& map, const MapGrains& grains, const MapLearning& how);

/// Doubts of both models' answers where they were run, and of runs that the store took from an earlier engine. Coarse
/// grains are no doubt where twins tell what they do.
Doubts doubts_of(const FailureMapResult& result, const MapGrains& grains);

MapShares shares_of(const FailureQuestion& question, const FailureMap& map);

}  // namespace soilbin::compare
