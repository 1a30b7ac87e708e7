// A soil as Chrono's SCM terrain (Soil Contact Model after Krenn and Hirzinger) reads it: the file of JSON that its
// co-simulation node takes (ChVehicleCosimTerrainNodeSCM), whose section "Soil parameters" holds what
// SCMTerrain::SetSoilParameters is called with.
//
//   const Soil soil = parse_scm_soil(read_source_text("scm.json", largest_yaml));
//   soil.semi_empirical->k_phi.value   // [N/m^(n+2)], which SCM calls Kphi
#pragma once

#include <array>
#include <filesystem>
#include <string>

#include "scenario/soil.hpp"
#include "scenario/source_text.hpp"
#include "scenario/unit.hpp"

namespace soilbin {

/// A value that SCM and a semi-empirical soil share. SCM: p = (Kc/b + Kphi) z^n, with 1/b = perimeter/(2 area) of the
/// contact patch, and tau = (c + p tan phi) (1 - exp(-j/K)).
struct ScmParameter {
  const char* key;       ///< in "Soil parameters"
  const char* argument;  ///< of SetSoilParameters
  const char* unit;      ///< in which it stands there
  double per_si;         ///< units per SI unit
  const char* name;      ///< of the soil's parameter (soil_parameters.hpp)
};

/// In the order of the arguments; Kphi and Kc are in N/m^(n+2) and N/m^(n+1), as here.
inline constexpr std::array<ScmParameter, 6> scm_parameters = {{
    {"Bekker Kphi", "Bekker_Kphi", "N/m^(n+2)", 1.0, "k_phi"},
    {"Bekker Kc", "Bekker_Kc", "N/m^(n+1)", 1.0, "k_c"},
    {"Bekker n exponent", "Bekker_n", "-", 1.0, "exponent"},
    {"Mohr cohesive limit", "Mohr_cohesion", "Pa", 1.0, "cohesion"},
    {"Mohr friction limit", "Mohr_friction", "deg", 1 / degree, "friction_angle"},
    {"Janosi shear coefficient", "Janosi_shear", "m", 1.0, "shear_modulus"},
}};

/// What SCM needs beside them and a soil does not tell. Chosen: of the stiffness, that SCM takes Kphi where it is less,
/// so that it is well above: 20 times its number as in Chrono's example (4e7 to 2e6), and no less than SCM's default.
struct ScmChoices {
  double elastic_stiffness = 5e7;                         ///< of unloading and reloading, per area [Pa/m]
  double damping = 3e4;                                   ///< per area [Pa s/m]; Chrono's example
  double grid_spacing = 0.05, length = 4.0, width = 1.0;  ///< of the terrain [m]; Chrono's example
};
ScmChoices scm_choices(const SemiEmpiricalSoil& soil);

/// The soil of such a file, with // comments as Chrono's have them. The section "soilbin", where there is one, brings
/// what SCM has no place for: standard deviations, c1 and c2, density, gravity, sources; without it the values count as
/// exact, and c1 and c2 are the usual ones. Throws InputError with the place of what is no JSON, and for what is
/// missing, no number, or outside its range.
Soil parse_scm_soil(const SourceText& source);

/// Whether the file's name says that it is JSON.
bool names_json(const std::string& file);

/// Whether a file of JSON is one of Chrono's SCM terrain: it has the section "Soil parameters". False where it can't be
/// read.
bool is_scm_soil(const std::filesystem::path& file);

}  // namespace soilbin
