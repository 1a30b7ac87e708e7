#include "compare/report/report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>

#include "compare/report/heat_map.hpp"
#include "compare/report/json_fields.hpp"
#include "scenario/atomic_file.hpp"
#include "scenario/csv.hpp"

namespace soilbin::compare {
namespace {

Table table_of(const NamedValues& values) {
  Table table{"", {"", ""}, {true, true}};
  for (const auto& [name, value] : values.all) table.add({name, value});
  return table;
}

/// Escaped prose whose percent signs stay with their numbers.
std::string prose(const std::string& text) {
  std::string out = escaped(text);
  for (std::size_t at = out.find(" %"); at != std::string::npos; at = out.find(" %", at)) out.replace(at, 1, "\u00a0");
  return out;
}

/// Sentences follow each other, anything else stands between blank lines.
class TerminalWriter {
 public:
  void block(const std::string& text) { add(text, true); }
  void lines(const std::vector<std::string>& lines) {
    if (!lines.empty()) block(fmt::format("{}\n", fmt::join(lines, "\n")));
  }
  void tell(const Headline& headline) {
    for (const BackedSentence& one : headline.all)
      block(fmt::format("{}. {}\n{}{}", one.about, one.text, one.detail, one.detail.empty() ? "" : "\n"));
  }
  void tell(const Sentences& sentences) {
    for (const BackedSentence& one : sentences.all)
      add((one.about.empty() ? "" : one.about + ": ") + one.text + "\n", false);
  }
  void tell(const Prose& prose) {
    for (const std::string& paragraph : prose.paragraphs) add(paragraph + "\n", false);
  }
  void tell(const Items& items) { lines(items.all); }
  void tell(const NamedValues& values) {
    std::size_t longest = 0;
    for (const auto& [name, value] : values.all) longest = std::max(longest, name.size());
    std::string text;
    for (const auto& [name, value] : values.all) text += fmt::format("  {:<{}}{}\n", name, longest + 2, value);
    block(text);
  }
  void tell(const Table& table) {
    if (!table.rows.empty()) block(as_text(table));
  }
  void tell(const Code& code) { block(code.text); }
  template <class Drawn>
  void tell(const Drawn&) {}
  const std::string& all() const { return all_; }

 private:
  void add(const std::string& text, bool is_block) {
    if (!all_.empty() && (is_block || ends_with_block_)) all_ += "\n";
    all_ += text, ends_with_block_ = is_block;
  }

  std::string all_;
  bool ends_with_block_ = false;
};

class PageWriter : public Page {
 public:
  PageWriter(const Report& report, const PageAbout& about)
      : Page(report.title, report.subtitle), doubts_(about.doubts) {}

