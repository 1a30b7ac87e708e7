// A YAML document as a tree of nodes that know their places.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "scenario/source_text.hpp"

namespace soilbin {

/// One node. In a mapping `items` holds key, value, key, value, ...; keys are scalars and differ from each other.
struct YamlNode {
  enum class Kind { null, scalar, sequence, mapping };
  Kind kind = Kind::null;
  std::string scalar;
  std::size_t offset = 0;  ///< of its first byte in the source
  std::vector<YamlNode> items;

  bool is_scalar() const { return kind == Kind::scalar; }
  bool is_sequence() const { return kind == Kind::sequence; }
  bool is_mapping() const { return kind == Kind::mapping; }
  /// "a list", "a mapping", ...
  std::string kind_name() const;
  /// The value behind a key of a mapping, or nullptr.
  const YamlNode* find(std::string_view key) const;
};

/// Largest YAML file that is read [bytes]; a case is a page of text.
inline constexpr std::size_t largest_yaml = 1U << 20U;

/// Reads one document. Throws InputError with line and column for broken YAML, a key that appears twice or is not a
/// scalar, anchors, aliases and tags (the formats of soilbin have none), control characters in a quoted text, nesting
/// deeper than 24, more than 100,000 nodes, a text beyond largest_yaml, an empty text and a second document.
YamlNode parse_yaml(const SourceText& source);

}  // namespace soilbin
