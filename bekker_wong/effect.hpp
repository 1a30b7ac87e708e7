// An effect: a departure from the base model, such as slip sinkage, as a small value with its parameters and what it
// does at the joints, the places where the wheel model can be changed. It never names another effect.
//
//   const EffectList effects = make_effects({{.id = "slip_sinkage", .form = "linear", .parameters = {{"S", 1.2}}}});
//   RollingWheel(tire, soil_values, effects).roll(at).sinkage  // [m]
//
// A new one: its file effects/NAME.cpp; its line in effects/forms.hpp, effects/catalogue.cpp and effects/titles.cpp; a
// test; a line in docs/reference/effects.md. CONTRIBUTING.md has the details.
#pragma once

#include <array>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "bekker_wong/contact_patch.hpp"
#include "bekker_wong/kinematics.hpp"
#include "bekker_wong/presumption.hpp"
#include "scenario/scenario.hpp"

namespace soilbin::bekker_wong {

class Effect;

/// What an effect may look at.
struct Surroundings {
  const Tire& tire;            ///< with the condition's inflation pressure, where that tells one (tire_at)
  const SoilValues& declared;  ///< the soil before any effect
  const OperatingCondition& at;
  Kinematics motion;
  const std::optional<Bin>& bin;
  double normal_load = 0.0;   ///< share of the load normal to the ground [N]
  double stress_share = 1.0;  ///< of the stresses that soil pressed so deep gives: less where slip has dug the wheel in
  SoilValues soil = declared;                                   ///< the soil that acts: after the soil joint
  std::span<const std::shared_ptr<const Effect>> effects = {};  ///< all that act on this wheel
};

/// Fills sigma at the depths of a patch: the pressure law of the soil that acts, with what every effect makes of the
/// soil's depth and of the pressure there. Looks at depth, circle_depth and the angle of entry alone, so that a carcass
/// may ask how hard the soil presses at a depth which its tread has not reached.
void press(ContactPatch& patch, const Outline& outline, const Surroundings& around);

/// A force that an effect adds to the stress integrals, in the wheel's axes.
struct AddedForce {
  std::string_view name;  ///< of the budget's row; must outlive the result (a literal)
  double forward = 0.0;   ///< [N]
  double lateral = 0.0;   ///< [N], to the left
  double vertical = 0.0;  ///< [N], upward: carries load
  double torque = 0.0;    ///< [N m], adds to the driving torque needed
};

/// The added forces of one evaluation. Holds at most 16.
class ForceLedger {
 public:
  void add(const AddedForce& force);
  std::span<const AddedForce> rows() const { return {rows_.data(), count_}; }
  double vertical() const;

