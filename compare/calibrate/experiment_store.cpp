#include "compare/calibrate/experiment_store.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <nlohmann/json.hpp>

#include "compare/report/json_fields.hpp"
#include "compare/report/sealed_json.hpp"
#include "scenario/atomic_file.hpp"
#include "scenario/checksum.hpp"
#include "scenario/errors.hpp"
#include "scenario/source_text.hpp"

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

/// What a test is, with its seal.
Json sealed_question(const std::string& key) {
  Json question = {{"test", key}};
  put_seal(question);
  return question;
}

Json json_of(const StoredExperiment& stored) {
  const Experiment& experiment = stored.experiment;
  Json values = Json::array(), results = Json::array();
  for (const double value : experiment.values) values.push_back(value);
  for (const Estimate& result : experiment.results) results.push_back({result.value, result.std_error});
  Json json{{"values", values}, {"seed", experiment.seed}, {"results", results}, {"seconds", experiment.seconds}};
  if (!experiment.error.empty()) json["error"] = experiment.error;
  if (stored.sealed) put_seal(json);
  return json;
}

StoredExperiment experiment_of(const Json& json, const std::string& place) {
  StoredExperiment stored;
  stored.sealed =
      check_seal(json, place, "take this experiment out of the file, and it is made again when it is needed") ==
      Seal::whole;
  Experiment& experiment = stored.experiment;
  const std::vector<double> values = json.at("values").get<std::vector<double>>();
  experiment.values = Eigen::Map<const Eigen::VectorXd>(values.data(), static_cast<Eigen::Index>(values.size()));
  experiment.seed = json.at("seed").get<std::uint64_t>();
  for (const Json& result : json.at("results"))
    experiment.results.push_back({result.at(0).get<double>(), result.at(1).get<double>()});
  experiment.seconds = json.at("seconds").get<double>();
  experiment.error = json.value("error", "");
  return stored;
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

bool same_question(const Experiment& experiment, const Eigen::VectorXd& values, std::uint64_t seed) {
  return experiment.seed == seed && experiment.values.size() == values.size() && experiment.values == values;
}

}  // namespace

ExperimentStore::ExperimentStore(std::filesystem::path file, Writers writers)
    : file_(std::move(file)), writers_(writers) {
  read();
}

/// What is in the file now, in place of what was known; what is known stays where there is none.
void ExperimentStore::read() {
  if (file_.empty() || !std::filesystem::exists(file_)) return;
  const std::string other = "name another file, or move this one away";
  const SourceText source = read_source_text(file_, largest_json);
  const Json document = parse_json(source, other);
  if (!document.is_object() || document.value("format", "") != format)
    throw InputError({file_.string(), 0, 0}, fmt::format("not a store of experiments ({})", format), "", other);
  std::vector<OfOneTest> tests;
  const std::string file = file_.string() + ": tests";
  for (const Json& test : read_json_at(file, [&] { return document.at("tests"); })) {
    const std::string place = fmt::format("{}[{}]", file, tests.size());
    read_json_at(place, [&] {
      tests.push_back({test.at("test").get<std::string>(), {}});
      Json question = sealed_question(tests.back().key);
      if (test.contains("seal")) question["seal"] = test["seal"];
      check_seal(question, place + ".test", "take this test out of the file, and its experiments are made again");
      return test.at("experiments").size();
    });
    std::vector<StoredExperiment>& into = tests.back().experiments;
    for (const Json& experiment : test.at("experiments")) {
      const std::string where = fmt::format("{}.experiments[{}]", place, into.size());
      into.push_back(read_json_at(where, [&] { return experiment_of(experiment, where); }));
    }
  }
  tests_ = std::move(tests);
}

std::optional<Experiment> ExperimentStore::find(const VirtualTest& test, const Eigen::VectorXd& values,
                                                std::uint64_t seed) const {
  const std::string key = key_of(test);
  std::optional<Experiment> older;
  for (const OfOneTest& known : tests_)
    if (same_but_for_version(key, known.key))
      for (const StoredExperiment& stored : known.experiments)
        if (same_question(stored.experiment, values, seed)) {
          if (known.key == key) return stored.experiment;
          older = stored.experiment;
        }
  return older;
}

