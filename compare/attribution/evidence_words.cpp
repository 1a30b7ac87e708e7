#include "compare/attribution/evidence_words.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "bekker_wong/effects/titles.hpp"

namespace soilbin::compare {
namespace {

constexpr double noise_level = 0.05;  // p below which noise alone is no explanation

/// "4,000"
std::string thousands_apart(long long value) {
  std::string text = std::to_string(value);
  for (std::size_t at = text.size(); at > 3;) text.insert(at -= 3, ",");
  return text;
}

/// Whether none of the simulated campaigns looked like this.
bool in_none(const ResidualSignatures& signatures) { return signatures.p_value * (signatures.simulations + 1.0) < 1.5; }

}  // namespace

std::string joined_with_and(const std::vector<std::string>& words) {
  std::string text;
  for (std::size_t i = 0; i < words.size(); ++i)
    text += (i == 0 ? "" : i + 1 == words.size() ? " and " : ", ") + words[i];
  return text;
}

std::string joined(const std::set<std::string>& ids) {
  return ids.empty() ? "no effect" : fmt::format("{}", fmt::join(ids, " + "));
}

std::string named_effects(const std::set<std::string>& ids) {
  std::vector<std::string> names;
  for (const std::string& id : ids) names.emplace_back(bekker_wong::effect_title(id).name);
  return names.empty() ? "no effect" : joined_with_and(names);
}

std::string times_likelier(double log_odds) {
  constexpr double million = 1e6;
  const double odds = std::exp(log_odds);
  if (odds > million) return "more than a million times";
  if (odds < 10) return fmt::format("{:.2g} times", odds);
  const double step = std::pow(10.0, std::floor(std::log10(odds)) - 1);
  return thousands_apart(std::llround(std::round(odds / step) * step)) + " times";
}

std::string p_words(const ResidualSignatures& signatures) {
  return fmt::format("p {} {:.2g}", in_none(signatures) ? "<" : "=", signatures.p_value);
}

std::string noise_verdict(const ResidualSignatures& signatures) {
  return fmt::format("{}explained by noise ({})", signatures.p_value < noise_level ? "not " : "", p_words(signatures));
}

std::string share_words(double weight) {
  return weight < least_share ? "< 1 %" : fmt::format("{:.0f} %", 100 * weight);
}

}  // namespace soilbin::compare
