#include "compare/report/page_card.hpp"

#include <fmt/core.h>

#include "scenario/errors.hpp"
#include "scenario/file_bytes.hpp"

namespace soilbin::compare {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t largest_page = 1U << 28U;  ///< [bytes]

/// The text from `begin` to `end`, both left out, or with both; "" where it isn't there.
std::string between(const std::string& text, const std::string& begin, const std::string& end, bool with_both = false) {
  const std::size_t first = text.find(begin);
  if (first == std::string::npos) return "";
  const std::size_t last = text.find(end, first + begin.size());
  if (last == std::string::npos) return "";
  if (with_both) return text.substr(first, last + end.size() - first);
  return text.substr(first + begin.size(), last - first - begin.size());
}

}  // namespace

PageCard page_card(const fs::path& page, const fs::path& from) {
  const std::string text = read_bytes(page, largest_page);
  PageCard card{fs::relative(page, from.parent_path().empty() ? fs::path(".") : from.parent_path()).generic_string(),
                between(text, "<title>", "</title>"), between(text, "<meta name=\"description\" content=\"", "\">"),
                between(text, "<svg class=\"plot\"", "</svg>", true)};
  if (card.title.empty())
    throw InputError(
        fmt::format("{}: no page of soilbin\n  hint: --report of compare, loop, reproduce and failure-map "
                    "writes one",
                    page.string()));
  return card;
}

}  // namespace soilbin::compare
