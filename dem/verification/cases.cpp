#include "dem/verification/cases.hpp"

#include <iterator>

namespace soilbin::dem {

std::vector<VerificationRow> verification_rows(const StartEngine& start) {
  auto rows = chung_ooi_rows(start);
  for (auto* more : {&motion_rows, &adhesion_rows, &mercury_rows}) {
    auto added = (*more)(start);
    rows.insert(rows.end(), std::make_move_iterator(added.begin()), std::make_move_iterator(added.end()));
  }
  auto meshes = mesh_rows();
  rows.insert(rows.end(), std::make_move_iterator(meshes.begin()), std::make_move_iterator(meshes.end()));
  return rows;
}

}  // namespace soilbin::dem
