// The one list of doubts: what a person should know before believing an answer. The readers rightly accept what stands
// here; but it is hardly meant, has no influence, or lies beyond what a model can tell.
//
// Who answers a question asks `doubts` with the question and its answers and tells all that it gives (doubt.hpp): as
// lines "warning: ..." beside the answer, as "warnings" in JSON (add_warnings), as a list on a page
// (PageAbout::doubts).
//
//   for (const std::string& line : in_words(doubts(question))) std::cerr << "warning: " << line << '\n';
//
// What is doubtful is decided in this folder, so that every command tells the same, and worded in one table
// (doubt_words.cpp):
//
//   a soil by itself     values out of the usual, no strength, nothing carried     declared_doubts.cpp
//   a wheel on a soil    proportions, a width for which the soil carries nothing   declared_doubts.cpp
//   an answer            deep sinkage, odd pressure, more power out than in        answer_doubts.cpp
//   a heavy tire         what grains show of one, beside the answer                heavy_doubts.cpp
//   no influence         lugs, inflation, passes, ... that change no digit         unused_inputs.cpp
//   a presumption        what an effect takes the wheel to have, and nobody said   doubts.cpp
//   grains               odd values, too soft or coarse, a law that hangs on the   grain_doubts.cpp
//                        step
//   measured rows        repeated, flipped, impossible                             row_doubts.cpp
//                        samples of a log in place of runs                       row_doubts.cpp
//   measured columns     swapped, in another unit, of another sign                 column_doubts.cpp
//   measured plates      a modulus below 0, no repeats, a form that misses         plate_doubts.cpp
//
// Three things have theirs with them: recorded runs, whether they hang on the time step (recorded/step_pair.hpp); a
// side of a comparison, how many runs are behind a point (discrepancy/side.cpp, measured_side.cpp); a failure map,
// experiments of an earlier engine (failure_map/incline_map.cpp).
#pragma once

#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "compare/doubts/doubt.hpp"
#include "compare/measured/campaign.hpp"
#include "compare/sweep/answers.hpp"
#include "compare/sweep/prediction.hpp"
#include "compare/sweep/result_json.hpp"
#include "scenario/case.hpp"
#include "scenario/soil.hpp"
#include "scenario/tire.hpp"

namespace soilbin::cone_index {
struct Mobility;
}

