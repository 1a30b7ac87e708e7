// What a wheel can do at best, as it is told; the rows of soilbin-limits/1.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <vector>

#include "compare/report/report.hpp"
#include "compare/sweep/wheel_limits.hpp"

namespace soilbin::compare {

/// Of each answer a table over the slopes and what the steepest one is. `at_limits`: answers_at_limits of the answers,
/// to which each row's remark belongs. All outlive the report.
Report report_on(const Case& question, const std::vector<WheelLimits>& answers,
                 const std::vector<ModelAnswers>& at_limits);

nlohmann::ordered_json limits_rows(const std::vector<WheelLimits>& answers);

}  // namespace soilbin::compare
