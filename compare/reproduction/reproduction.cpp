#include "compare/reproduction/reproduction.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "compare/measured/channels.hpp"
#include "compare/recorded/recorded_model.hpp"
#include "compare/sweep/varying.hpp"

namespace soilbin::compare {
namespace {

constexpr double tolerance = 1e-9;  // of ranges and of equal values along an axis

bool within(const OperatingCondition& at, const Where& where) {
  return std::all_of(where.begin(), where.end(), [&](const auto& axis) {
    const double x = view_of(axis.first).get(at), slack = tolerance * std::max(1.0, std::abs(x));
    return x >= axis.second.first - slack && x <= axis.second.second + slack;
  });
}

Estimate value_of(const TractionResult& result, FindingQuantity quantity) {
  switch (quantity) {
    case FindingQuantity::drawbar_pull:
      return result.drawbar_pull;
    case FindingQuantity::torque:
      return result.torque;
    case FindingQuantity::sinkage:
      return result.sinkage;
    case FindingQuantity::tractive_efficiency:
      break;
  }
  return efficiency_with_error(result);
}

/// Fewest points of a curve from which a test can be made.
std::size_t least_points(FindingTest test) {
  switch (test) {
    case FindingTest::mean:
    case FindingTest::largest:
      return 1;
    case FindingTest::curvature:
    case FindingTest::peak:
    case FindingTest::lowest:
    case FindingTest::peak_shift:
      return 3;
    default:
      return 2;
  }
}

CurveStatistic statistic_of(const Finding& finding) {
  using Curves = std::span<const Curve>;
  switch (finding.test) {
    case FindingTest::slope:
      return [](Curves c) { return slope(c[0]); };
    case FindingTest::curvature:
      return [](Curves c) { return curvature_share(c[0]); };
    case FindingTest::slope_difference:
      return [](Curves c) { return slope(c[0]) - slope(c[1]); };
    case FindingTest::slope_ratio:
      return [](Curves c) { return slope(c[0]) / slope(c[1]); };
    case FindingTest::peak:
      return [](Curves c) { return peak(c[0]); };
    case FindingTest::lowest:
      return [](Curves c) { return lowest(c[0]); };
    case FindingTest::peak_shift:
      return [](Curves c) { return peak(c[0]) - peak(c[1]); };
    case FindingTest::change:
      return [step = finding.step](Curves c) { return slope(c[0]) * step / mean_level(c[0]); };
    case FindingTest::mean:
      return [](Curves c) { return mean_level(c[0]); };
    case FindingTest::largest:
      break;
  }
  return [](Curves c) { return largest_value(c[0]); };
}

Interval interval_of(const Finding& finding, const std::vector<Curve>& curves, double level, std::uint64_t seed) {
  if (finding.test == FindingTest::slope) return slope_interval(curves[0], level);
  if (finding.test == FindingTest::mean) return mean_interval(curves[0], level);
  return bootstrap(curves, statistic_of(finding), level, seed);
}

FindingVerdict verdict_on(const Interval& interval, const Finding& finding) {
  if (interval.lower >= finding.at_least && interval.upper <= finding.at_most) return FindingVerdict::shown;
  if (interval.upper < finding.at_least || interval.lower > finding.at_most) return FindingVerdict::contradicted;
  return FindingVerdict::not_shown;
}

using Runs = std::vector<const RecordedRun*>;

}  // namespace

Curve curve_of(const Finding& finding, const Where& where, const std::vector<Answer>& answers,
               std::vector<OperatingCondition>& missing) {
  struct Sum {
    double x, y = 0, variance = 0;
    int count = 0;
    bool whole = true;
  };
  std::vector<Sum> sums;
  for (const Answer& answer : answers) {
    if (!within(answer.at, where)) continue;
    const double x = view_of(finding.along).get(answer.at);
    const auto same = [&](const Sum& sum) { return std::abs(sum.x - x) <= tolerance * std::max(1.0, std::abs(x)); };
    auto sum = std::find_if(sums.begin(), sums.end(), same);
    if (sum == sums.end()) sum = sums.insert(sums.end(), {.x = x});
    const Estimate one = answer.result ? value_of(*answer.result, finding.quantity) : Estimate{std::nan(""), 0};
    if (!std::isfinite(one.value)) {
      sum->whole = false;
      missing.push_back(answer.at);
      continue;
    }
    sum->y += one.value, sum->variance += one.std_error * one.std_error, sum->count += 1;
  }
  Curve curve;
  for (const Sum& sum : sums)
    if (sum.whole) curve.push_back({sum.x, sum.y / sum.count, std::sqrt(sum.variance) / sum.count});
  std::sort(curve.begin(), curve.end(), [](const CurvePoint& a, const CurvePoint& b) { return a.x < b.x; });
  return curve;
}

Evidence test_finding(const Finding& finding, const std::vector<Answer>& answers, double level, std::uint64_t seed) {
  Evidence evidence;
  std::vector<Curve> curves = {curve_of(finding, finding.where, answers, evidence.missing)};
  if (finding.compares()) curves.push_back(curve_of(finding, finding.against, answers, evidence.missing));
  evidence.curves = curves;
  for (const Curve& curve : curves)
    if (curve.size() < least_points(finding.test)) return evidence;
  evidence.interval = interval_of(finding, curves, level, seed);
  evidence.verdict = verdict_on(*evidence.interval, finding);
  return evidence;
}

Reproduction reproduce(const Findings& findings, const std::vector<StudyAnswers>& studies) {
  Reproduction all{findings, {}, {}, {}};
  for (const StudyAnswers& study : studies)
    if (std::find(all.labels.begin(), all.labels.end(), study.label) == all.labels.end())
      all.labels.push_back(study.label);
  for (const Finding& finding : findings.all) {
    ReproducedFinding row{finding, {}};
    for (const std::string& label : all.labels) {
      const auto study = std::find_if(studies.begin(), studies.end(), [&](const StudyAnswers& known) {
        return known.label == label && known.study == finding.study;
      });
      row.evidence.push_back(
          study == studies.end() ? Evidence{} : test_finding(finding, study->answers, findings.level, findings.seed));
    }
    all.rows.push_back(std::move(row));
  }
  return all;
}

std::vector<Answer> taken_as_exact(std::vector<Answer> answers) {
  for (Answer& answer : answers)
    for (const ChannelView& channel : channel_views)
      if (answer.result) ((*answer.result).*channel.predicted).std_error = 0;
  return answers;
}

std::vector<Answer> recorded_answers(const Record& record, const std::vector<OperatingCondition>& conditions,
                                     std::string& remark) {
  std::array<double, channel_views.size()> factors{};
  remark.clear();
  for (std::size_t c = 0; c < channel_views.size(); ++c) {
    const std::optional<double> factor = packing_factor(record, channel_views[c].predicted);
    factors[c] = std::max(1.0, factor.value_or(1.0));
    if (factor) remark += fmt::format("{}{} {:.2g}", remark.empty() ? "" : ", ", channel_views[c].title, *factor);
  }
  remark = remark.empty()
               ? "errors are those of single runs: too few conditions have several packings to know more"
               : "scatter between packings over the errors of single runs (errors are widened by it where it "
                 "is above 1): " +
                     remark;
  const RecordedModel model(record);
  std::vector<Answer> answers;
  for (const OperatingCondition& at : conditions) {
    answers.push_back(ask(model, {}, at));
    if (!answers.back().result) continue;
    const Runs runs = model.runs(at);
    for (std::size_t c = 0; c < channel_views.size(); ++c) {
      double own = 0;
      for (const RecordedRun* run : runs)
        own += std::pow(((*run->answer.result).*channel_views[c].predicted).std_error, 2);
      ((*answers.back().result).*channel_views[c].predicted).std_error =
          factors[c] * std::sqrt(own) / static_cast<double>(runs.size());
    }
  }
  return answers;
}

}  // namespace soilbin::compare
