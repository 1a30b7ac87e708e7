#include "compare/failure_map/map_report.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "compare/doubts/doubts.hpp"
#include "compare/report/heat_map.hpp"
#include "compare/report/json_fields.hpp"
#include "compare/report/number_text.hpp"
#include "compare/sweep/varying.hpp"

namespace soilbin::compare {
namespace {

/// Where the models agree: without lugs at any slip, else also up to a slip; with any lugs; and the largest box of all.
std::vector<AgreementClause> agreements(const FailureQuestion& question, FailureMap& rows, int rounds) {
  std::vector<AgreementClause> clauses;
  const auto add = [&](const std::vector<Role>& roles) {
    if (const auto clause = agreement(question, rows, roles, 9, rounds)) clauses.push_back(*clause);
    return !clauses.empty();
  };
  if (!add({Role::limited, Role::held, Role::limited, Role::whole}))
    add({Role::limited, Role::held, Role::limited, Role::limited});
  add({Role::limited, Role::limited, Role::limited, Role::whole});
  add({Role::bounded, Role::bounded, Role::bounded, Role::bounded});
  return clauses;
}

/// Of the analytic model and the grains at the conditions that were run, with the highest lugs.
std::vector<std::string> doubts_at_rows(const MapStory& story) {
  Case question;
  std::vector<Eigen::VectorXd> rows;
  for (const FailureRow& row : story.rows.rows) {
    rows.push_back(row.values);
    question.study.conditions.push_back(condition_at(story.map, row.values));
  }
  if (rows.empty()) return {};
  const auto height = [](const Eigen::VectorXd& values) { return values[map_lug_height]; };
  question.scenario = scenario_at(story.map, *std::ranges::max_element(rows, {}, height));
  question.study.models = {{ModelKind::bekker_wong, question.scenario.effects, ""}};
  question.scenario.effects.clear();
  const std::vector<ModelAnswers> study = run_study(question);
  question.study.models.push_back({ModelKind::dem, {}, ""});
  return doubts(question, study);
}

}  // namespace

MapStory learn_map(const InclineMap& map, const VirtualTest& grains, ExperimentStore& store, const MapLearning& how) {
  MapStory story;
  story.map = map;
  story.question = failure_question(story.map, grains, store, how.packing, how.tolerance);
  story.rows = map_failures(story.question, how.runs);
  story.clauses = agreements(story.question, story.rows, how.rounds);
  story.coordinates = compare_coordinates(story.map, story.rows);
  story.checks = check_fresh(story.question, story.rows, how.fresh, how.runs.seed);
  return story;
}

std::vector<std::string> doubts_of(const MapStory& story, const VirtualTest& grains, const ExperimentStore& store) {
  std::vector<std::string> all = doubts_at_rows(story);
  if (const std::size_t older = store.of_other_engines(grains); older > 0)
    all.push_back(
        fmt::format("{} of the experiments were made by an earlier engine, whose shear springs did not turn with the "
                    "spin of a pair: this one's answers differ",
                    older));
  return all;
}

namespace {

using Eigen::Index;
using Eigen::VectorXd;

/// "load 40 N, lug height 5 mm, angle 3 deg, slip 20 %".
std::string factors_in_words(const std::vector<Factor>& factors, const VectorXd& values) {
  std::string text;
  for (std::size_t j = 0; j < factors.size(); ++j) {
    const Factor& factor = factors[j];
    text += fmt::format("{}{} {:.3g}{}", text.empty() ? "" : ", ", factor.name, values[j] * per_unit(factor.unit),
                        factor.unit == "-" ? "" : " " + factor.unit);
  }
  return text;
}

std::string in_percent(const Estimate& share) { return number({100 * share.value, 100 * share.std_error}); }

const FailureRow* worst_of(const FailureMap& map) {
  const FailureRow* worst = nullptr;
  for (const FailureRow& row : map.rows)
    if (row.difference && (!worst || std::abs(row.difference->value) > std::abs(worst->difference->value)))
      worst = &row;
  return worst;
}

std::string rows_sentence(const MapStory& story) {
  const double tolerance = story.question.tolerance;
  std::size_t answered = 0, high = 0, low = 0;
  for (const FailureRow& row : story.rows.rows) {
    answered += row.difference.has_value();
    if (row.beyond(tolerance)) ++(row.difference->value > 0 ? high : low);
  }
  const std::string side = low == 0    ? "too high at all of them"
                           : high == 0 ? "too low at all of them"
                                       : fmt::format("too high at {}, too low at {}", high, low);
  std::string text = fmt::format("{}: of {} conditions run, {} are beyond {:.3g} % of the load and two standard errors",
                                 story.question.name, answered, high + low, 100 * tolerance);
  if (high + low > 0) text += ": the analytic pull is " + side;
  if (answered < story.rows.rows.size())
    text += fmt::format("; at {} more one of the models has no answer", story.rows.rows.size() - answered);
  if (const FailureRow* worst = worst_of(story.rows))
    text += fmt::format("; farthest off is {} % of the load, at {}", in_percent(*worst->difference),
                        factors_in_words(story.question.factors, worst->values));
  return text + ".";
}

std::string knowledge_sentence(const MapStory& story) {
  const LeaveOneOut& held_out = story.rows.held_out;
  const auto inside = static_cast<double>((held_out.standardised.array().abs() < 1.96).count());
  double mean = 0, squares = 0, noise = 0, n = 0;
  for (const FailureRow& row : story.rows.rows)
    if (row.difference) mean += row.difference->value, noise += std::pow(row.difference->std_error, 2), n += 1;
  mean /= n;
  for (const FailureRow& row : story.rows.rows)
    if (row.difference) squares += std::pow(row.difference->value - mean, 2) / n;
  return fmt::format(
      "Cross-validated error of the map: {:.1f} % of the load (each row predicted from all others, root mean square); "
      "{:.0f} % of the rows lie within 1.96 of their stated errors. The rows scatter by {:.1f} % about their mean, a "
      "run by {:.1f} % about its own.",
      100 * held_out.rms(), 100 * inside / static_cast<double>(held_out.standardised.size()), 100 * std::sqrt(squares),
      100 * std::sqrt(noise / n));
}

std::string coordinates_sentence(const MapStory& story) {
  if (story.coordinates.empty()) return "";
  std::string text = "Left out one at a time, a map in";
  for (const Coordinates& c : story.coordinates)
    text +=
        fmt::format("{} ({}) is off by {:.1f} %", &c == story.coordinates.data() ? "" : ",", c.name, 100 * c.held_out);
  const double plain = story.coordinates.front().held_out;
  const auto best =
      std::ranges::min_element(story.coordinates, [](const auto& a, const auto& b) { return a.held_out < b.held_out; });
  if (best == story.coordinates.begin()) return text + ": no group of these does better than the numbers as set.";
  return text + fmt::format(": ({}) does better than the numbers as set, by {:.0f} % of their error.", best->name,
                            100 * (1 - best->held_out / plain));
}

/// The same for people: what was tried, and whether it is of use.
std::string coordinates_in_words(const MapStory& story) {
  if (story.coordinates.empty()) return "";
  const double plain = story.coordinates.front().held_out;
  const auto best =
      std::ranges::min_element(story.coordinates, [](const auto& a, const auto& b) { return a.held_out < b.held_out; });
  const std::string text = fmt::format(
      "Would ratios without units predict better than load, lug height, angle and slip themselves? We learnt the map "
      "again from such ratios (the load number, which is the load over the weight of soil of the wheel's width and "
      "radius squared; the lugs' height over the "
      "sinkage at rest) and let it predict each condition from all others. With the quantities themselves it errs by "
      "{:.1f} % of the load",
      100 * plain);
  return text + (best == story.coordinates.begin()
                     ? ", with each set of ratios by more: the quantities themselves serve best."
                     : fmt::format(", with {} by {:.1f} %: these serve better.", best->name, 100 * best->held_out));
}

std::string checks_sentence(const MapStory& story) {
  std::size_t found = 0, within = 0, right = 0;
  for (const FreshCheck& check : story.checks)
    if (check.found) {
      ++found;
      within += std::abs(check.sigma()) < 2;
      right += (std::abs(check.found->value) > story.question.tolerance) ==
               (std::abs(check.predicted.value) > story.question.tolerance);
    }
  if (found == 0) return "";
  return fmt::format(
      "Fresh conditions: {} that the map had not seen; predicted and found differ by {:.1f} % of the load (root mean "
      "square), {} within two standard errors, {} on the side of the tolerance that was predicted.",
      found, 100 * rms_of(story.checks), within, right);
}

constexpr int cells = 7;  // of a heat map, along and up

std::string in_units(const Factor& factor, double value) {
  return fmt::format("{:.3g}{}", value * per_unit(factor.unit), factor.unit == "-" ? "" : " " + factor.unit);
}

HeatCell cell_at(const MapStory& story, const VectorXd& values) {
  const std::vector<Factor>& factors = story.question.factors;
  const Estimate there = story.rows.at(story.question, values);
  const double tolerance = story.question.tolerance, size = std::abs(there.value);
  const double percent = std::round(100 * there.value);
  HeatCell cell{100 * there.value, percent == 0 ? "0" : fmt::format("{:+.0f}", percent), "", true};
  cell.counts = size - 1.645 * there.std_error > tolerance;
  for (std::size_t j = 0; j < factors.size(); ++j)
    cell.meaning += fmt::format("{}{} {}", j == 0 ? "" : ", ", factors[j].name, in_units(factors[j], values[j]));
  cell.meaning += fmt::format(": {} % of the load, {}", number({100 * there.value, 100 * there.std_error}),
                              cell.counts                                  ? "the models part"
                              : size + 1.645 * there.std_error < tolerance ? "the models agree"
                                                                           : "the map cannot tell");
  return cell;
}

std::vector<double> two_levels(const Factor& factor) {
  return factor.upper > factor.lower ? std::vector{factor.lower, factor.upper} : std::vector{factor.lower};
}

Json values_json(const std::vector<Factor>& factors, const VectorXd& values) {
  Json json = Json::object();
  for (std::size_t j = 0; j < factors.size(); ++j) json[factors[j].name] = values[j];
  return json;
}

Json where_known(const std::optional<Estimate>& estimate) {
  return estimate ? estimate_json(*estimate) : Json(nullptr);
}

/// The map at every setting of lug height and slip; a factor that does not vary has no slider. They start where a
/// setting is nearest to the tire's own lugs and to 20 % slip.
SlidingMap sliding_map_of(const MapStory& story) {
  constexpr int lugs = 5, slips = 10;
  constexpr double usual_slip = 0.2;
  const std::vector<Factor>& factors = story.question.factors;
  SlidingMap map;
  const auto settings = [&](const Factor& factor, int count, double start) {
    const int places = factor.upper > factor.lower ? count : 1;
    std::vector<double> values;
    for (int i = 0; i < places; ++i) values.push_back(places == 1 ? factor.lower : level_value(factor, i, places));
    if (places > 1) {
      map.sliders.push_back({factor.name, {}});
      for (const double value : values) map.sliders.back().settings.push_back(in_units(factor, value));
      const auto nearest = std::ranges::min_element(values, {}, [&](double value) { return std::abs(value - start); });
      map.first.push_back(static_cast<std::size_t>(nearest - values.begin()));
    }
    return values;
  };
  const double own_lugs = story.map.scenario.tire.lugs.height;
  const std::vector<double> heights = settings(factors[map_lug_height], lugs, own_lugs),
                            at_slips = settings(factors[map_slip], slips, usual_slip);
  for (const double height : heights)
    for (const double slip : at_slips) map.maps.push_back(heat_map_of(story, height, slip));
  return map;
}

}  // namespace

double share_beyond(const MapStory& story) {
  constexpr int nodes = 9;
  const std::vector<Factor>& factors = story.question.factors;
  std::size_t all = 1, beyond = 0;
  for (std::size_t j = 0; j < factors.size(); ++j) all *= nodes;
  for (std::size_t i = 0; i < all; ++i) {
    VectorXd values(static_cast<Index>(factors.size()));
    std::size_t rest = i;
    for (std::size_t j = 0; j < factors.size(); ++j, rest /= nodes)
      values[j] = level_value(factors[j], static_cast<int>(rest % nodes), nodes);
    beyond += std::abs(story.rows.at(story.question, values).value) > story.question.tolerance;
  }
  return static_cast<double>(beyond) / static_cast<double>(all);
}

std::vector<std::string> map_summary(const MapStory& story) {
  std::vector<std::string> text = {rows_sentence(story)};
  text.push_back(fmt::format("By the map, {:.0f} % of the box asked for is beyond {:.3g} % of the load.",
                             100 * share_beyond(story), 100 * story.question.tolerance));
  for (const AgreementClause& clause : story.clauses) text.push_back(clause.text + ".");
  if (story.clauses.empty())
    text.push_back(
        "No box from the lower corner in which the models are sure to agree: with 95 % confidence they may part even "
        "there.");
  text.push_back(knowledge_sentence(story));
  for (const std::string& more : {coordinates_sentence(story), checks_sentence(story)})
    if (!more.empty()) text.push_back(more);
  return text;
}

std::vector<std::pair<std::string, std::string>> opening(const MapStory& story) {
  const double tolerance = 100 * story.question.tolerance;
  std::vector<std::pair<std::string, std::string>> parts;
  // A clause's text is "NAME: within 10 % of the load up to ...": what follows the load is the box.
  const std::string before = fmt::format("{}: within {:.3g} % of the load ", story.question.name, tolerance);
  std::string boxes;
  for (const AgreementClause& clause : story.clauses)
    boxes += (boxes.empty() ? "" : " Also ") +
             (clause.text.starts_with(before) ? clause.text.substr(before.size()) : clause.text) + ".";
  parts.emplace_back(
      "Trust it",
      story.clauses.empty()
          ? fmt::format("Nowhere for sure: no box of conditions is within {:.3g} % of the load with 95 % confidence.",
                        tolerance)
          : fmt::format("The estimate is within {:.3g} % of the load of what grains give, with 95 % confidence, {}",
                        tolerance, boxes));
  const double beyond = 100 * share_beyond(story);
  parts.emplace_back("Do not trust it",
                     fmt::format("By the map it is off by more in {:.0f} % of the conditions asked for. {}", beyond,
                                 capital(rows_sentence(story))));
  std::string sure = fmt::format(
      "The map predicts a condition that it has not seen to {:.1f} % of the load (root mean square, each row left out "
      "in turn).",
      100 * story.rows.held_out.rms());
  if (const std::string fresh = checks_sentence(story); !fresh.empty()) sure += " " + fresh;
  parts.emplace_back("How sure", sure);
  return parts;
}

std::string in_short(const MapStory& story) {
  const Tire& tire = story.map.scenario.tire;
  const double tolerance = 100 * story.question.tolerance;
  return fmt::format(
      "By the map the quick estimate of the pull lies within {:.3g} % of the load of what grains give in {:.0f} % of "
      "the "
      "conditions. Which ones: set the sliders to your lugs and slip{}.",
      tolerance, 100 * (1 - share_beyond(story)),
      tire.lugs.height > 0.0
          ? fmt::format(" (they start next to the lugs of {}, {:.3g} mm)", tire.name, 1000 * tire.lugs.height)
          : "");
}

std::vector<std::string> details(const MapStory& story) {
  std::vector<std::string> text = {knowledge_sentence(story)};
  if (std::string groups = coordinates_in_words(story); !groups.empty()) text.push_back(std::move(groups));
  return text;
}

Table rows_table(const MapStory& story) {
  Table table{"Every condition run, in order: analytic less grains, share of the load", {}};
  for (const Factor& factor : story.question.factors) table.header.push_back(heading(factor.name, factor.unit));
  table.header.insert(table.header.end(), {"difference [%]", "left out, predicted [%]", "beyond"});
  Index k = 0;
  for (const FailureRow& row : story.rows.rows) {
    std::vector<TableCell> cells;
    for (std::size_t j = 0; j < story.question.factors.size(); ++j)
      cells.push_back(number(row.values[j] * per_unit(story.question.factors[j].unit)));
    if (row.difference) {
      const double predicted = row.difference->value - story.rows.held_out.residual[k];
      cells.insert(cells.end(), {in_percent(*row.difference), fmt::format("{:.1f}", 100 * predicted),
                                 row.beyond(story.question.tolerance) ? "yes" : "no"});
      ++k;
    } else {
      cells.insert(cells.end(), {"-", "-", "no answer"});
    }
    table.add(std::move(cells));
  }
  return table;
}

Table coordinates_table(const MapStory& story) {
  Table table{"What the map may see, and its error with each row left out", {"coordinates", "error [% of the load]"}};
  for (const Coordinates& c : story.coordinates) table.add({c.name, fmt::format("{:.2f}", 100 * c.held_out)});
  return table;
}

Table checks_table(const MapStory& story) {
  Table table{"Fresh conditions: predicted, then run", {}};
  for (const Factor& factor : story.question.factors) table.header.push_back(heading(factor.name, factor.unit));
  table.header.insert(table.header.end(), {"predicted [%]", "found [%]", "apart [standard errors]"});
  for (const FreshCheck& check : story.checks) {
    std::vector<TableCell> cells;
    for (std::size_t j = 0; j < story.question.factors.size(); ++j)
      cells.push_back(number(check.values[j] * per_unit(story.question.factors[j].unit)));
    cells.push_back(in_percent(check.predicted));
    cells.push_back(check.found ? in_percent(*check.found) : "no answer");
    cells.push_back(check.found ? fmt::format("{:.1f}", check.sigma()) : "-");
    table.add(std::move(cells));
  }
  return table;
}

HeatMap heat_map_of(const MapStory& story, double lug_height, double slip) {
  const std::vector<Factor>& factors = story.question.factors;
  const Factor &load = factors[map_load], &angle = factors[map_angle];
  HeatMap map;
  map.title = fmt::format("{} {}, {} {}", factors[map_lug_height].name, in_units(factors[map_lug_height], lug_height),
                          factors[map_slip].name, in_units(factors[map_slip], slip));
  map.subtitle = "analytic less grains [% of the load]";
  map.x_title = heading(load.name, load.unit), map.y_title = heading(angle.name, angle.unit);
  map.limit = 300 * story.question.tolerance;
  for (int c = 0; c < cells; ++c)
    map.x.push_back(fmt::format("{:.4g}", level_value(load, c, cells) * per_unit(load.unit)));
  for (int r = cells - 1; r >= 0; --r) {
    map.y.push_back(in_units(angle, level_value(angle, r, cells)));
    std::vector<HeatCell> row;
    for (int c = 0; c < cells; ++c) {
      VectorXd values(4);
      values << level_value(load, c, cells), lug_height, level_value(angle, r, cells), slip;
      row.push_back(cell_at(story, values));
    }
    map.cells.push_back(std::move(row));
  }
  return map;
}

std::string failure_map_page(const MapStory& story, const PageAbout& about, const std::string& resolved_case) {
  Page page("Where may I trust the quick estimate?",
            fmt::format("{}: the analytic wheel against grains, {} on {}", about.title, story.map.scenario.tire.name,
                        in_words(story.map.scenario.soil)));
  page.sentences({in_short(story)});
  page.place("The map", "map");
  page.raw(sliding_map_html(
      sliding_map_of(story),
      "Drawbar pull, analytic less grains, in per cent of the load, as the map has it; loads across, angles up. Blue: "
      "the analytic pull is too low; orange: too high. Bold: the map is sure that the models differ by more than the "
      "tolerance. Faint: they agree, or the map cannot tell; each cell says which."));
  page.place("The answer in full", "answer");
  page.summary(opening(story));
  page.figures_at_a_glance(
      {{std::to_string(story.rows.rows.size()), "conditions run"},
       {fmt::format("{:.1f} %", 100 * story.rows.held_out.rms()), "cross-validated error, of the load"},
       {fmt::format("{:.0f} %", 100 * share_beyond(story)), "of the box beyond the tolerance"}});
  page.list(details(story));
  page.doubts(about.doubts);
  const std::vector<Factor>& factors = story.question.factors;
  page.folded("The map at its corners, side by side", [&] {
    std::vector<std::string> maps;
    for (const double slip :
         {factors[map_slip].lower, (factors[map_slip].lower + factors[map_slip].upper) / 2, factors[map_slip].upper})
      for (const double height : two_levels(factors[map_lug_height]))
        maps.push_back(heat_map_svg(heat_map_of(story, height, slip)));
    page.heat_maps(maps, "Loads across, angles up.");
  });
  page.section("What it rests on", "rows");
  page.table(rows_table(story));
  page.table(coordinates_table(story));
  if (!story.checks.empty()) page.table(checks_table(story));
  page.section("How to repeat this", "repeat");
  page.code(about.command);
  page.facts({"part", ""}, {&about.versions});
  page.folded("The resolved case", [&] { page.code(resolved_case); });
  return page.html();
}

nlohmann::ordered_json failure_map_json(const MapStory& story) {
  const std::vector<Factor>& factors = story.question.factors;
  Json document = {
      {"format", "soilbin-failure-map/1"},     {"incline", name_of(story.map.incline)},
      {"tolerance", story.question.tolerance}, {"summary", map_summary(story)},
      {"share_beyond", share_beyond(story)},   {"cross_validated_error", finite(story.rows.held_out.rms())}};
  Json ranges = Json::array(), rows = Json::array(), groups = Json::array(), checks = Json::array();
  for (const Factor& factor : factors)
    ranges.push_back({{"name", factor.name}, {"lower", factor.lower}, {"upper", factor.upper}});
  for (const FailureRow& row : story.rows.rows) {
    Json json = values_json(factors, row.values);
    json["difference"] = where_known(row.difference), json["beyond"] = row.beyond(story.question.tolerance);
    rows.push_back(std::move(json));
  }
  for (const Coordinates& c : story.coordinates) groups.push_back({{"name", c.name}, {"held_out", finite(c.held_out)}});
  for (const FreshCheck& check : story.checks) {
    Json json = values_json(factors, check.values);
    json["predicted"] = where_known(check.predicted), json["found"] = where_known(check.found);
    checks.push_back(std::move(json));
  }
  document["factors"] = ranges, document["rows"] = rows;
  document["coordinates"] = groups, document["checks"] = checks;
  return document;
}

}  // namespace soilbin::compare
