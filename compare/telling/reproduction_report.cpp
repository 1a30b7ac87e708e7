// A reproduction as it is told; soilbin-reproduction/1.
#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "compare/report/json_fields.hpp"
#include "compare/report/number_text.hpp"
#include "compare/reproduction/reproduction.hpp"
#include "compare/sweep/answers.hpp"
#include "compare/sweep/result_json.hpp"
#include "compare/sweep/varying.hpp"
#include "compare/telling/reports.hpp"
#include "scenario/mapping_writer.hpp"
#include "scenario/unit.hpp"

namespace soilbin::compare {
namespace {

/// A number along an axis or of a quantity, as people read it.
struct Scale {
  double per_si;
  const char* unit;
};

Scale scale_of(FindingAxis axis) {
  if (axis == FindingAxis::load) return {1e-3, "kN"};
  return axis == FindingAxis::slip ? Scale{100, "%"} : Scale{1 / degree, "deg"};
}

Scale scale_of(FindingQuantity quantity) {
  if (quantity == FindingQuantity::drawbar_pull) return {1, "N"};
  if (quantity == FindingQuantity::torque) return {1, "N m"};
  return quantity == FindingQuantity::sinkage ? Scale{1e3, "mm"} : Scale{100, "%"};
}

/// Its title; where it has none, "Uphill pull falls" of "uphill-pull-falls".
std::string title_of(const Finding& finding) {
  if (!finding.title.empty()) return finding.title;
  std::string words = finding.id;
  std::ranges::replace(words, '-', ' ');
  return capital(std::move(words));
}

std::string finding_anchor(const std::string& id) { return "finding-" + id; }

TableCell verdict_cell(FindingVerdict verdict, const std::string& id) {
  if (verdict == FindingVerdict::no_data) return "-";
  const auto [word, tone] = verdict == FindingVerdict::shown          ? std::pair{"shown", Tone::good}
                            : verdict == FindingVerdict::contradicted ? std::pair{"contradicted", Tone::bad}
                                                                      : std::pair{"open", Tone::open};
  return {word, "", tone, finding_anchor(id)};
}

bool is_place(FindingTest test) {
  return test == FindingTest::peak || test == FindingTest::lowest || test == FindingTest::peak_shift;
}

double per_si(const Finding& finding) { return is_place(finding.test) ? scale_of(finding.along).per_si : 1.0; }

std::string unit_of(const Finding& finding) {
  return is_place(finding.test) ? std::string(" ") + scale_of(finding.along).unit : "";
}

/// What a statistic's number is multiplied by for the page, and its unit, " N/kN": with that of whatever it is of.
std::pair<double, std::string> shown_in(const Finding& finding) {
  const Scale of = scale_of(finding.quantity), along = scale_of(finding.along);
  switch (finding.test) {
    case FindingTest::slope:
    case FindingTest::slope_difference:
      return {of.per_si / along.per_si, fmt::format(" {}/{}", of.unit, along.unit)};
    case FindingTest::mean:
    case FindingTest::largest:
      return {of.per_si, std::string(" ") + of.unit};
    case FindingTest::curvature:
      return {100, " % of the rise"};
    case FindingTest::change:
      return {100, " % of the mean"};
    case FindingTest::slope_ratio:
      return {1, " times"};
    case FindingTest::peak:
    case FindingTest::lowest:
    case FindingTest::peak_shift:
      break;
  }
  return {along.per_si, std::string(" ") + along.unit};
}

std::string where_in_words(const Where& where) {
  std::string words;
  for (const auto& [axis, range] : where) {
    const Scale scale = scale_of(axis);
    words += (words.empty() ? "" : ", ") + spaced(word_of(axis)) + " ";
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

/// "0.31 (0.24 .. 0.38) N/kN", in the statistic's unit; "" without an interval.
std::string interval_in_words(const Finding& finding, const Evidence& evidence) {
  if (!evidence.interval) return "";
  const auto [scale, unit] = shown_in(finding);
  const Interval& found = *evidence.interval;
  if (found.lower == found.upper) return fmt::format("{:.3g}{}", scale * found.value, unit);
  return fmt::format("{:.3g} ({:.3g} .. {:.3g}){}", scale * found.value, scale * found.lower, scale * found.upper,
                     unit);
}

std::string cell(const Finding& finding, const Evidence& evidence) {
  std::string text(word_of(evidence.verdict));
  if (evidence.interval) text += ": " + interval_in_words(finding, evidence);
  return text;
}

/// The curves that a finding's statistic was taken of, a colour a label; what it is held against is dashed. No plots
/// where no label has data.
Sheet finding_sheet(const ReproducedFinding& row, const std::vector<std::string>& labels) {
  const Finding& finding = row.finding;
  const Scale x = scale_of(finding.along);
  const Scale y = scale_of(finding.quantity);
  Plot plot{fmt::format("{} [{}]", capital(spaced(word_of(finding.quantity))), y.unit),
            {fmt::format("{} [{}]", spaced(word_of(finding.along)), x.unit)}};
  for (std::size_t k = 0; k < row.evidence.size(); ++k)
    for (std::size_t c = 0; c < row.evidence[k].curves.size(); ++c) {
      Series series{.label = labels[k] + (c == 0 ? "" : ", against"),
                    .mark = Mark::line_and_points,
                    .color = static_cast<int>(k),
                    .dash = static_cast<int>(c)};
      bool exact = true;
      for (const CurvePoint& point : row.evidence[k].curves[c]) {
        series.x.push_back(x.per_si * point.x), series.y.push_back(y.per_si * point.y);
        series.error.push_back(y.per_si * point.error);
        exact = exact && point.error == 0;
      }
      if (exact) series.error.clear();
      if (!series.x.empty()) plot.series.push_back(std::move(series));
    }
  Sheet sheet{""};
  if (!plot.series.empty()) sheet.plots.push_back(std::move(plot));
  return sheet;
}

std::string claim(const Finding& finding, double scale, const std::string& unit) {
  std::string words =
      fmt::format("{} of {} along {}, {}", spaced(word_of(finding.test)), spaced(word_of(finding.quantity)),
                  spaced(word_of(finding.along)), where_in_words(finding.where));
  if (finding.compares()) words += ", against " + where_in_words(finding.against);
  if (finding.step > 0) {
    const Scale axis = scale_of(finding.along);
    words += fmt::format(", per {:.4g} {}", axis.per_si * finding.step, axis.unit);
  }
  words += ": ";
  if (std::isfinite(finding.at_least)) words += fmt::format("at least {:.4g}{}", scale * finding.at_least, unit);
  if (std::isfinite(finding.at_least) && std::isfinite(finding.at_most)) words += ", ";
  if (std::isfinite(finding.at_most)) words += fmt::format("at most {:.4g}{}", scale * finding.at_most, unit);
  return words;
}

std::vector<ReportPart> parts_of(const ReproducedFinding& row, const std::vector<std::string>& labels) {
  const Finding& finding = row.finding;
  const auto [scale, unit] = shown_in(finding);
  const std::string claimed = claim(finding, scale, unit);
  Sheet sheet = finding_sheet(row, labels);
  Table table{sheet.plots.empty() ? claimed : "", {"answers of", "verdict"}, {true, true, true}};
  const bool missing = std::ranges::any_of(row.evidence, [](const Evidence& e) { return !e.missing.empty(); });
  if (missing) table.header.emplace_back("conditions missing");
  for (std::size_t k = 0; k < row.evidence.size(); ++k) {
    table.add({labels[k], cell(finding, row.evidence[k])});
    if (missing) table.rows.back().emplace_back(missing_in_words(row.evidence[k]));
  }
  std::vector<ReportPart> parts = {{Prose{{"\u201c" + finding.quote + "\u201d"}}}};
  parts.push_back(
      {Figure(std::move(sheet), claimed + (finding.compares() ? ". Dashed: what it is held against." : "."))});
  parts.push_back({std::move(table)});
  if (!finding.chosen.empty()) parts.push_back({Prose{{"Chosen here: " + finding.chosen}}});
  return parts;
}

}  // namespace

std::string claim_in_words(const Finding& finding) { return claim(finding, per_si(finding), unit_of(finding)); }

namespace {

Json reproduction_json(const Reproduction& reproduction) {
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
      one["missing"] = list_of(evidence.missing, [](const OperatingCondition& at) { return to_json(at); });
      answers[reproduction.labels[k]] = std::move(one);
    }
    document["rows"].push_back({{"id", finding.id},
                                {"title", title_of(finding)},
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

/// How many findings each label shows, contradicts and leaves open, then the findings that every model with data
/// contradicts.
std::vector<std::pair<std::string, std::string>> conclusions(const Reproduction& reproduction) {
  const std::vector<ReproducedFinding>& rows = reproduction.rows;
  std::vector<std::pair<std::string, std::string>> sentences;
  for (std::size_t k = 0; k < reproduction.labels.size(); ++k) {
    const auto count = [&](FindingVerdict verdict) {
      return std::ranges::count_if(rows, [&](const auto& row) { return row.evidence[k].verdict == verdict; });
    };
    const auto asked = static_cast<long>(rows.size()) - count(FindingVerdict::no_data);
    const std::string& label = reproduction.labels[k];
    const std::string name = model_in_words(label);
    sentences.emplace_back(
        name == label ? label : fmt::format("{} ({})", label.starts_with("dem") ? capital(name) : "The " + name, label),
        fmt::format(
            "{} of {} findings are shown, {} contradicted and {} left open{}.", count(FindingVerdict::shown), asked,
            count(FindingVerdict::contradicted), count(FindingVerdict::not_shown),
            asked < static_cast<long>(rows.size()) ? fmt::format(", {} not answered", rows.size() - asked) : ""));
  }
  std::string contradicted;
  for (const ReproducedFinding& row : rows) {
    const bool any =
        std::ranges::any_of(row.evidence, [](const Evidence& e) { return e.verdict == FindingVerdict::contradicted; });
    const bool all = std::ranges::all_of(row.evidence, [](const Evidence& e) {
      return e.verdict == FindingVerdict::contradicted || e.verdict == FindingVerdict::no_data;
    });
    if (any && all) contradicted += (contradicted.empty() ? "" : "; ") + title_of(row.finding);
  }
  if (!contradicted.empty()) sentences.emplace_back("Contradicted by every model that answers", contradicted + ".");
  return sentences;
}

/// "The analytic wheel shows 37 of 48 findings (2 contradicted), grains 20 of 31 findings (1 contradicted)."
std::string conclusion(const Reproduction& reproduction) {
  std::string text;
  for (std::size_t k = 0; k < reproduction.labels.size(); ++k) {
    const auto count = [&](FindingVerdict verdict) {
      return std::ranges::count_if(reproduction.rows,
                                   [&](const auto& row) { return row.evidence[k].verdict == verdict; });
    };
    const std::string& label = reproduction.labels[k];
    const std::string name = model_in_words(label),
                      who = name == label || name.starts_with("grains") ? name : "the " + name;
    const auto asked = std::ssize(reproduction.rows) - count(FindingVerdict::no_data);
    text += fmt::format("{}{} {} of {} findings ({} contradicted)", text.empty() ? "" : ", ",
                        text.empty() ? capital(who) + (name.starts_with("grains") ? " show" : " shows") : who,
                        count(FindingVerdict::shown), asked, count(FindingVerdict::contradicted));
  }
  return text.empty() ? text : text + ".";
}

/// Findings against models: shown, contradicted, open, or "-" where a model has no data; each cell leads to the
/// finding's figure.
Table findings_matrix(const Reproduction& reproduction) {
  MarkedTable table{
      fmt::format("Shown: the whole {:.0f} % interval agrees with the claim. Contradicted: no part of it does. Open: "
                  "between. A cell opens its figure",
                  100 * reproduction.findings.level),
      {"section", "finding"},
      {true, true}};
  for (const std::string& label : reproduction.labels) table.header.push_back(model_in_words(label));
  table.text_columns.resize(table.header.size(), true);
  for (const ReproducedFinding& row : reproduction.rows) {
    std::vector<TableCell> cells = {row.finding.section, title_of(row.finding)};
    for (const Evidence& evidence : row.evidence) cells.push_back(verdict_cell(evidence.verdict, row.finding.id));
    table.add(std::move(cells));
  }
  return table;
}

}  // namespace

Report report_on(const Reproduction& reproduction) {
  Report report{"What of " + reproduction.findings.name + " is reproduced", reproduction.findings.source,
                reproduction.findings.source};
  if (const std::string sentence = conclusion(reproduction); !sentence.empty())
    report.add(Sentences(std::vector{sentence}), Told::on_pages);
  report.add(Sentences(conclusions(reproduction)), Told::on_terminals);
  report.add("Findings against models", findings_matrix(reproduction), Told::everywhere, "matrix");
  report.add("How it is judged",
             Prose{{fmt::format("Each finding is a statistic with its {:.0f} % interval. The analytic model's answers "
                                "are taken as exact: an interval of one value.",
                                100 * reproduction.findings.level)}},
             Told::on_pages, "method");
  report.add(Items{reproduction.remarks});
  report.add(WarningsHere());
  report.add("Each finding: words, figure, intervals", Prose{}, Told::on_pages, "findings");
  std::vector<std::string> names;
  for (const std::string& label : reproduction.labels) names.push_back(model_in_words(label));
  for (const ReproducedFinding& row : reproduction.rows)
    report.add(Fold{fmt::format("{}: {}", row.finding.section, title_of(row.finding)),
                    [&row, names] { return parts_of(row, names); }, finding_anchor(row.finding.id)});
  report.data = [&reproduction] { return reproduction_json(reproduction); };
  return report;
}

}  // namespace soilbin::compare
