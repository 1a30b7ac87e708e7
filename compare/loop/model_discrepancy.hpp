// A base model whose form isn't the soil's. On soils that no equation was made for, the loop's first reading has no way
// to say so but to name effects that make up for it; this is the second one.
#pragma once

#include <optional>

#include "compare/loop/identify.hpp"

namespace soilbin::compare {

/// What the base model's own form may leave in the cells: smooth functions of its variables, load and slip, in every
/// channel, whitened to about 1 sd a cell each (Kennedy and O'Hagan 2001, J. R. Stat. Soc. B 63:425).
Eigen::MatrixXd model_discrepancy_columns(const Identification& id);

/// A reading of the same observations in which the base model may be off by such functions.
struct DiscrepancyReading {
  double size = 0.0;  ///< sd of each function's weight, in sd of the noise: the one that explains the data best
  /// Its ln evidence stands beside that of the first reading, the price of the size paid.
  Identification identification;
};

/// Traces, fits and weighs the effects of the catalogue once more, now that load and slip alone explain nothing.
/// Nothing where a reading is far from the noise (Identification::none_near_noise), or no soil carries the wheel.
std::optional<DiscrepancyReading> read_with_model_discrepancy(const Campaign& campaign, const Identification& first,
                                                              const IdentifyOptions& options);

}  // namespace soilbin::compare
