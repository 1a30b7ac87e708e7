// Physical nonsense in a question that the readers rightly accept: possible, but hardly meant.
#pragma once

#include <string>
#include <vector>

#include "bekker_wong/effect.hpp"
#include "compare/measured/campaign.hpp"
#include "compare/sweep/answers.hpp"
#include "scenario/case.hpp"

namespace soilbin::compare {

/// Warnings about a soil by itself: values out of the usual, combinations that carry nothing.
std::vector<std::string> doubts(const SemiEmpiricalSoil& soil);

/// Warnings about a whole case: its soil, its wheel on this soil, each of its conditions (those alike once).
std::vector<std::string> doubts(const Case& question);

/// The same without unheard.
std::vector<std::string> doubts_but_unheard(const Case& question);

/// Warnings about answers of the analytic model: a wheel that settles deeper (slip sinkage) than the 0.9 of its radius
/// up to which the stresses are meant. Each kind once.
std::vector<std::string> doubts(const Tire& tire, const std::vector<ModelAnswers>& study);

/// Whether a form's answer hangs on this key of Unheard. Where it is not given the form changes nothing (of lugs it
/// assumes some).
bool hears_of(const bekker_wong::EffectForm& form, const std::string& key);

/// Something that is declared and changes no digit.
struct Unheard {
  std::string key;    ///< "lugs", "pass", "moisture", "position", "run", or "effect" for an effect without such a value
  std::string words;  ///< why
};

/// What a case declares and none of its models hears of (lugs, passes, moisture, ...), and the effects that it switches
/// on whose condition it gives nowhere. Grains hear of lugs and passes.
std::vector<Unheard> unheard(const Case& question);

/// Warnings about a campaign: its soil, its runs, rows that repeat others, a drawbar pull whose sign looks flipped.
/// Each kind once.
std::vector<std::string> doubts(const Campaign& campaign);

/// Warnings that differ in numbers alone as one, with the number of the others: "(and at 3 other conditions)".
std::vector<std::string> once_each(const std::vector<std::string>& warnings);

}  // namespace soilbin::compare
