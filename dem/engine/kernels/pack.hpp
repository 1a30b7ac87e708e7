// A pack of doubles, as wide as the instruction set that this file is compiled for, with the operators that the laws
// are written in; and the way from rows (a grain each) to columns (a quantity each) and back.
#pragma once

#include <hwy/highway.h>

#include <cstdint>

namespace soilbin::dem::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;
using Lanes = hn::CappedTag<double, 8>;
using Vector = hn::Vec<Lanes>;
inline constexpr int lanes = static_cast<int>(hn::MaxLanes(Lanes()));
static_assert(lanes == 2 || lanes == 4 || lanes == 8, "doubles come in 2, 4 or 8");

struct PackMask {
  hn::Mask<Lanes> m;
};

struct Pack {
  Vector v;
  Pack() = default;
  HWY_INLINE Pack(Vector vector) : v(vector) {}
  HWY_INLINE explicit Pack(double value) : v(hn::Set(Lanes(), value)) {}

  HWY_INLINE friend Pack operator+(Pack a, Pack b) { return hn::Add(a.v, b.v); }
  HWY_INLINE friend Pack operator-(Pack a, Pack b) { return hn::Sub(a.v, b.v); }
  HWY_INLINE friend Pack operator*(Pack a, Pack b) { return hn::Mul(a.v, b.v); }
  HWY_INLINE friend Pack operator/(Pack a, Pack b) { return hn::Div(a.v, b.v); }
  HWY_INLINE friend Pack operator-(Pack a) { return hn::Neg(a.v); }
  HWY_INLINE friend PackMask operator>(Pack a, Pack b) { return {hn::Gt(a.v, b.v)}; }
  HWY_INLINE friend PackMask operator<(Pack a, Pack b) { return {hn::Lt(a.v, b.v)}; }
};

HWY_INLINE Pack sqrt(Pack a) { return hn::Sqrt(a.v); }
HWY_INLINE Pack min(Pack a, Pack b) { return hn::Min(a.v, b.v); }
HWY_INLINE Pack max(Pack a, Pack b) { return hn::Max(a.v, b.v); }
HWY_INLINE Pack round(Pack a) { return hn::Round(a.v); }
HWY_INLINE Pack select(PackMask yes, Pack a, Pack b) { return hn::IfThenElse(yes.m, a.v, b.v); }
HWY_INLINE Pack where(PackMask yes, Pack a) { return hn::IfThenElseZero(yes.m, a.v); }
HWY_INLINE PackMask operator|(PackMask a, PackMask b) { return {hn::Or(a.m, b.m)}; }
HWY_INLINE PackMask operator&(PackMask a, PackMask b) { return {hn::And(a.m, b.m)}; }
HWY_INLINE bool none(PackMask m) { return hn::AllFalse(Lanes(), m.m); }
HWY_INLINE Pack load(const double* from) { return hn::Load(Lanes(), from); }
HWY_INLINE void store(Pack a, double* to) { hn::Store(a.v, Lanes(), to); }

/// The image of a difference that is nearest to zero; period 0: there is only one.
HWY_INLINE Pack nearest_image(Pack d, double period) {
  return period > 0 ? d - Pack(period) * round(d * Pack(1 / period)) : d;
}

HWY_INLINE unsigned bits(PackMask m) {
  alignas(8) std::uint8_t out[8] = {};
  hn::StoreMaskBits(Lanes(), m.m, out);
  return out[0];
}
HWY_INLINE PackMask mask_of(unsigned bits) {
  alignas(8) std::uint8_t in[8] = {static_cast<std::uint8_t>(bits)};
  return {hn::LoadMaskBits(Lanes(), in)};
}

/// The sum over the pack, one after the other: the same bits for every width, pack by pack.
HWY_INLINE double add_up(double sum, Pack a) {
  alignas(64) double all[lanes];
  store(a, all);
  for (const double one : all) sum += one;
  return sum;
}

struct FourPacks {
  Pack a, b, c, d;
};

using Four = hn::CappedTag<double, 4>;

/// Columns of `lanes` rows of four doubles: row k is at row(k), aligned to 32 bytes.
template <class RowAt, int n = lanes>  // n: so that only the branch for this width is compiled
HWY_INLINE FourPacks columns(const RowAt& row) {
  const Lanes d;
  if constexpr (n == 8) {
    const auto pair = [&](int k) { return hn::Combine(d, hn::Load(Four(), row(k + 4)), hn::Load(Four(), row(k))); };
    const auto r0 = pair(0), r1 = pair(1), r2 = pair(2), r3 = pair(3);
    const auto even01 = hn::InterleaveLower(d, r0, r1), odd01 = hn::InterleaveUpper(d, r0, r1);
    const auto even23 = hn::InterleaveLower(d, r2, r3), odd23 = hn::InterleaveUpper(d, r2, r3);
    return {hn::OddEvenBlocks(hn::SwapAdjacentBlocks(even23), even01),
            hn::OddEvenBlocks(hn::SwapAdjacentBlocks(odd23), odd01),
            hn::OddEvenBlocks(even23, hn::SwapAdjacentBlocks(even01)),
            hn::OddEvenBlocks(odd23, hn::SwapAdjacentBlocks(odd01))};
  } else if constexpr (n == 4) {
    const auto r0 = hn::Load(d, row(0)), r1 = hn::Load(d, row(1)), r2 = hn::Load(d, row(2)), r3 = hn::Load(d, row(3));
    const auto even01 = hn::InterleaveLower(d, r0, r1), odd01 = hn::InterleaveUpper(d, r0, r1);
    const auto even23 = hn::InterleaveLower(d, r2, r3), odd23 = hn::InterleaveUpper(d, r2, r3);
    return {hn::ConcatLowerLower(d, even23, even01), hn::ConcatLowerLower(d, odd23, odd01),
            hn::ConcatUpperUpper(d, even23, even01), hn::ConcatUpperUpper(d, odd23, odd01)};
  } else {
    const auto r0 = hn::Load(d, row(0)), r1 = hn::Load(d, row(1));
    const auto s0 = hn::Load(d, row(0) + 2), s1 = hn::Load(d, row(1) + 2);
    return {hn::InterleaveLower(d, r0, r1), hn::InterleaveUpper(d, r0, r1), hn::InterleaveLower(d, s0, s1),
            hn::InterleaveUpper(d, s0, s1)};
  }
}

