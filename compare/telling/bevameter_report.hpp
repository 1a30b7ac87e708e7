// What a virtual bevameter found in a soil's grains, as it is told; soilbin-bevameter/1.
#pragma once

#include "compare/bevameter/bevameter.hpp"
#include "compare/experiments/virtual_bevameter.hpp"
#include "compare/report/report.hpp"
#include "scenario/soil.hpp"

namespace soilbin::compare {

/// The values of the fit beside those of the soil's file, and what the fit leaves; curves as points, the fit as lines.
/// All outlive the report.
Report report_on(const BevameterFit& fit, const BevameterReadings& readings, const Soil& soil, int packings);

}  // namespace soilbin::compare
