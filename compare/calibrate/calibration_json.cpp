// A calibration as JSON.
#include "compare/calibrate/calibration_words.hpp"
#include "compare/calibrate/decision_words.hpp"
#include "compare/report/json_fields.hpp"

namespace soilbin::compare {
namespace {

Json values_json(const VirtualTest& test, const Eigen::VectorXd& values) {
  Json json = Json::object();
  for (std::size_t j = 0; j < test.factors.size(); ++j) json[test.factors[j].name] = values[j];
  return json;
}

Json results_json(const VirtualTest& test, const std::vector<Estimate>& results) {
  Json json = Json::object();
  for (std::size_t t = 0; t < results.size(); ++t) json[test.targets[t].name] = estimate_json(results[t]);
  return json;
}

Json json_of(const VirtualTest& test, const Candidate& candidate) {
  return {{"values", values_json(test, candidate.values)},
          {"predicted", results_json(test, candidate.predicted)},
          {"chi_square", finite(candidate.chi_square)},
          {"chance", candidate.chance},
          {"runs", candidate.runs}};
}

Json json_of(const VarianceRow& row) {
  return {{"source", row.source},   {"sum_of_squares", row.sum_of_squares},
          {"freedom", row.freedom}, {"pooled", row.pooled},
          {"f", finite(row.f)},     {"p_value", finite(row.p_value)}};
}

Json analysis_json(const VirtualTest& test, const TargetAnalysis& analysis) {
  Json ranges = Json::array(), rows = Json::array(), order = Json::array();
  for (std::size_t j = 0; j < test.factors.size(); ++j) {
    const FactorRange& factor = analysis.ranges.factors[j];
    ranges.push_back({{"factor", test.factors[j].name}, {"K", factor.sums}, {"k", factor.means}, {"R", factor.range}});
    rows.push_back(json_of(analysis.variance.factors[j]));
  }
  for (const int j : analysis.ranges.order) order.push_back(test.factors[j].name);
  if (analysis.variance.left.freedom > 0) rows.push_back(json_of(analysis.variance.left));
  return {{"ranges", ranges},
          {"order", order},
          {"variance", rows},
          {"total", analysis.variance.total},
          {"error", sentence(analysis.variance)}};
}

Json runs_json(const VirtualTest& test, const Calibration& calibration) {
  Json runs = Json::array();
  for (const CalibrationRun& run : calibration.runs) {
    Json json{{"stage", stage_name(run.stage)},    {"values", values_json(test, run.experiment.values)},
              {"seed", run.experiment.seed},       {"results", results_json(test, run.experiment.results)},
              {"seconds", run.experiment.seconds}, {"from_store", run.from_store}};
    if (!run.experiment.error.empty()) json["error"] = run.experiment.error;
    runs.push_back(std::move(json));
  }
  return runs;
}

}  // namespace

Json to_json(const VirtualTest& test, const CalibrationOptions& options, const Calibration& calibration) {
  Json factors = Json::array(), targets = Json::array(), candidates = Json::array();
  for (std::size_t j = 0; j < test.factors.size(); ++j)
    factors.push_back({{"name", test.factors[j].name},
                       {"lower", test.factors[j].lower},
                       {"upper", test.factors[j].upper},
                       {"given_targets", estimate_json(calibration.parameters[j])},
                       {"told", calibration.learned[j]}});
  for (std::size_t t = 0; t < test.targets.size(); ++t) {
    Json target{{"name", test.targets[t].name},
                {"measured", estimate_json(test.targets[t].measured)},
                {"held_out_rms", calibration.held_out[t].rms()},
                {"extra_sd", calibration.extra_sd[t]}};
    if (!calibration.analyses.empty()) target["design"] = analysis_json(test, calibration.analyses[t]);
    targets.push_back(std::move(target));
  }
  for (const Candidate& candidate : calibration.candidates) candidates.push_back(json_of(test, candidate));
  Json json{{"format", "soilbin-calibration/1"},
            {"test", test.identity},
            {"design", options.design},
            {"near", options.near},
            {"within", options.within},
            {"probability", options.probability},
            {"seed", options.seed},
            {"reached", calibration.reached},
            {"best", json_of(test, calibration.best)},
            {"factors", factors},
            {"targets", targets},
            {"candidates", candidates},
            {"runs", runs_json(test, calibration)},
            {"sentences", calibration_sentences(test, options, calibration)}};
  if (calibration.decision) json["decision"] = to_json(*calibration.decision);
  return json;
}

}  // namespace soilbin::compare
