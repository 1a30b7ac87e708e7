// The library's rover wheel on its dry sand, for what is exported of it.
#pragma once

#include "scenario/case.hpp"
#include "scenario/library.hpp"

namespace soilbin::compare {

/// By the analytic wheel alone; conditions are each test's own.
inline Case rover_on_dry_sand() {
  const Library library({SOILBIN_SOURCE_DIR "/cases"});
  Case question;
  question.name = "rover";
  question.scenario.tire = find_tire("rover-wheel", library);
  question.scenario.soil = find_soil("dry-sand", library);
  question.study.models = {{ModelKind::bekker_wong, {}, "bekker_wong"}};
  return question;
}

}  // namespace soilbin::compare
