// Models that answer by runs on several packings of a bed: of a record, or of whoever makes them.
//
//   const RecordedModel grains(read_record("cases/studies/recorded/paper-straight.json"));
//   const OperatingCondition at = grains.record().runs.front().answer.at;
//   grains.evaluate(scenario, at).drawbar_pull.value  // [N], mean over packings; NoSolution for another condition
#pragma once

#include <functional>
#include <optional>

#include "compare/recorded/record.hpp"
#include "compare/recorded/step_pair.hpp"

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
  explicit RecordedModel(Record record) : record_(std::move(record)) {}

  std::string name() const override { return record_.model; }
  const Record& record() const { return record_; }
  /// The runs of a condition, on all packings there are.
  std::vector<const RecordedRun*> runs(const OperatingCondition& at) const;
  /// The mean_of_packings of a condition's runs. Throws NoSolution where the record has none.
  TractionResult evaluate(const Scenario& scenario, const OperatingCondition& at) const override;

 private:
  Record record_;
};

}  // namespace soilbin::compare
