// What is sampled over a drive, as columns of its data: of a wheel, of its grains, of a vehicle and its axles.
#pragma once

#include <functional>
#include <vector>

#include "compare/report/json_fields.hpp"

namespace soilbin::compare {

/// A column, for any kind of sample.
template <class Sample>
struct DriveColumn {
  const char* name;
  std::function<double(const Sample&)> get;
};
template <class Sample>
using DriveColumns = std::vector<DriveColumn<Sample>>;

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

}  // namespace soilbin::compare
