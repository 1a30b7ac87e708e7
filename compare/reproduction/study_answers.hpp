// What findings are tested on: every study that they speak of, answered by its analytic models and, where a record is
// given, by grains.
//
//   std::vector<StudyRecord> records;
//   add_record(records, {"paper-straight", file, read_record(file)}, findings);
//   const AnsweredStudies answered = answer_studies(findings, records, find_case);
//   const Reproduction reproduction = reproduce(findings, answered.answers);
#pragma once

#include <filesystem>
#include <functional>
#include <set>
#include <string>
#include <vector>

#include "compare/doubts/named_doubts.hpp"
#include "compare/reproduction/reproduction.hpp"

namespace soilbin::compare {

/// A record and the study that it answers: its case's name.
struct StudyRecord {
  std::string study;
  std::filesystem::path file;
  Record record;
};

/// The studies that findings speak of.
std::set<std::string> studies_of(const Findings& findings);

/// Throws InputError where no finding speaks of the record's study, and where another record answers it already.
void add_record(std::vector<StudyRecord>& records, StudyRecord record, const Findings& findings);

/// The answers, and what is to be known of them.
struct AnsweredStudies {
  std::vector<StudyAnswers> answers;
  std::vector<std::string> remarks;  ///< on errors
  NamedDoubts doubts;                ///< each with the studies that it is of
};

/// Every model's answers to every study of the findings; grains without a record are answers without result.
/// `progress`: makes one for each study.
AnsweredStudies answer_studies(
    const Findings& findings, const std::vector<StudyRecord>& records,
    const std::function<Case(const std::string& study)>& find_case,
    const std::function<Progress()>& progress = [] { return Progress(); });

}  // namespace soilbin::compare
