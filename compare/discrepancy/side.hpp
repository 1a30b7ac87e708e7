// The sides of a comparison: what each model, and the measurement, says at each condition of a study.
//
//   std::vector<Side> sides;
//   for (const ModelAnswers& answers : run_study(question)) sides.push_back(side_of(answers));
//   sides.push_back(side_of(campaign, question));  // measured runs near the study's conditions
#pragma once

#include <array>
#include <filesystem>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "compare/doubts/doubt.hpp"
#include "compare/doubts/grain_resolution.hpp"
#include "compare/fit/noise_floor.hpp"
#include "compare/measured/campaign.hpp"
#include "compare/recorded/recorded_model.hpp"
#include "compare/sweep/answers.hpp"

namespace soilbin::compare {

enum class SideKind { analytic, grains, measured };
constexpr std::array<Word<SideKind>, 3> words_of(std::type_identity<SideKind>) {
  return {{{"analytic", SideKind::analytic}, {"grains", SideKind::grains}, {"measured", SideKind::measured}}};
}

/// Degrees of freedom of standard errors that are known: none of them estimated from a handful of runs.
constexpr std::array<double, channel_views.size()> known_errors() {
  constexpr double all = std::numeric_limits<double>::infinity();
  return {all, all, all, all};
}

/// What a side says at one condition.
struct SidePoint {
  std::optional<TractionResult> result;  ///< means; standard errors of the means
  /// Standard deviation of one run about the mean of all runs that could have been made [SI], by channel: its own
  /// fluctuations and, with two packings or more, the packings'. 0 for an analytic model.
  std::array<double, channel_views.size()> scatter{};
  /// Degrees of freedom behind the standard error, by channel; infinite where it is not an estimate of few
  /// runs.
  std::array<double, channel_views.size()> freedom = known_errors();
  /// Channels that the side speaks of; a measurement may lack some.
  std::array<bool, channel_views.size()> has{true, true, true, true};
  std::size_t runs = 1;                      ///< behind the means
  std::size_t unsteady = 0;                  ///< of grains: those of them that did not become steady
  double drift = 0.0;                        ///< of grains: the largest of theirs (RecordedRun)
  double void_ratio = not_a_number;          ///< of grains: mean of their beds, where it is told
  std::optional<ResolutionError> by_twin{};  ///< of grains that have a coarser twin there
  Doubts doubts;                             ///< what limits them: unsteady_runs, one_bed_sample
  std::string error;                         ///< why there is no result
};

/// A model or the measurement, a point for each condition of the study.
struct Side {
  std::string label;
  SideKind kind = SideKind::analytic;
  std::vector<SidePoint> points;
  std::optional<ModelChoice> choice{};  ///< of an analytic side: its model and effects
  /// Whether the runs of grains tell how far packings scatter, be it less than single runs' own errors.
  bool scatter_known = false;
  /// The noise of one measured run, from all re-runs of the campaign.
  std::optional<NoiseFloor> noise{};
  /// The measured runs behind the points, in the campaign's own frame and slip.
  std::vector<Run> runs{};
  Doubts doubts{};  ///< in all its points: whether a record hangs on the time step
};

/// Whether a side is of this quick model.
inline bool is_by(const Side& side, ModelKind model) { return side.choice && side.choice->model == model; }

/// A model's answers as a side. Of grains, scatter is the answers' standard error.
Side side_of(const ModelAnswers& answers);

/// The quick models that a comparison sets side by side: the analytic wheel without effects, then the study's own with
/// effects, and resistive force theory where it is asked.
std::vector<ModelChoice> analytic_choices(const Study& study);

/// Adds the analytic model with these effects, unless one of the choices has them already; says whether it did.
bool add_choice(std::vector<ModelChoice>& choices, std::vector<EffectChoice> effects);

/// A side for each choice, with its answers; none where the soil has no values for the analytic model.
std::vector<Side> analytic_sides(Case question, const std::vector<ModelChoice>& choices, const Progress& progress = {});

/// Runs as a side: each counts at the condition that it is alike, with told_answer of those with a result. Scatter is
/// what told_scatter of all runs makes of their own errors: two packings at a condition say little of its scatter, all
/// conditions together more. Doubts tell of runs that were not steady or had
/// no result, and where no condition has several packings. `coarser`: runs with coarser grains (RunKind), for the error
/// of resolution.
Side side_of(const std::string& label, const std::vector<RecordedRun>& runs,
             const std::vector<OperatingCondition>& conditions, const std::vector<RecordedRun>& coarser = {});

/// The error of resolution of a point of grains that has a result: by its twin; without one that of the study.
ResolutionError resolution_error(const Scenario& scenario, const OperatingCondition& at, const SidePoint& point);

/// Where points have twins, what coarse grains do is told by the largest error of these.
void tell_twins(Doubts& doubts, const std::vector<SidePoint>& points,
                const std::vector<OperatingCondition>& conditions);

/// Grains as a side, and what a page tells of their runs.
struct GrainSide {
  Side side;
  std::vector<std::pair<std::string, std::string>> facts;  ///< "packings (seeds of the beds)": "1, 2"; and so on
};

/// The runs behind it; `record`: the file that keeps them, which also knows whether they hang on the time step, or "".
GrainSide grain_side(const std::vector<RecordedRun>& runs, const std::vector<OperatingCondition>& conditions,
                     const std::filesystem::path& record, const std::vector<RecordedRun>& coarser = {});

/// Whether the bed was looser or denser, by more than 3 %, than the soil whose values the analytic model has; none
/// where either density is not known.
Doubts bed_density_doubts(const Soil& soil, const std::vector<RecordedRun>& runs);

/// How far a measured run may be from a study's condition and still count as one of it: share of the load, slip [-],
/// angles [rad].
inline constexpr double near_load = 0.10, near_slip = 0.025, near_angle = 0.02;

/// Measured runs near each condition, averaged. Each run counts at the nearest condition alone. Slips and forces are
/// those of the study's definitions: slip by its speed, forces in its frame, each turned by the run's own yaw. At a yaw
/// (beyond near_angle) turning takes both drawbar pull and lateral force; where one wasn't measured the point
/// speaks of neither, and a doubt tells so.
///
/// The standard error of a mean of n runs is the noise of one run over sqrt(n); the noise is pooled over all setpoints
/// that the campaign ran twice or more (rerun_noise), near a condition or not, so that single runs have an error too.
/// Runs without a label are re-runs of one setpoint where they count at one condition. Without any re-run a point has
/// no error, and a doubt tells so. Means over two labels tell by a doubt that what sets these apart is not in their
/// error.
///
/// The tractive efficiency of a point is that of the means, where the channels that it takes were measured.
///
/// Throws InputError where no run is near any condition, or where the wheels differ: radius, width, height of the lugs
/// or inflation pressure by over 5 %, their number (where both know it) at all, lugs or air where the other has none.
Side side_of(const Campaign& campaign, const Case& question);

// The noise of a measured campaign, estimated from its re-runs: the scatter between runs of one setpoint.

/// What these runs measured of a channel (of channel_views) [SI]; runs without it are left out.
std::vector<double> values_of(const std::vector<const Run*>& runs, std::size_t channel);

/// Noise of one run, channel by channel, pooled over setpoints: sum of squares about each setpoint's mean over the
/// sum of runs beyond each setpoint's first, which is the freedom. All channels need not be measured in all runs.
/// Freedom 0: no setpoint has two runs with the channel, and nothing is known of its noise.
///
/// The standard deviation is one number, a, unless there are 20 degrees of freedom or more and the re-runs show that it
/// grows with the signal f: sqrt(a^2 + b^2 f^2) is taken where it makes them likelier by exp(2), which chance alone
/// does in about one campaign in thirty. `correlation`: between channels of one run, of the same residuals.
NoiseFloor rerun_noise(const std::vector<std::vector<const Run*>>& setpoints);

}  // namespace soilbin::compare
