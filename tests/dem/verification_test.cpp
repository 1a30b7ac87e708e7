// The published and closed-form cases on the fast engine; reference_engine_test.cpp runs them on the reference engine.
#include <gtest/gtest.h>

#include <algorithm>

#include "dem/verification/fast_engine.hpp"

namespace soilbin::dem {
namespace {

TEST(SlowVerification, EveryPublishedCaseIsMetAndNamedAsItsRowsBegin) {
  std::size_t rows = 0;
  for (const VerificationCase& one : verification_cases())
    for (const VerificationRow& row : rows_of({one}, start_fast_engine)) {
      ++rows;
      EXPECT_TRUE(row.pass()) << row.name << ": published " << row.published << ", ours " << row.ours << ", tolerance "
                              << row.tolerance << ' ' << row.unit;
      EXPECT_TRUE(std::any_of(one.names.begin(), one.names.end(), [&](const std::string& name) {
        return row.name.starts_with(name);
      })) << row.name;
    }
  EXPECT_GT(rows, 100u);
}

}  // namespace
}  // namespace soilbin::dem
