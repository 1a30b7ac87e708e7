// A comparison as data: soilbin-compare/1, and its rows as CSV.
#include <fmt/core.h>

#include "compare/discrepancy/comparison.hpp"
#include "compare/doubts/doubts.hpp"
#include "compare/report/json_fields.hpp"
#include "compare/report/number_text.hpp"
#include "compare/sweep/answers.hpp"
#include "compare/sweep/result_json.hpp"
#include "compare/sweep/varying.hpp"
#include "compare/telling/comparison_report.hpp"
#include "compare/telling/loop_report.hpp"
#include "scenario/csv.hpp"
#include "scenario/mapping_writer.hpp"

namespace soilbin::compare {
namespace {

Json side_json(const Side& side, const Case& question) {
  const std::vector<OperatingCondition>& conditions = question.study.conditions;
  Json json = {{"label", side.label}, {"kind", std::string(word_of(side.kind))}, {"points", Json::array()}};
  for (std::size_t i = 0; i < side.points.size(); ++i) {
    const SidePoint& point = side.points[i];
    Json one = to_json(Answer{conditions[i], point.result, point.error});
    one["runs"] = point.runs;
    for (std::size_t c = 0; c < channel_views.size(); ++c)
      one["scatter"][std::string(channel_views[c].name)] = finite(point.scatter[c]);
    one["doubts"] = in_words(point.doubts);
    if (side.kind == SideKind::grains && point.result)
      one["resolution_error"] = to_json(resolution_error(question.scenario, conditions[i], point));
    json["points"].push_back(std::move(one));
  }
  return json;
}

Json difference_json(const Comparison& comparison, const Difference& d) {
  return {{"side", comparison.sides[d.side].label},
          {"reference", comparison.sides[d.reference].label},
          {"channel", channel_views[d.channel].name},
          {"condition", d.condition},
          {"value", estimate_json(d.value)},
          {"reference_value", estimate_json(d.reference_value)},
          {"scatter", finite(d.scatter)},
          {"difference", finite(d.difference)},
          {"std_error", finite(d.std_error)},
          {"freedom", finite(d.freedom)},
          {"share_of_load", finite(d.share)},
          {"sigma", finite(d.sigma)},
          {"finding", word(d.finding)}};
}

Json tally_json(const Comparison& comparison, const Tally& t) {
  return {{"side", comparison.sides[t.side].label},
          {"reference", comparison.sides[t.reference].label},
          {"channel", channel_views[t.channel].name},
          {"values", t.values},
          {"differ", t.differ},
          {"within_scatter", t.in_scatter},
          {"within_errors", t.in_errors},
          {"not_judged", t.unknown},
          {"bias", finite(t.bias)},
          {"rms", finite(t.rms)},
          {"rms_share", finite(t.rms_share)},
          {"expected_rms", finite(t.expected_rms)},
          {"worst_row", t.worst}};
}

/// What is doubtful in the two points of a row.
std::string remarks_of(const Comparison& comparison, const Difference& d) {
  std::string text;
  const OperatingCondition& at = comparison.question.study.conditions[d.condition];
  for (const std::size_t s : {d.side, d.reference}) {
    const Side& side = comparison.sides[s];
    const SidePoint& point = side.points[d.condition];
    std::vector<std::string> remarks = in_words(point.doubts);
    if (side.choice)
      if (std::string one = remark_on(comparison.question.scenario, *side.choice, {at, point.result, ""}); !one.empty())
        remarks.push_back(std::move(one));
    for (const std::string& remark : remarks)
      text += fmt::format("{}{}: {}", text.empty() ? "" : "; ", side.label, remark);
  }
  return text;
}

}  // namespace

Json comparison_json(const Comparison& comparison, const ComparisonAbout& about) {
  const Study& study = comparison.question.study;
  Json json = {{"format", "soilbin-compare/1"}, {"study", study.name}, {"summary", Json::array()}};
  for (const Clause& clause : summary(comparison, about.loop ? &*about.loop : nullptr)) {
    Json evidence = Json::array();
    for (const ClauseEvidence one : clause.evidence) evidence.push_back(word(one));
    json["summary"].push_back(
        {{"about", clause.about}, {"text", clause.text}, {"rows", clause.rows}, {"evidence", std::move(evidence)}});
  }
  json["sides"] = json["rows"] = json["tallies"] = json["joint_tests"] = Json::array();
  for (const Side& side : comparison.sides) json["sides"].push_back(side_json(side, comparison.question));
  for (const Difference& d : comparison.differences) json["rows"].push_back(difference_json(comparison, d));
  for (const Tally& t : comparison.tallies) json["tallies"].push_back(tally_json(comparison, t));
  for (const JointTest& test : comparison.joint)
    json["joint_tests"].push_back({{"side", comparison.sides[test.side].label},
                                   {"reference", comparison.sides[test.reference].label},
                                   {"values", test.values},
                                   {"chi2", finite(test.chi2)},
                                   {"freedom", finite(test.freedom)},
                                   {"chi2_soil_exact", finite(test.chi2_soil_exact)},
                                   {"p_value", finite(test.p_value)},
                                   {"p_errors_known", finite(test.p_errors_known)},
                                   {"soil", test.soil}});
  if (about.loop) json["loop"] = to_json(about.loop->answer);
  for (const auto& [name, value] : about.facts) json["facts"][name] = value;
  for (const auto& [name, value] : about.versions) json["versions"][name] = value;
  json["command"] = about.command;
  return json;
}

std::string differences_csv(const Comparison& comparison) {
  std::string text =
      "side,reference,channel,unit,condition,value,value_se,reference_value,reference_se,scatter,difference,std_error,"
      "freedom,share_of_load,sigma,finding,remark\n";
  for (const Difference& d : comparison.differences)
    text += fmt::format(
        "{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{}\n", csv_cell(comparison.sides[d.side].label),
        csv_cell(comparison.sides[d.reference].label), channel_views[d.channel].name, channel_views[d.channel].si_unit,
        csv_cell(in_words(comparison.question.study.conditions[d.condition])), csv_number(d.value.value),
        csv_number(d.value.std_error), csv_number(d.reference_value.value), csv_number(d.reference_value.std_error),
        csv_number(d.scatter), csv_number(d.difference), csv_number(d.std_error), csv_number(d.freedom),
        csv_number(d.share), csv_number(d.sigma), word(d.finding), csv_cell(remarks_of(comparison, d)));
  return text;
}

}  // namespace soilbin::compare
