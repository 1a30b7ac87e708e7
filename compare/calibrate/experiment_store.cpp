#include "compare/calibrate/experiment_store.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <nlohmann/json.hpp>

#include "compare/report/json_fields.hpp"
#include "compare/report/sealed_json.hpp"
#include "scenario/checksum.hpp"
#include "scenario/errors.hpp"

namespace soilbin::compare {
namespace {

constexpr const char* format = "soilbin-experiments/1";

std::string key_of(const VirtualTest& test) {
  std::string key = test.identity + "\nfactors";
  for (const Factor& factor : test.factors) key += " " + factor.name;
  key += "\ntargets";
  for (const Target& target : test.targets) key += " " + target.name;
  return key;
}

/// A test's key with its seal.
Json sealed_question(const std::string& key) {
  Json question = {{"test", key}};
  put_seal(question);
  return question;
}

Json json_of(const Experiment& experiment) {
  Json values = Json::array(), results = Json::array();
  for (const double value : experiment.values) values.push_back(value);
  for (const Estimate& result : experiment.results) results.push_back({result.value, result.std_error});
  Json json{{"values", values}, {"seed", experiment.seed}, {"results", results}, {"seconds", experiment.seconds}};
  if (!experiment.error.empty()) json["error"] = experiment.error;
  if (experiment.sealed) put_seal(json);
  return json;
}

Experiment experiment_of(const Json& json, const std::string& place) {
  Experiment experiment;
  experiment.sealed =
      check_seal(json, place, "take this experiment out of the file, and it is made again when it is needed") ==
      Seal::whole;
  const std::vector<double> values = json.at("values").get<std::vector<double>>();
  experiment.values = Eigen::Map<const Eigen::VectorXd>(values.data(), static_cast<Eigen::Index>(values.size()));
  experiment.seed = json.at("seed").get<std::uint64_t>();
  for (const Json& result : json.at("results"))
    experiment.results.push_back({result.at(0).get<double>(), result.at(1).get<double>()});
  experiment.seconds = json.at("seconds").get<double>();
  experiment.error = json.value("error", "");
  experiment.from_store = true;
  return experiment;
}

/// A test's identity without what an engine of other bits calls otherwise: its "bed.version", and by which speed grains
/// sleep ("rig.sleep_speed": of the fastest grain of a slab, until November 2026).
std::string of_any_engine(std::string key) {
  if (const std::size_t begin = key.find("\nbed.version "); begin != std::string::npos)
    key.erase(begin, key.find('\n', begin + 1) - begin);
  const std::string before = "\nrig.sleep_speed ";
  if (const std::size_t at = key.find(before); at != std::string::npos)
    key.replace(at, before.size(), "\nrig.sleep_mean_speed ");
  return key;
}

/// Whether two tests differ in nothing, or in the engine's bits alone.
bool same_but_for_version(const std::string& one, const std::string& other) {
  return of_any_engine(one) == of_any_engine(other);
}

bool same_answer(const Experiment& a, const Experiment& b) {
  const auto same = [](const Estimate& x, const Estimate& y) {
    return x.value == y.value && x.std_error == y.std_error;
  };
  return a.error == b.error && std::equal(a.results.begin(), a.results.end(), b.results.begin(), b.results.end(), same);
}

bool answers(const Experiment& experiment, const ExperimentSpec& spec) {
  return experiment.seed == spec.seed && experiment.values.size() == spec.values.size() &&
         experiment.values == spec.values;
}

}  // namespace

ExperimentStore::ExperimentStore(std::filesystem::path file, Writers writers)
    : file_(std::move(file)),
      kept_(
          file_, writers, [this] { read(); }, [this] { return text(); }) {
  kept_.look();
}

const Experiment& ExperimentStore::put(Tests& tests, const std::string& key, Experiment experiment) {
  const auto test = std::ranges::find_if(tests, [&](const auto& one) { return one.first == key; });
  auto& into = test != tests.end() ? test->second : tests.emplace_back(key, std::vector<Experiment>{}).second;
  experiment.from_store = true;
  const auto known = std::ranges::find_if(into, [&](const Experiment& one) { return answers(one, experiment); });
  if (known == into.end()) return into.emplace_back(std::move(experiment));
  if (experiment.sealed && !known->sealed && same_answer(*known, experiment)) *known = std::move(experiment);
  return *known;
}

/// Takes the experiments of the file and its journal in place of those known.
void ExperimentStore::read() {
  const std::vector<SourceText> documents = kept_documents(file_);
  tests_ = parsed(documents.front(), asked_);
  for (std::size_t k = 1; k < documents.size(); ++k)
    for (const auto& [key, experiments] : parsed(documents[k], asked_))
      for (const Experiment& one : experiments) put(tests_, key, one);
}

void ExperimentStore::tell_asked(Asked asked) {
  const std::size_t told = asked_.size();
  asked_.merge(asked);
  if (asked_.size() > told && size() > 0) kept_.add([] {}, "");
}

ExperimentStore::Tests ExperimentStore::parsed(const SourceText& source, Asked& asked) {
  const std::string other = "name another file, or move this one away";
  const Json document = parse_json(source, other);
  if (!document.is_object() || document.value("format", "") != format)
    throw InputError({source.file, 0, 0}, fmt::format("not a store of experiments ({})", format), "", other);
  Tests tests;
  if (document.contains("asked"))
    read_json_at(source.file + ": asked", [&] { asked = document["asked"].get<Asked>(); });
  const std::string file = source.file + ": tests";
  for (const Json& test : read_json_at(file, [&] { return document.at("tests"); })) {
    const std::string place = fmt::format("{}[{}]", file, tests.size());
    read_json_at(place, [&] {
      tests.push_back({test.at("test").get<std::string>(), {}});
      Json question = sealed_question(tests.back().first);
      if (test.contains("seal")) question["seal"] = test["seal"];
      check_seal(question, place + ".test", "take this test out of the file, and its experiments are made again");
      return test.at("experiments").size();
    });
    std::vector<Experiment>& into = tests.back().second;
    for (const Json& experiment : test.at("experiments")) {
      const std::string where = fmt::format("{}.experiments[{}]", place, into.size());
      into.push_back(read_json_at(where, [&] { return experiment_of(experiment, where); }));
    }
  }
  return tests;
}

std::optional<Experiment> ExperimentStore::find(const VirtualTest& test, const ExperimentSpec& spec) const {
  const std::string key = key_of(test);
  std::optional<Experiment> older;
  for (const auto& [known, experiments] : tests_)
    if (same_but_for_version(key, known))
      for (const Experiment& experiment : experiments)
        if (answers(experiment, spec)) {
          if (known == key) return experiment;
          older = experiment;
        }
  return older;
}

void ExperimentStore::add(const VirtualTest& test, const Experiment& experiment) {
  Tests alone;
  put(alone, key_of(test), experiment);
  kept_.add([&] { put(tests_, key_of(test), experiment); }, text_of(alone, {}));
}

void ExperimentStore::merge(const std::filesystem::path& other) {
  if (!std::filesystem::exists(other)) throw InputError(other.string() + ": no such file");
  const ExperimentStore theirs(other);
  const auto take = [&] {
    Tests all = tests_;
    for (const auto& [key, experiments] : theirs.tests_)
      for (const Experiment& fresh : experiments)
        if (!same_answer(put(all, key, fresh), fresh))
          throw InputError(
              fmt::format("{}: another answer to an experiment than in {}\n  hint: the same program gives the "
                          "same bits on every machine; different sources may not",
                          other.string(), file_.string()));
    tests_ = std::move(all);
  };
  kept_.add(take, "");
}

bool is_experiment_store(const std::filesystem::path& file) {
  try {
    const Json document = parse_json(kept_documents(file).front(), "");
    return document.is_object() && document.value("format", "") == format;
  } catch (const InputError&) {
    return false;
  }
}

std::size_t ExperimentStore::unsealed() const {
  std::ptrdiff_t sum = 0;
  for (const auto& [key, experiments] : tests_) sum += std::ranges::count(experiments, false, &Experiment::sealed);
  return static_cast<std::size_t>(sum);
}

std::size_t ExperimentStore::of_other_engines(const VirtualTest& test) const {
  const std::string key = key_of(test);
  std::size_t sum = 0;
  for (const auto& [known, experiments] : tests_)
    if (known != key && same_but_for_version(key, known)) sum += experiments.size();
  return sum;
}

std::size_t ExperimentStore::size() const {
  std::size_t sum = 0;
  for (const auto& [key, experiments] : tests_) sum += experiments.size();
  return sum;
}

std::string ExperimentStore::text_of(const Tests& all, const Asked& asked) {
  Json tests = Json::array();
  for (const auto& [key, experiments] : all) {
    Json& one = tests.emplace_back(sealed_question(key));
    one["experiments"] = Json::array();
    for (const Experiment& experiment : experiments) one["experiments"].push_back(json_of(experiment));
  }
  Json document{{"format", format}};
  if (!asked.empty()) document["asked"] = asked;
  document["tests"] = std::move(tests);
  return json_text(document);
}

std::optional<Experiment> obtain(const VirtualTest& test, const ExperimentSpec& spec, ExperimentStore& store) {
  if (std::optional<Experiment> known = store.find(test, spec)) return known;
  if (test.asked) test.asked->push_back(spec);
  if (test.asked || !test.run) return std::nullopt;
  const auto start = std::chrono::steady_clock::now();
  Experiment experiment{spec};
  try {
    experiment.results = test.run(spec.values, spec.seed);
    for (const Estimate& result : experiment.results)
      if (!std::isfinite(result.value) || !(result.std_error >= 0)) experiment.error = "a result is not a number";
  } catch (const NoSolution& failure) {
    experiment.error = failure.what();
  }
  if (!experiment.error.empty()) experiment.results.clear();
  experiment.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  store.add(test, experiment);
  if (test.on_saved) test.on_saved();
  return experiment;
}

namespace {

constexpr const char* batch_format = "soilbin-batch/1";

/// Sixteen digits of all that an experiment's answer follows from, beside its values and seed.
std::string test_key(const VirtualTest& test) {
  std::string text = test.identity;
  for (const Factor& factor : test.factors) text += '\n' + factor.name;
  return fnv1a_digits(text);
}

}  // namespace

std::string batch_text(const VirtualTest& test, const std::vector<ExperimentSpec>& batch) {
  Json experiments = Json::array();
  for (const ExperimentSpec& one : batch) {
    Json values = Json::object();
    for (std::size_t k = 0; k < test.factors.size(); ++k) values[test.factors[k].name] = one.values[k];
    experiments.push_back({{"seed", one.seed}, {"values", values}});
  }
  return json_text({{"format", batch_format}, {"test", test_key(test)}, {"experiments", experiments}});
}

std::vector<ExperimentSpec> parse_batch(const SourceText& source, const VirtualTest& test) {
  const std::string hint = "a batch is written by --ask";
  const Json document = parse_json(source, hint);
  return read_json_at(source.file, [&] {
    if (document.at("format") != batch_format)
      throw InputError(fmt::format("{}: expected the format '{}'\n  hint: {}", source.file, batch_format, hint));
    if (document.at("test") != test_key(test))
      throw InputError(
          fmt::format("{}: these experiments were asked for by another question\n  hint: all flags but those of the "
                      "batch are those that it was asked with",
                      source.file));
    std::vector<ExperimentSpec> batch;
    for (const Json& one : document.at("experiments")) {
      ExperimentSpec asked{Eigen::VectorXd(static_cast<Eigen::Index>(test.factors.size())),
                           one.at("seed").get<std::uint64_t>()};
      for (std::size_t k = 0; k < test.factors.size(); ++k)
        asked.values[k] = one.at("values").at(test.factors[k].name).get<double>();
      batch.push_back(std::move(asked));
    }
    return batch;
  });
}

}  // namespace soilbin::compare
