// Tests of a publication's findings on a model's answers: each finding's statistic (a slope, a peak, a level) with its
// interval, and whether that interval lies in what the finding claims.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "compare/recorded/record.hpp"
#include "compare/reproduction/finding.hpp"
#include "compare/sweep/answers.hpp"

namespace soilbin::compare {

// Statistics of curves whose points have errors, with intervals: what a statement such as 'peaks near 20 % slip' or
// 'falls linearly' is tested by.

struct CurvePoint {
  double x = 0, y = 0;
  double error = 0;  ///< standard error of y; 0: exact
};
using Curve = std::vector<CurvePoint>;  ///< by rising x

/// A value and the interval that holds the truth with the stated probability.
struct Interval {
  double value = 0, lower = 0, upper = 0;
};

/// Slope of the straight line of weighted least squares, weights 1/error^2; where a point is exact, all weigh alike.
double slope(const Curve& curve);
/// Its interval by the normal law, from the points' errors alone: how well the slope of *this* line is known, whether
/// or not the points lie on it.
Interval slope_interval(const Curve& curve, double level);

/// Mean of y, each point weighing alike, and its interval by the normal law.
double mean_level(const Curve& curve);
Interval mean_interval(const Curve& curve, double level);

/// How far the parabola of weighted least squares departs from its chord in the middle of the range, over the rise
/// along the chord: c R/(4 b) of y = a + b u + c u^2, u from the middle of a range R. 0 for a line. Needs three points.
double curvature_share(const Curve& curve);

/// x of the largest y, refined by the parabola through it and its neighbours; an end of the curve is taken as it is.
double peak(const Curve& curve);
/// x of the smallest y, found alike.
double lowest(const Curve& curve);

using CurveStatistic = std::function<double(std::span<const Curve>)>;

/// The statistic of the curves and its percentile interval by parametric bootstrap: `draws` times every point is moved
/// by its own error, normally distributed; same seed, same interval. Draws whose statistic isn't finite count at both
/// ends.
Interval bootstrap(std::span<const Curve> curves, const CurveStatistic& statistic, double level, std::uint64_t seed,
                   int draws = 4000);

enum class FindingVerdict {
  shown,         ///< the whole interval lies in the claim
  not_shown,     ///< the interval lies across an end of the claim
  contradicted,  ///< no part of it lies in the claim
  no_data        ///< too few conditions have results
};

constexpr std::array<Word<FindingVerdict>, 4> words_of(std::type_identity<FindingVerdict>) {
  return {{{"shown", FindingVerdict::shown},
           {"not shown", FindingVerdict::not_shown},
           {"contradicted", FindingVerdict::contradicted},
           {"no data", FindingVerdict::no_data}}};
}

/// One finding, as one model's answers have it.
struct Evidence {
  FindingVerdict verdict = FindingVerdict::no_data;
  std::optional<Interval> interval;         ///< of the statistic [SI]
  std::vector<OperatingCondition> missing;  ///< conditions of the study without a result that belong to it
  std::vector<Curve> curves;                ///< that the statistic was taken of; the second is the one `against`
};

/// The curve of a finding: at each value of `along`, the mean of all conditions in `where`. A value that lacks one of
/// its conditions is left out, and the condition named in `missing`.
Curve curve_of(const Finding& finding, const Where& where, const std::vector<Answer>& answers,
               std::vector<OperatingCondition>& missing);

/// Tests a finding on the answers to its study's conditions.
Evidence test_finding(const Finding& finding, const std::vector<Answer>& answers, double level, std::uint64_t seed);

/// One model's answers to the studies.
struct StudyAnswers {
  std::string study, label;
  std::vector<Answer> answers;  ///< to all of the study's conditions, those without result included
};

/// A finding beside what each label's answers say of it, in the order of `labels`.
struct ReproducedFinding {
  Finding finding;
  std::vector<Evidence> evidence;
};

struct Reproduction {
  Findings findings;
  std::vector<std::string> labels;
  std::vector<ReproducedFinding> rows;
  std::vector<std::string> remarks;  ///< on the answers' errors
};

/// Every finding on every label's answers. A label without the finding's study has no data.
Reproduction reproduce(const Findings& findings, const std::vector<StudyAnswers>& studies);

/// The same answers without their errors. Those of the analytic model come from the soil's values, which all conditions
/// share: taken for noise of each point they would hide every trend.
std::vector<Answer> taken_as_exact(std::vector<Answer> answers);

/// A record's answers to conditions, with errors as RecordedModel tells them. `remark` says what was done.
std::vector<Answer> recorded_answers(const Record& record, const std::vector<OperatingCondition>& conditions,
                                     std::string& remark);

}  // namespace soilbin::compare
