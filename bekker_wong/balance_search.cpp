#include "bekker_wong/balance_search.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace soilbin::bekker_wong {
namespace {

constexpr double longest_step = 1.0;  // of the secant method, in ln(theta_1)
constexpr double flattest = 0.02;     // slope below which the secant method is no safe guide
constexpr double scan_step = 0.05;
constexpr double lowest = -40.0;

struct Sample {
  double x, f;
};

/// Highest point of f between two samples either side of a higher one, by golden section; stops where f > 0.
Sample top_of_hump(gsl::FunctionRef f, double low, double high) {
  constexpr double golden = 0.6180339887498949;
  const auto sample = [&](double x) { return Sample{x, f(x)}; };
  Sample a = sample(high - golden * (high - low)), b = sample(low + golden * (high - low));
  while (std::max(a.f, b.f) < 0.0 && high - low > 1e-9) {
    if (a.f > b.f) {
      high = b.x, b = a, a = sample(high - golden * (high - low));
    } else {
      low = a.x, a = b, b = sample(low + golden * (high - low));
    }
  }
  return a.f > b.f ? a : b;
}

}  // namespace

std::optional<RisingRoot> rising_root(gsl::FunctionRef f, double start, double slope, double upper, double tolerance) {
  constexpr int most_calls = 12;
  double x = std::min(start, upper), value = f(x);
  for (int call = 1; call < most_calls; ++call) {
    if (std::abs(value) <= tolerance) return RisingRoot{x, slope};
    const double step = std::clamp(-value / slope, -longest_step, longest_step);
    const double next = std::min(x + step, upper);
    if (next == x || !std::isfinite(next)) return {};
    const double next_value = f(next);
    slope = (next_value - value) / (next - x);
    x = next, value = next_value;
    if (!(slope > flattest)) break;
  }
  if (std::abs(value) <= tolerance) return RisingRoot{x, slope};
  return {};
}

FirstRoot first_rising_root(gsl::FunctionRef f, double upper) {
  Sample before{-std::numeric_limits<double>::infinity(), 0.0}, low{std::min(upper - scan_step, -7.0), 0.0};
  for (low.f = f(low.x); low.f >= 0.0; low.f = f(low.x))
    if ((low.x -= 2.0) < lowest) return {{}, low.f};
  const auto root_between = [&](double a, double b) {
    return FirstRoot{gsl::bracketed_root(f, a, b, 1e-15, 1e-14, "the balance of the load"), 0.0};
  };
  FirstRoot none{{}, low.f};
  while (low.x < upper) {
    const double x = std::min(low.x + scan_step, upper);
    const Sample high{x, f(x)};
    if (high.f >= 0.0) return root_between(low.x, high.x);
    none.highest = std::max(none.highest, high.f);
    if (low.f >= high.f && low.f > before.f && std::isfinite(before.x)) {  // low is the highest of three: a hump
      const Sample top = top_of_hump(f, before.x, high.x);
      none.highest = std::max(none.highest, top.f);
      if (top.f >= 0.0) return root_between(before.x, top.x);
    }
    before = low, low = high;
  }
  return none;
}

}  // namespace soilbin::bekker_wong
