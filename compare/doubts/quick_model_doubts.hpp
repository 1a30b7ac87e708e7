// What is doubtful in answers of resistive force theory and of the cone index: a part of the list of doubts
// (doubts.hpp).
#pragma once

#include <vector>

#include "compare/doubts/doubt.hpp"

namespace soilbin {
struct Scenario;
struct Soil;
namespace cone_index {
struct Mobility;
}
}  // namespace soilbin

namespace soilbin::compare {

/// What resistive force theory takes for a soil that does not declare its values, and what it can't know of it.
Doubts resistive_force_doubts(const Soil& soil);

/// What the model cone_index takes for a tire that does not declare it, where its relation was not tested, and what it
/// can't answer.
Doubts cone_index_doubts(const Scenario& scenario, const std::vector<OperatingCondition>& conditions);

/// A vehicle that does not drive all axles, a cone index taken for a rating, a verdict within its error, a pressure
/// that can't be told.
Doubts doubts(const cone_index::Mobility& mobility);

}  // namespace soilbin::compare
