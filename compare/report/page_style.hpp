// The style sheet of a page. Used by page.cpp alone.
#pragma once

#include <string>

namespace soilbin::compare {

/// CSS for both colour schemes, the palettes of plot.hpp included.
std::string page_style();

}  // namespace soilbin::compare
