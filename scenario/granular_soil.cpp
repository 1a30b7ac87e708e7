#include <fmt/core.h>

#include <utility>

#include "scenario/description.hpp"

namespace soilbin {

std::string wrong_in_cohesion(const GranularSoil& soil) {
  const std::pair<const char*, const ContactPair*> contacts[] = {{"grain_grain", &soil.grain_grain},
                                                                 {"grain_tire", &soil.grain_tire}};
  const bool jkr = soil.cohesion_law == GrainCohesion::jkr;
  for (const auto& [name, contact] : contacts) {
    if (jkr && contact->cohesion > 0)
      return fmt::format(
          "the cohesion of {} is an energy density, and cohesion_law jkr has a work of adhesion\n"
          "  hint: work_of_adhesion in J/m^2 in its place, or cohesion_law: linear",
          name);
    if (!jkr && contact->work_of_adhesion > 0)
      return fmt::format(
          "the work_of_adhesion of {} is read by cohesion_law jkr, and linear cohesion has an energy density\n"
          "  hint: cohesion_law: jkr, or 'cohesion' in kJ/m^3 in its place",
          name);
  }
  if (jkr && soil.grain_grain.work_of_adhesion == 0 && soil.grain_tire.work_of_adhesion == 0)
    return "cohesion_law jkr needs the work_of_adhesion of a contact, and none has one\n"
           "  hint: work_of_adhesion: 0.1 J/m^2 in grain_grain, or leave cohesion_law out";
  return "";
}

}  // namespace soilbin
