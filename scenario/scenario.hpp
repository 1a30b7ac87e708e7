// A question without its operating point (tire, soil, bin, effects), and the interface through which every model
// answers it.
//
//   const TractionResult result = bekker_wong::BekkerWong().evaluate(scenario, {.load = 4000, .slip = 0.2});
//   result.drawbar_pull.value, result.drawbar_pull.std_error  // [N]
#pragma once

#include <array>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "scenario/operating_condition.hpp"
#include "scenario/soil.hpp"
#include "scenario/tire.hpp"
#include "scenario/traction_result.hpp"

namespace soilbin {

/// The soil bin's inner measures [m]; only some effects ask for them.
struct Bin {
  double depth = 0.0;
  double width = 0.0;
};

/// An effect that a case switches on, as a person names it. Parameters left out keep the form's defaults.
struct EffectChoice {
  std::string id;                            ///< of the catalogue, e.g. "slip_sinkage"
  std::string form;                          ///< of the effect, e.g. "lyasko"; empty: the effect's first form
  std::map<std::string, double> parameters;  ///< SI units
};

/// How well a fit knows a parameter, and how its error hangs together with those of others (fitted_errors.hpp).
struct FittedError {
  std::string parameter;             ///< of the soil, "k_phi", or of an effect, "slip_sinkage.a"
  std::optional<double> std_error;   ///< of an effect's [SI]; a soil value's stands with the soil
  std::vector<double> correlations;  ///< with each of those before it in the list; empty: with none
};

/// How far a fitted model missed runs that its fit had not seen, beyond their noise: root mean squares of the four
/// traction_channels [SI]; 0: not known, or no more than noise.
using Misfit = std::array<double, 4>;

/// Everything but the operating condition: which tire, on which soil, seen through which effects.
struct Scenario {
  Tire tire;
  Soil soil;
  std::optional<Bin> bin;
  std::vector<EffectChoice> effects;
  std::vector<FittedError> errors = {};  ///< of soil and effects where a fit found them; others err independently
  Misfit misfit = {};                    ///< of a fitted model: a part of every standard error
};

/// One way of answering: semi-empirical, discrete elements, or measurements.
struct Model {
  virtual ~Model() = default;
  /// Name as the command and the files spell it, e.g. "bekker_wong".
  virtual std::string name() const = 0;
  /// Throws InputError where the scenario lacks what this model needs, NoSolution where it has no answer.
  virtual TractionResult evaluate(const Scenario&, const OperatingCondition&) const = 0;
};

}  // namespace soilbin
