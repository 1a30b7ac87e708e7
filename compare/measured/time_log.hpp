// A time log of a rig made a table of runs: its setpoints are found, transients cut off, and means taken with errors
// that allow for samples following each other.
//
//   const LogRuns made = runs_of_log(read_time_log(read_source_text("log.csv", largest_log)));
//   write_file_atomically("runs.csv", runs_csv(made));   // as a campaign reads it
//
// Samples of one run share its bed, its instruments' zero and each other's noise: thirty of them are not thirty runs.
#pragma once

#include <array>
#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "compare/measured/campaign.hpp"
#include "compare/measured/run_columns.hpp"
#include "scenario/estimate.hpp"
#include "scenario/source_text.hpp"

namespace soilbin::compare {

inline constexpr std::size_t largest_log = 1U << 28U;  ///< [bytes]
inline constexpr std::size_t most_log_rows = 1'000'000;

/// A time of a logger in seconds: a number; "12:30:05.25" or "12:30:05 PM", from midnight; "2026-01-31T12:30:05" or
/// "01/31/2026 12:30", with "Z" or "+01:00" behind it or without, from 1970; no value for anything else.
std::optional<double> clock_time(const std::string& text);

/// One of a unit in SI: "kN" is 1000.
double one_in_si(const std::string& unit);

/// Whether a column of this name holds the time of each row: "time", "t", "timestamp", alone or with a unit behind it.
bool names_a_clock(const std::string& header);

/// Whether a column of this name tells which wheel a row is of: "wheel", "tire", "tyre".
bool names_the_wheel(const std::string& header);

struct LogReading {
  std::map<std::string, DataColumn> columns{};              ///< names and units that a campaign declares, by quantity
  std::vector<std::pair<std::string, std::string>> only{};  ///< rows that have this text in this column alone
  std::string by{};                                         ///< column whose changes alone part the runs; "": none
};

/// A quantity of a log, row by row.
struct LoggedColumn {
  const RunColumn* column = nullptr;
  std::string header;
  std::vector<double> values;  ///< [SI]; not a number in an empty cell
};

/// The samples of a log, of one wheel.
struct TimeLog {
  std::string file;
  std::vector<LoggedColumn> columns;
  std::vector<double> clock;  ///< seconds, or what else the column counts; not a number where it tells none; or none
  std::vector<std::size_t> part;  ///< number of the named part that a row belongs to, by run, setpoint or --by; or none
  std::string parted_by;          ///< headers that tell the parts; "": none does
  std::vector<std::string> setpoints;  ///< of each row; or none
  std::vector<int> line;
  std::vector<std::string> notes;  ///< sentences on what was left aside and dropped
};

/// Reads a log: columns as a campaign has them, under their canonical names, those that a campaign declares, or a
/// quantity with a unit of its own behind it ("drawbar_pull_kN"); a clock; names of parts: run, setpoint. Others are
/// left aside and told. A row that repeats the one before it, its time included, is dropped. Throws InputError with
/// file, line and column for what can't be read, a log without slip, load or a channel, and one of several wheels.
TimeLog read_time_log(const SourceText& source, const LogReading& how = {});

/// A channel's mean over the steady part of a run [SI].
struct RunMean {
  Estimate mean;           ///< by mean_with_error (scenario/mean_value.hpp): blocks of four autocorrelation times
  double sd = 0.0;         ///< of single samples
  double effective = 0.0;  ///< independent samples that would leave the same error: (sd/error)^2, at most all
};

/// A channel whose halves differ by so many standard errors.
struct UnsteadyChannel {
  std::string_view title;
  double errors = 0.0;
};

/// A run made of samples.
struct LoggedRun {
  Run run;
  int first_line = 0, last_line = 0;
  std::size_t samples = 0, cut_before = 0, cut_after = 0;  ///< all; those cut off at both ends as transients
  std::array<std::optional<RunMean>, 4> channels;          ///< in the order of traction_channels
  std::vector<UnsteadyChannel> unsteady;
};

/// Samples that make no run.
struct LeftOut {
  int first_line = 0, last_line = 0;
  std::size_t samples = 0;
  std::string why;
};

struct LogRuns {
  std::vector<LoggedRun> runs;
  std::vector<LeftOut> left_out;
  std::string parted_by;           ///< headers whose changes part the runs; "": slip, load and other conditions do
  bool has_clock = false;          ///< its breaks part runs, too
  std::size_t periods = 0;         ///< unbroken ones of the clock that hold the runs
  std::vector<std::string> notes;  ///< sentences on the log
};

/// Fewest samples of a run, and of its steady part (chosen).
inline constexpr std::size_t fewest_samples = 8;

/// A run ends where a named part ends, where the clock goes back or stands still for more than ten steps, and, where
/// nothing names the parts, where slip, load or another condition changes (stretches.hpp). Of each, the transients at
/// both ends are cut off: by the latest of the MSER-5 cuts of all columns, where the samples cut off
/// differ from the rest by more than three standard errors and, of few samples, by three standard deviations;
/// none where half of the run or more would go. A run whose conditions go on changing is a ramp and is left out; one
/// whose channel's halves differ by more than four standard errors is doubted. Runs at like conditions share a
/// setpoint. Throws InputError where no run is left.
LogRuns runs_of_log(const TimeLog& log);

/// The runs as the CSV of a campaign, with each channel's standard deviation in time and error of the mean; numbers to
/// six digits, under the names and in the units of `named`.
std::string runs_csv(const LogRuns& made, const std::map<std::string, DataColumn>& named = {});

}  // namespace soilbin::compare
