// What this program was built from.
#pragma once

#include <string>
#include <utility>
#include <vector>

namespace soilbin::cli {

/// Name and version of soilbin, the build, the compiler and each library.
std::vector<std::pair<std::string, std::string>> versions();

/// State of the sources that this program was built from: the commit, with "-dirty" where they were changed since, or
/// "release VERSION" where they came without git.
std::string source_state();

/// All that a report of a fault needs, on one line: "soilbin 0.1.0 (commit 1a2b3c4d5e6f, Release, GNU 12.2.0)".
std::string version_line();

}  // namespace soilbin::cli
