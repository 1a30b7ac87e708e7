// Sets of effects and the evidence for them in words: names, odds, shares.
//
//   noise_verdict(found.signatures);   // "not explained by noise (p = 0.012)"
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

/// "p = 0.012"; "p < 0.00025" where no simulated campaign looked like this.
std::string p_words(const ResidualSignatures& signatures);
/// "not explained by noise (p = 0.012)"; from p = 0.05 on "explained by noise (p = 0.3)".
std::string noise_verdict(const ResidualSignatures& signatures);

/// Odds from their logarithm: "132 times", "more than a million times".
std::string times_likelier(double log_odds);

/// A share of the evidence below this [-] is told as "< 1 %".
inline constexpr double least_share = 0.005;

/// A set's share of the evidence, the same in every place: "81 %".
std::string share_words(double weight);

}  // namespace soilbin::compare
