#include "scenario/nearest_word.hpp"

#include <gtest/gtest.h>

namespace soilbin {
namespace {

const std::vector<std::string> keys = {"radius", "width", "lugs", "inflation_pressure"};

TEST(NearestWord, FindsWhatWasMeant) {
  EXPECT_EQ(nearest_word("raduis", keys), "radius") << "neighbours swapped count once";
  EXPECT_EQ(nearest_word("Width", keys), "width") << "case doesn't count";
  EXPECT_EQ(nearest_word("lug", keys), "lugs");
  EXPECT_EQ(nearest_word("inflationpressure", keys), "inflation_pressure");
}

TEST(NearestWord, SaysNothingWhereNothingIsNear) {
  EXPECT_EQ(nearest_word("temperature", keys), "");
  EXPECT_EQ(nearest_word("R2", {"run"}), "") << "two changes leave nothing of two letters";
  EXPECT_EQ(nearest_word("radius", {}), "");
  EXPECT_EQ(nearest_word(std::string(100'000, 'x'), keys), "");
}

TEST(NearestWord, AWordOfTheFieldGoesBeforeAMisspelling) {
  EXPECT_EQ(did_you_mean("--grouser-height", {"--lug-height", "--load"}), ", did you mean '--lug-height'?");
  EXPECT_EQ(did_you_mean("grouser_height", {"height", "lug_height"}), ", did you mean 'lug_height'?");
  EXPECT_EQ(did_you_mean("fit", {"loop", "plates", "list"}), ", did you mean 'loop' or 'plates'?");
  EXPECT_EQ(did_you_mean("grouser", {"radius", "width"}), "") << "what the word means isn't there";
}

TEST(NearestWord, ANameIsFoundByItsWords) {
  const std::vector<std::string> soils = {"clayey-soil",        "dry-sand",   "lean-clay",
                                          "rubicon-sandy-loam", "sandy-loam", "sandy-loam-wet"};
  EXPECT_EQ(did_you_mean_name("wet loam", soils), ", did you mean 'sandy-loam-wet'?");
  EXPECT_EQ(did_you_mean_name("Loam", soils), ", did you mean 'sandy-loam', 'rubicon-sandy-loam' or 'sandy-loam-wet'?");
  EXPECT_EQ(did_you_mean_name("sand", soils), ", did you mean 'dry-sand'?") << "a whole word goes before a beginning";
  EXPECT_EQ(did_you_mean_name("dry-snad", soils), ", did you mean 'dry-sand'?") << "a misspelling goes first";
  EXPECT_EQ(did_you_mean_name("gravel", soils), "");
  EXPECT_EQ(did_you_mean_name("--", soils), "");
  EXPECT_EQ(did_you_mean_name("a", std::vector<std::string>(9, "a-b")).size(),
            did_you_mean_name("a", std::vector<std::string>(5, "a-b")).size())
      << "five at most";
}

}  // namespace
}  // namespace soilbin
