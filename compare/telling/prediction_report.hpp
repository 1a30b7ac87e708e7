// A campaign beside its prediction, as it is told; soilbin-predict/1.
#pragma once

#include <string>

#include "compare/measured/campaign.hpp"
#include "compare/report/report.hpp"
#include "compare/sweep/prediction.hpp"

namespace soilbin::compare {

/// Each run as measured and as predicted, then how far off each channel is. `soil_from`: where the soil and the effects
/// of the scenario asked come from, "the declared soil and not fitted". All outlive the report.
Report report_on(const Prediction& prediction, const Campaign& campaign, const Scenario& asked,
                 const std::string& soil_from);

}  // namespace soilbin::compare
