// How tests ask for doubts: by their kind and what they say first, and what a failed one prints.
#pragma once

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <ostream>
#include <vector>

#include "compare/doubts/doubt.hpp"

namespace soilbin::compare {

inline void PrintTo(const Doubt& doubt, std::ostream* out) { *out << kind_word(doubt.kind) << ": " << in_words(doubt); }

}  // namespace soilbin::compare

namespace soilbin::test {

/// A doubt of this kind that says these first: texts as they are, numbers to one part in 200.
inline testing::Matcher<const compare::Doubt&> tells(compare::DoubtKind kind,
                                                     const std::vector<compare::Said>& says = {}) {
  const auto same = [](const compare::Said& one, const compare::Said& other) {
    const double *a = std::get_if<double>(&one), *b = std::get_if<double>(&other);
    return a && b ? std::abs(*a - *b) <= 0.005 * std::abs(*a) : one == other;
  };
  return testing::Truly([=](const compare::Doubt& doubt) {
    return doubt.kind == kind && says.size() <= doubt.says.size() &&
           std::equal(says.begin(), says.end(), doubt.says.begin(), same);
  });
}

}  // namespace soilbin::test
