// What a run's numerical choices change: the same condition with each of them halved or doubled.
#pragma once

#include "cli/soil_bin.hpp"

namespace soilbin::cli {

/// One choice changed.
struct Variant {
  std::string name;  ///< "bed twice as long"
  dem::DemSettings settings;
  Scenario scenario;
};

/// The choices as they are, first, then each changed: another packing, length, width and depth of the bed, warm-up,
/// time step, mesh of the tire, sampling time, skin.
std::vector<Variant> variants_of(const dem::DemSettings& settings, const Scenario& scenario);

/// Runs the variants of the question's only condition and prints what each changes, beside the standard error of the
/// difference. With a record, each variant is kept in a file of its own beside it. Throws InputError for more than one
/// condition.
int converge(const SoilBinFlags& flags, const Case& question, const EffectVocabulary& effects, bool json);

}  // namespace soilbin::cli
