#include "compare/calibrate/experiment_store.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <fstream>
#include <limits>
#include <nlohmann/json.hpp>
#include <sstream>

#include "compare/report/result_json.hpp"
#include "scenario/atomic_file.hpp"
#include "scenario/errors.hpp"

namespace soilbin::compare {
namespace {

using Json = nlohmann::ordered_json;

constexpr const char* format = "soilbin-experiments/1";

std::string key_of(const VirtualTest& test) {
  std::string key = test.identity + "\nfactors";
  for (const Factor& factor : test.factors) key += " " + factor.name;
  key += "\ntargets";
  for (const Target& target : test.targets) key += " " + target.name;
  return key;
}

Json json_of(const Experiment& experiment) {
  Json values = Json::array(), results = Json::array();
  for (const double value : experiment.values) values.push_back(value);
  for (const Estimate& result : experiment.results) results.push_back({result.value, result.std_error});
  Json json{{"values", values}, {"seed", experiment.seed}, {"results", results}, {"seconds", experiment.seconds}};
  if (!experiment.error.empty()) json["error"] = experiment.error;
  return json;
}

Experiment experiment_of(const Json& json) {
  Experiment experiment;
  const std::vector<double> values = json.at("values").get<std::vector<double>>();
  experiment.values = Eigen::Map<const Eigen::VectorXd>(values.data(), static_cast<Eigen::Index>(values.size()));
  experiment.seed = json.at("seed").get<std::uint64_t>();
  for (const Json& result : json.at("results"))
    experiment.results.push_back({result.at(0).get<double>(), result.at(1).get<double>()});
  experiment.seconds = json.at("seconds").get<double>();
  experiment.error = json.value("error", "");
  return experiment;
}

bool same_question(const Experiment& experiment, const Eigen::VectorXd& values, std::uint64_t seed) {
  return experiment.seed == seed && experiment.values.size() == values.size() && experiment.values == values;
}

}  // namespace

ExperimentStore::ExperimentStore(std::filesystem::path file) : file_(std::move(file)) {
  if (file_.empty() || !std::filesystem::exists(file_)) return;
  std::ifstream in(file_, std::ios::binary);
  std::ostringstream text;
  text << in.rdbuf();
  try {
    const Json document = Json::parse(text.str());
    if (document.at("format") != format) throw InputError("");
    for (const Json& test : document.at("tests")) {
      OfOneTest& into = tests_.emplace_back(OfOneTest{test.at("test").get<std::string>(), {}});
      for (const Json& experiment : test.at("experiments")) into.experiments.push_back(experiment_of(experiment));
    }
  } catch (const std::exception& error) {
    throw InputError({file_.string(), 0, 0}, fmt::format("not a store of experiments ({})", format), error.what(),
                     "name another file, or move this one away");
  }
}

std::optional<Experiment> ExperimentStore::find(const VirtualTest& test, const Eigen::VectorXd& values,
                                                std::uint64_t seed) const {
  const std::string key = key_of(test);
  for (const OfOneTest& known : tests_)
    if (known.key == key)
      for (const Experiment& experiment : known.experiments)
        if (same_question(experiment, values, seed)) return experiment;
  return std::nullopt;
}

void ExperimentStore::keep(const VirtualTest& test, const Experiment& experiment) {
  const std::string key = key_of(test);
  const auto known = std::find_if(tests_.begin(), tests_.end(), [&](const OfOneTest& one) { return one.key == key; });
  OfOneTest& into = known != tests_.end() ? *known : tests_.emplace_back(OfOneTest{key, {}});
  std::erase_if(into.experiments,
                [&](const Experiment& old) { return same_question(old, experiment.values, experiment.seed); });
  into.experiments.push_back(experiment);
  if (!file_.empty()) write_file_atomically(file_, text());
}

std::size_t ExperimentStore::size() const {
  std::size_t sum = 0;
  for (const OfOneTest& test : tests_) sum += test.experiments.size();
  return sum;
}

std::string ExperimentStore::text() const {
  Json tests = Json::array();
  for (const OfOneTest& test : tests_) {
    Json experiments = Json::array();
    for (const Experiment& experiment : test.experiments) experiments.push_back(json_of(experiment));
    tests.push_back({{"test", test.key}, {"experiments", experiments}});
  }
  return json_text({{"format", format}, {"tests", tests}});
}

std::pair<Experiment, bool> experiment_at(const VirtualTest& test, const Eigen::VectorXd& values, std::uint64_t seed,
                                          ExperimentStore& store) {
  if (std::optional<Experiment> known = store.find(test, values, seed)) return {std::move(*known), true};
  const auto start = std::chrono::steady_clock::now();
  Experiment experiment{values, seed, {}, "", 0.0};
  try {
    experiment.results = test.run(values, seed);
    for (const Estimate& result : experiment.results)
      if (!std::isfinite(result.value) || !(result.std_error >= 0)) experiment.error = "a result is not a number";
  } catch (const NoSolution& failure) {
    experiment.error = failure.what();
  }
  if (!experiment.error.empty()) experiment.results.clear();
  experiment.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  store.keep(test, experiment);
  return {std::move(experiment), false};
}

}  // namespace soilbin::compare
