// What measured plate tests gave, as it is told; soilbin-plates/1.
#pragma once

#include <span>
#include <string>

#include "compare/bevameter/measured_plates.hpp"
#include "compare/report/report.hpp"

namespace soilbin::compare {

/// The values with the parts of their errors, each plate by itself, what was set aside, and the lines that a campaign
/// or a soil file takes; readings and Bekker's form drawn. `file`: name of the readings' file. Fit and plates outlive
/// the report.
Report report_on(const MeasuredPlatesFit& fit, std::span<const MeasuredPlate> plates, const std::string& file);

}  // namespace soilbin::compare
