// Answers as they are told, one function each; those of several kinds of question have headers of their own beside this
// one. What a report is made of outlives it.
//
//   const Report report = report_on(prediction, campaign, scenario, "the declared soil and not fitted");
//   fmt::print("{}", text_of(report));
#pragma once

#include <map>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "compare/doubts/doubt.hpp"
#include "compare/report/report.hpp"

namespace soilbin {
struct Case;
struct Scenario;
struct Soil;
}  // namespace soilbin

namespace soilbin::cone_index {
struct Mobility;
}

namespace soilbin::dem {
struct AngleOfReposeResult;
struct AnnulusRun;
struct DirectShearResult;
struct DrawnWheel;
struct ConeRun;
struct PlateRun;
struct TiltingBoardResult;
struct VerificationRow;
struct TriaxialResult;
}  // namespace soilbin::dem

namespace soilbin::compare {

struct AnalyticDrive;
struct BevameterFit;
struct BevameterReadings;
struct Campaign;
struct CompiledC;
struct CompressionCurve;
struct DataColumn;
struct DrivenAnswers;
struct DriveSides;
struct FailureMapResult;
struct ForceTable;
struct Finding;
struct GoMap;
struct LogRuns;
struct MeasuredAnswers;
template <class Test>
struct MeasuredBeside;
struct MeasuredPlate;
struct MeasuredPlatesFit;
struct NotDecided;
struct PlateGroups;
struct MeasuredShear;
struct MeasuredShearFit;
struct ModelAnswers;
struct Prediction;
struct Reproduction;
struct SlipMap;
struct TestDesign;
struct TurnAnswers;
struct VehicleAnswers;
struct WheelFmu;
struct WheelLimits;
struct WheelSlipFit;

/// What the ± of an answer holds: which values of the soil have standard deviations of their own, which assumed ones,
/// which count as exact, and whether a fit says how they err together. For the first lines of an answer; "" for a soil
/// of grains alone.
std::string errors_in_words(const Scenario& asked);
/// errors_in_words of a question, as its first model sees it.
std::string errors_in_words(const Case& question);

/// What a wheel can do at best: of each answer a table over the slopes and what the steepest one is. `at_limits`:
/// answers_at_limits of the answers, to which each row's remark belongs.
Report report_on(const Case& question, const std::vector<WheelLimits>& answers,
                 const std::vector<ModelAnswers>& at_limits);
/// Rows of soilbin-limits/1.
nlohmann::ordered_json limits_rows(const std::vector<WheelLimits>& answers);

/// A campaign beside its prediction: each run as measured and as predicted, then how far off each channel is;
/// soilbin-predict/1. `soil_from`: where the soil and the effects of the scenario asked come from, "the declared soil
/// and not fitted".
Report report_on(const Prediction& prediction, const Campaign& campaign, const Scenario& asked,
                 const std::string& soil_from);

/// The runs found in a rig's time log: each one's lines, setpoint and means, what was left out, how means are made; the
/// CSV is a campaign's runs.csv under the names and in the units of `named`; soilbin-runs/1. `file`: the log's name.
Report report_on(const LogRuns& made, const std::string& file, const std::map<std::string, DataColumn>& named);

/// How far off a prediction is, a row a channel; `header` names the columns.
Table channel_errors_table(const Prediction& prediction, std::string caption, std::vector<std::string> header);

/// A drive of the analytic wheel: how it ended and where the work went; soilbin-drive/1.
Report report_on(const AnalyticDrive& drive);
/// Drives of both models: how each ended, then what differs at the end that both reach steadily;
/// soilbin-drive-sides/1.
Report report_on(const DriveSides& drive);

/// Whether a vehicle gets through, what it needs and by which parts, which sources were taken; soilbin-mobility/1.
/// `soil`: the name of the one that the rating cone index is of; "" where it was given.
Report report_on(const cone_index::Mobility& mobility, const std::string& soil);

/// A vehicle on a soil: whether it travels, how steep, each wheel, power, pull against slip; soilbin-vehicle-answer/1.
/// `open`: not_decided of the answers; then the verdict begins with it. By itself: as if nothing left it open.
Report report_on(const VehicleAnswers& answers, const std::optional<NotDecided>& open);
Report report_on(const VehicleAnswers& answers);
Report report_on(const TurnAnswers& answers);
/// A vehicle beside what was measured of it at slips of its drive line; soilbin-vehicle-measured/1.
Report report_on(const MeasuredAnswers& answers);
/// A vehicle driven in time: how it ended and which axle gave out; soilbin-vehicle-drive/1.
Report report_on(const DrivenAnswers& answers);
/// A row for each slope and heading.
std::string csv_of(const GoMap& map);
/// Slopes upward, headings to the right, blue where it goes on more than half of the soils.
std::string svg_of(const GoMap& map);

/// Runs to make before any is made: what they are expected to tell, the runs, each effect with what it is most easily
/// taken for; the CSV is the campaign's rows to fill in; soilbin-design/1.
Report report_on(const TestDesign& design);

/// A table of forces for other programs: its axes, and how far its interpolation lies from the model;
/// soilbin-force-table/1.
Report report_on(const ForceTable& table);

/// A wheel as Gazebo's plugin WheelSlip has it: two lines fitted to the model's curves; soilbin-wheel-slip/1.
Report report_on(const WheelSlipFit& fit);
/// The wheel with its map of soils: each one's colour, what the plugins have there, what the map can't say; with the
/// key `map`. `file`: of the map, for the SDF.
Report report_on(const WheelSlipFit& fit, const SlipMap& map, const std::string& file);

/// A driven wheel as a unit of FMI 2.0: its table and that one's errors, its variables, whether it was compiled;
/// soilbin-fmu/1.
Report report_on(const WheelFmu& fmu, const CompiledC& compiled);

/// A soil as Chrono's SCM terrain reads it (scenario/scm_soil.hpp): its values with their units, what is chosen, which
/// of our effects SCM lacks. The data are SCM's file; `version`: of soilbin.
Report report_on_scm(const Soil& soil, const std::string& version);

/// What measured plate tests gave: the values with the parts of their errors, each plate by itself, what was set aside,
/// and the lines that a campaign or a soil file takes; readings and Bekker's form drawn; soilbin-plates/1. `file`: name
/// of the readings' file.
Report report_on(const MeasuredPlatesFit& fit, std::span<const MeasuredPlate> plates, const std::string& file);

/// What plate tests gave that were fitted apart by a column: a row a group, how n and the pressure go with the density,
/// and a soil file's lines at the density that was asked for; soilbin-plate-groups/1. `file`: name of the readings'
/// file.
Report report_on(const PlateGroups& groups, const std::string& file);

/// What measured shear tests gave: c, phi and K, each test by itself, and the lines that a campaign or a soil file
/// takes; readings and Janosi's curves drawn; soilbin-shear/1. `file`: name of the readings' file.
Report report_on(const MeasuredShearFit& fit, std::span<const MeasuredShear> tests, const std::string& file);

/// What a virtual bevameter found in a soil's grains: the values of the fit beside those of the soil's file, and what
/// the fit leaves; curves as points, the fit as lines; soilbin-bevameter/1.
Report report_on(const BevameterFit& fit, const BevameterReadings& readings, const Soil& soil, int packings);

/// Element tests: their runs, what they give, curves; soilbin-element-test/1. `soil`: the name of the soil whose grains
/// were tested. A list: a run a packing, or packing by packing; one at least. `beside`: measured tests, where there
/// are.
Report report_on(const dem::DirectShearResult& result, const std::string& soil);
Report report_on(const dem::TriaxialResult& result, const std::string& soil,
                 const MeasuredBeside<CompressionCurve>& beside);
Report report_on(const std::vector<dem::TiltingBoardResult>& boards, const std::string& soil);
Report report_on(const std::vector<dem::AngleOfReposeResult>& heaps, const std::string& soil);
Report report_on(const std::vector<dem::PlateRun>& runs, const std::string& soil,
                 const MeasuredBeside<MeasuredPlate>& beside);
/// `grain`: mean diameter of the soil's grains [m].
Report report_on(const std::vector<dem::ConeRun>& runs, const std::string& soil, double grain);
Report report_on(const std::vector<dem::AnnulusRun>& runs, const std::string& soil);

/// The engine's verification against published numbers and closed forms, a row each; soilbin-verify/1.
Report report_on(std::span<const dem::VerificationRow> rows);

/// What was found in a drawing of a wheel and what was mended in it (docs/guide/bring-a-tire.md): triangles, bodies,
/// unit, axle, size and volume, and each change; drawn from the side and from the front; soilbin-mesh/1. `file`: its
/// name.
Report report_on(const dem::DrawnWheel& wheel, const std::string& file);

/// What is told beside a failure map.
struct FailureMapAbout {
  std::string name;             ///< "Failure map: longitudinal"
  std::string resolved_case{};  ///< of the study whose wheel, soil and bin these are, as YAML
  bool show_rows = false;       ///< on a terminal; a page has them folded
};
/// Where the quick estimate may be trusted, where not and to which side it errs, how sure that is; the map at the lugs
/// and slip that a reader sets; soilbin-failure-map/1.
Report report_on(const FailureMapResult& result, const FailureMapAbout& about);

/// What a finding asks: "slope of drawbar pull along load, at slip 10 .. 60 %: at least 0".
std::string claim_in_words(const Finding& finding);
/// Conclusion and findings against models; folded each finding with its words, figure and intervals;
/// soilbin-reproduction/1.
Report report_on(const Reproduction& reproduction);

}  // namespace soilbin::compare
