#include "compare/export/force_table.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <set>

#include "compare/report/number_text.hpp"
#include "scenario/csv.hpp"
#include "scenario/errors.hpp"
#include "scenario/nearest_word.hpp"

namespace soilbin::compare {
namespace {

/// What may vary, in the order of the axes.
constexpr std::array<std::string_view, 8> axes_in_order = {
    "load", "slip", "yaw", "longitudinal_incline", "transverse_incline", "speed", "inflation_pressure", "moisture"};

/// One hint for a question that is no full grid.
constexpr const char* grid_hint = "\n  hint: such as --load 50N..200N:10N --slip 0%..60%:5%";

/// Throws InputError where conditions differ in what no axis holds.
void refuse_other_variation(const std::vector<OperatingCondition>& conditions) {
  const OperatingCondition& first = conditions.front();
  const auto varies = [&](const auto& get) {
    return std::ranges::any_of(conditions, [&](const OperatingCondition& at) { return get(at) != get(first); });
  };
  const std::pair<const char*, bool> others[] = {
      {"pass", varies([](const auto& at) { return at.pass; })},
      {"run", varies([](const auto& at) { return at.run; })},
      {"position", varies([](const auto& at) { return at.position; })},
      {"slip_by", varies([](const auto& at) { return at.slip_by; })},
      {"force_frame", varies([](const auto& at) { return at.force_frame; })}};
  for (const auto& [name, is_so] : others)
    if (is_so)
      throw InputError(
          fmt::format("a table can't run over '{0}': there is nothing between its values\n"
                      "  hint: a table for each '{0}'",
                      name));
}

std::vector<TableAxis> axes_of(const std::vector<OperatingCondition>& conditions) {
  std::vector<TableAxis> axes;
  for (const std::string_view name : axes_in_order) {
    const ConditionView& view = condition_view(name);
    std::set<double> nodes;
    bool told = true;
    for (const OperatingCondition& at : conditions) {
      const double value = view.get(at);
      told = told && !std::isnan(value);
      if (!std::isnan(value)) nodes.insert(value);
    }
    if (!told && !nodes.empty())
      throw InputError(fmt::format("some conditions have a '{}' and some have none: they span no grid", name));
    if (nodes.size() > 1) axes.push_back({&view, {nodes.begin(), nodes.end()}});
  }
  return axes;
}

std::size_t nodes_of(const std::vector<TableAxis>& axes) {
  std::size_t nodes = 1;
  for (const TableAxis& axis : axes) nodes *= axis.nodes.size();
  return nodes;
}

/// Number of a node of the grid from its number along each axis.
std::size_t flat(const std::vector<TableAxis>& axes, const std::vector<std::size_t>& along) {
  std::size_t index = 0;
  for (std::size_t k = 0; k < axes.size(); ++k) index = index * axes[k].nodes.size() + along[k];
  return index;
}

/// The number along each axis of the `index`-th of a grid with `less` nodes less along each: 1 counts cells.
std::vector<std::size_t> along_axes(const std::vector<TableAxis>& axes, std::size_t index, std::size_t less) {
  std::vector<std::size_t> along(axes.size());
  for (std::size_t k = axes.size(); k-- > 0;) {
    const std::size_t size = axes[k].nodes.size() - less;
    along[k] = index % size, index /= size;
  }
  return along;
}

OperatingCondition placed(OperatingCondition at, const std::vector<TableAxis>& axes, const std::vector<double>& place) {
  for (std::size_t k = 0; k < axes.size(); ++k) axes[k].view->set(at, place[k]);
  return at;
}

/// The conditions in the order of the grid. Throws InputError where it has gaps.
std::vector<OperatingCondition> in_grid_order(const std::vector<OperatingCondition>& conditions,
                                              const std::vector<TableAxis>& axes) {
  const std::size_t nodes = nodes_of(axes);
  std::vector<const OperatingCondition*> found(nodes, nullptr);
  for (const OperatingCondition& at : conditions) {
    std::vector<std::size_t> along;
    for (const TableAxis& axis : axes)
      along.push_back(
          static_cast<std::size_t>(std::ranges::lower_bound(axis.nodes, axis.view->get(at)) - axis.nodes.begin()));
    found[flat(axes, along)] = &at;
  }
  const auto gaps = static_cast<std::size_t>(std::ranges::count(found, nullptr));
  if (gaps > 0) {
    std::string names;
    for (const TableAxis& axis : axes) names += (names.empty() ? "" : " x ") + std::string(axis.view->name);
    throw InputError(
        fmt::format("the conditions leave {} of the {} nodes of {} out: a table takes every combination"
                    "\n  hint: where the case gives 'rotation', --speed 0.1m/s; {}",
                    gaps, nodes, names, std::string(grid_hint).substr(9)));
  }
  std::vector<OperatingCondition> ordered;
  for (const OperatingCondition* at : found) ordered.push_back(*at);
  return ordered;
}

std::vector<TableChannel> channels_of(const std::vector<Answer>& nodes) {
  std::vector<TableChannel> channels;
  for (const TractionChannel& channel : traction_channels) {
    TableChannel made{&channel, {}, {}};
    for (const Answer& node : nodes) {
      const Estimate told = node.result ? (*node.result).*channel.predicted : Estimate{not_a_number, not_a_number};
      made.values.push_back(told.value), made.std_errors.push_back(told.std_error);
      if (std::isfinite(told.value)) made.scale = std::max(made.scale, std::abs(told.value));
    }
    if (std::ranges::any_of(made.values, [](double value) { return std::isfinite(value); }))
      channels.push_back(std::move(made));
  }
  return channels;
}

/// Where the table is asked whether it agrees with the model.
struct TablePlace {
  std::vector<double> at;
  Answer model;
};

/// Adds up how far interpolated values lie from the model's.
class ErrorSums {
 public:
  explicit ErrorSums(std::size_t channels) : squares_(channels), largest_(channels) {}

