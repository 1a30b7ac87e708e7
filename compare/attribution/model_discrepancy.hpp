// Model discrepancy (Kennedy and O'Hagan 2001): a second attribution of the residual, in which the base model's own
// form may be wrong. One with an exact base model has no way to say so but to name effects that make up for it.
#pragma once

#include <optional>

#include "compare/attribution/candidates.hpp"

namespace soilbin::compare {

/// What the base model's own form may leave in the cells: smooth functions of its variables, load and slip, in every
/// channel, whitened to about 1 sd a cell each (the model discrepancy of Kennedy and O'Hagan 2001, J.
/// R. Stat. Soc. B 63:425).
Eigen::MatrixXd model_discrepancy_columns(const FittedModel& base);

/// An attribution of the same observations in which the base model may be off by such functions.
struct DiscrepancyAttribution {
  double size = 0.0;  ///< sd of each function's weight, in sd of the noise: the one that explains the data best
  /// Its ln evidence stands beside that of the first attribution, the price of the size paid.
  Attribution found;
};

/// Finds signatures, fits and weighs the effects of the catalogue once more, now that load and slip alone explain
/// nothing. Nothing where either attribution is far from the noise (Candidates::none_near_noise), or no soil carries
/// the wheel.
std::optional<DiscrepancyAttribution> attribute_with_model_discrepancy(const Attribution& first,
                                                                       const AttributionOptions& options);

}  // namespace soilbin::compare
