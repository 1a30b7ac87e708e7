// A failure map as it is told; soilbin-failure-map/1.
#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "compare/failure_map/incline_map.hpp"
#include "compare/recorded/record.hpp"
#include "compare/report/heat_map.hpp"
#include "compare/report/json_fields.hpp"
#include "compare/report/number_text.hpp"
#include "compare/sweep/answers.hpp"
#include "compare/sweep/varying.hpp"
#include "compare/telling/reports.hpp"
#include "scenario/mapping_writer.hpp"

namespace soilbin::compare {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

std::string bare(const Factor& factor, double value) { return fmt::format("{:.3g}", value * per_unit(factor.unit)); }

std::string with_unit(const Factor& factor, double value) { return bare(factor, value) + unit_behind(factor.unit); }

/// "load 40 N, lug height 5 mm, angle 3 deg, slip 20 %".
std::string factors_in_words(const std::vector<Factor>& factors, const VectorXd& values) {
  std::string text;
  for (std::size_t j = 0; j < factors.size(); ++j)
    text += fmt::format("{}{} {}", text.empty() ? "" : ", ", factors[j].name, with_unit(factors[j], values[j]));
  return text;
}

/// "load up to 4 kN", "load from 3 kN", "load from 3 to 4 kN"; empty where the box has the whole range.
std::string range_of(const Factor& factor, double lower, double upper) {
  const bool from = lower > factor.lower, to = upper < factor.upper;
  if (from && to) return fmt::format("{} from {} to {}", factor.name, bare(factor, lower), with_unit(factor, upper));
  if (from) return fmt::format("{} from {}", factor.name, with_unit(factor, lower));
  return to ? fmt::format("{} up to {}", factor.name, with_unit(factor, upper)) : "";
}

/// "up to load 4 kN, at lug height 0 mm, with slip from 20 %; 12 conditions run there, largest error 6.1 %".
std::string box_in_words(const FailureQuestion& question, const AgreementClause& clause) {
  const std::vector<Role>& roles = clause.roles;
  std::string limits, held, ranges;
  for (std::size_t j = 0; j < roles.size(); ++j) {
    const Factor& factor = question.factors[j];
    if (roles[j] == Role::limited)
      limits +=
          fmt::format("{}{} {}", limits.empty() ? "up to " : " and ", factor.name, with_unit(factor, clause.upper[j]));
    if (roles[j] == Role::held) held += fmt::format(", at {} {}", factor.name, with_unit(factor, factor.lower));
    if (roles[j] == Role::bounded)
      if (const std::string range = range_of(factor, clause.lower[j], clause.upper[j]); !range.empty())
        ranges += (ranges.empty() ? (limits.empty() ? "with " : " with ") : ", ") + range;
  }
  return fmt::format("{}{}{}; {} conditions run there, largest error {:.1f} %", limits, held, ranges, clause.rows,
                     100 * clause.largest);
}

/// "the analytic pull", "the grains' pull".
std::string pull_of(ModelKind kind) {
  return kind == ModelKind::bekker_wong ? "the analytic pull"
         : kind == ModelKind::dem       ? "the grains' pull"
                                        : "the pull by resistive force theory";
}

/// "of the grains'", behind "within 10 % of the load".
std::string from_that_of(ModelKind kind) {
  return kind == ModelKind::bekker_wong ? "of the analytic one"
         : kind == ModelKind::dem       ? "of the grains'"
                                        : "of that by resistive force theory";
}

/// "analytic - grains".
std::string less_in_words(const InclineMap& map) {
  const auto one = [](ModelKind kind) {
    return kind == ModelKind::bekker_wong ? "analytic" : kind == ModelKind::dem ? "grains" : "resistive force theory";
  };
  return fmt::format("{} - {}", one(map.of), one(map.against));
}

std::string judged_in_words(Judged judged) {
  return judged == Judged::agree ? "the models agree" : judged == Judged::differ ? "the models differ" : "not decided";
}

std::string in_percent(const Estimate& share) { return number({100 * share.value, 100 * share.std_error}); }

const FailureRow* worst_of(const FailureMap& map) {
  const FailureRow* worst = nullptr;
  for (const FailureRow& row : map.rows)
    if (row.difference && (!worst || std::abs(row.difference->value) > std::abs(worst->difference->value)))
      worst = &row;
  return worst;
}

std::string rows_sentence(const FailureMapResult& result) {
  const double tolerance = result.question.tolerance;
  std::size_t answered = 0, high = 0, low = 0;
  for (const FailureRow& row : result.map.rows) {
    answered += row.difference.has_value();
    if (row.beyond(tolerance)) ++(row.difference->value > 0 ? high : low);
  }
  const std::string side = low == 0    ? "too high at all of them"
                           : high == 0 ? "too low at all of them"
                                       : fmt::format("too high at {}, too low at {}", high, low);
  std::string text =
      fmt::format("{}: {} of {} conditions run differ by more than {:.3g} % of the load and two standard errors",
                  result.question.name, high + low, answered, 100 * tolerance);
  if (high + low > 0) text += fmt::format(": {} is {}", pull_of(result.asked.of), side);
  if (answered < result.map.rows.size()) text += fmt::format("; {} not answered", result.map.rows.size() - answered);
  if (const FailureRow* worst = worst_of(result.map))
    text += fmt::format("; largest error {} % of the load, at {}", in_percent(*worst->difference),
                        factors_in_words(result.question.factors, worst->values));
  return text + ".";
}

/// How the rows lie about what the map says of each, and about their mean.
std::string scatter_sentence(const FailureMapResult& result) {
  const LeaveOneOut& held_out = result.map.held_out;
  const auto inside = static_cast<double>((held_out.standardised.array().abs() < 1.96).count());
  double mean = 0, squares = 0, noise = 0, n = 0;
  for (const FailureRow& row : result.map.rows)
    if (row.difference) mean += row.difference->value, noise += std::pow(row.difference->std_error, 2), n += 1;
  mean /= n;
  for (const FailureRow& row : result.map.rows)
    if (row.difference) squares += std::pow(row.difference->value - mean, 2) / n;
  return fmt::format(
      "Predicted from the others, {:.0f} % of the conditions lie within the map's 95 % interval. Their differences "
      "scatter "
      "by {:.1f} % of the load; a run's own error is {:.1f} %.",
      100 * inside / static_cast<double>(held_out.standardised.size()), 100 * std::sqrt(squares),
      100 * std::sqrt(noise / n));
}

std::string error_sentence(const FailureMapResult& result) {
  return fmt::format("Cross-validated error of the map: {:.1f} % of the load (RMS, each row left out in turn).",
                     100 * result.map.held_out.rms());
}

std::string checks_sentence(const FailureMapResult& result) {
  std::size_t found = 0, within = 0, right = 0;
  for (const FreshCheck& check : result.checks)
    if (check.found) {
      ++found;
      within += std::abs(check.sigma()) < 2;
      right += (std::abs(check.found->value) > result.question.tolerance) ==
               (std::abs(check.predicted.value) > result.question.tolerance);
    }
  if (found == 0) return "";
  return fmt::format(
      "Check on {} fresh conditions: error {:.1f} % of the load (RMS), {} within two standard errors, {} on the "
      "predicted side of the tolerance.",
      found, 100 * rms_of(result.checks), within, right);
}

/// By how much the grains' own pull is off for their size, and how well that is known; "" without grains.
std::string grains_sentence(const FailureMapResult& result) {
  if (result.asked.of != ModelKind::dem && result.asked.against != ModelKind::dem) return "";
  if (!result.map.resolution_error)
    return "Error of resolution of the grains: not known; the verdicts are about these grains, and not about sand.";
  double squares = 0.0, variance = 0.0, known = 0.0, answered = 0.0;
  for (const FailureRow& row : result.map.rows) {
    answered += row.difference.has_value();
    if (!row.resolution_error) continue;
    const Estimate error = result.map.resolution_error->predict(to_unit(result.question.factors, row.values));
    squares += std::pow(error.value, 2), variance += std::pow(error.std_error, 2), known += 1;
  }
  return fmt::format(
      "Error of resolution of the grains: {:.1f} ± {:.1f} % of the load (RMS over {:.0f} of {:.0f} conditions), {}. "
      "Where it could turn the verdict, the map says 'not decided'.",
      100 * std::sqrt(squares / known), 100 * std::sqrt(variance / known), known, answered,
      result.by_twins ? fmt::format("by twins with grains {} times as large", coarser_by)
                      : "carried over from the study of grain sizes; --coarser-twin finds the map's own");
}

constexpr int map_cells = 7;  // of a heat map, along and up

HeatCell cell_at(const FailureMapResult& result, const VectorXd& values) {
  const std::vector<Factor>& factors = result.question.factors;
  const Estimate there = result.map.at(result.question, values);
  const Judged judged = result.map.judged(result.question, values);
  const double percent = std::round(100 * there.value);
  HeatCell cell{100 * there.value, percent == 0 ? "0" : fmt::format("{:+.0f}", percent), "", judged == Judged::differ};
  if (judged == Judged::undecided) cell.text += "?";
  cell.meaning = fmt::format("{}: {} % of the load", factors_in_words(factors, values), in_percent(there));
  if (result.map.resolution_error.has_value())
    cell.meaning +=
        fmt::format(", from infinitely fine grains {} %", in_percent(result.map.at_fine(result.question, values)));
  cell.meaning += ", " + judged_in_words(judged);
  return cell;
}

/// Difference [% of the load] over load (across) and angle (up), by the map, at these lug height [m] and slip; cells
/// count where the models are judged to differ.
HeatMap heat_map_of(const FailureMapResult& result, double lug_height, double slip) {
  const std::vector<Factor>& factors = result.question.factors;
  const Factor &load = factors[map_load], &angle = factors[map_angle];
  HeatMap map;
  map.title = fmt::format("{} {}, {} {}", factors[map_lug_height].name, with_unit(factors[map_lug_height], lug_height),
                          factors[map_slip].name, with_unit(factors[map_slip], slip));
  map.subtitle = less_in_words(result.asked) + " [% of the load]";
  map.x_title = heading(load.name, load.unit), map.y_title = heading(angle.name, angle.unit);
  map.limit = 300 * result.question.tolerance;
  for (int c = 0; c < map_cells; ++c)
    map.x.push_back(fmt::format("{:.4g}", level_value(load, c, map_cells) * per_unit(load.unit)));
  for (int r = map_cells - 1; r >= 0; --r) {
    map.y.push_back(with_unit(angle, level_value(angle, r, map_cells)));
    std::vector<HeatCell> row;
    for (int c = 0; c < map_cells; ++c) {
      VectorXd values(4);
      values << level_value(load, c, map_cells), lug_height, level_value(angle, r, map_cells), slip;
      row.push_back(cell_at(result, values));
    }
    map.cells.push_back(std::move(row));
  }
  return map;
}

std::vector<double> two_levels(const Factor& factor) {
  return factor.upper > factor.lower ? std::vector{factor.lower, factor.upper} : std::vector{factor.lower};
}

Json values_json(const std::vector<Factor>& factors, const VectorXd& values) {
  Json json = Json::object();
  for (std::size_t j = 0; j < factors.size(); ++j) json[factors[j].name] = values[j];
  return json;
}

/// The map at every setting of lug height and slip; a factor that does not vary has no slider. The tire's own lug
/// height and 20 % slip are among the settings where they lie in the range, and the sliders start there, else next to
/// them.
SlidingMap sliding_map_of(const FailureMapResult& result) {
  constexpr int lugs = 5, slips = 10;
  constexpr double usual_slip = 0.2;
  const std::vector<Factor>& factors = result.question.factors;
  SlidingMap map;
  const auto settings = [&](const Factor& factor, int count, double start) {
    const int places = factor.upper > factor.lower ? count : 1;
    std::vector<double> values;
    for (int i = 0; i < places; ++i) values.push_back(places == 1 ? factor.lower : level_value(factor, i, places));
    if (places > 1) {
      if (start > factor.lower && start < factor.upper && std::ranges::none_of(values, [&](double value) {
            return with_unit(factor, value) == with_unit(factor, start);
          }))
        values.insert(std::ranges::upper_bound(values, start), start);
      map.sliders.push_back({factor.name, {}});
      for (const double value : values) map.sliders.back().settings.push_back(with_unit(factor, value));
      const auto nearest = std::ranges::min_element(values, {}, [&](double value) { return std::abs(value - start); });
      map.first.push_back(static_cast<std::size_t>(nearest - values.begin()));
    }
    return values;
  };
  const double own_lugs = result.asked.scenario.tire.lugs.height;
  const std::vector<double> heights = settings(factors[map_lug_height], lugs, own_lugs),
                            at_slips = settings(factors[map_slip], slips, usual_slip);
  for (const double height : heights)
    for (const double slip : at_slips) map.maps.push_back(heat_map_of(result, height, slip));
  return map;
}

/// Where the models agree, where no clause says it: a box is one only where a condition in it was run.
std::string without_a_box(const FailureMapResult& result) {
  constexpr double told = 0.005;  // of the range: what is 1 % in words
  const double tolerance = 100 * result.question.tolerance;
  if (result.shares.agree < told)
    return fmt::format("Nowhere: no part of the range is within {:.3g} % of the load with 95 % confidence.", tolerance);
  return fmt::format(
      "Cell by cell: {} is within {:.3g} % of the load {} with 95 % confidence in {:.0f} % of the range, but in no box "
      "of conditions that holds one that was run. The map on the page (--report) shows where.",
      pull_of(result.asked.of), tolerance, from_that_of(result.asked.against), 100 * result.shares.agree);
}

std::string decided_sentence(const FailureMapResult& result) {
  const MapShares& shares = result.shares;
  return fmt::format(
      "Decided with 95 % confidence: within {:.3g} % of the load in {:.0f} % of the range, beyond it in "
      "{:.0f} %; not decided in {:.0f} %.",
      100 * result.question.tolerance, 100 * shares.agree, 100 * shares.differ, 100 * shares.undecided);
}

/// Where the quick estimate may be trusted; where not and to which side it errs; how sure that is.
/// `grains`: how far off the grains are themselves, where that is not told before.
std::vector<std::pair<std::string, std::string>> trust_in_words(const FailureMapResult& result,
                                                                const std::string& grains) {
  const double tolerance = 100 * result.question.tolerance;
  std::vector<std::pair<std::string, std::string>> parts;
  std::string boxes;
  for (const AgreementClause& clause : result.clauses)
    boxes += (boxes.empty() ? "" : " Also ") + box_in_words(result.question, clause) + ".";
  parts.emplace_back("Trust it", result.clauses.empty()
                                     ? without_a_box(result)
                                     : fmt::format("{} is within {:.3g} % of the load {} with 95 % confidence {}",
                                                   capital(pull_of(result.asked.of)), tolerance,
                                                   from_that_of(result.asked.against), boxes));
  if (!grains.empty()) parts.back().second += " " + grains;
  const double beyond = 100 * result.shares.beyond;
  parts.emplace_back(
      "Do not trust it",
      fmt::format("The error exceeds {:.3g} % of the load in {:.0f} % of the range by the best estimate. {}", tolerance,
                  beyond, capital(rows_sentence(result))));
  std::string sure = error_sentence(result);
  if (const std::string fresh = checks_sentence(result); !fresh.empty()) sure += " " + fresh;
  parts.emplace_back("How sure", decided_sentence(result) + " " + sure);
  return parts;
}

/// The answer in two lines, above the map.
std::string in_short(const FailureMapResult& result) {
  const Tire& tire = result.asked.scenario.tire;
  const double tolerance = 100 * result.question.tolerance;
  return fmt::format(
      "{} is within {:.3g} % of the load {} in {:.0f} % of the range by the best estimate. {} Set the sliders to your "
      "lugs and slip{}.",
      capital(pull_of(result.asked.of)), tolerance, from_that_of(result.asked.against),
      100 * (1 - result.shares.beyond), decided_sentence(result),
      tire.lugs.height > 0.0
          ? fmt::format(" (they start at those of {}, {:.3g} mm)", tire.name, 1000 * tire.lugs.height)
          : "");
}

/// What a terminal says, for JSON.
std::vector<std::string> in_sentences(const FailureMapResult& result) {
  std::vector<std::string> all;
  for (const auto& [about, text] : trust_in_words(result, grains_sentence(result))) all.push_back(about + ": " + text);
  all.push_back(scatter_sentence(result));
  return all;
}

std::vector<std::string> headings_of(const std::vector<Factor>& factors) {
  std::vector<std::string> headings;
  for (const Factor& factor : factors) headings.push_back(heading(factor.name, factor.unit));
  return headings;
}

/// Values of the factors, each in its unit.
std::vector<TableCell> factor_cells(const std::vector<Factor>& factors, const Eigen::VectorXd& values) {
  std::vector<TableCell> cells;
  for (std::size_t j = 0; j < factors.size(); ++j)
    cells.push_back(number(values[static_cast<Index>(j)] * per_unit(factors[j].unit)));
  return cells;
}

Table rows_table(const FailureMapResult& result) {
  Table table{fmt::format("Every condition run, in order: {}, share of the load", less_in_words(result.asked)),
              headings_of(result.question.factors)};
  const bool twins = result.map.resolution_error.has_value();
  table.header.insert(table.header.end(), {"difference [%]", "cross-validated [%]", "beyond"});
  if (twins) table.header.insert(table.header.end(), {"error of resolution [%]", "by the map"});
  Index k = 0;
  for (const FailureRow& row : result.map.rows) {
    std::vector<TableCell> cells = factor_cells(result.question.factors, row.values);
    if (row.difference) {
      const double predicted = row.difference->value - result.map.held_out.residual[k];
      cells.insert(cells.end(), {in_percent(*row.difference), fmt::format("{:.1f}", 100 * predicted),
                                 row.beyond(result.question.tolerance) ? "yes" : "no"});
      ++k;
    } else {
      cells.insert(cells.end(), {"-", "-", "not answered"});
    }
    if (twins)
      cells.insert(cells.end(), {row.resolution_error ? in_percent(*row.resolution_error) : "-",
                                 judged_in_words(result.map.judged(result.question, row.values))});
    table.add(std::move(cells));
  }
  return table;
}

Table lugs_table(const FailureMapResult& result) {
  const std::vector<Factor>& factors = result.question.factors;
  const Factor& lugs = factors[map_lug_height];
  Table table{fmt::format("What lugs of {} bring over {}: drawbar pull, % of the load", with_unit(lugs, lugs.upper),
                          lugs.lower > 0 ? with_unit(lugs, lugs.lower) : "none"),
              {}};
  for (const int j : {map_load, map_angle, map_slip}) table.header.push_back(heading(factors[j].name, factors[j].unit));
  table.header.insert(table.header.end(), {model_in_words(std::string(word_of(result.asked.of))),
                                           model_in_words(std::string(word_of(result.asked.against)))});
  for (const LugGain& gain : result.lug_gains) {
    std::vector<TableCell> cells;
    for (const int j : {map_load, map_angle, map_slip})
      cells.push_back(number(gain.values[j] * per_unit(factors[static_cast<std::size_t>(j)].unit)));
    cells.insert(cells.end(), {fmt::format("{:.1f}", 100 * gain.of), in_percent(gain.against)});
    table.add(std::move(cells));
  }
  return table;
}

Table checks_table(const FailureMapResult& result) {
  Table table{"Fresh conditions: predicted, then run", headings_of(result.question.factors)};
  table.header.insert(table.header.end(), {"predicted [%]", "found [%]", "difference [standard errors]"});
  for (const FreshCheck& check : result.checks) {
    std::vector<TableCell> cells = factor_cells(result.question.factors, check.values);
    cells.push_back(in_percent(check.predicted));
    cells.push_back(check.found ? in_percent(*check.found) : "not answered");
    cells.push_back(check.found ? fmt::format("{:.1f}", check.sigma()) : "-");
    table.add(std::move(cells));
  }
  return table;
}

Json failure_map_json(const FailureMapResult& result) {
  const std::vector<Factor>& factors = result.question.factors;
  const MapShares& shares = result.shares;
  Json document = {
      {"format", "soilbin-failure-map/1"},      {"incline", name_of(result.asked.incline)},
      {"tolerance", result.question.tolerance}, {"summary", in_sentences(result)},
      {"share_beyond", shares.beyond},          {"cross_validated_error", finite(result.map.held_out.rms())}};
  document["of"] = word_of(result.asked.of), document["against"] = word_of(result.asked.against);
  document["shares"] = {{"agree", shares.agree}, {"differ", shares.differ}, {"undecided", shares.undecided}};
  document["lug_gains"] = list_of(result.lug_gains, [&](const LugGain& gain) {
    Json json = values_json(factors, gain.values);
    json["of"] = gain.of, json["against"] = estimate_json(gain.against);
    return json;
  });
  document["factors"] = list_of(factors, [](const Factor& factor) {
    return Json{{"name", factor.name}, {"lower", factor.lower}, {"upper", factor.upper}};
  });
  document["rows"] = list_of(result.map.rows, [&](const FailureRow& row) {
    Json json = values_json(factors, row.values);
    json["difference"] = or_null(row.difference), json["beyond"] = row.beyond(result.question.tolerance);
    json["resolution_error"] = or_null(row.resolution_error);
    json["judged"] = word_of(result.map.judged(result.question, row.values));
    return json;
  });
  document["checks"] = list_of(result.checks, [&](const FreshCheck& check) {
    Json json = values_json(factors, check.values);
    json["predicted"] = estimate_json(check.predicted), json["found"] = or_null(check.found);
    return json;
  });
  return document;
}

/// The map at the corners of lug height and slip.
std::vector<ReportPart> corners(const FailureMapResult& result) {
  const std::vector<Factor>& factors = result.question.factors;
  std::vector<std::string> maps;
  for (const double slip :
       {factors[map_slip].lower, (factors[map_slip].lower + factors[map_slip].upper) / 2, factors[map_slip].upper})
    for (const double height : two_levels(factors[map_lug_height]))
      maps.push_back(heat_map_svg(heat_map_of(result, height, slip)));
  return {{Drawings{std::move(maps), "Loads across, angles up.", "", true}}};
}

}  // namespace

