// A reproduction as it is told; soilbin-reproduction/1.
#pragma once

#include <string>

#include "compare/report/report.hpp"
#include "compare/reproduction/reproduction.hpp"

namespace soilbin::compare {

/// What a finding asks: "slope of drawbar pull along load, at slip 10 .. 60 %: at least 0".
std::string claim_in_words(const Finding& finding);

/// Conclusion and findings against models; folded each finding with its words, figure and intervals. The reproduction
/// outlives the report.
Report report_on(const Reproduction& reproduction);

}  // namespace soilbin::compare
