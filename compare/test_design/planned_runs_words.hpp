// Runs to make in words, tables, JSON and as a file to fill in.
//
//   for (const std::string& sentence : in_sentences(design)) fmt::print("{}\n", sentence);
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "compare/report/table.hpp"
#include "compare/test_design/planned_runs.hpp"

namespace soilbin::compare {

/// What the plan is expected to tell, in two or three sentences.
std::vector<std::string> in_sentences(const TestDesign& design);
/// The runs; each effect with what it is most easily taken for, by the plan and by the sweep.
Table runs_table(const TestDesign& design);
Table pairs_table(const TestDesign& design);

/// The rows as a CSV in the campaign's own columns and units, the channels to measure empty.
std::string rows_to_fill_in(const TestDesign& design);

/// soilbin-design/1.
nlohmann::ordered_json to_json(const TestDesign& design);

}  // namespace soilbin::compare
