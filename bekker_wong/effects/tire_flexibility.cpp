// tire_flexibility: the carcass flattens: longer, shallower contact.
//
// Where the soil would press harder than the tire's ground pressure p_g = p_i + p_c, the tread gives way and rolls on a
// flat. The load then spreads over a longer contact behind and before the axle: sinkage and compaction resistance fall,
// drawbar pull rises, the more the harder the soil and the heavier the load. Pressures that the tire does not declare
// are presumed, so that an undeclared softness has a trace as well.
//
// The belt neither stretches nor loses energy: it runs at r w over any outline, so the torque's arm stays r, a point's
// displacement is dj = ds - v_x/(r w) dx, and the normal stress takes no torque. M w - F v is then what slip and
// compaction dissipate, as for the rigid wheel. What the carcass itself loses in flexing is not in here.
//
// A form is a law S: the tread reaches the depth y = S(d) where the rigid circle would reach d = r (cos theta -
// cos theta_1). Slope, arc and belt travel follow from the outline y(x), x = r sin theta. The contact ends where
// the circle rises from the rut behind the axle: theta_2 = -theta_f, r (1 - cos theta_f) = deflection under the axle.
// S takes the declared soil.
#include <algorithm>
#include <cmath>
#include <optional>
#include <span>
#include <tuple>
#include <utility>

#include "bekker_wong/closed_forms.hpp"
#include "bekker_wong/effects/forms.hpp"
#include "bekker_wong/node_functions.hpp"

namespace soilbin::bekker_wong {
namespace {

constexpr Presumption carcass_pressure = {.key = "carcass_pressure",
                                          .name = "carcass pressure",
                                          .unit = "kPa",
                                          .rule = "0 kPa",
                                          .declared = [](const Tire& t) { return t.carcass_pressure; },
                                          .presumed = [](const Tire&) { return 0.0; }};

/// A tire without any pressure carries nothing: 0 says no more than silence.
constexpr Presumption inflation_pressure = {.key = "inflation_pressure",
                                            .name = "inflation pressure",
                                            .unit = "kPa",
                                            .rule = "100 kPa",
                                            .declared =
                                                [](const Tire& t) {
                                                  const bool carries =
                                                      t.inflation_pressure.value_or(0.0) + carcass_pressure(t) > 0.0;
                                                  return carries ? t.inflation_pressure : std::nullopt;
                                                },
                                            .presumed = [](const Tire&) { return 100e3; }};

double ground_pressure(const Tire& tire) { return inflation_pressure(tire) + carcass_pressure(tire); }

/// k of the declared soil, as far as its stresses act.
double pressing_modulus(const Outline& outline, const Surroundings& around) {
  return around.stress_share * around.declared.pressure_modulus(outline.width);
}

/// S(d) and dS/dd at the depths d of many nodes.
struct Depths {
  ContactPatch::Array value, slope;
};

/// Wong's flat: the pressure stays below p_g/a, so the depth below z_g = (p_g/(a k))^(1/n). The corner is rounded by
/// the power 6 (the depth is 11 % below z_g where the circle's is z_g), so that the balance stays smooth.
struct PressureCap {
  double n, deepest;
  PressureCap(double a, const Outline& outline, const Surroundings& around)
      : n(around.declared.exponent),
        deepest(std::pow(ground_pressure(around.tire) / (a * pressing_modulus(outline, around)),
                         1 / around.declared.exponent)) {}
  /// The share of the stresses at which S(d) = y.
  double share(double y, double d) const {
    return std::pow(deepest / y, n) * std::pow(-std::expm1(6 * std::log(y / d)), n / 6);
  }
  void operator()(std::span<const double> d, Depths& reached) const {
    constexpr double largest = 1e50;  // of d/z_g, whose sixth power is still a number
    ContactPatch::Array q, root;
    for (std::size_t i = 0; i < d.size(); ++i) {
      const double x = std::min(d[i] / deepest, largest), square = x * x;
      q[i] = 1 + square * square * square;
    }
    scaled_power({q.data(), d.size()}, -1.0 / 6, 1.0, {root.data(), d.size()});
    for (std::size_t i = 0; i < d.size(); ++i) reached.value[i] = d[i] * root[i], reached.slope[i] = root[i] / q[i];
  }
};

/// Carcass and soil in series: d = S + (r a^2/2) sigma(S)/p_g; a is the half angle of the flat at sigma = p_g.
struct CarcassSpring {
  double n, give, log_give;  // give [m^(1-n)]: deflection = give S^n
  CarcassSpring(double a, const Outline& outline, const Surroundings& around)
      : n(around.declared.exponent),
        give(0.5 * a * a * outline.radius * pressing_modulus(outline, around) / ground_pressure(around.tire)),
        log_give(std::log(give)) {}
  /// The share of the stresses at which S(d) = y.
  double share(double y, double d) const { return (d - y) / (give * std::pow(y, n)); }
  void operator()(std::span<const double> d, Depths& reached) const {
    for (std::size_t i = 0; i < d.size(); ++i) std::tie(reached.value[i], reached.slope[i]) = at(d[i]);
  }
  /// u = S/d solves u + B u^n = 1. In t = ln u that is ln(e^t + B e^(n t)) = 0, a convex function of slope 1 .. n:
  /// Newton falls monotonically to the root from where the larger term is 1, in three or four steps.
  std::pair<double, double> at(double d) const {
    if (!(d > 0.0)) return {0.0, n > 1.0 ? 1.0 : n < 1.0 ? 0.0 : 1 / (1 + give)};
    const double log_b = log_give + (n - 1) * std::log(d);
    double t = std::min(0.0, -log_b / n), step = 1.0;
    for (int i = 0; i < 20 && step > 1e-8; ++i) {  // the last step is exact to its square
      const double linear = std::exp(t), power = std::exp(log_b + n * t), sum = linear + power;
      step = std::log(sum) * sum / (linear + n * power);
      t -= step;
    }
    const double u = std::exp(t), slope = 1 + n * std::exp(log_b + (n - 1) * t);
    return {d * u, 1 / slope};
  }
};

template <class Law>
class Flattening final : public Effect {
 public:
  explicit Flattening(const std::vector<double>& p) : amplitude_(p[0]) {}

