#include "compare/experiments/study_results.hpp"

#include <fmt/format.h>

#include <filesystem>
#include <map>

#include "compare/doubts/doubts.hpp"
#include "compare/doubts/grain_resolution.hpp"
#include "compare/recorded/recorded_model.hpp"
#include "compare/sweep/varying.hpp"
#include "resistive_force/model.hpp"

namespace soilbin::compare {
namespace {

std::vector<OperatingCondition> conditions_of(const ModelAnswers& model) {
  std::vector<OperatingCondition> conditions;
  for (const Answer& answer : model.answers) conditions.push_back(answer.at);
  return conditions;
}

/// The runs of grains behind a model's answers, a point for each answer; none of another model.
std::vector<SidePoint> points_of(const ModelAnswers& model, const StudyResults& results) {
  if (model.choice.model != ModelKind::dem) return {};
  return side_of("", results.runs, conditions_of(model), results.coarser).points;
}

/// How many packings the answer is the mean of, and whether their runs became steady.
void add_runs(Json& row, const SidePoint& runs) {
  row["packings"] = runs.runs, row["steady"] = runs.unsteady == 0, row["drift"] = finite(runs.drift);
  if (!runs.doubts.empty()) row["remark"] = as_remark(runs.doubts);
}

/// rows_json, with what the runs of grains say of themselves and what the size of the grains does to their answers.
Json rows_with_runs(const Case& question, const StudyResults& results) {
  Json rows = rows_json(question.scenario.tire, results.study);
  auto row = rows.begin();
  for (const ModelAnswers& model : results.study) {
    const std::vector<SidePoint> points = points_of(model, results);
    for (std::size_t i = 0; i < model.answers.size(); ++i, ++row) {
      const Answer& answer = model.answers[i];
      if (points.empty() || !answer.result) continue;
      if (points[i].result)
        (*row)["resolution_error"] = to_json(resolution_error(question.scenario, answer.at, points[i]));
      add_runs(*row, points[i]);
    }
  }
  return rows;
}

/// What the runs of grains say of themselves, beside what the answers' notes say anyway.
Doubts doubts_of_runs(const StudyResults& results) {
  Doubts all;
  for (const ModelAnswers& model : results.study) {
    const std::vector<SidePoint> points = points_of(model, results);
    for (std::size_t i = 0; i < points.size(); ++i)
      for (Doubt doubt : points[i].doubts) {
        if (doubt.kind == DoubtKind::unsteady_runs || doubt.kind == DoubtKind::runs_without_result) continue;
        doubt.at = model.answers[i].at;
        all.push_back(std::move(doubt));
      }
  }
  return once_each(all);
}

/// The errors of the grains' answers as told_answer has them, by all runs that there are: the record's that answers,
/// or the kept one's, or those that were made.
void tell_errors(StudyResults& results, const StudyGrains& grains, const std::optional<Record>& kept) {
  const ToldScatter told = told_scatter(grains.recorded ? grains.recorded->record.runs
                                        : kept          ? kept->runs
                                                        : results.runs);
  for (ModelAnswers& model : results.study) {
    if (model.choice.model != ModelKind::dem) continue;
    for (Answer& answer : model.answers) {
      if (!answer.result) continue;
      std::vector<const RecordedRun*> runs;
      for (const RecordedRun& run : results.runs)
        if (alike(run.answer.at, answer.at)) runs.push_back(&run);
      const TractionResult with_errors = told_answer(runs, told);
      for (const ChannelView& channel : channel_views)
        ((*answer.result).*channel.predicted).std_error = (with_errors.*channel.predicted).std_error;
    }
  }
}

/// Doubts in the answers, in the record that answered for grains, and in the one that their runs are added to.
Doubts doubts_of_study(const Case& question, const StudyResults& results, const StudyGrains& grains,
                       const std::optional<Record>& kept) {
  const bool from_record = grains.recorded && asks(question.study, ModelKind::dem);
  Doubts all = doubts(question, results.study, from_record ? step_doubts(grains.recorded->record) : Doubts());
  if (kept) append(all, step_doubts(*kept));
  for (const ModelAnswers& model : results.study)
    if (const std::vector<SidePoint> points = points_of(model, results); !points.empty())
      tell_twins(all, points, conditions_of(model));
  return all;
}

}  // namespace

void choose_models(Study& study, std::optional<ModelKind> only, bool recorded) {
  if (only)
    keep_models(study, *only);
  else if (recorded && !asks(study, ModelKind::dem))
    study.models.push_back({ModelKind::dem, {}, "dem"});
}

void name_lammps(Case& question) {
  if (question.scenario.soil.granular) dem::refuse_beyond_lammps(*question.scenario.soil.granular);
  for (ModelChoice& choice : question.study.models)
    if (choice.model == ModelKind::dem) choice.label = dem::lammps_model_name;
}

namespace {

/// Throws InputError for a run without end, which would keep the others from theirs. What else is wrong with a
/// condition is told as its answer.
void refuse_endless_runs(const StudyGrains& grains, const Case& question) {
  const dem::DemModel model(grains.settings);
  for (const OperatingCondition& at : question.study.conditions) {
    try {
      dem::wheel_motion(at, question.scenario.tire.radius);
    } catch (const InputError&) {
      continue;
    }
    model.check(question.scenario, at);
  }
}

/// The model dem: its runs in the soil bin or, in their place, a record's. Gathers them in `runs`, in the order in
/// which they are asked for.
class Grains : public Model {
 public:
  Grains(const StudyGrains& grains, const Case& whole, const EffectVocabulary& effects, std::vector<RecordedRun>& runs)
      : grains_(grains), runs_(runs) {
    if (grains.recorded) {
      refuse_other_grains(grains.recorded->record, whole.scenario, grains.recorded->file);
      recorded_.emplace(grains.recorded->record);
      return;
    }
    dem::DemModel(grains.settings).check(whole.scenario);  // what no run could answer is no answer of each
    store_.reset(new RunStore(store_of(grains.settings, whole, effects, grains.keeping)));
    bin_ = std::make_unique<SoilBinRuns>(grains.settings, grains.keeping);
  }

