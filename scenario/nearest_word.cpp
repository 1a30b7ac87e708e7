#include "scenario/nearest_word.hpp"

#include <algorithm>
#include <cctype>
#include <cstddef>

#include "scenario/source_text.hpp"

namespace soilbin {
namespace {

std::string lower(std::string word) {
  std::transform(word.begin(), word.end(), word.begin(), [](unsigned char c) { return std::tolower(c); });
  return word;
}

/// Insertions, deletions, substitutions and swaps of neighbours that turn a into b.
std::size_t distance(const std::string& a, const std::string& b) {
  const std::size_t n = a.size(), m = b.size();
  std::vector<std::vector<std::size_t>> d(n + 1, std::vector<std::size_t>(m + 1));
  for (std::size_t i = 0; i <= n; ++i) d[i][0] = i;
  for (std::size_t j = 0; j <= m; ++j) d[0][j] = j;
  for (std::size_t i = 1; i <= n; ++i)
    for (std::size_t j = 1; j <= m; ++j) {
      const std::size_t cost = a[i - 1] == b[j - 1] ? 0 : 1;
      d[i][j] = std::min({d[i - 1][j] + 1, d[i][j - 1] + 1, d[i - 1][j - 1] + cost});
      if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1])
        d[i][j] = std::min(d[i][j], d[i - 2][j - 2] + 1);
    }
  return d[n][m];
}

}  // namespace

std::string nearest_word(const std::string& word, const std::vector<std::string>& right) {
  constexpr std::size_t longest = 200;  // a word beyond this is no misspelling, and the table is quadratic
  if (word.size() > longest) return "";
  std::string best;
  std::size_t best_distance = std::min(word.size(), std::max<std::size_t>(2, word.size() / 3) + 1);
  for (const std::string& candidate : right) {
    if (candidate.size() > longest) continue;
    const std::size_t d = distance(lower(word), lower(candidate));
    if (d < best_distance) best = candidate, best_distance = d;
  }
  return best;
}

std::string did_you_mean(const std::string& word, const std::vector<std::string>& right) {
  const std::string near = nearest_word(word, right);
  return near.empty() ? "" : ", did you mean '" + near + "'?";
}

std::string listed(const std::vector<std::string>& words) {
  std::string text;
  for (const std::string& word : words) text += (text.empty() ? "" : ", ") + clipped(word);
  return text;
}

std::string none_of(const std::string& word, const std::vector<std::string>& right) {
  return "'" + clipped(word) + "' is none of " + listed(right) + did_you_mean(word, right);
}

}  // namespace soilbin
