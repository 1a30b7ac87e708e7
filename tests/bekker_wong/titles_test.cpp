// The effects' names for people: each effect has one, and says what the reference says.
#include "bekker_wong/effects/titles.hpp"

#include <gtest/gtest.h>

#include <fstream>
#include <set>
#include <sstream>

#include "bekker_wong/effect.hpp"

namespace soilbin::bekker_wong {
namespace {

std::string reference_text() {
  std::ostringstream text;
  for (const char* page : {"effects.md", "effects-bed-and-measurement.md"})
    text << std::ifstream(std::string(SOILBIN_SOURCE_DIR) + "/docs/reference/" + page).rdbuf();
  return text.str();
}

TEST(EffectTitles, EachEffectHasANameOfItsOwnAndTheReferencesMeaning) {
  const std::string reference = reference_text();
  std::set<std::string> ids;
  std::set<std::string_view> names;
  for (const EffectForm& form : effect_catalogue()) {
    if (!ids.insert(form.id).second) continue;
    const EffectTitle& title = effect_title(form.id);
    EXPECT_TRUE(names.insert(title.name).second) << form.id;
    const std::string heading = "## " + form.id + ": " + std::string(title.meaning) + "\n";
    EXPECT_NE(reference.find(heading), std::string::npos) << heading;
  }
  EXPECT_THROW(effect_title("no_effect"), std::out_of_range);
}

}  // namespace
}  // namespace soilbin::bekker_wong
