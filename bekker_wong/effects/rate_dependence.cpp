// rate_dependence: soil resists penetration or shear more at speed.
//
// A wheel's surface enters the soil at v_x sin(theta) along its normal and slides on it at r w - v cos(theta). Pressure
// that grows with the first lets a fast wheel sink less; cohesion that grows with the second gives it more thrust and
// takes more torque; soil that must be set moving resists with v squared.
#include <algorithm>
#include <cmath>

#include "bekker_wong/effects/forms.hpp"
#include "bekker_wong/effects/instrument_channels.hpp"
#include "bekker_wong/effects/scaled_soil.hpp"
#include "bekker_wong/node_functions.hpp"

namespace soilbin::bekker_wong {
namespace {

/// A speed of zero counts as this share of the reference: power laws and logarithms have no value there.
constexpr double creep = 0.01;

/// Sine of the angle that a node's pressure belongs to: its own in front, the mirror angle's behind theta_m, from the
/// circle's depth r (cos(theta) - cos(theta_1)).
double sine_of_depth(double depth, double cosine_1, double radius) {
  const double cosine = cosine_1 + depth / radius;
  return std::sqrt(std::max(0.0, (1 - cosine) * (1 + cosine)));
}

/// sigma *= ratio(v_z)^m with the speed of penetration v_z = v_x sin(theta) at each node.
template <class Ratio>
void harden_with_speed(ContactPatch& patch, const Outline& outline, const Surroundings& around, double m, Ratio ratio) {
  if (m == 0.0) return;
  const double speed = around.at.speed * std::abs(std::cos(around.at.yaw));
  const double cosine_1 = std::cos(patch.angles.entry);
  const auto count = static_cast<std::size_t>(patch.count);
  ContactPatch::Array ratios, factors;
  for (std::size_t i = 0; i < count; ++i)
    ratios[i] = ratio(speed * sine_of_depth(patch.circle_depth[i], cosine_1, outline.radius));
  scaled_power({ratios.data(), count}, m, 1.0, {factors.data(), count});
  for (std::size_t i = 0; i < count; ++i) patch.sigma[i] *= factors[i];
}

/// sigma = k z^n (v_z/v0)^m.
class Grahn final : public Effect {
 public:
  explicit Grahn(const std::vector<double>& p) : m_(p[0]), v0_(p[1]) {}
  PressureLaw pressure_law() const override { return PressureLaw::by_place; }
  void pressure(ContactPatch& patch, const SoilValues&, const Outline& o, const Surroundings& around) const override {
    harden_with_speed(patch, o, around, m_, [&](double v_z) {
      const double r = v_z / v0_;
      return std::sqrt(r * r + creep * creep);
    });
  }

 private:
  double m_, v0_;
};

/// sigma = k z^n (1 + v_z/v0)^m: the plate test's pressure at rest, Grahn's power at speed.
class QuasiStatic final : public Effect {
 public:
  explicit QuasiStatic(const std::vector<double>& p) : m_(p[0]), v0_(p[1]) {}
  PressureLaw pressure_law() const override { return PressureLaw::by_place; }
  void pressure(ContactPatch& patch, const SoilValues&, const Outline& o, const Surroundings& around) const override {
    harden_with_speed(patch, o, around, m_, [&](double v_z) { return 1 + v_z / v0_; });
  }

 private:
  double m_, v0_;
};

/// c = c_0 (1 + a log10(v_j/v0)), v_j the speed at which the rim slides over the soil; phi as it is.
class CohesionLog final : public Effect {
 public:
  explicit CohesionLog(const std::vector<double>& p) : amplitude_(p[0]), v0_(p[1]) {}
  void strength(ContactPatch& patch, const SoilValues& soil, const Outline&,
                const Surroundings& around) const override {
    const double rim = rim_speed(around), along = around.at.speed * std::cos(around.at.yaw);
    const double across = around.at.speed * std::sin(around.at.yaw);
    for (int i = 0; i < patch.count; ++i) {
      const double sliding = std::hypot(rim - along * patch.normal_cosine[i], across);
      const double decades = std::log10(std::hypot(sliding / v0_, creep));
      patch.strength[i] += soil.cohesion * std::max(amplitude_ * decades, least_share - 1);
    }
  }

