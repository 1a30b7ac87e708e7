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

}  // namespace soilbin::cli
