#include "compare/report/report.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "compare/report/json_fields.hpp"
#include "compare/report/markdown.hpp"

namespace soilbin::compare {
namespace {

Table table_of(const NamedValues& values) {
  Table table{"", {"", ""}, {true, true}};
  for (const auto& [name, value] : values.all) table.add({name, value});
  return table;
}

// On a terminal. Sentences follow each other, anything else stands between blank lines.

class TerminalText {
 public:
  void block(const std::string& text) { add(text, true); }
  void lines(const std::vector<std::string>& lines) {
    for (const std::string& line : lines) add(line + "\n", &line == &lines.front());
  }
  void tell(const Sentences& sentences) {
    for (const BackedSentence& one : sentences.all)
      add((one.about.empty() ? "" : one.about + ": ") + one.text + "\n", false);
  }
  void tell(const NamedValues& values) {
    std::size_t longest = 0;
    for (const auto& [name, value] : values.all) longest = std::max(longest, name.size());
    std::string text;
    for (const auto& [name, value] : values.all) text += fmt::format("  {:<{}}{}\n", name, longest + 2, value);
    block(text);
  }
  void tell(Table table) {
    table.caption.clear();
    if (!table.rows.empty()) block(as_text(table));
  }
  void tell(const Code& code) { block(code.text); }
  void tell(const Figure&) {}
  void tell(const Drawing&) {}
  const std::string& all() const { return all_; }

 private:
  void add(const std::string& text, bool is_block) {
    if (!all_.empty() && (is_block || ends_with_block_)) all_ += "\n";
    all_ += text, ends_with_block_ = is_block;
  }

  std::string all_;
  bool ends_with_block_ = false;
};

void tell(Page& page, const Sentences& sentences) { page.backed_summary(sentences.all); }
void tell(Page& page, const NamedValues& values) { page.table(table_of(values)); }
void tell(Page& page, const Table& table) { page.table(table); }
void tell(Page& page, const Figure& figure) { page.figure(figure.sheet, figure.caption); }
void tell(Page& page, const Drawing& drawing) { page.drawing(drawing.svg, drawing.caption); }
void tell(Page& page, const Code& code) { page.code(code.text); }

/// Figures are numbered.
class MarkdownReport : public MarkdownFolder {
 public:
  using MarkdownFolder::MarkdownFolder;

  void tell(const Sentences& sentences) {
    for (const BackedSentence& one : sentences.all)
      text(fmt::format("- {}{}", one.about.empty() ? "" : "**" + plain(one.about) + ".** ", plain(one.text)));
  }
  void tell(const NamedValues& values) { table(table_of(values)); }
  void tell(const Table& one) { table(one); }
  void tell(const Figure& one) { figure(next_name(), one.sheet); }
  void tell(const Drawing& one) { picture(next_name(), one.svg, one.caption); }
  void tell(const Code& code) { text("```\n" + code.text + "```"); }

 private:
  std::string next_name() { return fmt::format("figure-{}", ++figures_); }
  int figures_ = 0;
};

}  // namespace

std::string text_of(const Report& report) {
  TerminalText text;
  if (!report.heading.empty()) text.block(report.heading + "\n");
  for (const ReportPart& part : report.parts)
    if (part.told != Told::on_pages) std::visit([&](const auto& content) { text.tell(content); }, part.content);
  text.lines(report.notes);
  return text.all();
}

std::string page_of(const Report& report, const PageAbout& about) {
  Page page(about.title.empty() ? report.title : about.title, report.subtitle);
  bool warned = false;
  for (const ReportPart& part : report.parts) {
    if (part.told == Told::on_terminals) continue;
    if (!part.section.empty()) page.section(part.section);
    std::visit([&](const auto& content) { tell(page, content); }, part.content);
    if (!warned && std::holds_alternative<Sentences>(part.content)) page.doubts(about.doubts), warned = true;
  }
  if (!warned) page.doubts(about.doubts);
  page.section("Made by");
  page.code(about.command);
  std::vector<std::string> made = report.notes;
  for (const auto& [name, version] : about.versions) made.push_back(name + " " + version);
  page.list(made);
  return page.html();
}

void write_markdown(const std::filesystem::path& folder, const Report& report, const PageAbout& about,
                    bool decimal_comma) {
  MarkdownReport md(folder, decimal_comma);
  md.text("# " + plain(about.title.empty() ? report.title : about.title));
  if (!report.subtitle.empty()) md.text(plain(report.subtitle));
  for (const ReportPart& part : report.parts) {
    if (part.told == Told::on_terminals) continue;
    if (!part.section.empty()) md.text("## " + plain(part.section));
    std::visit([&](const auto& content) { md.tell(content); }, part.content);
  }
  if (!about.doubts.empty()) md.text("## Warnings");
  for (const std::string& doubt : about.doubts) md.text("- " + plain(doubt));
  md.text("## Made by");
  md.text("    " + about.command);
  for (const std::string& note : report.notes) md.text("- " + plain(note));
  for (const auto& [name, version] : about.versions) md.text(fmt::format("- {} {}", plain(name), plain(version)));
  md.write();
  if (report.csv) md.csv("data", report.csv());
  if (!report.data) return;
  nlohmann::ordered_json data = report.data();
  add_warnings(data, about.doubts);
  md.file("data.json", json_text(data));
}

}  // namespace soilbin::compare
