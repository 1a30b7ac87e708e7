// A failure map as it is told; soilbin-failure-map/1.
#pragma once

#include <string>

#include "compare/failure_map/learned_map.hpp"
#include "compare/report/report.hpp"

namespace soilbin::compare {

/// What is told beside a map.
struct FailureMapAbout {
  std::string name;             ///< "Failure map: longitudinal"
  std::string resolved_case{};  ///< of the study whose wheel, soil and bin these are, as YAML
  bool show_rows = false;       ///< on a terminal; a page has them folded
};

/// Where the quick estimate may be trusted, where not and to which side it errs, how sure that is; the map at the lugs
/// and slip that a reader sets. The result outlives the report.
Report report_on(const FailureMapResult& result, const FailureMapAbout& about);

}  // namespace soilbin::compare
