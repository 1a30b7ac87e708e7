#include "bekker_wong/contact_stages.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <mutex>

#include "bekker_wong/gsl.hpp"

namespace soilbin::bekker_wong {
namespace {

constexpr double max_stress_share = 0.98;  // of theta_1, conventions.md

/// Where a segment's ends are singular, so that its nodes crowd there.
enum Crowd { nowhere = 0, at_start = 1, at_end = 2, at_both = 3 };

/// A rule on [0, 1] whose nodes crowd toward an end as t^4: an integrand x^n becomes t^(4n+3), smooth enough for
/// Gauss-Legendre even at n = 0.1. Distances from both ends are kept so that neither is lost to cancellation.
struct CrowdedRule {
  std::array<double, 64> from_start, from_end, weight;
};

void build(CrowdedRule& rule, int n, Crowd crowd) {
  const gsl::LegendreRule gauss = gsl::legendre_rule(n);
  const auto quartic = [](double t) { return t * t * t * t; };
  // 35 t^4 - 84 t^5 + 70 t^6 - 20 t^7: t^4 at both ends; derivative 140 t^3 (1 - t)^3
  const auto both = [&](double t) { return quartic(t) * (35 + t * (-84 + t * (70 - 20 * t))); };
  for (int i = 0; i < n; ++i) {
    const auto k = static_cast<std::size_t>(i);
    const double t = gauss.nodes[k], u = 1.0 - t, w = gauss.weights[k];
    switch (crowd) {
      case nowhere: rule.from_start[k] = t, rule.from_end[k] = u, rule.weight[k] = w; break;
      case at_start:
        rule.from_start[k] = quartic(t), rule.from_end[k] = 1.0 - quartic(t), rule.weight[k] = 4 * t * t * t * w;
        break;
      case at_end:
        rule.from_start[k] = 1.0 - quartic(u), rule.from_end[k] = quartic(u), rule.weight[k] = 4 * u * u * u * w;
        break;
      case at_both:
        rule.from_start[k] = both(t), rule.from_end[k] = both(u), rule.weight[k] = 140 * std::pow(t * u, 3) * w;
        break;
    }
  }
}

const CrowdedRule& crowded_rule(int n, Crowd crowd) {
  struct Stored {
    std::once_flag once;
    CrowdedRule rule;
  };
  static std::array<std::array<Stored, 4>, 65> stored;
  Stored& s = stored[static_cast<std::size_t>(n)][crowd];
  std::call_once(s.once, [&] { build(s.rule, n, crowd); });
  return s.rule;
}

/// theta_1 - theta where a braked wheel's j_x changes sign, or 0 where it doesn't: root of x = rho (sin theta_1 -
/// sin(theta_1 - x)) with rho = v_x/(r w) > 1. The function is concave with value 0 at x = 0, so it has one root at most.
double sign_change(double theta_1, double extent, double rho) {
  if (rho * std::cos(theta_1) >= 1.0) return 0.0;
  const auto f = [&](double x) { return x - rho * (std::sin(theta_1) - std::sin(theta_1 - x)); };
  if (f(extent) >= 0.0) return 0.0;
  double x = extent;
  for (int i = 0; i < 60; ++i) {  // Newton from the right on a concave function falls monotonically to the root
    const double step = f(x) / (1.0 - rho * std::cos(theta_1 - x));
    x -= step;
    if (std::abs(step) <= 1e-15 * x) break;
  }
  return x;
}

struct Segment {
  double high, low;  // angles
  Crowd crowd;
};

/// cos(theta_1 - x) - cos(theta_1) without cancellation, from sin x and 1 - cos x.
double cosine_rise(double sine_1, double cosine_1, double sine_x, double versine_x) {
  return sine_1 * sine_x - cosine_1 * versine_x;
}

void add_segment(ContactPatch& p, const Segment& segment, bool front, const Outline& outline, int nodes) {
  const CrowdedRule& rule = crowded_rule(nodes, segment.crowd);
  const double length = segment.high - segment.low;
  const double before = p.angles.entry - segment.high, after = segment.low - p.angles.exit;
  const double sine_1 = std::sin(p.angles.entry), cosine_1 = std::cos(p.angles.entry);
  const double mirror =
      front ? 0.0 : (p.angles.entry - p.angles.max_stress) / (p.angles.max_stress - p.angles.exit);
  const int first = p.count;
  p.count += nodes;
  for (int k = 0; k < nodes; ++k) {
    const auto i = static_cast<std::size_t>(first + k), q = static_cast<std::size_t>(k);
    const double x = before + length * rule.from_start[q];
    const double sh = std::sin(0.5 * x), ch = std::cos(0.5 * x);
    const double sine_x = 2 * sh * ch, versine_x = 2 * sh * sh;
    p.since_entry[i] = x;
    p.theta[i] = p.angles.entry - x;
    p.sine_drop[i] = sine_1 * versine_x + cosine_1 * sine_x;
    p.normal_sine[i] = sine_1 - p.sine_drop[i];
    const double rise = cosine_rise(sine_1, cosine_1, sine_x, versine_x);
    p.normal_cosine[i] = cosine_1 + rise;
    p.arc[i] = outline.radius * length * rule.weight[q];
    p.arm[i] = outline.shear_radius;
    p.depth[i] = outline.radius * rise;
    if (!front) {
      const double x_e = mirror * (after + length * rule.from_end[q]);
      const double she = std::sin(0.5 * x_e), che = std::cos(0.5 * x_e);
      p.depth[i] = outline.radius * cosine_rise(sine_1, cosine_1, 2 * she * che, 2 * she * she);
    }
  }
}

}  // namespace

ContactAngles base_angles(double theta_1, const SoilValues& soil, const Kinematics& motion) {
  const double share = std::clamp(soil.c1 + soil.c2 * std::abs(motion.slip), 0.0, max_stress_share);
  return {.entry = theta_1, .max_stress = share * theta_1, .exit = 0.0};
}

int nodes_per_segment(const SoilValues& soil, const Outline& outline, const Kinematics& motion) {
  const double stiffness = outline.shear_radius / soil.shear_modulus;
  int nodes = stiffness < 10 ? 16 : stiffness < 50 ? 20 : stiffness < 200 ? 24 : stiffness < 1000 ? 32 : 48;
  if (motion.slip < 0.0 && !motion.locked) nodes += 16;
  return std::min(nodes, 64);
}

void fill_geometry(ContactPatch& patch, const ContactAngles& angles, const Outline& outline, const Kinematics& motion,
                   int nodes) {
  patch.count = 0;
  patch.angles = angles;
  patch.deflection = 0.0;
  double split = angles.exit - 1.0;  // out of reach
  if (motion.forward > 1.0 && !motion.locked) {
    const double x = sign_change(angles.entry, angles.entry - angles.exit, motion.forward);
    if (x > 0.0) split = angles.entry - x;
  }
  const auto lay = [&](double high, double low, Crowd crowd, bool front) {
    if (!(high > low)) return;
    if (split < high && split > low) {
      add_segment(patch, {high, split, Crowd(at_end | (crowd & at_start))}, front, outline, nodes);
      add_segment(patch, {split, low, Crowd(at_start | (crowd & at_end))}, front, outline, nodes);
    } else {
      add_segment(patch, {high, low, crowd}, front, outline, nodes);
    }
  };
  lay(angles.entry, angles.max_stress, at_start, true);
  lay(angles.max_stress, angles.exit, at_end, false);
}

void fill_pressure(ContactPatch& p, const SoilValues& soil, const Outline& outline) {
  const double modulus = soil.pressure_modulus(outline.width);
  for (int i = 0; i < p.count; ++i) p.sigma[i] = modulus * std::pow(p.depth[i], soil.exponent);
}

void fill_displacement(ContactPatch& p, const Outline& outline, const Kinematics& motion) {
  const double r = outline.shear_radius;
  const double turning = motion.locked ? 0.0 : r;
  const double forward = r * motion.forward, lateral = r * motion.lateral;
  for (int i = 0; i < p.count; ++i) {
    p.j_x[i] = turning * p.since_entry[i] - forward * p.sine_drop[i];
    p.j_y[i] = lateral * p.since_entry[i];
  }
}

void fill_strength(ContactPatch& p, const SoilValues& soil) {
  const double friction = std::tan(soil.friction_angle);
  for (int i = 0; i < p.count; ++i) {
    p.strength[i] = soil.cohesion + p.sigma[i] * friction;
    p.modulus[i] = soil.shear_modulus;
  }
}

void fill_mobilised(ContactPatch& p, ContactPatch::Array& j, const Kinematics& motion) {
  for (int i = 0; i < p.count; ++i) j[i] = std::sqrt(p.j_x[i] * p.j_x[i] + p.j_y[i] * p.j_y[i]);
  if (motion.locked) {
    for (int i = 0; i < p.count; ++i) p.mobilised[i] = 1.0;
  } else {
    for (int i = 0; i < p.count; ++i) p.mobilised[i] = 1.0 - std::exp(-j[i] / p.modulus[i]);
  }
}

void fill_shear(ContactPatch& p, const ContactPatch::Array& j) {
  for (int i = 0; i < p.count; ++i) {
    const double per_j = j[i] > 0.0 ? p.strength[i] * p.mobilised[i] / j[i] : 0.0;
    p.tau_x[i] = per_j * p.j_x[i];
    p.tau_y[i] = per_j * p.j_y[i];
  }
}

}  // namespace soilbin::bekker_wong
