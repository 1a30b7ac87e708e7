// Where a campaign of records comes from: the records that it was made of, joined, and its README.md, which tells how
// it was made and the run behind each row.
//
//   JoinedRecords joined;
//   for (const auto& file : files) join({file, read_record(file)}, joined);
//   const CampaignOfRecords made = tell_campaign(scenario, joined.runs, disclosed);
//   write_file_atomically(folder / "README.md", provenance_text(joined, made, hidden_in_words({"pass"}, {}), by));
#pragma once

#include <string>
#include <vector>

#include "compare/recorded/campaign_of_records.hpp"
#include "compare/recorded/merge.hpp"

namespace soilbin::compare {

struct JoinedRecords {
  std::vector<NamedRecord> records;
  std::vector<RecordedRun> runs;  ///< of all, in their order
};

/// Throws InputError where wheel, grains, bed or rig aren't those of the first record.
void join(NamedRecord record, JoinedRecords& all);

/// What the analyst is not told, and the effects that his model has, as they were asked for.
std::string hidden_in_words(const std::vector<std::string>& hide, const std::vector<std::string>& effects);

/// Who made a campaign.
struct MadeBy {
  std::string version, source;  ///< of soilbin, and of the sources that it was built from
  std::string command;          ///< as it was typed
};

/// README.md of the campaign. `hidden`: hidden_in_words.
std::string provenance_text(const JoinedRecords& joined, const CampaignOfRecords& made, const std::string& hidden,
                            const MadeBy& by);

}  // namespace soilbin::compare
