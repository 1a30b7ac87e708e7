// All differences of a pair at once, with the soil's doubt that they share.
#pragma once

#include <optional>

#include "compare/discrepancy/side.hpp"

namespace soilbin::compare {

/// chi2 = d' (D + J S J')^-1 d over all channels and conditions: D, the reference's variances; S, the declared
/// variances of the soil's values; J, the model's derivatives by them. The soil's doubt moves all conditions together,
/// which rows taken one by one can't tell. First order in the soil's values.
struct JointTest {
  std::size_t side = 0, reference = 0;
  std::size_t values = 0;
  double chi2 = 0.0;
  double p_value = 1.0;           ///< of chi2 with `values` degrees of freedom
  double chi2_soil_exact = 0.0;   ///< the same with S = 0: what the soil's doubt takes away is the rest
  std::vector<std::string> soil;  ///< values that were free to move
};

/// Nothing where a value of the reference has no standard error, where the model has no balance at some condition, or
/// where there is no semi-empirical soil.
std::optional<JointTest> joint_test(const Side& reference, const Case& question,
                                    const std::vector<EffectChoice>& effects);

}  // namespace soilbin::compare
