#include "compare/report/plot_panel.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace soilbin::compare {
namespace {

/// Lower and upper end of an axis.
struct Span {
  double lower = std::numeric_limits<double>::infinity();
  double upper = -std::numeric_limits<double>::infinity();

  void take(double x) {
    if (std::isfinite(x)) lower = std::min(lower, x), upper = std::max(upper, x);
  }
  double length() const { return upper - lower; }
};

/// The error that is drawn.
double error_at(const Series& series, std::size_t i) {
  const double error = series.band && i < series.error.size() ? series.error[i] : 0.0;
  return std::isfinite(error) ? error : 0.0;
}

/// Whether its errors are bars at its points, which may hide those of another series.
bool has_bars(const Series& series) {
  return (series.mark == Mark::points || series.y.size() == 1) && series.band && !series.error.empty() &&
         series.base.empty();
}

bool share_a_place(const Series& a, const Series& b) {
  return std::ranges::any_of(a.x, [&](double x) { return std::ranges::find(b.x, x) != b.x.end(); });
}

/// Whether a series lies on points of another one, which it marks.
bool marks_points_of(const Series& marks, const Series& series) {
  if (marks.mark != Mark::points || marks.x.empty()) return false;
  for (std::size_t i = 0; i < marks.x.size(); ++i) {
    bool there = false;
    for (std::size_t k = 0; k < series.x.size(); ++k)
      there = there || (series.x[k] == marks.x[i] && series.y[k] == marks.y[i]);
    if (!there) return false;
  }
  return true;
}

/// An axis's limits: those asked for, else the values' with a little room.
Span with_room(Span span, const Axis& axis, double room) {
  if (!(span.upper >= span.lower)) span = {0.0, 1.0};
  if (span.length() == 0.0) {
    const double half = span.lower == 0.0 ? 0.5 : 0.1 * std::abs(span.lower);
    span = {span.lower - half, span.upper + half};
  }
  const double pad = room * (span.upper - std::min(span.lower, axis.lower.value_or(span.lower)));
  const bool touches_zero = span.lower == 0.0;
  span = {touches_zero ? 0.0 : span.lower - pad, span.upper + pad};
  return {axis.lower.value_or(span.lower), axis.upper.value_or(span.upper)};
}

/// Where values lie in the panel.
class Frame {
 public:
  explicit Frame(const Plot& plot) {
    Span x, y;
    for (const Series& series : plot.series)
      for (std::size_t i = 0; i < series.x.size(); ++i) {
        if (!std::isfinite(series.y[i])) continue;
        x.take(series.x[i]);
        y.take(series.y[i] - error_at(series, i));
        y.take(series.y[i] + error_at(series, i));
        if (!series.base.empty()) y.take(series.base[i]);
      }
    if (plot.identity_line) x.take(y.lower), x.take(y.upper), y.take(x.lower), y.take(x.upper);
    x_ = with_room(x, plot.x, 0.02);
    y_ = with_room(y, plot.y, 0.05);
    // A single place has one tick: points beside each other there would be read at other ones.
    x_ticks = x.length() == 0.0 ? std::vector{x.lower} : ticks(x_.lower, x_.upper, 6);
    y_ticks = ticks(y_.lower, y_.upper, 5);
    std::size_t longest = 1;
    for (const double tick : y_ticks) longest = std::max(longest, label(tick, y_ticks).size());
    left = (plot.y.title.empty() ? 18.0 : 34.0) + 7.0 * static_cast<double>(longest);
  }

  double left, top = 30.0;
  static double right() { return panel_width - 12.0; }
  static double bottom() { return panel_height - 42.0; }
  double x(double value) const { return left + (value - x_.lower) / x_.length() * (right() - left); }
  /// y of what ends at the panel's edge, where its axis ends before the value.
  double inside(double value) const { return y(std::clamp(value, y_.lower, y_.upper)); }
  double y(double value) const { return bottom() - (value - y_.lower) / y_.length() * (bottom() - top); }
  const Span& y_span() const { return y_; }
  const Span& x_span() const { return x_; }
  std::vector<double> x_ticks, y_ticks;

  /// A tick's number with as many places as the step needs, a true minus sign, thousands apart.
  static std::string label(double value, const std::vector<double>& all) {
    if (all.size() == 1) return fmt::format("{:.4g}", value);
    const double step = all[1] - all[0];
    const int places = std::clamp(-static_cast<int>(std::floor(std::log10(step) + 1e-9)), 0, 9);
    const double rounded = std::abs(value) < 1e-9 * step ? 0.0 : value;
    return fmt::format("{:.{}f}", rounded, places);
  }

