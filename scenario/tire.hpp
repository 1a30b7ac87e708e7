// A tire or rigid wheel as the soil meets it: outside dimensions, lugs and inflation pressure. Both models and every
// campaign describe their wheel with it.
//
//   const Tire rover{.name = "rover", .radius = 0.09, .width = 0.11,                   // [m], tread base without lugs
//                    .lugs = {.height = 0.01, .count = 24, .thickness = 0.002}};       // [m]
//   in_words(rover)  // "rover (r 90 mm, b 110 mm, 24 lugs of 10 mm)"
#pragma once

#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "scenario/estimate.hpp"
#include "scenario/operating_condition.hpp"

namespace soilbin {

/// How the lugs (grousers) run across the tread.
enum class LugPattern {
  straight,   ///< bars parallel to the axle
  chevron,    ///< two slanted bars that meet on the centre line
  slanted,    ///< bars over the whole width that all lean the same way
  staggered,  ///< slanted bars to both sides of the centre line, half a pitch apart: an agricultural drive tire's
};

/// Lugs of a tire or grousers of a rover wheel.
struct Lugs {
  double height = 0.0;       ///< h [m], from the tread base outward; 0 means smooth
  std::optional<int> count;  ///< number around the circumference, staggered: on each side; unknown in some campaigns
  std::optional<double> thickness;  ///< [m] along the circumference
  LugPattern pattern = LugPattern::straight;
  std::optional<double> angle = {};  ///< [rad] between a bar and the axle, where the pattern has one
};

/// How the plies of a pneumatic tire's carcass run. The model cone_index alone asks for it.
enum class Construction {
  bias_ply,  ///< crossed plies, belted or not
  radial,
};

/// One row of a tire maker's load-deflection table, measured on firm flat ground.
struct TireDeflection {
  double load = 0.0;        ///< W [N], > 0
  double pressure = 0.0;    ///< p_i [Pa], >= 0
  double deflection = 0.0;  ///< f [m], > 0
};

/// A tire maker's load-deflection table (scenario/deflection_table.hpp reads it off).
struct DeflectionTable {
  std::string source;  ///< the file that it was read from
  std::vector<TireDeflection> rows;
};

/// The key of Tire::carcass_pressure in files, and its name among the values that a fit found.
inline constexpr const char* carcass_pressure_key = "carcass_pressure";

/// The keys of Tire::deflection, Tire::construction and Tire::section_height in files.
inline constexpr const char* deflection_key = "deflection";
inline constexpr const char* construction_key = "construction";
inline constexpr const char* section_height_key = "section_height";

/// A wheel as the soil meets it. Radius and width belong to the tread base, without lugs.
struct Tire {
  std::string name;
  double radius = 0.0;  ///< r [m], > 0
  double width = 0.0;   ///< b [m], > 0
  Lugs lugs;
  std::optional<double> inflation_pressure;      ///< [Pa]; absent: rigid
  std::optional<Estimate> carcass_pressure;      ///< [Pa] pressure that the carcass itself carries (Wong's p_c)
  std::optional<DeflectionTable> deflection{};   ///< of firm ground, its maker's; absent: presumed by effects
  std::string source{};                          ///< where the wheel as a whole is described
  std::map<std::string, std::string> sources{};  ///< where single numbers come from, by key: "lugs.height"
  /// From the rim to the tread [m]; absent: the model cone_index, which alone reads it, assumes one.
  std::optional<double> section_height{};
  std::optional<Construction> construction{};  ///< absent: cone_index takes bias ply, and says so
};

/// To the tips of the lugs [m].
inline double outer_radius(const Tire& tire) { return tire.radius + tire.lugs.height; }

inline bool is_lugged(const Tire& tire) { return tire.lugs.height > 0.0; }

/// The tire as it rolls at a condition: with that condition's inflation pressure, where it tells one.
Tire tire_at(Tire tire, const OperatingCondition& at);

/// Inflation and carcass pressure together [Pa]: p_g, with which a tire presses on firm ground; nothing where the tire
/// declares no inflation pressure.
std::optional<double> declared_ground_pressure(const Tire& tire);

/// "24 lugs of 600 mm leave no gap ..." where count and thickness ask for more than the circumference of the tread
/// base, staggered lugs of both sides taken together; "" where they don't, or where either is not known.
std::string why_no_gaps(const Tire& tire);

/// "rover-wheel (r 90 mm, b 110 mm, smooth)".
std::string in_words(const Tire& tire);
/// The tire in words with a remark before the closing bracket.
std::string in_words(const Tire& tire, std::string_view remark);

}  // namespace soilbin
