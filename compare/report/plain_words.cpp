#include <fmt/core.h>

#include <cmath>

#include "compare/report/analysis_page.hpp"
#include "compare/report/number_text.hpp"
#include "compare/report/peaks.hpp"

namespace soilbin::compare {
namespace {

std::string force(double newton) {
  return std::abs(newton) >= 1000.0 ? fmt::format("{:.3g} kN", newton / 1000) : fmt::format("{:.3g} N", newton);
}

/// "1.32 ± 0.22 kN".
std::string force(const Estimate& pull) {
  const bool kilo = std::abs(pull.value) >= 1000.0;
  return number(pull, kilo ? 1e-3 : 1.0) + (kilo ? " kN" : " N");
}

/// "The most it can pull rises from 817 N (2 kN) to 2.06 kN (8 kN)."
std::string change(const Peak& first, const Peak& last) {
  const double a = first.pull->drawbar_pull.value, b = last.pull->drawbar_pull.value;
  if (std::abs(b - a) < 0.01 * std::abs(a))
    return fmt::format("From {} to {} the most it can pull hardly changes.", first.label, last.label);
  return fmt::format("The most it can pull {} from {} ({}) to {} ({}){}.", b > a ? "rises" : "falls", force(a),
                     first.label, force(b), last.label, b < 0.0 ? ", where it has to be pushed" : "");
}

std::string largest_pull(const Peak& peak) {
  const TractionResult& r = *peak.pull;
  std::string text = fmt::format("The wheel pulls at most {}{}, {:.0f} % of its load, at {:.3g} % slip",
                                 force(r.drawbar_pull), peak.label.empty() ? "" : " (" + peak.label + ")",
                                 100 * r.drawbar_pull.value / r.at.load, 100 * r.at.slip);
  if (peak.efficiency != nullptr)
    text += fmt::format("; at best {:.0f} % of its power goes into pull, at {:.3g} % slip",
                        100 * peak.efficiency->tractive_efficiency, 100 * peak.efficiency->at.slip);
  return text + ".";
}

/// What another model of the study says of the same curve.
std::string other_model(const std::string& label, const Peak& base, const Peak& other) {
  return fmt::format(
      "With {} it is {} at {:.3g} % slip, and at {:.3g} % slip the wheel sinks {:.0f} mm where the base "
      "model says {:.0f} mm.",
      label, force(other.pull->drawbar_pull.value), 100 * other.pull->at.slip, 100 * other.last->at.slip,
      1000 * other.last->sinkage.value, 1000 * base.last->sinkage.value);
}

}  // namespace

std::string in_words(const StudyPart& part) {
  if (part.study.empty()) return "";
  const std::vector<Peak> base = peaks(part.study.front());
  std::vector<std::size_t> solved;
  for (std::size_t i = 0; i < base.size(); ++i)
    if (base[i].pull != nullptr) solved.push_back(i);
  if (solved.empty()) return "No condition has a solution.";
  const std::size_t shown = solved[(solved.size() - 1) / 2];
  std::string text = largest_pull(base[shown]);
  for (std::size_t m = 1; m < part.study.size(); ++m) {
    const std::vector<Peak> other = peaks(part.study[m]);
    if (other[shown].pull != nullptr)
      text.append(" ").append(other_model(part.study[m].choice.label, base[shown], other[shown]));
  }
  if (solved.size() > 1) text.append(" ").append(change(base[solved.front()], base[solved.back()]));
  return text;
}

std::string in_words(const CampaignPart& part) {
  std::string text = "Without any fitting the model misses";
  const ChannelError* worst = nullptr;
  for (std::size_t i = 0; i < part.prediction.errors.size(); ++i) {
    const ChannelError& error = part.prediction.errors[i];
    const ChannelView& channel = channel_views[error.channel];
    text += fmt::format("{} {} by {:.3g} {} ({:.0f} % of the range measured)", i == 0 ? "" : ",", channel.title,
                        error.rmse * channel.per_si, channel.unit, 100 * error.share_of_range);
    if (worst == nullptr || error.share_of_range > worst->share_of_range) worst = &error;
  }
  text += fmt::format(", root mean square over {} runs", part.prediction.runs.size());
  if (part.prediction.unsolved > 0) text += fmt::format(", of which {} have no solution", part.prediction.unsolved);
  if (worst != nullptr) {
    const ChannelView& channel = channel_views[worst->channel];
    text += fmt::format(". Worst is {}, on average predicted {:.3g} {} too {}", channel.title,
                        std::abs(worst->bias) * channel.per_si, channel.unit, worst->bias < 0 ? "small" : "large");
  }
  return text + ".";
}

}  // namespace soilbin::compare
