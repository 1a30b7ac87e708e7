// A tire that declares an inflation pressure is flexible where it flattens: what the commands that answer a question
// ask of the analytic wheel where nobody named the effect tire_flexibility. Campaigns and fitted models keep to their
// declared effects.
//
//   Case question = ...;                                                 // a tire of 270 kPa, no effects
//   for (const std::string& note : flexible_where_declared(question))    // now with tire_flexibility
//     fmt::print(stderr, "{}\n", note);
#pragma once

#include <string>
#include <vector>

#include "scenario/case.hpp"

namespace soilbin::compare {

/// Adds tire_flexibility, in its form flat_section, to the question's analytic models, where every condition has an
/// inflation pressure, its own or the tire's. That form caps the pressure under the tread at inflation and carcass
/// pressure: a wheel that presses with less rolls as the rigid one. Nothing where a model names the effect or comes
/// from a fit. Gives a sentence that says so.
std::vector<std::string> flexible_where_declared(Case& question);

/// The question with a rigid wheel: without the tire's inflation pressure. Gives a sentence where there was none.
/// Throws InputError where a model names tire_flexibility or a condition an inflation pressure.
std::vector<std::string> make_rigid(Case& question);

}  // namespace soilbin::compare
