#pragma once

namespace soilbin {

/// A number and its standard error (or, for an input, its standard deviation), both in the same unit.
/// std_error 0 means "taken as exact".
struct Estimate {
  double value = 0.0;
  double std_error = 0.0;
};

}  // namespace soilbin
