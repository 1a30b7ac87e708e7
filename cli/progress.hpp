// Long work: how far it is, on standard error where that is a terminal; and a clean stop by Ctrl-C.
#pragma once

#include <stdexcept>

#include "compare/sweep/answers.hpp"

namespace soilbin::cli {

/// Thrown by a progress that shown_progress made, once Ctrl-C was pressed.
struct Interrupted : std::runtime_error {
  Interrupted() : std::runtime_error("interrupted") {}
};

/// From now on Ctrl-C is remembered; a second one ends the program at once.
void catch_interrupts();
/// Whether it was pressed.
bool interrupt_asked();

/// Stops at Ctrl-C. Shows the share done and the time left, once the work has taken longer than half a second.
compare::Progress shown_progress();

}  // namespace soilbin::cli
