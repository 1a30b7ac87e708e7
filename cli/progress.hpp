// Long work: how far it is, on standard error; and a clean stop by Ctrl-C.
#pragma once

#include <functional>
#include <stdexcept>
#include <string>

#include "compare/sweep/answers.hpp"

namespace soilbin::cli {

/// Thrown by a progress that shown_progress made, once Ctrl-C was pressed.
struct Interrupted : std::runtime_error {
  Interrupted() : std::runtime_error("interrupted") {}
};

/// From now on Ctrl-C is remembered; another one, a second later or more, ends the program at once. Waits for other
/// processes (FileLock) are told, and end by it too. A file that grows too large is an error like any other.
void catch_interrupts();
/// Whether it was pressed.
bool interrupt_asked();

/// What is done now and about how long it takes. On a terminal: one line that takes the place of the last one, to be
/// called as often as one likes. Elsewhere, in a log say: a line of its own, the first after ten seconds of work, then
/// one a minute.
void show_progress_line(const std::string& text);
/// Takes away the line that shows progress, where there is a terminal.
void clear_progress_line();

/// Stops at Ctrl-C. Shows the share done and the time left (show_progress_line), once the work has taken longer than
/// half a second.
compare::Progress shown_progress();
/// Progress of work in time, shown as shown_progress shows it: how much of its duration is done [s].
std::function<void(double time, double duration)> shown_progress_in_time();

}  // namespace soilbin::cli