  void add(const ForceTable& table, const std::vector<double>& at, const TractionResult& model) {
    const std::optional<LookedUp> found = look_up(table, at);
    if (!found) return;
    ++count_;
    for (std::size_t k = 0; k < squares_.size(); ++k) {
      const double error = found->values[k] - (model.*table.channels[k].channel->predicted).value;
      if (!std::isfinite(error)) continue;
      squares_[k] += error * error;
      largest_[k] = std::max(largest_[k], std::abs(error));
    }
  }
  double rms(std::size_t channel) const {
    return count_ == 0 ? 0.0 : std::sqrt(squares_[channel] / static_cast<double>(count_));
  }
  double largest(std::size_t channel) const { return largest_[channel]; }

 private:
  std::vector<double> squares_, largest_;
  std::size_t count_ = 0;
};

/// Asks the model in the middles of cells and on edges, and counts how far it is.
class TableCheck {
 public:
  TableCheck(ForceTable& table, const Model& model, const Progress& progress)
      : table_(table),
        model_(model),
        scenario_(seen_by(table.question.study.models.front(), table.question.scenario)),
        progress_(progress) {
    cells_ = 1;
    for (const TableAxis& axis : table.axes) cells_ *= axis.nodes.size() - 1;
    done_ = nodes_of(table.axes), total_ = done_ + cells_ + table.axes.size() * most_edges;
  }

  std::size_t total() const { return total_; }

  void middles() {
    ErrorSums sums(table_.channels.size());
    for (std::size_t cell = 0; cell < cells_; ++cell) {
      const std::vector<std::size_t> along = along_axes(table_.axes, cell, 1);
      std::vector<double> at;
      for (std::size_t k = 0; k < along.size(); ++k) at.push_back(middle(k, along[k]));
      step();
      if (!look_up(table_, at)) continue;
      const Answer answer = ask(model_, scenario_, placed(table_.fixed, table_.axes, at));
      ++table_.cells;
      if (answer.result)
        sums.add(table_, at, *answer.result);
      else
        ++table_.cells_without_answer;
    }
    for (std::size_t k = 0; k < table_.channels.size(); ++k)
      table_.channels[k].largest_error = sums.largest(k), table_.channels[k].rms_error = sums.rms(k);
  }

  /// Edges spread over the nodes in steps of the golden ratio, which no grid's size divides.
  void edges() {
    constexpr double golden = 0.6180339887498949;
    const auto nodes = static_cast<double>(nodes_of(table_.axes));
    for (std::size_t axis = 0; axis < table_.axes.size(); ++axis) {
      ErrorSums sums(table_.channels.size());
      for (int i = 0; i < most_edges; ++i) {
        step();
        const double share = golden * i - std::floor(golden * i);
        std::vector<std::size_t> along = along_axes(table_.axes, static_cast<std::size_t>(share * nodes), 0);
        along[axis] = std::min(along[axis], table_.axes[axis].nodes.size() - 2);
        std::vector<double> at;
        for (std::size_t k = 0; k < along.size(); ++k)
          at.push_back(k == axis ? middle(k, along[k]) : table_.axes[k].nodes[along[k]]);
        if (!look_up(table_, at)) continue;
        const Answer answer = ask(model_, scenario_, placed(table_.fixed, table_.axes, at));
        if (answer.result) sums.add(table_, at, *answer.result);
      }
      for (std::size_t k = 0; k < table_.channels.size(); ++k)
        if (const double scale = table_.channels[k].scale; scale > 0.0)
          table_.axes[axis].error_share = std::max(table_.axes[axis].error_share, sums.rms(k) / scale);
    }
  }

 private:
  double middle(std::size_t axis, std::size_t cell) const {
    return 0.5 * (table_.axes[axis].nodes[cell] + table_.axes[axis].nodes[cell + 1]);
  }
  void step() {
    if (progress_) progress_(std::min(++done_, total_), total_);
  }

