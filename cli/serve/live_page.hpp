// The page of `soilbin serve`: controls, numbers and charts that live.js fills from /case and /estimate.
#pragma once

#include <string>
#include <vector>

#include "cli/serve/setup.hpp"
#include "compare/report/javascript.hpp"

namespace soilbin::cli {

/// Its script, style and body, from cli/serve/browser; made by the build.
std::vector<compare::EmbeddedFile> live_files();

/// Self-contained HTML with the reports' style, charts and d3; where d3 isn't installed the page says so, and shows
/// numbers without curves.
std::string live_page(const Setup& setup);

}  // namespace soilbin::cli
