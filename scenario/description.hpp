// What each struct of a case looks like in a file, said once. The reader, the writer and the JSON Schema are visitors
// of these descriptions, so they can't drift apart.
//
// describe(visitor, std::type_identity<T>{}) calls, for each key of T in the order in which it is written:
//   visitor.text    (key, member, need, meaning)             a std::string
//   visitor.number  (key, member, measure, need, meaning)    a double or an Estimate, or an optional one
//   visitor.exponent(key, member, range, need, meaning)      the soil's n, on which later units depend
//   visitor.assumed_sd(key, member, meaning)                 a share of later values, their sd where they have none
//   visitor.integer (key, member, lowest, need, meaning)     an int or an optional one
//   visitor.choice  (key, member, need, meaning)             an enum or an optional one; its words: words_of
//   visitor.group   (key, member, need, meaning)             a struct with a description of its own, or an optional one
//   visitor.list    (key, member, need, meaning)             a std::vector of such structs
//   visitor.part    (key, member, need, meaning)             an optional soil: a mapping, a name of the library, a path
// `member` is a pointer to a data member. contradiction(T) names what is wrong between members, with a line
// "  hint: ..." behind it or without; "" for nothing.
#pragma once

#include <array>
#include <cstddef>
#include <functional>
#include <numbers>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
#include <variant>
#include <vector>

#include "scenario/quantity.hpp"
#include "scenario/scenario.hpp"
#include "scenario/soil_parameters.hpp"

