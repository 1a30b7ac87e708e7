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
// A maker's load-deflection table, where the tire has one, is read by the two forms that have a deflection of their
// own. Both then give way on firm ground as the table says, at the default a; f goes with a^2. The spring's stiffness
// is that of a circle whose segment of depth f carries W, W = b Int d dx/softness; the pressure's distribution is the
// contact's own, so it is met where sigma is largest under the axle (c1 = c2 = 0). The cap has no deflection on firm
// ground but W/(2 b p_g) long, a chord, which is longer than a tire's print of that deflection: it keeps to p_g.
//
// S takes the soil that acts, P(y), with all that other effects make of it: the tread rests where soil and carcass
// press alike. Of the base model's power law S is known in closed form, and so is that of the cap where the pressure
// follows from the depth alone, once the depth z_g at which it is p_g/a is found; else S is found at each node.
#include <algorithm>
#include <cmath>
#include <optional>
#include <span>
#include <tuple>
#include <utility>

#include "bekker_wong/closed_forms.hpp"
#include "bekker_wong/effects/forms.hpp"
#include "bekker_wong/node_functions.hpp"
#include "scenario/deflection_table.hpp"

namespace soilbin::bekker_wong {
namespace {

constexpr Presumption carcass_pressure = {
    .key = "carcass_pressure",
    .name = "carcass pressure",
    .unit = "kPa",
    .rule = "0 kPa",
    .declared =
        [](const Tire& t) { return t.carcass_pressure ? std::optional(t.carcass_pressure->value) : std::nullopt; },
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

/// What is presumed of the carcass where the maker's table has it in it already.
constexpr Presumption carcass_beside_table = {
    .key = carcass_pressure.key,
    .name = carcass_pressure.name,
    .unit = carcass_pressure.unit,
    .rule = carcass_pressure.rule,
    .declared = [](const Tire& t) { return t.deflection ? std::optional(0.0) : carcass_pressure.declared(t); },
    .presumed = carcass_pressure.presumed};

constexpr double spring_half_angle = 0.3, circle_half_angle = 0.5;  // [rad] defaults of a

/// f of the maker's table under this share of the load, short of the radius.
double told_deflection(const DeflectionTable& table, const Surroundings& around) {
  const double f = deflection_of(table, around.normal_load, inflation_pressure(around.tire));
  return std::min(f, 0.99 * around.tire.radius);
}

double ground_pressure(const Tire& tire) { return inflation_pressure(tire) + carcass_pressure(tire); }

using Array = ContactPatch::Array;

/// k of the soil that acts, as far as its stresses do, without what effects make of the pressure.
double pressing_modulus(const Outline& outline, const Surroundings& around) {
  return around.stress_share * around.soil.pressure_modulus(outline.width);
}

/// S(d) and dS/dd at the depths d of many nodes.
struct Depths {
  Array value, slope;
};

/// Wong's flat: the pressure stays below p_g/a, so the depth below z_g, P(z_g) = p_g/a. The corner of the tread's depth
/// is rounded by the power 6 (11 % below z_g where the circle's depth is z_g), so that the patch's few nodes follow it.
/// The exit angle goes with the root of the deflection: by that corner a tire that the soil presses with two thirds of
/// p_g, which should be rigid, would have a long contact behind the axle and pull 5 % of its load too much. So the
/// exit is that of a corner four times as sharp.
struct PressureCap {
  static constexpr bool by_depth_alone = true;  // its decisive depth is that of every node alike
  double n, most, deepest;                      // z_g; of the power law (p_g/(a k))^(1/n)
  PressureCap(double a, const Outline& outline, const Surroundings& around)
      : n(around.soil.exponent),
        most(ground_pressure(around.tire) / a),
        deepest(std::pow(most / pressing_modulus(outline, around), 1 / n)) {}
  /// The depth at which the soil's pressure decides where the tread lies: z_g; that of the power law.
  double decisive(double) const { return deepest; }
  void decide(double z_g) { deepest = z_g; }
  /// Rises with that depth, 1 where it is right.
  double residual(double, double pressure, double) const { return pressure / most; }
  double tread(double z_g, double d) const { return d * rounded(d / z_g); }
  /// Depth of the tread by which the contact ends.
  static double tread_at_exit(double z_g, double d) {
    constexpr double corner = 24.0, farthest = 1e12;  // of d/z_g, whose power is still a number
    return d * std::pow(1 + std::pow(std::min(d / z_g, farthest), corner), -1.0 / corner);
  }
  /// The decisive depth, and the pressure there, where the tread lies at y below the circle's d.
  static double decisive_under(double y, double d) { return y * std::pow(-std::expm1(6 * std::log(y / d)), -1.0 / 6); }
  double pressure_under(double, double) const { return most; }
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

 private:
  static double rounded(double x) { return std::pow(1 + std::pow(std::min(x, 1e50), 6), -1.0 / 6); }
};

/// How far a pressure of 1 Pa presses the carcass in [m/Pa]: (r a^2/2)/p_g; a is the half angle of the flat at sigma =
/// p_g. By the maker's table A b/W, of the segment A that the chord of the flat cuts off.
double carcass_softness(double a, const Outline& outline, const Surroundings& around) {
  if (!around.tire.deflection) return 0.5 * a * a * outline.radius / ground_pressure(around.tire);
  const double scale = a / spring_half_angle, f = told_deflection(*around.tire.deflection, around),
               half = 2 * std::asin(std::sqrt(f / (2 * outline.radius))),
               segment = outline.radius * outline.radius * (half - 0.5 * std::sin(2 * half));
  return scale * scale * outline.width * segment / around.normal_load;
}

/// Carcass and soil in series: d = S + softness P(S).
struct CarcassSpring {
  static constexpr bool by_depth_alone = false;
  double n, softness, give, log_give;  // softness [m/Pa]; give [m^(1-n)]: deflection = give S^n
  CarcassSpring(double a, const Outline& outline, const Surroundings& around)
      : n(around.soil.exponent),
        softness(carcass_softness(a, outline, around)),
        give(softness * pressing_modulus(outline, around)),
        log_give(std::log(give)) {}
  /// The depth at which the soil's pressure decides where the tread lies: its own; that of the power law.
  double decisive(double d) const { return at(d).first; }
  /// Rises with that depth, 1 where it is right.
  double residual(double y, double pressure, double d) const { return (y + softness * pressure) / d; }
  static double tread(double y, double) { return y; }
  static double tread_at_exit(double y, double) { return y; }
  /// The decisive depth, and the pressure there, where the tread lies at y below the circle's d.
  static double decisive_under(double y, double) { return y; }
  double pressure_under(double y, double d) const { return (d - y) / softness; }
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

/// S on the soil that acts, for one angle of entry.
template <class Law>
class Tread {
 public:
  Tread(double amplitude, const Outline& outline, const Surroundings& around, double entry)
      : law_(amplitude, outline, around), outline_(outline), around_(around), entry_(entry) {
    if (around.stress_share == 0.0) return;
    const PressureLaw pressed = pressure_law(around.effects);
    node_by_node_ = pressed != PressureLaw::declared;
    if constexpr (Law::by_depth_alone)
      if (pressed == PressureLaw::by_depth) decide(), node_by_node_ = false;
  }

  void operator()(std::span<const double> d, Depths& reached) const {
    constexpr double step = 1e-5;  // relative, of d
    law_(d, reached);
    Decisive at;
    if (!solved(d, at, reached.value)) return;
    Array low, high, below, above;
    for (std::size_t i = 0; i < d.size(); ++i) low[i] = d[i] * (1 - step), high[i] = d[i] * (1 + step);
    Decisive lower = at, higher = at;
    solve({low.data(), d.size()}, lower, below);
    solve({high.data(), d.size()}, higher, above);
    for (std::size_t i = 0; i < d.size(); ++i)
      if (d[i] > least()) reached.slope[i] = (above[i] - below[i]) / (high[i] - low[i]);
  }

  /// S alone.
  void depths(std::span<const double> d, Array& value) const {
    Depths reached;
    law_(d, reached);
    Decisive at;
    solved(d, at, reached.value);
    std::copy_n(reached.value.begin(), d.size(), value.begin());
  }

  /// The share of the stresses at which S(d) = y.
  double share(double y, double d) const {
    if (!(d > y)) return 0.0;
    const double deep = law_.decisive_under(y, d);
    Array pressure;
    press_at({&deep, 1}, {&d, 1}, pressure);
    return law_.pressure_under(y, d) / pressure[0];
  }

  /// How far the lowest point of the tread stays above the circle's.
  double deflection() const { return lowest() - tread_at_lowest(); }

  /// The deflection by which the contact ends behind the axle.
  double deflection_at_exit() const {
    return lowest() - law_.tread_at_exit(law_.decisive_under(tread_at_lowest(), lowest()), lowest());
  }

 private:
  /// Depth of the circle's lowest point.
  double lowest() const {
    const double half = std::sin(0.5 * entry_);
    return 2 * outline_.radius * half * half;
  }
  double tread_at_lowest() const {
    const double depth = lowest();
    Array reached;
    depths({&depth, 1}, reached);
    return reached[0];
  }
  /// Below this depth the tread's share of it stays the same [m].
  double least() const { return 1e-9 * outline_.radius; }

  void press_at(std::span<const double> depth, std::span<const double> circle, Array& pressure) const {
    ContactPatch probe;
    probe.count = static_cast<int>(depth.size());
    probe.angles.entry = entry_;
    std::ranges::copy(depth, probe.depth.begin());
    std::ranges::copy(circle, probe.circle_depth.begin());
    press(probe, outline_, around_);
    for (std::size_t i = 0; i < depth.size(); ++i) pressure[i] = around_.stress_share * probe.sigma[i];
  }

  /// ln of the decisive depths of many nodes, and how fast the residual's ln rises with each.
  struct Decisive {
    Array t, rise;
  };

  /// ln of the law's residual at the decisive depths e^t, 0 where they are right; gives the largest.
  double residuals(std::span<const double> d, const Array& t, Array& left) const {
    Array depth, pressure;
    for (std::size_t i = 0; i < d.size(); ++i) depth[i] = std::exp(t[i]);
    press_at({depth.data(), d.size()}, d, pressure);
    double most = 0.0;
    for (std::size_t i = 0; i < d.size(); ++i) {
      left[i] = std::log(law_.residual(depth[i], pressure[i], std::max(d[i], least())));
      most = std::max(most, std::abs(left[i]));
    }
    return most;
  }

  /// Whether no effect changes the pressure where it decides; leaves the decisive depths of the power law.
  bool power_law_acts(std::span<const double> d, Decisive& at) const {
    Array left;
    for (std::size_t i = 0; i < d.size(); ++i) at.t[i] = std::log(law_.decisive(std::max(d[i], least())));
    at.rise.fill(law_.n);
    return residuals(d, at.t, left) < 1e-12;
  }

  /// Finds the one decisive depth, and leaves the law as its closed form with it.
  void decide() {
    const double surface = 0.0;
    Decisive at;
    if (power_law_acts({&surface, 1}, at)) return;
    find({&surface, 1}, at);
    law_.decide(std::exp(at.t[0]));
  }

  /// Finds S at many nodes where it has no closed form; false, and nothing, where it has.
  bool solved(std::span<const double> d, Decisive& at, Array& value) const {
    if (!node_by_node_ || std::ranges::all_of(d, [](double depth) { return depth <= 0.0; }) || power_law_acts(d, at))
      return false;
    solve(d, at, value);
    return true;
  }

  void solve(std::span<const double> d, Decisive& at, Array& value) const {
    find(d, at);
    for (std::size_t i = 0; i < d.size(); ++i) {
      const double circle = std::max(d[i], least());
      value[i] = law_.tread(std::exp(at.t[i]), circle) * (std::max(d[i], 0.0) / circle);
    }
  }

  /// The decisive depths of many nodes at once, from those nearby, by the secant method on ln of the residual over t,
  /// which rises; where it leaves the bracket found so far, the bracket is halved.
  void find(std::span<const double> d, Decisive& at) const {
    constexpr double longest = 2.0, unknown = 1e3, accuracy = 1e-13;
    auto& [t, rise] = at;
    Array left, before, step, low, high;
    low.fill(-unknown), high.fill(unknown);
    double most = residuals(d, t, left);
    for (int round = 0; round < 100 && most > accuracy; ++round) {
      for (std::size_t i = 0; i < d.size(); ++i) {
        const double wanted = t[i] + std::clamp(-left[i] / rise[i], -longest, longest);
        before[i] = left[i], step[i] = 0.0;
        if (std::abs(left[i]) < accuracy || wanted == t[i]) continue;
        (left[i] < 0.0 ? low : high)[i] = t[i];
        step[i] = (wanted > low[i] && wanted < high[i] ? wanted : 0.5 * (low[i] + high[i])) - t[i];
        t[i] += step[i];
      }
      const double now = residuals(d, t, left);
      for (std::size_t i = 0; i < d.size(); ++i)
        if (const double secant = (left[i] - before[i]) / step[i]; step[i] != 0.0 && secant > 0.01) rise[i] = secant;
      if (now < 100 * accuracy && now >= most) break;  // rounding is left
      most = now;
    }
  }

  Law law_;
  const Outline& outline_;
  const Surroundings& around_;
  double entry_;
  bool node_by_node_ = false;  ///< whether S has no closed form: effects make another law of the pressure
};

template <class Law>
class Flattening final : public Effect {
 public:
  explicit Flattening(const std::vector<double>& p) : amplitude_(p[0]) {}

  void angles(ContactAngles& a, const Outline& outline, const Surroundings& around) const override {
    if (amplitude_ == 0.0) return;
    const double deflection = Tread<Law>(amplitude_, outline, around, a.entry).deflection_at_exit();
    a.exit = std::min(a.exit, -2 * std::asin(std::sqrt(std::clamp(deflection / (2 * outline.radius), 0.0, 1.0))));
  }

  std::optional<double> stress_share(double tread_depth, double circle_depth, const Outline& outline,
                                     const Surroundings& around) const override {
    if (amplitude_ == 0.0) return std::nullopt;
    const double entry = 2 * std::asin(std::sqrt(std::clamp(circle_depth / (2 * outline.radius), 0.0, 1.0)));
    return Tread<Law>(amplitude_, outline, around, entry).share(tread_depth, circle_depth);
  }

  void geometry(ContactPatch& p, const Outline& outline, const Surroundings& around) const override {
    if (amplitude_ == 0.0) return;
    const Tread<Law> law(amplitude_, outline, around, p.angles.entry);
    const auto count = static_cast<std::size_t>(p.count);
    const double surface = std::cos(p.angles.entry);
    Depths tread;
    Array mirrored;
    law({circle_depths(p.of(&ContactPatch::normal_cosine), surface, outline).data(), count}, tread);
    std::size_t first_rear = 0;  // behind theta_m the pressure law looks at the mirror angle's depth
    while (first_rear < count && p.theta[first_rear] >= p.angles.max_stress) ++first_rear;
    law.depths({&p.circle_depth[first_rear], count - first_rear}, mirrored);
    Array rise, stretch;  // of the tread a radian; arc length of the tread over the circle's
    for (std::size_t i = 0; i < count; ++i) rise[i] = tread.slope[i] * p.normal_sine[i];
    length({rise.data(), count}, p.of(&ContactPatch::normal_cosine), {stretch.data(), count});
    follow_belt(law, outline, stretch, p);
    for (std::size_t i = 0; i < count; ++i) {
      p.normal_sine[i] = rise[i] / stretch[i];
      p.normal_cosine[i] /= stretch[i];
      p.arc[i] *= stretch[i];
      p.depth[i] = i < first_rear ? tread.value[i] : mirrored[i - first_rear];
    }
    p.deflection = law.deflection();
  }

 private:
  /// Depths of the circle where the cosine of its angle is this; surface: that of theta_1.
  static Array circle_depths(std::span<const double> cosine, double surface, const Outline& outline) {
    Array depth;
    for (std::size_t i = 0; i < cosine.size(); ++i) depth[i] = std::max(0.0, outline.radius * (cosine[i] - surface));
    return depth;
  }

  /// Makes since_entry, at nodes that still lie on the circle, the belt's travel since the entry over r: the integral
  /// of the stretch, sqrt((S' sin)^2 + cos^2), by Simpson's rule from node to node.
  static void follow_belt(const Tread<Law>& law, const Outline& outline, const Array& stretch, ContactPatch& p) {
    const auto count = static_cast<std::size_t>(p.count);
    const double sine_1 = std::sin(p.angles.entry), cosine_1 = std::cos(p.angles.entry), surface = 0.0;
    Array rise, cosine, half_way;  // half way from the node before
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

  double amplitude_;
};

/// Schmid: the deflected tire's contact is that of a larger rigid circle, sqrt(R/r) = sqrt(1 + f/z) + sqrt(f/z), with
/// the deflection f = (r a^2/2) W/(2 r b p_g), or the maker's, and Bekker's static sinkage z of the rigid wheel on the
/// soil that acts. The formula says that the contact sqrt(2r (z + f)) before the axle and sqrt(2r f) behind it has the
/// circle's length sqrt(2R z): the circle stands sqrt(2r f) behind the axle.
class SubstituteCircle final : public Effect {
 public:
  explicit SubstituteCircle(const std::vector<double>& p) : amplitude_(p[0]) {}

  void outline(Outline& outline, const Surroundings& around) const override {
    if (amplitude_ == 0.0) return;
    const double more = beyond(outline.width, around);
    for (double* radius : {&outline.radius, &outline.shear_radius, &outline.slip_radius}) *radius += more;
  }

  void geometry(ContactPatch& p, const Outline& outline, const Surroundings& around) const override {
    if (amplitude_ == 0.0) return;
    const double more = beyond(outline.width, around);
    for (double& arm : p.of(&ContactPatch::arm)) arm -= more;
  }

 private:
  double deflection(double width, const Surroundings& around) const {
    if (around.tire.deflection)
      return std::pow(amplitude_ / circle_half_angle, 2) * told_deflection(*around.tire.deflection, around);
    return 0.25 * amplitude_ * amplitude_ * around.normal_load / (width * ground_pressure(around.tire));
  }
  /// R - r [m].
  double beyond(double width, const Surroundings& around) const {
    SoilValues soil = around.soil;
    soil.exponent = std::min(soil.exponent, 2.5);  // Bekker's formula ends at 3
    const double radius = around.tire.radius, z = bekker_static_sinkage(soil, radius, width, around.normal_load);
    const double share = deflection(width, around) / z, root = std::sqrt(1 + share) + std::sqrt(share);
    return radius * (root * root) - radius;
  }
  double amplitude_;
};

}  // namespace

std::vector<EffectForm> tire_flexibility_forms() {
  const std::string id = "tire_flexibility";
  const std::vector<Presumption> of_pressure = {inflation_pressure, carcass_pressure},
                                 beside_table = {inflation_pressure, carcass_beside_table};
  const std::vector<std::string> table = {deflection_key};
  return {
      {.id = id,
       .form = "flat_section",
       .equation = "sigma <= p_g/a, p_g = p_i + p_c; d -> d (1 + (d/z_g)^6)^(-1/6), sigma(z_g) = p_g/a",
       .source = "after Wong, Theory of Ground Vehicles, ch. 2 (pneumatic tire below the critical ground pressure)",
       .parameters = {{"a", "-", 1.0, 0.0, 30.0, "declared ground pressure over the one that acts"}},
       .presumes = of_pressure,
       .make = maker<Flattening<PressureCap>>()},
      {.id = id,
       .form = "carcass_spring",
       .equation = "d = y + (r a^2/2) sigma(y)/p_g: carcass and soil in series, theta_2 = -theta_f",
       .source = "stated: radial springs of stiffness 2 p_g/(r a^2) between rim and tread",
       .parameters = {{"a", "rad", spring_half_angle, 0.0, 2.0,
                       "half angle of the flat where the soil presses with p_g"}},
       .presumes = beside_table,
       .tire_values = table,
       .make = maker<Flattening<CarcassSpring>>()},
      {.id = id,
       .form = "substitute_circle",
       .equation = "sqrt(R/r) = sqrt(1 + f/z0) + sqrt(f/z0), f = (r a^2/2) W/(2 r b p_g), z0: Bekker's static sinkage",
       .source = "after Schmid 1995, J. Terramechanics 32(1):3",
       .parameters = {{"a", "rad", circle_half_angle, 0.0, 2.0, "half angle of the flat where W/(2 r b) = p_g"}},
       .steady_only = "its circle stands for the tire's contact, whose rim a drive follows",
       .presumes = beside_table,
       .tire_values = table,
       .make = maker<SubstituteCircle>()},
  };
}

}  // namespace soilbin::bekker_wong
