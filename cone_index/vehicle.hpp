// Does a wheeled vehicle get through soft fine-grained soil? Vehicle cone index for 1 and for 50 passes, mean maximum
// pressure, and what a soil's rating cone index leaves beyond them.
//
//   const Vehicle truck{.weight = 59.83e3, .axles = 2, .tires = 4, .tire_width = 0.3175, .tire_diameter = 0.9398,
//                       .clearance = 0.442, .power = 141.7e3};           // [N], [m], [W]
//   vehicle_cone_index(truck).one_pass                                   // 191.6e3 [Pa]
//   mobility_of(truck, Estimate{300e3, 30e3}).passages[0].go             // true: 300 kPa are enough for one pass
#pragma once

#include <array>
#include <cmath>
#include <map>
#include <optional>
#include <string>
#include <type_traits>

#include "scenario/description.hpp"
#include "scenario/source_text.hpp"
#include "scenario/yes_no.hpp"

namespace soilbin::cone_index {

enum class Transmission { automatic, manual };

constexpr std::array<Word<Transmission>, 2> words_of(std::type_identity<Transmission>) {
  return {{{"automatic", Transmission::automatic}, {"manual", Transmission::manual}}};
}

/// A self-propelled wheeled vehicle, all of whose tires are alike.
struct Vehicle {
  std::string name{}, source{};
  double weight = 0.0;                ///< [N], > 0
  int axles = 2;                      ///< >= 1
  std::optional<int> driven_axles{};  ///< absent: all
  int tires = 4;                      ///< at least one an axle
  double tire_width = 0.0;            ///< b [m], > 0, of the section
  double tire_diameter = 0.0;         ///< d [m], > 0, unloaded
  double clearance = 0.0;             ///< least height over the ground [m], >= 0
  double power = 0.0;                 ///< of the engine [W], > 0
  Transmission transmission = Transmission::automatic;
  YesNo chains = YesNo::no;
  std::optional<double> section_height{};  ///< h of the tire [m], > 0
  std::optional<double> deflection{};      ///< delta on firm ground [m], > 0, below h
  std::optional<double> mmp_factor{};      ///< K of the mean maximum pressure, over delta/d; absent: by rowlands_factor
  std::map<std::string, std::string> sources{};  ///< where single numbers come from, by key
};

inline constexpr const char* vehicle_format = "soilbin-vehicle/1";

void describe(auto& v, std::type_identity<Vehicle>) {
  v.text("name", &Vehicle::name, Need::optional, "what to call the vehicle");
  v.text("source", &Vehicle::source, Need::optional, "where it is described");
  v.number("weight", &Vehicle::weight, Measure{"kN", above_zero}, Need::required, "of the vehicle, loaded");
  v.integer("axles", &Vehicle::axles, 1, Need::required, "number of axles");
  v.integer("driven_axles", &Vehicle::driven_axles, 1, Need::optional, "how many of them are driven; absent: all");
  v.integer("tires", &Vehicle::tires, 1, Need::required, "number of tires on the ground");
  v.number("tire_width", &Vehicle::tire_width, Measure{"mm", above_zero}, Need::required, "of a tire's section");
  v.number("tire_diameter", &Vehicle::tire_diameter, Measure{"mm", above_zero}, Need::required,
           "of an unloaded tire, over the tread");
  v.number("clearance", &Vehicle::clearance, Measure{"mm", zero_or_more}, Need::required,
           "least height of the vehicle over the ground");
  v.number("power", &Vehicle::power, Measure{"kW", above_zero}, Need::required, "of the engine");
  v.choice("transmission", &Vehicle::transmission, Need::optional, "how gears are shifted");
  v.choice("chains", &Vehicle::chains, Need::optional, "whether the tires have chains on");
  v.number("section_height", &Vehicle::section_height, Measure{"mm", above_zero}, Need::optional,
           "of a tire, from the rim to the tread");
  v.number("deflection", &Vehicle::deflection, Measure{"mm", above_zero}, Need::optional,
           "of a tire on firm ground, under its share of the weight");
  v.number("mmp_factor", &Vehicle::mmp_factor, Measure{"-", above_zero}, Need::optional,
           "K of the mean maximum pressure, of its form over deflection by diameter; absent: by the driven axles");
}

std::string contradiction(const Vehicle& vehicle);

/// Reads a vehicle file (soilbin-vehicle/1). Throws InputError with file, line and column.
Vehicle parse_vehicle(const SourceText& source);

/// The parts of the mobility index [-].
struct MobilityFactors {
  double contact_pressure = 0.0;  ///< CPF = weight [lb]/(width [in] x outer radius [in] x number of tires)
  double weight = 0.0;            ///< WF, by the weight an axle X [kip]
  double tire = 0.0;              ///< TF = (10 + width [in])/100
  double grouser = 1.0;           ///< GF = 1.05 with chains
  double wheel_load = 0.0;        ///< WLF = weight [kip]/(2 axles)
  double clearance = 0.0;         ///< CF = clearance [in]/10
  double engine = 1.0;            ///< EF = 1.05 below 10 hp a short ton
  double transmission = 1.0;      ///< TrF = 1.05 with a manual transmission
};

/// What a vehicle needs of fine-grained soil:
///
///   MI = (CPF WF/(TF GF) + WLF - CF) EF TrF,
///   VCI1 [psi] = (11.48 + 0.2 MI - 39.2/(MI + 3.74)) DCF for MI <= 115, else 4.1 MI^0.446 DCF,
///   VCI50 [psi] = 28.23 + 0.43 MI - 92.67/(MI + 3.67),
///
/// MI after FM 5-430-00-1 (1994), chapter 7; VCI1 with its 3.74 and DCF = (0.15 h/delta)^0.25 from Priddy and
/// Willoughby (2006), J. Terramechanics 43; VCI50 as public codes have it, no primary source read. DCF is 1 where
/// deflection and section height are not both declared. For vehicles that drive all axles.
struct VehicleConeIndex {
  MobilityFactors factors;
  double mobility_index = 0.0;
  double deflection_factor = 1.0;  ///< DCF
  double one_pass = 0.0;           ///< VCI1 [Pa]
  double fifty_passes = 0.0;       ///< VCI50 [Pa]
};

/// Throws InputError for impossible numbers and where MI is 0 or less: the fits hold for more.
VehicleConeIndex vehicle_cone_index(const Vehicle& vehicle);

/// Rowland's mean maximum pressure under a wheeled vehicle,
///
///   MMP = K W/(2 m b^0.85 d^1.15 sqrt(delta/d)) [Pa],
///
/// 2 m the number of tires. The deflection over the diameter is Larminie's (1992, J. Terramechanics 29; its summary
/// read, not its formula), the exponents are as commonly quoted after Rowland (1975).
struct MeanMaximumPressure {
  double value = 0.0;   ///< [Pa]
  double factor = 0.0;  ///< K
  bool declared = false;
};
/// Nothing where the deflection is not declared, or where neither mmp_factor is nor section height and K are known.
std::optional<MeanMaximumPressure> mean_maximum_pressure(const Vehicle& vehicle);

/// Rowland's K where the deflection stands over the section height, MMP = K W/(2 m b^0.85 d^1.15 sqrt(delta/h)): 3.65
/// of two axles that are both driven, by axles and driven axles; as commonly quoted after Rowland (1975); no source
/// that we could read prints them. Over the diameter it is K sqrt(h/d). Nothing for a combination that is not in the
/// table.
std::optional<double> rowlands_factor(int axles, int driven);

/// So many passes over one place.
struct Passage {
  int passes = 1;
  double needed = 0.0;  ///< VCI [Pa]
  Estimate excess;      ///< rating cone index less that [Pa]
  bool go = false;      ///< the excess is 0 or more

  /// Whether one standard deviation turns the verdict.
  bool is_close() const { return excess.std_error > 0.0 && std::abs(excess.value) < excess.std_error; }
};

/// A vehicle on a soil.
struct Mobility {
  Vehicle vehicle;
  VehicleConeIndex index;
  std::optional<MeanMaximumPressure> pressure;
  std::optional<Estimate> rating{};                  ///< rating cone index: cone index times remolding index [Pa]
  std::optional<std::array<Passage, 2>> passages{};  ///< 1 and 50, where the rating is known
  bool rating_is_cone_index = false;                 ///< of a soil whose remolding index nobody told
};
Mobility mobility_of(const Vehicle& vehicle, const std::optional<Estimate>& rating);

}  // namespace soilbin::cone_index
