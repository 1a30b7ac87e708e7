#include "compare/report/number_text.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cctype>
#include <cmath>

#include "scenario/unit.hpp"

namespace soilbin::compare {

std::string number(double value, int digits) {
  if (!std::isfinite(value)) return "-";
  if (value == 0.0) return "0";
  const double size = std::abs(value);
  if (size < 1e-4 || size >= 1e7) return fmt::format("{:.{}e}", value, digits - 1);
  const int places = std::clamp(digits - 1 - static_cast<int>(std::floor(std::log10(size))), 0, 7);
  return fmt::format("{:.{}f}", value, places);
}

std::string number(const Estimate& estimate, double per_unit) {
  const double value = estimate.value * per_unit, error = estimate.std_error * per_unit;
  if (!(error > 1e-9 * std::abs(value)) || !std::isfinite(error)) return number(value);
  const int places = std::clamp(1 - static_cast<int>(std::floor(std::log10(error))), 0, 9);
  return fmt::format("{:.{}f} ± {:.{}f}", value, places, error, places);
}

std::string csv_number(double value, int digits) {
  return std::isfinite(value) ? fmt::format("{:.{}g}", value + 0.0, digits) : "";
}

double per_unit(const std::string& unit) {
  const Unit parsed = parse_unit(unit);
  return parsed.denominator / (parsed.numerator * std::pow(10.0, parsed.decimal));
}

std::string unit_behind(std::string_view unit) { return unit == "-" ? "" : " " + std::string(unit); }

std::string percent(double share) { return fmt::format("{:.3g} %", 100 * share); }

std::string counted(std::size_t count, const std::string& noun) {
  return fmt::format("{} {}{}", count, noun, count == 1 ? "" : "s");
}

std::string duration_text(double seconds) {
  if (seconds < 10) return fmt::format("{:.2g} s", seconds);
  if (seconds < 100) return fmt::format("{:.0f} s", seconds);
  if (seconds < 6000) return fmt::format("{:.0f} min", seconds / 60);
  return fmt::format("{:.3g} h", seconds / 3600);
}

std::string size_text(double bytes) {
  if (bytes < 1e6) return fmt::format("{:.0f} kB", std::max(1.0, bytes / 1e3));
  return bytes < 1e9 ? fmt::format("{:.0f} MB", bytes / 1e6) : fmt::format("{:.1f} GB", bytes / 1e9);
}

std::string spaced(std::string_view name) {
  std::string words(name);
  std::ranges::replace(words, '_', ' ');
  return words;
}

std::string newtons(double force, int digits) {
  const double kilo = 1000.0 - 0.5 * std::pow(10.0, 3 - digits);  // what so many digits make 1000
  return std::abs(force) >= kilo ? fmt::format("{:.{}g} kN", force / 1000, digits)
                                 : fmt::format("{:.{}g} N", force, digits);
}

std::string capital(std::string text) {
  if (!text.empty()) text.front() = static_cast<char>(std::toupper(static_cast<unsigned char>(text.front())));
  return text;
}

std::string heading(const std::string& name, const std::string& unit) {
  return unit == "-" ? name : name + " [" + unit + "]";
}

std::string heading(const TractionChannel& channel) {
  return fmt::format("{} [{}]", capital(std::string(channel.title)), channel.unit);
}

std::string in_unit(std::size_t channel, double si) {
  return fmt::format("{} {}", number(si * traction_channels[channel].per_si), traction_channels[channel].unit);
}

}  // namespace soilbin::compare