 private:
  std::array<AddedForce, 16> rows_;
  std::size_t count_ = 0;
};

/// The contact as the added forces see it: everything but the forces themselves.
struct Rolling {
  const Surroundings& around;
  const SoilValues& soil;  ///< after the soil joint
  const Outline& outline;  ///< after the outline joint
  const ContactPatch& patch;
  double sinkage = 0.0;  ///< z [m]
};

/// The four channels as instruments show them, in the axes that the condition asks for.
struct Reading {
  double drawbar_pull = 0.0, torque = 0.0, sinkage = 0.0, lateral_force = 0.0;
};

/// Where a reading keeps the traction_channels, in their order.
inline constexpr std::array<double Reading::*, 4> reading_members = {&Reading::drawbar_pull, &Reading::torque,
                                                                     &Reading::sinkage, &Reading::lateral_force};

/// What the pressure of the soil at a node follows from.
enum class PressureLaw {
  declared,  ///< the power law of the soil that acts
  by_depth,  ///< another law of the depth alone
  by_place,  ///< the depth, and where on the wheel the node is
};

/// Of all these effects together.
PressureLaw pressure_law(std::span<const std::shared_ptr<const Effect>> effects);

/// Joints of the wheel model, in the order in which they are called. Defaults do nothing.
class Effect {
 public:
  virtual ~Effect() = default;
  /// Once a condition: how the wheel moves, where that is not what the condition tells.
  virtual void motion(Kinematics&) const {}
  /// Once a condition: the soil's values.
  virtual void soil(SoilValues&, const Surroundings&) const {}
  /// Once a condition: radius, width, shear radius.
  virtual void outline(Outline&, const Surroundings&) const {}
  /// Every trial sinkage: theta_m and theta_2, from theta_1.
  virtual void angles(ContactAngles&, const Outline&, const Surroundings&) const {}
  /// Every trial sinkage: depth, normals, arcs, arms at the nodes (a carcass that flattens).
  virtual void geometry(ContactPatch&, const Outline&, const Surroundings&) const {}
  /// The share of the soil's stresses at which geometry leaves the tread this deep under the axle where the circle's
  /// lowest point lies so deep [m], 0 where both lie equally deep; nothing where geometry leaves the tread on the
  /// circle.
  virtual std::optional<double> stress_share([[maybe_unused]] double tread_depth, [[maybe_unused]] double circle_depth,
                                             const Outline&, const Surroundings&) const {
    return std::nullopt;
  }
  /// Depths at which the pressure law looks, from those of the tread: soil that was pressed before. In press.
  virtual void soil_depth(ContactPatch&, const Surroundings&) const {}
  /// sigma is filled; change it in place. In press: of the geometry only the depths and the angle of entry are there.
  virtual void pressure(ContactPatch&, const SoilValues&, const Outline&, const Surroundings&) const {}
  /// What soil_depth and pressure make of the pressure law; a carcass has closed forms of some.
  virtual PressureLaw pressure_law() const { return PressureLaw::declared; }
  /// strength and modulus are filled; change them in place.
  virtual void strength(ContactPatch&, const SoilValues&, const Outline&, const Surroundings&) const {}
  /// mobilised is filled from |j|/K; change it in place. displacement: |j| at the nodes [m].
  virtual void mobilise(ContactPatch&, [[maybe_unused]] std::span<const double> displacement, const SoilValues&,
                        const Surroundings&) const {}
  /// Forces beside the stress integrals.
  virtual void added_forces(ForceLedger&, const Rolling&) const {}
  /// Whether they may have a vertical part; the search for the balance leaves out those that have none.
  virtual bool lifts() const { return true; }
  /// After the balance: total sinkage from the one that balances the load [m]. Where an effect deepens it, forces are
  /// taken at the deeper position with the stresses scaled so that they still carry the load; a carcass gives way to
  /// the scaled ones.
  virtual double settle(double sinkage, const Rolling&) const { return sinkage; }
  /// What the rig's instruments make of it.
  virtual void sensor(Reading&, const Surroundings&) const {}
};

/// A parameter of an effect's form.
struct EffectParameter {
  std::string name;
  std::string unit;       ///< as in files: "-", "deg", "mm", "kPa", ...; values here are SI
  double fallback = 0.0;  ///< default [SI]
  double lower = 0.0;     ///< [SI]
  double upper = 0.0;     ///< [SI]
  std::string meaning;
  /// "moisture", "position" or "run" where this is a reference value about which the effect is centred: the loop then
  /// sets it to the campaign's mean. Empty for every other parameter.
  std::string centred_on = {};
  /// The spread of a parameter. A shape's (not the amplitude's): the sd about its default with which the loop fits it
  /// [SI]; 0: half the default or 1 % of its range. A reference value's: in half the campaign's range of that
  /// condition; 0: not fitted.
  double spread = 0.0;
  /// Whether the depth of the bin, where that is declared, is taken in place of this parameter.
  bool is_the_bins = false;
};

/// One form of an effect. parameters[0] is its amplitude: at 0 the form is the base model.
struct EffectForm {
  std::string id;  ///< of the catalogue
  std::string form;
  std::string equation;      ///< one line, plain text
  std::string source;        ///< paper and equation, "after X", or "stated"
  std::string meaning = {};  ///< for people, where the form says more than the effect's title; else empty
  std::vector<EffectParameter> parameters;
  bool measurement = false;  ///< an effect of the rig or the bed, not of the wheel on the soil
  /// How far nature may differ from this form, as a share of the effect: what a wrong form leaves over is not taken for
  /// a further effect. Small where the form is kinematics (a tilted bed), large where it is a fit (slip sinkage).
  double form_tolerance = 0.25;
  /// Why a wheel driven in time can't take this form; empty: it can (bekker_wong/transient).
  std::string steady_only = {};
  /// The values of the tire that the form reads and that a tire may leave out, each with what is taken instead.
  std::vector<Presumption> presumes = {};
  /// The values of the tire that the form reads where a tire has them, and does well without: "deflection".
  std::vector<std::string> tire_values = {};
  /// The conditions that the form reads, of those that only some effects do and about which no parameter is centred:
  /// "pass", "speed". Of a learned form: each of its variables.
  std::vector<std::string> conditions = {};
  /// Whether the sinkage of a later pass counts from the floor of the rut; else from the undisturbed surface.
  bool sinkage_from_rut_floor = false;
  std::function<std::unique_ptr<const Effect>(const std::vector<double>& parameters)> make;
};

/// Every form of every effect, in the catalogue's order. Built once.
const std::vector<EffectForm>& effect_catalogue();
/// The ids of its effects, each once, in its order.
std::vector<std::string> effect_ids();

/// Whether a form's answer depends on a condition ("pass", "speed", "moisture", "position", "run") or on a value of the
/// tire ("lugs", "lugs.count", "inflation_pressure", "deflection"), by what its description says. Where a question
/// leaves the condition out, the form changes nothing; for the tire's value it presumes one.
bool depends_on(const EffectForm& form, std::string_view key);

/// The form that a choice names. Throws InputError with the nearest right word for an unknown id, form or parameter,
/// and for a value outside its bounds.
const EffectForm& find_form(const EffectChoice& choice);

/// Whether one of these effects reads the tire's inflation pressure: the tire flattens. Throws InputError as find_form.
bool is_flexible(const std::vector<EffectChoice>& effects);

/// A parameter of a form. Throws InputError with the nearest right word for a name that it doesn't have.
const EffectParameter& find_parameter(const EffectForm& form, const std::string& name);

/// The effect that a choice names, with the form's defaults for what it leaves out.
std::unique_ptr<const Effect> make_effect(const EffectChoice& choice);

using EffectList = std::vector<std::shared_ptr<const Effect>>;
EffectList make_effects(const std::vector<EffectChoice>& choices);

}  // namespace soilbin::bekker_wong
