#include <fmt/args.h>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "compare/doubts/doubt.hpp"
#include "compare/report/number_text.hpp"
#include "compare/sweep/varying.hpp"

namespace soilbin::compare {
namespace {

/// A sentence is a format string of {fmt} over what its doubts say, {at} " at load ...", {in} " (load ...)" and
/// {error}. Beside fmt's formats there are, where `told` reads them: {:N3} a force to three digits, {:n3} a number to
/// three digits, {:#run} "3 runs", {:times}, {:overlap} and {:modulus}; and a clause that is left out where there is
/// nothing to say, {:?, with a thrust of {:N3}}.
struct DoubtSentence {
  DoubtKind kind;
  const char *word, *sentence;
};

// clang-format off
#define D(kind, sentence) {DoubtKind::kind, #kind, sentence}
#define LOOK_AT_UNIT \
  " the prediction fits far better; look at its unit{3:?, '{}'}{0:?, in its header or under 'columns:' in campaign.yaml}"
#define BEYOND_GRAINS "{:?, but it is known from wheels that sink by up to 0.18 of their width: here by {:.2g}}. Loam was "\
  "not tried (docs/guide/trust-the-estimate.md)"
constexpr DoubtSentence sentences[] = {
    D(unusual_exponent, "n = {:.4g} is outside {:.4g} .. {:.4g}: most plate tests give 0.1 .. 1.6"),
    D(unusual_pressure, "k_c, k_phi and n press a plate 100 mm wide into the soil by 50 mm with {:n3} kPa, outside "
      "{:.4g} .. {:.4g}: fresh snow bears 2 kPa so, dense sand 700 kPa; are the units of k_c and k_phi right?"),
    D(unusual_cohesion, "c = {:.4g} kPa is outside {:.4g} .. {:.4g}: soft soils have 0 .. 70 kPa"),
    D(unusual_friction_angle, "phi = {:.4g} deg is outside {:.4g} .. {:.4g}: the densest sand has some 45 deg"),
    D(unusual_shear_modulus, "K = {:.4g} mm is outside {:.4g} .. {:.4g}: 6 mm in firm clay, 25 mm in loose sand"),
    D(unusual_density, "density = {:.4g} kg/m^3 is outside {:.4g} .. {:.4g}: fresh snow has some 250, dense gravel "
      "2200"),
    D(unusual_gravity, "gravity = {:.4g} m/s^2 is outside {:.4g} .. {:.4g}: the Moon has 1.62, Earth 9.81"),
    D(unusual_radius, "the wheel's radius = {:.4g} mm is outside {:.4g} .. {:.4g}: the model is tested from 50 mm to 2 "
      "m"),
    D(unusual_inflation, "the inflation pressure = {:.0f} kPa is above {:.0f}{at}: tires of cars have some 200 kPa, of "
      "trucks 800, of aircraft 1500; is its unit right?"),
    D(carries_nothing, "neither k_c nor k_phi is positive: this soil carries no load at any wheel width"),
    D(carries_nothing_at_width, "k_c/b + k_phi is not positive for this width: the soil carries no load"),
    D(no_strength, "c and phi are both 0: this soil has no strength and gives no traction"),
    D(usual_stress_angle, "the soil declares no {}: {:g} with a standard deviation of {:g} is taken, a usual value"),
    D(stress_angles_limited, "c1 + c2 = {:.3g}: at full slip theta_m is limited to {} theta_1"),
    D(stress_behind_axle, "c1 + c2 is negative: at full slip the largest stress would lie behind the axle"),
    D(rough_errors, "the standard deviation of {} is {:.0f} % of its value: first-order errors are rough"),
    D(rough_errors_at_zero, "{} is 0 with a standard deviation, and can only be larger: first-order errors are rough"),
    D(hardly_known, "the standard deviation of {} is {:times} times its value: it is hardly known; is its unit right?"),
    D(hardly_known_at_zero, "the standard deviation of {} is large beside a value of 0: it is hardly known; is its "
      "unit right?"),
    D(exponent_changed_alone, "n was changed and k_phi was not: their units and values belong together, as a plate "
      "test found them"),
    D(wider_than_high, "the wheel is wider ({:.4g} mm) than its diameter ({:.4g} mm)"),
    D(high_lugs, "the lugs ({:.4g} mm) are higher than 30 % of the radius"),
    D(beyond_wheels, "the centre of gravity lies {:.3g} m {} of all wheels: on level ground the vehicle tips over; is "
      "centre_of_gravity right?"),
    D(tips_easily, "with its centre of gravity {:.3g} m high and {:.3g} m beside the nearer wheels it tips over on hard "
      "ground at a cross slope of {:.2g} deg: usual are {:.0f} deg and more; is centre_of_gravity right?"),
    D(unusual_wheel_load, "a wheel of axle '{}' carries {:N3} on level ground, {:n3} kPa over its radius times its width: "
      "usual are {:.3g} .. {:.4g} kPa{:? for {}}; are mass, axles and tires right?"),
    D(no_solution, "no solution{at}: {error}"),
    D(standing_wheel, "at a speed of 0 a wheel is at rest or slips by 100 %; the answer is that of a very slow "
      "wheel{at}"),
    D(power_from_nothing, "drawbar power exceeds the power put in{at}: an instrument error, or an effect that adds "
      "one; no efficiency is given"),
    D(unusual_ground_pressure, "mean ground pressure {:.3g} kPa{at}: usual are 0.5 .. 2000 kPa"),
    D(slides_across, "the wheel slides down the cross slope{at}: {:N3} of the load act down it{:?, with a thrust of "
      "{:N3}}, and the soil shears at {:N3} (c, phi)"),
    D(settles_too_deep, "the wheel settles to {:.0f} % of its radius{at}: the stresses are unreliable above {:.0f} %"),
    D(deep_sinkage, "the wheel sinks {:.0f} % of its radius{at}: unreliable above {:.0f} %"),
    D(bin_floor, "the wheel sinks {:.0f} % of the bin's depth{at}: its floor acts on the wheel; add --effect "
      "hard_layer"),
    D(short_contact, "K ({:.3g} mm) is longer than the contact ({:.3g} mm){at}: shear hardly develops"),
    D(large_deflection, "the tire deflects by {:.3g} mm{at}, {:.0f} % of its radius: tires are built for about 10 %, "
      "at most {:.0f} %. Raise the inflation pressure or lower the load"),
    D(beyond_deflections, "{:N} at {:.4g} kPa lie outside the tire's load-deflection table ({}){at}: the stiffness of "
      "its edge is taken"),
    D(flattens, "the tire flattens{at} (inflation {:.4g} kPa and carcass {:.4g} kPa){:?: as a rigid wheel it pulls "
      "{:N}}{:?, with --effect tire_flexibility {:N}}{error:?, and carries no more there: {}}"),
    D(no_pressure_at_rest, "rate_dependence:grahn has no pressure at rest, and under the flat of a flexible tire nothing "
      "penetrates the soil: it stays soft there, and the pull jumps with load and inflation pressure (of a truck's tire by "
      "a tenth of its load within 3 kPa); take --effect rate_dependence:quasi_static, or --rigid"),
    D(pull_without_slip, "the wheel pulls {:.2g} of its load{at}: even there the model shears the soil by up to {:.3g} "
      "mm under a radius of {:.4g} mm, and K is {:.3g} mm. A wheel that pulls slips: take pulls at less than 5 % slip "
      "as upper bounds"),
    D(drives_without_slip, "a driven wheel needs no slip{at}: its rim is slower than its travel, because the model "
      "shears the soil under a large or deep wheel before it slips. Real driven wheels slip by some percent: take "
      "slips below 5 %, and what is climbed or pulled with them, as bounds"),
    D(slips_little, "its driven wheels slip by {:.2g} % at most: real ones slip by some percent more, so take slips below "
      "5 %, and what is climbed or pulled with them, as bounds"),
    D(slope_slides, "from {:.3g} deg on this soil slides by itself (c, phi, at a depth of the wheel's radius){at}"),
    D(heavy_and_lugged, "a heavy lugged tire on dry sand pulls less than this{at}: in simulated grains less by 24 to 27 % "
      "of its load. --rigid --effect lug_thrust:tips --effect shear_hump:carried --effect slip_sinkage:reece,h=100mm is "
      "4 to 7 % off there{:?, and here pulls {:N}}{:? in place of {:N}}" BEYOND_GRAINS),
    D(heavy_and_smooth, "a heavy tire on dry sand pulls less than this{at}: in simulated grains less by some 20 % of its "
      "load. --rigid --effect shear_hump:carried --effect slip_sinkage:reece,h=100mm is 3 to 7 % off there{:?, and here "
      "pulls {:N}}{:? in place of {:N}}" BEYOND_GRAINS),
    D(heavy_climb, "with those beside its other effects {} climbs {:.3g} deg in place of {:.3g}: slopes between the two "
      "are not decided"),
    D(travel_not_decided, "whether it travels here is not decided: it climbs {:.2f} ± {:.2g} deg, and {:.3g} deg are "
      "asked; --map gives the chance"),
    D(carried_beyond_grains, "shear_hump:carried is known from grains under tires that sink by up to {:.2g} of their "
      "width: this wheel sinks by {:.2g} of it{at} (docs/guide/trust-the-estimate.md)"),
    D(sinkage_in_rut, "after the first pass sinkage counts from the floor of the rut that the passes before have left; "
      "by {} these floors add up without end, by multipass:rut_power the whole rut grows as measured ones do"),
    D(beyond_learned, "the learned effect ({}) was learned from another range of the {}: its value at the edge of "
      "that range is used{at}"),
    D(errors_left_out, "the standard errors leave out the soil's {}"),
    D(without_deviations, "no value of the soil has a standard deviation, so ± is far too small; 'assumed_sd: 10 %' under "
      "semi_empirical takes a tenth of each"),
    D(lugs_ignored, "lugs are ignored: add {1} (estimate, explain, limits, run and serve do where they ask one model)"),
    D(lug_count_ignored, "the number of lugs is ignored: add {1}"),
    D(lug_thickness_ignored, "the lugs' thickness is ignored: only grains have it, {1}"),
    D(lug_pattern_ignored, "the lugs' pattern is ignored: only grains have it, {1}"),
    D(lug_angle_ignored, "the lugs' angle is ignored: only grains have it, {1}"),
    D(inflation_ignored, "the inflation pressure is ignored: add {1} (estimate, explain, limits, run and serve do)"),
    D(inflation_ignored_by_grains, "the inflation pressure is ignored: grains meet a rigid tire"),
    D(carcass_ignored, "the carcass pressure is ignored: add {1}"),
    D(carcass_ignored_by_grains, "the carcass pressure is ignored: grains meet a rigid tire"),
    D(deflection_ignored, "the load-deflection table is ignored: add {1}"),
    D(deflection_ignored_by_grains, "the load-deflection table is ignored: grains meet a rigid tire"),
    D(section_height_ignored, "only the model cone_index reads the section height"),
    D(construction_ignored, "only the model cone_index reads the tire's construction"),
    D(speed_ignored, "the speed is ignored: add {1}"),
    D(bin_ignored, "the bin is ignored: add {1}, which reads its depth"),
    D(no_yaw, "'{0}' is ignored: no condition has a 'yaw'"),
    D(assumed_errors_none, "--no-assumed-sd is ignored: no standard deviation of the soil is only assumed"),
    D(assumed_errors_ignored_by_grains, "grains ignore --no-assumed-sd"),
    D(condition_ignored, "'{}' is ignored: add {}"),
    D(condition_ignored_by_grains, "grains ignore '{0}'"),
    D(effect_without_condition, "effect {1} does not act: no condition has a '{0}'"),
    D(effect_without_pass, "effect {1} does not act: no condition has a '{0}' of 2 or more"),
    D(bin_depth_taken, "effect {} takes the bin's depth, {:g} mm: its own '{}' of {:g} mm is ignored"),
    D(soil_weight_ignored, "the soil's {} is ignored: loads are forces, and only effects such as bulldozing weigh "
      "soil"),
    D(rigid_already, "--rigid is ignored: the tire declares no inflation pressure and is rigid"),
    D(smooth_already, "--no-lugs is ignored: the tire declares no lugs and is smooth"),
    D(ignored_by_rft, "rft ignores {}"),
    D(rft_values_estimated, "rft: xi_n = {:.3g} ± {:.2g} MN/m^3 and surface friction {:.2g} ± {:.1g} are estimated "
      "from the soil's density and friction angle: declare 'resistive_force', from plates"),
    D(rft_without_cohesion, "rft has no cohesion, and this soil has {:.3g} kPa: it sinks too deep and pulls too "
      "little"),
    D(ignored_by_cone_index, "cone_index ignores {}"),
    D(cone_index_tells_no_sinkage, "cone_index gives pull and torque alone: no sinkage, no stresses, no contact angles"),
    D(cone_index_beside_bekker, "a cone and a bevameter test unlike things of a soil, and what relates their values is "
      "loose: where cone_index and bekker_wong differ here, neither is shown to be wrong"),
    D(section_height_assumed, "cone_index: the tire declares no section_height, and {:.4g} mm are assumed, {:.0f} % of "
      "its width"),
    D(construction_unknown, "cone_index: the tire declares no construction, and is taken for one of crossed plies; a "
      "radial one pulls more at little slip: construction: radial"),
    D(firm_deflection_by_pressure, "cone_index: the tire declares no load-deflection table; by its inflation and carcass "
      "pressure it deflects by {:.3g} mm on firm ground, {:.0f} % of its section height{at}"),
    D(firm_deflection_assumed, "cone_index is for pneumatic tires: this one declares no inflation pressure, and a "
      "deflection of {:.0f} % of its section height is assumed"),
    D(outside_cone_index_tests, "cone_index: {} = {:.3g} is outside {:.3g} .. {:.3g}, where its relation was "
      "tested{at}"),
    D(some_axles_driven, "{:.0f} of {:.0f} axles are driven: VCI1 and VCI50 are of vehicles that drive all of them"),
    D(cone_index_as_rating, "the soil's cone index is taken as its rating cone index: where traffic softens the soil, "
      "that is less (--remolding-index)"),
    D(close_to_vehicle_cone_index, "{:#pass}: an excess of {:.3g} ± {:.3g} kPa may as well be the other way"),
    D(no_mean_maximum_pressure, "no mean maximum pressure: it needs {}"),
    D(presumed, "{}"),
    D(density_assumed, "the soil declares no density: {:g} kg/m^3 is assumed, and the answers depend on it"),
    D(exact_carcass, "effect {0} takes the carcass pressure, {1:.4g} kPa, as exact: an error in it would be "
      "attributed to another effect; give it an sd, carcass_pressure: {{value: {1:.4g} kPa, sd: ...}}"),
    D(taken_as_flexible, "the tire is taken as flexible where the soil presses with more than its {:.4g}{:? .. {:.4g}} "
      "kPa of inflation and carcass (effect {}, form {}); --rigid for the rigid wheel"),
    D(taken_by_table, "the tire is taken as flexible, by its load-deflection table (effect {}, form {}); --rigid for "
      "the rigid wheel"),
    D(taken_with_lugs, "the tire is taken with its lugs (effect {}, form {}); --no-lugs for the smooth wheel"),
    D(known_by_size, "tire {} is known {}"),
    D(unusual_grain_density, "grain_density = {:.4g} kg/m^3 is outside 500 .. 8000: quartz has 2650, steel 7850"),
    D(grain_density_in_g_cm3, "grain_density = {:.4g} kg/m^3 is outside 500 .. 8000: quartz has 2650, steel 7850; is "
      "it meant in g/cm^3, 1000 times as much?"),
    D(unusual_sliding_friction, "sliding_friction of {} = {:.4g} is above 1.5: rock on rock has 0.4 .. 1"),
    D(wide_grain_radii, "radius_max is {:.2g} times radius_min, more than 5: the smallest grains set the time step and "
      "the number of grains, the largest the size of the bed, so runs take very long"),
    D(cohesion_presses_grains, "the {} of grain_grain, {:.6g} {}, alone pulls these grains into each other by "
      "{:overlap}: Hertz's law holds for small overlaps; less than {:.3g} {} keeps it below {:.0f} %"),
    D(rolling_depends_on_step, "with the rolling law '{}' answers depend on the time step: below the angular speed "
      "mu_r R* F_N dt/I* a contact is a dashpot of I*/dt, whatever mu_r. At the longest step, {:.3g} ms, two mean "
      "grains that 100 N press together are so below {:.2g} rad/s. At a quarter of the step a tire of 0.5 m radius at "
      "4 kN, 20 % slip pulled 1183 ± 43 N in place of 773 ± 19 N. rolling_resistance: elastic_plastic does not depend "
      "on it{:?. This law also resists spin about the contact's normal, which the published one does not}"),
    D(soft_grains, "grains this soft, {:modulus}, are pressed into each other by {:overlap} under the wheel's {:.2g} "
      "kPa{in}: Hertz's law holds for small overlaps, and a run stops at 50 %; a youngs_modulus of {:.2g} MPa or more "
      "keeps them below {:.0f} %"),
    D(coarse_grains, "the grains are coarse for this wheel{:?: estimated error {}}{in}{:?: the error is unknown, since "
      "{}}. Mean diameter {:.3g} mm: {:.2g} across its width ({} wanted){:?, {:.2g} along its contact}{:? ({})}{:?, "
      "{:.2g} in a lug's height}{:? ({})}. See docs/lab/grain-size.md"),
    D(narrow_bed, "the bed is {:.3g} tire widths wide, so its walls support the soil: at 2 widths the paper's tire "
      "pulled 17 ± 4 % more than at 2.6; take {:.3g} m or more"),
    D(bed_density, "the grains' bed is {} ({:.0f} kg/m^3) than the soil of the analytic model's values ({:.0f} "
      "kg/m^3): measure the values on this bed (soilbin bevameter, then --soil)"),
    D(step_untested, "not verified that the grains' answers are independent of the time step: the record has no run at "
      "half of it (soilbin run STUDY --model dem --record FILE --half-step yes makes one)"),
    D(step_matters, "the grains' answers depend on the time step: {}"),
    D(earlier_engine, "{} of the experiments were made by an earlier engine, whose shear springs did not turn with the "
      "spin of a pair: this one's answers differ"),
    D(budget_rest, "the parts of the pull leave {:.3g} N unexplained (chance: at most {:.3g} N)"),
    D(one_run, "one run: the scatter between bed samples is unknown"),
    D(one_bed_sample, "one bed sample: the scatter between bed samples is unknown"),
    D(runs_without_result, "{} of {} runs without a result"),
    D(unsteady_runs, "{} of {:#run} not steady (drift up to {:.1f} standard errors): lengthen the run"),
    D(forces_not_turned_to_travel, "forces of {} of {:#run} left out: turning them from the wheel's axes to those of "
      "travel takes both drawbar pull and lateral force"),
    D(forces_not_turned_to_wheel, "forces of {} of {:#run} left out: turning them from the axes of travel to the "
      "wheel's takes both drawbar pull and lateral force"),
    D(no_reruns, "no setpoint was run twice: the scatter is not known ({})"),
    D(mixed_setpoints, "runs of more than one setpoint: the error leaves out the differences between setpoints"),
    D(rows_are_samples, "the rows look like samples of a time log, not like runs: {1:?column '{}' is a clock with even "
      "steps}{2:?{:.3g} rows on end have the number of one run}{3:?{} rows on end are at one setpoint}{4:?slip and "
      "load hardly change from row to row over {} rows}{5:?, and follow each other smoothly (autocorrelation of the "
      "{}}{6:? {:.2f})}. Samples of one run share its bed; counted as runs they make errors too small and can look "
      "like an effect. One row a run: soilbin runs '{0}'"),
    D(several_wheels, "column '{}' names {} wheels ({}): a campaign has one wheel: make a campaign of each"),
    D(sinkage_beyond_wheel, "a measured sinkage of {:.4g} mm is more than the wheel's diameter: is the column's unit "
      "right?"),
    D(pull_beyond_load, "a drawbar pull of {:N} is more than three times the load: are the units of both right?"),
    D(unsteady_run, "an unsteady run: the {} scattered by {:.3g} {} in time, the median run by {:.3g} {}"),
    D(unsteady_samples, "not steady: the halves of its {} differ by {:.1f} standard errors"),
    D(sinkage_flipped, "{} of {} measured sinkages are negative: is their sign flipped? Below the undisturbed surface "
      "is positive"),
    D(no_sinkage, "no run has a sinkage: without it the loop overlooks effects such as slip sinkage, because other soil "
      "values explain the other channels as well"),
    D(renumbered_rows, "{} of {} rows have all values of an earlier one, under another number: were they copied? They "
      "would count twice"),
    D(repeated_row, "all its values are those of line {}: counted twice"),
    D(repeated_number, "run {} is in line {} already"),
    D(flipped_sign, "{}column '{}' looks as if its sign were flipped: with the other sign the prediction fits far "
      "better; change the sign in the file if so: positive {}"),
    D(column_too_large, "{0}column '{1}' looks {2:g} times too large: with its values divided by {2:g}" LOOK_AT_UNIT),
    D(column_too_small, "{0}column '{1}' looks {2:g} times too small: with its values multiplied by "
      "{2:g}" LOOK_AT_UNIT),
    D(slip_in_shares, "{0}column '{1}' looks as if it held shares where % are declared: with slips 100 times as "
      "large" LOOK_AT_UNIT),
    D(slip_in_percent, "{0}column '{1}' looks as if it held % where shares are declared: with slips a hundredth as "
      "large" LOOK_AT_UNIT),
    D(load_in_another_unit, "{0}column '{1}' looks as if it were in {4}: with loads {2:.4g} times as "
      "large" LOOK_AT_UNIT),
    D(columns_swapped, "{}the columns '{}' and '{}' look swapped: each fits the prediction of the other far better; "
      "look at the header{:?, and at 'columns:' in {}}"),
    D(load_swapped, "{}the columns '{}' and '{}' look swapped: exchanged, they fit the prediction far better; look at "
      "the header{:?, and at 'columns:' in {}}"),
    D(plate_test_apart, "{}"),
    D(sunk_beyond_plate, "a plate of b = {:g} mm sinks by {:n3} mm: plates are pressed in by about their size; is the "
      "unit of the sinkage right?"),
    D(sensor_stuck, "test '{}', b = {:g} mm: the sinkage stays at {:n3} mm while the pressure rises from {:n3} "
      "kPa on; {:#reading} set aside: does the depth sensor stick, is it at the end of its range, or is the ground "
      "hard there?"),
    D(many_spikes, "{} of {} readings are spikes and were set aside: too many to be chance; check "
      "the sensors"),
    D(one_plate_size, "plates of one size can't separate k_c and k_phi: k_c = 0 and k_phi = k are valid for wheels of "
      "about b = {:g} mm only; test a second size"),
    D(negative_modulus, "{} is negative: Bekker's form does not describe these plates; the values are valid for widths "
      "of {:g} to {:g} mm only"),
    D(unusual_plate_exponent, "n = {:n3}: most plate tests give 0.1 .. 1.6; do the readings start where the plate "
      "touches the soil?"),
    D(scattered_plate_tests, "pressures of tests with one plate scatter by {:.3g} %: were "
      "they made on the same soil at the same density? --by COLUMN fits each of its values apart, --only COLUMN=VALUE "
      "selects tests"),
    D(no_repeated_plates, "no plate test was repeated: what another test would scatter is taken from other sands, 8 % "
      "of the pressure and 0.1 of n"),
    D(halves_not_compared, "low and high pressures can't be compared: some test has too few readings in a half; the "
      "errors leave out how far the soil departs from a power law"),
    D(form_misses, "Bekker's form misses the pressures by {:.3g} %: fit over the pressures that your wheel makes "
      "(--pressure)"),
    D(curve_stiffens, "the pressure grows faster at depth than Bekker's form: n is {:.2f} in the lower half of the "
      "pressures and {:.2f} in the upper one. A floor or a firm layer below does that (effect hard_layer), and so does "
      "a loose bed that a plate compacts: fit over the pressures that your wheel makes (--pressure)"),
    D(curve_flattens, "the pressure grows slower at depth than Bekker's form: n is {:.2f} in the lower half of the "
      "pressures and {:.2f} in the upper one. The bed nears the most that it bears: a load beyond sinks deeper than the "
      "fit says; fit over the pressures that your wheel makes (--pressure)"),
    D(beyond_densities_of_plates, "{:g} kg/m^3 lies beyond the beds that were tested, {:g} to {:g} kg/m^3: the values "
      "of the nearest one are taken there, with standard errors that grow with the distance"),
    D(one_normal_stress, "one normal stress ({:.3g} kPa) can't separate c and phi: phi is given with c = 0, valid "
      "near this stress"),
    D(shear_falls_again, "the shear stress falls after a peak in {} of {:#test}: Janosi's curve stays at tau_max; at "
      "high slip the residual strength acts (effect shear_hump)"),
    D(few_shear_tests, "{:#test}: c and phi have no error; three tests are needed"),
    D(no_repeated_shear_tests, "no normal stress was tested twice: the errors are what {:#test} scatter about one line, "
      "and leave out what c, phi and K change from bed to bed; test each stress on two beds or more, or give wider "
      "standard deviations"),
    D(varying_normal_stress, "the normal stress varies within {:#test}, by {:.2g} % (a standard deviation) in '{}': "
      "its mean is taken"),
    D(shear_gives_back, "the soil's shear returns {:.3g} J, {:.2g} % of the work of compaction: where the tread's "
      "slip reverses, the model unloads the shear stress along its loading curve, at the present pressure. Real soil "
      "does not return it: the resistance is too small by about this share"),
    D(grains_left_out, "the study asks for grains too, which are not on this page; soilbin compare {} {} --report "
      "FILE.html shows them"),
};
#undef LOOK_AT_UNIT
#undef D
// clang-format on

constexpr bool in_order() {
  for (std::size_t i = 0; i < std::size(sentences); ++i)
    if (sentences[i].kind != static_cast<DoubtKind>(i)) return false;
  return static_cast<std::size_t>(DoubtKind::grains_left_out) + 1 == std::size(sentences);
}
static_assert(in_order(), "a sentence for each kind, in the order of DoubtKind");

const std::string* text_of(const Said& said) { return std::get_if<std::string>(&said); }

std::string overlap_text(double overlap) {  // of grains, over their radius
  return overlap < 1.0 ? fmt::format("about {:.2g} % of their radius", 100 * overlap) : "more than their radius";
}

std::string modulus_text(double modulus) {
  if (modulus < 1e3) return fmt::format("{:.3g} Pa", modulus);
  return modulus < 1e6 ? fmt::format("{:.3g} kPa", modulus / 1e3) : fmt::format("{:.3g} MPa", modulus / 1e6);
}

std::string told(const Said& said, std::string_view format);

}  // namespace
}  // namespace soilbin::compare

