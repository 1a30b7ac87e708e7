// The document below every format: what is refused before a key is looked at.
#include "scenario/yaml_node.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>

#include "tests/scenario/refusal.hpp"

namespace soilbin {
namespace {

using test::refusal;
using testing::HasSubstr;
using testing::StartsWith;

std::string refused_yaml(const std::string& text) {
  return refusal([&] { parse_yaml(make_source_text(text, "f.yaml")); });
}

TEST(YamlNode, KnowsItsPlace) {
  const SourceText source = make_source_text("a: 1\nb:\n  - x\n  - {c: d}\n", "f.yaml");
  const YamlNode document = parse_yaml(source);
  const YamlNode& item = document.find("b")->items[1];
  EXPECT_EQ(source.position(item.find("c")->offset).line, 4);
  EXPECT_EQ(source.position(item.find("c")->offset).column, 9);
}

TEST(YamlNode, AByteOrderMarkAndCarriageReturnsAreWelcome) {
  const YamlNode document =
      parse_yaml(make_source_text("\xEF\xBB\xBF"
                                  "a: 1\r\nb: 2\r\n",
                                  "f.yaml"));
  EXPECT_EQ(document.find("a")->scalar, "1");
  EXPECT_EQ(document.find("b")->scalar, "2");
}

TEST(YamlNode, ColumnsCountCharactersNotBytes) {
  EXPECT_EQ(refused_yaml("{\u00e4\u00f6\u00fc: 1, \u00e4\u00f6\u00fc: 2}\n"),
            "f.yaml:1:10: key '\u00e4\u00f6\u00fc' appears twice in the same mapping\n"
            "  1 | {\u00e4\u00f6\u00fc: 1, \u00e4\u00f6\u00fc: 2}\n"
            "    |          ^");
}

TEST(YamlNode, RefusesWhatTheFormatsDoNotHave) {
  EXPECT_THAT(refused_yaml("a: 1\nb: 2\na: 3\n"), StartsWith("f.yaml:3:1: key 'a' appears twice"));
  EXPECT_THAT(refused_yaml("a: &x 1\n"), HasSubstr("anchors"));
  EXPECT_THAT(refused_yaml("a: *x\n"), StartsWith("f.yaml:1:4: "));
  EXPECT_THAT(refused_yaml("a: !!binary x\n"), HasSubstr("tags"));
  EXPECT_THAT(refused_yaml("a: 1\n---\nb: 2\n"), HasSubstr("second document"));
  EXPECT_THAT(refused_yaml("[1, 2]: 3\n"), HasSubstr("a key must be a word"));
  EXPECT_THAT(refused_yaml("a: [1, 2\n"), HasSubstr("not well-formed YAML"));
  EXPECT_THAT(refused_yaml("a: \"x\n"), StartsWith("f.yaml:1:4: a quote is opened here and never closed"));
  EXPECT_THAT(refused_yaml(""), HasSubstr("empty"));
}

// A line that begins a column beside its block, and a key without its colon: the parser's own words name neither.
TEST(YamlNode, SaysWhichLineStandsOutOfItsBlock) {
  EXPECT_THAT(refused_yaml("a:\n  b: 1\n   c: 2\n"),
              HasSubstr("hint: this line begins in column 4, the one before it in column 3: lines of one block"));
  EXPECT_THAT(refused_yaml("a:\n  b: 1\n c: 2\n"), HasSubstr("begins in column 2, the one before it in column 3"));
  EXPECT_THAT(refused_yaml("a: 1\n\n# b\n c: 2\n"), HasSubstr("begins in column 2, the one before it in column 1"));
  for (const char* without_colon : {"a:\n  d: 3\n  b 1 mm\nc: 2\n", "b 1 mm\na: 2\n", "a:\n  b 1 mm\n  c: 2\n"})
    EXPECT_THAT(refused_yaml(without_colon), HasSubstr("hint: 'b 1 mm' has no colon")) << without_colon;
}

TEST(YamlNode, RefusesBombs) {
  EXPECT_THAT(refused_yaml("a: &a [x, x]\nb: &b [*a, *a]\nc: [*b, *b]\n"), HasSubstr("anchors"));
  EXPECT_THAT(refused_yaml(std::string(100'000, '[')), HasSubstr("nested deeper than 24 levels"));
  std::string blocks;
  for (int i = 0; i < 1000; ++i) blocks += "- ";
  EXPECT_THAT(refused_yaml(blocks), HasSubstr("nested deeper"));
  std::string values = "[";
  for (int i = 0; i < 200'000; ++i) values += "1,";
  EXPECT_THAT(refused_yaml(values + "]"), HasSubstr("more than 100000 values"));
  EXPECT_THAT(refused_yaml("a: " + std::string(2'000'000, 'x')), HasSubstr("larger than"));
}

TEST(YamlNode, RefusesWhatIsNoText) {
  EXPECT_THAT(refused_yaml("a: \xff\n"), StartsWith("f.yaml:1:4: byte 0xff is no text"));
  EXPECT_THAT(refused_yaml(std::string("a: \0x", 5)), HasSubstr("byte 0x00"));
  EXPECT_THAT(refused_yaml("a: \xed\xa0\x80\n"), HasSubstr("byte 0xed")) << "a surrogate";
  EXPECT_THAT(refused_yaml("a: \xc0\xaf\n"), HasSubstr("byte 0xc0")) << "an overlong slash";
}

TEST(SourceText, RefusesWhatIsNoFile) {
  const std::filesystem::path folder = std::filesystem::temp_directory_path();
  EXPECT_THAT(refusal([] { read_source_text("no/such/file.yaml", 10); }), HasSubstr("no/such/file.yaml: no such file"));
  EXPECT_THAT(refusal([&] { read_source_text(folder, 10); }), HasSubstr("is a folder"));
  EXPECT_THAT(refusal([] { read_source_text("/dev/zero", 10); }), HasSubstr("not a regular file"));
}

TEST(SourceText, ALongLineIsCutRoundThePlace) {
  const std::string message = refused_yaml("a: " + std::string(5000, 'x') + " : y : z\n");
  EXPECT_LT(message.size(), 500u);
}

}  // namespace
}  // namespace soilbin