  void tell(const std::vector<ReportPart>& parts) {
    for (const ReportPart& part : parts) {
      if (!holds(part.told, Told::on_pages)) continue;
      if (!part.section.empty()) head(part);
      std::visit([&](const auto& content) { tell(content); }, part.content);
    }
  }
  void tell(const Sentences& sentences) {
    if (!sentences.all.empty()) summary(sentences.all);
  }
  void tell(const Headline& headline) { summary(headline.all); }
  void tell(const Prose& paragraphs) {
    for (const std::string& text : paragraphs.paragraphs) raw("<p>" + prose(text) + "</p>\n");
  }
  void tell(const Items& items) {
    raw("<ul>");
    for (const std::string& item : items.all) raw("<li>" + prose(item) + "</li>");
    raw("</ul>\n");
  }
  void tell(const NamedValues& values) { raw(html_of(table_of(values))); }
  void tell(const Table& table) {
    raw(html_of(table));
    if (!table.legend.empty()) tell(Prose{{table.legend}});
  }
  void tell(const Code& code) { raw("<pre><code>" + escaped(code.text) + "</code></pre>\n"); }
  void tell(const KeyFigures& figures) {
    raw("<div class=\"glance\">");
    for (const KeyFigure& one : figures.all)
      raw("<div><b>" + escaped(one.value) + "</b><span>" + escaped(one.meaning) + "</span></div>");
    raw("</div>\n");
  }
  void tell(const Figure& one) {
    if (const Sheet sheet = one.sheet(); !sheet.plots.empty()) figure(sheet, one.caption);
  }
  /// Heat maps side by side as the width allows, each at its own size; else one below the other.
  void tell(const Drawings& drawings) {
    const std::string caption = "</div><figcaption>" + escaped(drawings.caption) + "</figcaption></figure>\n";
    if (drawings.are_heat_maps) {
      raw("<figure><div class=\"maps\">");
      for (const std::string& map : drawings.svgs) raw("<div>" + map + "</div>\n");
      return raw(caption);
    }
    for (const std::string& svg : drawings.svgs) raw("<figure><div class=\"panels\">" + svg + caption);
  }
  void tell(const Fold& fold) {
    const std::string id = fold.anchor.empty() ? "" : " id=\"" + escaped(fold.anchor) + "\"";
    raw("<details" + id + "><summary>" + escaped(fold.title) + "</summary>\n");
    tell(fold.parts());
    raw("</details>\n");
  }
  void tell(const Choices& choices) {
    raw(fmt::format("<div class=\"choices\" data-what=\"{}\">\n", escaped(choices.what)));
    for (std::size_t i = 0; i < choices.all.size(); ++i) {
      raw(fmt::format("<div class=\"choice\" data-name=\"{0}\"{1}><h3>{0}</h3>\n", escaped(choices.all[i].first),
                      i == choices.first ? " data-first" : ""));
      tell(choices.all[i].second());
      raw("</div>\n");
    }
    raw("</div>\n");
  }
  void tell(const Cards& cards) {
    raw("<div class=\"cards\">");
    for (const PageCard& card : cards.all)  // titles, lines and drawings are escaped already: page_card
      raw(fmt::format("<a class=\"card\" href=\"{}\">{}<b>{}</b><span>{}</span></a>\n", escaped(card.href),
                      card.drawing, card.title, card.line));
    raw("</div>\n");
  }
  void tell(const ReplayView& view) { replay(view.title, view.bytes, view.caption); }
  void tell(const Html& html) { raw(html.text); }
  void tell(const WarningsHere&) {
    if (doubts_.empty()) return;
    section("Warnings", "doubts");
    tell(Items{doubts_});
  }

 private:
  void head(const ReportPart& part) {
    if (part.heading == ReportPart::Heading::place) return place(part.section, part.anchor);
    if (part.heading == ReportPart::Heading::subsection) return raw("<h3>" + escaped(part.section) + "</h3>\n");
    section(part.section, part.anchor);
  }

  /// Sentences in a box, each behind the name of what it is about and followed by links to what backs it.
  void summary(const std::vector<BackedSentence>& sentences) {
    if (!sentences.empty()) describe(sentences.front().text);
    raw("<div class=\"summary\">");
    for (const BackedSentence& sentence : sentences) {
      raw("<p>" + (sentence.about.empty() ? "" : "<b>" + escaped(sentence.about) + ".</b> ") + prose(sentence.text));
      for (const auto& [anchor, text] : sentence.evidence)
        raw(fmt::format(" <a class=\"evidence\" href=\"#{}\">{}</a>", escaped(anchor), escaped(text)));
      if (!sentence.detail.empty()) raw(" <small>" + prose(sentence.detail) + "</small>");
      raw("</p>");
    }
    raw("</div>\n");
  }

  const std::vector<std::string>& doubts_;
};

/// A cell or a sentence that can't be taken for markup.
std::string plain(const std::string& text) {
  std::string out;
  for (const char c : text) {
    if (c == '|' || c == '<' || c == '*' || c == '_' || c == '\\' || c == '`') out += '\\';
    out += c == '\n' ? ' ' : c;
  }
  return out;
}

/// Markdown that grows from top to bottom in a folder, which is made, with its figures and their data beside it.
class MarkdownWriter {
 public:
  MarkdownWriter(std::filesystem::path folder, bool decimal_comma)
      : folder_(std::move(folder)), decimal_comma_(decimal_comma) {
    make_folder(folder_);
  }

