// lug_thrust: lugs shear on a larger radius and push soil with their faces.
//
// A lug of height h raises what the tread can pull: it moves the shear surface out to a larger circle, shears soil on
// its sides, and pushes the soil behind its face. Every form rises with h/b or h/r; they differ in what the gain grows
// with: slip (shear_radius: already at s = 0), cohesion and load (side_factors), load (passive_blade), lug size alone
// (free_blade). In tips the lugs bear the load too: the tread base sinks less.
//
// The amplitude is the share of the lug height that acts. Lugs that the tire does not declare are presumed, so that an
// undeclared lug has a trace as well; tips takes declared ones alone.
//
// What lugs can give has three limits, each exact away from its corner and rounded there:
// - A lug acts as far as it is buried: where the tread base sinks by less than the lug height, by that depth.
// - The tread and its lugs together pull no more than the soil bears on the surface through the lugs' tips, where the
//   soil between them shears off: c A + N tan(phi), A = b L (r + h)/r over the contact's length L, and N the load on
//   it. shear_radius keeps within that by itself: it changes neither strength nor length.
// - Blades nearer to each other than the spacing rule of Skonieczny, Moreland and Wettergreen (2012, IROS, 5065: a
//   grouser meets the soil before the rim that follows it does) push no more than blades at that distance. Its
//   1/(1 - s) is left out: it lets fewer lugs do where the wheel slips, and this is the number that is never too many.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "bekker_wong/closed_forms.hpp"
#include "bekker_wong/earth_pressure.hpp"
#include "bekker_wong/effects/edge.hpp"
#include "bekker_wong/effects/forms.hpp"
#include "bekker_wong/node_functions.hpp"

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

/// A larger circle under a wheel without lugs is no lug.
constexpr Presumption own_lug_height = {.key = "lugs.height",
                                        .name = "lug height",
                                        .unit = "mm",
                                        .rule = "a smooth wheel",
                                        .declared = lug_height.declared,
                                        .presumed = [](const Tire&) { return 0.0; }};

constexpr Presumption lug_count = {
    .key = "lugs.count",
    .name = "number of lugs",
    .unit = "-",
    .rule = "24",
    .declared = [](const Tire& t) { return t.lugs.count ? std::optional<double>(*t.lugs.count) : std::nullopt; },
    .presumed = [](const Tire&) { return 24.0; }};

/// min(x, 1) for x >= 0, its corner rounded between 3/4 and 5/4.
double at_most_one(double x) {
  constexpr double round = 0.25;
  if (x <= 1 - round) return x;
  if (x >= 1 + round) return 1.0;
  const double short_of = 1 + round - x;
  return 1 - short_of * short_of / (4 * round);
}

/// min(x, 1)/x, the share of x that acts.
double acting_share(double x) { return x > 0.0 ? at_most_one(x) / x : 1.0; }

/// The lug height that is in the soil where the tread base sinks by this much [m].
double buried_height(const Tire& tire, double sinkage) {
  const double height = lug_height(tire);
  return height > 0.0 ? height * at_most_one(std::max(sinkage, 0.0) / height) : 0.0;
}

/// How far the tread base of a patch sinks [m].
double sinkage_of(const ContactPatch& patch, const Outline& outline) {
  const double sine = std::sin(0.5 * patch.angles.entry);
  return outline.radius * 2 * sine * sine - patch.deflection;
}

/// Widths of lugs on a metre of the contact: those that the tire has, or as many as the spacing rule lets push.
double lugs_per_metre(const Rolling& r) {
  const Tire& tire = r.around.tire;
  const double spacing = 2 * std::numbers::pi * tire.radius / lug_count(tire);
  const double tip = 1 + buried_height(tire, r.sinkage) / tire.radius, surface = 1 - r.sinkage / tire.radius;
  const double least = tire.radius * (std::sqrt(std::max(0.0, tip * tip - surface * surface)) -
                                      std::sqrt(std::max(0.0, 1 - surface * surface)));
  return r.outline.width / spacing * acting_share(least / spacing);
}

