#include <hwy/highway.h>
#include <hwy/targets.h>

#include <string>
#include <vector>

#include "dem/engine/kernels/kernels.hpp"
#include "scenario/errors.hpp"

namespace soilbin::dem {

// The kernels of one instruction set, in the namespace that Highway has for it.
#define SOILBIN_KERNELS(SET)                                                           \
  namespace SET {                                                                      \
  void run_pairs(const PairSweep&, std::size_t, std::size_t, PairFindings&);           \
  void run_touches(const TouchSweep&, TouchBatch&, int);                               \
  void find_near_rows(const NearSweep&, std::uint32_t, const RowRun*, int, NearRows&); \
  }
#if HWY_ARCH_X86
SOILBIN_KERNELS(N_AVX3)
SOILBIN_KERNELS(N_AVX2)
SOILBIN_KERNELS(N_SSE4)
#elif HWY_ARCH_ARM
SOILBIN_KERNELS(N_NEON)
#else
SOILBIN_KERNELS(HWY_NAMESPACE)
#endif

namespace {

struct Choice {
  std::string_view name;
  std::int64_t target;
  Kernels kernels;
};

#if HWY_ARCH_X86
constexpr Choice choices[] = {{"avx512", HWY_AVX3, {N_AVX3::run_pairs, N_AVX3::run_touches, N_AVX3::find_near_rows}},
                              {"avx2", HWY_AVX2, {N_AVX2::run_pairs, N_AVX2::run_touches, N_AVX2::find_near_rows}},
                              {"sse4", HWY_SSE4, {N_SSE4::run_pairs, N_SSE4::run_touches, N_SSE4::find_near_rows}}};
#else
constexpr std::int64_t any = -1;  // the one set that there is, compiled for every machine of the kind
#if HWY_ARCH_ARM
constexpr Choice choices[] = {{"neon", any, {N_NEON::run_pairs, N_NEON::run_touches, N_NEON::find_near_rows}}};
#else
constexpr Choice choices[] = {
    {"portable", any, {HWY_NAMESPACE::run_pairs, HWY_NAMESPACE::run_touches, HWY_NAMESPACE::find_near_rows}}};
#endif
#endif

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

Kernels kernels_for(std::string_view instruction_set) {
  std::string known;
  for (const std::string_view name : instruction_sets()) {
    for (const Choice& choice : choices)
      if (choice.name == name && name == instruction_set) return choice.kernels;
    known += known.empty() ? "" : ", ";
    known += name;
  }
  throw InputError("no instruction set '" + std::string(instruction_set) + "' here\n  hint: this machine has " + known);
}

}  // namespace soilbin::dem
