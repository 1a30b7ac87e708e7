#include "scenario/tire_size.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <regex>

#include "scenario/errors.hpp"
#include "scenario/quantity.hpp"
#include "scenario/source_text.hpp"

namespace soilbin {
namespace {

constexpr double inch = 0.0254;

/// Without blanks and service description, in capitals.
std::string tidy(const std::string& text) {
  static const std::regex service(R"(\s+[0-9]{2,3}(/[0-9]{2,3})?\s*[A-Z][0-9]?$)", std::regex::icase);
  std::string size = text.size() > 40 ? "" : std::regex_replace(text, service, "");
  std::erase_if(size, [](unsigned char c) { return std::isspace(c) != 0; });
  std::ranges::transform(size, size.begin(), [](unsigned char c) { return static_cast<char>(std::toupper(c)); });
  return size;
}

/// Whether a text was meant as a size: digits, and what stands between them in sizes.
bool is_meant(const std::string& size) {
  static const std::regex meant(R"((IF|VF|CFO|LT|P)?[0-9]+[0-9.]*[-/XRBDL][-0-9./XRBDZCLT]*)");
  return std::regex_match(size, meant);
}

struct Size {
  double diameter = 0.0;  ///< of the outside [in]; 0: not told
  double width = 0.0;     ///< [mm] from 100 on, below that [in]
  double aspect = 0.0;    ///< [%]; 0: not told
  double rim = 0.0;       ///< [in]
  Construction construction = Construction::bias_ply;
  std::string width_text{};
};

[[noreturn]] void refuse(const std::string& text, const std::string& why) {
  throw InputError(
      fmt::format("tire size '{}': {}\n  hint: such as 600/65R28 (mm, %, in), 18.4-38 or 16.00R20 (in), 66x43.00-25 "
                  "(in); those that "
                  "are stored: soilbin list tires",
                  clipped(text), why));
}

Size read(const std::string& text) {
  static const std::string number = R"(([0-9]+(?:\.[0-9]+)?))";
  static const std::regex pattern("(?:IF|VF|CFO|LT|P)?" + number + "(?:([/X])" + number + ")?(R|ZR|B|D|-)" + number +
                                  "(?:C|LT)?");
  std::smatch part;
  const std::string size = tidy(text);
  if (!std::regex_match(size, part, pattern))
    refuse(text, "it is read as width, height of the sides, construction (R, B, D or -) and rim");
  const auto value = [&](std::size_t k) { return read_number(part[k].str()).value(); };
  Size read{.rim = value(5)};
  if (part[4] == "R" || part[4] == "ZR") read.construction = Construction::radial;
  if (part[2] == "X")
    read.diameter = value(1), read.width = value(3), read.width_text = part[3];
  else
    read.width = value(1), read.aspect = part[2].matched ? value(3) : 0.0, read.width_text = part[1];
  return read;
}

void need(const std::string& text, const char* what, double value, double low, double high, const char* unit) {
  if (!(value >= low && value <= high))
    refuse(text, fmt::format("{} of {:g} {} is not from {:g} to {:g} {}", what, value, unit, low, high, unit));
}

}  // namespace

std::optional<Tire> tire_of_size(const std::string& text) {
  const std::string name = tidy(text);
  if (!is_meant(name)) return std::nullopt;
  const Size size = read(text);
  const bool metric = size.width >= 100.0;
  if (metric)
    need(text, "a width", size.width, 100, 1500, "mm");
  else
    need(text, "a width", size.width, 2, 70, "in");
  need(text, "a rim", size.rim, 4, 63, "in");
  Tire tire;
  tire.name = name, tire.width = metric ? size.width / 1000 : size.width * inch;
  std::string sides;
  if (size.diameter > 0.0) {
    need(text, "an outer diameter", size.diameter, size.rim + 1, 200, "in");
    tire.radius = size.diameter * inch / 2, sides = fmt::format("{:g} in in diameter", size.diameter);
  } else {
    const std::size_t point = size.width_text.find('.');
    const bool two_decimals = point != std::string::npos && size.width_text.size() - point == 3;
    const double aspect = size.aspect > 0.0 ? size.aspect : metric ? 82 : two_decimals ? 105 : 85;
    need(text, "sides", aspect, 20, 110, "% of the width");
    tire.radius = size.rim * inch / 2 + aspect / 100 * tire.width;
    sides =
        fmt::format("sides of {:g} % of that{}", aspect, size.aspect > 0.0 ? "" : " (assumed: the size tells none)");
  }
  tire.section_height = tire.radius - size.rim * inch / 2;
  tire.construction = size.construction;
  tire.source = fmt::format("{}{:.4g} mm wide, {} on a rim of {:g} in, so a radius of {:.4g} mm over an unknown tread",
                            by_size_alone, 1000 * tire.width, sides, size.rim, 1000 * tire.radius);
  return tire;
}

bool nearly_same_size(const std::string& one, const std::string& other) {
  if (!is_meant(tidy(one)) || !is_meant(tidy(other))) return false;
  try {
    const Size a = read(one), b = read(other);
    return a.width == b.width && a.aspect == b.aspect && a.diameter == b.diameter && std::abs(a.rim - b.rim) <= 1.0;
  } catch (const InputError&) {
    return false;
  }
}

std::string library_name_of_size(const std::string& text) {
  std::string name = tidy(text);
  if (!is_meant(name)) return "";
  std::ranges::replace(name, '/', '-');
  return name;
}

}  // namespace soilbin
