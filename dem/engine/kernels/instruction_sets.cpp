#include <hwy/targets.h>

#include <array>
#include <string>
#include <vector>

#include "dem/engine/kernels/pair_kernel.hpp"
#include "scenario/errors.hpp"

namespace soilbin::dem {

// As pair_kernel.cpp names them, by what Highway calls each instruction set.
namespace N_AVX3 {
void run_pairs(const PairSweep&, std::size_t, std::size_t, PairFindings&);
}
namespace N_AVX2 {
void run_pairs(const PairSweep&, std::size_t, std::size_t, PairFindings&);
}
namespace N_SSE4 {
void run_pairs(const PairSweep&, std::size_t, std::size_t, PairFindings&);
}

namespace {

struct Choice {
  std::string_view name;
  std::int64_t target;
  PairKernel kernel;
};

constexpr std::array<Choice, 3> choices = {{{"avx512", HWY_AVX3, N_AVX3::run_pairs},
                                            {"avx2", HWY_AVX2, N_AVX2::run_pairs},
                                            {"sse4", HWY_SSE4, N_SSE4::run_pairs}}};

}  // namespace

std::span<const std::string_view> instruction_sets() {
  static const std::vector<std::string_view> here = [] {
    std::vector<std::string_view> names;
    for (const Choice& choice : choices)
      if (hwy::SupportedTargets() & choice.target) names.push_back(choice.name);
    return names;
  }();
  return here;
}

PairKernel pair_kernel(std::string_view instruction_set) {
  std::string known;
  for (const std::string_view name : instruction_sets()) {
    for (const Choice& choice : choices)
      if (choice.name == name && name == instruction_set) return choice.kernel;
    known += known.empty() ? "" : ", ";
    known += name;
  }
  throw InputError("no instruction set '" + std::string(instruction_set) + "' here\n  hint: this machine has " + known);
}

}  // namespace soilbin::dem
