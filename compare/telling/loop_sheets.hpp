// The figures of a loop's answer: measured values beside the model before and after. Before: the base model, its soil
// refitted. After: the model with the effects that the answer's model uses. Colours and names are the same in all of
// them.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "compare/loop/loop.hpp"
#include "compare/report/plot.hpp"

namespace soilbin::compare {

/// The curves against slip that a figure of the fit shows: (name of the curve, its rows), the one that the effects
/// change most first. Empty where the runs do not lie on curves against slip: fewer than half of
/// them have three others at other slips under the same conditions, or there are more than a dozen curves.
std::vector<std::pair<std::string, std::vector<int>>> curves_of_the_fit(const LoopAnswer& answer);

/// Each channel of these rows against slip, with both models at the mean of the rows' conditions.
Sheet fit_sheet(const LoopAnswer& answer, const std::vector<int>& rows);

/// What the base model misses in each channel's unit over one variable, beside what the effects change.
Sheet gap_sheet(const LoopAnswer& answer, const Covariate& x);

/// Residuals over one variable before and after [sd of the noise].
Sheet residual_sheet(const LoopAnswer& answer, const Covariate& x);

/// The effects' change of the prediction over the base model's residual [sd of the noise].
Sheet signature_sheet(const LoopAnswer& answer, const Covariate& x);

/// The variables of the campaign, first the one on which the effects' change depends most.
std::vector<Covariate> variables_by_weight(const LoopAnswer& answer);

}  // namespace soilbin::compare
