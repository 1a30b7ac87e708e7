// Outcomes of the element tests as they are told: their runs, what they give, curves; soilbin-element-test/1. `soil`:
// the name of the soil whose grains were tested.
#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "compare/experiments/compression_curves.hpp"
#include "compare/experiments/plate_curves.hpp"
#include "compare/report/json_fields.hpp"
#include "compare/report/number_text.hpp"
#include "compare/telling/reports.hpp"
#include "dem/element_tests/angle_of_repose.hpp"
#include "dem/element_tests/bevameter_tests.hpp"
#include "dem/element_tests/direct_shear.hpp"
#include "dem/element_tests/tilting_board.hpp"
#include "dem/element_tests/triaxial.hpp"
#include "scenario/mean_value.hpp"
#include "scenario/unit.hpp"

namespace soilbin::compare {
namespace {

Json json_of(const dem::StrengthLine& line) {
  if (line.points == 0) return nullptr;
  return {{"friction_angle", estimate_json(line.friction_angle)},
          {"cohesion", estimate_json(line.cohesion)},
          {"covariance", line.covariance},
          {"chi2", line.chi2},
          {"points", line.points},
          {"friction_angle_without_cohesion", estimate_json(line.friction_angle_without_cohesion)}};
}

/// The angle behind a ratio's tangent or sine.
Estimate angle_of_tangent(const Estimate& ratio) {
  return {std::atan(ratio.value), ratio.std_error / (1 + ratio.value * ratio.value)};
}
Estimate angle_of_sine(const Estimate& sine) {
  return {std::asin(sine.value), sine.std_error / std::sqrt(1 - sine.value * sine.value)};
}

std::string degrees(const Estimate& angle) { return number(angle, 1 / degree); }

std::string line_text(const char* name, const dem::StrengthLine& line) {
  if (line.points == 0) return "";
  return fmt::format("{}: phi {} deg, c {} kPa; without cohesion phi {} deg", name, degrees(line.friction_angle),
                     number(line.cohesion, 1e-3), degrees(line.friction_angle_without_cohesion));
}

/// A stress that was held to more than 1 %: which, of which run, and what to do; "" where it was held.
std::string held_text(const char* name, double stress, std::uint64_t packing, double error) {
  if (error <= 0.01) return "";
  return fmt::format(
      "The {} of {} kPa (specimen {}) was held to {} %, not to 1 %: a slower test holds it (--inertial).", name,
      number(stress / 1e3), packing, number(error * 100));
}

Json json_of(const dem::HeldStress& held) { return {{"at_peak", held.at_peak}, {"at_residual", held.at_residual}}; }

/// A column of a curve: a member, or what a function makes of a sample.
template <class Sample, class Of>
std::vector<double> column(const std::vector<Sample>& curve, const Of& of) {
  std::vector<double> out;
  for (const Sample& sample : curve) out.push_back(std::invoke(of, sample));
  return out;
}

template <class Sample>
auto times(double Sample::*member, double factor) {
  return [=](const Sample& sample) { return sample.*member * factor; };
}

template <class Curve, class X, class Y>
void add_line(Plot& plot, std::string label, const Curve& curve, const X& x, const Y& y) {
  plot.series.push_back(
      over_samples({.label = std::move(label), .color = static_cast<int>(plot.series.size())}, curve, x, y));
}

/// A measured curve, dashed.
void add_measured(Plot& plot, std::string label, const std::vector<double>& x, double x_factor,
                  const std::vector<double>& y, double y_factor) {
  Series series{.label = std::move(label), .color = static_cast<int>(plot.series.size()), .dash = 1};
  for (std::size_t k = 0; k < x.size(); ++k) series.x.push_back(x_factor * x[k]), series.y.push_back(y_factor * y[k]);
  plot.series.push_back(std::move(series));
}

/// The table of features beside those of grains, and into `values` an entry each.
Table told_beside(const std::vector<FeatureBeside>& features, Json& values) {
  Table table{"", {"feature", "unit", "measured", "grains", "off by [errors]"}};
  for (const FeatureBeside& one : features) {
    const double per_si = per_unit(one.measured.unit);
    table.add({one.measured.name, one.measured.unit, number(one.measured.measured, per_si), number(one.grains, per_si),
               number(one.off(), 2)});
    values["beside"].push_back({{"target", one.measured.name},
                                {"unit", one.measured.unit},
                                {"measured", estimate_json(one.measured.measured)},
                                {"grains", estimate_json(one.grains)}});
  }
  return table;
}

/// How near grains come to the measured tests, for the first line of an answer; "" without tests.
std::string nearness(const std::vector<FeatureBeside>& features) {
  if (features.empty()) return "";
  const auto errors_off = [](const FeatureBeside& one) { return std::abs(one.off()); };
  const auto met = std::ranges::count_if(
      features, [](double off) { return off <= met_within; }, errors_off);
  const FeatureBeside& farthest = *std::ranges::max_element(features, {}, errors_off);
  const double per_si = per_unit(farthest.measured.unit);
  return fmt::format(
      "Grains are within {} errors of the measured tests at {} of {} features; farthest off is {}: {} {} "
      "for {} measured.",
      number(met_within, 1), met, features.size(), farthest.measured.name, number(farthest.grains, per_si),
      farthest.measured.unit, number(farthest.measured.measured, per_si));
}

/// The report of a test; `table` is empty where it has one run, which the sentences tell.
Report report_of(const char* test, const std::string& soil, Table table, std::vector<std::string> sentences,
                 const Json& values, Sheet sheet) {
  Report report{sheet.title + ": " + soil, "A simulated laboratory test of the grains.",
                fmt::format("{}: {}", test, soil)};
  std::erase(sentences, "");
  if (!sentences.empty()) report.add(Sentences(sentences));
  report.add("Curves", Figure{sheet, ""});
  if (!table.rows.empty()) report.add("Runs", std::move(table));
  Json document = {{"format", "soilbin-element-test/1"}, {"test", test}, {"soil", soil}};
  document.update(values);
  report.data = [document = std::move(document)] { return document; };
  report.sheet = [sheet = std::move(sheet)] { return sheet; };
  return report;
}

}  // namespace

Report report_on(const dem::DirectShearResult& result, const std::string& soil) {
  using Sample = dem::ShearSample;
  Table table{
      "",
      {"stress [kPa]", "packing", "void ratio", "peak [deg]", "at [mm]", "residual [deg]", "held to [%]", "imbalance"}};
  std::vector<std::string> sentences{line_text("peak", result.peak), line_text("residual", result.residual)};
  Json runs = Json::array();
  Plot shear{"Shear stress over normal stress [-]", {"displacement [mm]"}};
  Plot lift{"Rise of the lid [mm]", {"displacement [mm]"}};
  for (const dem::DirectShearRun& run : result.runs) {
    table.add({number(run.stress / 1e3), std::to_string(run.packing), number(run.void_ratio),
               degrees(angle_of_tangent(run.peak)), number(run.peak_at * 1e3), degrees(angle_of_tangent(run.residual)),
               number(run.normal.error * 100), fmt::format("{:.1e}", run.imbalance)});
    sentences.push_back(held_text("normal stress", run.stress, run.packing, run.normal.error));
    runs.push_back({{"stress", run.stress},
                    {"packing", run.packing},
                    {"void_ratio", run.void_ratio},
                    {"speed", run.speed},
                    {"peak_ratio", estimate_json(run.peak)},
                    {"peak_at", run.peak_at},
                    {"residual_ratio", estimate_json(run.residual)},
                    {"normal_stress_held", json_of(run.normal)},
                    {"imbalance", run.imbalance},
                    {"work", run.work},
                    {"work_of_stress", run.work_of_stress},
                    {"energy_error", run.energy_error},
                    {"displacement", column(run.curve, &Sample::displacement)},
                    {"shear_stress", column(run.curve, &Sample::shear_stress)},
                    {"normal_stress", column(run.curve, &Sample::normal_stress)},
                    {"dilation", column(run.curve, &Sample::dilation)}});
    const auto mm = times(&Sample::displacement, 1e3);
    const std::string label = fmt::format("{} kPa, specimen {}", number(run.stress / 1e3), run.packing);
    add_line(shear, label, run.curve, mm, [](const Sample& s) { return s.shear_stress / s.normal_stress; });
    add_line(lift, label, run.curve, mm, times(&Sample::dilation, 1e3));
  }
  return report_of("direct-shear", soil, std::move(table), std::move(sentences),
                   {{"mean_diameter", result.mean_diameter},
                    {"peak", json_of(result.peak)},
                    {"residual", json_of(result.residual)},
                    {"runs", std::move(runs)}},
                   {"Direct shear", {std::move(shear), std::move(lift)}});
}

Report report_on(const dem::TriaxialResult& result, const std::string& soil,
                 const MeasuredBeside<CompressionCurve>& beside) {
  using Sample = dem::TriaxialSample;
  Table table{"",
              {"stress [kPa]", "packing", "void ratio", "peak [deg]", "at strain [%]", "dilation [deg]",
               "residual [deg]", "held to [%]"}};
  std::vector<std::string> sentences{line_text("peak", result.peak), line_text("residual", result.residual)};
  Json runs = Json::array();
  Plot stress{"(s1 - s3)/(s1 + s3) [-]", {"axial strain [%]"}};
  Plot volume{"Volumetric strain, contraction positive [%]", {"axial strain [%]"}};
  for (const dem::TriaxialRun& run : result.runs) {
    table.add({number(run.stress / 1e3), std::to_string(run.packing), number(run.void_ratio),
               degrees(angle_of_sine(run.peak)), number(run.peak_at * 100), number(run.dilation_angle / degree),
               degrees(angle_of_sine(run.residual)), number(run.confining_error * 100)});
    sentences.push_back(held_text("confining stress", run.stress, run.packing, run.confining_error));
    runs.push_back({{"stress", run.stress},
                    {"packing", run.packing},
                    {"void_ratio", run.void_ratio},
                    {"isotropic_error", run.isotropic_error},
                    {"confining_error", run.confining_error},
                    {"confining_stress_held", json_of(run.confining)},
                    {"peak_sine", estimate_json(run.peak)},
                    {"peak_at", run.peak_at},
                    {"residual_sine", estimate_json(run.residual)},
                    {"dilation_angle", run.dilation_angle},
                    {"work", run.work},
                    {"work_of_stress", run.work_of_stress},
                    {"energy_error", run.energy_error},
                    {"strain", column(run.curve, &Sample::strain)},
                    {"volumetric", column(run.curve, &Sample::volumetric)},
                    {"axial", column(run.curve, &Sample::axial)},
                    {"lateral_x", column(run.curve, &Sample::lateral_x)},
                    {"lateral_y", column(run.curve, &Sample::lateral_y)}});
    const auto percent = times(&Sample::strain, 100);
    const std::string label = fmt::format("{} kPa, specimen {}", number(run.stress / 1e3), run.packing);
    add_line(stress, label, run.curve, percent, [](const Sample& s) { return s.sine(); });
    add_line(volume, label, run.curve, percent, times(&Sample::volumetric, 100));
  }
  Json values{{"mean_diameter", result.mean_diameter},
              {"peak", json_of(result.peak)},
              {"residual", json_of(result.residual)},
              {"runs", std::move(runs)}};
  sentences.insert(sentences.begin(), nearness(beside.features));
  Table features = told_beside(beside.features, values);
  for (const CompressionCurve& test : beside.tests) {
    const std::string label = fmt::format("{}, {} kPa, measured", test.test, number(test.confining / 1e3));
    add_measured(stress, label, test.strain, 100, test.sine, 1);
    if (!test.volumetric.empty()) add_measured(volume, label, test.strain, 100, test.volumetric, 100);
  }
  Report report = report_of("triaxial", soil, std::move(table), std::move(sentences), values,
                            {"Triaxial compression", {std::move(stress), std::move(volume)}});
  if (!features.rows.empty()) report.add("Beside measured tests", std::move(features));
  return report;
}

namespace {

/// "", or behind a value what it is a mean of.
std::string of_packings(std::size_t count) { return count > 1 ? fmt::format(" (mean of {} packings)", count) : ""; }

/// A curve's name, with its packing where there are several.
std::string label_of(std::string name, std::uint64_t packing, bool several) {
  return several ? fmt::format("{}{}packing {}", name, name.empty() ? "" : ", ", packing) : name;
}

/// Means over packings of what each run gives of itself, by what was set.
struct MeanOverPackings {
  double set = 0.0;
  std::vector<Estimate> each{};
};

template <class Run>
std::vector<MeanOverPackings> means_of(const std::vector<Run>& runs, double Run::*set, double (*value)(const Run&)) {
  std::vector<MeanOverPackings> means;
  for (const Run& run : runs) {
    const auto same = [&](const MeanOverPackings& mean) { return mean.set == run.*set; };
    if (std::ranges::none_of(means, same)) means.push_back({run.*set});
    std::ranges::find_if(means, same)->each.push_back({value(run), 0.0});
  }
  return means;
}

/// A sentence and, into `json`, an entry a mean; no sentence of a single packing.
std::vector<std::string> told_means(const std::vector<MeanOverPackings>& means, const char* what, const char* unit,
                                    double per_si, const char* key, const char* value_key, Json& json) {
  std::vector<std::string> sentences;
  json = Json::array();
  for (const MeanOverPackings& mean : means) {
    const Estimate over = mean_of_repeats(mean.each);
    json.push_back({{key, mean.set}, {value_key, estimate_json(over)}, {"packings", mean.each.size()}});
    if (mean.each.size() > 1)
      sentences.push_back(fmt::format("{} {} {}: {} kPa{}", what, number(mean.set * per_si), unit, number(over, 1e-3),
                                      of_packings(mean.each.size())));
  }
  return sentences;
}

double pressure_at_end(const dem::PlateRun& run) { return run.curve.back().pressure; }

/// Mean over the last fifth of the way.
double shear_at_end(const dem::AnnulusRun& run) {
  const std::size_t tail = std::max<std::size_t>(1, run.curve.size() / 5);
  double mean = 0;
  for (std::size_t k = run.curve.size() - tail; k < run.curve.size(); ++k)
    mean += run.curve[k].shear_stress / static_cast<double>(tail);
  return mean;
}

}  // namespace

Report report_on(const std::vector<dem::TiltingBoardResult>& boards, const std::string& soil) {
  using Board = dem::TiltingBoardResult;
  using Sample = dem::TiltSample;
  const Board& first = boards.front();
  Table table{"", {"packing", "grains", "begins to slide at [deg]", "slid by a grain at [deg]"}};
  Plot plot{"Mean slide [mm]", {"tilt [deg]"}};
  std::vector<Estimate> onsets, gones;
  std::size_t slid = 0;
  Json runs = Json::array();
  for (const Board& board : boards) {
    slid += board.slid ? 1 : 0;
    onsets.push_back({board.onset, 0.0}), gones.push_back({board.gone, 0.0});
    const std::string at = number(board.onset / degree);
    table.add({std::to_string(board.packing), std::to_string(board.grains), board.slid ? at : "held up to " + at,
               board.slid ? number(board.gone / degree) : "-"});
    runs.push_back({{"packing", board.packing}, {"slid", board.slid}, {"onset", board.onset}, {"gone", board.gone}});
    add_line(
        plot, label_of("", board.packing, boards.size() > 1), board.curve,
        [](const Sample& s) { return s.angle / degree; }, times(&Sample::slide, 1e3));
  }
  const Estimate onset = mean_of_repeats(onsets), gone = mean_of_repeats(gones);
  std::string told = fmt::format("{} grains begin to slide at {} deg; slid by a grain at {} deg{}", first.grains,
                                 degrees(onset), degrees(gone), of_packings(boards.size()));
  if (slid == 0)
    told = fmt::format("{} grains held up to {} deg{}", first.grains, number(onset.value / degree),
                       boards.size() > 1 ? fmt::format(" in {} packings", boards.size()) : "");
  else if (slid < boards.size())
    told += fmt::format(". {} of them held up to the steepest tilt, so the angles are larger than that",
                        boards.size() - slid);
  return report_of("tilting-board", soil, boards.size() > 1 ? std::move(table) : Table{}, {told},
                   {{"mean_diameter", first.mean_diameter},
                    {"grains", first.grains},
                    {"slid", slid == boards.size()},
                    {"onset", onset.value},
                    {"gone", gone.value},
                    {"onset_error", onset.std_error},
                    {"gone_error", gone.std_error},
                    {"angle", column(first.curve, &Sample::angle)},
                    {"slide", column(first.curve, &Sample::slide)},
                    {"runs", std::move(runs)}},
                   {"Tilting board", {std::move(plot)}});
}

Report report_on(const std::vector<dem::AngleOfReposeResult>& heaps, const std::string& soil) {
  using Heap = dem::AngleOfReposeResult;
  using Ring = dem::HeapProfile;
  const Heap& first = heaps.front();
  const auto in_grains = [](const Heap& heap) { return heap.height / heap.mean_diameter; };
  Table table{"", {"packing", "grains", "angle [deg]", "height [grains]", "radius [mm]", "at rest after [s]"}};
  Plot plot{"Height [mm]", {"distance from the axis [mm]"}};
  std::vector<Estimate> angles, heights, bases;
  Json runs = Json::array();
  for (const Heap& heap : heaps) {
    angles.push_back(heap.angle), heights.push_back({in_grains(heap), 0.0}), bases.push_back({heap.base, 0.0});
    table.add({std::to_string(heap.packing), std::to_string(heap.grains), degrees(heap.angle), number(in_grains(heap)),
               number(heap.base * 1e3), number(heap.settling_time)});
    runs.push_back({{"packing", heap.packing},
                    {"angle", estimate_json(heap.angle)},
                    {"grains", heap.grains},
                    {"height", heap.height},
                    {"base", heap.base}});
    add_line(plot, label_of("", heap.packing, heaps.size() > 1), heap.profile, times(&Ring::radius, 1e3),
             times(&Ring::height, 1e3));
  }
  const Estimate angle = mean_of_repeats(angles), height = mean_of_repeats(heights);
  std::vector<std::string> sentences{fmt::format(
      "angle of repose {} deg{}: {} grains, heap {} grains high, {} mm in radius", degrees(angle),
      of_packings(heaps.size()), first.grains, number(height.value, 3), number(mean_of_repeats(bases).value * 1e3))};
  if (heaps.size() == 1)
    sentences.emplace_back("The ± is by the sectors of one heap: packings differ by more (--packings 3).");
  if (height.value < dem::lowest_heap)
    sentences.push_back(fmt::format(
        "The heap is lower than {:g} grains: its slope comes out too small (--size, as a multiple of the default).",
        dem::lowest_heap));
  return report_of("repose", soil, heaps.size() > 1 ? std::move(table) : Table{}, std::move(sentences),
                   {{"mean_diameter", first.mean_diameter},
                    {"angle", estimate_json(angle)},
                    {"by_sector", first.by_sector},
                    {"grains", first.grains},
                    {"height", first.height},
                    {"base", first.base},
                    {"lift_speed", first.lift_speed},
                    {"radius", column(first.profile, &Ring::radius)},
                    {"profile", column(first.profile, &Ring::height)},
                    {"height_in_grains", height.value},
                    {"runs", std::move(runs)}},
                   {"Angle of repose", {std::move(plot)}});
}

Report report_on(const std::vector<dem::PlateRun>& runs, const std::string& soil,
                 const MeasuredBeside<MeasuredPlate>& beside) {
  using Sample = dem::PlateSample;
  const bool several = runs.front().packing != runs.back().packing;
  Table table{"", {"plate [mm]", "packing", "grains", "void ratio", "sinkage [mm]", "pressure there [kPa]"}};
  Json all = Json::array(), means;
  Plot plot{"Pressure [kPa]", {"sinkage [mm]"}};
  for (const dem::PlateRun& run : runs) {
    const Sample& last = run.curve.back();
    table.add({number(run.diameter * 1e3), std::to_string(run.packing), std::to_string(run.grains),
               number(run.void_ratio), number(last.sinkage * 1e3), number(last.pressure / 1e3)});
    all.push_back({{"diameter", run.diameter},
                   {"packing", run.packing},
                   {"void_ratio", run.void_ratio},
                   {"bulk_density", run.density},
                   {"speed", run.speed},
                   {"sinkage", column(run.curve, &Sample::sinkage)},
                   {"pressure", column(run.curve, &Sample::pressure)}});
    const double from = beside.tests.empty() ? 0.0 : run.seat();
    const auto sinkage = [=](const Sample& s) { return (s.sinkage - from) * 1e3; };
    add_line(plot, label_of(fmt::format("{} mm", number(run.diameter * 1e3)), run.packing, several), run.curve, sinkage,
             [](const Sample& s) { return s.pressure / 1e3; });
  }
  std::vector<std::string> sentences = told_means(means_of(runs, &dem::PlateRun::diameter, pressure_at_end),
                                                  "At the deepest, plate of", "mm", 1e3, "diameter", "pressure", means);
  Json values{{"runs", std::move(all)}, {"at_end", std::move(means)}};
  sentences.insert(sentences.begin(), nearness(beside.features));
  Table features = told_beside(beside.features, values);
  for (const MeasuredPlate& test : beside.tests)
    add_measured(plot, test.test + ", measured", test.curve.sinkage, 1e3, test.curve.pressure, 1e-3);
  Report report =
      report_of("plate", soil, std::move(table), std::move(sentences), values, {"Plate sinkage", {std::move(plot)}});
  if (features.rows.empty()) return report;
  report.add("Beside measured tests", std::move(features));
  report.add(Sentences(std::vector<std::string>{
      "There and in the figure sinkage counts from the plate's seat, where it first bears 1 kPa; in the runs from the "
      "mean height of the surface."}));
  return report;
}

Report report_on(const std::vector<dem::ConeRun>& runs, const std::string& soil, double grain) {
  using Sample = dem::PlateSample;
  Table table{"", {"packing", "grains", "void ratio", "cone index [kPa]", "gradient [MN/m^3]"}};
  Json all = Json::array();
  Plot plot{"Cone resistance [kPa]", {"depth [mm]"}};
  std::vector<Estimate> indices, gradients;
  for (const dem::ConeRun& run : runs) {
    const dem::PlateRun& pressed = run.pressed;
    indices.push_back({run.index, 0.0}), gradients.push_back({run.gradient, 0.0});
    table.add({std::to_string(pressed.packing), std::to_string(pressed.grains), number(pressed.void_ratio),
               number(run.index / 1e3), number(run.gradient / 1e6)});
    all.push_back({{"packing", pressed.packing},
                   {"void_ratio", pressed.void_ratio},
                   {"bulk_density", pressed.density},
                   {"speed", pressed.speed},
                   {"index", run.index},
                   {"gradient", run.gradient},
                   {"depth", column(pressed.curve, &Sample::sinkage)},
                   {"resistance", column(pressed.curve, &Sample::pressure)}});
    add_line(plot, label_of("", pressed.packing, runs.size() > 1), pressed.curve, times(&Sample::sinkage, 1e3),
             times(&Sample::pressure, 1e-3));
  }
  const double diameter = runs.front().pressed.diameter, depth = runs.front().pressed.curve.back().sinkage;
  const Estimate index = mean_of_repeats(indices), gradient = mean_of_repeats(gradients);
  std::vector<std::string> sentences{
      fmt::format("A cone of {} mm, {} grains wide, from the surface to {} mm: cone index {} kPa, which grows by {} "
                  "MN/m^3{}",
                  number(diameter * 1e3), number(diameter / grain, 3), number(depth * 1e3), number(index, 1e-3),
                  number(gradient, 1e-6), of_packings(runs.size())),
      "A field's cone is narrower (20.3 or 12.8 mm) and stands on far more grains. The growth with depth is what "
      "Turnage's relation asks for (a soil's cone_index_gradient); the index itself grows with the cone's width."};
  return report_of("cone", soil, runs.size() > 1 ? std::move(table) : Table{}, std::move(sentences),
                   {{"diameter", diameter},
                    {"diameter_in_grains", diameter / grain},
                    {"index", estimate_json(index)},
                    {"gradient", estimate_json(gradient)},
                    {"runs", std::move(all)}},
                   {"Cone penetration", {std::move(plot)}});
}

Report report_on(const std::vector<dem::AnnulusRun>& runs, const std::string& soil) {
  using Sample = dem::AnnulusSample;
  const bool several = runs.front().packing != runs.back().packing;
  Table table{"", {"stress [kPa]", "packing", "shear stress at the end [kPa]", "sinkage [mm]"}};
  Json all = Json::array(), means;
  Plot plot{"Shear stress [kPa]", {"displacement [mm]"}};
  for (const dem::AnnulusRun& run : runs) {
    table.add({number(run.stress / 1e3), std::to_string(run.packing), number(shear_at_end(run) / 1e3),
               number(run.curve.back().sinkage * 1e3)});
    all.push_back({{"stress", run.stress},
                   {"packing", run.packing},
                   {"speed", run.speed},
                   {"displacement", column(run.curve, &Sample::displacement)},
                   {"shear_stress", column(run.curve, &Sample::shear_stress)},
                   {"normal_stress", column(run.curve, &Sample::normal_stress)},
                   {"sinkage", column(run.curve, &Sample::sinkage)}});
    add_line(plot, label_of(fmt::format("{} kPa", number(run.stress / 1e3)), run.packing, several), run.curve,
             times(&Sample::displacement, 1e3), [](const Sample& s) { return s.shear_stress / 1e3; });
  }
  std::vector<std::string> sentences =
      told_means(means_of(runs, &dem::AnnulusRun::stress, shear_at_end), "Shear stress at the end, under", "kPa", 1e-3,
                 "stress", "shear_stress", means);
  return report_of("shear", soil, std::move(table), std::move(sentences),
                   {{"runs", std::move(all)}, {"at_end", std::move(means)}}, {"Ring with grousers", {std::move(plot)}});
}

}  // namespace soilbin::compare
