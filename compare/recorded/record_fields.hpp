// A record's members as JSON keys, for the visitors of json_fields.hpp.
#pragma once

#include "compare/recorded/record.hpp"
#include "compare/sweep/result_fields.hpp"

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

template <class Visitor, class Density>
void bed_fields(Visitor& v, Density& bed) {
  v.number("void_ratio", bed.void_ratio, "-", "volume of voids over volume of grains");
  v.number("bulk_density", bed.bulk, "kg/m^3", "mass of grains over the volume with voids");
  v.number("coordination", bed.coordination, "-", "contacts a grain");
}

template <class Visitor, class Profile>
void rut_fields(Visitor& v, Profile& rut) {
  v.number("from", rut.from, "m", "begin of the stretch behind the wheel, x in the bin");
  v.number("to", rut.to, "m", "its end");
  v.number("axle", rut.axle, "m", "where the axle stood at the end, x in the bin");
  v.numbers("y", rut.y, "m", "from the middle of the track to the left");
  v.numbers("across", rut.across, "m", "change of height at each y, mean over the stretch");
  v.numbers("x", rut.x, "m", "along the bin");
  v.numbers("along", rut.along, "m", "change of height at each x, mean over the tire's width");
  v.number("volume", rut.volume, "m^3", "of the change over the whole bin: heaped - dug");
  v.number("heaped", rut.heaped, "m^3", "above the old surface");
  v.number("dug", rut.dug, "m^3", "below the old surface");
}

template <class Visitor, class Flow>
void flow_fields(Visitor& v, Flow& flow) {
  v.number("cell", flow.cell, "m", "side of a cell");
  v.whole("nx", flow.nx, "cells along x, which varies fastest");
  v.whole("nz", flow.nz, "cells along z");
  v.number("x", flow.x, "m", "lower corner of the first cell, from the axle");
  v.number("z", flow.z, "m", "lower corner of the first cell, from the axle");
  v.numbers("vx", flow.vx, "m/s", "mean velocity against the bin, forward; null where no grain came");
  v.numbers("vz", flow.vz, "m/s", "upward");
  v.numbers("solid", flow.solid, "-", "mean volume of grains with their centres in a cell, over the cell's");
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
void outcome_fields(Visitor& v, Run& run) {
  stress_fields(v, *run.answer.result);
  v.flag("steady", run.steady, "whether the run became steady");
  v.number("drift", run.drift, "-",
           "largest difference of halves over its standard error, of pull, torque and sinkage");
  v.group("power", "powers, means over the steady part", [&](auto& inner) { power_fields(inner, run.power); });
  v.added_group("bed", "how dense the bed was before the wheel, in its core",
                [&](auto& inner) { bed_fields(inner, run.bed); });
  v.group("rut", "change of the surface seen from above", [&](auto& inner) { rut_fields(inner, run.rut); });
  v.group("flow", "mean velocity of the soil round the wheel, in its middle plane",
          [&](auto& inner) { flow_fields(inner, run.flow); });
}

}  // namespace soilbin::compare
