// Built with -ffp-contract=off, without errno and floating-point traps (CMakeLists.txt): nothing that changes a value.
#include "bekker_wong/node_functions.hpp"

#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>

// One copy for any x86-64, one for AVX2, one for AVX-512, picked when the program starts.
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__) && !defined(__SANITIZE_ADDRESS__) && \
    !defined(__SANITIZE_THREAD__)
#define SOILBIN_WIDE [[gnu::target_clones("default", "avx2", "avx512f")]]
#else
#define SOILBIN_WIDE
#endif
#define SOILBIN_INLINE [[gnu::always_inline]] inline

namespace soilbin::bekker_wong {
namespace {

/// c[0] + c[1] x + c[2] x^2 + ..., as four interleaved sums in x^4: the processor works on all four at once, where one
/// sum would wait for each of its own steps.
template <std::size_t N>
SOILBIN_INLINE double polynomial(double x, const double (&c)[N]) {
  const double x2 = x * x, x4 = x2 * x2;
  constexpr std::size_t last = (N - 1) / 4 * 4;
  double sum[4] = {};
  for (std::size_t k = 0; k < 4; ++k) sum[k] = last + k < N ? c[last + k] : 0.0;
  for (std::size_t i = last; i >= 4; i -= 4)
    for (std::size_t k = 0; k < 4; ++k) sum[k] = sum[k] * x4 + c[i - 4 + k];
  return (sum[0] + sum[1] * x) + x2 * (sum[2] + sum[3] * x);
}

constexpr double factorial(int n) { return n < 2 ? 1.0 : n * factorial(n - 1); }

// Taylor series suffice: at |x| = 1.6 the first term left out is below 5e-17.
constexpr double sine_terms[] = {1.0,
                                 -1 / factorial(3),
                                 1 / factorial(5),
                                 -1 / factorial(7),
                                 1 / factorial(9),
                                 -1 / factorial(11),
                                 1 / factorial(13),
                                 -1 / factorial(15),
                                 1 / factorial(17),
                                 -1 / factorial(19),
                                 1 / factorial(21)};
constexpr double cosine_terms[] = {1.0,
                                   -1 / factorial(2),
                                   1 / factorial(4),
                                   -1 / factorial(6),
                                   1 / factorial(8),
                                   -1 / factorial(10),
                                   1 / factorial(12),
                                   -1 / factorial(14),
                                   1 / factorial(16),
                                   -1 / factorial(18),
                                   1 / factorial(20),
                                   -1 / factorial(22)};
// (e^r - 1)/r, |r| <= ln(2)/2
constexpr double exponential_terms[] = {1.0,
                                        1 / factorial(2),
                                        1 / factorial(3),
                                        1 / factorial(4),
                                        1 / factorial(5),
                                        1 / factorial(6),
                                        1 / factorial(7),
                                        1 / factorial(8),
                                        1 / factorial(9),
                                        1 / factorial(10),
                                        1 / factorial(11),
                                        1 / factorial(12),
                                        1 / factorial(13)};
// (atanh(s)/s - 1)/s^2 in s^2, |s| <= 0.172
constexpr double inverse_tangent_terms[] = {1.0 / 3,  1.0 / 5,  1.0 / 7,  1.0 / 9,  1.0 / 11,
                                            1.0 / 13, 1.0 / 15, 1.0 / 17, 1.0 / 19, 1.0 / 21};

constexpr double ln2 = 0.6931471805599453094;
constexpr double ln2_high = 6.93147180369123816490e-01;  // 33 bits: k * ln2_high is exact
constexpr double ln2_low = 1.90821492927058770002e-10;
constexpr double whole = 0x1.8p52;  // x + whole - whole rounds x to an integer

/// 2^k as a factor, k a whole number in -1022 .. 1023.
SOILBIN_INLINE double two_to(double k) {
  const auto biased = std::bit_cast<std::uint64_t>(k + (whole + 1023));
  return std::bit_cast<double>(biased << 52);
}

struct Exponential {
  double two_k;  ///< 2^k
  double rest;   ///< e^r - 1
};

/// e^x = two_k (1 + rest), for -708 <= x <= 708.
SOILBIN_INLINE Exponential exponential(double x) {
  const double k = (x * (1 / ln2) + whole) - whole;
  const double r = (x - k * ln2_high) - k * ln2_low;
  return {two_to(k), r * polynomial(r, exponential_terms)};
}

/// ln(x) of a normal x > 0: x = 2^k m with m in sqrt(1/2) .. sqrt(2), ln(m) = 2 atanh((m - 1)/(m + 1)).
SOILBIN_INLINE double logarithm(double x) {
  constexpr std::uint64_t one = 0x3ff0000000000000, root_half = 0x3fe6a09e667f3bcd;
  const std::uint64_t bits = std::bit_cast<std::uint64_t>(x);
  const std::uint64_t power = (bits + (one - root_half)) >> 52;  // k + 1023
  const double k = std::bit_cast<double>(power | 0x4330000000000000) - (0x1p52 + 1023);
  const double m = std::bit_cast<double>(bits - (power << 52) + one);
  const double s = (m - 1) / (m + 1), s2 = s * s;
  return k * ln2_high + (2 * s + (2 * s * s2 * polynomial(s2, inverse_tangent_terms) + k * ln2_low));
}

SOILBIN_INLINE double within(double x, double low, double high) { return x < low ? low : x > high ? high : x; }

}  // namespace

SOILBIN_WIDE void half_angle(std::span<const double> angle, std::span<double> sine, std::span<double> cosine) {
  const std::size_t count = angle.size();
  const double* const a = angle.data();
  double *const s = sine.data(), *const c = cosine.data();
#pragma GCC ivdep
  for (std::size_t i = 0; i < count; ++i) {
    const double x = 0.5 * a[i], x2 = x * x;
    s[i] = x * polynomial(x2, sine_terms);
    c[i] = polynomial(x2, cosine_terms);
  }
}

SOILBIN_WIDE void scaled_power(std::span<const double> base, double exponent, double scale, std::span<double> out) {
  const std::size_t count = base.size();
  const double* const b = base.data();
  double* const o = out.data();
#pragma GCC ivdep
  for (std::size_t i = 0; i < count; ++i) {
    const double x = b[i];
    const Exponential e = exponential(within(exponent * logarithm(x), -708.0, 708.0));
    const double power = scale * e.two_k * (1 + e.rest) + (x - x);  // x - x: NaN for NaN and infinity
    o[i] = x <= 0.0 ? 0.0 : power;
  }
}

SOILBIN_WIDE void mobilised_share(std::span<const double> displacement, std::span<const double> modulus,
                                  std::span<double> out) {
  const std::size_t count = displacement.size();
  const double *const j = displacement.data(), *const k = modulus.data();
  double* const o = out.data();
#pragma GCC ivdep
  for (std::size_t i = 0; i < count; ++i) {
    const double ratio = j[i] / k[i];
    const Exponential e = exponential(within(-ratio, -700.0, 0.0));
    o[i] = (1 - e.two_k) - e.two_k * e.rest;
  }
}

SOILBIN_WIDE void length(std::span<const double> x, std::span<const double> y, std::span<double> out) {
  const std::size_t count = x.size();
  const double *const a = x.data(), *const b = y.data();
  double* const o = out.data();
#pragma GCC ivdep
  for (std::size_t i = 0; i < count; ++i) o[i] = std::sqrt(a[i] * a[i] + b[i] * b[i]);
}

}  // namespace soilbin::bekker_wong
