// A study answered: which of its models are asked, each one's answers, by grains too, what is doubtful in them, and the
// grains' time step.
//
//   choose_models(question.study, ModelKind::dem, false);
//   const StudyResults results = answer_study(question, question, {.settings = settings, .packings = 3}, effects);
//   fmt::print("{}", json_text(to_json(question, results)));
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "compare/discrepancy/side.hpp"
#include "compare/experiments/soil_bin_runs.hpp"
#include "compare/report/json_fields.hpp"
#include "compare/sweep/result_json.hpp"

namespace soilbin::compare {

/// Which models a study asks: `only` those of that kind, where it is given; else its own, and with a record grains too.
void choose_models(Study& study, std::optional<ModelKind> only, bool recorded);

/// The grains of a question are moved by LAMMPS: answers carry its name. Throws InputError for grains that aren't
/// spheres.
void name_lammps(Case& question);

/// Who answers for grains: runs in the soil bin or, in their place, a record.
struct StudyGrains {
  dem::DemSettings settings{};
  int packings = 1;
  RunKeeping keeping{};
  std::vector<RunSpec> list{};            ///< of a record that is kept, or with twins: its runs, made in this order
  std::optional<NamedRecord> recorded{};  ///< answers without a run
};

struct StudyResults {
  std::vector<ModelAnswers> study{};
  Doubts doubts{};
  Doubts of_runs{};                         ///< of grains: what their runs say of themselves
  std::optional<dem::StepCriteria> step{};  ///< of grains (step_of)
  std::vector<RecordedRun> runs{};          ///< behind the grains' answers, in the order in which they came
  std::vector<RecordedRun> coarser{};       ///< of these, as far as there are any
};

/// Every model of the question at every condition, and what is doubtful in the answers; the step is left to step_of.
/// A run that the engine had to stop is an answer without solution, with what it said. `before`: each run of the list.
/// A record that is begun keeps `whole`: the question with all its conditions. Throws what DemModel::check throws.
StudyResults answer_study(const Case& question, const Case& whole, const StudyGrains& grains,
                          const EffectVocabulary& effects, const Watch& watch = {}, const Progress& progress = {});

/// The grains of a question as a side of a comparison, and the runs behind it.
struct GrainSideRuns {
  GrainSide grains;
  std::vector<RecordedRun> runs{};
};
GrainSideRuns run_grain_side(const Case& question, const StudyGrains& grains, const EffectVocabulary& effects,
                             const Progress& progress = {});

/// remarks_about, and of grains what their runs say of themselves: not steady, one packing. The scenario must outlive
/// it.
Remark remarks_about(const Scenario& scenario, const StudyResults& results);

/// soilbin-run/1; answers of grains with packings, steady, drift and remark of their runs, and with what the size of
/// their grains does to them.
Json to_json(const Case& question, const StudyResults& results);

}  // namespace soilbin::compare
