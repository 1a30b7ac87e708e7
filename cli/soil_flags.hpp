// Flags for a soil's own values: "--friction-angle 30deg", "--k-phi '1500+-200 kN/m^(n+2)'", named as in a soil file.
#pragma once

#include <CLI/CLI.hpp>
#include <map>
#include <string>

#include "scenario/soil.hpp"

namespace soilbin::cli {

class SoilFlags {
 public:
  /// Adds a flag for each of soil_parameters, and --density.
  void add_to(CLI::App& app, const std::string& heading);

  bool any_given() const;

  /// Puts the values that were given in place of the soil's. A value without "+-" (or "±") keeps the soil's standard
  /// deviation. The soil's name then ends in ", changed", and the values' source is the command line. Throws InputError
  /// that names the flag, or says that the soil has values for grains alone.
  void apply(Soil& soil) const;

 private:
  std::map<std::string, std::string> texts_;  ///< by the key of a soil file
};

}  // namespace soilbin::cli
