// A case's wheel driven in time by the analytic model: run, then as sentences, JSON, CSV, plots and an HTML page.
#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "bekker_wong/transient/driving.hpp"
#include "compare/drives/drive_errors.hpp"
#include "compare/report/page.hpp"
#include "compare/report/plot.hpp"
#include "compare/report/table.hpp"
#include "scenario/case.hpp"

namespace soilbin::compare {

/// A case's drive and what came of it.
struct AnalyticDrive {
  Case question;
  bekker_wong::DriveRecord record;
  std::optional<double> steepest;  ///< slope that the wheel climbs in a steady state at the soil, the cross slope and
                                   ///< the yaw of the start [rad]
  DriveErrors errors;
};

/// Runs the drive of a case, and again for its errors, on so many threads. Throws InputError where the case has none,
/// and what drive_wheel throws.
AnalyticDrive run_drive(const Case& question, int samples, const bekker_wong::DriveProgress& progress = {},
                        int threads = 1);

/// How it ended and where the work went, in sentences.
std::vector<std::string> in_words(const AnalyticDrive& part);

/// What is doubtful in a drive (compare/doubts/doubts.hpp): its wheel and soil, how deep it sank on its way, what
/// changes nothing.
std::vector<std::string> doubts(const AnalyticDrive& part);

/// Where a table of work stands: on a page, under its caption; in text, where its header says what it is of.
enum class WorkTable { on_page, in_text };

/// Where the motor's work went: a name, its share in J and in percent; what is unaccounted for, then all of it, last.
/// Of a wheel that came down or braked: where the work of motor and gravity went, and how much each put in.
Table energy_table(const bekker_wong::EnergyLedger& energy, WorkTable where);

/// So many of the samples, evenly, the first and the last among them.
Table samples_table(const bekker_wong::DriveRecord& record, std::size_t rows);

/// Speeds, slip, sinkage, torque, forces along travel and energy against time.
Sheet drive_sheet(const AnalyticDrive& part);

/// soilbin-drive/1, in SI.
nlohmann::ordered_json to_json(const AnalyticDrive& part);

/// A line a sample: time, way, speeds, slips, sinkage, torque, forces, slope, energies; SI, angles in degrees.
std::string drive_csv(const AnalyticDrive& part);

std::string drive_page(const AnalyticDrive& part, const PageAbout& about);

}  // namespace soilbin::compare