namespace soilbin {

/// Whether a key may be left out; the member then keeps its default.
enum class Need { required, optional };

/// How files spell a value of an enum.
template <class E>
struct Word {
  std::string_view text;
  E value;
};

constexpr std::array<Word<LugPattern>, 4> words_of(std::type_identity<LugPattern>) {
  return {{{"straight", LugPattern::straight},
           {"chevron", LugPattern::chevron},
           {"slanted", LugPattern::slanted},
           {"staggered", LugPattern::staggered}}};
}

constexpr std::array<Word<Construction>, 2> words_of(std::type_identity<Construction>) {
  return {{{"bias_ply", Construction::bias_ply}, {"radial", Construction::radial}}};
}

constexpr std::array<Word<SlipBy>, 2> words_of(std::type_identity<SlipBy>) {
  return {{{"wheel_plane_speed", SlipBy::wheel_plane_speed}, {"travel_speed", SlipBy::travel_speed}}};
}

constexpr std::array<Word<ForceFrame>, 2> words_of(std::type_identity<ForceFrame>) {
  return {{{"travel", ForceFrame::travel}, {"wheel", ForceFrame::wheel}}};
}

constexpr std::array<Word<RollingResistance>, 4> words_of(std::type_identity<RollingResistance>) {
  using R = RollingResistance;
  return {{{"elastic_plastic", R::elastic_plastic},
           {"directional", R::directional},
           {"directional_with_twist", R::directional_with_twist},
           {"torsion_spring", R::torsion_spring}}};
}

constexpr std::array<Word<TwistingResistance>, 2> words_of(std::type_identity<TwistingResistance>) {
  return {{{"none", TwistingResistance::none}, {"marshall", TwistingResistance::marshall}}};
}

constexpr std::array<Word<GrainCohesion>, 2> words_of(std::type_identity<GrainCohesion>) {
  return {{{"linear", GrainCohesion::linear}, {"jkr", GrainCohesion::jkr}}};
}

constexpr std::array<Word<GrainShape>, 4> words_of(std::type_identity<GrainShape>) {
  return {{{"sphere", GrainShape::sphere},
           {"two_spheres", GrainShape::two_spheres},
           {"three_spheres", GrainShape::three_spheres},
           {"four_spheres", GrainShape::four_spheres}}};
}

/// The enum of a choice, which may be an optional one.
template <class Choice>
struct EnumOf {
  using type = Choice;
};
template <class E>
struct EnumOf<std::optional<E>> {
  using type = E;
};
template <class Choice>
using enum_of = typename EnumOf<Choice>::type;

/// All words of a choice, as files spell them.
template <class Choice>
std::vector<std::string> all_words() {
  using E = enum_of<Choice>;
  std::vector<std::string> all;
  for (const Word<E>& word : words_of(std::type_identity<E>{})) all.emplace_back(word.text);
  return all;
}

/// The value that a word names; nothing where the enum has no such word.
template <class E>
std::optional<E> value_named(std::string_view text) {
  for (const Word<E>& word : words_of(std::type_identity<E>{}))
    if (word.text == text) return word.value;
  return std::nullopt;
}

/// Largest yaw and (open) largest incline [rad].
inline constexpr double right_angle = std::numbers::pi / 2;
inline constexpr Range inclines{.lower = -right_angle, .upper = right_angle, .lower_open = true, .upper_open = true};
inline constexpr Range yaws{.lower = -right_angle, .upper = right_angle};
inline constexpr Range lug_angles{.lower = 0.0, .upper = 1.2};  ///< [rad]: 68.75 deg
inline constexpr Range fractions{.lower = 0.0, .upper = 1.0};

void describe(auto& v, std::type_identity<Lugs>) {
  v.number("height", &Lugs::height, Measure{"mm", zero_or_more}, Need::required,
           "from the tread base outward; 0 mm: smooth");
  v.integer("count", &Lugs::count, 1, Need::optional, "number around the circumference; staggered: on each side");
  v.number("thickness", &Lugs::thickness, Measure{"mm", above_zero}, Need::optional, "along the circumference");
  v.choice("pattern", &Lugs::pattern, Need::optional, "how the lugs run across the tread");
  v.number("angle", &Lugs::angle, Measure{"deg", lug_angles}, Need::optional,
           "between a bar and the axle; absent: 0.5 rad, and 0 of straight bars");
}

void describe(auto& v, std::type_identity<TireDeflection>) {
  using D = TireDeflection;
  v.number("load", &D::load, Measure{"kN", above_zero}, Need::required, "on the tire, on firm flat ground");
  v.number("pressure", &D::pressure, Measure{"kPa", zero_or_more}, Need::required, "of inflation");
  v.number("deflection", &D::deflection, Measure{"mm", above_zero}, Need::required,
           "by how much the axle comes nearer to the ground");
}

void describe(auto& v, std::type_identity<DeflectionTable>) {
  v.text("source", &DeflectionTable::source, Need::optional, "where the table comes from");
  v.list("rows", &DeflectionTable::rows, Need::required, "of one load, pressure and deflection each");
}

/// "at 150 kPa the tire deflects by 40 mm under 20 kN, ..."; "" for a table that can be read off.
std::string contradiction(const DeflectionTable& table);

/// The rows of a T that a file may also name as a CSV, whose columns are the keys of a row, each with its unit; nothing
/// for most structs.
template <class T>
inline constexpr std::nullptr_t rows_in_csv = nullptr;
template <>
inline constexpr std::vector<TireDeflection> DeflectionTable::*rows_in_csv<DeflectionTable> = &DeflectionTable::rows;

std::string contradiction(const Tire& tire);

void describe(auto& v, std::type_identity<Tire>) {
  v.text("name", &Tire::name, Need::optional, "what to call the wheel");
  v.text("source", &Tire::source, Need::optional, "where the wheel as a whole is described");
  v.number("radius", &Tire::radius, Measure{"mm", above_zero}, Need::required,
           "radius to the tread base, without lugs");
  v.number("width", &Tire::width, Measure{"mm", above_zero}, Need::required,
           "width of the tread; of a tire by its size alone the section's");
  v.group("lugs", &Tire::lugs, Need::optional, "lugs or grousers; absent: smooth");
  v.number("inflation_pressure", &Tire::inflation_pressure, Measure{"kPa", zero_or_more}, Need::optional,
           "read by the effect tire_flexibility alone; without it the wheel is rigid");
  v.number("carcass_pressure", &Tire::carcass_pressure, Measure{"kPa", zero_or_more}, Need::optional,
           "pressure that the carcass itself carries (Wong's p_c)");
  v.group("deflection", &Tire::deflection, Need::optional,
          "the maker's load-deflection table: a CSV with columns such as load_kN, pressure_kPa, deflection_mm");
  v.number("section_height", &Tire::section_height, Measure{"mm", above_zero}, Need::optional,
           "from the rim to the tread; read by the model cone_index alone");
  v.choice("construction", &Tire::construction, Need::optional,
           "how its plies run; read by the model cone_index alone");
}

void describe(auto& v, std::type_identity<SemiEmpiricalSoil>) {
  using S = SemiEmpiricalSoil;
  for (const SoilParameter& p : soil_parameters) {
    const bool usual = p.value == &S::stress_angle_c1 || p.value == &S::stress_angle_c2;
    if (p.value == &S::exponent)
      v.exponent(p.name, p.value, p.range, Need::required, p.meaning);
    else
      v.number(p.name, p.value, p.measure(), usual ? Need::optional : Need::required, p.meaning);
    if (p.value == &S::exponent)  // k_c and k_phi belong to one n, so that their shares stand for the stiffness alone
      v.assumed_sd("assumed_sd", &S::assumed_sd,
                   "share of a value below n that is its sd where it has none: an assumption; absent: exact");
  }
  for (const ExactSoilValue& exact : exact_soil_values)
    v.number(exact.name, exact.value, exact.measure(), Need::optional, exact.meaning);
}

/// What a file may leave out of a soil, and what is then taken. `given`: whether it holds a key.
inline void fill_in(SemiEmpiricalSoil& soil, const std::function<bool(const char*)>& given) {
  const auto usual = [&](const char* key, Estimate SemiEmpiricalSoil::*value, const Estimate& taken) {
    if (!given(key)) soil.*value = taken, soil.sources[key] = usual_stress_angle_source;
  };
  usual("stress_angle_c1", &SemiEmpiricalSoil::stress_angle_c1, usual_stress_angle_c1);
  usual("stress_angle_c2", &SemiEmpiricalSoil::stress_angle_c2, usual_stress_angle_c2);
}

void describe(auto& v, std::type_identity<ContactPair>) {
  v.number("restitution", &ContactPair::restitution, Measure{"-", fractions}, Need::required,
           "speed after a collision over the speed before");
  v.number("sliding_friction", &ContactPair::sliding_friction, Measure{"-", zero_or_more}, Need::required,
           "coefficient of sliding friction");
  v.number("rolling_friction", &ContactPair::rolling_friction, Measure{"-", zero_or_more}, Need::required,
           "coefficient of rolling friction");
  v.number("rolling_damping", &ContactPair::rolling_damping, Measure{"-", fractions}, Need::optional,
           "dashpot of rolling, a share of critical; 0: grains rock on. Of elastic_plastic alone");
  v.number("cohesion", &ContactPair::cohesion, Measure{"kJ/m^3", zero_or_more}, Need::optional,
           "energy density of linear cohesion: attraction over the contact's area; 0: none");
  v.number("rolling_stiffness", &ContactPair::rolling_stiffness, Measure{"N m", zero_or_more}, Need::optional,
           "couple a radian of rolling; of torsion_spring alone");
  v.number("work_of_adhesion", &ContactPair::work_of_adhesion, Measure{"J/m^2", zero_or_more}, Need::optional,
           "w of cohesion_law jkr, which pulls two grains apart with (3/2) pi w R* at most; 0: none");
}

void describe(auto& v, std::type_identity<GrainFraction>) {
  v.number("radius", &GrainFraction::radius, Measure{"mm", above_zero}, Need::required,
           "of its grains; of a sieve fraction half the geometric mean of its two openings");
  v.number("share", &GrainFraction::share, Measure{"%", {.lower = 0.0, .upper = 1.0, .lower_open = true}},
           Need::required, "of the mass of all grains");
}

void describe(auto& v, std::type_identity<GranularSoil>) {
  using G = GranularSoil;
  v.number("radius_min", &G::radius_min, Measure{"mm", above_zero}, Need::optional,
           "smallest grain radius; needed where there are no sizes");
  v.number("radius_max", &G::radius_max, Measure{"mm", above_zero}, Need::optional,
           "largest grain radius; needed where there are no sizes");
  v.list("sizes", &G::sizes, Need::optional, "in place of both radii: fractions of one size each, smallest first");
  v.number("grain_density", &G::grain_density, Measure{"kg/m^3", above_zero}, Need::required,
           "density of a grain, not of the bed");
  v.number("gravity", &G::gravity, Measure{"m/s^2", above_zero}, Need::optional, gravity_meaning);
  v.number("youngs_modulus", &G::youngs_modulus, Measure{"MPa", above_zero}, Need::required, "E of a grain");
  v.number("poisson_ratio", &G::poisson_ratio, Measure{"-", {.lower = -1.0, .upper = 0.5, .lower_open = true}},
           Need::required, "nu of a grain");
  v.choice("rolling_resistance", &G::rolling_resistance, Need::optional,
           "how grains resist rolling; directional: the answer depends on the time step");
  v.choice("twisting_resistance", &G::twisting_resistance, Need::optional,
           "how grains resist spin about the normal of their contact");
  v.choice("cohesion_law", &G::cohesion_law, Need::optional,
           "how grains pull each other together: linear by 'cohesion' of a contact, jkr by its 'work_of_adhesion'");
  v.choice("shape", &G::shape, Need::optional,
           "what a grain is made of: a sphere, or several joined in a row, a triangle, a tetrahedron; radii are then "
           "those of the sphere of its volume");
  v.number("sphere_spacing", &G::sphere_spacing, Measure{"-", {.lower = 0.1, .upper = 2.0}}, Need::optional,
           "between the centres of a grain's spheres, in their radii; read where a grain has several");
  v.group("grain_grain", &G::grain_grain, Need::required, "contact of two grains");
  v.group("grain_tire", &G::grain_tire, Need::required, "contact of a grain and the tire");
}

/// Sets the radii that follow from `sizes`.
void fill_in(GranularSoil& soil, const std::function<bool(const char*)>& given);

/// grain_sizes.hpp
std::string wrong_in_sizes(const GranularSoil& soil);

/// Each law of cohesion has a value of its own, in a unit of its own; "" where they go together.
std::string wrong_in_cohesion(const GranularSoil& soil);

inline std::string contradiction(const GranularSoil& soil) {
  if (const std::string wrong = wrong_in_cohesion(soil); !wrong.empty()) return wrong;
  if (const std::string wrong = wrong_in_sizes(soil); !wrong.empty()) return wrong;
  const bool stiff = soil.grain_grain.rolling_stiffness > 0 || soil.grain_tire.rolling_stiffness > 0;
  if (stiff != (soil.rolling_resistance == RollingResistance::torsion_spring))
    return "rolling_stiffness and rolling_resistance torsion_spring belong together";
  return "";
}

void describe(auto& v, std::type_identity<ResistiveForceSoil>) {
  v.number("xi_n", &ResistiveForceSoil::xi_n, Measure{"kN/m^3", above_zero}, Need::required,
           "stress per depth, over the response of resistive force theory; a level plate bears 0.875 of it");
  v.number("surface_friction", &ResistiveForceSoil::surface_friction, Measure{"-", zero_or_more}, Need::required,
           "coefficient of friction between soil and wheel");
}

void describe(auto& v, std::type_identity<Soil>) {
  v.text("name", &Soil::name, Need::optional, "what to call the soil");
  v.text("source", &Soil::source, Need::optional, "where the soil as a whole is described");
  v.number("moisture", &Soil::moisture, Measure{"%", fractions}, Need::optional, "water content by mass");
  v.number("density", &Soil::bed_density, Measure{"kg/m^3", above_zero}, Need::optional,
           "of the bed that is asked about, where 'beds' holds several");
  v.group("semi_empirical", &Soil::semi_empirical, Need::optional, "values of the Bekker / Wong-Reece model");
  v.list("beds", &Soil::beds, Need::optional,
         "the same at several densities, loosest first; without 'semi_empirical' its values are those at 'density'");
  v.group("granular", &Soil::granular, Need::optional, "grains of the discrete element model");
  v.group("resistive_force", &Soil::resistive_force, Need::optional, "values of resistive force theory (model rft)");
  v.number("cone_index", &Soil::cone_index, Measure{"kPa", above_zero}, Need::optional,
           "of fine-grained soil: mean over the first 150 mm or so (model cone_index)");
  v.number("cone_index_gradient", &Soil::cone_index_gradient, Measure{"MPa/m", above_zero}, Need::optional,
           "of sand: by how much the cone index grows with depth (model cone_index)");
}

/// "'beds' needs two or more"; "" for a soil without beds, or with beds that say what it is at its density (beds.hpp).
std::string wrong_in_beds(const Soil& soil);

/// Puts the values of the bed that is asked about into a soil that has several and no values of its own.
void fill_in(Soil& soil, const std::function<bool(const char*)>& given);

inline std::string contradiction(const Soil& soil) {
  if (const std::string wrong = wrong_in_beds(soil); !wrong.empty()) return wrong;
  if (!soil.semi_empirical && !soil.granular && !soil.resistive_force && !soil.cone_index && !soil.cone_index_gradient)
    return "a soil needs 'semi_empirical', 'granular', 'resistive_force', 'cone_index' or 'cone_index_gradient'";
  if (soil.cone_index && soil.cone_index_gradient)
    return "'cone_index' is of fine-grained soil and 'cone_index_gradient' of sand: give one of them";
  if (soil.semi_empirical && soil.granular && soil.semi_empirical->gravity != soil.granular->gravity)
    return "gravity must be the same in 'semi_empirical' and in 'granular'";
  return "";
}

void describe(auto& v, std::type_identity<Bin>) {
  v.number("depth", &Bin::depth, Measure{"m", above_zero}, Need::required, "depth of the soil over the bin's floor");
  v.number("width", &Bin::width, Measure{"m", above_zero}, Need::required, "inner width");
}

void describe(auto& v, std::type_identity<OperatingCondition>) {
  using C = OperatingCondition;
  v.number("load", &C::load, Measure{"N", above_zero}, Need::required,
           "vertical load on the axle, weight of the wheel included");
  v.number("slip", &C::slip, Measure{"-", {.lower = -1.0, .upper = 1.0}}, Need::required, "positive drives");
  v.number("speed", &C::speed, Measure{"m/s", zero_or_more}, Need::optional, "forward speed of the axle");
  v.number("longitudinal_incline", &C::longitudinal_incline, Measure{"deg", inclines}, Need::optional,
           "uphill positive");
  v.number("transverse_incline", &C::transverse_incline, Measure{"deg", inclines}, Need::optional,
           "cross slope, left side up positive");
  v.number("yaw", &C::yaw, Measure{"deg", yaws}, Need::optional,
           "positive: the wheel points to the left of its travel");
  v.integer("pass", &C::pass, 1, Need::optional, "1: undisturbed soil");
  v.number("inflation_pressure", &C::inflation_pressure, Measure{"kPa", zero_or_more}, Need::optional,
           "of the tire; absent: the tire's own");
  v.choice("slip_by", &C::slip_by, Need::optional, "the speed from which slip is computed");
  v.choice("force_frame", &C::force_frame, Need::optional, "axes of drawbar pull and lateral force");
  v.number("moisture", &C::moisture, Measure{"%", fractions}, Need::optional, "water content by mass");
  v.number("position", &C::position, Measure{"m", any_value}, Need::optional, "mean distance along the bin");
  v.integer("run", &C::run, 0, Need::optional, "order in which the runs were made");
}

/// Members that can't stand together, in words; "" for most structs.
template <class T>
std::string contradiction(const T&) {
  return "";
}

/// Sets what a mapping left out and a plain default can't stand for; nothing for most structs.
template <class T>
void fill_in(T&, const std::function<bool(const char*)>&) {}

/// The keys of T's description, in order.
template <class T>
std::vector<std::string> keys_of();

namespace description_detail {

struct KeyList {
  std::vector<std::string> keys;
  void text(const char* key, const auto&...) { keys.emplace_back(key); }
  void number(const char* key, const auto&...) { keys.emplace_back(key); }
  void exponent(const char* key, const auto&...) { keys.emplace_back(key); }
  void assumed_sd(const char* key, const auto&...) { keys.emplace_back(key); }
  void integer(const char* key, const auto&...) { keys.emplace_back(key); }
  void choice(const char* key, const auto&...) { keys.emplace_back(key); }
  void group(const char* key, const auto&...) { keys.emplace_back(key); }
  void list(const char* key, const auto&...) { keys.emplace_back(key); }
  void part(const char* key, const auto&...) { keys.emplace_back(key); }
};

template <class On>
struct EachNumberOrChoice {
  const On& on;
  void number(const char* key, auto member, const Measure& measure, Need, const char* meaning) const {
    on(key, member, measure, meaning);
  }
  void integer(const char* key, auto member, int lowest, Need, const char* meaning) const {
    on(key, member, lowest, meaning);
  }
  void choice(const char* key, auto member, Need, const char* meaning) const {
    on(key, member, std::monostate(), meaning);
  }
  void text(const auto&...) const {}
  void group(const auto&...) const {}
};

}  // namespace description_detail

/// For who treats members of T alike: calls on(key, member, limits, meaning) for each number, whole number and choice,
/// in order; texts and groups are left out. `limits` is the measure of a number, the least of a whole one, a
/// std::monostate of a choice. T's description has nothing else.
template <class T, class On>
void each_member(const On& on) {
  const description_detail::EachNumberOrChoice<On> visitor{on};
  describe(visitor, std::type_identity<T>{});
}

template <class T>
std::vector<std::string> keys_of() {
  description_detail::KeyList list;
  describe(list, std::type_identity<T>{});
  return list.keys;
}

}  // namespace soilbin