  /// A paragraph, as it is.
  void text(const std::string& paragraph) { body_ += paragraph + "\n\n"; }
  void file(const std::string& name, const std::string& text) const { write_file_atomically(folder_ / name, text); }
  void csv(const std::string& name, const std::string& text) const {
    file(name + ".csv", decimal_comma_ ? with_decimal_commas(text) : text);
  }
  /// Writes report.md.
  void write() const { file("report.md", body_); }

  void tell(const std::vector<ReportPart>& parts) {
    for (const ReportPart& part : parts) {
      if (!holds(part.told, Told::in_documents) || std::holds_alternative<Fold>(part.content)) continue;
      if (!part.section.empty())
        text((part.heading == ReportPart::Heading::subsection ? "### " : "## ") + plain(part.section));
      std::visit([&](const auto& content) { tell(content); }, part.content);
    }
  }
  void tell(const Sentences& sentences) {
    for (const BackedSentence& one : sentences.all)
      text(fmt::format("- {}{}", one.about.empty() ? "" : "**" + plain(one.about) + ".** ", plain(one.text)));
  }
  void tell(const Headline& headline) {
    for (const BackedSentence& one : headline.all)
      text(fmt::format("- **{}.** {} {}", plain(one.about), plain(one.text), plain(one.detail)));
  }
  void tell(const Prose& prose) {
    for (const std::string& paragraph : prose.paragraphs) text(plain(paragraph));
  }
  void tell(const Items& items) {
    for (const std::string& item : items.all) text("- " + plain(item));
  }
  void tell(const NamedValues& values) { tell(table_of(values)); }
  void tell(const Table& table) {
    if (!table.caption.empty()) body_ += plain(table.caption) + ".\n\n";
    std::string rule = "|";
    for (std::size_t c = 0; c < table.header.size(); ++c) rule += table.is_text(c) ? ":--|" : "--:|";
    for (const std::vector<std::string>& line : lines_of(table)) {
      body_ += "|";
      for (const std::string& cell : line) body_ += " " + plain(cell) + " |";
      body_ += "\n" + rule + (rule.empty() ? "" : "\n");
      rule.clear();
    }
    body_ += "\n";
    if (!table.legend.empty()) text(plain(table.legend));
  }
  void tell(const Code& code) { text("```\n" + code.text + "```"); }
  void tell(const KeyFigures& figures) {
    for (const KeyFigure& one : figures.all) text(fmt::format("- {}: {}", plain(one.meaning), plain(one.value)));
  }
  void tell(const Figure& one) { figure(one.name.empty() ? next_name() : one.name, one.sheet()); }
  void tell(const Drawings& drawings) {
    std::size_t place = 0;
    for (const std::string& svg : drawings.svgs)
      picture(drawings.name.empty()       ? next_name()
              : drawings.svgs.size() == 1 ? drawings.name
                                          : fmt::format("{}-{}", drawings.name, ++place),
              drawings.are_heat_maps ? on_paper(svg) : svg, drawings.caption);
  }
  void tell(const Choices& choices) {
    for (std::size_t i = 0; i < choices.all.size(); ++i)
      if (choices.all_in_documents || i == choices.first)
        text("### " + plain(choices.all[i].first)), tell(choices.all[i].second());
  }
  template <class OfPages>
  void tell(const OfPages&) {}

 private:
  std::string next_name() { return fmt::format("figure-{}", ++figures_); }
  /// A drawing NAME.svg, NAME.csv and NAME.json with its numbers, and links to them; nothing for a sheet without plots.
  void figure(const std::string& name, const Sheet& sheet) {
    if (sheet.plots.empty()) return;
    picture(name, svg(sheet), sheet.title.empty() ? name : sheet.title);
    csv(name, sheet_csv(sheet));
    file(name + ".json", json_text(to_json(sheet)));
    body_ += fmt::format("Data: [CSV]({0}.csv), [JSON]({0}.json).\n\n", name);
  }
  void picture(const std::string& name, const std::string& drawing, const std::string& title) {
    file(name + ".svg", drawing);
    body_ += fmt::format("![{}]({}.svg)\n\n", plain(title), name);
  }

