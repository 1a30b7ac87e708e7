// Runs of the virtual soil bin written as a measured campaign, to test the loop: the grains are the nature that an
// analyst measures. What acts in them and is left out of the campaign, or of his model, is what the loop should find.
#pragma once

#include <set>
#include <string>
#include <vector>

#include "compare/measured/campaign.hpp"
#include "compare/recorded/record.hpp"

namespace soilbin::compare {

/// What the analyst is told.
struct Disclosure {
  std::string name{};                   ///< of the campaign
  std::set<std::string> hide{};         ///< of things_to_hide(): left out of the campaign, as if it weren't there
  std::vector<EffectChoice> effects{};  ///< that his model already has
  bool only_steady = false;             ///< leaves out runs that did not become steady
  std::uint64_t seed = 1;               ///< of the order in which the rows are numbered
};

/// What can be left untold: conditions ("longitudinal_incline", "pass", ...), "lugs" and "bin".
std::vector<std::string> things_to_hide();

/// A campaign and the run behind each of its rows, in the same order.
struct CampaignOfRecords {
  Campaign campaign;
  std::vector<RecordedRun> runs;
  std::size_t without_result = 0, not_steady = 0;  ///< runs left out, and why
};

/// One row a run, in an order drawn at random, as a careful experimenter makes them: grains know no order, and one that
/// followed the conditions would look like a drift. Runs whose told conditions agree are re-runs of one setpoint. The
/// lateral force is told where any run was asked for at yaw or on a cross slope: elsewhere it is zero by symmetry. The
/// soil is the scenario's, which needs semi-empirical values. Throws InputError without them, for a word in `hide` that
/// isn't one of things_to_hide(), and where no run is left.
CampaignOfRecords tell_campaign(const Scenario& scenario, const std::vector<RecordedRun>& runs,
                                const Disclosure& disclosed);

}  // namespace soilbin::compare
