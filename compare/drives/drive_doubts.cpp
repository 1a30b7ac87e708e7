// A drive's samples as answers, to be doubted as any others.
#include "compare/doubts/doubts.hpp"
#include "compare/drives/drive_sides.hpp"

namespace soilbin::compare {
namespace {

/// How deep the wheel stood; a drive has no balance of which the rest could be told.
template <class Sample>
ModelAnswers answers_of(const ModelChoice& choice, const Drive& drive, const std::vector<Sample>& samples) {
  ModelAnswers answers{choice, {}};
  for (const Sample& sample : samples) {
    OperatingCondition at;
    at.load = drive.load, at.pass = drive.pass, at.speed = sample.speed;
    at.slip = sample.slip.value_or(0.0), at.longitudinal_incline = sample.longitudinal_incline;
    TractionResult result;
    result.at = at;
    result.sinkage.value = sample.sinkage;
    result.tractive_efficiency = result.entry_angle = result.exit_angle = result.max_stress_angle = not_a_number;
    answers.answers.push_back({at, result, ""});
  }
  return answers;
}

std::vector<std::string> doubts_of(Case question, const std::vector<ModelAnswers>& study) {
  question.study.models.clear(), question.study.conditions.clear();
  for (const ModelAnswers& model : study) {
    question.study.models.push_back(model.choice);
    for (const Answer& answer : model.answers) question.study.conditions.push_back(answer.at);
  }
  return doubts(question, study);
}

}  // namespace

std::vector<std::string> doubts(const DrivePart& part) {
  const ModelChoice wheel{ModelKind::bekker_wong, part.question.drive->effects, ""};
  return doubts_of(part.question, {answers_of(wheel, *part.question.drive, part.record.samples)});
}

std::vector<std::string> doubts(const DriveSides& drive) {
  std::vector<ModelAnswers> study;
  for (const DriveSide& side : drive.sides) {
    const bool grains = side.kind == SideKind::grains;
    const ModelChoice choice{grains ? ModelKind::dem : ModelKind::bekker_wong,
                             grains ? std::vector<EffectChoice>{} : drive.question.drive->effects, side.label};
    study.push_back(answers_of(choice, *drive.question.drive, side.samples));
  }
  return doubts_of(drive.question, study);
}

}  // namespace soilbin::compare
