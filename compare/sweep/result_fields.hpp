// A result's members as JSON keys, for the visitors of json_fields.hpp. The names are the contract's.
#pragma once

#include "compare/measured/channels.hpp"

namespace soilbin::compare {

/// Four results, their standard errors, efficiency, angles, budget. `result`: a TractionResult, const or not.
template <class Visitor, class Result>
void result_fields(Visitor& v, Result& result) {
  for (const ChannelView& channel : channel_views)
    v.number(channel.name, (result.*channel.predicted).value, channel.si_unit, channel.title.data());
  v.number("theta_1", result.entry_angle, "rad", "where soil meets the wheel, from the vertical");
  v.group("std_error", "standard errors", [&](auto& inner) {
    for (const ChannelView& channel : channel_views)
      inner.number(channel.name, (result.*channel.predicted).std_error, channel.si_unit, channel.title.data());
  });
  v.number("tractive_efficiency", result.tractive_efficiency, "-",
           "power at the drawbar over power put in; an efficiency from 0 to 1");
  v.number("theta_m", result.max_stress_angle, "rad", "where soil presses most");
  v.number("theta_2", result.exit_angle, "rad", "where soil lets go; negative behind the axle");
  v.list("budget", result.budget, "parts of the drawbar pull", [](auto& inner, auto& part) {
    inner.text("name", part.name, "what pulls");
    inner.number("force", part.force, "N", "its part");
  });
  v.added_group("budget_rest", "what the parts leave of the drawbar pull", [&](auto& inner) {
    inner.number("force", result.budget_rest.force, "N", "drawbar pull less the sum of the parts");
    inner.number("bound", result.budget_rest.bound, "N", "largest rest that is no sign of a fault; null: not known");
  });
}

/// Stresses under the wheel.
template <class Visitor, class Result>
void stress_fields(Visitor& v, Result& result) {
  v.list("patch", result.patch, "stresses under the wheel, from exit to entry", [](auto& inner, auto& at) {
    inner.number("theta", at.theta, "rad", "from the vertical, entry side positive");
    inner.number("normal", at.normal, "Pa", "pressing on the wheel");
    inner.number("shear", at.shear, "Pa", "in the wheel's plane, positive forward");
    inner.number("lateral_shear", at.lateral_shear, "Pa", "to the left");
  });
}

}  // namespace soilbin::compare
