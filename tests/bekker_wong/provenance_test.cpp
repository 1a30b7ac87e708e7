// Whose equations the forms of the effects are, and that the pages say so.
#include "bekker_wong/effects/provenance.hpp"

#include <fmt/core.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>
#include <fstream>
#include <regex>
#include <set>
#include <sstream>

namespace soilbin::bekker_wong {
namespace {

// A form that is published, or after a source, names it: a year, or Wong's book.
TEST(Provenance, NamesItsSource) {
  const std::regex source("(18|19|20)[0-9]{2}|Wong, Theory of Ground Vehicles");
  for (const EffectForm& form : effect_catalogue()) {
    SCOPED_TRACE(form.id + ":" + form.form + ": " + form.source);
    if (provenance_of(form) != Provenance::stated)
      EXPECT_TRUE(std::regex_search(form.source, source));
    else
      EXPECT_TRUE(form.source.find("stated") == 0);
    EXPECT_FALSE(form.source.empty());
  }
}

std::string number_word(std::size_t n) {
  static const std::vector<std::string> words = {"six", "fourteen", "twenty"};
  static const std::vector<std::size_t> numbers = {6, 14, 20};
  const auto found = std::find(numbers.begin(), numbers.end(), n);
  return found == numbers.end() ? std::to_string(n) : words[static_cast<std::size_t>(found - numbers.begin())];
}

/// The text of a page without line breaks, in small letters.
std::string page(const std::string& name) {
  std::ifstream file(std::string(SOILBIN_SOURCE_DIR "/") + name);
  std::ostringstream all;
  all << file.rdbuf();
  std::string text = std::regex_replace(all.str(), std::regex("\\s+"), " ");
  std::transform(text.begin(), text.end(), text.begin(), [](unsigned char c) { return std::tolower(c); });
  return text;
}

// The catalogue counted: what README, CHANGELOG and docs say of it.
TEST(Provenance, IsWhatThePagesSay) {
  std::set<std::string> of_wheel, of_measurement;
  std::size_t published = 0, after = 0, ours = 0;
  for (const EffectForm& form : effect_catalogue()) {
    (form.measurement ? of_measurement : of_wheel).insert(form.id);
    const Provenance whose = provenance_of(form);
    ++(whose == Provenance::published ? published : whose == Provenance::after ? after : ours);
  }
  const std::string effects = number_word(of_wheel.size() + of_measurement.size()) + " effects";
  const std::string wheel = number_word(of_wheel.size()) + " of wheel and soil";
  const std::string measurement = number_word(of_measurement.size()) + " of the measurement";
  const std::string forms = fmt::format("{} forms: {} as published, {} after a source, {} ours",
                                        effect_catalogue().size(), published, after, ours);
  for (const char* name : {"README.md", "CHANGELOG.md", "docs/reference/effects.md"})
    for (const std::string& said : {effects, wheel, measurement, forms})
      EXPECT_NE(page(name).find(said), std::string::npos) << name << " should say: " << said;
}

}  // namespace
}  // namespace soilbin::bekker_wong
