// A sheet of plots as data: for the scripts of a page, and for who wants a figure's numbers.
#pragma once

#include <nlohmann/json.hpp>

#include "compare/report/plot.hpp"

namespace soilbin::compare {

/// {"title", "plots": [{"title", "x": {"title", "lower", "upper"}, "y", "series": [{"label", "x", "y", "error", "base",
/// "mark", "color": "c0", "dash"}]}]}; numbers have six digits, and what is not a number is null.
nlohmann::ordered_json to_json(const Sheet& sheet);

/// The same as CSV, a row a point: plot, series, x, y (of an area what it adds to the pile), error.
std::string sheet_csv(const Sheet& sheet);

}  // namespace soilbin::compare
