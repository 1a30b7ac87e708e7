#include "compare/recorded/campaign_provenance.hpp"

#include <fmt/core.h>

#include "compare/sweep/varying.hpp"
#include "scenario/nearest_word.hpp"

namespace soilbin::compare {

void join(NamedRecord record, JoinedRecords& all) {
  all.records.push_back(std::move(record));
  const NamedRecord& last = all.records.back();
  refuse_other_inputs(last.record, all.records.front().record.inputs, last.file);
  all.runs.insert(all.runs.end(), last.record.runs.begin(), last.record.runs.end());
}

std::string hidden_in_words(const std::vector<std::string>& hide, const std::vector<std::string>& effects) {
  std::string text = hide.empty() ? "Nothing of the runs' conditions, wheel or bin was left out."
                                  : "Left out, as if it weren't there: " + listed(hide) + ".";
  if (!effects.empty()) text += " The declared model has " + listed(effects) + ".";
  return text;
}

std::string provenance_text(const JoinedRecords& joined, const CampaignOfRecords& made, const std::string& hidden,
                            const MadeBy& by) {
  std::string text = fmt::format(
      "# {}\n\nRuns of soilbin's virtual soil bin, told as a campaign. {}\n\nMade by soilbin {} ({}) with\n\n    "
      "{}\n\n",
      made.campaign.name, hidden, by.version, by.source, by.command);
  text += "| record | hash of its inputs | begun by |\n|---|---|---|\n";
  for (const auto& [file, record] : joined.records)
    text +=
        fmt::format("| {} | {} | soilbin {} |\n", file.filename().string(), inputs_key(record.inputs), record.soilbin);
  text += "\nWhat the runs follow from beside condition and packing, in SI:\n\n```\n";
  for (const auto& [name, value] : joined.records.front().record.inputs) text += name + " " + value + "\n";
  text +=
      "```\n\n| run | condition in the grains | packing (seed of the bed) | steady | drift | sources |\n"
      "|---|---|---|---|---|---|\n";
  for (std::size_t k = 0; k < made.runs.size(); ++k) {
    const RecordedRun& run = made.runs[k];
    text += fmt::format("| {} | {} | {} | {} | {:.3g} | {} |\n", k + 1, in_words(run.answer.at), run.packing,
                        run.steady ? "yes" : "no", run.drift, run.source);
  }
  return text;
}

}  // namespace soilbin::compare
