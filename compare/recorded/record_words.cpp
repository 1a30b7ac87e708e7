#include "compare/recorded/record_words.hpp"

#include <fmt/core.h>

#include <map>
#include <set>

#include "compare/recorded/step_pair.hpp"
#include "compare/report/number_text.hpp"
#include "scenario/nearest_word.hpp"

namespace soilbin::compare {

Table packings_table(const Record& record) {
  struct Line {
    std::size_t runs = 0, answers = 0, steady = 0;
    double seconds = 0;
  };
  std::map<std::uint64_t, Line> packings;
  for (const RecordedRun& run : record.runs) {
    Line& line = packings[run.packing];
    ++line.runs, line.seconds += run.seconds;
    line.answers += run.answer.result.has_value(), line.steady += run.answer.result && run.steady;
  }
  Table table{"", {"bed sample", "runs", "with a result", "steady", "seconds"}};
  for (const auto& [packing, line] : packings)
    table.add({std::to_string(packing), std::to_string(line.runs), std::to_string(line.answers),
               std::to_string(line.steady), fmt::format("{:.0f}", line.seconds)});
  return table;
}

std::string in_words(const NamedRecord& named) {
  const Record& record = named.record;
  std::set<std::string> sources;
  for (const RecordedRun& run : record.runs) sources.insert(run.source);
  std::string text = fmt::format("{}: {} by {}, {} at half the time step\nmade by   {} of soilbin {}\ninputs    {}\n{}",
                                 named.file.string(), counted(record.runs.size(), "run"), record.model,
                                 record.half_step.size(), listed({sources.begin(), sources.end()}), record.soilbin,
                                 inputs_key(record.inputs), as_text(packings_table(record)));
  if (!record.coarser.empty()) text += fmt::format("{} with coarser grains\n", counted(record.coarser.size(), "run"));
  for (const StepPair& pair : step_pairs(record)) text += in_words(pair) + "\n";
  return text;
}

}  // namespace soilbin::compare
