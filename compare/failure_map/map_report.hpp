// A failure map for people and machines: plain words, tables, heat maps, a page, JSON.
#pragma once

#include <nlohmann/json.hpp>

#include "compare/failure_map/map_story.hpp"
#include "compare/report/heat_map.hpp"
#include "compare/report/page.hpp"

namespace soilbin::compare {

/// Share of the box, by the map, in which |difference| is above the tolerance: over a grid of 9 nodes a factor.
double share_beyond(const MapStory& story);

/// Sentences, the most important first: how much of the box disagrees and to which side, where the models agree, how
/// well the map knows, what dimensionless groups do, what fresh conditions showed.
std::vector<std::string> map_summary(const MapStory& story);

/// What the page opens with, (what it is about, sentences): where the quick estimate may be trusted; where not and to
/// which side it errs; how sure that is.
std::vector<std::pair<std::string, std::string>> opening(const MapStory& story);

/// What else there is: scatter of the rows, dimensionless groups.
std::vector<std::string> details(const MapStory& story);

HtmlTable rows_table(const MapStory& story);
HtmlTable coordinates_table(const MapStory& story);
HtmlTable checks_table(const MapStory& story);

/// Difference [% of the load] over load (across) and angle (up), by the map, at these lug height [m] and slip; cells
/// count where the map is sure, with one-sided confidence 95 %, that the tolerance is passed.
HeatMap heat_map_of(const MapStory& story, double lug_height, double slip);

/// One HTML page. resolved_case: of the study whose wheel, soil and bin these are.
/// `about.title` stands in the page's subtitle: the title is the question that it answers.
std::string failure_map_page(const MapStory& story, const PageAbout& about, const std::string& resolved_case);

/// soilbin-failure-map/1, in SI.
nlohmann::ordered_json failure_map_json(const MapStory& story);

}  // namespace soilbin::compare
