#include "scenario/mapping_writer.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <array>

#include "scenario/errors.hpp"
#include "scenario/source_text.hpp"

namespace soilbin {
namespace {

bool is_plain(std::string_view text) {
  const auto letter = [](char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'); };
  const auto inner = [&](char c) { return letter(c) || (c >= '0' && c <= '9') || c == '_' || c == '-' || c == ' '; };
  if (text.empty() || text.size() > 60 || !letter(text.front()) || text.back() == ' ') return false;
  if (!std::all_of(text.begin(), text.end(), inner)) return false;
  // Words that other YAML readers take for something else than text.
  constexpr std::array<std::string_view, 9> special = {"null", "true", "false", "yes", "no", "on", "off", "y", "n"};
  std::string lower(text);
  for (char& c : lower) c = c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
  return std::find(special.begin(), special.end(), lower) == special.end();
}

}  // namespace

std::string yaml_scalar(std::string_view text) {
  if (find_control(text) != text.npos)
    throw InputError("a text with control characters can't be written: nobody reads it");
  if (is_plain(text)) return std::string(text);
  std::string quoted = "\"";
  for (const char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    if (c == '"' || c == '\\')
      quoted += {'\\', c};
    else if (c == '\n')
      quoted += "\\n";
    else if (c == '\t')
      quoted += "\\t";
    else if (byte < 0x20U || byte == 0x7FU)
      quoted += fmt::format("\\x{:02x}", static_cast<unsigned>(byte));
    else
      quoted += c;
  }
  return quoted + "\"";
}

void YamlLines::begin_line() {
  const int blanks = 2 * (item_pending_ ? depth_ - 1 : depth_);
  text_ += std::string(static_cast<std::size_t>(std::max(blanks, 0)), ' ');
  if (item_pending_) text_ += "- ";
  item_pending_ = false;
}

void YamlLines::value(std::string_view key, std::string_view scalar) {
  begin_line();
  text_ += fmt::format("{}: {}\n", key, scalar);
}

void YamlLines::open(std::string_view key) {
  begin_line();
  text_ += fmt::format("{}:\n", key);
  ++depth_;
}

void YamlLines::close() { --depth_; }

void YamlLines::open_item() {
  ++depth_;
  item_pending_ = true;
}

void YamlLines::item(std::string_view scalar) {
  begin_line();
  text_ += fmt::format("- {}\n", scalar);
}

void write_estimate(const std::string& key, const Estimate& estimate, const std::string& unit, Writing& writing,
                    double silent_sd) {
  std::string source;
  if (writing.sources != nullptr)
    if (const auto found = writing.sources->find(writing.path + key); found != writing.sources->end())
      source = found->second;
  const std::string value = write_quantity(estimate.value, unit, writing.n);
  const bool silent = estimate.std_error == silent_sd;
  if (silent && source.empty()) return writing.lines->value(key, value);
  std::string flow = "{value: " + value;
  if (!silent) flow += ", sd: " + write_quantity(estimate.std_error, unit, writing.n);
  if (!source.empty()) flow += ", source: " + yaml_scalar(source);
  writing.lines->value(key, flow + "}");
}

}  // namespace soilbin
