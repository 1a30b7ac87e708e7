// Outcomes of the element tests as tables, sentences, JSON and curves.
#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "compare/report/page.hpp"
#include "dem/element_tests/angle_of_repose.hpp"
#include "dem/element_tests/bevameter_tests.hpp"
#include "dem/element_tests/direct_shear.hpp"
#include "dem/element_tests/tilting_board.hpp"
#include "dem/element_tests/triaxial.hpp"

namespace soilbin::compare {

/// One test's outcome: a table of its runs and sentences, SI and radians for programs, curves to draw.
struct TestReport {
  Table table;       ///< without a header: the test has one run, which the sentences tell
  std::string text;  ///< whole lines
  nlohmann::ordered_json json;
  Sheet sheet;
};

TestReport report_on(const dem::DirectShearResult& result);
TestReport report_on(const dem::TriaxialResult& result);
TestReport report_on(const dem::TiltingBoardResult& result);
TestReport report_on(const dem::AngleOfReposeResult& result);
TestReport report_on(const std::vector<dem::PlateRun>& runs);
TestReport report_on(const std::vector<dem::AnnulusRun>& runs);

}  // namespace soilbin::compare
