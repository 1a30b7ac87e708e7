// A yes or no of a file, as a choice between two words.
#pragma once

#include <array>
#include <type_traits>

#include "scenario/description.hpp"

namespace soilbin {

enum class YesNo { no, yes };

constexpr std::array<Word<YesNo>, 2> words_of(std::type_identity<YesNo>) {
  return {{{"no", YesNo::no}, {"yes", YesNo::yes}}};
}

}  // namespace soilbin
