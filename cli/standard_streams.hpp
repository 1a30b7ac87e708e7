// Standard output and standard error as the command has them: what is printed can neither end the work nor drive the
// terminal. main() calls guard_standard_streams() first; fmt::print and its kind then write through the guards.
#pragma once

#include <string>

namespace soilbin::cli {

/// Opens the descriptors 0 to 2 that are closed, so that no file that is opened later takes their place; what is then
/// printed on a closed standard output still counts as not written. From here on
/// - what can't be written to standard error (a full disk, a reader that is gone) is dropped, and no error;
/// - both streams show control characters, but for tab and line feed, as "\u001b": a name from a file or of a file
///   can't move the cursor, colour or rename the window. In a JSON text that is the same character.
void guard_standard_streams();

/// Writes `text` in place of the line that the terminal of standard error shows.
void rewrite_line(const std::string& text);

}  // namespace soilbin::cli
