#include "scenario/mapping_reader.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <filesystem>

#include "scenario/csv.hpp"
#include "scenario/nearest_word.hpp"

namespace soilbin {
namespace {

void keep_source(const YamlNode& mapping, const std::string& key, Reading& reading) {
  const YamlNode* source = mapping.find("source");
  if (source == nullptr) return;
  const std::string text = read_text(*source, reading);
  if (reading.sources != nullptr) (*reading.sources)[reading.path + key] = text;
}

/// A standard deviation has its number's unit, and any value from 0.
double read_deviation(const YamlNode& node, const Measure& measure, const Reading& reading) {
  return read_scalar(node, Measure{measure.unit, zero_or_more}, reading).value;
}

}  // namespace

std::vector<std::vector<double>> read_named_csv(const YamlNode& path, const std::vector<CsvColumn>& columns,
                                                const Reading& reading) {
  const std::string name = read_name(path, reading);
  if (name.find('\0') != std::string::npos) reading.refuse(path, "a path can't hold a zero byte");
  const std::filesystem::path file = std::filesystem::path(reading.source->file).parent_path() / name;
  std::error_code error;
  if (!std::filesystem::is_regular_file(file, error))
    reading.refuse(path, fmt::format("no such file: '{}'", clipped(name)), "a path relative to this file, of a CSV");
  return read_csv_columns(read_source_text(file, largest_csv), columns);
}

void expect_keys(const YamlNode& mapping, const std::vector<std::string>& keys, const Reading& reading) {
  if (!mapping.is_mapping())
    reading.refuse(mapping, "expected a mapping of keys, not " + mapping.kind_name(), "keys here: " + listed(keys));
  for (std::size_t i = 0; i + 1 < mapping.items.size(); i += 2) {
    const YamlNode& key = mapping.items[i];
    if (std::find(keys.begin(), keys.end(), key.scalar) != keys.end()) continue;
    const std::size_t blank = key.scalar.find(' ');
    if (const std::string word = key.scalar.substr(0, blank); blank != word.npos &&
                                                              mapping.items[i + 1].kind == YamlNode::Kind::null &&
                                                              std::find(keys.begin(), keys.end(), word) != keys.end())
      reading.refuse(key, fmt::format("'{}' has no colon behind '{}'", clipped(key.scalar), word),
                     fmt::format("write {}:{}", word, clipped(key.scalar.substr(blank))));
    reading.refuse(key, fmt::format("unknown key '{}'{}", clipped(key.scalar), did_you_mean(key.scalar, keys)),
                   "keys here: " + listed(keys));
  }
}

const YamlNode* value_of(const YamlNode& mapping, const std::string& key, Need need, const std::string& meaning,
                         const Reading& reading) {
  const YamlNode* node = mapping.find(key);
  if (node == nullptr && need == Need::required)
    reading.refuse(mapping, fmt::format("key '{}' is missing", key), fmt::format("{}: {}", key, meaning));
  if (node != nullptr && node->kind == YamlNode::Kind::null)  // it stands at the key: what is not there has no place
    reading.refuse(*(node - 1), fmt::format("nothing stands behind '{}'", key), fmt::format("{}: {}", key, meaning));
  return node;
}

std::string read_text(const YamlNode& node, const Reading& reading) {
  if (!node.is_scalar()) reading.refuse(node, "expected a text, not " + node.kind_name());
  return node.scalar;
}

std::string read_name(const YamlNode& node, const Reading& reading) {
  std::string name = read_text(node, reading);
  while (!name.empty() && name.back() == '\n') name.pop_back();  // of a block
  if (name.find_first_of("\n\r\t") != name.npos)
    reading.refuse(node, "a name is one line, without tabs", "longer texts go behind 'description'");
  return name;
}

Quantity read_scalar(const YamlNode& node, const Measure& measure, const Reading& reading) {
  if (!node.is_scalar()) {
    const Unit unit = parse_unit(measure.unit, reading.n);
    reading.refuse(node, fmt::format("expected {}, such as '{}', not {}", dimension_name(unit), dimension_example(unit),
                                     node.kind_name()));
  }
  try {
    return parse_quantity(node.scalar, measure, reading.n);
  } catch (const InputError& error) {
    reading.refuse(node, error.what());
  }
}

double read_number(const YamlNode& node, const Measure& measure, const std::string& key, Reading& reading) {
  if (!node.is_mapping()) return read_scalar(node, measure, reading).value;
  if (const YamlNode* deviation = node.find("sd"))
    reading.refuse(*deviation, fmt::format("'{}' is taken as exact: it has no 'sd'", key));
  expect_keys(node, {"value", "source"}, reading);
  keep_source(node, key, reading);
  return read_scalar(*value_of(node, "value", Need::required, "the number", reading), measure, reading).value;
}

Estimate read_estimate(const YamlNode& node, const Measure& measure, const std::string& key, Reading& reading) {
  const auto assumed = [&](double value) { return reading.assumed_sd * std::abs(value); };
  if (!node.is_mapping()) {
    const double value = read_scalar(node, measure, reading).value;
    return {value, assumed(value)};
  }
  expect_keys(node, {"value", "sd", "source"}, reading);
  keep_source(node, key, reading);
  Estimate estimate;
  estimate.value = read_scalar(*value_of(node, "value", Need::required, "the number", reading), measure, reading).value;
  if (const YamlNode* sd = value_of(node, "sd", Need::optional, "its standard deviation", reading))
    estimate.std_error = read_deviation(*sd, measure, reading);
  else
    estimate.std_error = assumed(estimate.value);
  return estimate;
}

int read_integer(const YamlNode& node, int lowest, const Reading& reading) {
  if (!node.is_scalar()) reading.refuse(node, "expected a whole number, not " + node.kind_name());
  const std::string& text = node.scalar;
  int value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size())
    reading.refuse(node, fmt::format("expected a whole number, such as '2', not '{}'", clipped(text)));
  if (value < lowest) reading.refuse(node, fmt::format("{} is out of range: must be at least {}", value, lowest));
  return value;
}