  std::filesystem::path folder_;
  bool decimal_comma_;
  std::string body_;
  int figures_ = 0;
};

/// The parts with a place for the doubts, which stand behind the first sentences where nothing else is said.
std::vector<ReportPart> with_warnings(std::vector<ReportPart> parts) {
  const auto is_a = [](auto type) {
    return [type](const ReportPart& part) { return std::holds_alternative<decltype(type)>(part.content); };
  };
  if (std::ranges::any_of(parts, is_a(WarningsHere()))) return parts;
  const auto first = std::ranges::find_if(parts, [&](const ReportPart& part) {
    return holds(part.told, Told::on_pages) &&
           (std::holds_alternative<Sentences>(part.content) || std::holds_alternative<Headline>(part.content));
  });
  parts.insert(first == parts.end() ? first : first + 1, {WarningsHere()});
  return parts;
}

}  // namespace

std::function<Sheet()> drawn_once(std::function<Sheet()> draw) {
  return [draw = std::move(draw), drawn = std::make_shared<std::optional<Sheet>>()] {
    if (!*drawn) *drawn = draw();
    return **drawn;
  };
}

std::string text_of(const Report& report) {
  TerminalWriter text;
  if (!report.heading.empty()) text.block(report.heading + "\n");
  for (const ReportPart& part : report.parts)
    if (holds(part.told, Told::on_terminals))
      std::visit([&](const auto& content) { text.tell(content); }, part.content);
  text.lines(report.notes);
  return text.all();
}

std::string page_of(const Report& report, const PageAbout& about) {
  PageWriter page(report, about);
  if (const std::vector<std::string>& missing = page.libraries().missing; !missing.empty())
    page.raw(
        fmt::format("<p class=\"warning\" role=\"note\">Made without {}: the figures that need it are plain drawings. "
                    "Install it and make the page again.</p>\n",
                    escaped(fmt::format("{}", fmt::join(missing, ", ")))));
  page.tell(with_warnings(report.parts));
  page.section("How to repeat this", "repeat");
  page.tell(Code{about.command});
  if (!report.notes.empty()) page.tell(Items{report.notes});
  Table facts{"", {"part", ""}, {true, true}};
  for (const auto* list : {&report.made_of, &about.versions})
    for (const auto& [name, value] : *list) facts.add({name, value});
  page.tell(facts);
  if (!report.resolved_case.empty())
    page.tell(Fold{"The resolved case", [&] { return std::vector<ReportPart>{{Code{report.resolved_case}}}; }});
  return page.html();
}

void write_markdown(const std::filesystem::path& folder, const Report& report, const PageAbout& about,
                    bool decimal_comma) {
  MarkdownWriter md(folder, decimal_comma);
  md.text("# " + plain(report.title));
  if (!report.subtitle.empty()) md.text(plain(report.subtitle));
  md.tell(report.parts);
  if (!about.doubts.empty()) md.text("## Warnings");
  md.tell(Items{about.doubts});
  md.text("## How to repeat this");
  md.text("    " + about.command);
  if (!report.resolved_case.empty()) md.text("The resolved case is [case.yaml](case.yaml).");
  md.tell(Items{report.notes});
  for (const auto* list : {&report.made_of, &about.versions})
    for (const auto& [name, value] : *list) md.text(fmt::format("- {}: {}", plain(name), plain(value)));
  md.write();
  if (!report.resolved_case.empty()) md.file("case.yaml", report.resolved_case);
  if (report.csv) md.csv(report.csv_name, report.csv());
  if (report.data) md.file(report.data_name + ".json", json_text(report.data()));
}

}  // namespace soilbin::compare
