#include "cli/text_output.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <numeric>

#include "compare/measured/channels.hpp"
#include "compare/report/json_fields.hpp"
#include "compare/sweep/varying.hpp"
#include "scenario/nearest_word.hpp"
#include "scenario/unit.hpp"

namespace soilbin::cli {
namespace {

using compare::Answer;
using compare::capital;
using compare::channel_views;
using compare::ChannelError;
using compare::ChannelView;
using compare::Curves;
using compare::curves_against_slip;
using compare::HtmlTable;
using compare::ModelAnswers;
using compare::PredictedRun;
using compare::Prediction;
using compare::Spread;

/// Characters of a UTF-8 text.
std::size_t width(const std::string& text) {
  return static_cast<std::size_t>(
      std::count_if(text.begin(), text.end(), [](char c) { return (static_cast<unsigned char>(c) & 0xC0) != 0x80; }));
}

bool is_number(const std::string& text) {
  if (text.empty() || text == "-") return true;
  const std::size_t first = text.front() == '-' || text.front() == '+' ? 1 : 0;
  return first < text.size() && std::isdigit(static_cast<unsigned char>(text[first])) != 0;
}

std::vector<OperatingCondition> conditions_of(const std::vector<Answer>& answers) {
  std::vector<OperatingCondition> all;
  for (const Answer& answer : answers) all.push_back(answer.at);
  return all;
}

bool any_side_force(const std::vector<ModelAnswers>& study) {
  for (const ModelAnswers& model : study)
    for (const Answer& answer : model.answers)
      if (answer.result && answer.result->lateral_force.value != 0.0) return true;
  return false;
}

/// In percent; "-" where there is none (has_efficiency).
std::string efficiency(const TractionResult& result) {
  return has_efficiency(result) ? number(100 * result.tractive_efficiency) : "-";
}

std::string heading(const ChannelView& channel) { return fmt::format("{} [{}]", channel.title, channel.unit); }

constexpr std::size_t widest_line = 120;
constexpr std::size_t between_columns = 2;

/// The words of a cell, in lines of at most `wide` characters where no word is longer.
std::vector<std::string> folded(const std::string& cell, std::size_t wide) {
  std::vector<std::string> lines{""};
  for (std::size_t at = 0; at <= cell.size();) {
    const std::size_t end = std::min(cell.find(' ', at), cell.size());
    const std::string word = cell.substr(at, end - at);
    if (at > 0 && width(lines.back()) + 1 + width(word) > wide)
      lines.push_back(word);
    else
      lines.back() += (at > 0 ? " " : "") + word;
    at = end + 1;
  }
  return lines;
}

std::size_t longest_word(const std::string& cell) {
  std::size_t longest = 0;
  for (const std::string& word : folded(cell, 0)) longest = std::max(longest, width(word));
  return longest;
}

/// Narrows the widest columns, a character at a time, until a line fits. Where it cannot fit all stays as it is.
void narrow(std::vector<std::size_t>& widths, const std::vector<std::size_t>& least) {
  const std::size_t gaps = between_columns * (widths.size() - 1);
  const auto line_of = [&](const std::vector<std::size_t>& all) {
    return std::accumulate(all.begin(), all.end(), gaps);
  };
  if (line_of(least) > widest_line) return;
  for (std::size_t line = line_of(widths); line > widest_line; --line) {
    std::size_t widest = widths.size();
    for (std::size_t c = 0; c < widths.size(); ++c)
      if (widths[c] > least[c] && (widest == widths.size() || widths[c] > widths[widest])) widest = c;
    if (widest == widths.size()) return;
    --widths[widest];
  }
}

}  // namespace

std::string with_unit(const SoilParameter& parameter) {
  const bool plain = std::string_view(parameter.unit) == "-";
  return plain ? parameter.symbol : fmt::format("{} [{}]", parameter.symbol, parameter.unit);
}

std::string TextTable::text() const {
  std::vector<std::size_t> widths(rows_.front().size(), 0);
  std::vector<bool> right(widths.size(), true);
  const auto is_title = [&](const std::vector<std::string>& row) { return row.size() < rows_.front().size(); };
  for (std::size_t r = 0; r < rows_.size(); ++r)
    for (std::size_t c = 0; c < rows_[r].size() && !is_title(rows_[r]); ++c) {
      widths[c] = std::max(widths[c], width(rows_[r][c]));
      if (r > 0 && !is_number(rows_[r][c])) right[c] = false;
    }
  const auto has_note = [](const std::string& cell) { return cell.find(" (") != std::string::npos; };
  std::vector<std::size_t> least(widths.size(), 0);  // figures stay in one line, words may be folded
  for (std::size_t r = 0; r < rows_.size(); ++r)
    for (std::size_t c = 0; c < rows_[r].size() && !is_title(rows_[r]); ++c)
      least[c] = std::max(least[c],
                          r > 0 && right[c] && !has_note(rows_[r][c]) ? width(rows_[r][c]) : longest_word(rows_[r][c]));
  narrow(widths, least);
  std::string text;
  for (const std::vector<std::string>& row : rows_) {
    if (is_title(row)) {
      text += "\n" + row.front() + "\n";
      continue;
    }
    std::vector<std::vector<std::string>> cells;
    std::size_t lines = 1;
    for (std::size_t c = 0; c < row.size(); ++c) {
      cells.push_back(width(row[c]) > widths[c] ? folded(row[c], widths[c]) : std::vector{row[c]});
      lines = std::max(lines, cells.back().size());
    }
    for (std::size_t l = 0; l < lines; ++l) {
      std::string line;
      for (std::size_t c = 0; c < row.size(); ++c) {
        const std::string part = l < cells[c].size() ? cells[c][l] : "", blanks(widths[c] - width(part), ' ');
        line += (c == 0 ? "" : std::string(between_columns, ' ')) + (right[c] ? blanks + part : part + blanks);
      }
      text += line.substr(0, line.find_last_not_of(' ') + 1) + "\n";
    }
  }
  return text;
}

std::string as_text(const HtmlTable& table) {
  TextTable text(table.header);
  for (const auto& row : table.rows) text.add(row);
  return table.caption.empty() ? text.text() : fmt::format("{}\n{}", table.caption, text.text());
}

void print_warnings(const std::vector<std::string>& warnings) {
  for (const std::string& warning : warnings) fmt::print(stderr, "warning: {}\n", warning);
}

void print_json(nlohmann::ordered_json document, const std::vector<std::string>& doubts) {
  compare::tell_doubts(document, doubts);
  fmt::print("{}", compare::json_text(document));
}

std::vector<Reading> readings(const TractionResult& r) {
  std::vector<Reading> all;
  for (const ChannelView& channel : channel_views)
    all.push_back(
        {capital(std::string(channel.title)), number(r.*channel.predicted, channel.per_si), std::string(channel.unit)});
  const std::string none = why_no_efficiency(r);
  all.push_back({"Tractive efficiency", none.empty() ? efficiency(r) : "none: " + none, none.empty() ? "%" : ""});
  all.push_back(
      {"Contact",
       fmt::format("soil meets the wheel {:.1f}° before the axle, presses most at {:.1f}°, lets go at {:.1f}°",
                   r.entry_angle / degree, r.max_stress_angle / degree, r.exit_angle / degree + 0.0),
       ""});
  std::string sum;
  for (const Contribution& part : r.budget) {
    std::string name = part.name;
    std::replace(name.begin(), name.end(), '_', ' ');
    const std::string sign = sum.empty() ? (part.force < 0 ? "-" : "") : (part.force < 0 ? " - " : " + ");
    sum += fmt::format("{}{} N ({})", sign, number(std::abs(part.force)), name);
  }
  if (const BudgetRest& rest = r.budget_rest; std::abs(rest.force) > 1e-9 * r.at.load)
    sum +=
        fmt::format("; {} N of it is in none of these{}", number(rest.force),
                    std::isfinite(rest.bound) ? fmt::format(" (sampling leaves up to {} N)", number(rest.bound)) : "");
  all.push_back({"Drawbar pull is", sum, ""});
  if (!r.without_error_of.empty())
    all.push_back(
        {"Standard errors",
         fmt::format("leave out the soil's {}: the results have no derivative by it here", listed(r.without_error_of)),
         ""});
  return all;
}

/// Why a pull at 0 % slip is not 0, which readers expect; "" where no answer is at that slip.
std::string pull_without_slip(const std::vector<Answer>& answers) {
  const bool there = std::any_of(answers.begin(), answers.end(),
                                 [](const Answer& answer) { return std::abs(answer.at.slip) < 1e-9 && answer.result; });
  return there ? "At 0 % slip (v = r ω) the soil is still compacted and sheared along the contact, so the pull is not "
                 "0.\n"
               : "";
}

std::string answer_text(const ModelAnswers& model, const Answer& answer) {
  std::string text = fmt::format("{}: {}\n", model.choice.label, compare::in_words(answer.at));
  if (!answer.result) return text + "  no solution: " + answer.error + "\n";
  text += "\n";
  for (const Reading& reading : readings(*answer.result))
    text += fmt::format("  {:<21}{}{}{}\n", reading.name, reading.value, reading.unit.empty() ? "" : " ", reading.unit);
  return text + pull_without_slip({answer});
}

std::string study_text(const std::vector<ModelAnswers>& study) {
  const bool side = any_side_force(study);
  std::string text;
  for (const ModelAnswers& model : study) {
    const Curves curves = curves_against_slip(conditions_of(model.answers), Spread::exact);
    std::vector<std::string> header;
    if (!curves.varying.empty()) header.push_back(curves.varying);
    header.push_back("slip [%]");
    for (std::size_t c = 0; c < channel_views.size(); ++c)
      if (side || channel_views[c].name != "lateral_force") header.push_back(heading(channel_views[c]));
    header.push_back("efficiency [%]");
    TextTable table(header);
    std::string notes;
    for (std::size_t i = 0; i < model.answers.size(); ++i) {
      const Answer& answer = model.answers[i];
      std::vector<std::string> row;
      if (!curves.varying.empty()) row.push_back(curves.labels[curves.curve_of[i]]);
      row.push_back(fmt::format("{:.4g}", 100 * answer.at.slip));
      for (const ChannelView& channel : channel_views)
        if (side || channel.name != "lateral_force")
          row.push_back(answer.result ? number((*answer.result).*channel.predicted, channel.per_si) : "-");
      row.push_back(answer.result ? efficiency(*answer.result) : "-");
      table.add(std::move(row));
      if (!answer.result) notes += fmt::format("no solution at {}: {}\n", compare::in_words(answer.at), answer.error);
    }
    text += (text.empty() ? "" : "\n") + model.choice.label + "\n" + table.text() + notes;
  }
  return study.empty() ? text : text + pull_without_slip(study.front().answers);
}

std::string errors_text(const Prediction& prediction) {
  TextTable table({"channel", "runs", "rms error", "bias (predicted - measured)", "measured range", "rms/range [%]"});
  for (const ChannelError& error : prediction.errors) {
    const auto in_unit = [&](double si) { return compare::in_unit(error.channel, si); };
    table.add({std::string(channel_views[error.channel].title), std::to_string(error.runs), in_unit(error.rmse),
               in_unit(error.bias), in_unit(error.range), number(100 * error.share_of_range)});
  }
  return table.text();
}

std::string prediction_text(const Prediction& prediction) {
  std::vector<OperatingCondition> conditions;
  for (const PredictedRun& run : prediction.runs) conditions.push_back(run.measured.at);
  const Curves curves = curves_against_slip(conditions, Spread::measured);
  std::vector<std::string> header = {"run"};
  if (!curves.varying.empty()) header.push_back("nominal " + curves.varying);
  header.insert(header.end(), {"load [N]", "slip [%]"});
  for (const ChannelError& error : prediction.errors) {
    const ChannelView& channel = channel_views[error.channel];
    header.push_back(heading(channel));
    header.insert(header.end(), {"predicted", "residual"});
  }
  TextTable table(header);
  std::string notes;
  for (std::size_t i = 0; i < prediction.runs.size(); ++i) {
    const PredictedRun& run = prediction.runs[i];
    std::vector<std::string> row = {std::to_string(run.run)};
    if (!curves.varying.empty()) row.push_back(curves.labels[curves.curve_of[i]]);
    row.push_back(number(run.measured.at.load));
    row.push_back(fmt::format("{:.4g}", 100 * run.measured.at.slip));
    for (const ChannelError& error : prediction.errors) {
      const ChannelView& channel = channel_views[error.channel];
      const auto measured = run.measured.*channel.measured;
      const auto rest = residual(run, channel);
      row.push_back(measured ? number(*measured * channel.per_si) : "-");
      row.push_back(run.predicted.result ? number(((*run.predicted.result).*channel.predicted).value * channel.per_si)
                                         : "-");
      row.push_back(rest ? number(*rest * channel.per_si) : "-");
    }
    if (!run.predicted.result) notes += fmt::format("run {}: no solution: {}\n", run.run, run.predicted.error);
    table.add(std::move(row));
  }
  return table.text() + notes + "\n" + errors_text(prediction);
}

}  // namespace soilbin::cli
