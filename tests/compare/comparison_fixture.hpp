// A comparison whose grains are made in the test: the base model's answers, moved by known amounts.
#pragma once

#include "compare/discrepancy/comparison.hpp"
#include "compare/sweep/answers.hpp"
#include "scenario/unit.hpp"

namespace soilbin::compare {

/// A 250 mm wheel on sand of known doubt, these slips at each of these loads.
inline Case sand_study(const std::vector<double>& slips, const std::vector<double>& loads = {1000}) {
  Case question;
  question.name = question.study.name = "made";
  question.scenario.tire.name = "wheel";
  question.scenario.tire.radius = 0.25;
  question.scenario.tire.width = 0.10;
  question.scenario.soil.name = "sand";
  SemiEmpiricalSoil soil;
  soil.exponent = {1.1, 0.05};
  soil.k_c = {990, 0};
  soil.k_phi = {1528e3, 150e3};
  soil.cohesion = {1040, 300};
  soil.friction_angle = {28 * degree, 1.5 * degree};
  soil.shear_modulus = {0.02, 0.005};
  soil.stress_angle_c1 = {0.18, 0.05};
  soil.stress_angle_c2 = {0.32, 0.05};
  question.scenario.soil.semi_empirical = soil;
  for (const double load : loads)
    for (const double slip : slips) {
      OperatingCondition at;
      at.load = load;
      at.slip = slip;
      question.study.conditions.push_back(at);
    }
  question.study.models = {{ModelKind::bekker_wong, {}, "bekker_wong"}};
  return question;
}

inline ModelAnswers base_answers(const Case& question) {
  return {question.study.models.front(),
          sweep(*make_model(ModelKind::bekker_wong), question.scenario, question.study.conditions)};
}

/// Runs as if grains had given them: the base model's results, the pull moved by `offset` newtons at run k, each run
/// with the standard error `own`.
inline std::vector<RecordedRun> grain_runs(const ModelAnswers& base, const std::vector<double>& offsets, double own) {
  std::vector<RecordedRun> all;
  for (const Answer& answer : base.answers)
    for (std::size_t k = 0; k < offsets.size(); ++k) {
      RecordedRun run;
      run.answer = answer;
      run.packing = k + 1;
      run.steady = true;
      run.drift = 0.5;
      run.answer.result->drawbar_pull = {run.answer.result->drawbar_pull.value + offsets[k], own};
      run.answer.result->torque.std_error = 2.0;
      run.answer.result->sinkage.std_error = 1e-3;
      all.push_back(run);
    }
  return all;
}

inline Side grain_side(const ModelAnswers& base, const std::vector<double>& offsets, double own) {
  std::vector<OperatingCondition> conditions;
  for (const Answer& answer : base.answers) conditions.push_back(answer.at);
  return side_of("dem", grain_runs(base, offsets, own), conditions);
}

/// The same where enough packings have shown how far they scatter.
inline Side of_known_scatter(Side grains) {
  grains.scatter_known = true;
  return grains;
}

}  // namespace soilbin::compare
