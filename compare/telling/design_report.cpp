// Runs to make before any is made, as they are told; soilbin-design/1.
#include <fmt/core.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "bekker_wong/effects/titles.hpp"
#include "compare/measured/condition_views.hpp"
#include "compare/measured/run_columns.hpp"
#include "compare/report/json_fields.hpp"
#include "compare/report/number_text.hpp"
#include "compare/telling/reports.hpp"
#include "compare/test_design/planned_runs.hpp"
#include "scenario/nearest_word.hpp"

namespace soilbin::compare {
namespace {

std::string effect_name(const std::string& id) { return std::string(bekker_wong::effect_title(id).name); }

/// "slip sinkage", or what stays where nothing is taken for the effect.
std::string name_of_other(const TestDesign& design, const CandidatePair& r) {
  return r.other ? effect_name(design.effects[*r.other]) : "nothing: overlooked";
}

/// What an effect is most easily taken for.
const CandidatePair& hardest(const PlannedTest& test, std::size_t effect) {
  const CandidatePair* worst = nullptr;
  for (const CandidatePair& r : test.candidate_pairs)
    if (r.truth == effect && (!worst || r.right < worst->right)) worst = &r;
  return *worst;
}

std::string share(double value) { return fmt::format("{:.0f} %", 100 * value); }

Json row_json(const TestDesign& design, const Run& run) {
  Json row = {{"run", *run.at.run}, {"setpoint", *run.setpoint}};
  for (const std::string& name : design.varied) {
    const ConditionView& view = condition_view(name);
    const double value = view.get(run.at) * per_unit(std::string(view.column_unit));
    row[view.column] = view.whole ? Json(std::lround(value)) : Json(value);
  }
  return row;
}

/// What the plan is expected to tell, in two or three sentences.
std::vector<std::string> expectations(const TestDesign& design) {
  std::vector<std::string> sentences;
  const std::string runs = counted(design.runs.size(), "run");
  sentences.push_back(fmt::format(
      "{}{} to separate {}. An effect as large as the noise of a run is expected to be named "
      "right in {} of all cases; by a sweep of one condition at a time with as many runs in {}.",
      runs, design.made > 0 ? fmt::format(", beside {} that are made,", counted(design.made, "run")) : "",
      counted(design.effects.size(), "effect"), share(design.planned.named_right), share(design.swept.named_right)));
  std::string noise = "Noise of a run taken for that:";
  for (int c = 0; c < channel_count; ++c)
    if (design.noise[c])
      noise += fmt::format(" {} {} {},", channel_views[c].title, number(*design.noise[c] * channel_views[c].per_si),
                           channel_views[c].unit);
  noise.back() = '.';
  sentences.push_back(noise +
                      " Of two names 2 standard deviations apart the right one fits better in 84 %, 3 apart in 93 %; "
                      "an effect twice as large is twice as far from every other.");
  if (!design.not_shown.empty()) {
    std::vector<std::string> names;
    for (const std::string& id : design.not_shown) names.push_back(effect_name(id));
    sentences.push_back("Not shown by what varies here: " + listed(names) + ".");
  }
  return sentences;
}

Table planned_runs_table(const TestDesign& design) {
  MarkedTable table{"The runs, in the order in which to make them; runs of one setpoint are its re-runs",
                    {"run", "setpoint"},
                    {false, true}};
  for (const std::string& name : design.varied) {
    const ConditionView& view = condition_view(name);
    const std::string unit = own_unit(design.columns, view).first;
    table.header.push_back(heading(std::string(view.title), unit.empty() ? "-" : unit));
    table.text_columns.push_back(false);
  }
  for (const Run& run : design.runs) {
    std::vector<TableCell> row = {std::to_string(*run.at.run), *run.setpoint};
    for (const std::string& name : design.varied) {
      const ConditionView& view = condition_view(name);
      row.push_back(fmt::format("{:.6g}", view.get(run.at) * own_unit(design.columns, view).second));
    }
    table.add(std::move(row));
  }
  return table;
}

/// Each effect with what it is most easily taken for, by the plan and by the sweep.
Table pairs_table(const TestDesign& design) {
  MarkedTable table{"What each effect is most easily taken for, and how many standard deviations the two are apart",
                    {"effect", "by these runs", "apart", "by a sweep", "apart"},
                    {true, true, false, true, false}};
  for (std::size_t e = 0; e < design.effects.size(); ++e) {
    const CandidatePair &planned = hardest(design.planned, e), &swept = hardest(design.swept, e);
    table.add({effect_name(design.effects[e]), name_of_other(design, planned),
               fmt::format("{:.1f}", planned.separation), name_of_other(design, swept),
               fmt::format("{:.1f}", swept.separation)});
  }
  return table;
}

Json design_json(const TestDesign& design) {
  Json rows = Json::array(), sweep = Json::array(), pairs = Json::array(), noise = Json::object();
  for (const Run& run : design.runs) rows.push_back(row_json(design, run));
  for (std::size_t i = 0; i < design.swept.runs.size(); ++i) {
    Run run;
    run.at = design.swept.runs[i];
    run.at.run = static_cast<int>(i + 1), run.setpoint = fmt::format("W{:02d}", i + 1);
    sweep.push_back(row_json(design, run));
  }
  for (std::size_t i = 0; i < design.planned.candidate_pairs.size(); ++i) {
    const CandidatePair &r = design.planned.candidate_pairs[i], &swept = design.swept.candidate_pairs[i];
    pairs.push_back({{"effect", design.effects[r.truth]},
                     {"taken_for", r.other ? Json(design.effects[*r.other]) : Json(nullptr)},
                     {"separation_sd", finite(r.separation)},
                     {"right", finite(r.right)},
                     {"sweep_separation_sd", finite(swept.separation)},
                     {"sweep_right", finite(swept.right)}});
  }
  for (int c = 0; c < channel_count; ++c)
    if (design.noise[c]) noise[channel_views[c].name] = {{"sd", *design.noise[c]}, {"unit", channel_views[c].si_unit}};
  return {{"format", "soilbin-design/1"},
          {"campaign", design.campaign},
          {"runs", rows},
          {"named_right", finite(design.planned.named_right)},
          {"sweep", {{"runs", sweep}, {"named_right", finite(design.swept.named_right)}}},
          {"effects", design.effects},
          {"not_shown", design.not_shown},
          {"noise", noise},
          {"runs_made", design.made},
          {"pairs", pairs}};
}

}  // namespace

Report report_on(const TestDesign& design) {
  Report report{"Runs to make: " + design.campaign, "Conditions that separate effects best, before any run is made.",
                design.campaign};
  report.add(Sentences{expectations(design)});
  report.add("The runs", planned_runs_table(design));
  report.add("How far effects are apart", pairs_table(design));
  report.data = [&design] { return design_json(design); };
  report.csv = [&design] { return rows_to_fill_in(design); };
  report.csv_name = "runs";
  return report;
}

}  // namespace soilbin::compare
