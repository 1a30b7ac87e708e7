// What the best candidate puts into the answer: effects with their errors, the soil refitted with them.
#pragma once

#include <map>
#include <string>
#include <utility>
#include <vector>

#include "compare/loop/candidates.hpp"

namespace soilbin::compare {

/// An effect that the loop accepts, in the form that fits best.
struct AcceptedEffect {
  EffectChoice choice;                          ///< with fitted parameters [SI]
  std::vector<std::string> fitted;              ///< names of the parameters that were fitted
  std::vector<std::pair<double, double>> ci95;  ///< of each fitted parameter, cut off at its bounds
  std::vector<bool> at_bound;                   ///< of each: the fit ended at a bound, where its form ends
  double p_value = 1.0;                         ///< family-wise, beside the other accepted effects
  std::map<std::string, double> cosines;        ///< of its signature with each other effect's: what separates them
};

/// A soil value refitted with the accepted effects and without: the difference is the bias of leaving them out.
struct SoilShift {
  std::string name;
  Estimate with, without;  ///< [SI]
};

/// The effects of a candidate, with errors; p-values and cosines are those of effects that stand in (1, none).
std::vector<AcceptedEffect> effects_of(const CandidateModel& candidate);

/// The same with the p-value and the cosines of each.
std::vector<AcceptedEffect> accepted_effects(const Attribution& found, const AttributionOptions& options);

/// Of each free soil value, beside a model with effects and beside the base model.
std::vector<SoilShift> soil_shifts(const FittedModel& with, const FittedModel& without);

}  // namespace soilbin::compare
