// What a refusal must say: the place, what is wrong there, and what to write instead.
#pragma once

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "scenario/errors.hpp"

namespace soilbin::test {

/// The message of the InputError that an action throws; a failed test and "" where it throws none.
template <class Action>
std::string refusal(const Action& action) {
  try {
    action();
  } catch (const InputError& error) {
    return error.what();
  }
  ADD_FAILURE() << "nothing was refused";
  return "";
}

}  // namespace soilbin::test
