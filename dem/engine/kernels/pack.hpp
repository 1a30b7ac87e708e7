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

/// a b before anything is added to it: a sum that follows rounds once, where the instruction set can. Which operations
/// are fused stands here, not with the compiler (-ffp-contract=off), so AVX2 and AVX-512 give the same bits.
struct Product {
  Vector a, b;
};

struct Pack {
  Vector v;
  Pack() = default;
  HWY_INLINE Pack(Vector vector) : v(vector) {}
  HWY_INLINE Pack(Product product) : v(hn::Mul(product.a, product.b)) {}
  HWY_INLINE explicit Pack(double value) : v(hn::Set(Lanes(), value)) {}
};

HWY_INLINE Product operator*(Pack a, Pack b) { return {a.v, b.v}; }
HWY_INLINE Pack operator/(Pack a, Pack b) { return hn::Div(a.v, b.v); }
HWY_INLINE Pack operator-(Pack a) { return hn::Neg(a.v); }
HWY_INLINE Pack operator+(Pack a, Pack b) { return hn::Add(a.v, b.v); }
HWY_INLINE Pack operator+(Product a, Pack b) { return hn::MulAdd(a.a, a.b, b.v); }
HWY_INLINE Pack operator+(Pack a, Product b) { return hn::MulAdd(b.a, b.b, a.v); }
HWY_INLINE Pack operator+(Product a, Product b) { return a + Pack(b); }
HWY_INLINE Pack operator-(Pack a, Pack b) { return hn::Sub(a.v, b.v); }
HWY_INLINE Pack operator-(Product a, Pack b) { return hn::MulSub(a.a, a.b, b.v); }
HWY_INLINE Pack operator-(Pack a, Product b) { return hn::NegMulAdd(b.a, b.b, a.v); }
HWY_INLINE Pack operator-(Product a, Product b) { return a - Pack(b); }
HWY_INLINE PackMask operator>(Pack a, Pack b) { return {hn::Gt(a.v, b.v)}; }
HWY_INLINE PackMask operator<(Pack a, Pack b) { return {hn::Lt(a.v, b.v)}; }

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

/// The way back: six columns as rows of six doubles, one a lane.
template <int n = lanes>  // n: so that only the branch for this width is compiled
class Rows {
 public:
  HWY_INLINE explicit Rows(const SixPacks& of) {
    const Lanes d;
    const auto ab_even = hn::InterleaveLower(d, of.a.v, of.b.v), ab_odd = hn::InterleaveUpper(d, of.a.v, of.b.v);
    const auto cd_even = hn::InterleaveLower(d, of.c.v, of.d.v), cd_odd = hn::InterleaveUpper(d, of.c.v, of.d.v);
    const auto ef_even = hn::InterleaveLower(d, of.e.v, of.f.v), ef_odd = hn::InterleaveUpper(d, of.e.v, of.f.v);
    if constexpr (n == 8) {
      const auto zero = hn::Zero(d);
      const auto put = [&](int k, Vector abcd, Vector ef) HWY_ATTR {
        front_[k] = hn::ConcatLowerLower(d, ef, abcd);
        front_[k + 4] = hn::ConcatUpperUpper(d, ef, abcd);
      };
      put(0, hn::OddEvenBlocks(hn::SwapAdjacentBlocks(cd_even), ab_even), hn::OddEvenBlocks(zero, ef_even));
      put(1, hn::OddEvenBlocks(hn::SwapAdjacentBlocks(cd_odd), ab_odd), hn::OddEvenBlocks(zero, ef_odd));
      put(2, hn::OddEvenBlocks(cd_even, hn::SwapAdjacentBlocks(ab_even)),
          hn::OddEvenBlocks(zero, hn::SwapAdjacentBlocks(ef_even)));
      put(3, hn::OddEvenBlocks(cd_odd, hn::SwapAdjacentBlocks(ab_odd)),
          hn::OddEvenBlocks(zero, hn::SwapAdjacentBlocks(ef_odd)));
    } else if constexpr (n == 4) {
      const auto put = [&](int k, Vector abcd, Vector ef) HWY_ATTR { front_[k] = abcd, back_[k] = ef; };
      put(0, hn::ConcatLowerLower(d, cd_even, ab_even), ef_even);
      put(1, hn::ConcatLowerLower(d, cd_odd, ab_odd), ef_odd);
      put(2, hn::ConcatUpperUpper(d, cd_even, ab_even), hn::ConcatUpperUpper(d, ef_even, ef_even));
      put(3, hn::ConcatUpperUpper(d, cd_odd, ab_odd), hn::ConcatUpperUpper(d, ef_odd, ef_odd));
    } else {
      front_[0] = ab_even, middle_[0] = cd_even, back_[0] = ef_even;
      front_[1] = ab_odd, middle_[1] = cd_odd, back_[1] = ef_odd;
    }
  }

  /// Adds row k to the first six of the eight doubles at `sum`, which are aligned to 64 bytes. The other two stay what
  /// they are.
  HWY_INLINE void add(int k, double* sum) const {
    const Lanes d;
    add_to(d, sum, front_[k]);
    if constexpr (n == 4) {
      const hn::Half<Lanes> half;
      add_to(half, sum + 4, hn::LowerHalf(half, back_[k]));
    } else if constexpr (n == 2) {
      add_to(d, sum + 2, middle_[k]);
      add_to(d, sum + 4, back_[k]);
    }
  }

 private:
  Vector front_[n], middle_[n == 2 ? n : 1], back_[n == 8 ? 1 : n];
};

/// Adds what the contacts of a pack do to both of their grains, contact after contact: the same order, so the same
/// bits, for every width.
template <class FirstAt, class SecondAt>
HWY_INLINE void add_rows(const SixPacks& on_first, const FirstAt& first, const SixPacks& on_second,
                         const SecondAt& second) {
  const Rows of_first(on_first), of_second(on_second);
  for (int k = 0; k < lanes; ++k) {
    of_first.add(k, first(k));
    of_second.add(k, second(k));
  }
}

}  // namespace soilbin::dem::HWY_NAMESPACE
