// The sheets of plots that studies and campaigns are shown by.
#pragma once

#include "compare/report/plot.hpp"
#include "compare/sweep/answers.hpp"
#include "compare/sweep/prediction.hpp"
#include "compare/sweep/varying.hpp"

namespace soilbin::compare {

/// Answers along one curve, of a side or a model.
struct LabelledAnswers {
  std::string label;
  const std::vector<Answer>& answers;
};

/// Whether a panel stands there whose values are all zero.
enum class Panels { nonzero, all };

/// The answers as a plot for people shows them: the models called in words, and the analytic one, which costs little,
/// along many places of each curve.
std::vector<ModelAnswers> smoothed_for_plot(const Case& question, std::vector<ModelAnswers> study,
                                            const ConditionView& abscissa = slip_view());

/// Drawbar pull, torque, sinkage, tractive efficiency (and the lateral force where there is one) against slip or what
/// else curves are to run over: a colour for each combination of the other conditions, a dash for each model; with up
/// to five curves also error bands, else those of the first model where it has up to five. Every model's answers are of
/// the question's curves, at its slips or others.
Sheet study_sheet(const Case& question, const std::vector<ModelAnswers>& study, Panels panels = Panels::nonzero,
                  const ConditionView& abscissa = slip_view());

/// The two together, over what the question's curves run over (curves_run_over; slip where there is none).
Sheet plot_of_study(const Case& question, const std::vector<ModelAnswers>& study);

/// The parts of the drawbar pull piled up against slip, those that drive above zero and those that hold back below it,
/// and their sum as a line. A panel for each of the answers, which are of one curve each.
Sheet budget_sheet(const std::string& title, const std::vector<LabelledAnswers>& curves);

/// Stresses under one wheel, of a side or a model.
struct LabelledPatch {
  std::string label;
  int color = 0;
  const std::vector<StressSample>& patch;
};

/// sigma and tau along the contact, a series for each patch that holds samples; no plots where none does.
Sheet patch_sheet(const std::string& title, const std::vector<LabelledPatch>& patches);

/// Each measured channel against slip: measured runs as points, predictions as lines through their setpoints' means.
Sheet campaign_sheet(const Campaign& campaign, const Prediction& prediction);

/// Predicted against measured, a panel for each measured channel.
Sheet scatter_sheet(const Campaign& campaign, const Prediction& prediction);

}  // namespace soilbin::compare
