#include "dem/verification/cases.hpp"

namespace soilbin::dem {

std::vector<VerificationCase> verification_cases() {
  std::vector<VerificationCase> all;
  for (const auto& cases : {chung_ooi_cases(), motion_cases(), adhesion_cases(), mercury_cases(), mesh_cases(),
                            clump_cases(), step_size_cases()})
    all.insert(all.end(), cases.begin(), cases.end());
  return all;
}

std::vector<VerificationRow> rows_of(const std::vector<VerificationCase>& cases, const StartEngine& start,
                                     const std::function<void(std::size_t, std::size_t)>& progress) {
  std::vector<VerificationRow> rows;
  for (std::size_t i = 0; i < cases.size(); ++i) {
    cases[i].add_rows(rows, start);
    if (progress) progress(i + 1, cases.size());
  }
  return rows;
}

}  // namespace soilbin::dem
