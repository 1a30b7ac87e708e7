// What a run's numerical choices change: the same condition with each of them halved or doubled.
#pragma once

#include "compare/experiments/soil_bin_runs.hpp"
#include "compare/report/table.hpp"

namespace soilbin::compare {

/// A variant and its run. A bed that would be too shallow or narrow is a run whose answer says so.
struct VariantRun {
  std::string name;
  RecordedRun run;
};

/// Runs the variants of the question's only condition, the first as it is asked. With a record, each variant is kept in
/// a file of its own beside it. Throws InputError for more than one condition, and what DemModel::check throws for the
/// question as it is asked.
std::vector<VariantRun> run_variants(const dem::DemSettings& settings, const Case& question,
                                     const EffectVocabulary& effects, const RunKeeping& keeping);

/// A run that run_variants would make.
struct PlannedVariant {
  std::string name;
  bool recorded = false;
  double seconds = 0;     ///< that its run will take, as plan_of has it; its bed comes on top
  bool settles = false;   ///< its bed is not in the folder of beds
  std::string refused{};  ///< why it can't be run; "" where it can
};

/// Makes nothing but a small bed each, to learn the speed of this machine (plan_of). Throws as run_variants.
std::vector<PlannedVariant> plan_variants(const dem::DemSettings& settings, const Case& question,
                                          const RunKeeping& keeping);
/// A line for each, and the sum.
std::string plan_text(const std::vector<PlannedVariant>& plan);

/// The change that each variant makes, beside the standard error of the difference.
Table convergence_table(const std::vector<VariantRun>& runs);
/// soilbin-convergence/1.
nlohmann::ordered_json convergence_json(const std::vector<VariantRun>& runs);

}  // namespace soilbin::compare
