// A reproduction as words, JSON and an HTML page.
#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "compare/report/page.hpp"
#include "compare/reproduction/reproduction.hpp"

namespace soilbin::compare {

/// What a finding asks: "slope of drawbar pull along load, at slip 10 .. 60 %: at least 0".
std::string claim_in_words(const Finding& finding);

/// "0.31 (0.24 .. 0.38)", in the statistic's unit; "" without an interval.
std::string interval_in_words(const Finding& finding, const Evidence& evidence);

/// "12 shown, 3 not shown, 1 contradicted, 8 no data", of a label.
std::string tally(const Reproduction& reproduction, std::size_t label);

/// soilbin-reproduction/1.
nlohmann::ordered_json to_json(const Reproduction& reproduction);

std::string reproduction_page(const Reproduction& reproduction, const PageAbout& about);

}  // namespace soilbin::compare
