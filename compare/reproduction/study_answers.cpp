#include "compare/reproduction/study_answers.hpp"

#include <fmt/core.h>

#include <algorithm>

#include "compare/recorded/step_pair.hpp"
#include "scenario/errors.hpp"

namespace soilbin::compare {
namespace {

/// Answers by the study's record, and remarks on it; none where there is no record.
std::vector<Answer> recorded_grains(const std::string& study, const Case& question,
                                    const std::vector<StudyRecord>& records, std::vector<std::string>& remarks) {
  std::vector<Answer> answers;
  for (const StudyRecord& one : records) {
    if (one.study != study) continue;
    std::string remark;
    answers = recorded_answers(one.record, question.study.conditions, remark);
    const std::string file = one.file.filename().string() + ": ";
    remarks.push_back(file + remark);
    for (const std::string& doubt : in_words(step_doubts(one.record))) remarks.push_back(file + doubt);
  }
  return answers;
}

}  // namespace

std::set<std::string> studies_of(const Findings& findings) {
  std::set<std::string> names;
  for (const Finding& finding : findings.all) names.insert(finding.study);
  return names;
}

void add_record(std::vector<StudyRecord>& records, StudyRecord record, const Findings& findings) {
  const std::string file = record.file.string();
  if (!studies_of(findings).contains(record.study))
    throw InputError(fmt::format("{}: no finding speaks of its study '{}'", file, record.study));
  for (const StudyRecord& other : records)
    if (other.study == record.study)
      throw InputError(fmt::format("{} and {} answer the same study '{}'\n  hint: one record a study",
                                   other.file.string(), file, record.study));
  records.push_back(std::move(record));
}

AnsweredStudies answer_studies(const Findings& findings, const std::vector<StudyRecord>& records,
                               const std::function<Case(const std::string& study)>& find_case,
                               const std::function<Progress()>& progress) {
  AnsweredStudies answered;
  for (const std::string& name : studies_of(findings)) {
    Case question = find_case(name);
    std::erase_if(question.study.models, [](const ModelChoice& c) { return c.model == ModelKind::dem; });
    std::vector<ModelAnswers> study = run_study(question, progress());
    for (const ModelAnswers& model : study)
      answered.answers.push_back({name, model.choice.label, taken_as_exact(model.answers)});
    std::vector<Answer> grains = recorded_grains(name, question, records, answered.remarks);
    if (!grains.empty()) {
      question.study.models.push_back({ModelKind::dem, {}, "dem"});
      study.push_back({question.study.models.back(), grains});
    }
    answered.doubts.add(question.study.name, question, study);
    if (grains.empty())
      for (const OperatingCondition& at : question.study.conditions) grains.push_back({at, std::nullopt, "not run"});
    answered.answers.push_back({name, "dem", std::move(grains)});
  }
  return answered;
}

}  // namespace soilbin::compare
