#include "bekker_wong/contact_stages.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <mutex>

#include "bekker_wong/gsl.hpp"
#include "bekker_wong/node_functions.hpp"

namespace soilbin::bekker_wong {
namespace {

/// Where a segment's ends are singular, so that its nodes crowd there.
enum Crowd { nowhere = 0, at_start = 1, at_end = 2, at_both = 3 };

constexpr int most_nodes = 64;

/// A rule on [0, 1] whose nodes crowd toward an end as t^p: an integrand x^n becomes t^(p (n + 1) - 1), smooth enough
/// for Gauss-Legendre even at n = 0.1. Distances from both ends are kept so that neither is lost to cancellation.
struct CrowdedRule {
  std::array<double, most_nodes> from_start, from_end, weight;
};

double power(double t, int p) { return p == 0 ? 1.0 : t * power(t, p - 1); }

/// t^p at both ends, p = 3 or 4: the incomplete beta function of (p, p), and its derivative.
double crowd_both(double t, int p) {
  return p == 3 ? power(t, 3) * (10 + t * (-15 + t * 6)) : power(t, 4) * (35 + t * (-84 + t * (70 - 20 * t)));
}
double crowd_both_slope(double t, double u, int p) { return p == 3 ? 30 * power(t * u, 2) : 140 * power(t * u, 3); }

void build(CrowdedRule& rule, int n, int p, Crowd crowd) {
  const gsl::LegendreRule gauss = gsl::legendre_rule(n);
  for (int i = 0; i < n; ++i) {
    const auto k = static_cast<std::size_t>(i);
    const double t = gauss.nodes[k], u = gauss.nodes[static_cast<std::size_t>(n - 1 - i)];  // u = 1 - t
    double start = t, end = u, slope = 1.0;
    switch (crowd) {
      case nowhere:
        break;
      case at_start:
        start = power(t, p), end = 1.0 - start, slope = p * power(t, p - 1);
        break;
      case at_end:
        end = power(u, p), start = 1.0 - end, slope = p * power(u, p - 1);
        break;
      case at_both:
        start = crowd_both(t, p), end = crowd_both(u, p), slope = crowd_both_slope(t, u, p);
        break;
    }
    rule.from_start[k] = start, rule.from_end[k] = end, rule.weight[k] = slope * gauss.weights[k];
  }
}

const CrowdedRule& crowded_rule(const NodeLayout& layout, Crowd crowd) {
  struct Stored {
    std::once_flag once;
    CrowdedRule rule;
  };
  static std::array<std::array<std::array<Stored, 4>, 2>, most_nodes + 1> stored;
  Stored& s = stored[static_cast<std::size_t>(layout.per_segment)][layout.crowding == 3 ? 0 : 1][crowd];
  std::call_once(s.once, [&] { build(s.rule, layout.per_segment, layout.crowding, crowd); });
  return s.rule;
}

/// theta_1 - theta where a braked wheel's j_x changes sign, or 0 where it doesn't: root of x = rho (sin theta_1 -
/// sin(theta_1 - x)) with rho = v_x/(r w) > 1. The function is concave with value 0 at x = 0, so it has one root at
/// most.
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

/// Distances from theta_2 to those from theta_1 at which the pressure law sees nodes behind theta_m.
double mirror_ratio(const ContactAngles& a) { return (a.entry - a.max_stress) / (a.max_stress - a.exit); }

/// Distances from entry, weights, and into `depth` the distance from entry at which the pressure law looks: the node's
/// own in front, its mirror angle's behind theta_m.
void add_segment(ContactPatch& p, const Segment& segment, bool front, const Outline& outline,
                 const NodeLayout& layout) {
  const CrowdedRule& rule = crowded_rule(layout, segment.crowd);
  const double length = segment.high - segment.low;
  const double before = p.angles.entry - segment.high, after = segment.low - p.angles.exit;
  const double mirror = front ? 0.0 : mirror_ratio(p.angles);
  double *const x = &p.since_entry[p.count], *const seen = &p.depth[p.count], *const arc = &p.arc[p.count];
  for (int k = 0; k < layout.per_segment; ++k) {
    const auto q = static_cast<std::size_t>(k);
    x[k] = before + length * rule.from_start[q];
    arc[k] = outline.radius * length * rule.weight[q];
    seen[k] = front ? x[k] : mirror * (after + length * rule.from_end[q]);
  }
  p.count += layout.per_segment;
}

/// Angles, normals, arms and depths from the distances that add_segment laid; first_rear: first node behind theta_m.
/// All from half angles, so that the depth cos(theta_1 - x) - cos(theta_1) loses nothing to cancellation.
void fill_trigonometry(ContactPatch& p, const Outline& outline, int first_rear) {
  const double sine_1 = std::sin(p.angles.entry), cosine_1 = std::cos(p.angles.entry), radius = outline.radius;
  ContactPatch::Array sine, cosine;
  const auto count = static_cast<std::size_t>(p.count), rear = static_cast<std::size_t>(first_rear);
  half_angle({p.since_entry.data(), count}, {sine.data(), count}, {cosine.data(), count});
  for (std::size_t i = 0; i < count; ++i) {
    const double s = sine[i], c = cosine[i];
    const double sine_drop = 2 * s * (sine_1 * s + cosine_1 * c), rise = 2 * s * (sine_1 * c - cosine_1 * s);
    p.theta[i] = p.angles.entry - p.since_entry[i];
    p.sine_drop[i] = sine_drop;
    p.normal_sine[i] = sine_1 - sine_drop;
    p.normal_cosine[i] = cosine_1 + rise;
    p.arm[i] = outline.shear_radius;
    sine[i] = rise;
  }
  for (std::size_t i = 0; i < rear; ++i) p.depth[i] = radius * sine[i];
  if (rear < count)
    half_angle({&p.depth[rear], count - rear}, {&sine[rear], count - rear}, {&cosine[rear], count - rear});
  for (std::size_t i = rear; i < count; ++i)
    p.depth[i] = radius * 2 * sine[i] * (sine_1 * cosine[i] - cosine_1 * sine[i]);
  std::copy_n(p.depth.begin(), count, p.circle_depth.begin());
}

/// v_x/(r w) and v_y/(r w) as the shear circle has them: of its own radius in place of r.
struct CircleMotion {
  double forward, lateral;
  CircleMotion(const Outline& outline, const Kinematics& motion)
      : forward(outline.slip_radius / outline.shear_radius * motion.forward),
        lateral(outline.slip_radius / outline.shear_radius * motion.lateral) {}
};

/// |j| at a distance x from entry [m], on the shear radius.
double displacement_at(double x, double entry, const Outline& outline, const CircleMotion& motion) {
  const double along = x - motion.forward * (std::sin(entry) - std::sin(entry - x));
  return outline.shear_radius * std::hypot(along, motion.lateral * x);
}

/// A braked wheel's shear displacement along the wheel may grow, turn and change sign. Past 45 deg of yaw that leaves
/// no trace in |j|, which the displacement across the wheel rules.
bool turns_back(const ContactAngles& angles, const CircleMotion& motion) {
  return motion.forward > 1.0 && motion.forward * std::cos(angles.entry) < 1.0 &&
         std::abs(motion.lateral) < motion.forward;
}

}  // namespace

ContactAngles base_angles(double theta_1, const SoilValues& soil, const Kinematics& motion) {
  const double share = std::clamp(soil.c1 + soil.c2 * std::abs(motion.slip), 0.0, max_stress_share);
  return {.entry = theta_1, .max_stress = share * theta_1, .exit = 0.0};
}

NodeLayout node_layout(const SoilValues& soil, const Outline& outline, const Kinematics& motion,
                       const ContactAngles& angles) {
  NodeLayout layout;
  layout.crowding = soil.exponent < 0.7 ? 4 : 3;
  double nodes = 10.0;
  if (soil.exponent < 0.3) nodes += 4;
  if (!(angles.max_stress > angles.exit)) nodes += 4;  // one segment where there are two elsewhere
  if (motion.locked) {
    if (motion.lateral != 0.0) nodes += 10;
  } else {
    const CircleMotion circle(outline, motion);
    const auto hardness = [&](double x) {
      return displacement_at(x, angles.entry, outline, circle) / soil.shear_modulus;
    };
    const double extent = angles.entry - angles.exit, front = hardness(angles.entry - angles.max_stress);
    const double whole = std::max(hardness(extent), hardness(0.5 * extent));
    layout.crowd_at_crest = front < 20.0 && whole > 8.0 * std::max(1.0, front);
    if (layout.crowd_at_crest) nodes += 8;
    if (turns_back(angles, circle)) {
      nodes = 16.0 + (motion.lateral != 0.0 ? 16.0 : 0.0) + 12.0 * std::log10(1.0 + whole);
    } else {
      const double decades = std::log10(1.0 + whole);
      nodes += 8.0 * decades + 4.0 * std::max(0.0, decades - 3.0);
    }
  }
  layout.per_segment = std::min(4 * static_cast<int>(std::ceil(std::min(nodes, 1e3) / 4)), most_nodes);
  return layout;
}

NodeLayout coarse(const NodeLayout& layout) {
  NodeLayout half = layout;
  half.per_segment = std::max(8, (layout.per_segment + 7) / 8 * 4);
  return half;
}

void fill_geometry(ContactPatch& patch, const ContactAngles& angles, const Outline& outline, const Kinematics& motion,
                   const NodeLayout& layout) {
  patch.count = 0;
  patch.angles = angles;
  patch.deflection = 0.0;
  const CircleMotion circle(outline, motion);
  const bool may_turn = !motion.locked && turns_back(angles, circle), no_rear = !(angles.max_stress > angles.exit);
  double split = angles.exit - 1.0;  // out of reach
  if (may_turn) {
    const double x = sign_change(angles.entry, angles.entry - angles.exit, circle.forward);
    if (x > 0.0) split = angles.entry - x;
  }
  const auto lay = [&](double high, double low, Crowd crowd, bool front) {
    if (!(high > low)) return;
    if (split < high && split > low) {
      add_segment(patch, {high, split, Crowd(at_end | (crowd & at_start))}, front, outline, layout);
      add_segment(patch, {split, low, Crowd(at_start | (crowd & at_end))}, front, outline, layout);
    } else {
      add_segment(patch, {high, low, crowd}, front, outline, layout);
    }
  };
  lay(angles.entry, angles.max_stress, may_turn && no_rear ? at_both : at_start, true);
  const int first_rear = patch.count;
  lay(angles.max_stress, angles.exit, layout.crowd_at_crest ? at_both : at_end, false);
  fill_trigonometry(patch, outline, first_rear);
}

void fill_geometry(ContactPatch& patch, const ContactAngles& angles, const Outline& outline,
                   std::span<const double> since_entry) {
  patch.count = static_cast<int>(since_entry.size());
  patch.angles = angles;
  patch.deflection = 0.0;
  const double mirror = angles.max_stress > angles.exit ? mirror_ratio(angles) : 0.0;
  int front = 0;
  for (std::size_t i = 0; i < since_entry.size(); ++i) {
    const double x = since_entry[i], theta = angles.entry - x;
    const bool rear = theta < angles.max_stress;
    front += rear ? 0 : 1;
    patch.since_entry[i] = x;
    patch.arc[i] = outline.radius;
    patch.depth[i] = rear ? mirror * std::max(0.0, theta - angles.exit) : x;
  }
  fill_trigonometry(patch, outline, front);
}

void fill_pressure(ContactPatch& p, const SoilValues& soil, const Outline& outline) {
  scaled_power(p.of(&ContactPatch::depth), soil.exponent, soil.pressure_modulus(outline.width),
               p.of(&ContactPatch::sigma));
}

void fill_displacement(ContactPatch& p, const Outline& outline, const Kinematics& motion) {
  const double turning = motion.locked ? 0.0 : outline.shear_radius;
  const double forward = outline.slip_radius * motion.forward, lateral = outline.slip_radius * motion.lateral;
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
  const std::span<double> displacement{j.data(), static_cast<std::size_t>(p.count)};
  length(p.of(&ContactPatch::j_x), p.of(&ContactPatch::j_y), displacement);
  if (motion.locked) {
    std::ranges::fill(p.of(&ContactPatch::mobilised), 1.0);
  } else {
    mobilised_share(displacement, p.of(&ContactPatch::modulus), p.of(&ContactPatch::mobilised));
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
