// Tests of a publication's findings on a model's answers: each finding's statistic (a slope, a peak, a level) with its
// interval, and whether that interval lies in what the finding claims.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <limits>
#include <map>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <vector>

#include "compare/doubts/doubts.hpp"
#include "compare/measured/condition_views.hpp"
#include "compare/recorded/record.hpp"
#include "compare/sweep/answers.hpp"
#include "scenario/description.hpp"
#include "scenario/source_text.hpp"

namespace soilbin::compare {

// Findings of a publication as rows of a file: what it says, word by word, and the statistic that would show it.
// The format soilbin-findings/1 is described in docs/reference/findings.md.

enum class FindingQuantity { drawbar_pull, torque, sinkage, tractive_efficiency };

constexpr std::array<Word<FindingQuantity>, 4> words_of(std::type_identity<FindingQuantity>) {
  using Q = FindingQuantity;
  return {{{"drawbar_pull", Q::drawbar_pull},
           {"torque", Q::torque},
           {"sinkage", Q::sinkage},
           {"tractive_efficiency", Q::tractive_efficiency}}};
}

/// What a curve varies with.
enum class FindingAxis { load, slip, longitudinal_incline, transverse_incline, yaw };

constexpr std::array<Word<FindingAxis>, 5> words_of(std::type_identity<FindingAxis>) {
  using A = FindingAxis;
  return {{{"load", A::load},
           {"slip", A::slip},
           {"longitudinal_incline", A::longitudinal_incline},
           {"transverse_incline", A::transverse_incline},
           {"yaw", A::yaw}}};
}

/// The statistic whose interval is held against the claim.
enum class FindingTest {
  slope,             ///< of the line of weighted least squares
  curvature,         ///< departure from a line in mid-range, over the rise
  slope_difference,  ///< slope less that of the curve `against`
  slope_ratio,       ///< slope over that of the curve `against`
  peak,              ///< where the largest value is
  lowest,            ///< where the smallest is
  peak_shift,        ///< peak less that of the curve `against`
  change,            ///< slope times `step`, over the mean
  mean,              ///< mean value
  largest            ///< largest value
};

constexpr std::array<Word<FindingTest>, 10> words_of(std::type_identity<FindingTest>) {
  using T = FindingTest;
  return {{{"slope", T::slope},
           {"curvature", T::curvature},
           {"slope_difference", T::slope_difference},
           {"slope_ratio", T::slope_ratio},
           {"peak", T::peak},
           {"lowest", T::lowest},
           {"peak_shift", T::peak_shift},
           {"change", T::change},
           {"mean", T::mean},
           {"largest", T::largest}}};
}

/// Conditions whose axes lie in these ranges, ends included [SI].
using Where = std::map<FindingAxis, std::pair<double, double>>;

struct Finding {
  std::string id;
  std::string title;  ///< what is claimed, as a sentence; "" where the file has none
  std::string section;
  std::string quote;   ///< the publication's own words
  std::string study;   ///< of the library, whose conditions are looked at
  std::string chosen;  ///< what of the test isn't in the publication
  FindingQuantity quantity = FindingQuantity::drawbar_pull;
  FindingAxis along = FindingAxis::slip;
  FindingTest test = FindingTest::slope;
  Where where;      ///< the curve: means over all else at each value of `along`
  Where against;    ///< the other curve, where the test compares two
  double step = 0;  ///< of change [SI]
  double at_least = -std::numeric_limits<double>::infinity();  ///< the claim, in the statistic's unit [SI]
  double at_most = std::numeric_limits<double>::infinity();

  bool compares() const {
    return test == FindingTest::slope_difference || test == FindingTest::slope_ratio || test == FindingTest::peak_shift;
  }
};

void describe(auto& v, std::type_identity<Finding>) {
  v.text("id", &Finding::id, Need::required, "a name of its own");
  v.text("title", &Finding::title, Need::optional, "what is claimed, as a sentence");
  v.text("section", &Finding::section, Need::required, "of the publication");
  v.text("quote", &Finding::quote, Need::required, "the publication's own words");
  v.text("study", &Finding::study, Need::required, "of the library, whose conditions are looked at");
  v.choice("quantity", &Finding::quantity, Need::required, "what the curve shows");
  v.choice("along", &Finding::along, Need::required, "what the curve varies with");
  v.choice("test", &Finding::test, Need::required, "the statistic that is held against the claim");
  v.text("chosen", &Finding::chosen, Need::optional, "what of the test isn't in the publication");
}

struct Findings {
  std::string name, source;
  double level = 0.95;     ///< of the intervals
  std::uint64_t seed = 1;  ///< of the bootstrap
  std::vector<Finding> all;
};

inline constexpr const char* findings_format = "soilbin-findings/1";

/// Throws InputError with file, line, column and hint.
Findings parse_findings(const SourceText& source);
Findings read_findings(const std::filesystem::path& path);

/// Where an axis stands in an operating condition, and its unit.
const ConditionView& view_of(FindingAxis axis);
Measure measure_of(FindingAxis axis);

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

/// Answers without their errors. The analytic model's come from the soil's values, which all conditions share: taken
/// for noise of each point they would hide every trend.
std::vector<Answer> taken_as_exact(std::vector<Answer> answers);

/// A record's answers to conditions, with errors as RecordedModel tells them. `remark` says what was done.
std::vector<Answer> recorded_answers(const Record& record, const std::vector<OperatingCondition>& conditions,
                                     std::string& remark);

// What findings are tested on: every study that they speak of, answered by its analytic models and, where a record is
// given, by grains.
//
//   std::vector<StudyRecord> records;
//   add_record(records, {"paper-straight", file, read_record(file)}, findings);
//   const AnsweredStudies answered = answer_studies(findings, records, find_case);
//   const Reproduction reproduction = reproduce(findings, answered.answers);

/// A record and the study that it answers: its case's name.
struct StudyRecord {
  std::string study;
  std::filesystem::path file;
  Record record;
};

std::set<std::string> studies_of(const Findings& findings);

/// Throws InputError where no finding speaks of the record's study, and where another record answers it already.
void add_record(std::vector<StudyRecord>& records, StudyRecord record, const Findings& findings);

/// The answers, and what is to be known of them.
struct AnsweredStudies {
  std::vector<StudyAnswers> answers;
  std::vector<std::string> remarks;  ///< on errors
  NamedDoubts doubts;                ///< each with the studies that it is of
};

/// Every model's answers to every study of the findings; grains without a record are answers without result.
/// `progress`: makes one for each study.
AnsweredStudies answer_studies(
    const Findings& findings, const std::vector<StudyRecord>& records,
    const std::function<Case(const std::string& study)>& find_case,
    const std::function<Progress()>& progress = [] { return Progress(); });

}  // namespace soilbin::compare
