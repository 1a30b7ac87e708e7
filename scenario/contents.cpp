#include "scenario/contents.hpp"

#include <algorithm>
#include <set>
#include <system_error>

#include "scenario/nearest_word.hpp"
#include "scenario/yaml_node.hpp"

namespace soilbin {
namespace {

constexpr const char* contents_format = "soilbin-contents/1";

ContentsSection& section_titled(std::vector<ContentsSection>& sections, const std::string& title) {
  const auto same = [&](const ContentsSection& section) { return section.title == title; };
  if (const auto found = std::find_if(sections.begin(), sections.end(), same); found != sections.end()) return *found;
  return sections.emplace_back(ContentsSection{title, {}});
}

void refuse_unless(bool right, const SourceText& source, const YamlNode& node, const std::string& expected) {
  if (!right) source.refuse(node.offset, "expected " + expected + ", not " + node.kind_name());
}

void check_head(const SourceText& source, const YamlNode& root) {
  refuse_unless(root.is_mapping(), source, root, "a mapping of shelves");
  const YamlNode* format = root.find("format");
  if (format == nullptr || format->scalar != contents_format)
    source.refuse(format == nullptr ? root.offset : format->offset, std::string("expected format: ") + contents_format);
  std::vector<std::string> words = {"format"};
  for (const Shelf shelf : all_shelves) words.emplace_back(folder_of(shelf));
  for (std::size_t i = 0; i < root.items.size(); i += 2)
    if (const std::string& key = root.items[i].scalar; std::find(words.begin(), words.end(), key) == words.end())
      source.refuse(root.items[i].offset, "unknown key '" + clipped(key) + "'" + did_you_mean(key, words));
}

/// Moves what a file lists of the names still to be told into its sections.
void take_listed(const std::filesystem::path& file, Shelf shelf, std::set<std::string>& left,
                 std::vector<ContentsSection>& sections) {
  const SourceText source = read_source_text(file, largest_yaml);
  const YamlNode root = parse_yaml(source);
  check_head(source, root);
  const YamlNode* listed = root.find(folder_of(shelf));
  if (listed == nullptr) return;
  refuse_unless(listed->is_mapping(), source, *listed, "a mapping of sections");
  for (std::size_t s = 0; s < listed->items.size(); s += 2) {
    const YamlNode& lines = listed->items[s + 1];
    refuse_unless(lines.is_mapping(), source, lines, "a mapping of names");
    for (std::size_t i = 0; i < lines.items.size(); i += 2) {
      const YamlNode& meaning = lines.items[i + 1];
      refuse_unless(meaning.is_scalar() || meaning.kind == YamlNode::Kind::null, source, meaning, "a line of text");
      if (const std::string& name = lines.items[i].scalar; left.erase(name) == 1)
        section_titled(sections, listed->items[s].scalar).lines.push_back({name, meaning.scalar});
    }
  }
}

}  // namespace

std::vector<ContentsSection> contents_of(const std::vector<std::filesystem::path>& folders, Shelf shelf) {
  const std::vector<std::string> names = Library(folders).names(shelf);
  std::set<std::string> left(names.begin(), names.end());
  std::vector<ContentsSection> sections;
  for (const std::filesystem::path& folder : folders) {
    std::error_code error;
    if (const auto file = folder / "contents.yaml"; std::filesystem::is_regular_file(file, error))
      take_listed(file, shelf, left, sections);
  }
  for (const std::string& name : left) section_titled(sections, "Others").lines.push_back({name, ""});
  return sections;
}

}  // namespace soilbin
