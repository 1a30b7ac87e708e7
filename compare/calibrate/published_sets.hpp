// Sets of contact values that others published with what they got: our virtual test beside theirs.
#pragma once

#include <string>
#include <vector>

#include "compare/calibrate/experiment_store.hpp"
#include "compare/recorded/watch.hpp"
#include "scenario/source_text.hpp"

namespace soilbin::compare {

/// One row of the file, and ours.
struct PublishedSet {
  std::string name;
  Eigen::VectorXd values;         ///< of the test's factors [SI]
  std::vector<double> published;  ///< of the test's targets [SI]
  Experiment ours;
};

/// Reads a CSV with the columns `set`, one for each factor by its name (in its unit), and one for each target as
/// NAME_UNIT ("board_angle_deg"). Throws InputError at the place for a missing column or a cell that is no number.
std::vector<PublishedSet> parse_published_sets(const SourceText& source, const VirtualTest& test);

/// Runs each set, or takes it from the store.
void run_sets(std::vector<PublishedSet>& sets, const VirtualTest& test, std::uint64_t seed, ExperimentStore& store,
              const Watch& watch = {});

}  // namespace soilbin::compare
