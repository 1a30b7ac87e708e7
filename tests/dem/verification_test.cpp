// The published and closed-form cases on the fast engine; reference_engine_test.cpp runs them on the reference engine.
#include <gtest/gtest.h>

#include "dem/verification/fast_engine.hpp"

namespace soilbin::dem {
namespace {

TEST(SlowVerification, EveryPublishedCaseIsMet) {
  const auto rows = verification_rows(start_fast_engine);
  EXPECT_GT(rows.size(), 100u);
  for (const VerificationRow& row : rows)
    EXPECT_TRUE(row.pass()) << row.name << ": published " << row.published << ", ours " << row.ours << ", tolerance "
                            << row.tolerance << ' ' << row.unit;
}

}  // namespace
}  // namespace soilbin::dem
