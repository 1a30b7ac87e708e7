// A drive as it is told: the analytic wheel's, and both models' side by side.
#pragma once

#include "compare/drives/drive.hpp"
#include "compare/drives/drive_sides.hpp"
#include "compare/report/report.hpp"

namespace soilbin::compare {

/// How it ended and where the work went; soilbin-drive/1. The drive outlives the report.
Report report_on(const AnalyticDrive& drive);

/// How each ended, then what differs at the end that both reach steadily; soilbin-drive-sides/1. The drive outlives the
/// report.
Report report_on(const DriveSides& drive);

}  // namespace soilbin::compare
