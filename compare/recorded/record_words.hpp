// A record told to a person: how many runs it holds of which packing, who made them, and whether they hang on the time
// step. `soilbin record show` prints it.
#pragma once

#include <string>

#include "compare/recorded/run_store.hpp"
#include "compare/report/table.hpp"

namespace soilbin::compare {

/// A row a packing: runs, those with a result, those that became steady, seconds of work.
Table packings_table(const Record& record);

/// Model, makers, hash of the inputs; packings_table; a line for each pair of the time step (step_pair.hpp).
std::string in_words(const NamedRecord& record);

}  // namespace soilbin::compare