 private:
  double amplitude_, v0_;
};

/// The whole strength times 1 + a log10(v/v0), v the speed of travel.
class ShearLog final : public Effect {
 public:
  explicit ShearLog(const std::vector<double>& p) : amplitude_(p[0]), v0_(p[1]) {}
  void strength(ContactPatch& patch, const SoilValues&, const Outline&, const Surroundings& around) const override {
    const double factor = at_least_share(1 + amplitude_ * std::log10(std::hypot(around.at.speed / v0_, creep)));
    for (double& strength : patch.of(&ContactPatch::strength)) strength *= factor;
  }

 private:
  double amplitude_, v0_;
};

/// Resistance a density b z v^2 against travel: the soil in the rut's cross section is set moving.
class Inertial final : public Effect {
 public:
  explicit Inertial(const std::vector<double>& p) : amplitude_(p[0]) {}
  bool lifts() const override { return false; }
  void added_forces(ForceLedger& ledger, const Rolling& rolling) const override {
    if (amplitude_ == 0.0) return;
    const OperatingCondition& at = rolling.around.at;
    const double force =
        amplitude_ * rolling.soil.density * rolling.outline.width * rolling.sinkage * at.speed * at.speed;
    ledger.add(
        {.name = "inertial_resistance", .forward = -force * std::cos(at.yaw), .lateral = force * std::sin(at.yaw)});
  }

 private:
  double amplitude_;
};

}  // namespace

std::vector<EffectForm> rate_dependence_forms() {
  const std::string id = "rate_dependence";
  const EffectParameter v0 = {"v0", "m/s", 0.1, 1e-4, 20.0, "speed at which the soil's values were measured"};
  return {
      {.id = id,
       .form = "grahn",
       .equation = "sigma = k z^n (v_z/v0)^m, v_z = v cos(yaw) sin(theta), held above v0/100",
       .source = "after Grahn 1991, J. Terramechanics 28(4):339",
       .parameters = {{"m", "-", 0.1, 0.0, 1.0, "power of the penetration speed"}, v0},
       .conditions = {"speed"},
       .make = maker<Grahn>()},
      {.id = id,
       .form = "quasi_static",
       .equation = "sigma = k z^n (1 + v_z/v0)^m, v_z = v cos(yaw) sin(theta)",
       .source = "after Grahn 1991, made to end in the plate test's pressure at rest",
       .parameters = {{"m", "-", 0.2, 0.0, 2.0, "power of the penetration speed"}, v0},
       .conditions = {"speed"},
       .make = maker<QuasiStatic>()},
      {.id = id,
       .form = "cohesion_log",
       .equation = "c = c_0 (1 + a log10(v_j/v0)), v_j = |r w - v cos(theta)| held above v0/100",
       .source = "Stafford and Tanner 1983, Soil & Tillage Research 3(3):245 (c logarithmic in rate, phi constant)",
       .parameters = {{"a", "-", 0.2, 0.0, 2.0, "relative growth of the cohesion a decade of sliding speed"}, v0},
       .conditions = {"speed"},
       .make = maker<CohesionLog>()},
      {.id = id,
       .form = "shear_log",
       .equation = "c + sigma tan(phi) times 1 + a log10(v/v0), v held above v0/100",
       .source = "stated here: the logarithmic law of rate on the whole strength",
       .parameters = {{"a", "-", 0.1, -0.4, 1.0, "relative growth of the strength a decade of speed"}, v0},
       .conditions = {"speed"},
       .make = maker<ShearLog>()},
      {.id = id,
       .form = "inertial",
       .equation = "resistance a density b z v^2",
       .source = "stated here: momentum of the soil that the wheel sets moving",
       .parameters = {{"a", "-", 1.0, 0.0, 100.0, "share of v^2 that the rut's soil takes up"}},
       .conditions = {"speed"},
       .make = maker<Inertial>()},
  };
}

}  // namespace soilbin::bekker_wong
