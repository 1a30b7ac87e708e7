// How a study's conditions differ from each other: which of them belong to one curve against slip, and in words.
#pragma once

#include <string>
#include <vector>

#include "compare/measured/condition_views.hpp"
#include "scenario/case.hpp"

namespace soilbin::compare {

/// Whether equal setpoints have equal numbers (a study) or scatter about them (a measured campaign).
enum class Spread { exact, measured };

/// What curves run over most often.
inline const ConditionView& slip_view() { return condition_view("slip"); }

/// Slip, where two conditions that agree in all else differ in it; else the first of load, inclines, yaw, pass,
/// inflation pressure, moisture and speed of which that is so; null where it is so of none.
const ConditionView* curves_run_over(const std::vector<OperatingCondition>& conditions);

/// Conditions sorted into curves.
struct Curves {
  std::vector<std::string> labels;  ///< of each curve, in rising order of its conditions: "4 kN, yaw 15 deg"; "" alone
  std::vector<std::size_t> curve_of;  ///< of each condition
  std::string varying;                ///< what tells the curves apart, for a heading: "load, yaw"; "" for one curve
};

/// Sorts by load, inclines, yaw, pass, inflation pressure, moisture and slip, whichever the curves don't run over, and
/// by speed where that tells conditions of one slip apart. Measured loads count as one where neighbours lie within 25
/// %, angles within 2 deg.
Curves curves_against(const ConditionView& abscissa, const std::vector<OperatingCondition>& conditions, Spread spread);
inline Curves curves_against_slip(const std::vector<OperatingCondition>& conditions, Spread spread) {
  return curves_against(slip_view(), conditions, spread);
}

/// The question with `points` places or more on each of its curves, from the smallest to the largest value that the
/// curve has: for smooth lines; of a whole number no others. The curve's own are among them. A speed that came from a
/// rotation follows the slip.
Case with_smooth_curves(Case question, int points, const ConditionView& abscissa = slip_view());

/// The soil's name, or what to call one that a case describes and doesn't name.
std::string in_words(const Soil& soil);

/// The condition in words, with what is not at its default: "load 80 N, slip 20 %, yaw 5 deg".
std::string in_words(const OperatingCondition& at);

/// What all of them share, with what is not at its default: "load 80 N, yaw 5 deg"; "" for nothing. `with_slip`: the
/// slip too, where it is one.
std::string shared_in_words(const std::vector<OperatingCondition>& conditions, bool with_slip);

/// Whether two conditions agree as far as a person who types numbers can tell: to 1e-9 of each number.
bool alike(const OperatingCondition& a, const OperatingCondition& b);

}  // namespace soilbin::compare
