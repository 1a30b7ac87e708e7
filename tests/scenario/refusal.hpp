// What a refusal must say: the place, what is wrong there, and what to write instead.
#pragma once

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "scenario/errors.hpp"

namespace soilbin::test {

/// The message of the error that an action throws; "" where it throws none.
template <class Error = InputError, class Action>
std::string error_of(const Action& action) {
  try {
    action();
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

/// error_of; a failed test where it throws none.
template <class Error = InputError, class Action>
std::string refusal(const Action& action) {
  const std::string error = error_of<Error>(action);
  EXPECT_NE(error, "") << "nothing was refused";
  return error;
}

}  // namespace soilbin::test
