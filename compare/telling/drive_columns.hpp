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
#include "scenario/drive_record.hpp"
#include "scenario/estimate.hpp"
#include "scenario/unit.hpp"

namespace soilbin::compare {

/// A column, for any kind of sample.
template <class Sample>
struct DriveColumn {
  const char* name;
  std::function<double(const Sample&)> get;
};
template <class Sample>
using DriveColumns = std::vector<DriveColumn<Sample>>;

/// Getters of a column: a part of a sample's energy, an angle in degrees, a slip (not a number while the wheel stands).
auto energy(auto part) {
  return [part](const auto& sample) { return std::invoke(part, sample.energy); };
}
auto in_degrees(auto angle) {
  return [angle](const auto& sample) { return sample.*angle / degree; };
}
inline constexpr auto slip_or_none = [](const auto& sample) { return sample.slip.value_or(not_a_number); };

/// Names of the columns, and a sample; nothing between the commas for what is not a number.
template <class Sample>
std::string names_csv(const DriveColumns<Sample>& columns, const std::string& prefix = "") {
  std::string text;
  for (const DriveColumn<Sample>& column : columns) text += (text.empty() ? "" : ",") + prefix + column.name;
  return text;
}
template <class Sample>
std::string sample_csv(const DriveColumns<Sample>& columns, const Sample& sample) {
  std::string text;
  for (const DriveColumn<Sample>& column : columns)
    text += (&column == columns.data() ? "" : ",") + csv_number(column.get(sample));
  return text;
}

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

/// How the drive ended with a value that was moved; nulls where the soil can't hold the wheels then.
inline Json moved_drive_json(double value, const std::optional<DriveEnd>& end, double end_time, double travelled) {
  if (!end) return {{"value", value}, {"end", nullptr}, {"end_time", nullptr}, {"travelled", nullptr}};
  return {{"value", value}, {"end", std::string(word_of(*end))}, {"end_time", end_time}, {"travelled", travelled}};
}

/// A list of values for each column.
template <class Sample>
Json columns_json(const DriveColumns<Sample>& columns, const std::vector<Sample>& samples) {
  Json all = Json::object();
  for (const DriveColumn<Sample>& column : columns)
    all[column.name] = list_of(samples, [&](const Sample& sample) { return finite(column.get(sample)); });
  return all;
}

}  // namespace soilbin::compare
