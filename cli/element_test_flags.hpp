// Flags that element-test and bevameter share: the soil's grains and how a specimen of them is made.
#pragma once

#include <CLI/CLI.hpp>
#include <optional>
#include <string>
#include <vector>

#include "compare/doubts/doubt.hpp"
#include "compare/experiments/compression_curves.hpp"
#include "compare/experiments/plate_curves.hpp"
#include "dem/element_tests/bevameter_tests.hpp"
#include "scenario/soil.hpp"

namespace soilbin::cli {

/// The law of --rolling; `words` are those that the caller takes beside them. Throws InputError for any other.
RollingResistance rolling_named(const std::string& text, std::vector<std::string> words = {});

/// Flags as typed; empty: the default.
struct ElementTestFlags {
  std::string settling_friction, rolling;
  int packing = 1, threads = 0;
  double size = 1;

  void add_to(CLI::App& command);
  /// With the soil's own rolling resistance, where no flag gives another. Throws InputError that names the flag.
  dem::SpecimenSettings specimen(const GranularSoil& soil) const;
  dem::WorkOptions work() const;
  /// What is doubtful in the grains, under the law that the flag gives.
  compare::Doubts doubts(GranularSoil soil) const;
};

/// Measured tests of the laboratory: --curves, and which of the file's by --tests or --only.
struct MeasuredFlags {
  std::string file, tests;
  std::vector<std::string> only;

  void add_to(CLI::App& command, const char* meaning);
  bool given() const { return !file.empty(); }

  // Each throws InputError with file, line and hint, also for the other one's flag.
  std::vector<compare::CompressionCurve> triaxial() const;
  std::vector<compare::MeasuredPlate> plates() const;
};

/// Plates of the size that a field test has, --plate and --plate-sinkage; without them they are sized in grains.
struct PlateFlags {
  std::vector<std::string> diameters;
  std::string sinkage;

  void add_to(CLI::App& command);
  // Each throws InputError that names the flag.
  dem::PlateSettings plates(const GranularSoil& soil) const;
  std::optional<double> deepest() const;  ///< --plate-sinkage [m]; none: not given
};

/// The cone of element-test cone, --cone and --cone-depth; without them it is sized in grains.
struct ConeFlags {
  std::string diameter, depth;

  void add_to(CLI::App& command);
  /// In a bed that is deep enough. Throws InputError that names the flag.
  dem::ConeSettings cone(const GranularSoil& soil) const;
};

}  // namespace soilbin::cli
