// A tire as it declares itself, where a command answers a question and nobody named the effect: with an inflation
// pressure it is flexible where it flattens, and with lugs it has their thrust. Campaigns, comparisons and fitted
// models keep to their declared effects.
//
//   Case question = ...;                                        // a tire of 270 kPa with lugs, no effects
//   for (const std::string& note : in_words(as_declared(question, {})))   // now with tire_flexibility and lug_thrust
//     fmt::print(stderr, "{}\n", note);
#pragma once

#include "compare/doubts/doubt.hpp"
#include "scenario/case.hpp"

namespace soilbin::compare {

/// What of a tire is left out although it declares it.
struct TireLeftOut {
  bool pressure = false;  ///< a rigid wheel
  bool lugs = false;      ///< a smooth one
  bool effects = false;   ///< every effect was switched off by name: the tire switches none on
};

/// Adds to the question's analytic models the effects of what its tire declares, one form each:
/// - tire_flexibility, carcass_spring, where it has a load-deflection table too, which that form reads
/// - tire_flexibility, flat_section, where every condition has an inflation pressure, its own or the tire's: it caps
///   the pressure under the tread at inflation and carcass pressure, so that a wheel that presses with less rolls as
///   the rigid one
/// - lug_thrust, passive_blade, for lugs, where one model is asked: of the forms it alone has the size of the pull that
///   lugs add in grains which resolve them (docs/lab/grain-size.md). A study that sets models side by side keeps to
///   them
/// Nothing of an effect that a model names, nor in a model that comes from a fit. What is left out is taken off the
/// tire. Gives a doubt for each thing added or left out for nothing, and one for a tire that is known by its size
/// alone. Throws InputError where a model names the effect of what is to be left out, where a condition tells the
/// pressure, and where grains are asked, which meet the tire with its lugs.
Doubts as_declared(Case& question, const TireLeftOut& left_out);

}  // namespace soilbin::compare
