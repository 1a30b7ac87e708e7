// What the page of a vehicle starts from, and the questions that its queries turn it into. A query speaks the flags of
// `soilbin vehicle`, and is read by the same code.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "cli/serve/query.hpp"
#include "cli/workplace.hpp"
#include "compare/vehicle/vehicle.hpp"

namespace soilbin::cli {

/// A vehicle on a soil, and the words that ask `soilbin` the same: {"vehicle", "truck", "--slope=5deg"}.
struct AskedVehicle {
  compare::VehicleCase question{};
  std::vector<compare::VehicleWheel> wheels{};  ///< with what their tires declare
  compare::Doubts notes{};                      ///< of what they declare
  std::vector<std::string> words{};
};

/// What is asked of a vehicle.
enum class AskedOf { steady_state, drive };

class VehicleSetup {
 public:
  /// Starts from a vehicle (a name, a path) and flags of `soilbin vehicle`. Throws InputError as that does. `place`
  /// must outlive this.
  VehicleSetup(const Workplace& place, std::string name, std::vector<Flag> flags);

  /// The start with the query's flags in place of its own; a soil that the query names comes without the start's
  /// changes to its values. Throws InputError: an unknown flag, a value that is wrong, a soil that is not of the
  /// library; for a drive also a flag that the file's drive leaves unread.
  AskedVehicle ask(const std::vector<Flag>& query, AskedOf what = AskedOf::steady_state) const;

  /// soilbin-serve/1: the numbers, choices, axles, soils and effects that a page moves; where each starts.
  nlohmann::ordered_json document() const;

  const Workplace& place() const { return place_; }

  /// The unit of the page's forces, by the start's weight: N or kN.
  const std::string& force_unit() const { return force_unit_; }

 private:
  const Workplace& place_;
  std::string name_, force_unit_;
  std::vector<Flag> start_;
};

}  // namespace soilbin::cli
