#include "compare/report/bars.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "compare/report/number_text.hpp"
#include "compare/report/plot.hpp"
#include "compare/report/plot_panel.hpp"

namespace soilbin::compare {
namespace {

constexpr double width = 420, margin = 70, thick = 13, gap = 30, top = 30;

/// Values' range with zero in it.
std::pair<double, double> range_of(const Bars& bars) {
  double low = 0.0, high = 0.0;
  for (const BarGroup& group : bars.groups)
    for (const double value : group.values)
      if (std::isfinite(value)) low = std::min(low, value), high = std::max(high, value);
  return low == high ? std::pair{0.0, 1.0} : std::pair{low, high};
}

}  // namespace

std::string bars_svg(const Bars& bars, const std::vector<int>& colors_of_sides) {
  const auto [low, high] = range_of(bars);
  const auto x = [&, low = low, high = high](double value) {
    return margin + (value - low) / (high - low) * (width - 2 * margin);
  };
  std::string body =
      fmt::format(R"(<text class="ink" fill="#1a1d23" font-size="13" font-weight="600" x="4" y="17">{}</text>)",
                  escaped(bars.title));
  double y = top;
  for (const BarGroup& group : bars.groups) {
    body += fmt::format(R"(<text class="ink" fill="#1a1d23" x="4" y="{:.0f}">{}</text>)", y + 12, escaped(group.name));
    y += 18;
    const double first = y;
    for (std::size_t s = 0; s < group.values.size(); ++s, y += thick + 2) {
      const double value = group.values[s], from = x(0.0), to = std::isfinite(value) ? x(value) : from;
      const std::string tip = fmt::format("{}, {}: {} {}", group.name, bars.sides[s], number(value), bars.unit);
      body += fmt::format(R"(<g data-x="{}" data-y="{}" data-value="{}" )", escaped(bars.sides[s]), escaped(group.name),
                          std::isfinite(value) ? fmt::format("{:.6g}", value) : "");
      body += fmt::format(R"(data-tip="{0}" role="img" aria-label="{0}"><title>{0}</title>)", escaped(tip));
      body += fmt::format(R"(<rect {} x="{:.1f}" y="{:.1f}" width="{:.1f}" height="{:.0f}"/>)",
                          fill(Palette::named, colors_of_sides[s]), std::min(from, to), y,
                          std::max(std::abs(to - from), 0.5), thick);
      const bool negative = std::isfinite(value) && value < 0.0;
      body += fmt::format(R"(<text class="quiet" fill="#5a6270" x="{:.1f}" y="{:.1f}" text-anchor="{}">{}</text></g>)",
                          negative ? to - 5 : to + 5, y + 11, negative ? "end" : "start", number(value));
    }
    body +=  // beside the bars alone: it would cross the names
        fmt::format(
            R"(<line class="quiet-line" stroke="#8a919c" x1="{0:.1f}" x2="{0:.1f}" y1="{1:.0f}" y2="{2:.0f}"/>)",
            x(0.0), first - 2, y);
    y += gap - 18;
  }
  for (std::size_t s = 0; s < bars.sides.size(); ++s, y += 18)
    body += fmt::format(R"(<rect {} x="8" y="{:.0f}" width="18" height="10"/>)"
                        R"(<text class="ink" fill="#1a1d23" x="34" y="{:.0f}">{}</text>)",
                        fill(Palette::named, colors_of_sides[s]), y, y + 9, escaped(bars.sides[s]));
  return fmt::format(
      R"(<svg xmlns="http://www.w3.org/2000/svg" class="plot bars" viewBox="0 0 {:.0f} {:.0f}" role="group" aria-label="{}" )"
      R"(font-size="12">{}</svg>)",
      width, y + 6, escaped(bars.title), body);
}

}  // namespace soilbin::compare