/// What the soil bears forward on the surface through the lugs' tips, per metre of width, and what the tread takes of
/// it: what is left is for the lugs [N/m].
class TipSurface {
 public:
  TipSurface(const SoilValues& soil, const Tire& tire, double sinkage)
      : cohesion_(soil.cohesion * (1 + buried_height(tire, sinkage) / tire.radius)),
        friction_(std::tan(soil.friction_angle)) {}
  /// A node with its shear stress in the wheel's plane.
  void add(const ContactPatch& patch, int i, double tau) {
    tread_ += patch.arc[i] * tau * patch.normal_cosine[i];
    borne_ +=
        patch.arc[i] *
        (cohesion_ + friction_ * (patch.sigma[i] * patch.normal_cosine[i] + std::max(0.0, tau * patch.normal_sine[i])));
  }
  /// The share of a thrust [N/m] that the soil lets act.
  double share_of(double thrust) const {
    const double left = borne_ - (thrust < 0.0 ? -tread_ : tread_);
    if (thrust == 0.0) return 1.0;
    return left > 0.0 ? acting_share(std::abs(thrust) / left) : 0.0;
  }

 private:
  double cohesion_, friction_, tread_ = 0.0, borne_ = 0.0;
};

/// The force of blades, as far as the soil lets it act.
AddedForce within_what_the_soil_bears(AddedForce force, const Rolling& r) {
  TipSurface surface(r.soil, r.around.tire, r.sinkage);
  for (int i = 0; i < r.patch.count; ++i) surface.add(r.patch, i, r.patch.tau_x[i]);
  const double share = surface.share_of(force.forward / r.outline.width);
  force.forward *= share, force.vertical *= share, force.torque *= share;
  return force;
}

enum class SlipOf { tread_base, shear_circle };

/// Bekker's, of the rigid wheel on the soil that acts: the outline is asked before there is a balance.
double static_sinkage(const Surroundings& around) {
  SoilValues soil = around.soil;
  soil.exponent = std::min(soil.exponent, 2.5);  // Bekker's formula ends at 3
  return bekker_static_sinkage(soil, around.tire.radius, around.tire.width, around.normal_load);
}

/// The soil shears on R_s = r + lambda_s h, which is the torque's arm too. By the conventions slip is that of the tread
/// base: j_x = R_s (theta_1 - theta) - r v_x/(r w) (sin theta_1 - sin theta). Slip counted at R_s scales both terms.
template <SlipOf slip>
class ShearRadius final : public Effect {
 public:
  explicit ShearRadius(const std::vector<double>& p) : share_(p[0]) {}
  void outline(Outline& outline, const Surroundings& around) const override {
    const double beyond = share_ * buried_height(around.tire, static_sinkage(around));
    outline.shear_radius += beyond;
    if (slip == SlipOf::shear_circle) outline.slip_radius += beyond;
  }

 private:
  double share_;
};

/// The wheel rolls on the circle r + lambda h, which presses on the soil, shears it and is the torque's arm; slip and
/// sinkage are those of the tread base. Ground too hard for the tips holds the tread base up: its sinkage is negative.
class Tips final : public Effect {
 public:
  explicit Tips(const std::vector<double>& p) : share_(p[0]) {}
  void outline(Outline& outline, const Surroundings& around) const override {
    outline.radius += beyond(around);
    outline.shear_radius += beyond(around);
  }
  void sensor(Reading& reading, const Surroundings& around) const override { reading.sinkage -= beyond(around); }

 private:
  double beyond(const Surroundings& around) const { return share_ * own_lug_height(around.tire); }
  double share_;
};

