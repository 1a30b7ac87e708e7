// Long work: how far it is, on standard error where that is a terminal; and a clean stop by Ctrl-C.
#pragma once

#include <stdexcept>
#include <string>

#include "compare/sweep/answers.hpp"

namespace soilbin::cli {

/// Thrown by a progress that shown_progress made, once Ctrl-C was pressed.
struct Interrupted : std::runtime_error {
  Interrupted() : std::runtime_error("interrupted") {}
};

/// From now on Ctrl-C is remembered; another one, a second later or more, ends the program at once.
void catch_interrupts();
/// Whether it was pressed.
bool interrupt_asked();

/// One line that takes the place of the last one, where standard error is a terminal.
void show_progress_line(const std::string& text);
/// Takes away the line that shows progress, where there is a terminal.
void clear_progress_line();

/// Stops at Ctrl-C. Shows the share done and the time left, once the work has taken longer than half a second.
compare::Progress shown_progress();

}  // namespace soilbin::cli
