#include "compare/report/page.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <string_view>

#include "compare/report/json_fields.hpp"
#include "scenario/errors.hpp"
#include "scenario/file_bytes.hpp"

namespace soilbin::compare {
namespace {

namespace fs = std::filesystem;

std::string numbered(std::size_t section) { return fmt::format("part-{}", section + 1); }

std::string id_attribute(const std::string& anchor) { return anchor.empty() ? "" : " id=\"" + escaped(anchor) + "\""; }

/// Colours of one scheme as custom properties.
std::string palette_properties(const char* Color::*scheme) {
  std::string css;
  for (const auto& [palette, letter] : {std::pair{Palette::named, 'c'}, std::pair{Palette::ordered, 'q'}}) {
    const std::vector<Color> all = colors(palette);
    for (std::size_t i = 0; i < all.size(); ++i) css += fmt::format("--{}{}:{};", letter, i, all[i].*scheme);
  }
  return css;
}

/// Rules that give the marks of the plots their scheme's colour.
std::string palette_rules() {
  std::string css;
  for (const auto& [palette, letter] : {std::pair{Palette::named, 'c'}, std::pair{Palette::ordered, 'q'}})
    for (std::size_t i = 0; i < colors(palette).size(); ++i)
      css += fmt::format(
          ".s.{0}{1}{{stroke:var(--{0}{1})}}.f.{0}{1}{{fill:var(--{0}{1})}}.dot.{0}{1}{{background:var(--{0}{1})}}\n",
          letter, i);
  return css;
}

/// CSS for both colour schemes, the palettes of plot.hpp included.
std::string page_style() {
  const std::string light =
      "--ground:#f6f7f9;--paper:#fff;--ink:#1a1d23;--quiet:#5a6270;--edge:#dfe3e8;--line:#8a919c;--link:#0b63a8;" +
      palette_properties(&Color::light);
  const std::string dark =
      "--ground:#111418;--paper:#191d23;--ink:#e8eaee;--quiet:#a2abb8;--edge:#2d333c;--line:#6d7683;--link:#6cb6ff;" +
      palette_properties(&Color::dark);
  return fmt::format(
      ":root{{color-scheme:light dark}}:root,.as-saved{{{}}}\n@media screen and "
      "(prefers-color-scheme:dark){{:root{{{}}}}}\n{}{}",
      light, dark, '\n' + embedded(own_files(), "page.css") + embedded(own_files(), "answers.css"), palette_rules());
}

constexpr std::size_t largest_page = 1U << 28U;  ///< [bytes]

/// A text's first sentences, or where they are too long its first words.
std::string beginning(const std::string& text) {
  constexpr std::size_t most = 170, least = 50;
  if (text.size() <= most) return text;
  if (const std::size_t stop = text.rfind(". ", most); stop != std::string::npos && stop >= least)
    return text.substr(0, stop + 1);
  return text.substr(0, text.rfind(' ', most)) + " \u2026";
}

/// The text from `begin` to `end`, both left out, or with both; "" where it isn't there.
std::string between(const std::string& text, const std::string& begin, const std::string& end, bool with_both = false) {
  const std::size_t first = text.find(begin);
  if (first == std::string::npos) return "";
  const std::size_t last = text.find(end, first + begin.size());
  if (last == std::string::npos) return "";
  if (with_both) return text.substr(first, last + end.size() - first);
  return text.substr(first + begin.size(), last - first - begin.size());
}

/// Text of a page as text of another: its entities stay, tags are none.
std::string without_tags(const std::string& text) {
  std::string out;
  for (const char c : text) out += c == '<' ? "&lt;" : c == '>' ? "&gt;" : c == '"' ? "&quot;" : std::string(1, c);
  return out;
}

/// Whether what stands between < and > is a shape or words of a drawing, with attributes that name no program, style or
/// other file.
bool is_plain_tag(std::string_view inside) {
  constexpr std::array<std::string_view, 11> shapes = {"svg",      "g",       "path", "line",  "rect", "circle",
                                                       "polyline", "polygon", "text", "tspan", "title"};
  constexpr std::array<std::string_view, 4> refused = {"on", "style", "href", "src"};
  if (inside.starts_with('/')) inside.remove_prefix(1);
  if (inside.ends_with('/')) inside.remove_suffix(1);
  const std::string_view shape = inside.substr(0, inside.find(' '));
  if (std::ranges::find(shapes, shape) == shapes.end()) return false;
  for (inside.remove_prefix(shape.size()); !inside.empty();) {  // each: a blank, name="value"
    const std::size_t equals = inside.find("=\""), end = inside.find('"', std::min(equals, inside.size() - 1) + 2);
    if (inside.front() != ' ' || equals == inside.npos || end == inside.npos) return false;
    std::string name(inside.substr(1, equals - 1)), value(inside.substr(equals + 2, end - equals - 2));
    for (std::string* text : {&name, &value})
      std::ranges::transform(*text, text->begin(), [](unsigned char c) { return std::tolower(c); });
    if (name.find_first_not_of("abcdefghijklmnopqrstuvwxyz0123456789-") != name.npos) return false;
    if (std::ranges::any_of(refused, [&](std::string_view word) { return name.starts_with(word); })) return false;
    if (value.find("url(") != value.npos || value.find("script:") != value.npos) return false;
    inside.remove_prefix(end + 1);
  }
  return true;
}

/// Whether an SVG text is a drawing and nothing else, as soilbin writes them. A page that somebody changed may hold
/// others.
bool is_plain_drawing(std::string_view svg) {
  for (std::size_t at = svg.find('<'); at != svg.npos; at = svg.find('<', at + 1)) {
    const std::size_t end = svg.find('>', at);
    if (end == svg.npos || !is_plain_tag(svg.substr(at + 1, end - at - 1))) return false;
  }
  return true;
}

}  // namespace

PageCard page_card(const fs::path& page, const fs::path& from) {
  const std::string text = read_bytes(page, largest_page);
  PageCard card{fs::relative(page, from.parent_path().empty() ? fs::path(".") : from.parent_path()).generic_string(),
                without_tags(between(text, "<title>", "</title>")),
                without_tags(beginning(between(text, "<meta name=\"description\" content=\"", "\">"))),
                between(text, "<svg class=\"plot\"", "</svg>", true)};
  if (card.drawing.empty())  // a page of heat maps
    card.drawing = between(text, "<svg xmlns=\"http://www.w3.org/2000/svg\" class=\"plot heat\"", "</svg>", true);
  if (!is_plain_drawing(card.drawing)) card.drawing.clear();
  if (card.title.empty())
    throw InputError(
        fmt::format("{}: no page of soilbin\n  hint: --report of compare, loop, reproduce and failure-map writes one",
                    page.string()));
  return card;
}

Page::Page(std::string title, std::string subtitle) : title_(std::move(title)), subtitle_(std::move(subtitle)) {}

void Page::describe(const std::string& text) {
  if (description_.empty()) description_ = text;
}

void Page::section(const std::string& title, const std::string& anchor) {
  sections_.emplace_back(anchor.empty() ? numbered(sections_.size()) : anchor, title);
  body_ += fmt::format("<h2{}>{}</h2>\n", id_attribute(sections_.back().first), escaped(title));
}

void Page::place(const std::string& title, const std::string& anchor) {
  sections_.emplace_back(anchor, title);
  body_ += fmt::format("<span{}></span>\n", id_attribute(anchor));
}

void Page::figure(const Sheet& sheet, const std::string& caption) {
  sheets_.push_back(sheet);
  body_ += fmt::format("<figure id=\"figure-{}\">", sheets_.size());
  const std::vector<LegendEntry> entries = legend(sheet);
  if (!entries.empty()) {
    body_ += "<ul class=\"legend\">";
    for (const LegendEntry& entry : entries) body_ += "<li>" + entry.swatch + escaped(entry.label) + "</li>";
    body_ += "</ul>";
  }
  body_ += "<div class=\"panels\">\n";
  for (std::size_t i = 0; i < sheet.plots.size(); ++i) body_ += panel_svg(sheet, i) + "\n";
  body_ += "</div><figcaption>" + escaped(caption) + "</figcaption></figure>\n";
}

void Page::replay(const std::string& title, const std::string& bytes, const std::string& caption) {
  has_replay_ = true;
  const bool can = libraries_.three && libraries_.orbit;
  body_ += fmt::format(
      "<figure><div class=\"replay\" role=\"group\" aria-label=\"Replay in 3D: {}\"><p "
      "class=\"replay-note\">{}</p></div><figcaption>{}</figcaption></figure>\n",
      escaped(title),
      can ? "The replay needs scripts, which this browser doesn't run."
          : "The replay can't be shown: three.js was not installed where this page was made (package libjs-three).",
      escaped(caption));
  if (can) body_ += "<script type=\"text/plain\" id=\"replay-data\">" + base64(bytes) + "</script>\n";
}

std::string Page::scripts() const {
  nlohmann::ordered_json figures = nlohmann::ordered_json::object();
  for (std::size_t i = 0; i < sheets_.size(); ++i) figures[fmt::format("figure-{}", i + 1)] = to_json(sheets_[i]);
  return "<script type=\"application/json\" id=\"figures\">" +
         json_in_script(figures.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace)) + "</script>\n" +
         script_elements(libraries_, has_replay_) +
         (extra_scripts_.empty() ? "" : "<script>\n" + in_script(extra_scripts_) + "</script>\n");
}

std::string Page::html() const {
  std::string contents;
  for (std::size_t i = 0; i < sections_.size(); ++i)
    contents += fmt::format("<a href=\"#{}\">{}</a>", escaped(sections_[i].first), escaped(sections_[i].second));
  if (sections_.size() < 2) contents.clear();
  return fmt::format(
      "<!doctype html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
      "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n<title>{0}</title>\n"
      "<meta name=\"description\" content=\"{6}\">\n"
      "<style>\n{1}</style>\n</head>\n<body>\n<main>\n<h1>{0}</h1>\n<p "
      "class=\"subtitle\">{2}</p>\n{3}{4}</main>\n{5}</body>\n</html>\n",
      escaped(title_), page_style(), escaped(subtitle_), contents.empty() ? "" : "<nav>" + contents + "</nav>\n", body_,
      scripts(), escaped(description_.empty() ? subtitle_ : description_));
}

}  // namespace soilbin::compare
