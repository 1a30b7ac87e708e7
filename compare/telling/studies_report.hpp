// Studies and campaigns as they are told side by side, from the top: plain words, plots, tables, provenance.
#pragma once

#include <string>
#include <vector>

#include "compare/report/report.hpp"
#include "compare/sweep/answers.hpp"
#include "compare/sweep/prediction.hpp"

namespace soilbin::compare {

/// A study and what its models answer, at its own conditions and along its curves.
struct StudyPart {
  Case question;
  std::vector<ModelAnswers> study;
  Case curves;  ///< with_smooth_curves of the question
  std::vector<ModelAnswers> along_curves;
  std::string asked_as{};  ///< the study's name or file, as the command was given it
};

/// A campaign and what the model predicts of it, without fitting.
struct CampaignPart {
  Campaign campaign;
  Prediction prediction;
};

/// `links`: other pages, shown as cards. Studies and campaigns outlive the report.
Report report_on(const std::vector<StudyPart>& studies, const std::vector<CampaignPart>& campaigns,
                 const std::vector<PageCard>& links = {});

/// Sentences about a study, computed from its answers: the largest pull, the best efficiency, what changes them.
std::string in_words(const StudyPart& part);

/// Sentences about a campaign: how far off the predictions are, and in which direction.
std::string in_words(const CampaignPart& part);

}  // namespace soilbin::compare