/// (1 - exp(-|j|/K)) j_x/|j| at each node; the direction alone where the wheel is locked.
void call_up(const ContactPatch& patch, const Kinematics& motion, ContactPatch::Array& forward) {
  ContactPatch::Array displacement;
  const std::span<double> j{displacement.data(), static_cast<std::size_t>(patch.count)};
  length(patch.of(&ContactPatch::j_x), patch.of(&ContactPatch::j_y), j);
  mobilised_share(j, patch.of(&ContactPatch::modulus), {forward.data(), j.size()});
  for (std::size_t i = 0; i < j.size(); ++i)
    forward[i] = j[i] > 0.0 ? (motion.locked ? 1.0 : forward[i]) * patch.j_x[i] / j[i] : 0.0;
}

/// Bekker's factors for the soil sheared on the sides of the lugs.
class SideFactors final : public Effect {
 public:
  explicit SideFactors(const std::vector<double>& p) : share_(p[0]) {}
  void strength(ContactPatch& patch, const SoilValues& soil, const Outline& outline,
                const Surroundings& around) const override {
    if (share_ == 0.0) return;
    const double sinkage = sinkage_of(patch, outline),
                 ratio = share_ * buried_height(around.tire, sinkage) / outline.width;
    const double acot = std::numbers::pi / 2 - std::atan(ratio);
    const double cohesive = 2 * ratio * soil.cohesion;
    const double frictional = 0.64 * ratio * acot * std::tan(soil.friction_angle);
    ContactPatch::Array forward;  // the share of its strength that each node calls up in the wheel's plane
    call_up(patch, around.motion, forward);
    TipSurface surface(soil, around.tire, sinkage);
    double sides = 0.0;
    for (int i = 0; i < patch.count; ++i) {
      surface.add(patch, i, patch.strength[i] * forward[i]);
      sides += patch.arc[i] * (cohesive + frictional * patch.sigma[i]) * forward[i] * patch.normal_cosine[i];
    }
    const double acts = surface.share_of(sides);
    for (int i = 0; i < patch.count; ++i) patch.strength[i] += acts * (cohesive + frictional * patch.sigma[i]);
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
    const double h = share_ * buried_height(r.around.tire, r.sinkage), density = lugs_per_metre(r);
    const WallResistance face = passive_wall(r.soil);
    AddedForce force{.name = "lug_thrust"};
    for (int i = 0; i < r.patch.count; ++i) {
      const double j = std::hypot(r.patch.j_x[i], r.patch.j_y[i]);
      if (!(j > 0.0)) continue;
      const double surcharge = with_surcharge ? r.patch.sigma[i] : 0.0;
      const double push = density * r.patch.arc[i] * face(h, surcharge) * r.patch.mobilised[i] * r.patch.j_x[i] / j;
      force.forward += push * r.patch.normal_cosine[i];
      force.vertical += push * r.patch.normal_sine[i];
      force.torque += push * (r.patch.arm[i] + 0.5 * h);
    }
    ledger.add(within_what_the_soil_bears(force, r));
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
    const double h = share_ * buried_height(r.around.tire, r.sinkage), radius = r.outline.radius;
    const double density = lugs_per_metre(r), weight = specific_weight(r.soil);
    const Rim rim(r);
    const WallResistance face = passive_wall(r.soil);
    AddedForce force{.name = "lug_thrust"};
    for (int i = 0; i < r.patch.count; ++i) {
      const Edge e = rim.at(i);
      const double way = std::abs(slide) * radius * r.patch.since_entry[i] / r.patch.modulus[i];
      const double push = std::copysign(density * r.patch.arc[i] * face(h, weight * e.depth), slide) *
                          (motion.locked ? 1.0 : -std::expm1(-way));
      force.forward += push;
      force.torque += push * e.cosine * (r.patch.arm[i] + 0.5 * h);
    }
    ledger.add(within_what_the_soil_bears(force, r));
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
       .form = "tips",
       .equation = "r + lambda h in place of r: pressure, shear and torque's arm; slip and sinkage of the tread base",
       .source = "stated: lugs so near to each other that they carry the wheel (docs/lab/calibration.md)",
       .parameters = {{"lambda", "-", 0.5, 0.0, 2.0, meaning}},
       .steady_only = "its circle lies outside the rim that a drive follows",
       .presumes = {own_lug_height},
       .make = maker<Tips>()},
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
