// A reproduction as words, JSON and an HTML page.
#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "compare/report/page.hpp"
#include "compare/report/plot.hpp"
#include "compare/reproduction/reproduction.hpp"

namespace soilbin::compare {

/// What a finding asks: "slope of drawbar pull along load, at slip 10 .. 60 %: at least 0".
std::string claim_in_words(const Finding& finding);

/// "12 shown, 3 not shown, 1 contradicted, 8 no data", of a label.
std::string tally(const Reproduction& reproduction, std::size_t label);

/// soilbin-reproduction/1.
nlohmann::ordered_json to_json(const Reproduction& reproduction);

/// "The analytic wheel shows 37 of 48 findings (2 contradicted), grains 20 of 31 findings (1 contradicted).": what the
/// page opens with.
std::string conclusion(const Reproduction& reproduction);

/// Of each label how many findings it shows, contradicts and leaves open, then the findings that every model with data
/// contradicts.
std::vector<std::pair<std::string, std::string>> opening(const Reproduction& reproduction);

/// Findings against models: shown, contradicted, open, or "-" where a model has no data; each cell leads to the
/// finding's figure.
Table findings_matrix(const Reproduction& reproduction);

/// Conclusion, matrix, doubts; folded each finding with its words, figure and intervals.
std::string reproduction_page(const Reproduction& reproduction, const PageAbout& about);

}  // namespace soilbin::compare
