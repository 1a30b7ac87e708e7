// Samples of a drive as columns of a file and as rows of a table, for any kind of sample: those of the analytic wheel,
// those of its grains.
#pragma once

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include "compare/report/json_fields.hpp"
#include "compare/report/number_text.hpp"
#include "scenario/drive_record.hpp"
#include "scenario/unit.hpp"

namespace soilbin::compare {

template <class Sample>
struct DriveColumn {
  const char* name;
  std::function<double(const Sample&)> get;
};
template <class Sample>
using DriveColumns = std::vector<DriveColumn<Sample>>;

/// What every kind of sample has: `of_its_own` stand behind the slip, `of_its_energy` at the end.
template <class Sample>
DriveColumns<Sample> drive_columns(const DriveColumns<Sample>& of_its_own, const DriveColumns<Sample>& of_its_energy) {
  using S = Sample;
  DriveColumns<S> all = {
      {"time_s", [](const S& s) { return s.time; }},
      {"travelled_m", [](const S& s) { return s.travelled; }},
      {"speed_m_s", [](const S& s) { return s.speed; }},
      {"rim_speed_m_s", [](const S& s) { return s.rim_speed; }},
      {"slip", [](const S& s) { return s.slip.value_or(not_a_number); }},
  };
  all.insert(all.end(), of_its_own.begin(), of_its_own.end());
  const DriveColumns<S> more = {
      {"sinkage_m", [](const S& s) { return s.sinkage; }},
      {"torque_Nm", [](const S& s) { return s.torque; }},
      {"soil_force_N", [](const S& s) { return s.forward; }},
      {"lateral_force_N", [](const S& s) { return s.lateral; }},
      {"drawbar_N", [](const S& s) { return s.drawbar; }},
      {"longitudinal_incline_deg", [](const S& s) { return s.longitudinal_incline / degree; }},
      {"motor_J", [](const S& s) { return s.energy.motor; }},
      {"kinetic_J", [](const S& s) { return s.energy.kinetic; }},
      {"height_J", [](const S& s) { return s.energy.height; }},
      {"drawbar_J", [](const S& s) { return s.energy.drawbar; }},
  };
  all.insert(all.end(), more.begin(), more.end());
  all.insert(all.end(), of_its_energy.begin(), of_its_energy.end());
  return all;
}

/// A list of values for each column.
template <class Sample>
Json columns_json(const DriveColumns<Sample>& columns, const std::vector<Sample>& samples) {
  Json all = Json::object();
  for (const DriveColumn<Sample>& column : columns) {
    Json& values = all[column.name] = Json::array();
    for (const Sample& sample : samples) values.push_back(finite(column.get(sample)));
  }
  return all;
}

/// "time_s,travelled_m,..."
template <class Sample>
std::string columns_csv(const DriveColumns<Sample>& columns) {
  std::string text;
  for (const DriveColumn<Sample>& column : columns) {
    if (!text.empty()) text += ',';
    text += column.name;
  }
  return text;
}

/// A sample's values; nothing between the commas for what is not a number.
template <class Sample>
std::string columns_csv(const DriveColumns<Sample>& columns, const Sample& sample) {
  std::string text;
  for (const DriveColumn<Sample>& column : columns) {
    const double value = column.get(sample);
    if (&column != columns.data()) text += ',';
    text += csv_number(value);
  }
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

/// In percent; "-" for a wheel that stands.
inline std::string slip_text(const DriveState& s) { return s.slip ? number(100 * *s.slip) : "-"; }

inline Json happenings_json(const std::vector<DriveHappening>& happenings) {
  Json rows = Json::array();
  for (const DriveHappening& h : happenings)
    rows.push_back({{"time", h.time}, {"travelled", h.travelled}, {"what", std::string(word_of(h.what))}});
  return rows;
}

}  // namespace soilbin::compare