struct SixPacks {
  Pack a, b, c, d, e, f;
};

template <class Tag>
HWY_INLINE void add_to(Tag d, double* sum, hn::Vec<Tag> what) {
  hn::Store(hn::Add(hn::Load(d, sum), what), d, sum);
}

/// The way back: adds row after row of six columns to the first six of the eight doubles at row(k), which are aligned
/// to 64 bytes. The other two stay what they are.
template <class RowAt, int n = lanes>
HWY_INLINE void add_rows(const SixPacks& of, const RowAt& row) {
  const Lanes d;
  const auto ab_even = hn::InterleaveLower(d, of.a.v, of.b.v), ab_odd = hn::InterleaveUpper(d, of.a.v, of.b.v);
  const auto cd_even = hn::InterleaveLower(d, of.c.v, of.d.v), cd_odd = hn::InterleaveUpper(d, of.c.v, of.d.v);
  const auto ef_even = hn::InterleaveLower(d, of.e.v, of.f.v), ef_odd = hn::InterleaveUpper(d, of.e.v, of.f.v);
  if constexpr (n == 8) {
    const auto zero = hn::Zero(d);
    const auto abcd0 = hn::OddEvenBlocks(hn::SwapAdjacentBlocks(cd_even), ab_even);  // rows 0 and 4
    const auto abcd1 = hn::OddEvenBlocks(hn::SwapAdjacentBlocks(cd_odd), ab_odd);    // 1 and 5
    const auto abcd2 = hn::OddEvenBlocks(cd_even, hn::SwapAdjacentBlocks(ab_even));  // 2 and 6
    const auto abcd3 = hn::OddEvenBlocks(cd_odd, hn::SwapAdjacentBlocks(ab_odd));    // 3 and 7
    const auto ef0 = hn::OddEvenBlocks(zero, ef_even), ef1 = hn::OddEvenBlocks(zero, ef_odd);
    const auto ef2 = hn::OddEvenBlocks(zero, hn::SwapAdjacentBlocks(ef_even));
    const auto ef3 = hn::OddEvenBlocks(zero, hn::SwapAdjacentBlocks(ef_odd));
    add_to(d, row(0), hn::ConcatLowerLower(d, ef0, abcd0));
    add_to(d, row(1), hn::ConcatLowerLower(d, ef1, abcd1));
    add_to(d, row(2), hn::ConcatLowerLower(d, ef2, abcd2));
    add_to(d, row(3), hn::ConcatLowerLower(d, ef3, abcd3));
    add_to(d, row(4), hn::ConcatUpperUpper(d, ef0, abcd0));
    add_to(d, row(5), hn::ConcatUpperUpper(d, ef1, abcd1));
    add_to(d, row(6), hn::ConcatUpperUpper(d, ef2, abcd2));
    add_to(d, row(7), hn::ConcatUpperUpper(d, ef3, abcd3));
  } else if constexpr (n == 4) {
    const hn::Half<Lanes> half;
    const auto add = [&](int k, Vector abcd, hn::Vec<hn::Half<Lanes>> ef) HWY_ATTR {
      add_to(d, row(k), abcd);
      add_to(half, row(k) + 4, ef);
    };
    add(0, hn::ConcatLowerLower(d, cd_even, ab_even), hn::LowerHalf(half, ef_even));
    add(1, hn::ConcatLowerLower(d, cd_odd, ab_odd), hn::LowerHalf(half, ef_odd));
    add(2, hn::ConcatUpperUpper(d, cd_even, ab_even), hn::UpperHalf(half, ef_even));
    add(3, hn::ConcatUpperUpper(d, cd_odd, ab_odd), hn::UpperHalf(half, ef_odd));
  } else {
    const auto add = [&](int k, Vector ab, Vector cd, Vector ef) HWY_ATTR {
      add_to(d, row(k), ab);
      add_to(d, row(k) + 2, cd);
      add_to(d, row(k) + 4, ef);
    };
    add(0, ab_even, cd_even, ef_even);
    add(1, ab_odd, cd_odd, ef_odd);
  }
}

}  // namespace soilbin::dem::HWY_NAMESPACE