void ExperimentStore::keep(const VirtualTest& test, const Experiment& experiment) {
  add([&] { put(key_of(test), experiment); });
}

void ExperimentStore::take(const std::filesystem::path& other) {
  if (!std::filesystem::exists(other)) throw InputError(other.string() + ": no such file");
  const ExperimentStore theirs(other);
  add([&] {
    for (const OfOneTest& test : theirs.tests_)
      for (const StoredExperiment& stored : test.experiments) {
        const Experiment& fresh = stored.experiment;
        for (const OfOneTest& mine : tests_)
          if (mine.key == test.key)
            for (const StoredExperiment& known : mine.experiments)
              if (same_question(known.experiment, fresh.values, fresh.seed) && !same_answer(known.experiment, fresh))
                throw InputError(
                    fmt::format("{}: another answer to an experiment than in {}\n  hint: the same program gives the "
                                "same bits on every machine; different sources may not",
                                other.string(), file_.string()));
        put(test.key, fresh);
      }
  });
}

/// Makes a change beside what the file has by now, and writes the file.
void ExperimentStore::add(const std::function<void()>& change) {
  if (file_.empty()) return change();
  const std::filesystem::path folder = file_.has_parent_path() ? file_.parent_path() : std::filesystem::path(".");
  make_folder(folder);
  std::optional<FileLock> lock;
  if (writers_ == Writers::several) lock.emplace(folder, FileLock::Wait::until_free);
  read();  // what other processes have finished meanwhile
  change();
  write_file_atomically(file_, text());
}

void ExperimentStore::put(const std::string& key, const Experiment& experiment) {
  const auto known = std::ranges::find_if(tests_, [&](const OfOneTest& one) { return one.key == key; });
  OfOneTest& into = known != tests_.end() ? *known : tests_.emplace_back(OfOneTest{key, {}});
  std::erase_if(into.experiments, [&](const StoredExperiment& old) {
    return same_question(old.experiment, experiment.values, experiment.seed);
  });
  into.experiments.push_back({experiment, true});
}

std::size_t ExperimentStore::unsealed() const {
  std::ptrdiff_t sum = 0;
  for (const OfOneTest& test : tests_)
    sum += std::ranges::count_if(test.experiments, [](const auto& one) { return !one.sealed; });
  return static_cast<std::size_t>(sum);
}

std::size_t ExperimentStore::of_other_engines(const VirtualTest& test) const {
  const std::string key = key_of(test);
  std::size_t sum = 0;
  for (const OfOneTest& known : tests_)
    if (known.key != key && same_but_for_version(key, known.key)) sum += known.experiments.size();
  return sum;
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
    for (const StoredExperiment& stored : test.experiments) experiments.push_back(json_of(stored));
    Json one = sealed_question(test.key);
    one["experiments"] = experiments;
    tests.push_back(std::move(one));
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
  if (test.on_saved) test.on_saved();
  return {std::move(experiment), false};
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

VirtualTest only_asking(VirtualTest test) {
  test.run = [](const Eigen::VectorXd& values, std::uint64_t seed) -> std::vector<Estimate> {
    throw ExperimentsAsked({{values, seed}});
  };
  return test;
}

std::string batch_text(const VirtualTest& test, const std::vector<AskedExperiment>& batch) {
  Json experiments = Json::array();
  for (const AskedExperiment& one : batch) {
    Json values = Json::object();
    for (std::size_t k = 0; k < test.factors.size(); ++k) values[test.factors[k].name] = one.values[k];
    experiments.push_back({{"seed", one.seed}, {"values", values}});
  }
  return json_text({{"format", batch_format}, {"test", test_key(test)}, {"experiments", experiments}});
}

std::vector<AskedExperiment> parse_batch(const SourceText& source, const VirtualTest& test) {
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
    std::vector<AskedExperiment> batch;
    for (const Json& one : document.at("experiments")) {
      AskedExperiment asked{Eigen::VectorXd(static_cast<Eigen::Index>(test.factors.size())),
                            one.at("seed").get<std::uint64_t>()};
      for (std::size_t k = 0; k < test.factors.size(); ++k)
        asked.values[k] = one.at("values").at(test.factors[k].name).get<double>();
      batch.push_back(std::move(asked));
    }
    return batch;
  });
}

}  // namespace soilbin::compare