  void angles(ContactAngles& a, const Outline& outline, const Surroundings& around) const override {
    if (amplitude_ == 0.0) return;
    const double deflection = deflection_of(Law(amplitude_, outline, around), a.entry, outline);
    a.exit = std::min(a.exit, -2 * std::asin(std::sqrt(std::clamp(deflection / (2 * outline.radius), 0.0, 1.0))));
  }

  std::optional<double> stress_share(double tread_depth, double circle_depth, const Outline& outline,
                                     const Surroundings& around) const override {
    if (amplitude_ == 0.0) return std::nullopt;
    return Law(amplitude_, outline, around).share(tread_depth, circle_depth);
  }

  void geometry(ContactPatch& p, const Outline& outline, const Surroundings& around) const override {
    if (amplitude_ == 0.0) return;
    const Law law(amplitude_, outline, around);
    const auto count = static_cast<std::size_t>(p.count);
    const double surface = std::cos(p.angles.entry);
    Depths tread, mirrored;
    law({circle_depths(p.of(&ContactPatch::normal_cosine), surface, outline).data(), count}, tread);
    std::size_t first_rear = 0;  // behind theta_m the pressure law looks at the mirror angle's depth
    while (first_rear < count && p.theta[first_rear] >= p.angles.max_stress) ++first_rear;
    law({&p.depth[first_rear], count - first_rear}, mirrored);
    ContactPatch::Array rise, stretch;  // of the tread a radian; arc length of the tread over the circle's
    for (std::size_t i = 0; i < count; ++i) rise[i] = tread.slope[i] * p.normal_sine[i];
    length({rise.data(), count}, p.of(&ContactPatch::normal_cosine), {stretch.data(), count});
    follow_belt(law, outline, stretch, p);
    for (std::size_t i = 0; i < count; ++i) {
      p.normal_sine[i] = rise[i] / stretch[i];
      p.normal_cosine[i] /= stretch[i];
      p.arc[i] *= stretch[i];
      p.depth[i] = i < first_rear ? tread.value[i] : mirrored.value[i - first_rear];
    }
    p.deflection = deflection_of(law, p.angles.entry, outline);
  }

 private:
  /// Depths of the circle where the cosine of its angle is this; surface: that of theta_1.
  static ContactPatch::Array circle_depths(std::span<const double> cosine, double surface, const Outline& outline) {
    ContactPatch::Array depth;
    for (std::size_t i = 0; i < cosine.size(); ++i) depth[i] = std::max(0.0, outline.radius * (cosine[i] - surface));
    return depth;
  }

  /// Makes since_entry, at nodes that still lie on the circle, the belt's travel since the entry over r: the integral
  /// of the stretch, sqrt((S' sin)^2 + cos^2), by Simpson's rule from node to node.
  static void follow_belt(const Law& law, const Outline& outline, const ContactPatch::Array& stretch, ContactPatch& p) {
    const auto count = static_cast<std::size_t>(p.count);
    const double sine_1 = std::sin(p.angles.entry), cosine_1 = std::cos(p.angles.entry), surface = 0.0;
    ContactPatch::Array rise, cosine, half_way;  // half way from the node before
    for (std::size_t i = 0; i < count; ++i) {
      rise[i] = (i == 0 ? sine_1 : p.normal_sine[i - 1]) + p.normal_sine[i];
      cosine[i] = (i == 0 ? cosine_1 : p.normal_cosine[i - 1]) + p.normal_cosine[i];
    }
    length({rise.data(), count}, {cosine.data(), count}, {half_way.data(), count});
    for (std::size_t i = 0; i < count; ++i) rise[i] /= half_way[i], cosine[i] /= half_way[i];
    Depths at_entry, between;
    law({&surface, 1}, at_entry);
    law({circle_depths({cosine.data(), count}, cosine_1, outline).data(), count}, between);
    for (std::size_t i = 0; i < count; ++i) rise[i] *= between.slope[i];
    length({rise.data(), count}, {cosine.data(), count}, {half_way.data(), count});
    const double rise_1 = at_entry.slope[0] * sine_1;
    double before = std::sqrt(rise_1 * rise_1 + cosine_1 * cosine_1), lost = 0.0, passed = 0.0;
    for (std::size_t i = 0; i < count; ++i) {
      lost += (1 - (before + 4 * half_way[i] + stretch[i]) / 6) * (p.since_entry[i] - passed);
      before = stretch[i], passed = p.since_entry[i];
      p.since_entry[i] -= lost;
    }
  }

