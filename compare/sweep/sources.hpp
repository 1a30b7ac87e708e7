// Where the numbers of a question come from: each value of its wheel and of its soil with its source.
#pragma once

#include <string>
#include <vector>

#include "compare/report/json_fields.hpp"
#include "compare/report/table.hpp"
#include "scenario/scenario.hpp"

namespace soilbin::compare {

struct SourcedValue {
  std::string of;           ///< "tire" or "soil"
  std::string key;          ///< as files name it: "lugs.height"
  std::string name;         ///< for people: "lug height"
  std::string unit;         ///< as files write it; "-" for a plain number
  double per_si;            ///< units per SI unit
  Estimate value;           ///< [SI]
  bool assumed_sd = false;  ///< its standard deviation is a share that the soil's file assumes
  std::string source;       ///< its own, else that of the whole; "not stated" where neither is
};

/// The declared values of the wheel, then those of the soil for the analytic model.
std::vector<SourcedValue> sourced_values(const Scenario& scenario);

/// "1.04 ± 0.10 kPa (± assumed)".
std::string in_words(const SourcedValue& value);

/// "sources" of soilbin-explain/1, in SI; and the same for people.
Json sources_json(const Scenario& scenario);
Table sources_table(const Scenario& scenario);

}  // namespace soilbin::compare
