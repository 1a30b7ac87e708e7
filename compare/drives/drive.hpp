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
#include "scenario/case.hpp"

namespace soilbin::compare {

/// A case's drive and what came of it.
struct DrivePart {
  Case question;
  bekker_wong::DriveRecord record;
  std::optional<double> steepest;  ///< slope that the wheel climbs in a steady state at the soil of the start [rad]
  DriveErrors errors;
};

/// Runs the drive of a case, and again for its errors, on so many threads. Throws InputError where the case has none,
/// and what drive_wheel throws.
DrivePart run_drive(const Case& question, int samples, const bekker_wong::DriveProgress& progress = {},
                    int threads = 1);

/// How it ended and where the work went, in sentences.
std::vector<std::string> in_words(const DrivePart& part);

/// What is doubtful in a drive (compare/doubts/doubts.hpp): its wheel and soil, how deep it sank on its way, what
/// changes nothing.
std::vector<std::string> doubts(const DrivePart& part);

/// Where the motor's work went: a name and its share in J, the rest last.
std::vector<std::pair<std::string, double>> energy_rows(const bekker_wong::EnergyLedger& energy);

/// Speeds, slip, sinkage, torque, forces along travel and energy against time.
Sheet drive_sheet(const DrivePart& part);

/// soilbin-drive/1, in SI.
nlohmann::ordered_json to_json(const DrivePart& part);

/// A line a sample: time, way, speeds, slips, sinkage, torque, forces, slope, energies; SI, angles in degrees.
std::string drive_csv(const DrivePart& part);

std::string drive_page(const DrivePart& part, const PageAbout& about);

}  // namespace soilbin::compare
