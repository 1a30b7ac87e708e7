// A failure map for people and machines: plain words, tables, heat maps, a page, JSON.
#pragma once

#include <nlohmann/json.hpp>

#include "compare/failure_map/learned_map.hpp"
#include "compare/report/heat_map.hpp"
#include "compare/report/page.hpp"

namespace soilbin::compare {

/// Sentences, the most important first: how much of the box disagrees and to which side, where the models agree, how
/// well the map knows, what dimensionless groups do, what fresh conditions showed.
std::vector<std::string> map_summary(const FailureMapResult& result);

/// The answer in two lines, above the map.
std::string in_short(const FailureMapResult& result);

/// The whole answer, (what it is about, sentences): where the quick estimate may be trusted; where not and to
/// which side it errs; how sure that is.
std::vector<std::pair<std::string, std::string>> opening(const FailureMapResult& result);

/// What else there is: scatter of the rows, whether ratios without units would serve better.
std::vector<std::string> details(const FailureMapResult& result);

Table rows_table(const FailureMapResult& result);
Table coordinates_table(const FailureMapResult& result);
Table checks_table(const FailureMapResult& result);

/// Difference [% of the load] over load (across) and angle (up), by the map, at these lug height [m] and slip; cells
/// count where the map is sure, with one-sided confidence 95 %, that the tolerance is passed.
HeatMap heat_map_of(const FailureMapResult& result, double lug_height, double slip);

/// One HTML page. resolved_case: of the study whose wheel, soil and bin these are.
/// `about.title` stands in the page's subtitle: the title is the question that it answers.
std::string failure_map_page(const FailureMapResult& result, const PageAbout& about, const std::string& resolved_case);

/// soilbin-failure-map/1, in SI.
nlohmann::ordered_json failure_map_json(const FailureMapResult& result);

}  // namespace soilbin::compare