  std::string name() const override { return recorded_ ? recorded_->name() : dem::model_name(grains_.settings); }
  TractionResult evaluate(const Scenario& scenario, const OperatingCondition& at) const override {
    if (recorded_) {
      for (const RecordedRun* run : recorded_->runs(at)) runs_.push_back(*run);
      return recorded_->evaluate(scenario, at);
    }
    const auto run = [&](const Scenario& of, const RunSpec& spec) {
      return runs_.emplace_back(obtain(spec, of, *store_, *bin_));
    };
    return RunOnPackings(name(), packings_from(grains_.settings, grains_.packings), run).evaluate(scenario, at);
  }
  /// The runs with coarser grains that there are.
  const std::vector<RecordedRun>& coarser() const {
    return recorded_ ? recorded_->record().coarser : store_->record().coarser;
  }
  /// Makes the runs of the list first, in its order; what a record elsewhere has is left to it.
  void make_listed(const Scenario& scenario, const Watch& watch) {
    const std::vector<RunSpec>& list = grains_.list;
    for (std::size_t k = 0; k < list.size(); ++k) {
      if (store_->knows(list[k])) continue;
      tell(watch, fmt::format("run {} of {}", k + 1, list.size()), k, list.size());
      obtain(list[k], scenario, *store_, *bin_);
    }
  }

 private:
  const StudyGrains& grains_;
  std::vector<RecordedRun>& runs_;
  std::optional<RecordedModel> recorded_;
  std::unique_ptr<RunStore> store_;  ///< it and the bin only without a record that answers
  std::unique_ptr<SoilBinRuns> bin_;
};

}  // namespace

StudyResults answer_study(const Case& question, const Case& whole, const StudyGrains& grains,
                          const EffectVocabulary& effects, const Watch& watch, const Progress& progress) {
  StudyResults results;
  if (asks(question.study, ModelKind::dem) && !grains.recorded) refuse_endless_runs(grains, question);
  results.study = run_study(question, progress, [&](ModelKind kind) -> std::unique_ptr<const Model> {
    if (const std::string& drawn = grains.settings.rig.meshing.drawn; kind == ModelKind::rft && !drawn.empty())
      return std::make_unique<resistive_force::ResistiveForce>(
          resistive_force::drawn_elements(drawn, question.scenario.tire));
    if (kind != ModelKind::dem) return make_model(kind);
    auto model = std::make_unique<Grains>(grains, whole, effects, results.runs);
    model->make_listed(whole.scenario, watch);
    results.coarser = model->coarser();
    return model;
  });
  std::optional<Record> kept;
  if (std::filesystem::exists(grains.keeping.record)) kept = read_record(grains.keeping.record);
  tell_errors(results, grains, kept);
  results.doubts = doubts_of_study(question, results, grains, kept);
  results.of_runs = doubts_of_runs(results);
  return results;
}

GrainSideRuns run_grain_side(const Case& question, const StudyGrains& grains, const EffectVocabulary& effects,
                             const Progress& progress) {
  GrainSideRuns of;
  if (!grains.recorded) refuse_endless_runs(grains, question);
  Grains model(grains, question, effects, of.runs);
  model.make_listed(question.scenario, {});
  sweep(model, question.scenario, question.study.conditions, progress);
  of.grains = grain_side(of.runs, question.study.conditions,
                         grains.recorded ? grains.recorded->file : grains.keeping.record, model.coarser());
  return of;
}

Remark remarks_about(const Scenario& scenario, const StudyResults& results) {
  std::map<OperatingCondition, std::string> of_runs;
  for (const ModelAnswers& model : results.study) {
    const std::vector<SidePoint> points = points_of(model, results);
    for (std::size_t i = 0; i < points.size(); ++i)
      if (points[i].result) of_runs[model.answers[i].at] = as_remark(points[i].doubts);
  }
  return [remark = remarks_about(scenario), of_runs](const ModelChoice& model, const Answer& answer) {
    const std::string of_answer = remark(model, answer);
    const auto runs = of_runs.find(answer.at);
    if (model.model != ModelKind::dem || runs == of_runs.end()) return of_answer;
    return of_answer + (of_answer.empty() || runs->second.empty() ? "" : "; ") + runs->second;
  };
}

Json to_json(const Case& question, const StudyResults& results) {
  Json document = run_json(question, rows_with_runs(question, results));
  add_warnings(document, results.doubts);
  if (results.step) document["dem"] = to_json(*results.step);
  return document;
}

}  // namespace soilbin::compare
