#include "bekker_wong/reference_wheel.hpp"

#include <algorithm>
#include <boost/math/quadrature/tanh_sinh.hpp>
#include <boost/math/tools/roots.hpp>
#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>
#include <vector>

namespace soilbin::reference {

struct Wheel::Point {
  Real sigma, tau_x, tau_y;
};

Wheel::Wheel(const Tire& tire, const bekker_wong::SoilValues& soil, const OperatingCondition& at)
    : r_(tire.radius),
      b_(tire.width),
      k_(Real(soil.k_c) / b_ + Real(soil.k_phi)),
      n_(soil.exponent),
      cohesion_(soil.cohesion),
      friction_(std::tan(Real(soil.friction_angle))),
      shear_modulus_(soil.shear_modulus),
      load_(at.load),
      yaw_(at.yaw),
      incline_(at.longitudinal_incline),
      cross_slope_(at.transverse_incline) {
  const Real s = at.slip;
  const bool sideways = std::abs(at.yaw) > (1 - 1e-12) * std::numbers::pi / 2;
  const Real cosine = sideways ? 0 : std::cos(yaw_), sine = std::sin(yaw_);
  Real plane_slip = s;
  if (s == -1) {
    locked_ = true;
    rate_x_ = cosine, rate_y_ = sine;
  } else {
    const Real rate = s >= 0 ? 1 - s : 1 / (1 + s);
    const bool by_plane = at.slip_by == SlipBy::wheel_plane_speed;
    rate_x_ = by_plane ? rate : rate * cosine;
    rate_y_ = by_plane ? rate * std::tan(yaw_) : rate * sine;
    if (!by_plane) plane_slip = rate_x_ <= 1 ? 1 - rate_x_ : 1 / rate_x_ - 1;
  }
  theta_m_share_ = std::clamp<Real>(soil.c1 + soil.c2 * std::abs(plane_slip), 0, 0.98L);
}

/// j_x/r = (theta_1 - theta) - v_x/(r w) (sin theta_1 - sin theta), the difference of sines as a product.
Real Wheel::displacement_x(Real since_entry, Real theta_1) const {
  const Real sine_drop = 2 * std::cos(theta_1 - since_entry / 2) * std::sin(since_entry / 2);
  return (locked_ ? 0 : since_entry) - rate_x_ * sine_drop;
}

/// Distance from entry at which a braked wheel's j_x turns negative, by bisection; 0: nowhere.
Real Wheel::reversal(Real theta_1) const {
  if (locked_ || rate_x_ * std::cos(theta_1) >= 1 || displacement_x(theta_1, theta_1) >= 0) return 0;
  Real positive = 0, negative = theta_1;
  while (negative - positive > std::numeric_limits<Real>::epsilon() * negative) {
    const Real middle = (positive + negative) / 2;
    if (middle == positive || middle == negative) break;
    (displacement_x(middle, theta_1) > 0 ? positive : negative) = middle;
  }
  return negative;
}

Wheel::Point Wheel::stress(Real theta, Real since_entry, Real since_exit, Real theta_1) const {
  const Real theta_m = theta_m_share_ * theta_1;
  // rear: theta_1 - theta_e, by the conventions' mapping of theta onto the front
  const Real from_entry = theta > theta_m ? since_entry : since_exit / theta_m * (theta_1 - theta_m);
  const Real depth = 2 * r_ * std::sin(theta_1 - from_entry / 2) * std::sin(from_entry / 2);
  Point p{};
  p.sigma = k_ * std::pow(depth, n_);
  const Real j_x = r_ * displacement_x(since_entry, theta_1), j_y = r_ * rate_y_ * since_entry;
  const Real j = std::hypot(j_x, j_y);
  if (j == 0) return p;
  const Real mobilised = locked_ ? 1 : -std::expm1(-j / shear_modulus_);
  const Real tau = (cohesion_ + p.sigma * friction_) * mobilised;
  p.tau_x = tau * j_x / j, p.tau_y = tau * j_y / j;
  return p;
}

Real Wheel::integrate(Real theta_1, Real rel_tol, const auto& integrand) const {
  // Boost 1.83 throws where the integrand grows at an end that rounding has cut off, however little that end weighs.
  namespace policies = boost::math::policies;
  using Quiet = policies::policy<policies::evaluation_error<policies::ignore_error>>;
  thread_local boost::math::quadrature::tanh_sinh<Real, Quiet> rule(12);
  std::vector<Real> cuts{0, theta_1};  // theta_m: kink of sigma; the reversal: kink of |j|
  if (theta_m_share_ > 0) cuts.push_back(theta_m_share_ * theta_1);
  if (const Real x = reversal(theta_1); x > 0) cuts.push_back(theta_1 - x);
  std::ranges::sort(cuts);
  Real sum = 0;
  for (std::size_t i = 0; i + 1 < cuts.size(); ++i) {
    const Real low = cuts[i], high = cuts[i + 1];
    if (!(high > low)) continue;
    sum += rule.integrate(
        [&](Real theta, Real to_end) {  // to_end: low - theta or high - theta, without cancellation
          const Real since_exit = to_end < 0 && low == 0 ? -to_end : theta;
          const Real since_entry = to_end > 0 && high == theta_1 ? to_end : theta_1 - theta;
          return integrand(theta, stress(theta, since_entry, since_exit, theta_1));
        },
        low, high, rel_tol);
  }
  return sum;
}

Real Wheel::carried(Real theta_1, Real rel_tol) const {
  return r_ * b_ * integrate(theta_1, rel_tol, [](Real t, const Point& p) {
           return p.sigma * std::cos(t) + p.tau_x * std::sin(t);
         });
}

Forces Wheel::at(Real theta_1, Real rel_tol) const {
  const auto times_rb = [&](auto f) { return r_ * b_ * integrate(theta_1, rel_tol, f); };
  Forces f;
  f.vertical = carried(theta_1, rel_tol);
  f.forward = times_rb([](Real t, const Point& p) { return p.tau_x * std::cos(t) - p.sigma * std::sin(t); });
  f.side = times_rb([](Real, const Point& p) { return p.tau_y; });
  f.torque = r_ * times_rb([](Real, const Point& p) { return p.tau_x; });
  f.gross_force = times_rb([](Real t, const Point& p) {
    return p.sigma * std::sin(t) + std::abs(p.tau_x) * std::cos(t) + std::abs(p.tau_y);
  });
  f.gross_torque = r_ * times_rb([](Real, const Point& p) { return std::abs(p.tau_x); });
  return f;
}

Real Wheel::growth(Real theta_1) const {
  const Real h = 1e-4L;
  return (carried(theta_1 * (1 + h)) - carried(theta_1 * (1 - h))) / (2 * h * carried(theta_1));
}

Real Wheel::entry_angle(Real normal_load, Real deepest) const {
  const auto excess = [&](Real t) { return carried(t) / normal_load - 1; };
  Real lower = 0;
  const Real stride = locked_ || rate_x_ > 1 ? 1.03L : 1.15L;  // a braked wheel's load may rise, fall and rise again
  for (Real upper = 1e-2L; lower < deepest; lower = upper, upper = std::min(stride * upper, deepest)) {
    if (carried(upper, 1e-6L) < normal_load) continue;
    if (lower == 0) return 0;
    // the scan's looser quadrature may have misjudged a bracket's end: open it a little
    lower *= 1 - 1e-4L, upper = std::min(upper * (1 + 1e-4L), deepest);
    std::uintmax_t iterations = 200;
    const auto [a, b] = boost::math::tools::toms748_solve(excess, lower, upper,
                                                          boost::math::tools::eps_tolerance<Real>(60), iterations);
    return (a + b) / 2;
  }
  return 0;
}

Answer Wheel::roll() const {
  const Real normal_load = load_ * std::cos(incline_) * std::cos(cross_slope_);
  const Real theta_1 = entry_angle(normal_load, std::acos(0.1L));
  if (theta_1 == 0) throw std::runtime_error("the reference wheel finds no balance");
  const Forces f = at(theta_1);
  const Real c = std::cos(yaw_), s = std::sin(yaw_);
  Answer a;
  a.theta_1 = theta_1;
  a.sinkage = 2 * r_ * std::pow(std::sin(theta_1 / 2), 2);
  a.drawbar_pull = f.forward * c - f.side * s - load_ * std::sin(incline_);
  a.lateral_force = f.forward * s + f.side * c - load_ * std::cos(incline_) * std::sin(cross_slope_);
  a.torque = f.torque;
  a.force_scale = f.gross_force, a.torque_scale = f.gross_torque;
  return a;
}

}  // namespace soilbin::reference
