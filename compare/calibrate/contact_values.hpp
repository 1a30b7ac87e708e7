// The numbers of a contact of grains that a calibration varies, by their names in files.
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

/// Puts values of factors, which are named as a contact's numbers, into that contact.
void put_values(GranularSoil& soil, ContactKind kind, const std::vector<Factor>& factors,
                const Eigen::VectorXd& values);

}  // namespace soilbin::compare