 private:
  Span x_, y_;
};

std::string with_minus(std::string text) {
  if (text.starts_with("-")) text.replace(0, 1, "\u2212");
  return text;
}

std::string grid(const Frame& f) {
  std::string out;
  for (const double tick : f.y_ticks) {
    const bool zero = std::abs(tick) < 1e-12 * f.y_span().length();
    out += fmt::format(R"(<line class="{}" stroke="{}" x1="{:.1f}" x2="{:.1f}" y1="{:.1f}" y2="{:.1f}"/>)",
                       zero ? "quiet-line" : "grid", zero ? "#8a919c" : "#e3e6ea", f.left, f.right(), f.y(tick),
                       f.y(tick));
    out += fmt::format(R"(<text class="quiet" fill="#5a6270" x="{:.1f}" y="{:.1f}" text-anchor="end">{}</text>)",
                       f.left - 6, f.y(tick) + 4, with_minus(Frame::label(tick, f.y_ticks)));
  }
  for (const double tick : f.x_ticks) {
    out += fmt::format(
        R"(<line class="quiet-line" stroke="#8a919c" x1="{0:.1f}" x2="{0:.1f}" y1="{1:.1f}" y2="{2:.1f}"/>)", f.x(tick),
        f.bottom(), f.bottom() + 4);
    out += fmt::format(R"(<text class="quiet" fill="#5a6270" x="{:.1f}" y="{:.1f}" text-anchor="middle">{}</text>)",
                       f.x(tick), f.bottom() + 17, with_minus(Frame::label(tick, f.x_ticks)));
  }
  return out +
         fmt::format(R"(<path class="quiet-line" stroke="#8a919c" fill="none" d="M{0:.1f} {1:.1f}V{2:.1f}H{3:.1f}"/>)",
                     f.left, f.top, f.bottom(), f.right());
}

std::string words(const Plot& plot, const Frame& f) {
  std::string out =
      fmt::format(R"(<text class="ink" fill="#1a1d23" font-size="13" font-weight="600" x="{:.1f}" y="17">{}</text>)",
                  16.0, escaped(plot.title));
  out += fmt::format(R"(<text class="quiet" fill="#5a6270" x="{:.1f}" y="{:.1f}" text-anchor="middle">{}</text>)",
                     0.5 * (f.left + f.right()), panel_height - 8, escaped(plot.x.title));
  if (plot.y.title.empty()) return out;
  const double middle = 0.5 * (f.top + f.bottom());
  return out + fmt::format(R"svg(<text class="quiet" fill="#5a6270" text-anchor="middle" )svg"
                           R"svg(transform="translate(14 {:.1f}) rotate(-90)">{}</text>)svg",
                           middle, escaped(plot.y.title));
}

/// Runs of neighbouring points whose y is finite: [first, last).
std::vector<std::pair<std::size_t, std::size_t>> unbroken(const Series& series) {
  std::vector<std::pair<std::size_t, std::size_t>> parts;
  for (std::size_t i = 0; i < series.y.size(); ++i) {
    if (!std::isfinite(series.y[i])) continue;
    if (parts.empty() || parts.back().second != i) parts.push_back({i, i});
    parts.back().second = i + 1;
  }
  return parts;
}

/// What a series fills: its band of one standard error, or the area down to its base.
std::string band(const Sheet& sheet, const Series& series, const Frame& f) {
  std::string out;
  const bool area = !series.base.empty();
  if (!area && (series.error.empty() || !series.band || series.mark == Mark::points)) return out;
  for (const auto& [first, last] : unbroken(series)) {
    std::string upper, lower;
    for (std::size_t i = first; i < last; ++i) {
      const double high = area ? series.y[i] : series.y[i] + error_at(series, i);
      const double low = area ? series.base[i] : series.y[i] - error_at(series, i);
      upper += fmt::format("{:.1f},{:.1f} ", f.x(series.x[i]), f.inside(high));
      lower = fmt::format("{:.1f},{:.1f} ", f.x(series.x[i]), f.inside(low)) + lower;
    }
    out += fmt::format(R"(<polygon {} fill-opacity="{}" points="{}"/>)", fill(sheet.palette, color_of(sheet, series)),
                       area ? 0.45 : 0.15, upper + lower);
  }
  return out;
}

std::string line(const Sheet& sheet, const Series& series, const Frame& f) {
  if (series.mark == Mark::points || !series.base.empty()) return "";
  std::string path;
  for (const auto& [first, last] : unbroken(series))
    for (std::size_t i = first; i < last; ++i)
      path += fmt::format("{}{:.1f} {:.1f}", i == first ? "M" : "L", f.x(series.x[i]), f.y(series.y[i]));
  return fmt::format(
      R"(<path {}{} fill="none" stroke-width="2" stroke-linejoin="round" stroke-linecap="round" d="{}"/>)",
      stroke(sheet.palette, color_of(sheet, series)), dashes(series.dash), path);
}

std::string points(const Sheet& sheet, const Series& series, const Frame& f, double shift) {
  if ((series.mark == Mark::line && series.y.size() > 1) || !series.base.empty()) return "";
  const int color = color_of(sheet, series);
  std::string out;
  for (std::size_t i = 0; i < series.y.size(); ++i) {
    if (!std::isfinite(series.y[i])) continue;
    if (has_bars(series) && error_at(series, i) > 0.0)
      out += fmt::format(R"(<line {} x1="{:.1f}" x2="{:.1f}" y1="{:.1f}" y2="{:.1f}"/>)", stroke(sheet.palette, color),
                         f.x(series.x[i]) + shift, f.x(series.x[i]) + shift,
                         f.inside(series.y[i] - error_at(series, i)), f.inside(series.y[i] + error_at(series, i)));
    out += fmt::format(R"(<circle {} r="3.2" cx="{:.1f}" cy="{:.1f}"/>)", fill(sheet.palette, color),
                       f.x(series.x[i]) + shift, f.y(series.y[i]));
  }
  return out;
}

std::string identity(const Frame& f) {
  const double lower = std::max(f.x_span().lower, f.y_span().lower),
               upper = std::min(f.x_span().upper, f.y_span().upper);
  return fmt::format(R"(<line class="quiet-line" stroke="#8a919c" stroke-dasharray="4 4" )"
                     R"(x1="{:.1f}" y1="{:.1f}" x2="{:.1f}" y2="{:.1f}"/>)",
                     f.x(lower), f.y(lower), f.x(upper), f.y(upper));
}

}  // namespace