template <>
struct fmt::formatter<soilbin::compare::Said> {
  std::string format_;
  constexpr auto parse(fmt::format_parse_context& context) {
    auto end = context.begin();
    for (int depth = 0; end != context.end() && (depth > 0 || *end != '}'); ++end)
      depth += *end == '{' ? 1 : *end == '}' ? -1 : 0;
    format_.assign(context.begin(), end);
    return end;
  }
  auto format(const soilbin::compare::Said& said, auto& context) const {
    return fmt::format_to(context.out(), "{}", soilbin::compare::told(said, format_));
  }
};

namespace soilbin::compare {
namespace {

std::string told(const Said& said, std::string_view format) {
  const std::string* text = text_of(said);
  if (format.starts_with('?'))
    return text && text->empty() ? "" : fmt::vformat(format.substr(1), fmt::make_format_args(said));
  if (text) return *text;
  const double number = std::get<double>(said);
  if (format == "times") return fmt::format("{:.{}f}", number, number < 10 ? 1 : 0);
  if (format == "overlap") return overlap_text(number);
  if (format == "modulus") return modulus_text(number);
  if (format.starts_with('#')) return counted(static_cast<std::size_t>(number), std::string(format.substr(1)));
  if (format.starts_with('N')) return newtons(number, format.size() > 1 ? format[1] - '0' : 4);
  if (format.starts_with('n')) return compare::number(number, format[1] - '0');
  return fmt::format(fmt::runtime(fmt::format("{{:{}}}", format)), number);
}

const DoubtSentence& sentence_of(DoubtKind kind) { return sentences[static_cast<std::size_t>(kind)]; }

/// Whether two doubts are of one kind and one subject.
bool are_alike(const Doubt& a, const Doubt& b) {
  return a.kind == b.kind && std::ranges::equal(a.says, b.says, [](const Said& one, const Said& other) {
           const std::string *text = text_of(one), *its = text_of(other);
           return !text || !its || *text == *its;
         });
}

}  // namespace

void append(Doubts& all, Doubts more) {
  all.insert(all.end(), std::make_move_iterator(more.begin()), std::make_move_iterator(more.end()));
}

bool tell_of(const Doubts& doubts, DoubtKind kind) {
  return std::ranges::find(doubts, kind, &Doubt::kind) != doubts.end();
}

Doubts once_each(const Doubts& doubts) {
  Doubts shown;
  for (const Doubt& doubt : doubts) {
    const auto known = std::ranges::find_if(shown, [&](const Doubt& one) { return are_alike(one, doubt); });
    if (known == shown.end())
      shown.push_back(doubt);
    else
      ++known->others;
  }
  return shown;
}

std::string_view kind_word(DoubtKind kind) { return sentence_of(kind).word; }

std::string in_words(const Doubt& doubt) {
  const std::string at = doubt.at ? in_words(*doubt.at) : "";
  fmt::dynamic_format_arg_store<fmt::format_context> told;
  for (const Said& one : doubt.says) told.push_back(one);
  told.push_back(fmt::arg("at", at.empty() ? "" : " at " + at));
  told.push_back(fmt::arg("in", at.empty() ? "" : " (" + at + ")"));
  told.push_back(fmt::arg("error", Said(doubt.error)));
  std::string words = fmt::vformat(sentence_of(doubt.kind).sentence, told);
  if (doubt.others > 0)
    words += fmt::format(" (and at {} other {}{})", doubt.others, doubt.line ? "line" : "condition",
                         doubt.others > 1 ? "s" : "");
  if (doubt.line) words = fmt::format("line {}: {}", *doubt.line, words);
  return doubt.of.empty() ? words : doubt.of + ": " + words;
}

std::vector<std::string> in_words(const Doubts& doubts) {
  std::vector<std::string> lines;
  for (const Doubt& doubt : doubts) lines.push_back(in_words(doubt));
  return lines;
}

std::string as_remark(const Doubts& doubts) {
  std::string remark;
  for (Doubt doubt : doubts) {
    doubt.at.reset(), doubt.line.reset();
    remark += (remark.empty() ? "" : "; ") + in_words(doubt);
  }
  return remark;
}

void add_warnings(nlohmann::ordered_json& document, const Doubts& doubts) {
  if (doubts.empty() || (document.contains("warnings") && !document["warnings"].empty())) return;
  document["warnings"] = in_words(doubts);
  for (const Doubt& doubt : doubts) document["warning_kinds"].push_back(kind_word(doubt.kind));
}

}  // namespace soilbin::compare
