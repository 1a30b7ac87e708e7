// A link to another of our pages as a person sees it: a small drawing, the title, a line on what it answers; all taken
// from the page itself.
#pragma once

#include <filesystem>
#include <string>

namespace soilbin::compare {

struct PageCard {
  std::string href;     ///< from the page that links
  std::string title;    ///< of the linked page
  std::string line;     ///< its description: the first sentences that it says
  std::string drawing;  ///< its first <svg class="plot">; "" where it has none
};

/// Reads a page that Page::html made. `from` is the file that links to it. Throws InputError where there is no such
/// file or it is no such page.
PageCard page_card(const std::filesystem::path& page, const std::filesystem::path& from);

}  // namespace soilbin::compare
