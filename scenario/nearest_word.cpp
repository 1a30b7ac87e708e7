#include "scenario/nearest_word.hpp"

#include <algorithm>
#include <cctype>
#include <cstddef>
#include <ranges>
#include <string_view>
#include <utility>

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

/// Words that people use, and ours: flags, keys of files, effects and commands alike. Hyphens and underscores are one.
constexpr std::pair<std::string_view, std::string_view> words_of_the_field[] = {
    {"slope", "longitudinal_incline"},
    {"incline", "longitudinal_incline"},
    {"grade", "longitudinal_incline"},
    {"gradient", "longitudinal_incline"},
    {"pitch", "longitudinal_incline"},
    {"cross_slope", "transverse_incline"},
    {"side_slope", "transverse_incline"},
    {"bank", "transverse_incline"},
    {"slip_angle", "yaw"},
    {"steering", "yaw"},
    {"weight", "load"},
    {"mass", "load"},
    {"velocity", "speed"},
    {"pressure", "inflation_pressure"},
    {"grouser_height", "lug_height"},
    {"grouser_count", "lug_count"},
    {"grouser_thickness", "lug_thickness"},
    {"grousers", "lug_count"},
    {"grousers", "lugs"},
    {"grouser", "lug_thrust"},
    {"grousers", "lug_thrust"},
    {"lug", "lug_thrust"},
    {"lugs", "lug_thrust"},
    {"rut", "multipass"},
    {"tire_pressure", "tire_flexibility"},
    {"flexible", "tire_flexibility"},
    {"elastic_wheel", "tire_flexibility"},
    {"tire", "wheel"},
    {"tyre", "wheel"},
    {"wheel", "tire"},
    {"tyre", "tire"},
    {"pull", "drawbar_pull"},
    {"moment", "torque"},
    {"depth", "sinkage"},
    {"side_force", "lateral_force"},
    {"diameter", "radius"},
    {"gamma", "density"},
    {"unit_weight", "density"},
    {"phi", "friction_angle"},
    {"n", "exponent"},
    {"traction", "estimate"},
    {"fit", "loop"},
    {"fit", "plates"},
    {"identify", "loop"},
    {"incline", "limits"},
    {"incline", "failure-map"},
    {"slope", "limits"},
    {"climb", "limits"},
    {"map", "failure-map"},
    {"simulate", "run"},
    {"dem", "run"},
    {"show", "list"},
    {"validate", "check"},
};

/// With one spelling: "--lug-height" is "lug_height".
std::string one_spelling(const std::string& word) {
  std::string text = lower(word.starts_with("--") ? word.substr(2) : word);
  std::ranges::replace(text, '-', '_');
  return text;
}

}  // namespace

std::vector<std::string> meant_words(const std::string& word, const std::vector<std::string>& right) {
  std::vector<std::string> meant;
  const std::string said = one_spelling(word);
  for (const auto& [theirs, ours] : words_of_the_field) {
    if (said != theirs) continue;
    for (const std::string& candidate : right)
      if (one_spelling(candidate) == one_spelling(std::string(ours))) meant.push_back(candidate);
  }
  return meant;
}

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

namespace {

/// ", did you mean 'loop' or 'plates'?"
std::string meaning_one_of(const std::vector<std::string>& words) {
  if (words.empty()) return "";
  std::string text = ", did you mean '" + words.front();
  for (std::size_t i = 1; i < words.size(); ++i) text += (i + 1 < words.size() ? "', '" : "' or '") + words[i];
  return text + "'?";
}

/// "sandy-loam wet" as sandy, loam, wet.
std::vector<std::string> parts_of_name(const std::string& name) {
  std::vector<std::string> parts(1);
  for (const char c : lower(name))
    if (std::isalnum(static_cast<unsigned char>(c)))
      parts.back() += c;
    else if (!parts.back().empty())
      parts.emplace_back();
  if (parts.back().empty()) parts.pop_back();
  return parts;
}

/// How many of these words a name holds: 2 for each that is a part of it, 1 for each that begins one.
int words_held(const std::vector<std::string>& words, const std::string& name) {
  const std::vector<std::string> parts = parts_of_name(name);
  int held = 0;
  for (const std::string& word : words)
    if (std::ranges::find(parts, word) != parts.end())
      held += 2;
    else if (word.size() > 2)
      held += std::ranges::any_of(parts, [&](const std::string& part) { return part.starts_with(word); });
  return held;
}

}  // namespace

std::string did_you_mean_name(const std::string& name, const std::vector<std::string>& names) {
  if (const std::string near = did_you_mean(name, names); !near.empty()) return near;
  constexpr std::size_t most = 5, longest = 200;
  const std::vector<std::string> words = parts_of_name(name.substr(0, longest));
  std::vector<std::string> best;
  int held = 1;
  for (const std::string& candidate : names) {
    const int here = words_held(words, candidate);
    if (here > held) best.clear(), held = here;
    if (here == held) best.push_back(candidate);
  }
  std::ranges::stable_sort(best, {}, [](const std::string& one) { return parts_of_name(one).size(); });
  best.resize(std::min(best.size(), most));
  return meaning_one_of(best);
}

std::string did_you_mean(const std::string& word, const std::vector<std::string>& right) {
  if (const std::vector<std::string> meant = meant_words(word, right); !meant.empty()) return meaning_one_of(meant);
  const std::string near = nearest_word(word, right);
  return near.empty() ? "" : ", did you mean '" + near + "'?";
}

std::string listed(const std::vector<std::string>& words) {
  constexpr std::size_t most = 100;
  std::string text;
  for (const std::string& word : words | std::views::take(most)) text += (text.empty() ? "" : ", ") + clipped(word);
  return words.size() > most ? text + " and " + std::to_string(words.size() - most) + " more" : text;
}

std::string none_of(const std::string& word, const std::vector<std::string>& right) {
  return "'" + clipped(word) + "' is none of " + listed(right) + did_you_mean(word, right);
}

}  // namespace soilbin
