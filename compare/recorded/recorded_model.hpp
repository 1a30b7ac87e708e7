// Models that answer by runs on several packings of a bed: of a record, or of whoever makes them.
//
//   const RecordedModel grains(read_record("cases/studies/recorded/paper-straight.json"));
//   const OperatingCondition at = grains.record().runs.front().answer.at;
//   grains.evaluate(scenario, at).drawbar_pull.value  // [N], mean over packings; NoSolution for another condition
#pragma once

#include <array>
#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "compare/recorded/record.hpp"
#include "compare/recorded/step_pair.hpp"
#include "scenario/traction_channels.hpp"

namespace soilbin::compare {

/// Mean of the estimates of packings, at least one. The standard error is the scatter between packings over the root of
/// their number or, where that is larger, what their own errors give: with two or three packings the scatter is poorly
/// known.
Estimate mean_over_packings(const std::vector<Estimate>& packings);

/// Degrees of freedom of that standard error: packings beyond the first where it is their scatter, else infinite.
double freedom_over_packings(const std::vector<Estimate>& packings);

/// Several packings' answers to one condition as one: mean_over_packings of the four results; mean_efficiency; means
/// of stresses and budget.
/// Of those with a result: one that was stopped leaves the others' answer. Throws NoSolution where none has one, and
/// InputError for no runs.
TractionResult mean_of_packings(const std::vector<const RecordedRun*>& runs);

/// Mean variance of a single run's mean by its own error, of a channel; all runs have results.
double own_variance(const std::vector<const RecordedRun*>& runs, Estimate TractionResult::*channel);

/// Standard deviation between packings, of a channel of TractionResult; 0 for less than two runs with results.
double scatter_between(const std::vector<const RecordedRun*>& runs, Estimate TractionResult::*channel);

/// How much further packings scatter than the errors of single runs tell, for a channel: the root of their pooled
/// variance ratio over all conditions that have several packings.
struct PackingScatter {
  double factor = 1.0;
  double freedom = 0.0;  ///< packings beyond the first of each condition
};

/// The scatter of runs at any conditions; nothing where none has several packings or the runs state no error.
std::optional<PackingScatter> packing_scatter(const std::vector<RecordedRun>& runs, Estimate TractionResult::*channel);

/// The factor of that scatter in a record; no value with less than four degrees of freedom.
std::optional<double> packing_factor(const Record& record, Estimate TractionResult::*channel);

/// packing_scatter's factor where the runs themselves tell none: 1, and of the sinkage 2 where there are early errors
/// (RecordedRun) among them. With these the paper's tire scattered 2.0 times as much as its runs told, over 46
/// conditions on five packings each; pull, torque and lateral force 1.0 times, as the sinkage does since
/// (docs/lab/soil-bin.md, "How well a run knows its sinkage").
double usual_packing_factor(const std::vector<RecordedRun>& runs, Estimate TractionResult::*channel);

/// By which factor the errors that runs are told with are larger than their own, for each channel; 1 at least. It is
/// that of packing_scatter, with its freedom; where that rests on less than four degrees of freedom, or on none, it is
/// usual_packing_factor at least.
using ToldScatter = std::array<PackingScatter, traction_channels.size()>;
ToldScatter told_scatter(const std::vector<RecordedRun>& runs);

/// The standard deviation of one run about the mean of all that could have been made, and the degrees of freedom behind
/// it: the root of own_variance times the factor, or what they scatter by where they state no error, or are five and
/// more and that is larger. `runs`: of one condition, at least one, all with results.
struct RunScatter {
  double deviation = 0.0, freedom = 0.0;
};
RunScatter scatter_of_a_run(const std::vector<const RecordedRun*>& runs, const ToldScatter& told, std::size_t channel);

/// mean_of_packings, with standard errors of scatter_of_a_run over the root of the number of runs with a result.
TractionResult told_answer(const std::vector<const RecordedRun*>& runs, const ToldScatter& told);

/// Answers each condition by its runs on several packings, which are made, or found in a store. What a run refuses is
/// an InputError.
class RunOnPackings : public Model {
 public:
  using Run = std::function<RecordedRun(const Scenario&, const RunSpec&)>;
  RunOnPackings(std::string name, std::vector<std::uint64_t> packings, Run run)
      : name_(std::move(name)), packings_(std::move(packings)), run_(std::move(run)) {}

  std::string name() const override { return name_; }
  /// Throws what mean_of_packings and the run throw.
  TractionResult evaluate(const Scenario& scenario, const OperatingCondition& at) const override;

 private:
  std::string name_;
  std::vector<std::uint64_t> packings_;
  Run run_;
};

/// Answers from a record alone. The scenario isn't looked at: refuse_other_inputs says whether it is the record's.
class RecordedModel : public Model {
 public:
  explicit RecordedModel(Record record) : record_(std::move(record)), told_(told_scatter(record_.runs)) {}

  std::string name() const override { return record_.model; }
  const Record& record() const { return record_; }
  /// The runs of a condition, on all packings there are.
  std::vector<const RecordedRun*> runs(const OperatingCondition& at) const;
  /// The told_answer of a condition's runs. Throws NoSolution where the record has none.
  TractionResult evaluate(const Scenario& scenario, const OperatingCondition& at) const override;

 private:
  Record record_;
  ToldScatter told_;
};

}  // namespace soilbin::compare
