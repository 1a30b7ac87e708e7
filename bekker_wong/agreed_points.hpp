// Operating points that independent codes compute alike: what an installation's self-test and the tests of the base
// model hold it against.
#pragma once

#include <string>
#include <vector>

#include "bekker_wong/contact_patch.hpp"
#include "bekker_wong/effect.hpp"
#include "scenario/scenario.hpp"

namespace soilbin::bekker_wong {

/// A result as it is written, with half a unit of its last digit [SI].
struct RoundedValue {
  double value = 0.0, half_unit = 0.0;
};

/// One point, and what two independent codes make of it.
struct AgreedPoint {
  std::string name;
  std::string published;  ///< what of it stands in a publication: "inputs of Azimi and others 2013"; "": none
  Tire tire;
  SoilValues soil;
  std::vector<EffectChoice> effects;
  OperatingCondition at;
  RoundedValue sinkage, drawbar_pull, torque;  ///< [m], [N], [N m]
};

/// Every point, the light wheel first. No result of them is a publication's: two codes, neither of which is this one,
/// agree on them to the digits told.
const std::vector<AgreedPoint>& agreed_points();

/// The wheel's reading at the point.
Reading reading_at(const AgreedPoint& point);

/// Largest difference of the three results, in half units of the last digit told: up to 1 is agreement.
double worst_difference(const AgreedPoint& point, const Reading& reading);

}  // namespace soilbin::bekker_wong
