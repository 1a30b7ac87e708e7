// Sets of effects and the evidence for them in words: names, odds, shares.
//
//   odds_and_p(found.signatures);   // "noise alone would look like this in 1 of 81 campaigns, p = 0.012"
#pragma once

#include <set>
#include <string>
#include <vector>

#include "compare/attribution/signatures.hpp"

namespace soilbin::compare {

/// "a", "a and b", "a, b and c".
std::string joined_with_and(const std::vector<std::string>& words);

/// Ids: "slip_sinkage", "multipass + sensor_offset"; "no effect" for an empty set.
std::string joined(const std::set<std::string>& ids);

/// Names for people: "side-wall bulldozing, slip sinkage and hard layer"; "no effect" for an empty set.
std::string named_effects(const std::set<std::string>& ids);

/// How often noise alone would look like this: "1 of 81 campaigns", "30 of 100 campaigns", "none of 4,000 simulated
/// campaigns".
std::string odds_words(const ResidualSignatures& signatures);
/// "p = 0.012"; "p < 0.00025" where no simulated campaign looked like this.
std::string p_words(const ResidualSignatures& signatures);
/// "noise alone would look like this in 1 of 81 campaigns, p = 0.012".
std::string odds_and_p(const ResidualSignatures& signatures);

/// Odds from their logarithm: "132 times", "more than a million times".
std::string times_likelier(double log_odds);

/// A share of the evidence below this [-] is told as "< 1 %".
inline constexpr double least_share = 0.005;

/// A set's share of the evidence, the same in every place: "81 %".
std::string share_words(double weight);

}  // namespace soilbin::compare
