// A model's answers on a regular grid of conditions, for programs that look forces up in place of asking the model: how
// far a value interpolated between its nodes lies from the model is measured and told.
//
//   const ForceTable table = force_table(question);  // loads x slips x ... of the question's study, by its one model
//   if (const std::optional<LookedUp> found = look_up(table, {800.0, 0.2})) found->values[0];  // drawbar pull [N]
//   write_file_atomically("wheel.h", c_header_of(table, {.name = "wheel", .version = "0.1.0"}));
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "compare/measured/condition_views.hpp"
#include "compare/sweep/answers.hpp"
#include "scenario/traction_channels.hpp"

namespace soilbin::compare {

/// A condition that the table runs over: its nodes, rising, two or more [SI].
struct TableAxis {
  const ConditionView* view;
  std::vector<double> nodes;
  /// Root mean square of the interpolation's error half-way between two nodes of this axis alone, at up to
  /// `most_edges` places spread over the table: the largest over the channels, each as a share of its `scale`.
  double error_share = 0.0;
};

/// What the table holds of each node; in the order of the nodes, the last axis fastest. Not a number where the model
/// has no answer.
struct TableChannel {
  const TractionChannel* channel;
  std::vector<double> values;      ///< [SI]
  std::vector<double> std_errors;  ///< from the soil's standard deviations [SI]
  double scale = 0.0;              ///< largest magnitude of `values`
  double largest_error = 0.0;      ///< of the interpolation, over the middles of all cells [SI]
  double rms_error = 0.0;          ///< its root mean square there
};

/// More edges than these are not looked at to tell which axis the error comes from.
inline constexpr int most_edges = 64;
/// The interpolation is told to be rough where its largest error exceeds this share of a channel's largest magnitude.
/// Chosen.
inline constexpr double rough_share = 0.05;

struct ForceTable {
  Case question;             ///< whose study has the one model and the nodes as conditions, in the channels' order
  ModelAnswers nodes;        ///< the answers at them
  OperatingCondition fixed;  ///< the first node: what does not vary is the same at all
  std::vector<TableAxis> axes;
  std::vector<TableChannel> channels;    ///< those that the model answers
  std::size_t without_answer = 0;        ///< nodes
  std::size_t cells = 0;                 ///< whose middle was asked: those with answers at all corners
  std::size_t cells_without_answer = 0;  ///< of these, where the model has none
};

/// The table of a question whose study asks one model at a full grid of conditions. Asks the model at every node, in
/// the middle of every cell and on some edges. Throws InputError for several models, a grid with gaps, conditions that
/// vary and have no middle (pass), and where nothing varies; what `make` throws; NoSolution where no node has an
/// answer.
ForceTable force_table(Case question, const Progress& progress = {}, const MakeModel& make = make_model);

/// A place in the table, in the order of its channels [SI].
struct LookedUp {
  std::vector<double> values, std_errors;
  bool clamped = false;  ///< the place lies outside: these are the values at the nearest place within
};

/// Multilinear between the corners of the cell that holds the place; `at` in the order of the axes. Nothing where a
/// corner that counts has no answer, or `at` is not a number.
std::optional<LookedUp> look_up(const ForceTable& table, const std::vector<double>& at);

/// The channel with the largest error by its scale, and that share.
struct RoughestChannel {
  const TableChannel* channel;
  double share;
};
RoughestChannel roughest(const ForceTable& table);
/// The axis from which most of the error comes.
const TableAxis& coarsest(const ForceTable& table);

/// A node each: the axes' values, then value and standard error of each channel, why there is no answer. SI, angles in
/// degrees.
std::string csv_of(const ForceTable& table);

/// What a C header says beside the table.
struct CHeaderAbout {
  std::string name;     ///< of its functions: a stem of letters, digits and '_'
  std::string version;  ///< of soilbin
};

/// In which unit the table holds a condition: "N", "rad", "-" for a plain number.
std::string si_unit_of(const ConditionView& view);

/// "rover table-2.h" as "rover_table_2": what its functions begin with.
std::string c_name_of(const std::string& file);

/// One file of C99, which C++ takes too, without dependencies: the table, NAME_lookup, which clamps and tells so by its
/// status, and in its comment tire, soil, model, units, range and errors.
std::string c_header_of(const ForceTable& table, const CHeaderAbout& about);

}  // namespace soilbin::compare
