// What this program was built from.
#pragma once

#include <string>
#include <utility>
#include <vector>

namespace soilbin::cli {

/// Name and version of soilbin, the build, the compiler and each library.
std::vector<std::pair<std::string, std::string>> versions();

}  // namespace soilbin::cli
