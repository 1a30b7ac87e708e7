// A tilting board that stands in for the virtual one in tests of calibrations and of their stores.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "compare/calibrate/experiment_store.hpp"
#include "scenario/unit.hpp"

namespace soilbin::compare {

/// One target, the board's angle of the paper, measured without error. What it answers is the test's to say.
inline VirtualTest stand_in_board(std::vector<Factor> factors, std::string identity = "stand-in board") {
  VirtualTest test;
  test.identity = std::move(identity);
  test.factors = std::move(factors);
  test.targets = {{"board_angle", {31.47 * degree, 0}, "deg"}};
  return test;
}

}  // namespace soilbin::compare
