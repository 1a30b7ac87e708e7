// A record's members as JSON keys, for the visitors of json_fields.hpp.
#pragma once

#include "compare/recorded/record.hpp"
#include "compare/report/result_fields.hpp"

namespace soilbin::compare {

template <class Visitor, class Losses>
void loss_fields(Visitor& v, Losses& losses) {
  v.number("damping", losses.damping, "W", "in normal dashpots");
  v.number("shear_damping", losses.shear_damping, "W", "in tangential dashpots");
  v.number("sliding", losses.sliding, "W", "in sliders");
  v.number("into_slide", losses.into_slide, "W", "taken by tangential springs, dashpots and sliders together");
  v.number("into_roll", losses.into_roll, "W", "taken by rolling resistance");
}

template <class Visitor, class Power>
void power_fields(Visitor& v, Power& power) {
  v.number("drive", power.drive, "W", "M w");
  v.number("pull", power.pull, "W", "F_DP v");
  v.number("climb", power.climb, "W", "lifts the load up the slope");
  v.number("heave", power.heave, "W", "lifts the load out of the soil; negative while the wheel sinks");
  v.number("into_soil", power.into_soil, "W", "given to the grains");
  v.number("rest", power.rest, "W", "drive less all these");
  v.group("losses", "where grains lost it; all 0 where nobody counted",
          [&](auto& inner) { loss_fields(inner, power.losses); });
}

/// What every run has, with a result or without.
template <class Visitor, class Run>
void run_fields(Visitor& v, Run& run) {
  v.whole("packing", run.packing, "seed of the bed");
  v.text("source", run.source, "state of the sources that the program was built from");
  v.number("seconds", run.seconds, "s", "that it took on the clock on the wall");
}

/// What a run with a result has beside the result itself.
template <class Visitor, class Run>
void told_fields(Visitor& v, Run& run) {
  stress_fields(v, *run.answer.result);
  v.flag("steady", run.steady, "whether the run became steady");
  v.number("drift", run.drift, "-",
           "largest difference of halves over its standard error, of pull, torque and sinkage");
  v.group("power", "powers, means over the steady part", [&](auto& inner) { power_fields(inner, run.power); });
}

}  // namespace soilbin::compare
