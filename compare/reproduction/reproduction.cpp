#include "compare/reproduction/reproduction.hpp"

#include <fmt/core.h>

#include <Eigen/Dense>
#include <algorithm>
#include <boost/math/special_functions/erf.hpp>
#include <cmath>
#include <random>

#include "compare/fit/factorizations.hpp"
#include "compare/measured/campaign.hpp"
#include "compare/recorded/recorded_model.hpp"
#include "compare/recorded/step_pair.hpp"
#include "compare/sweep/varying.hpp"
#include "scenario/errors.hpp"
#include "scenario/mapping_reader.hpp"
#include "scenario/mapping_writer.hpp"

namespace soilbin::compare {
namespace {

Where read_where(const YamlNode& node, const Reading& reading) {
  if (!node.is_mapping())
    reading.refuse(node, "expected a mapping of axes", "such as {slip: [10 %, 30 %], load: 4 kN}");
  Where where;
  for (std::size_t k = 0; k + 1 < node.items.size(); k += 2) {
    const FindingAxis axis = read_choice<FindingAxis>(node.items[k], reading);
    const YamlNode& value = node.items[k + 1];
    Measure measure = measure_of(axis);
    measure.range = any_value;
    if (value.is_sequence() && value.items.size() != 2) reading.refuse(value, "a range has two ends");
    const YamlNode &first = value.is_sequence() ? value.items[0] : value,
                   &last = value.is_sequence() ? value.items[1] : value;
    where[axis] = {read_scalar(first, measure, reading).value, read_scalar(last, measure, reading).value};
    if (where[axis].first > where[axis].second) reading.refuse(value, "the range runs downward");
  }
  return where;
}

/// In which unit a claim is written: places along the axis in its own, all else as plain SI numbers.
Measure measure_of_claim(const Finding& finding) {
  const bool place = finding.test == FindingTest::peak || finding.test == FindingTest::lowest ||
                     finding.test == FindingTest::peak_shift;
  Measure measure = place ? measure_of(finding.along) : Measure{};
  measure.range = any_value;
  return measure;
}

Finding read_finding(const YamlNode& node, const Reading& reading) {
  Finding finding = read_mapping<Finding>(node, reading, {"where", "against", "step", "at_least", "at_most"});
  if (const YamlNode* where = node.find("where")) finding.where = read_where(*where, reading);
  if (const YamlNode* against = node.find("against")) finding.against = read_where(*against, reading);
  const Measure claim = measure_of_claim(finding);
  const YamlNode *least = node.find("at_least"), *most = node.find("at_most"), *step = node.find("step");
  if (least) finding.at_least = read_scalar(*least, claim, reading).value;
  if (most) finding.at_most = read_scalar(*most, claim, reading).value;
  if (step) finding.step = read_scalar(*step, measure_of(finding.along), reading).value;
  if (!least && !most) reading.refuse(node, "no claim", "at_least, at_most or both");
  if (finding.at_least > finding.at_most) reading.refuse(node, "at_least is more than at_most");
  if ((node.find("against") != nullptr) != finding.compares())
    reading.refuse(node, finding.compares() ? "'against' is missing" : "this test compares with nothing");
  if ((step != nullptr) != (finding.test == FindingTest::change))
    reading.refuse(node, "'step' and the test 'change' belong together");
  return finding;
}

}  // namespace

const ConditionView& view_of(FindingAxis axis) { return condition_view(word_of(axis)); }

Measure measure_of(FindingAxis axis) { return {std::string(view_of(axis).column_unit), view_of(axis).range}; }

Findings parse_findings(const SourceText& source) {
  const YamlNode document = parse_yaml(source);
  const Reading reading{&source, std::nullopt, nullptr, ""};
  expect_format(document, findings_format, reading);
  expect_keys(document, {"format", "name", "source", "level", "seed", "findings"}, reading);
  Findings findings;
  const auto need = [&](const char* key, const char* meaning) -> const YamlNode& {
    return *value_of(document, key, Need::required, meaning, reading);
  };
  findings.name = read_name(need("name", "what to call the publication"), reading);
  findings.source = read_text(need("source", "the publication"), reading);
  findings.level =
      read_scalar(need("level", "of the intervals"), {"-", {.lower = 0.5, .upper = 1, .upper_open = true}}, reading)
          .value;
  findings.seed = static_cast<std::uint64_t>(read_integer(need("seed", "of the bootstrap"), 0, reading));
  const YamlNode& list = need("findings", "a list");
  if (!list.is_sequence()) reading.refuse(list, "expected a list of findings");
  std::set<std::string> ids;
  for (const YamlNode& node : list.items) {
    findings.all.push_back(read_finding(node, reading));
    if (!ids.insert(findings.all.back().id).second) reading.refuse(node, "two findings have this id");
  }
  return findings;
}

Findings read_findings(const std::filesystem::path& path) {
  return parse_findings(read_source_text(path, largest_yaml));
}

namespace {

std::vector<double> weights(const Curve& curve) {
  const bool exact = std::ranges::any_of(curve, [](const CurvePoint& p) { return !(p.error > 0); });
  std::vector<double> out;
  for (const CurvePoint& point : curve) out.push_back(exact ? 1.0 : 1 / (point.error * point.error));
  return out;
}

/// A line's slope as a weighted sum of y: the factors.
std::vector<double> slope_factors(const Curve& curve) {
  const std::vector<double> w = weights(curve);
  double sum = 0, mean = 0, spread = 0;
  for (std::size_t k = 0; k < curve.size(); ++k) sum += w[k], mean += w[k] * curve[k].x;
  mean /= sum;
  for (std::size_t k = 0; k < curve.size(); ++k) spread += w[k] * (curve[k].x - mean) * (curve[k].x - mean);
  std::vector<double> factors;
  for (std::size_t k = 0; k < curve.size(); ++k) factors.push_back(w[k] * (curve[k].x - mean) / spread);
  return factors;
}

/// z of the two-sided normal interval: 1.96 for 0.95.
double normal_quantile(double level) { return std::sqrt(2.0) * boost::math::erf_inv(level); }

/// A weighted sum of y with its normal interval.
Interval sum_interval(const Curve& curve, const std::vector<double>& factors, double level) {
  double value = 0, variance = 0;
  for (std::size_t k = 0; k < curve.size(); ++k) {
    value += factors[k] * curve[k].y;
    variance += std::pow(factors[k] * curve[k].error, 2);
  }
  const double reach = normal_quantile(level) * std::sqrt(variance);
  return {value, value - reach, value + reach};
}

std::vector<double> mean_factors(const Curve& curve) {
  return std::vector<double>(curve.size(), 1 / static_cast<double>(curve.size()));
}

/// Where the parabola through three points has its extreme.
double vertex(const CurvePoint& a, const CurvePoint& b, const CurvePoint& c) {
  const double ab = (b.y - a.y) / (b.x - a.x), bc = (c.y - b.y) / (c.x - b.x);
  const double bend = (bc - ab) / (c.x - a.x);
  return bend == 0 ? b.x : (a.x + b.x) / 2 - ab / (2 * bend);
}

double extreme(const Curve& curve, double sign) {
  const auto top = std::ranges::max_element(
      curve, [&](const CurvePoint& a, const CurvePoint& b) { return sign * a.y < sign * b.y; });
  if (top == curve.begin() || top + 1 == curve.end()) return top->x;
  return vertex(*(top - 1), *top, *(top + 1));
}

double quantile(const std::vector<double>& sorted, double share) {
  const double at = share * static_cast<double>(sorted.size() - 1);
  const std::size_t below = static_cast<std::size_t>(at);
  if (below + 1 >= sorted.size() || sorted[below] == sorted[below + 1]) return sorted[below];
  return sorted[below] + (at - static_cast<double>(below)) * (sorted[below + 1] - sorted[below]);
}

double largest_value(const Curve& curve) {
  double most = -std::numeric_limits<double>::infinity();
  for (const CurvePoint& point : curve) most = std::max(most, point.y);
  return most;
}

}  // namespace

double slope(const Curve& curve) { return slope_interval(curve, 0.5).value; }
Interval slope_interval(const Curve& curve, double level) { return sum_interval(curve, slope_factors(curve), level); }

double mean_level(const Curve& curve) { return mean_interval(curve, 0.5).value; }
Interval mean_interval(const Curve& curve, double level) { return sum_interval(curve, mean_factors(curve), level); }

double curvature_share(const Curve& curve) {
  const std::vector<double> w = weights(curve);
  const double middle = (curve.front().x + curve.back().x) / 2, range = curve.back().x - curve.front().x;
  const Eigen::Index n = static_cast<Eigen::Index>(curve.size());
  Eigen::MatrixXd design(n, 3);
  Eigen::VectorXd values(n);
  for (Eigen::Index k = 0; k < n; ++k) {
    const CurvePoint& point = curve[k];
    const double u = (point.x - middle) / range, root = std::sqrt(w[k]);
    design.row(k) << root, root * u, root * u * u;
    values(k) = root * point.y;
  }
  const Eigen::VectorXd c = least_squares(design, values);
  return c(2) / (4 * c(1));
}

double peak(const Curve& curve) { return extreme(curve, 1); }
double lowest(const Curve& curve) { return extreme(curve, -1); }

Interval bootstrap(std::span<const Curve> curves, const CurveStatistic& statistic, double level, std::uint64_t seed,
                   int draws) {
  std::mt19937_64 random(seed);
  std::normal_distribution<double> normal;
  std::vector<double> found;
  int lost = 0;
  std::vector<Curve> moved(curves.begin(), curves.end());
  for (int draw = 0; draw < draws; ++draw) {
    for (std::size_t c = 0; c < curves.size(); ++c)
      for (std::size_t k = 0; k < curves[c].size(); ++k)
        moved[c][k].y = curves[c][k].y + curves[c][k].error * normal(random);
    const double value = statistic(moved);
    if (std::isfinite(value)) found.push_back(value);
    lost += std::isfinite(value) ? 0 : 1;
  }
  const double infinity = std::numeric_limits<double>::infinity();
  found.insert(found.end(), lost, infinity);
  found.insert(found.end(), lost, -infinity);
  std::ranges::sort(found);
  return {statistic(curves), quantile(found, (1 - level) / 2), quantile(found, (1 + level) / 2)};
}

namespace {

constexpr double tolerance = 1e-9;  // of ranges and of equal values along an axis

bool within(const OperatingCondition& at, const Where& where) {
  return std::ranges::all_of(where, [&](const auto& axis) {
    const double x = view_of(axis.first).get(at), slack = tolerance * std::max(1.0, std::abs(x));
    return x >= axis.second.first - slack && x <= axis.second.second + slack;
  });
}

Estimate value_of(const TractionResult& result, FindingQuantity quantity) {
  if (quantity == FindingQuantity::drawbar_pull) return result.drawbar_pull;
  if (quantity == FindingQuantity::torque) return result.torque;
  return quantity == FindingQuantity::sinkage ? result.sinkage : efficiency_with_error(result);
}

/// A test's statistic of one curve or two, and the fewest points of a curve from which it can be made.
struct TestStatistic {
  FindingTest test;
  std::size_t least_points;
  double (*of)(std::span<const Curve>, double step);
};

const TestStatistic& statistic_of(FindingTest test) {
  using C = std::span<const Curve>;
  static constexpr TestStatistic all[] = {
      {FindingTest::slope, 2, [](C c, double) { return slope(c[0]); }},
      {FindingTest::curvature, 3, [](C c, double) { return curvature_share(c[0]); }},
      {FindingTest::slope_difference, 2, [](C c, double) { return slope(c[0]) - slope(c[1]); }},
      {FindingTest::slope_ratio, 2, [](C c, double) { return slope(c[0]) / slope(c[1]); }},
      {FindingTest::peak, 3, [](C c, double) { return peak(c[0]); }},
      {FindingTest::lowest, 3, [](C c, double) { return lowest(c[0]); }},
      {FindingTest::peak_shift, 3, [](C c, double) { return peak(c[0]) - peak(c[1]); }},
      {FindingTest::change, 2, [](C c, double step) { return slope(c[0]) * step / mean_level(c[0]); }},
      {FindingTest::mean, 1, [](C c, double) { return mean_level(c[0]); }},
      {FindingTest::largest, 1, [](C c, double) { return largest_value(c[0]); }}};
  return *std::ranges::find(all, test, &TestStatistic::test);
}

Interval interval_of(const Finding& finding, const std::vector<Curve>& curves, double level, std::uint64_t seed) {
  if (finding.test == FindingTest::slope) return slope_interval(curves[0], level);
  if (finding.test == FindingTest::mean) return mean_interval(curves[0], level);
  const auto statistic = [&](std::span<const Curve> c) { return statistic_of(finding.test).of(c, finding.step); };
  return bootstrap(curves, statistic, level, seed);
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
    auto sum = std::ranges::find_if(sums, same);
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
  std::ranges::sort(curve, [](const CurvePoint& a, const CurvePoint& b) { return a.x < b.x; });
  return curve;
}

Evidence test_finding(const Finding& finding, const std::vector<Answer>& answers, double level, std::uint64_t seed) {
  Evidence evidence;
  std::vector<Curve> curves = {curve_of(finding, finding.where, answers, evidence.missing)};
  if (finding.compares()) curves.push_back(curve_of(finding, finding.against, answers, evidence.missing));
  evidence.curves = curves;
  for (const Curve& curve : curves)
    if (curve.size() < statistic_of(finding.test).least_points) return evidence;
  evidence.interval = interval_of(finding, curves, level, seed);
  evidence.verdict = verdict_on(*evidence.interval, finding);
  return evidence;
}

Reproduction reproduce(const Findings& findings, const std::vector<StudyAnswers>& studies) {
  Reproduction all{findings, {}, {}, {}};
  for (const StudyAnswers& study : studies)
    if (std::ranges::find(all.labels, study.label) == all.labels.end()) all.labels.push_back(study.label);
  for (const Finding& finding : findings.all) {
    ReproducedFinding row{finding, {}};
    for (const std::string& label : all.labels) {
      const auto study = std::ranges::find_if(
          studies, [&](const StudyAnswers& known) { return known.label == label && known.study == finding.study; });
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
  remark.clear();
  for (const ChannelView& channel : channel_views)
    if (const std::optional<double> factor = packing_factor(record, channel.predicted))
      remark += fmt::format("{}{} {:.2g}", remark.empty() ? "" : ", ", channel.title, *factor);
  if (remark.empty())
    remark = usual_packing_factor(record.runs, &TractionResult::sinkage) > 1.0
                 ? "errors are those of single runs, that of the sinkage twice as large: too few conditions have "
                   "several bed samples"
                 : "errors are those of single runs: too few conditions have several bed samples";
  else
    remark =
        "scatter between bed samples over the errors of single runs (errors are widened by it where it is above 1): " +
        remark;
  const RecordedModel model(record);
  std::vector<Answer> answers;
  for (const OperatingCondition& at : conditions) answers.push_back(ask(model, {}, at));
  return answers;
}

namespace {

/// Answers by the study's record, and remarks on it; none where there is no record.
std::vector<Answer> recorded_grains(const std::string& study, const Case& question,
                                    const std::vector<StudyRecord>& records, std::vector<std::string>& remarks) {
  std::vector<Answer> answers;
  for (const StudyRecord& one : records) {
    if (one.study != study) continue;
    std::string remark;
    answers = recorded_answers(one.record, question.study.conditions, remark);
    const std::string file = one.file.filename().string() + ": ";
    remarks.push_back(file + remark);
    for (const std::string& doubt : in_words(step_doubts(one.record))) remarks.push_back(file + doubt);
  }
  return answers;
}

}  // namespace

std::set<std::string> studies_of(const Findings& findings) {
  std::set<std::string> names;
  for (const Finding& finding : findings.all) names.insert(finding.study);
  return names;
}

void add_record(std::vector<StudyRecord>& records, StudyRecord record, const Findings& findings) {
  const std::string file = record.file.string();
  if (!studies_of(findings).contains(record.study))
    throw InputError(fmt::format("{}: no finding speaks of its study '{}'", file, record.study));
  for (const StudyRecord& other : records)
    if (other.study == record.study)
      throw InputError(fmt::format("{} and {} answer the same study '{}'\n  hint: one record a study",
                                   other.file.string(), file, record.study));
  records.push_back(std::move(record));
}

AnsweredStudies answer_studies(const Findings& findings, const std::vector<StudyRecord>& records,
                               const std::function<Case(const std::string& study)>& find_case,
                               const std::function<Progress()>& progress) {
  AnsweredStudies answered;
  for (const std::string& name : studies_of(findings)) {
    Case question = find_case(name);
    std::erase_if(question.study.models, [](const ModelChoice& c) { return c.model == ModelKind::dem; });
    std::vector<ModelAnswers> study = run_study(question, progress());
    for (const ModelAnswers& model : study)
      answered.answers.push_back({name, model.choice.label, taken_as_exact(model.answers)});
    std::vector<Answer> grains = recorded_grains(name, question, records, answered.remarks);
    if (!grains.empty()) {
      question.study.models.push_back({ModelKind::dem, {}, "dem"});
      study.push_back({question.study.models.back(), grains});
    }
    answered.doubts.add(question.study.name, question, study);
    if (grains.empty())
      for (const OperatingCondition& at : question.study.conditions) grains.push_back({at, std::nullopt, "not run"});
    answered.answers.push_back({name, "dem", std::move(grains)});
  }
  return answered;
}

}  // namespace soilbin::compare
