// lug_thrust: lugs shear on a larger radius and push soil with their faces.
//
// A lug of height h raises what the tread can pull: it moves the shear surface out to a larger circle, shears soil on
// its sides, and pushes the soil behind its face. Every form rises with h/b or h/r; they differ in what the gain grows
// with: slip (shear_radius: already at s = 0), cohesion and load (side_factors), load (passive_blade), lug size alone
// (free_blade).
//
// The amplitude is the share of the lug height that acts. Lugs that the tire does not declare are presumed, so that an
// undeclared lug has a trace as well.
#include <cmath>
#include <numbers>

#include "bekker_wong/earth_pressure.hpp"
#include "bekker_wong/effects/edge.hpp"
#include "bekker_wong/effects/forms.hpp"

namespace soilbin::bekker_wong {
namespace {

constexpr Presumption lug_height = {
    .key = "lugs.height",
    .name = "lug height",
    .unit = "mm",
    .rule = "5 % of the radius",
    .declared = [](const Tire& t) { return is_lugged(t) ? std::optional<double>(t.lugs.height) : std::nullopt; },
    .presumed = [](const Tire& t) { return 0.05 * t.radius; },
    .else_do = "leave the effect out for a wheel without lugs"};

constexpr Presumption lug_count = {
    .key = "lugs.count",
    .name = "number of lugs",
    .unit = "-",
    .rule = "24",
    .declared = [](const Tire& t) { return t.lugs.count ? std::optional<double>(*t.lugs.count) : std::nullopt; },
    .presumed = [](const Tire&) { return 24.0; }};

double spacing(const Tire& tire) { return 2 * std::numbers::pi * tire.radius / lug_count(tire); }

enum class SlipOf { tread_base, shear_circle };

/// The soil shears on R_s = r + lambda_s h, which is the torque's arm too. By the conventions slip is that of the tread
/// base: j_x = R_s (theta_1 - theta) - r v_x/(r w) (sin theta_1 - sin theta). Slip counted at R_s scales both terms.
template <SlipOf slip>
class ShearRadius final : public Effect {
 public:
  explicit ShearRadius(const std::vector<double>& p) : share_(p[0]) {}
  void outline(Outline& outline, const Surroundings& around) const override {
    const double beyond = share_ * lug_height(around.tire);
    outline.shear_radius += beyond;
    if (slip == SlipOf::shear_circle) outline.slip_radius += beyond;
  }

 private:
  double share_;
};

/// Bekker's factors for the soil sheared on the sides of the lugs.
class SideFactors final : public Effect {
 public:
  explicit SideFactors(const std::vector<double>& p) : share_(p[0]) {}
  void strength(ContactPatch& patch, const SoilValues& soil, const Outline& outline,
                const Surroundings& around) const override {
    const double ratio = share_ * lug_height(around.tire) / outline.width;
    const double acot = std::numbers::pi / 2 - std::atan(ratio);
    const double cohesive = 2 * ratio * soil.cohesion;
    const double frictional = 0.64 * ratio * acot * std::tan(soil.friction_angle);
    for (int i = 0; i < patch.count; ++i) patch.strength[i] += cohesive + frictional * patch.sigma[i];
  }

 private:
  double share_;
};

/// Passive force on the faces of the lugs in contact, spread over their spacing; the shear displacement mobilises it as
/// it does the soil's strength. With the surcharge the soil before a face carries the wheel's pressure at that place.
template <bool with_surcharge>
class Blade final : public Effect {
 public:
  explicit Blade(const std::vector<double>& p) : share_(p[0]) {}
  void added_forces(ForceLedger& ledger, const Rolling& r) const override {
    if (share_ == 0.0) return;
    const double h = share_ * lug_height(r.around.tire);
    const double lugs_per_metre = r.outline.width / spacing(r.around.tire);
    const WallResistance face = passive_wall(r.soil);
    AddedForce force{.name = "lug_thrust"};
    for (int i = 0; i < r.patch.count; ++i) {
      const double j = std::hypot(r.patch.j_x[i], r.patch.j_y[i]);
      if (!(j > 0.0)) continue;
      const double surcharge = with_surcharge ? r.patch.sigma[i] : 0.0;
      const double push =
          lugs_per_metre * r.patch.arc[i] * face(h, surcharge) * r.patch.mobilised[i] * r.patch.j_x[i] / j;
      force.forward += push * r.patch.normal_cosine[i];
      force.vertical += push * r.patch.normal_sine[i];
      force.torque += push * (r.patch.arm[i] + 0.5 * h);
    }
    ledger.add(force);
  }

