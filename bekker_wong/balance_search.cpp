#include "bekker_wong/balance_search.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace soilbin::bekker_wong {

using gsl::Sample;

namespace {

constexpr double longest_step = 1.0;  // of the secant method, in ln(theta_1)
constexpr double flattest = 0.02;     // slope below which the secant method is no safe guide
constexpr double scan_step = 0.05;
constexpr double lowest = -40.0;

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
    if ((low.x -= 2.0) < lowest) return {{}, low};
  const auto root_between = [&](double a, double b) {
    return FirstRoot{gsl::bracketed_root(f, a, b, 1e-15, 1e-14, "the balance of the load"), {}};
  };
  FirstRoot none{{}, low};
  const auto note = [&](const Sample& at) {
    if (at.f > none.highest.f) none.highest = at;
  };
  while (low.x < upper) {
    const double x = std::min(low.x + scan_step, upper);
    const Sample high{x, f(x)};
    if (high.f >= 0.0) return root_between(low.x, high.x);
    note(high);
    if (low.f >= high.f && low.f > before.f && std::isfinite(before.x)) {  // low is the highest of three: a hump
      const Sample top = gsl::bracketed_maximum(f, {before, low, high}, 1e-9, 0.0, "the balance of the load");
      note(top);
      if (top.f >= 0.0) return root_between(before.x, top.x);
    }
    before = low, low = high;
  }
  return none;
}

Sample climb(gsl::FunctionRef f, double about, double upper) {
  constexpr double first_step = 0.02, growth = 2.0, known_to = 1e-5;
  const auto at = [&](double x) { return Sample{std::min(x, upper), f(std::min(x, upper))}; };
  const auto top = [&](const Sample& a, const Sample& middle, const Sample& b) {
    const auto [left, right] = std::minmax(a, b, [](const Sample& l, const Sample& r) { return l.x < r.x; });
    return gsl::bracketed_maximum(f, {left, middle, right}, known_to, 0.0, "the most that the soil carries");
  };
  double step = first_step;
  Sample behind = at(about), here = at(behind.x + step);
  if (here.x == behind.x) behind = at(upper - step);
  if (!(here.f > behind.f)) std::swap(behind, here), step = -step;
  while (here.f < 0.0 && here.x > lowest && !(step > 0.0 && here.x == upper)) {
    const Sample next = at(here.x + step);
    if (!(next.f > here.f)) return top(behind, here, next);
    behind = here, here = next, step *= growth;
  }
  if (here.f >= 0.0 || here.x < upper) return here;
  const Sample inside = at(upper - 10 * known_to);  // the upper end is a top only where f rises up to it
  return inside.f > here.f ? top(behind, inside, here) : here;
}

}  // namespace soilbin::bekker_wong