Report report_on(const FailureMapResult& result, const FailureMapAbout& about) {
  const auto the = [](ModelKind kind) {
    return std::string(kind == ModelKind::bekker_wong ? "the " : "") + model_in_words(std::string(word_of(kind)));
  };
  Report report{"Where may I trust the quick estimate?",
                fmt::format("{}: {} against {}, {} on {}", about.name, the(result.asked.of), the(result.asked.against),
                            result.asked.scenario.tire.name, in_words(result.asked.scenario.soil))};
  const std::string grains = grains_sentence(result);
  std::vector<std::string> first = {in_short(result)};
  if (!grains.empty()) first.push_back(grains);
  report.add(Sentences(first), Told::on_pages);
  const std::string below_map = fmt::format(
      "Drawbar pull, {}, in per cent of the load, as the map has it; loads across, angles up. Blue: {} is too low; "
      "orange: too high. Bold: the models differ by more than the tolerance; faint: they agree; with a question mark: "
      "not decided.",
      less_in_words(result.asked), pull_of(result.asked.of));
  report.add("The map", Html{sliding_map_html(sliding_map_of(result), below_map)}, Told::on_pages, "map",
             ReportPart::Heading::place);
  report.add("The answer in full", Sentences(trust_in_words(result, "")), Told::on_pages, "answer",
             ReportPart::Heading::place);
  report.add(Sentences(trust_in_words(result, grains)), Told::in_text);
  report.add(Items{{scatter_sentence(result)}});
  report.add(WarningsHere());
  report.add(Fold{"The map at its corners, side by side", [&result] { return corners(result); }});
  report.add("What it rests on", Prose{}, Told::on_pages, "rows");
  report.add(Fold{fmt::format("All {} conditions run", result.map.rows.size()),
                  [&result] { return std::vector<ReportPart>{{rows_table(result)}}; }});
  if (!result.lug_gains.empty())
    report.add(Fold{"What lugs bring", [&result] { return std::vector<ReportPart>{{lugs_table(result)}}; }});
  if (!result.checks.empty())
    report.add(
        Fold{"Checks on fresh conditions", [&result] { return std::vector<ReportPart>{{checks_table(result)}}; }});
  if (about.show_rows) report.add(rows_table(result), Told::on_terminals);
  if (!result.lug_gains.empty()) report.add(lugs_table(result), Told::on_terminals);
  if (!result.checks.empty()) report.add(checks_table(result), Told::on_terminals);
  report.resolved_case = about.resolved_case;
  report.data = [&result] { return failure_map_json(result); };
  return report;
}

}  // namespace soilbin::compare
