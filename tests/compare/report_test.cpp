#include "compare/report/report.hpp"

#include <fmt/core.h>
#include <gmock/gmock.h>

#include <algorithm>
#include <sstream>

#include "compare/report/heat_map.hpp"
#include "compare/report/json_fields.hpp"
#include "compare/report/number_text.hpp"
#include "compare/report/plot.hpp"
#include "compare/report/plot_panel.hpp"
#include "compare/sweep/answers.hpp"
#include "compare/sweep/result_json.hpp"
#include "scenario/atomic_file.hpp"
#include "scenario/errors.hpp"
#include "scenario/estimate.hpp"
#include "scenario/file_bytes.hpp"
#include "tests/folder.hpp"

namespace soilbin::compare {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::EndsWith;
using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;

Series line(const std::string& label, std::vector<double> y) {
  Series series;
  series.label = label;
  for (std::size_t i = 0; i < y.size(); ++i) series.x.push_back(static_cast<double>(i));
  series.y = std::move(y);
  return series;
}

std::size_t count(const std::string& text, const std::string& part) {
  std::size_t found = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++found;
  return found;
}

TEST(Ticks, AreRoundAndInside) {
  EXPECT_THAT(ticks(0, 60, 6), ElementsAre(0, 10, 20, 30, 40, 50, 60));
  EXPECT_THAT(ticks(-1, 1, 4), ElementsAre(-1, -0.5, 0, 0.5, 1));
  EXPECT_EQ(ticks(2, 2, 5).size(), 1U);
}

TEST(Numbers, ValueStopsAtTheErrorsPlace) {
  EXPECT_EQ(number({4.17863, 0.3149}), "4.18 ± 0.31");
  EXPECT_EQ(number({1234.5, 67.0}), "1234 ± 67");
  EXPECT_EQ(number({0.0123, 0.0004}, 1000), "12.30 ± 0.40");
  EXPECT_EQ(number({4.17863, 0.0}), "4.179");
  EXPECT_EQ(number(-0.0), "0");
  EXPECT_EQ(number(not_a_number), "-");
}

TEST(Svg, EscapesTextAndBreaksLinesAtGaps) {
  const Sheet sheet{"a < b & c", {Plot{"pull [N]", {"slip [%]"}, {}, {line("one & two", {1, 2, not_a_number, 4, 5})}}}};
  const std::string text = svg(sheet);
  EXPECT_THAT(text, HasSubstr("a &lt; b &amp; c"));
  EXPECT_THAT(text, HasSubstr("one &amp; two"));
  EXPECT_THAT(text, Not(HasSubstr("nan")));
  const std::size_t path = text.find("stroke-linejoin");
  const std::string d = text.substr(path, text.find("/>", path) - path);
  EXPECT_EQ(count(d, "M"), 2U);
}

TEST(Svg, SurvivesEmptyAndConstantSeries) {
  const Sheet sheet{"",
                    {Plot{}, Plot{"flat", {}, {}, {line("", {3, 3, 3})}},
                     Plot{"nothing", {}, {}, {line("x", {not_a_number, not_a_number})}, true}},
                    Palette::ordered};
  EXPECT_THAT(svg(sheet), Not(HasSubstr("nan")));
  EXPECT_THAT(svg(sheet), Not(HasSubstr("inf")));
}

TEST(Svg, ALegendEntryForALabel) {
  Series points = line("yaw 5", {1, 2});
  points.mark = Mark::points;
  const Sheet sheet{"",
                    {Plot{"a", {}, {}, {line("yaw 5", {1, 2}), points}}, Plot{"b", {}, {}, {line("yaw 5", {1, 2})}}}};
  const std::vector<LegendEntry> entries = legend(sheet);
  ASSERT_EQ(entries.size(), 1U);
  EXPECT_THAT(entries[0].swatch, HasSubstr("<circle"));
  EXPECT_THAT(entries[0].swatch, HasSubstr("<line"));
}

TEST(Page, EscapesAndClosesWhatItOpens) {
  Report report{"Title <1>", "below"};
  report.add(Sentences(std::vector<BackedSentence>{{"Name", "text & more"}, {"", "plain"}}));
  report.add("First", KeyFigures{{{"4 N", "pull"}}});
  report.add("Second", Items{{"<b>"}});
  report.add(Table{"caption", {"a", "b"}, {}, {{"x<y", {"1", "a note"}}}});
  report.add(Fold{"more", [] { return std::vector<ReportPart>{{Code{"soilbin run <study>"}}}; }});
  report.add(Figure(Sheet{"", {Plot{"a", {}, {}, {line("s", {1, 2})}}}, Palette::ordered}, "caption"));
  const std::string whole = page_of(report, {}), html = whole.substr(0, whole.find("<script"));
  for (const char* tag : {"div", "table", "details", "figure", "ul", "svg", "main", "p", "h2"})
    EXPECT_EQ(count(html, std::string("<") + tag + ">") + count(html, std::string("<") + tag + " "),
              count(html, std::string("</") + tag + ">"))
        << tag;
  EXPECT_THAT(html, HasSubstr("x&lt;y"));
  EXPECT_THAT(html, HasSubstr("1 <small>a note</small>"));
  EXPECT_THAT(html, HasSubstr("&lt;b&gt;"));
  EXPECT_THAT(html, HasSubstr("href=\"#part-2\""));
}

// A card says what its page says of itself, and the way to it from the page that links.
TEST(Page, ACardIsTakenFromThePageItself) {
  const test::Folder folder;
  Report report{"A <page>", "below"};
  report.add(Sentences(std::vector<BackedSentence>{{"Name", "It pulls 4 N & more."}, {"", "Second."}}));
  report.add(Figure(Sheet{"", {Plot{"first", {}, {}, {line("s", {1, 2})}}}, Palette::ordered}, "caption"));
  write_file_atomically(folder / "sub" / "page.html", page_of(report, {}));
  const PageCard card = page_card(folder / "sub" / "page.html", folder / "index.html");
  EXPECT_EQ(card.href, "sub/page.html");
  EXPECT_EQ(card.title, "A &lt;page&gt;");
  EXPECT_EQ(card.line, "It pulls 4 N &amp; more.");
  EXPECT_THAT(card.drawing, AllOf(StartsWith("<svg class=\"plot\""), HasSubstr("first"), EndsWith("</svg>")));
  Report start{"start", ""};
  start.add(Cards{{card}});
  EXPECT_THAT(page_of(start, {}), HasSubstr("<a class=\"card\" href=\"sub/page.html\"><svg"));
  write_file_atomically(folder / "other.html", "<html></html>");
  EXPECT_THROW(page_card(folder / "other.html", folder / "index.html"), InputError);
  EXPECT_THROW(page_card(folder / "none.html", folder / "index.html"), InputError);
}

TEST(Page, ACardsLineEndsAtAWord) {
  const test::Folder folder;
  const auto line_of = [&](const std::string& text) {
    Report report{"title", "below"};
    report.add(Sentences(std::vector{text}));
    write_file_atomically(folder / "page.html", page_of(report, {}));
    return page_card(folder / "page.html", folder / "index.html").line;
  };
  std::string words;
  for (int i = 0; i < 60; ++i) words += "seven77 ";
  EXPECT_THAT(line_of(words), EndsWith("seven77 \u2026"));
  EXPECT_LT(line_of(words).size(), 180U);
  const std::string sentence = "A first sentence that says what the linked page has found out of it.";
  EXPECT_EQ(line_of(sentence + " " + words), sentence);
}

Report report_with_a_heat_map() {
  Report report{"title", "below"};
  HeatMap map;
  map.title = "where", map.x = {"1"}, map.y = {"2"}, map.cells = {{{3.0, "+3", "three", true}}};
  report.add(Drawings{{heat_map_svg(map)}, "caption", "map", true});
  return report;
}

// A viewer of pictures may be dark; a page is the map's own ground.
TEST(Markdown, AHeatMapLiesOnWhitePaper) {
  const test::Folder folder;
  write_markdown(folder.path(), report_with_a_heat_map(), {}, false);
  const std::string picture = read_bytes(folder / "map.svg", 1U << 20U);
  EXPECT_THAT(picture, HasSubstr("<rect width=\"100%\" height=\"100%\" fill=\"#ffffff\"/>"));
  EXPECT_EQ(picture.find("<rect"), picture.find("<rect width=\"100%\"")) << "below all else";
}

TEST(Page, ACardOfAHeatMapShowsIt) {
  const test::Folder folder;
  const Report report = report_with_a_heat_map();
  write_file_atomically(folder / "page.html", page_of(report, {}));
  EXPECT_THAT(page_card(folder / "page.html", folder / "index.html").drawing, HasSubstr("where"));
}

TEST(ModelNames, AreThoseOfPeople) {
  EXPECT_EQ(model_in_words("bekker_wong"), "analytic wheel");
  EXPECT_EQ(model_in_words("bekker_wong + slip_sinkage"), "analytic wheel with slip sinkage");
  EXPECT_EQ(model_in_words("bekker_wong + slip_sinkage:ding + exit_angle + yaw"),
            "analytic wheel with slip sinkage (ding), exit angle and yaw");
  EXPECT_EQ(model_in_words("bekker_wong + sidewall_bulldozing:passive_wedge + cross_talk"),
            "analytic wheel with side-wall bulldozing (passive wedge) and cross-talk");
  EXPECT_EQ(model_in_words("dem"), "grains");
  EXPECT_EQ(model_in_words("dem packing 2"), "grains, bed sample 2");
  for (const char* own : {"my bekker_wong", "grains", "analytic wheel", "cmu-smooth (measured)", ""})
    EXPECT_EQ(model_in_words(own), own);
  EXPECT_THAT(names_and_ids({"dem", "mine", "dem"}), ElementsAre(std::pair<std::string, std::string>("grains", "dem")));
}

TEST(Svg, ErrorsThatAreOnlyToldTakeNoRoomAndAreNotDrawn) {
  Series told = line("a", {1, 2});
  told.error = {50, 50};
  told.band = false;
  const std::string text = svg(Sheet{"", {Plot{"pull", {}, {}, {told}}}});
  EXPECT_THAT(text, AllOf(Not(HasSubstr("<polygon")), Not(HasSubstr(">50<"))));
  const nlohmann::ordered_json series = to_json(Sheet{"", {Plot{"pull", {}, {}, {told}}}})["plots"][0]["series"][0];
  EXPECT_EQ(series["error"][0], 50);
  EXPECT_EQ(series["band"], false);
}

// An efficiency of 5 ± 20 % is none of -15 %: the band ends where its axis does, at the bottom of the panel.
TEST(Svg, ABandEndsWhereItsAxisDoes) {
  Series efficiency = line("a", {5, 30});
  efficiency.error = {20, 20};
  const auto lowest = [&](const Axis& axis) {
    const std::string text = svg(Sheet{"", {Plot{"efficiency [%]", {}, axis, {efficiency}}}});
    std::string points = text.substr(text.find("points=\"") + 8);
    points.erase(points.find('"'));
    double y = 0.0, most = 0.0;
    char comma = 0;
    std::istringstream numbers(points);
    for (double x = 0.0; numbers >> x >> comma >> y;) most = std::max(most, y);
    const std::string axes = text.substr(text.find("quiet-line\" stroke=\"#8a919c\" fill=\"none\" d=\"M"));
    const double bottom = std::stod(axes.substr(axes.find('V') + 1));
    return most - bottom;
  };
  EXPECT_NEAR(lowest({"", 0.0}), 0.0, 0.1);
  EXPECT_LT(lowest({}), 0.0) << "without an end there is room below";
}

// Points of several sides at one slip stand beside each other: no tick but that slip's, by which they would be misread.
TEST(Svg, ALonePlaceHasOneTick) {
  Series a{.label = "a", .x = {20}, .y = {5}, .error = {1}, .mark = Mark::points}, b = a;
  b.label = "b", b.y = {7};
  const std::string text = svg(Sheet{"", {Plot{"pull", {"slip [%]"}, {}, {a, b}}}});
  EXPECT_THAT(text, HasSubstr(">20</text>"));
  for (const char* other : {">18</text>", ">19</text>", ">21</text>", ">22</text>"})
    EXPECT_THAT(text, Not(HasSubstr(other)));
}

// Areas are drawn from their base; as data they say what they add to the pile.
TEST(Svg, AnAreaIsFilledFromItsBase) {
  Series area = line("part", {3, 5});
  area.base = {1, 2};
  const Sheet sheet{"", {Plot{"parts", {}, {}, {area}}}};
  EXPECT_THAT(svg(sheet), AllOf(HasSubstr("<polygon"), Not(HasSubstr("stroke-linejoin"))));
  EXPECT_THAT(legend(sheet).at(0).swatch, HasSubstr("<rect"));
  EXPECT_EQ(to_json(sheet)["plots"][0]["series"][0]["base"], nlohmann::ordered_json({1.0, 2.0}));
  EXPECT_THAT(sheet_csv(sheet), AllOf(HasSubstr("parts,part,0,2,"), HasSubstr("parts,part,1,3,")));
}

TEST(ResultJson, NotANumberIsNullAndErrorsStand) {
  TractionResult result;
  result.torque.value = 1.0;
  result.tractive_efficiency = not_a_number;
  const auto solved = to_json(Answer{{}, result, ""});
  EXPECT_TRUE(solved["tractive_efficiency"].is_null());
  result.tractive_efficiency = 0.5;
  EXPECT_EQ(to_json(Answer{{}, result, ""})["tractive_efficiency"], 0.5);
  for (const double no_share : {-0.5, 1.2}) {  // pushed; more power out than in
    result.tractive_efficiency = no_share;
    EXPECT_TRUE(to_json(Answer{{}, result, ""})["tractive_efficiency"].is_null()) << no_share;
  }
  EXPECT_FALSE(solved.contains("error"));
  EXPECT_EQ(to_json(Answer{{}, std::nullopt, "why"})["error"], "why");
}

TEST(ResultJson, StandardErrorsSayWhatTheyLeaveOut) {
  TractionResult result;
  EXPECT_FALSE(to_json(Answer{{}, result, ""}).contains("std_error_without"));
  result.without_error_of = {"k_c", "cohesion"};
  EXPECT_EQ(to_json(Answer{{}, result, ""})["std_error_without"].dump(), R"(["k_c","cohesion"])");
}

// Two bars at one slip stand 9 px apart, and a mark goes with the point that it marks; a line keeps its place.
TEST(Plots, ErrorBarsAtOnePlaceStandBesideEachOther) {
  const Series dem{.label = "dem", .x = {20}, .y = {5}, .error = {1}, .mark = Mark::points};
  const Series measured{.label = "measured", .x = {10, 20}, .y = {3, 6}, .error = {1, 1}, .mark = Mark::points};
  const Series mark{.label = "one packing", .x = {20}, .y = {5}, .mark = Mark::points};
  const Series line{.label = "model", .x = {10, 20}, .y = {3, 6}, .error = {1, 1}};
  EXPECT_THAT(bar_shifts(Plot{"pull", {}, {}, {dem, measured, mark, line}}), ElementsAre(-4.5, 4.5, -4.5, 0));
  EXPECT_THAT(bar_shifts(Plot{"pull", {}, {}, {dem, line}}), ElementsAre(0, 0));
}

TEST(HeatMaps, ACellOfZeroHasNoSide) {
  EXPECT_EQ(heat_class({0.0, "0.0", "", true}), "none");
  EXPECT_EQ(heat_class({-0.0, "0.0", "", true}), "none");
  EXPECT_EQ(heat_class({-0.2, "-0.2", "", true}), "c0");
  EXPECT_EQ(heat_class({0.2, "+0.2", "", true}), "c1");
}

TEST(ResultJson, CsvRowsHaveAsManyCellsAsTheHeader) {
  std::vector<ModelAnswers> study(1);
  study[0].choice.label = "a, b";
  study[0].answers = {Answer{{}, TractionResult{}, ""}, Answer{{}, std::nullopt, "no, \"none\""}};
  const std::string csv =
      study_csv(study, [](const ModelChoice&, const Answer& answer) { return answer.result ? "deep, \"very\"" : ""; });
  const auto commas = [](std::string row) {
    bool quoted = false;
    std::size_t found = 0;
    for (const char c : row) {
      if (c == '"') quoted = !quoted;
      if (c == ',' && !quoted) ++found;
    }
    return found;
  };
  std::vector<std::size_t> cells;
  for (std::size_t at = 0; at < csv.size(); at = csv.find('\n', at) + 1)
    cells.push_back(commas(csv.substr(at, csv.find('\n', at) - at)));
  EXPECT_THAT(cells, ElementsAre(21U, 21U, 21U));
}

Report small_report() {
  Report report{"Pull", "of a wheel", "pull: a wheel on sand"};
  report.add(Sentences(std::vector<BackedSentence>{{"", "It pulls."}, {"Deep", "it sinks."}}));
  Table table{"caption", {"slip [%]", "pull [N]"}};
  table.add({"20", "15.2"});
  report.add("Numbers", table);
  report.add("Seen", Figure{Sheet{"sheet", {{"Pull [N]", {"slip [%]"}, {}, {line("pull", {1, 2})}}}}, "What to see."});
  report.add(NamedValues{{{"tire", "rover wheel"}}}, Told::on_terminals);
  report.add("Steps", Code{"k_c: 1\n"}, Told::to_look_at);
  report.notes = {"made of 3 runs"};
  report.data = [] { return Json{{"format", "x/1"}}; };
  report.csv = [] { return std::string("slip,pull\n0.2,15.2\n"); };
  return report;
}

TEST(Report, ATerminalGetsSentencesAndTablesWithBlankLinesAroundThem) {
  EXPECT_EQ(text_of(small_report()),
            "pull: a wheel on sand\n"
            "\n"
            "It pulls.\nDeep: it sinks.\n"
            "\n"
            "caption\n"
            "slip [%]  pull [N]\n"
            "      20      15.2\n"
            "\n"
            "  tire  rover wheel\n"
            "\n"
            "made of 3 runs\n");
}

TEST(Report, APageHasItsPartsInOrderAndTheWarningsBehindTheFirstSentences) {
  const std::string html = page_of(small_report(), {"soilbin pull", {{"soilbin", "1"}}, {"coarse grains"}});
  std::size_t at = 0;
  for (const char* part : {"<title>Pull</title>", "It pulls.", "coarse grains", "Numbers", "caption", "Seen", "<svg",
                           "What to see.", "Steps", "k_c: 1", "soilbin pull", "made of 3 runs"}) {
    const std::size_t found = html.find(part, at);
    ASSERT_NE(found, std::string::npos) << part;
    at = found;
  }
  EXPECT_THAT(html, Not(HasSubstr("rover wheel")));
}

TEST(Report, MarkdownHasFiguresAndDataBesideIt) {
  const test::Folder folder;
  write_markdown(folder.path(), small_report(), {"soilbin pull", {}, {"coarse grains"}}, true);
  const auto text = [&](const char* name) { return read_bytes(folder / name, 1U << 20U); };
  EXPECT_THAT(text("report.md"),
              AllOf(HasSubstr("# Pull\n"), HasSubstr("- **Deep.** it sinks."), HasSubstr("| 20 | 15.2 |")));
  EXPECT_THAT(text("figure-1.svg"), HasSubstr("<svg"));
  EXPECT_THAT(text("data.csv"), EndsWith("slip;pull\n0,2;15,2\n"));
  EXPECT_THAT(text("report.md"), HasSubstr("## Warnings\n\n- coarse grains\n"));
  EXPECT_EQ(Json::parse(text("data.json")), small_report().data());
}

}  // namespace
}  // namespace soilbin::compare
