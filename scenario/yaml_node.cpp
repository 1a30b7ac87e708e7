#include "scenario/yaml_node.hpp"

#include <fmt/core.h>
#include <yaml-cpp/eventhandler.h>
#include <yaml-cpp/exceptions.h>
#include <yaml-cpp/parser.h>

#include <algorithm>
#include <set>
#include <sstream>
#include <utility>

namespace soilbin {
namespace {

constexpr std::size_t deepest = 24;
constexpr std::size_t most_nodes = 100'000;

std::size_t offset_of(const YAML::Mark& mark) { return mark.pos < 0 ? 0 : static_cast<std::size_t>(mark.pos); }

/// Builds the tree from the parser's events; containers in the making wait on a stack.
class TreeBuilder : public YAML::EventHandler {
 public:
  explicit TreeBuilder(const SourceText& source) : source_(source) {}

  YamlNode take() { return std::move(root_); }

  void OnDocumentStart(const YAML::Mark&) override {}
  void OnDocumentEnd() override {}

  void OnNull(const YAML::Mark& mark, YAML::anchor_t anchor) override { place(make(Kind::null, mark, "", anchor)); }

  void OnAlias(const YAML::Mark& mark, YAML::anchor_t) override {
    source_.refuse(offset_of(mark), "aliases ('*name') are not part of this format", "write the value out");
  }

  void OnScalar(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t anchor,
                const std::string& value) override {
    YamlNode node = make(Kind::scalar, mark, tag, anchor);
    if (find_control(value) != std::string::npos)  // written as an escape, or the file would have been refused
      source_.refuse(node.offset, "a control character, such as \"\\e\" or \"\\0\", is no part of a text",
                     "leave it out");
    if (tag == "!" && !is_closed(node.offset)) source_.refuse(node.offset, "a quote is opened here and never closed");
    node.scalar = value;
    place(std::move(node));
  }

  void OnSequenceStart(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t anchor,
                       YAML::EmitterStyle::value) override {
    open(make(Kind::sequence, mark, tag, anchor));
  }

  void OnMapStart(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t anchor,
                  YAML::EmitterStyle::value) override {
    open(make(Kind::mapping, mark, tag, anchor));
  }

  void OnSequenceEnd() override { close(); }

  void OnMapEnd() override {
    check_keys(open_.back());
    close();
  }

 private:
  using Kind = YamlNode::Kind;

  YamlNode make(Kind kind, const YAML::Mark& mark, const std::string& tag, YAML::anchor_t anchor) {
    const std::size_t offset = offset_of(mark);
    if (anchor != YAML::NullAnchor)
      source_.refuse(offset, "anchors ('&name') are not part of this format", "write the value out where it is used");
    const bool tagged = !tag.empty() && tag != "?" && tag != "!";
    if (tagged) source_.refuse(offset, "tags ('!name') are not part of this format");
    if (++nodes_ > most_nodes) source_.refuse(offset, fmt::format("more than {} values", most_nodes));
    YamlNode node;
    node.kind = kind;
    node.offset = offset;
    return node;
  }

  /// Whether a quoted text that begins here ends (yaml-cpp takes the end of the file for its end).
  bool is_closed(std::size_t offset) const {
    const std::string& text = source_.text;
    if (offset >= text.size() || (text[offset] != '"' && text[offset] != '\'')) return true;
    for (std::size_t at = offset + 1; at < text.size(); ++at) {
      if (text[at] == '\\' && text[offset] == '"')
        ++at;
      else if (text[at] == text[offset])
        return true;
    }
    return false;
  }

  void open(YamlNode node) {
    if (open_.size() >= deepest) source_.refuse(node.offset, fmt::format("nested deeper than {} levels", deepest));
    open_.push_back(std::move(node));
  }

  void close() {
    YamlNode done = std::move(open_.back());
    open_.pop_back();
    place(std::move(done));
  }

  void place(YamlNode node) {
    if (open_.empty())
      root_ = std::move(node);
    else
      open_.back().items.push_back(std::move(node));
  }

  void check_keys(const YamlNode& mapping) const {
    std::set<std::string_view> seen;
    for (std::size_t i = 0; i + 1 < mapping.items.size(); i += 2) {
      const YamlNode& key = mapping.items[i];
      if (!key.is_scalar()) source_.refuse(key.offset, "a key must be a word, not " + key.kind_name());
      if (!seen.insert(key.scalar).second)
        source_.refuse(key.offset, fmt::format("key '{}' appears twice in the same mapping", clipped(key.scalar)));
    }
  }

  const SourceText& source_;
  YamlNode root_;
  std::vector<YamlNode> open_;
  std::size_t nodes_ = 0;
};

/// Refuses whatever stands behind the first document.
class NoSecondDocument : public TreeBuilder {
 public:
  explicit NoSecondDocument(const SourceText& source) : TreeBuilder(source), source_(source) {}
  void OnDocumentStart(const YAML::Mark& mark) override {
    source_.refuse(offset_of(mark), "a second document in the same file", "one document a file");
  }

