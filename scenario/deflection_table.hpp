// A tire maker's load-deflection table read off at a load and an inflation pressure: how far the tire gives way on firm
// flat ground. The stiffness W/f is interpolated, in the load and then in the pressure, so that a tire of stiffness
// K_0 + K_1 p is met exactly between the rows; outside the table that of its edge holds.
//
//   const DeflectionTable table{"data sheet", {{10e3, 150e3, 0.025}, {20e3, 150e3, 0.05}}};
//   deflection_of(table, 15e3, 150e3)   // 0.0375 [m]
#pragma once

#include "scenario/tire.hpp"

namespace soilbin {

/// The most rows of a table.
inline constexpr std::size_t most_deflection_rows = 1000;

/// f [m] under a load W [N], > 0, at an inflation pressure [Pa]. The table holds a row at least.
double deflection_of(const DeflectionTable& table, double load, double pressure);

/// Whether load and pressure lie between rows of the table: nothing is taken from its edge.
bool covers(const DeflectionTable& table, double load, double pressure);

/// "12 rows, 10 .. 40 kN, 150 .. 300 kPa".
std::string in_words(const DeflectionTable& table);

}  // namespace soilbin
