// Grains on surfaces of triangles, on the engine: the cases of dem/verification/meshes.cpp.
#include <gtest/gtest.h>

#include "dem/verification/cases.hpp"

namespace soilbin::dem {
namespace {

TEST(SlowEngineMeshes, AreThePlanesAndCornersThatTheyStandFor) {
  for (const VerificationRow& row : rows_of(mesh_cases(), {}))
    EXPECT_TRUE(row.pass()) << row.name << ": expected " << row.published << ", ours " << row.ours << ", tolerance "
                            << row.tolerance << ' ' << row.unit;
}

}  // namespace
}  // namespace soilbin::dem
