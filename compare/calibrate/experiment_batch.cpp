#include "compare/calibrate/experiment_batch.hpp"

#include <fmt/core.h>

#include <nlohmann/json.hpp>

#include "compare/report/json_fields.hpp"
#include "compare/report/json_file.hpp"
#include "scenario/checksum.hpp"
#include "scenario/errors.hpp"

namespace soilbin::compare {
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
                      "batch are those "
                      "that it was asked with",
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
