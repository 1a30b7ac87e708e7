// One doubt as a value: its kind, what its sentence tells, and where. Its words stand in one table (doubt_words.cpp).
//
//   const Doubts doubts = compare::doubts(question);
//   if (tell_of(doubts, DoubtKind::deep_sinkage)) ...
//   for (const std::string& line : in_words(doubts)) fmt::print(stderr, "warning: {}\n", line);
#pragma once

#include <concepts>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "scenario/operating_condition.hpp"

namespace soilbin::compare {

/// In the order of the table of sentences, which says what each is.
// clang-format off
enum class DoubtKind {
  // a soil and a wheel by themselves
  unusual_exponent, unusual_pressure, unusual_cohesion, unusual_friction_angle, unusual_shear_modulus,
  unusual_density, unusual_gravity,
  unusual_radius, unusual_inflation, carries_nothing, carries_nothing_at_width, no_strength, usual_stress_angle,
  stress_angles_limited, stress_behind_axle, rough_errors, rough_errors_at_zero, hardly_known, hardly_known_at_zero,
  exponent_changed_alone, wider_than_high, high_lugs, beyond_wheels, tips_easily, unusual_wheel_load,
  // an answer
  no_solution, standing_wheel, power_from_nothing, unusual_ground_pressure, slides_across, settles_too_deep,
  deep_sinkage, bin_floor, short_contact, large_deflection, beyond_deflections, flattens, no_pressure_at_rest,
  pull_without_slip,
  drives_without_slip, slips_little, slope_slides, heavy_and_lugged, heavy_and_smooth, heavy_climb, travel_not_decided,
  carried_beyond_grains,
  sinkage_in_rut, beyond_learned, errors_left_out, without_deviations,
  // no influence
  lugs_ignored, lug_count_ignored, lug_thickness_ignored, lug_pattern_ignored, lug_angle_ignored, inflation_ignored,
  inflation_ignored_by_grains, carcass_ignored, carcass_ignored_by_grains, deflection_ignored,
  deflection_ignored_by_grains, section_height_ignored, construction_ignored, speed_ignored, bin_ignored, no_yaw,
  assumed_errors_none, assumed_errors_ignored_by_grains, condition_ignored, condition_ignored_by_grains,
  effect_without_condition, effect_without_pass, bin_depth_taken, soil_weight_ignored, rigid_already, smooth_already,
  // resistive force theory
  ignored_by_rft, rft_values_estimated, rft_without_cohesion,
  // cone index
  ignored_by_cone_index, cone_index_tells_no_sinkage, cone_index_beside_bekker, section_height_assumed,
  construction_unknown,
  firm_deflection_by_pressure, firm_deflection_assumed, outside_cone_index_tests, some_axles_driven,
  cone_index_as_rating, close_to_vehicle_cone_index, no_mean_maximum_pressure,
  // presumptions
  presumed, density_assumed, exact_carcass, taken_as_flexible, taken_by_table, taken_with_lugs, known_by_size,
  // grains
  unusual_grain_density, grain_density_in_g_cm3, unusual_sliding_friction, wide_grain_radii, cohesion_presses_grains,
  rolling_depends_on_step, soft_grains, coarse_grains, narrow_bed, bed_density, step_untested, step_matters,
  earlier_engine,
  // sides of a comparison
  budget_rest, one_run, one_bed_sample, runs_without_result, unsteady_runs, forces_not_turned_to_travel,
  forces_not_turned_to_wheel, no_reruns, mixed_setpoints,
  // measured rows
  rows_are_samples, several_wheels, sinkage_beyond_wheel, pull_beyond_load, unsteady_run, unsteady_samples,
  sinkage_flipped, no_sinkage, renumbered_rows, repeated_row, repeated_number,
  // measured columns
  flipped_sign, column_too_large, column_too_small, slip_in_shares, slip_in_percent, load_in_another_unit,
  columns_swapped, load_swapped,
  // measured plates
  plate_test_apart, sunk_beyond_plate, sensor_stuck, many_spikes, one_plate_size, negative_modulus, unusual_plate_exponent,
  scattered_plate_tests, no_repeated_plates, halves_not_compared, form_misses, curve_stiffens, curve_flattens,
  beyond_densities_of_plates,
  // measured shear tests
  one_normal_stress, shear_falls_again, few_shear_tests, no_repeated_shear_tests,
  varying_normal_stress,
  // drives and pages
  shear_gives_back, grains_left_out,
};
// clang-format on

/// A number or a text of a sentence; "" where there is nothing to tell.
struct Said : std::variant<double, std::string> {
  template <class Number>
  requires std::is_arithmetic_v<Number> Said(Number number) : variant(static_cast<double>(number)) {}
  template <class Text>
  requires std::convertible_to<const Text&, std::string_view> Said(const Text& text)
      : variant(std::string(std::string_view(text))) {}
};

struct Doubt {
  DoubtKind kind;
  std::vector<Said> says{};  ///< what its sentence tells, in the sentence's order and units
  std::optional<OperatingCondition> at{};
  std::optional<int> line{};  ///< of a row of the campaign's file
  std::size_t others = 0;     ///< at so many other conditions, or lines
  std::string error{};        ///< of the model that failed there
  std::string of{};           ///< the studies or the run that it is of, where there are several

  bool operator==(const Doubt&) const = default;
};
using Doubts = std::vector<Doubt>;

void append(Doubts& all, Doubts more);

/// Whether any is of this kind.
bool tell_of(const Doubts& doubts, DoubtKind kind);

/// Doubts alike as one, the first, with the number of the others. Alike are those of one kind and one subject: whose
/// texts are the same; numbers, conditions, lines and errors may differ.
Doubts once_each(const Doubts& doubts);

/// "deep_sinkage", for documents and tests.
std::string_view kind_word(DoubtKind kind);

/// "line 10: the wheel sinks ... at load 80 N, slip 20 % (and at 3 other conditions)".
std::string in_words(const Doubt& doubt);
/// A line each.
std::vector<std::string> in_words(const Doubts& doubts);

/// As the remark of a row, which names their condition and line; "" for none.
std::string as_remark(const Doubts& doubts);

/// Adds "warnings", the lines, and "warning_kinds", their words; neither where there are no doubts, or it has them.
void add_warnings(nlohmann::ordered_json& document, const Doubts& doubts);

}  // namespace soilbin::compare
