// Outcomes of the element tests as they are told: their runs, what they give, curves; soilbin-element-test/1. `soil`:
// the name of the soil whose grains were tested.
#pragma once

#include <string>
#include <vector>

#include "compare/report/report.hpp"
#include "dem/element_tests/angle_of_repose.hpp"
#include "dem/element_tests/bevameter_tests.hpp"
#include "dem/element_tests/direct_shear.hpp"
#include "dem/element_tests/tilting_board.hpp"
#include "dem/element_tests/triaxial.hpp"

namespace soilbin::compare {

Report report_on(const dem::DirectShearResult& result, const std::string& soil);
Report report_on(const dem::TriaxialResult& result, const std::string& soil);
Report report_on(const dem::TiltingBoardResult& result, const std::string& soil);
Report report_on(const dem::AngleOfReposeResult& result, const std::string& soil);
Report report_on(const std::vector<dem::PlateRun>& runs, const std::string& soil);
Report report_on(const std::vector<dem::AnnulusRun>& runs, const std::string& soil);

}  // namespace soilbin::compare
