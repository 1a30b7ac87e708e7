// What is sampled over a drive, as columns of its data and as rows of a table: of a wheel, of its grains, of a vehicle
// and its axles.
#pragma once

#include <algorithm>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "compare/report/json_fields.hpp"
#include "compare/report/number_text.hpp"

namespace soilbin::compare {

/// A column, for any kind of sample.
template <class Sample>
struct DriveColumn {
  const char* name;
  std::function<double(const Sample&)> get;
};
template <class Sample>
using DriveColumns = std::vector<DriveColumn<Sample>>;

/// So many of the samples, evenly, the first and the last among them.
template <class Sample>
std::vector<Sample> picked_samples(const std::vector<Sample>& samples, std::size_t rows) {
  std::vector<Sample> some;
  rows = std::min(rows, samples.size());
  for (std::size_t row = 0; row < rows; ++row)
    some.push_back(samples[rows == 1 ? 0 : row * (samples.size() - 1) / (rows - 1)]);
  return some;
}
inline constexpr std::size_t shown_samples = 12;  ///< on a terminal

/// A slip in percent; "-" for a wheel that stands.
inline std::string slip_text(const std::optional<double>& slip) { return slip ? number(100 * *slip) : "-"; }

/// A list of values for each column.
template <class Sample>
Json columns_json(const DriveColumns<Sample>& columns, const std::vector<Sample>& samples) {
  Json all = Json::object();
  for (const DriveColumn<Sample>& column : columns)
    all[column.name] = list_of(samples, [&](const Sample& sample) { return finite(column.get(sample)); });
  return all;
}

}  // namespace soilbin::compare
