// What a calibration found, and what the soil bin decided between its candidates: as sentences, tables, JSON, and as a
// soil that other commands take.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "compare/calibrate/calibration.hpp"
#include "compare/calibrate/contact_values.hpp"
#include "compare/calibrate/published_sets.hpp"
#include "compare/report/report.hpp"
#include "scenario/soil.hpp"

namespace soilbin::compare {

/// The verdict, then what the design, the candidates and the targets say. One string a sentence.
std::vector<std::string> calibration_sentences(const VirtualTest& test, const CalibrationOptions& options,
                                               const Calibration& calibration);

/// Range analysis and analysis of variance of one target: a row a factor with k_i, R, sum of squares, F and p.
Table level_table(const VirtualTest& test, const Calibration& calibration, std::size_t target);
/// Every run: stage, values, results.
Table runs_table(const VirtualTest& test, const Calibration& calibration);
/// Candidates: values, what is predicted of them, chi square, chance.
Table candidates_table(const VirtualTest& test, const Calibration& calibration);

/// The sentences, what each factor does, the candidates, the runs: on a terminal these last where `with_runs`. All
/// outlive the report.
Report report_on(const VirtualTest& test, const CalibrationOptions& options, const Calibration& calibration,
                 bool with_runs);

/// Published sets: values, what was published, ours, what was measured.
Table beside_table(const VirtualTest& test, const std::vector<PublishedSet>& sets);

/// soilbin-calibration/1, all in SI.
nlohmann::ordered_json to_json(const VirtualTest& test, const CalibrationOptions& options,
                               const Calibration& calibration);

/// The soil with the calibrated values in this contact; each names, as its source, the test, what it reached, and how
/// well the targets determine the value. Factors are named as the contact's numbers.
Soil calibrated_soil(Soil soil, ContactKind kind, const VirtualTest& test, const CalibrationOptions& options,
                     const Calibration& calibration);

/// The soil bin's verdict, the candidates that it can't tell apart, and what the errors don't hold. One string a
/// sentence.
std::vector<std::string> decision_sentences(const Decision& decision);

/// Headings and a candidate's cells: the error of each channel that was measured, of all, and the verdict.
std::vector<std::string> decision_columns(const Decision& decision);
std::vector<std::string> decision_cells(const Decision& decision, std::size_t candidate);

/// A decision, all in SI; errors as shares of the load.
nlohmann::ordered_json to_json(const Decision& decision);

}  // namespace soilbin::compare