  static double deflection_of(const Law& law, double entry, const Outline& outline) {
    const double half = std::sin(0.5 * entry), depth = 2 * outline.radius * half * half;
    Depths reached;
    law({&depth, 1}, reached);
    return depth - reached.value[0];
  }
  double amplitude_;
};

/// Schmid: the deflected tire's contact is that of a larger rigid circle, sqrt(R/r) = sqrt(1 + f/z) + sqrt(f/z), with
/// the deflection f = (r a^2/2) W/(2 r b p_g) and Bekker's static sinkage z of the rigid wheel. The formula says that
/// the contact sqrt(2r (z + f)) before the axle and sqrt(2r f) behind it has the circle's length sqrt(2R z): the circle
/// stands sqrt(2r f) behind the axle.
class SubstituteCircle final : public Effect {
 public:
  explicit SubstituteCircle(const std::vector<double>& p) : amplitude_(p[0]) {}

  void outline(Outline& outline, const Surroundings& around) const override {
    if (amplitude_ == 0.0) return;
    const double larger = enlargement(outline.radius, outline.width, around);
    outline.shear_radius += (larger - 1) * outline.radius, outline.slip_radius += (larger - 1) * outline.radius;
    outline.radius *= larger;
  }

  void geometry(ContactPatch& p, const Outline& outline, const Surroundings& around) const override {
    if (amplitude_ == 0.0) return;
    for (double& arm : p.of(&ContactPatch::arm)) arm -= outline.radius - around.tire.radius;
  }

 private:
  double deflection(double width, const Surroundings& around) const {
    return 0.25 * amplitude_ * amplitude_ * around.normal_load / (width * ground_pressure(around.tire));
  }
  double enlargement(double radius, double width, const Surroundings& around) const {
    const double z = bekker_static_sinkage(around.declared, radius, width, around.normal_load);
    const double share = deflection(width, around) / z, root = std::sqrt(1 + share) + std::sqrt(share);
    return root * root;
  }
  double amplitude_;
};

}  // namespace

std::vector<EffectForm> tire_flexibility_forms() {
  const std::string id = "tire_flexibility";
  const std::vector<Presumption> of_pressure = {inflation_pressure, carcass_pressure};
  return {
      {.id = id,
       .form = "flat_section",
       .equation = "sigma <= p_g/a, p_g = p_i + p_c; d -> d (1 + (d/z_g)^6)^(-1/6), k z_g^n = p_g/a",
       .source = "after Wong, Theory of Ground Vehicles, ch. 2 (pneumatic tire below the critical ground pressure)",
       .parameters = {{"a", "-", 1.0, 0.0, 30.0, "declared ground pressure over the one that acts"}},
       .steady_only = "the shear displacement is followed along a rigid rim",
       .presumes = of_pressure,
       .make = maker<Flattening<PressureCap>>()},
      {.id = id,
       .form = "carcass_spring",
       .equation = "d = y + (r a^2/2) k y^n/p_g: carcass and soil in series, theta_2 = -theta_f",
       .source = "stated: radial springs of stiffness 2 p_g/(r a^2) between rim and tread",
       .parameters = {{"a", "rad", 0.3, 0.0, 2.0, "half angle of the flat where the soil presses with p_g"}},
       .steady_only = "the shear displacement is followed along a rigid rim",
       .presumes = of_pressure,
       .make = maker<Flattening<CarcassSpring>>()},
      {.id = id,
       .form = "substitute_circle",
       .equation = "sqrt(R/r) = sqrt(1 + f/z0) + sqrt(f/z0), f = (r a^2/2) W/(2 r b p_g), z0: Bekker's static sinkage",
       .source = "after Schmid 1995, J. Terramechanics 32(1):3",
       .parameters = {{"a", "rad", 0.5, 0.0, 2.0, "half angle of the flat where W/(2 r b) = p_g"}},
       .steady_only = "the shear displacement is followed along a rigid rim",
       .presumes = of_pressure,
       .make = maker<SubstituteCircle>()},
  };
}

}  // namespace soilbin::bekker_wong
