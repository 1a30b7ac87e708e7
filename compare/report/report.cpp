#include "compare/report/report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>

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

class PageWriter {
 public:
  PageWriter(const Report& report, const PageAbout& about)
      : page_(about.title.empty() ? report.title : about.title, report.subtitle), doubts_(about.doubts) {}

  void tell(const std::vector<ReportPart>& parts) {
    for (const ReportPart& part : parts) {
      if (!holds(part.told, Told::on_pages)) continue;
      if (!part.section.empty()) head(part);
      std::visit([&](const auto& content) { tell(content); }, part.content);
    }
  }
  void tell(const Sentences& sentences) {
    if (!sentences.all.empty()) page_.summary(sentences.all);
  }
  void tell(const Headline& headline) { page_.summary(headline.all); }
  void tell(const Prose& prose) {
    for (const std::string& paragraph : prose.paragraphs) page_.paragraph(paragraph);
  }
  void tell(const Items& items) { page_.list(items.all); }
  void tell(const NamedValues& values) { page_.table(table_of(values)); }
  void tell(const Table& table) {
    page_.table(table);
    if (!table.legend.empty()) page_.paragraph(table.legend);
  }
  void tell(const Code& code) { page_.code(code.text); }
  void tell(const KeyFigures& figures) { page_.figures_at_a_glance(figures.all); }
  void tell(const Figure& figure) {
    if (const Sheet sheet = figure.sheet(); !sheet.plots.empty()) page_.figure(sheet, figure.caption);
  }
  void tell(const Drawings& drawings) {
    if (drawings.are_heat_maps) return page_.heat_maps(drawings.svgs, drawings.caption);
    for (const std::string& svg : drawings.svgs) page_.drawing(svg, drawings.caption);
  }
  void tell(const Fold& fold) {
    page_.folded(
        fold.title, [&] { tell(fold.parts()); }, fold.anchor);
  }
  void tell(const Choices& choices) {
    std::vector<Choice> all;
    for (const auto& [name, parts] : choices.all) all.push_back({name, [this, &parts = parts] { tell(parts()); }});
    page_.choices(choices.what, all, choices.first);
  }
  void tell(const Cards& cards) { page_.cards(cards.all); }
  void tell(const ReplayView& replay) { page_.replay(replay.title, replay.bytes, replay.caption); }
  void tell(const Html& html) { page_.raw(html.text); }
  void tell(const WarningsHere&) {
    if (doubts_.empty()) return;
    page_.section("Warnings", "doubts");
    page_.list(doubts_);
  }
  Page& page() { return page_; }

 private:
  void head(const ReportPart& part) {
    if (part.heading == ReportPart::Heading::place) return page_.place(part.section, part.anchor);
    if (part.heading == ReportPart::Heading::subsection) return page_.subsection(part.section);
    page_.section(part.section, part.anchor);
  }

  Page page_;
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
              svg, drawings.caption);
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
  PageWriter writer(report, about);
  Page& page = writer.page();
  if (const std::vector<std::string>& missing = page.libraries().missing; !missing.empty())
    page.raw(
        fmt::format("<p class=\"warning\" role=\"note\">Made without {}: the figures that need it are plain drawings. "
                    "Install it and make the page again.</p>\n",
                    escaped(fmt::format("{}", fmt::join(missing, ", ")))));
  writer.tell(with_warnings(report.parts));
  page.section("How to repeat this", "repeat");
  page.code(about.command);
  if (!report.notes.empty()) page.list(report.notes);
  Table facts{"", {"part", ""}, {true, true}};
  for (const auto* list : {&report.made_of, &about.versions})
    for (const auto& [name, value] : *list) facts.add({name, value});
  page.table(facts);
  if (!report.resolved_case.empty()) page.folded("The resolved case", [&] { page.code(report.resolved_case); });
  return page.html();
}

void write_markdown(const std::filesystem::path& folder, const Report& report, const PageAbout& about,
                    bool decimal_comma) {
  MarkdownWriter md(folder, decimal_comma);
  md.text("# " + plain(about.title.empty() ? report.title : about.title));
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
