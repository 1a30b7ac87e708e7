// The numbers of grains that a calibration varies, by their names in files.
//
//   put_values(soil, ContactKind::grain_tire, {{"sliding_friction", 0.3, 0.9}}, values);
#pragma once

#include <Eigen/Dense>
#include <string>
#include <vector>

#include "compare/design/factor.hpp"
#include "scenario/soil.hpp"

namespace soilbin::compare {

/// A contact pair of a soil by its key in files: "grain_grain" or "grain_tire".
enum class ContactKind { grain_grain, grain_tire };
std::string key_of(ContactKind kind);

/// A contact's number by its name: "sliding_friction". Throws std::invalid_argument for an unknown one.
double& value_of(ContactPair& pair, const std::string& name);

/// A factor that is not the soil's but the specimen's: how it settles (docs/guide/element-tests.md).
inline constexpr const char* settling_friction_factor = "settling_friction";

/// Puts values of factors into a soil: youngs_modulus into its grains, a contact's numbers into that contact;
/// settling_friction is left aside. Throws std::invalid_argument for another name.
void put_values(GranularSoil& soil, ContactKind kind, const std::vector<Factor>& factors,
                const Eigen::VectorXd& values);

}  // namespace soilbin::compare
