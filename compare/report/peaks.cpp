#include "compare/report/peaks.hpp"

#include "compare/sweep/varying.hpp"

namespace soilbin::compare {

std::vector<Peak> peaks(const ModelAnswers& model) {
  std::vector<OperatingCondition> conditions;
  for (const Answer& answer : model.answers) conditions.push_back(answer.at);
  const Curves curves = curves_against_slip(conditions, Spread::exact);
  std::vector<Peak> found(curves.labels.size());
  for (std::size_t c = 0; c < found.size(); ++c) found[c].label = curves.labels[c];
  for (std::size_t i = 0; i < model.answers.size(); ++i) {
    Peak& peak = found[curves.curve_of[i]];
    if (!model.answers[i].result) {
      ++peak.unsolved;
      continue;
    }
    const TractionResult& r = *model.answers[i].result;
    if (!peak.pull || r.drawbar_pull.value > peak.pull->drawbar_pull.value) peak.pull = &r;
    if (!peak.last || r.at.slip > peak.last->at.slip) peak.last = &r;
    if (has_efficiency(r) && (!peak.efficiency || r.tractive_efficiency > peak.efficiency->tractive_efficiency))
      peak.efficiency = &r;
  }
  return found;
}

}  // namespace soilbin::compare