  ForceTable& table_;
  const Model& model_;
  Scenario scenario_;
  const Progress& progress_;
  std::size_t cells_ = 0, done_ = 0, total_ = 0;
};

/// The cell of an axis that holds a value, and how far into it [0 .. 1].
struct AxisPlace {
  std::size_t cell = 0;
  double share = 0.0;
  bool clamped = false;
};

AxisPlace place_on(const std::vector<double>& nodes, double value) {
  const bool outside = value < nodes.front() || value > nodes.back();
  const double within = std::clamp(value, nodes.front(), nodes.back());
  const auto above = static_cast<std::size_t>(std::ranges::upper_bound(nodes, within) - nodes.begin());
  const std::size_t cell = std::min(above, nodes.size() - 1) - 1;
  return {cell, (within - nodes[cell]) / (nodes[cell + 1] - nodes[cell]), outside};
}

}  // namespace

std::optional<LookedUp> look_up(const ForceTable& table, const std::vector<double>& at) {
  std::vector<AxisPlace> places;
  LookedUp found;
  for (std::size_t k = 0; k < table.axes.size(); ++k) {
    if (std::isnan(at[k])) return std::nullopt;
    places.push_back(place_on(table.axes[k].nodes, at[k]));
    found.clamped = found.clamped || places.back().clamped;
  }
  found.values.assign(table.channels.size(), 0.0), found.std_errors = found.values;
  for (std::size_t corner = 0; corner < (std::size_t{1} << places.size()); ++corner) {
    double weight = 1.0;
    std::vector<std::size_t> along;
    for (std::size_t k = 0; k < places.size(); ++k) {
      const bool upper = ((corner >> k) & 1U) != 0;
      weight *= upper ? places[k].share : 1.0 - places[k].share;
      along.push_back(places[k].cell + (upper ? 1 : 0));
    }
    if (weight == 0.0) continue;
    const std::size_t node = flat(table.axes, along);
    if (!table.nodes.answers[node].result) return std::nullopt;
    for (std::size_t k = 0; k < table.channels.size(); ++k) {
      found.values[k] += weight * table.channels[k].values[node];
      found.std_errors[k] += weight * table.channels[k].std_errors[node];
    }
  }
  return found;
}

ForceTable force_table(Case question, const Progress& progress, const MakeModel& make) {
  if (question.study.models.size() != 1) {
    std::vector<std::string> labels;
    for (const ModelChoice& choice : question.study.models) labels.push_back(choice.label);
    throw InputError(
        fmt::format("a table holds the answers of one model, and the case asks {}: {}\n  hint: --model "
                    "NAME, or --effect NAME for the analytic wheel with that effect alone",
                    labels.size(), listed(labels)));
  }
  if (question.study.conditions.empty())
    throw InputError(std::string("there are no conditions to make a table of") + grid_hint);
  refuse_other_variation(question.study.conditions);
  ForceTable table;
  table.axes = axes_of(question.study.conditions);
  if (table.axes.empty())
    throw InputError(std::string("a table runs over two values of a condition or more, and none varies") + grid_hint);
  question.study.conditions = in_grid_order(question.study.conditions, table.axes);
  question.study.rotations.clear();
  table.question = std::move(question);
  table.fixed = table.question.study.conditions.front();
  const std::unique_ptr<const Model> model = make(table.question.study.models.front().model);
  TableCheck check(table, *model, progress);
  table.nodes.choice = table.question.study.models.front();
  table.nodes.answers = sweep(*model, seen_by(table.nodes.choice, table.question.scenario),
                              table.question.study.conditions, [&](std::size_t done, std::size_t) {
                                if (progress) progress(done, check.total());
                              });
  table.without_answer = static_cast<std::size_t>(
      std::ranges::count_if(table.nodes.answers, [](const Answer& answer) { return !answer.result; }));
  if (table.without_answer == table.nodes.answers.size())
    throw NoSolution("no node of the table has an answer: " + table.nodes.answers.front().error);
  table.channels = channels_of(table.nodes.answers);
  check.middles();
  check.edges();
  return table;
}

RoughestChannel roughest(const ForceTable& table) {
  RoughestChannel worst{&table.channels.front(), 0.0};
  for (const TableChannel& channel : table.channels)
    if (channel.scale > 0.0 && channel.largest_error / channel.scale > worst.share)
      worst = {&channel, channel.largest_error / channel.scale};
  return worst;
}

const TableAxis& coarsest(const ForceTable& table) {
  return *std::ranges::max_element(table.axes, {}, &TableAxis::error_share);
}

std::string csv_of(const ForceTable& table) {
  constexpr int digits = 15;  // a simulator that differentiates the table must not see its rounding
  std::string csv;
  for (const TableAxis& axis : table.axes) csv += std::string(axis.view->column) + ",";
  for (const TableChannel& channel : table.channels)
    csv += column_of(*channel.channel) + "," + column_of(*channel.channel, "se") + ",";
  csv += "error\n";
  for (std::size_t node = 0; node < table.nodes.answers.size(); ++node) {
    const Answer& answer = table.nodes.answers[node];
    for (const TableAxis& axis : table.axes)
      csv += csv_number(axis.view->get(answer.at) * per_unit(std::string(axis.view->column_unit)), digits) + ",";
    for (const TableChannel& channel : table.channels)
      csv += csv_number(channel.values[node], digits) + "," + csv_number(channel.std_errors[node], digits) + ",";
    csv += csv_cell(answer.error) + "\n";
  }
  return csv;
}

}  // namespace soilbin::compare