int color_of(const Sheet& sheet, const Series& series) {
  const int available = static_cast<int>(colors(sheet.palette).size());
  if (sheet.palette == Palette::named) return series.color % available;
  int most = 0;
  for (const Plot& plot : sheet.plots)
    for (const Series& s : plot.series) most = std::max(most, s.color);
  return most == 0 ? 0 : static_cast<int>(std::lround(static_cast<double>(series.color) * (available - 1) / most));
}

std::string stroke(Palette palette, int color) {
  return fmt::format(R"(class="s {}{}" stroke="{}")", palette == Palette::named ? 'c' : 'q', color,
                     colors(palette)[color].light);
}

std::string fill(Palette palette, int color) {
  return fmt::format(R"(class="f {}{}" fill="{}")", palette == Palette::named ? 'c' : 'q', color,
                     colors(palette)[color].light);
}

std::string dashes(int dash) {
  switch (dash % 4) {
    case 1:
      return R"( stroke-dasharray="7 4")";
    case 2:
      return R"( stroke-dasharray="1 4")";
    case 3:
      return R"( stroke-dasharray="8 4 1 4")";
    default:
      return "";
  }
}

std::vector<double> bar_shifts(const Plot& plot) {
  constexpr double apart = 9.0;  // [px]
  std::vector<double> shifts(plot.series.size(), 0.0);
  std::vector<std::size_t> together;
  for (std::size_t s = 0; s < shifts.size(); ++s)
    if (has_bars(plot.series[s]) && std::ranges::any_of(plot.series, [&](const Series& other) {
          return &other != &plot.series[s] && has_bars(other) && share_a_place(plot.series[s], other);
        }))
      together.push_back(s);
  for (std::size_t k = 0; k < together.size(); ++k)
    shifts[together[k]] = apart * (static_cast<double>(k) - 0.5 * static_cast<double>(together.size() - 1));
  for (std::size_t s = 0; s < shifts.size(); ++s)
    for (const std::size_t bars : together)
      if (!has_bars(plot.series[s]) && marks_points_of(plot.series[s], plot.series[bars])) shifts[s] = shifts[bars];
  return shifts;
}

std::string panel(const Sheet& sheet, const Plot& plot) {
  const Frame frame(plot);
  std::string out = grid(frame) + words(plot, frame);
  if (plot.identity_line) out += identity(frame);
  for (const Series& series : plot.series) out += band(sheet, series, frame);
  for (const Series& series : plot.series) out += line(sheet, series, frame);
  const std::vector<double> shifts = bar_shifts(plot);
  for (std::size_t s = 0; s < shifts.size(); ++s) out += points(sheet, plot.series[s], frame, shifts[s]);
  return out;
}

}  // namespace soilbin::compare
