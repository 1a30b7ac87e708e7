#include "compare/reproduction/reproduction_report.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "compare/report/json_fields.hpp"
#include "compare/report/page.hpp"
#include "compare/sweep/result_json.hpp"
#include "compare/sweep/varying.hpp"
#include "scenario/mapping_writer.hpp"
#include "scenario/unit.hpp"

namespace soilbin::compare {
namespace {

std::string plain(std::string_view word) {
  std::string text(word);
  std::replace(text.begin(), text.end(), '_', ' ');
  return text;
}

/// A number along an axis, as people read it.
struct AxisScale {
  double per_si;
  const char* unit;
};

AxisScale scale_of(FindingAxis axis) {
  switch (axis) {
    case FindingAxis::load:
      return {1e-3, "kN"};
    case FindingAxis::slip:
      return {100, "%"};
    default:
      return {1 / degree, "deg"};
  }
}

bool is_place(FindingTest test) {
  return test == FindingTest::peak || test == FindingTest::lowest || test == FindingTest::peak_shift;
}

double per_si(const Finding& finding) { return is_place(finding.test) ? scale_of(finding.along).per_si : 1.0; }

std::string unit_of(const Finding& finding) {
  return is_place(finding.test) ? std::string(" ") + scale_of(finding.along).unit : "";
}

std::string where_in_words(const Where& where) {
  std::string words;
  for (const auto& [axis, range] : where) {
    const AxisScale scale = scale_of(axis);
    words += (words.empty() ? "" : ", ") + plain(word_of(axis)) + " ";
    words += range.first == range.second ? fmt::format("{:.4g} {}", scale.per_si * range.first, scale.unit)
                                         : fmt::format("{:.4g} .. {:.4g} {}", scale.per_si * range.first,
                                                       scale.per_si * range.second, scale.unit);
  }
  return words.empty() ? "everywhere" : words;
}

std::string missing_in_words(const Evidence& evidence) {
  if (evidence.missing.empty()) return "";
  std::string words = fmt::format("{} without result: ", evidence.missing.size());
  const std::size_t shown = std::min<std::size_t>(evidence.missing.size(), 3);
  for (std::size_t k = 0; k < shown; ++k) words += (k > 0 ? "; " : "") + in_words(evidence.missing[k]);
  return words + (shown < evidence.missing.size() ? "; ..." : "");
}

std::string cell(const Finding& finding, const Evidence& evidence) {
  std::string text(word_of(evidence.verdict));
  if (evidence.interval) text += ": " + interval_in_words(finding, evidence);
  return text;
}

}  // namespace

std::string claim_in_words(const Finding& finding) {
  const double scale = per_si(finding);
  const std::string unit = unit_of(finding);
  std::string words =
      fmt::format("{} of {} along {}, {}", plain(word_of(finding.test)), plain(word_of(finding.quantity)),
                  plain(word_of(finding.along)), where_in_words(finding.where));
  if (finding.compares()) words += ", against " + where_in_words(finding.against);
  if (finding.step > 0) {
    const AxisScale axis = scale_of(finding.along);
    words += fmt::format(", per {:.4g} {}", axis.per_si * finding.step, axis.unit);
  }
  words += ": ";
  if (std::isfinite(finding.at_least)) words += fmt::format("at least {:.4g}{}", scale * finding.at_least, unit);
  if (std::isfinite(finding.at_least) && std::isfinite(finding.at_most)) words += ", ";
  if (std::isfinite(finding.at_most)) words += fmt::format("at most {:.4g}{}", scale * finding.at_most, unit);
  return words;
}

std::string interval_in_words(const Finding& finding, const Evidence& evidence) {
  if (!evidence.interval) return "";
  const double scale = per_si(finding);
  const Interval& found = *evidence.interval;
  if (found.lower == found.upper) return fmt::format("{:.3g}{}", scale * found.value, unit_of(finding));
  return fmt::format("{:.3g} ({:.3g} .. {:.3g}){}", scale * found.value, scale * found.lower, scale * found.upper,
                     unit_of(finding));
}

std::string tally(const Reproduction& reproduction, std::size_t label) {
  std::string words;
  for (const Word<FindingVerdict>& verdict : words_of(std::type_identity<FindingVerdict>{})) {
    const auto count = std::count_if(reproduction.rows.begin(), reproduction.rows.end(),
                                     [&](const auto& row) { return row.evidence[label].verdict == verdict.value; });
    words += fmt::format("{}{} {}", words.empty() ? "" : ", ", count, verdict.text);
  }
  return words;
}

nlohmann::ordered_json to_json(const Reproduction& reproduction) {
  Json document = {{"format", "soilbin-reproduction/1"},
                   {"findings", reproduction.findings.name},
                   {"level", reproduction.findings.level},
                   {"remarks", reproduction.remarks},
                   {"rows", Json::array()}};
  for (const ReproducedFinding& row : reproduction.rows) {
    const Finding& finding = row.finding;
    Json answers = Json::object();
    for (std::size_t k = 0; k < row.evidence.size(); ++k) {
      const Evidence& evidence = row.evidence[k];
      Json one = {{"verdict", std::string(word_of(evidence.verdict))}};
      if (evidence.interval) {
        one["value"] = finite(evidence.interval->value);
        one["lower"] = finite(evidence.interval->lower), one["upper"] = finite(evidence.interval->upper);
      }
      one["missing"] = Json::array();
      for (const OperatingCondition& at : evidence.missing) one["missing"].push_back(to_json(at));
      answers[reproduction.labels[k]] = std::move(one);
    }
    document["rows"].push_back({{"id", finding.id},
                                {"section", finding.section},
                                {"quote", finding.quote},
                                {"study", finding.study},
                                {"test", claim_in_words(finding)},
                                {"at_least", finite(finding.at_least)},
                                {"at_most", finite(finding.at_most)},
                                {"chosen", finding.chosen},
                                {"answers", std::move(answers)}});
  }
  return document;
}

std::string reproduction_page(const Reproduction& reproduction, const PageAbout& about) {
  Page page(about.title, reproduction.findings.source);
  std::vector<std::pair<std::string, std::string>> sentences;
  for (std::size_t k = 0; k < reproduction.labels.size(); ++k)
    sentences.emplace_back(reproduction.labels[k], tally(reproduction, k));
  page.summary(sentences);
  page.doubts(about.doubts);
  page.paragraph(fmt::format(
      "Each finding is a statistic with its {:.0f} % interval: shown where the whole interval lies in what is claimed, "
      "contradicted where none of it does, not shown between. The analytic model's answers are exact: an interval of "
      "one "
      "value.",
      100 * reproduction.findings.level));
  page.list(reproduction.remarks);
  std::string section;
  for (const ReproducedFinding& row : reproduction.rows) {
    const Finding& finding = row.finding;
    if (finding.section != section) page.section("Section " + (section = finding.section));
    page.subsection(finding.id);
    page.paragraph("\u201c" + finding.quote + "\u201d");
    HtmlTable table{claim_in_words(finding), {"answers of", "verdict", "conditions missing"}, {}, {true, true, true}};
    for (std::size_t k = 0; k < row.evidence.size(); ++k)
      table.rows.push_back({reproduction.labels[k], cell(finding, row.evidence[k]), missing_in_words(row.evidence[k])});
    page.table(table);
    if (!finding.chosen.empty()) page.paragraph("Chosen here: " + finding.chosen);
  }
  page.section("How this page was made");
  page.code(about.command);
  return page.html();
}

}  // namespace soilbin::compare