 private:
  const SourceText& source_;
};

}  // namespace

std::string YamlNode::kind_name() const {
  switch (kind) {
    case Kind::null:
      return "nothing";
    case Kind::scalar:
      return "a single value";
    case Kind::sequence:
      return "a list";
    case Kind::mapping:
      return "a mapping";
  }
  return "";
}

const YamlNode* YamlNode::find(std::string_view key) const {
  if (!is_mapping()) return nullptr;
  for (std::size_t i = 0; i + 1 < items.size(); i += 2)
    if (items[i].scalar == key) return &items[i + 1];
  return nullptr;
}

namespace {

/// Blanks before the first sign of a line.
std::size_t indent_of(const std::string& line) { return std::min(line.find_first_not_of(' '), line.size()); }

bool has_a_key(const std::string& line) { return line.find(':') != line.npos; }

/// A line that begins in another column than those of its block, or a key without its colon, as far as the lines up to
/// that of the error tell; "" where they don't.
std::string slip_of_layout(const std::vector<std::string>& lines) {
  if (lines.size() < 2) return "";
  const std::string &here = lines.back(), &before = lines[lines.size() - 2];
  const std::size_t indent = indent_of(here), last = indent_of(before);
  const bool opens_block = std::string_view(":|>").find(before.back()) != std::string_view::npos ||
                           before[last] == '-' || before.find(": #") != before.npos;
  const bool deeper = indent > last && has_a_key(before) && !opens_block;
  const bool between =
      indent < last && std::ranges::none_of(lines.begin(), lines.end() - 1,
                                            [&](const std::string& line) { return indent_of(line) == indent; });
  if (has_a_key(here) && (deeper || between))
    return fmt::format(
        "this line begins in column {}, the one before it in column {}: lines of one block begin in one "
        "column",
        indent + 1, last + 1);
  for (const std::string& line : {here, before})
    if (!has_a_key(line) && line.find_first_of("-[]{}\"'") == line.npos)
      return fmt::format("'{}' has no colon: write a key, ': ' and a value, as in 'radius: 110 mm'",
                         clipped(line.substr(indent_of(line))));
  return "";
}

/// What most likely went wrong in the line of this place or in the one before it; "" where nothing usual did.
std::string slip_of_the_pen(const std::string& text, std::size_t at) {
  std::string before, here;
  std::vector<std::string> written;  // without blank lines and comments
  std::istringstream lines(text);
  for (std::size_t read = 0; read <= at && std::getline(lines, here); read += here.size() + 1) {
    if (read + here.size() < at) before = here;
    const std::size_t word = here.find_first_not_of(" \t\r");
    if (word != here.npos && here[word] != '#') written.push_back(here.substr(0, here.find_last_not_of(" \t\r") + 1));
  }
  for (const std::string& line : {here, before}) {
    const std::size_t word = line.find_first_not_of(" \t");
    if (word == line.npos) continue;
    if (line.substr(0, word).find('\t') != line.npos) return "a tab stands before the key: indent with blanks";
    const std::size_t comment = line.find(" #"), colon = line.find(": ");
    if (comment != line.npos && colon != line.npos && comment < colon)
      return "'#' after a blank begins a comment: put a name that holds it in quotes, \"Run #\": ...";
    if (line.find(": %") != line.npos || line.find("{%") != line.npos) return "put the percent sign in quotes: \"%\"";
    if (std::count(line.begin(), line.end(), '[') != std::count(line.begin(), line.end(), ']'))
      return "a list is not closed: ']' is missing";
    if (std::count(line.begin(), line.end(), '{') != std::count(line.begin(), line.end(), '}'))
      return "a mapping is not closed: '}' is missing";
    const std::size_t bare = line.find(':');
    if (colon == line.npos && bare != line.npos && bare + 1 < line.size())
      return "a blank is missing after ':', as in 'radius: 110 mm'";
  }
  return slip_of_layout(written);
}

}  // namespace

YamlNode parse_yaml(const SourceText& source) {
  if (source.text.size() > largest_yaml)
    source.refuse(0, fmt::format("larger than the {} bytes that a YAML file may have", largest_yaml));
  TreeBuilder builder(source);
  NoSecondDocument rest(source);
  try {
    std::istringstream stream(source.text);
    YAML::Parser parser(stream);
    if (!parser.HandleNextDocument(builder)) source.refuse(0, "the file is empty");
    parser.HandleNextDocument(rest);
  } catch (const YAML::Exception& error) {
    const std::size_t at = error.mark.is_null() ? 0 : offset_of(error.mark);
    source.refuse(std::min(at, source.text.size()), "not well-formed YAML: " + error.msg,
                  slip_of_the_pen(source.text, at));
  }
  return builder.take();
}

}  // namespace soilbin