namespace soilbin::compare {

struct LoggedRun;
struct LogRuns;
struct MeasuredPlatesFit;
struct MeasuredShear;
struct MeasuredShearFit;
struct PlateGroups;

/// Doubts of a question and its answers, by any model. A condition without an answer is none of them: answers say that
/// themselves. `study` may be empty, and its models need not be all of the question's. `of_models`: what else is
/// doubtful in their answers; told among the others.
Doubts doubts(const Case& question, const std::vector<ModelAnswers>& study, const Doubts& of_models = {});

/// The scenario with a rigid wheel and with what Wong and Reece lack under a heavy tire on sand, in the forms and with
/// the values that its doubts name.
Scenario as_in_grains(Scenario scenario);
/// The question of that wheel, asked of the analytic model alone.
Case as_in_grains(Case question);

/// A steepest slope [rad] beside the one as_in_grains (none: not even level ground), where doubts tell of a heavy tire;
/// `who` climbs: "the wheel".
Doubts doubts_of_climb(const Doubts& told, const char* who, std::optional<double> steepest,
                       const std::function<std::optional<double>()>& as_in_grains);

/// The question's tire, for the first line of an answer; says where its lugs change nothing.
std::string tire_in_words(const Case& question);

/// Doubts of a question without answers: asks its analytic models, tells where they have no answer, and looks at
/// the soil's grains too, which `--model dem` would take.
Doubts doubts(const Case& question);

/// Doubts of a campaign and its prediction by `asked`: the wheel with that soil and these effects, and the rows.
Doubts doubts(const Campaign& campaign, const Scenario& asked, const Prediction& prediction);

/// Doubts of a campaign, by the model that it declares; tells where that has no answer.
Doubts doubts(const Campaign& campaign);

/// Doubts of a campaign before a fit that looks for effects: without what the declared model alone does not read.
Doubts doubts_before_fit(const Campaign& campaign);

/// Doubts that take a column for mistaken or the rows for samples of a log: no verdict holds beside one.
Doubts of_mistaken_columns(Doubts doubts);

/// What is doubtful in one answer, for its row of a table: without the condition, which stands there. "" where nothing
/// is. An answer that is none says why by itself.
std::string remark_on(const Scenario& scenario, const ModelChoice& model, const Answer& answer);

/// remark_on for a table of answers about one scenario, which must outlive it.
Remark remarks_about(const Scenario& scenario);

/// A remark for each run of a prediction, on the answer and on the measured row.
std::vector<std::string> remarks_on(const Campaign& campaign, const Scenario& asked, const Prediction& prediction);

/// Tests that disagree, a sensor that sticks, spikes without number, one size of plate, a modulus below 0, an unusual
/// n, no test that was repeated, a curve that bends, a form that misses the pressures.
Doubts doubts(const MeasuredPlatesFit& fit);

/// Doubts of tests fitted apart: their readings', one size of plate, a density that no bed had.
Doubts doubts(const PlateGroups& groups);

/// One normal stress, a cohesion below 0, humps, no test that was repeated.
Doubts doubts(const MeasuredShearFit& fit, std::span<const MeasuredShear> tests);

// Parts of the list.

// Signs that the rows of a campaign are samples of a log and no runs. Samples of one run share its bed: counted as runs
// they make errors too small by many times, and a fit takes what one bed differs by for an effect.
//
//   if (!signs_of_a_log(campaign).empty()) ...  // no verdict holds beside one

/// One, or none, on rows that look like samples, by the first of these (numbers chosen):
/// - an ignored column holds a clock with even steps, over 20 rows or more;
/// - rows on end have one run's number, three or more on average;
/// - ten rows or more on end are at one setpoint: in half of all rows, and in two setpoints or more unless they are
///   smooth;
/// - four rows or more on end are at one setpoint on average, 40 rows or more in all, and they are smooth;
/// - a hundred rows or more whose conditions hardly change from one to the next, twenty on end at like conditions.
/// Rows of one setpoint are smooth where their autocorrelation at lag 1, about each stretch's mean and over all
/// stretches, is more than 0.5 and four of its standard errors for independent rows, 1/sqrt(pairs) (Bartlett 1946).
/// And one on an ignored column that names several wheels.
Doubts signs_of_a_log(const Campaign& campaign);

/// Rows that are no runs, that no wheel makes, that were copied, that were unsteady; a sinkage whose sign seems
/// flipped. Without a line: of the whole column.
Doubts row_doubts(const Campaign& campaign);

/// The model that gave the answers, asked at other conditions.
using AskAgain = std::function<std::vector<Answer>(const std::vector<OperatingCondition>&)>;

/// Columns that a model's answers, one a run, fit far better once what may have been done to them is undone: a sign
/// flipped (pull, torque, lateral force, slip), numbers a power of ten too large or too small (channels), slips or
/// loads in another unit, two columns swapped. Each column is named once at most, with what fits best; the rest is
/// judged with that put right. Of more than 200 runs some are looked at, evenly.
Doubts column_doubts(const Campaign& campaign, const std::vector<Answer>& answers, const AskAgain& ask);

/// Where a person names the effects of a model.
enum class EffectsAre { flags, of_a_drive, of_a_campaign };

/// Inputs of a question that change no digit of any of its models' answers: what a case declares and its analytic
/// models, or its grains, hear nothing of, and the effects that it switches on whose condition it gives nowhere. Each
/// says first the key of a tire, a condition or a bin: "lugs", "lugs.count", "inflation_pressure", "pass", "bin"; but
/// bin_depth_taken, which says the effect.
Doubts unused_inputs(const Case& question, EffectsAre named = EffectsAre::flags);

/// Channels of a run made of samples that are not steady; of all runs of a log, by run and lines.
Doubts doubts(const LoggedRun& run);
Doubts doubts(const LogRuns& runs);

/// Doubts of a soil by itself: values out of the usual, no strength, nothing carried, hardly known.
Doubts doubts(const Soil& soil);

/// Of a pressure [Pa] that no tire has, the wheel's own or that of a condition.
Doubts unusual_inflation(double pressure, const std::optional<OperatingCondition>& at = std::nullopt);

/// Doubts of a wheel by itself: its size, proportions and pressure.
Doubts doubts(const Tire& tire);

/// Doubts of a wheel and its soil, which may carry nothing for this width.
Doubts doubts(const Tire& tire, const Soil& soil);

/// What resistive force theory takes for a soil that does not declare its values, and what it can't know of it.
Doubts resistive_force_doubts(const Soil& soil);

/// What the model cone_index takes for a tire that does not declare it, where its relation was not tested, and what it
/// can't answer.
Doubts cone_index_doubts(const Scenario& scenario, const std::vector<OperatingCondition>& conditions);

/// A vehicle that does not drive all axles, a cone index taken for a rating, a verdict within its error, a pressure
/// that can't be told.
Doubts doubts(const cone_index::Mobility& mobility);

// Warnings on several studies and campaigns together: each doubt once, with the names of all that it applies to.
//
//   NamedDoubts named;
//   for (...) named.add(question.study.name, question, study);
//   print_warnings(named.all());  // "paper-straight, paper-transverse: the tire's lugs change nothing: ..."
//
// Studies of the same wheel on the same grains differ only in the figures of the doubt about coarse grains: it is given
// once, with the worst figures.

class NamedDoubts {
 public:
  /// Adds the doubts of a study and its answers.
  void add(const std::string& name, const Case& question, const std::vector<ModelAnswers>& study);
  /// Adds doubts that were found elsewhere.
  void add(const std::string& name, const Doubts& doubts);
  /// In the order in which they came, each with its names (Doubt::of).
  Doubts all() const;

 private:
  struct OnGrains {
    Scenario scenario;
    std::vector<ModelAnswers> study;  ///< of all that share the doubt
  };
  struct Entry {
    Doubt doubt;
    std::optional<OnGrains> grains;  ///< the doubt is made from these
  };
  std::vector<Entry> entries_;
};

}  // namespace soilbin::compare
