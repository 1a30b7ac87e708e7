// Runs of the virtual soil bin written as a measured campaign, to test the loop: the grains are the nature that an
// analyst measures. What acts in them and is left out of the campaign, or of his model, is what the loop should find.
//
//   const CampaignOfRecords made = campaign_from_runs(scenario, joined_runs(records), told);
//   write_file_atomically(folder / "README.md", provenance_text(records, made, hidden_in_words({"pass"}, {}), by));
#pragma once

#include <set>
#include <string>
#include <vector>

#include "compare/measured/campaign.hpp"
#include "compare/recorded/run_store.hpp"

namespace soilbin::compare {

/// How runs are told to an analyst.
struct CampaignOptions {
  std::string name{};                   ///< of the campaign
  std::set<std::string> hide{};         ///< of things_to_hide(): left out of the campaign, as if it weren't there
  std::vector<EffectChoice> effects{};  ///< that his model already has
  bool only_steady = false;             ///< leaves out runs that did not become steady
  std::uint64_t seed = 1;               ///< of the order in which the rows are numbered
};

/// Names of what can be left untold: conditions ("longitudinal_incline", "pass", ...), "lugs" and "bin".
std::vector<std::string> things_to_hide();

/// A campaign and the run behind each of its rows, in the same order.
struct CampaignOfRecords {
  Campaign campaign;
  std::vector<RecordedRun> runs;
  std::size_t without_result = 0, not_steady = 0;  ///< runs left out, and why
};

/// The runs of all records, in their order. Throws InputError where wheel, grains, bed or rig aren't those of the
/// first.
std::vector<RecordedRun> joined_runs(const std::vector<NamedRecord>& records);

/// One row a run, in an order drawn at random, as a careful experimenter makes them: grains know no order, and one that
/// followed the conditions would look like a drift. Runs whose told conditions agree are re-runs of one setpoint. The
/// lateral force is told where any run was asked for at yaw or on a cross slope: elsewhere it is zero by symmetry. The
/// soil is the scenario's, which needs semi-empirical values. Throws InputError without them, for a word in `hide` that
/// isn't one of things_to_hide(), and where no run is left.
CampaignOfRecords campaign_from_runs(const Scenario& scenario, const std::vector<RecordedRun>& runs,
                                     const CampaignOptions& told);

/// A sentence of what the analyst is not told, and of the effects that his model has, as they were asked for.
std::string hidden_in_words(const std::vector<std::string>& hide, const std::vector<std::string>& effects);

/// Who made a campaign.
struct MadeBy {
  std::string version, source;  ///< of soilbin, and of the sources that it was built from
  std::string command;          ///< as it was typed
};

/// README.md of the campaign. `hidden`: hidden_in_words.
std::string provenance_text(const std::vector<NamedRecord>& records, const CampaignOfRecords& made,
                            const std::string& hidden, const MadeBy& by);

}  // namespace soilbin::compare
