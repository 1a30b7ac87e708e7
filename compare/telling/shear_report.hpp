// What measured shear tests gave, as it is told; soilbin-shear/1.
#pragma once

#include <span>
#include <string>

#include "compare/bevameter/measured_shear.hpp"
#include "compare/report/report.hpp"

namespace soilbin::compare {

/// c, phi and K, each test by itself, and the lines that a campaign or a soil file takes; readings and Janosi's curves
/// drawn. `file`: name of the readings' file. Fit and tests outlive the report.
Report report_on(const MeasuredShearFit& fit, std::span<const MeasuredShear> tests, const std::string& file);

}  // namespace soilbin::compare