std::size_t read_word(const YamlNode& node, const std::vector<std::string>& right, const Reading& reading) {
  const std::string choices = "one of: " + listed(right);
  if (!node.is_scalar()) reading.refuse(node, "expected a word, not " + node.kind_name(), choices);
  const auto found = std::find(right.begin(), right.end(), node.scalar);
  if (found == right.end())
    reading.refuse(node, fmt::format("unknown word '{}'{}", clipped(node.scalar), did_you_mean(node.scalar, right)),
                   choices);
  return static_cast<std::size_t>(found - right.begin());
}

namespace {

/// What takes a file that is given in another one's place.
struct OtherFormat {
  std::string_view format;
  const char* hint;  ///< {}: the file
};
constexpr OtherFormat other_formats[] = {
    {"soilbin-case/1", "a case is a question: soilbin run, estimate or compare takes it"},
    {"soilbin-campaign/1", "a campaign is measured runs: soilbin check, predict or loop takes it"},
    {"soilbin-vehicle-case/1", "that is a vehicle on a soil: soilbin vehicle {}"},
    {"soilbin-vehicle/1", "that is a vehicle without a soil: soilbin mobility {}"},
    {"soilbin-soil/1", "that is a soil: --soil {}"},
    {"soilbin-tire/1", "that is a tire: --tire {}"}};

std::string hint_at_format(const std::string& format, const std::string& file) {
  const auto* const other = std::ranges::find(other_formats, format, &OtherFormat::format);
  if (other != std::end(other_formats)) return fmt::format(fmt::runtime(other->hint), file);
  std::vector<std::string> formats;
  for (const OtherFormat& known : other_formats) formats.emplace_back(known.format);
  const std::string near = nearest_word(format, formats);
  return near.empty() ? "" : "format: " + near;
}

}  // namespace

void expect_format(const YamlNode& document, const std::string& format, const Reading& reading) {
  if (!document.is_mapping())
    reading.refuse(document, fmt::format("expected a mapping that begins with 'format: {}', not {}", format,
                                         document.kind_name()));
  const YamlNode* node = document.find("format");
  if (node == nullptr) reading.refuse(document, "key 'format' is missing", "format: " + format);
  if (!node->is_scalar() || node->scalar != format)
    reading.refuse(*node, fmt::format("unknown format '{}': expected '{}'", clipped(node->scalar), format),
                   node->is_scalar() ? hint_at_format(node->scalar, reading.source->file) : "");
}

}  // namespace soilbin
