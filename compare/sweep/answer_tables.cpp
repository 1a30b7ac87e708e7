#include "compare/sweep/answer_tables.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "compare/measured/channels.hpp"
#include "compare/report/number_text.hpp"
#include "compare/report/table.hpp"
#include "compare/sweep/varying.hpp"
#include "scenario/nearest_word.hpp"
#include "scenario/unit.hpp"

namespace soilbin::compare {
namespace {

std::vector<OperatingCondition> conditions_answered(const std::vector<Answer>& answers) {
  std::vector<OperatingCondition> all;
  for (const Answer& answer : answers) all.push_back(answer.at);
  return all;
}

bool any_side_force(const std::vector<ModelAnswers>& study) {
  for (const ModelAnswers& model : study)
    for (const Answer& answer : model.answers)
      if (answer.result && answer.result->lateral_force.value != 0.0) return true;
  return false;
}

/// The places of the conditions, one curve after the other, each in its own order.
std::vector<std::size_t> curve_by_curve(const Curves& curves) {
  std::vector<std::size_t> order(curves.curve_of.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::ranges::stable_sort(order, {}, [&](std::size_t i) { return curves.curve_of[i]; });
  return order;
}

/// In percent; "-" where there is none (has_efficiency).
std::string efficiency_in_percent(const TractionResult& result) {
  return has_efficiency(result) ? number(100 * result.tractive_efficiency) : "-";
}

/// Why a pull of the analytic model at 0 % slip on the level is not 0, which readers expect; "" where there is none.
std::string pull_without_slip(const ModelAnswers& model) {
  const bool there =
      model.choice.model == ModelKind::bekker_wong && std::ranges::any_of(model.answers, [](const Answer& answer) {
        return answer.result && std::abs(answer.at.slip) < 1e-9 && answer.at.longitudinal_incline == 0.0;
      });
  return there ? "At 0 % slip (v = r ω) the soil is still compacted and sheared along the contact, so the pull is not "
                 "0.\n"
               : "";
}

}  // namespace

std::vector<PrintedValue> printed_values(const TractionResult& r) {
  std::vector<PrintedValue> all;
  for (const ChannelView& channel : channel_views)
    all.push_back(
        {capital(std::string(channel.title)), number(r.*channel.predicted, channel.per_si), std::string(channel.unit)});
  const std::string none = why_no_efficiency(r);
  all.push_back(
      {"Tractive efficiency", none.empty() ? efficiency_in_percent(r) : "none: " + none, none.empty() ? "%" : ""});
  all.push_back({"Contact",
                 fmt::format("entry {:.1f} deg, peak stress {:.1f} deg, exit {:.1f} deg", r.entry_angle / degree,
                             r.max_stress_angle / degree, r.exit_angle / degree + 0.0),
                 ""});
  std::string sum;
  for (const Contribution& part : r.budget) {
    const std::string sign = sum.empty() ? (part.force < 0 ? "-" : "") : (part.force < 0 ? " - " : " + ");
    sum += fmt::format("{}{} N ({})", sign, number(std::abs(part.force)), spaced(part.name));
  }
  if (const BudgetRest& rest = r.budget_rest; std::abs(rest.force) > 1e-9 * r.at.load)
    sum +=
        fmt::format("; {} N unexplained{}", number(rest.force),
                    std::isfinite(rest.bound) ? fmt::format(" (sampling error: up to {} N)", number(rest.bound)) : "");
  all.push_back({"Drawbar pull is", sum, ""});
  if (!r.without_error_of.empty())
    all.push_back(
        {"Standard errors",
         fmt::format("leave out the soil's {}: the results have no derivative by it here", listed(r.without_error_of)),
         ""});
  return all;
}

std::string answer_text(const ModelAnswers& model, const Answer& answer) {
  std::string text = fmt::format("{}: {}\n", model.choice.label, in_words(answer.at));
  if (!answer.result) return text + "  no solution: " + answer.error + "\n";
  text += "\n";
  for (const PrintedValue& one : printed_values(*answer.result))
    text += fmt::format("  {:<21}{}{}{}\n", one.name, one.value, one.unit.empty() ? "" : " ", one.unit);
  return text + pull_without_slip({model.choice, {answer}, {}});
}

std::string study_text(const std::vector<ModelAnswers>& study) {
  const bool side = any_side_force(study);
  std::string text;
  for (const ModelAnswers& model : study) {
    const Curves curves = curves_against_slip(conditions_answered(model.answers), Spread::exact);
    std::vector<std::string> header;
    if (!curves.varying.empty()) header.push_back(curves.varying);
    header.push_back("slip [%]");
    for (std::size_t c = 0; c < channel_views.size(); ++c)
      if (side || !channel_views[c].sideways)
        header.push_back(heading(std::string(channel_views[c].title), std::string(channel_views[c].unit)));
    header.push_back("efficiency [%]");
    Table table{"", header};
    std::string notes;
    for (const std::size_t i : curve_by_curve(curves)) {
      const Answer& answer = model.answers[i];
      std::vector<TableCell> row;
      if (!curves.varying.empty()) row.push_back(curves.labels[curves.curve_of[i]]);
      row.push_back(fmt::format("{:.4g}", 100 * answer.at.slip));
      for (const ChannelView& channel : channel_views)
        if (side || !channel.sideways)
          row.push_back(answer.result ? number((*answer.result).*channel.predicted, channel.per_si) : "-");
      row.push_back(answer.result ? efficiency_in_percent(*answer.result) : "-");
      table.add(std::move(row));
      if (!answer.result) notes += fmt::format("no solution at {}: {}\n", in_words(answer.at), answer.error);
    }
    text += (text.empty() ? "" : "\n") + model.choice.label + "\n" + as_text(table) + notes;
  }
  return study.empty() ? text : text + pull_without_slip(study.front());
}

}  // namespace soilbin::compare
