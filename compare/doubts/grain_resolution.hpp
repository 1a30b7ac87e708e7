// The error of resolution: by how much grains of their size answer otherwise than infinitely fine ones of the same
// sand.
//
//   const ResolutionError error = resolution_error(scenario, at, sinkage);
//   if (error.known()) ...  // answer - error.drawbar_pull.value is what infinitely fine grains are estimated to give
//
// It comes from one study (bench/grain_size, docs/lab/grain-size.md): one wheel, with lugs and without, under one load,
// on dense beds of one sand, with grains of several sizes and the same contacts. At each slip an answer is taken as
// straight in the mean diameter d of the grains,
//
//   F_DP = a_F + s_F d,   M = a_M + s_M d,   z = a_z + s_z d,   l = r acos(1 - a_z/r) the length of the contact,
//
// so the errors are s_F d, s_M d and s_z d: none for d -> 0. For another wheel, load or contact, F_DP/W and M/(W r) are
// taken to follow d/l, and z to follow d alone. Between slips the slopes are interpolated. Carried over so to a rover's
// wheel, the errors missed those found there by `carried_over` of themselves, which their standard errors then hold;
// `beyond` says where a question leaves what was studied. An answer that was also given on coarser grains carries its
// own error instead (error_by_twin).
#pragma once

#include <span>
#include <string>

#include "compare/report/json_fields.hpp"
#include "scenario/estimate.hpp"
#include "scenario/operating_condition.hpp"
#include "scenario/scenario.hpp"
#include "scenario/traction_result.hpp"

namespace soilbin::compare {

/// An answer from grains less that of infinitely fine grains.
struct ResolutionError {
  Estimate drawbar_pull;  ///< [N]
  Estimate torque;        ///< [N m]
  Estimate sinkage;       ///< [m]
  std::string beyond;     ///< why there are none: where the question leaves the study; "" where it doesn't
  bool by_twin = false;   ///< from a coarser twin of the answer itself; else carried over from the study
  bool known() const { return beyond.empty(); }
};

/// The error of an answer from its twin, on grains of the same sand `ratio` times as large. Both are taken to lie on a
/// straight line in d: the error is (twin - answer)/(ratio - 1), and its standard error that of both over ratio - 1.
ResolutionError error_by_twin(const TractionResult& answer, const TractionResult& twin, double ratio);
/// The error of one number of an answer.
Estimate error_by_twin(const Estimate& answer, const Estimate& twin, double ratio);

/// What the study found at one slip with grains of one size: means over packings and their errors.
struct StudiedAnswer {
  double slip;
  double diameter;  ///< mean, of the grains [m]
  Estimate drawbar_pull, torque, sinkage;
};

/// The wheel of the study [m] and its load [N].
inline constexpr double studied_radius = 0.496, studied_lugs = 0.011, studied_load = 4000.0;
/// The rest of the study: the tire's width [m], the void ratio of its dense beds, and the grains' contacts, which are
/// paper-sand's: modulus [Pa], sliding and rolling friction, cohesion [J/m^3], sliding friction on the tire.
inline constexpr double studied_width = 0.305, studied_void_ratio = 0.507;
inline constexpr struct {
  double modulus = 31.75e6, sliding = 0.1602, rolling = 0.1, cohesion = 1111e3, on_tire = 0.52;
} studied_contacts;
/// By how much of themselves the errors of another wheel, load or sand are off: root mean square of what was found for
/// a rover's wheel with lugs and without, in another sand (docs/lab/grain-size.md).
inline constexpr struct { double drawbar_pull = 0.9, torque = 0.5, sinkage = 0.8; } carried_over;
/// Beyond the studied slips the slopes of the nearest one hold as far as this (chosen).
inline constexpr double slip_reach = 0.1;
/// So many times coarser than the study's coarsest, beside a lug's height or the contact, is still told (chosen).
inline constexpr double size_reach = 1.25;

/// The study's wheels: with its lugs, and the same without any.
enum class StudiedWheel { lugged, bare };

/// The study's answers, by rising slip, each slip's from the coarsest grains to the finest.
std::span<const StudiedAnswer> studied_answers(StudiedWheel wheel);

/// A straight line through values at d by least squares weighted by their errors. Its errors are at least as large as
/// the values' scatter about it asks for. The errors of both ends are not independent.
struct SizeFit {
  Estimate at_zero;  ///< value for d -> 0
  Estimate slope;    ///< per metre of d
};
/// Throws std::logic_error for fewer than two values.
SizeFit fit_against_size(std::span<const double> diameters, std::span<const Estimate> values);

/// Whose answer a sinkage is: that of coarse grains lacks what their size takes from it.
enum class SinkageOf { grains, another_model };

/// The error of the answer of a scenario's grains at a condition: the contact's length follows from this sinkage [m];
/// on a bed of this void ratio, where it is known. Standard errors are widened by carried_over for another wheel
/// (radius, width, lugs), load or sand, of which one was tried; and by as much once more, as independent, for each of
/// what was not: another slip, a slope, yaw, a later pass, another void ratio (chosen). Throws InputError for a soil
/// without grains.
ResolutionError resolution_error(const Scenario& scenario, const OperatingCondition& at, double sinkage,
                                 SinkageOf whose = SinkageOf::grains, double void_ratio = not_a_number);

/// "the drawbar pull by +150 ± 60 N, the torque by +30 ± 12 N m and the sinkage by -11 ± 3 mm". Of a known one.
std::string in_words(const ResolutionError& error);

/// "drawbar_pull", "torque", "sinkage" with value and std_error, "from": "twin" or "study"; null each where the study
/// tells nothing, and "beyond", why it doesn't.
Json to_json(const ResolutionError& error);

}  // namespace soilbin::compare
