// Errors on conditions left out, by channel, in words: what a model gains and what it loses, in the same place.
#pragma once

#include <string>
#include <vector>

#include "compare/loop/loop.hpp"

namespace soilbin::compare {

/// Whether a held-out error is larger with the effects than without, by more than its third digit.
bool rises(const ErrorPair& error);

/// The channels whose held-out error rises with the effects that the answer's model takes (Channel); none where it
/// takes none.
std::vector<int> worse_channels(const LoopAnswer& answer);

/// "held-out error falls by 28 +- 5 sigma^2 a value; predicted better: sinkage (20.6 to 7.04 mm); predicted worse:
/// drawbar pull (5.95 to 6.3 N)".
std::string held_out_words(const CrossValidation& validation);

}  // namespace soilbin::compare
