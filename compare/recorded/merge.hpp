// Records of shards put together: the bytes are those of the record that one process would have written, but for the
// seconds that each run took.
#pragma once

#include <filesystem>
#include <vector>

#include "compare/recorded/record.hpp"

namespace soilbin::compare {

/// A record and the file that it was read from, for messages.
struct NamedRecord {
  std::filesystem::path file;
  Record record;
};

/// All their runs in one record, in_order; any order of the shards gives the same one. A run that several hold with the
/// same answer is kept once (of seconds and sources those that compare first), so merging twice changes nothing. Throws
/// InputError for none, for records of other inputs, model or case (as each is written today), and where two hold the
/// same run with different answers; it names both files, the run, and what made each.
Record merged(const std::vector<NamedRecord>& shards);

}  // namespace soilbin::compare
