// A failure map for people and machines: plain words, tables, heat maps, a page, JSON.
#pragma once

#include <nlohmann/json.hpp>

#include "compare/failure_map/incline_map.hpp"
#include "compare/report/heat_map.hpp"
#include "compare/report/page.hpp"

namespace soilbin::compare {

// A failure map learnt, with all that is to be said of it: where the models agree, how well the map knows, what there
// is to doubt. map_report.hpp puts it into words, tables, pictures and JSON.
//
//   const MapStory story = learn_map(map, grains, store, {.tolerance = 0.1});
//   for (const std::string& sentence : map_summary(story)) fmt::print("{}\n", sentence);

/// A map and what was found with it.
struct MapStory {
  InclineMap map;
  FailureQuestion question;
  FailureMap rows;
  std::vector<AgreementClause> clauses;  ///< where the models agree
  std::vector<Coordinates> coordinates;
  std::vector<FreshCheck> checks;
};

/// How a map is learnt.
struct MapLearning {
  FailureMapOptions runs{};   ///< which conditions are run
  int rounds = 4;             ///< further runs for each clause (agreement)
  int fresh = 0;              ///< conditions that are predicted, then run (check_fresh)
  double tolerance = 0.10;    ///< share of the load beyond which the models count as different
  std::uint64_t packing = 1;  ///< seed of the bed
};

/// Throws what map_failures throws. `grains` and `store` must outlive the story.
MapStory learn_map(const InclineMap& map, const VirtualTest& grains, ExperimentStore& store, const MapLearning& how);

/// Of both models' answers where they were run, and of the runs that the store took from an earlier engine.
std::vector<std::string> doubts_of(const MapStory& story, const VirtualTest& grains, const ExperimentStore& store);

/// Share of the box, by the map, in which |difference| is above the tolerance: over a grid of 9 nodes a factor.
double share_beyond(const MapStory& story);

/// Sentences, the most important first: how much of the box disagrees and to which side, where the models agree, how
/// well the map knows, what dimensionless groups do, what fresh conditions showed.
std::vector<std::string> map_summary(const MapStory& story);

/// The answer in two lines, above the map.
std::string in_short(const MapStory& story);

/// The whole answer, (what it is about, sentences): where the quick estimate may be trusted; where not and to
/// which side it errs; how sure that is.
std::vector<std::pair<std::string, std::string>> opening(const MapStory& story);

/// What else there is: scatter of the rows, whether ratios without units would serve better.
std::vector<std::string> details(const MapStory& story);

Table rows_table(const MapStory& story);
Table coordinates_table(const MapStory& story);
Table checks_table(const MapStory& story);

/// Difference [% of the load] over load (across) and angle (up), by the map, at these lug height [m] and slip; cells
/// count where the map is sure, with one-sided confidence 95 %, that the tolerance is passed.
HeatMap heat_map_of(const MapStory& story, double lug_height, double slip);

/// One HTML page. resolved_case: of the study whose wheel, soil and bin these are.
/// `about.title` stands in the page's subtitle: the title is the question that it answers.
std::string failure_map_page(const MapStory& story, const PageAbout& about, const std::string& resolved_case);

/// soilbin-failure-map/1, in SI.
nlohmann::ordered_json failure_map_json(const MapStory& story);

}  // namespace soilbin::compare