 private:
  double share_;
};

/// The faces push straight back, as a track's do: called up by the way that the tread slides from the entry on, under
/// the soil that lies on each. Nothing at no slip, a drag where braked.
class LevelBlade final : public Effect {
 public:
  explicit LevelBlade(const std::vector<double>& p) : share_(p[0]) {}
  bool lifts() const override { return false; }
  void added_forces(ForceLedger& ledger, const Rolling& r) const override {
    const Kinematics& motion = r.around.motion;
    const double slide = motion.rim() - motion.forward;  // of the tread, over its way rolled
    if (share_ == 0.0 || slide == 0.0) return;
    const double h = share_ * lug_height(r.around.tire), radius = r.outline.radius;
    const double lugs_per_metre = r.outline.width / spacing(r.around.tire), weight = specific_weight(r.soil);
    const Rim rim(r);
    const WallResistance face = passive_wall(r.soil);
    AddedForce force{.name = "lug_thrust"};
    for (int i = 0; i < r.patch.count; ++i) {
      const Edge e = rim.at(i);
      const double way = std::abs(slide) * radius * r.patch.since_entry[i] / r.patch.modulus[i];
      const double push = std::copysign(lugs_per_metre * r.patch.arc[i] * face(h, weight * e.depth), slide) *
                          (motion.locked ? 1.0 : -std::expm1(-way));
      force.forward += push;
      force.torque += push * e.cosine * (r.patch.arm[i] + 0.5 * h);
    }
    ledger.add(force);
  }

 private:
  double share_;
};

}  // namespace

std::vector<EffectForm> lug_thrust_forms() {
  const std::string id = "lug_thrust";
  const std::string meaning = "share of the lug height that acts";
  const std::vector<Presumption> of_height = {lug_height}, of_faces = {lug_height, lug_count};
  return {
      {.id = id,
       .form = "shear_radius",
       .equation = "R_s = r + lambda_s h: shear surface and torque's arm; slip counted at the tread base",
       .source = "after Ding, Gao, Deng, Nagatani, Yoshida 2011, J. Terramechanics 48:27 (equivalent shearing radius)",
       .parameters = {{"lambda_s", "-", 0.5, 0.0, 4.0, meaning}},
       .presumes = of_height,
       .make = maker<ShearRadius<SlipOf::tread_base>>()},
      {.id = id,
       .form = "shear_radius_own_slip",
       .equation = "R_s = r + lambda_s h: shear surface and torque's arm; slip counted at R_s",
       .source = "after Ding, Gao, Deng, Nagatani, Yoshida 2011, J. Terramechanics 48:27, with the slip of their wheel",
       .parameters = {{"lambda_s", "-", 0.5, 0.0, 4.0, meaning}},
       .presumes = of_height,
       .make = maker<ShearRadius<SlipOf::shear_circle>>()},
      {.id = id,
       .form = "side_factors",
       .equation = "tau_max = c (1 + 2 h/b) + sigma tan(phi) [1 + 0.64 (h/b) acot(h/b)], h = a h_lug",
       .source = "after Bekker 1969, Introduction to Terrain-Vehicle Systems (thrust of a spud), taken per unit area",
       .parameters = {{"a", "-", 1.0, 0.0, 10.0, meaning}},
       .presumes = of_height,
       .make = maker<SideFactors>()},
      {.id = id,
       .form = "passive_blade",
       .equation =
           "F = b (gamma h^2 N_phi/2 + sigma h N_phi + 2 c h sqrt(N_phi)) a lug, times 1 - exp(-j/K), h = a h_lug",
       .source = "after Wong, Theory of Ground Vehicles, ch. 2 (passive earth pressure on a grouser with surcharge)",
       .parameters = {{"a", "-", 0.3, 0.0, 3.0, meaning}},
       .presumes = of_faces,
       .make = maker<Blade<true>>()},
      {.id = id,
       .form = "free_blade",
       .equation = "F = b (gamma h^2 N_phi/2 + 2 c h sqrt(N_phi)) a lug, times 1 - exp(-j/K), h = a h_lug",
       .source = "after Bekker 1956, Theory of Land Locomotion (passive pressure without surcharge)",
       .parameters = {{"a", "-", 1.0, 0.0, 10.0, meaning}},
       .presumes = of_faces,
       .make = maker<Blade<false>>()},
      {.id = id,
       .form = "level_blade",
       .equation =
           "F = b (gamma h^2 N_phi/2 + gamma d h N_phi + 2 c h sqrt(N_phi)) a lug at the depth d, straight back, "
           "times 1 - exp(-|s_t| x/K), s_t = s, braked s/(1 + s), x = r (theta_1 - theta), h = a h_lug",
       .source = "after Wong, Theory of Ground Vehicles, ch. 2 (passive earth pressure on a grouser), taken level",
       .parameters = {{"a", "-", 0.5, 0.0, 10.0, meaning}},
       .presumes = of_faces,
       .make = maker<LevelBlade>()},
  };
}

}  // namespace soilbin::bekker_wong
