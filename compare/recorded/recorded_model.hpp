// Models that answer by runs on several packings of a bed: run now, taken from a record, or both.
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

/// The run of a condition on a packing. A condition without solution is a run whose answer carries the error; what is
/// refused is an InputError.
using RunOnce = std::function<RecordedRun(const Scenario&, const OperatingCondition&, std::uint64_t packing)>;

/// Gets every run behind an answer, before the model's evaluate returns.
using RunListener = std::function<void(const RecordedRun&)>;

/// Takes a run from the file where it is there, else runs it and adds it at once. `empty` is the record that the file
/// is begun with. Throws InputError where the file's inputs differ.
RunOnce kept_in(const std::filesystem::path& file, Record empty, RunOnce run, RunList list = &Record::runs,
                Writers writers = Writers::several);

/// Mean of the estimates of packings, at least one. The standard error is the scatter between packings over the root of
/// their number or, where that is larger, what their own errors give: with two or three packings the scatter is poorly
/// known.
Estimate mean_over_packings(const std::vector<Estimate>& packings);

/// Degrees of freedom of that standard error: packings beyond the first where it is their scatter, else infinite.
double freedom_over_packings(const std::vector<Estimate>& packings);

/// Several packings' answers to one condition as one: mean_over_packings of the four results; mean_efficiency; means
/// of stresses and budget.
/// Throws NoSolution where a run has no result, and InputError for no runs.
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

/// Of runs at any conditions; nothing where none has several packings or the runs state no error.
std::optional<PackingScatter> packing_scatter(const std::vector<RecordedRun>& runs, Estimate TractionResult::*channel);

/// Its factor, of a record; no value with less than four degrees of freedom.
std::optional<double> packing_factor(const Record& record, Estimate TractionResult::*channel);

/// Runs each condition on every packing.
class RunOnPackings : public Model {
 public:
  RunOnPackings(std::string name, std::vector<std::uint64_t> packings, RunOnce run, RunListener on_run = {})
      : name_(std::move(name)), packings_(std::move(packings)), run_(std::move(run)), on_run_(std::move(on_run)) {}

  std::string name() const override { return name_; }
  /// Throws what mean_of_packings and the run throw.
  TractionResult evaluate(const Scenario& scenario, const OperatingCondition& at) const override;

 private:
  std::string name_;
  std::vector<std::uint64_t> packings_;
  RunOnce run_;
  RunListener on_run_;
};

/// Answers from a record alone. The scenario isn't looked at: refuse_other_inputs says whether it is the record's.
class RecordedModel : public Model {
 public:
  explicit RecordedModel(Record record, RunListener on_run = {})
      : record_(std::move(record)), on_run_(std::move(on_run)) {}

  std::string name() const override { return record_.model; }
  const Record& record() const { return record_; }
  /// The runs of a condition, on all packings there are.
  std::vector<const RecordedRun*> runs(const OperatingCondition& at) const;
  /// Their mean_of_packings. Throws NoSolution where the condition isn't in the record, and says so.
  TractionResult evaluate(const Scenario& scenario, const OperatingCondition& at) const override;

 private:
  Record record_;
  RunListener on_run_;
};

}  // namespace soilbin::compare
