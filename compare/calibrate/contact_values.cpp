#include "compare/calibrate/contact_values.hpp"

#include <stdexcept>

namespace soilbin::compare {
namespace {

ContactPair& pair_of(GranularSoil& soil, ContactKind kind) {
  return kind == ContactKind::grain_grain ? soil.grain_grain : soil.grain_tire;
}

}  // namespace

std::string key_of(ContactKind kind) { return kind == ContactKind::grain_grain ? "grain_grain" : "grain_tire"; }

double& value_of(ContactPair& pair, const std::string& name) {
  if (name == "restitution") return pair.restitution;
  if (name == "sliding_friction") return pair.sliding_friction;
  if (name == "rolling_friction") return pair.rolling_friction;
  if (name == "cohesion") return pair.cohesion;
  if (name == "work_of_adhesion") return pair.work_of_adhesion;
  throw std::invalid_argument("a contact has no number '" + name + "'");
}

void put_values(GranularSoil& soil, ContactKind kind, const std::vector<Factor>& factors,
                const Eigen::VectorXd& values) {
  for (std::size_t j = 0; j < factors.size(); ++j) {
    const std::string& name = factors[j].name;
    if (name.starts_with(settling_friction_factor)) continue;
    (name == "youngs_modulus" ? soil.youngs_modulus : value_of(pair_of(soil, kind), name)) = values[j];
  }
}

}  // namespace soilbin::compare
