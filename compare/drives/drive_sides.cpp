#include "compare/drives/drive_sides.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "compare/doubts/doubts.hpp"
#include "compare/recorded/recorded_model.hpp"
#include "scenario/drive_way.hpp"

namespace soilbin::compare {
namespace {

using bekker_wong::DriveRecord;
using Steady = std::optional<dem::SteadyDrive>;

/// Why the end of an analytic drive is not a steady state, or nothing: the setpoint and the way have stopped changing,
/// and so has the speed, to a thousandth over the last twentieth of the time.
std::string unsteady(const DriveRecord& record, const Drive& drive) {
  constexpr double same = 1e-3, part = 0.05;
  const DriveState& end = record.samples.back();
  if (record.end != DriveEnd::time_is_up && record.end != DriveEnd::arrived)
    return fmt::format("the wheel is {}", word_of(record.end));
  const double last_place = drive.profile.empty() ? 0.0 : drive.profile.back().at;
  const double since = record.end_time * (1 - part);
  for (const DriveState& s : record.samples) {
    if (s.time < since) continue;
    if (s.time < drive.controller.ramp || s.travelled < last_place || !s.slip ||
        std::abs(s.speed - end.speed) > same * std::abs(end.speed))
      return "it ended before its speed had stopped changing";
  }
  return "";
}

dem::SteadyDrive values_at(const DriveState& end) {
  dem::SteadyDrive steady;
  steady.from = steady.to = end.time;
  steady.speed.value = end.speed, steady.rim_speed.value = end.rim_speed, steady.slip.value = end.slip.value_or(0.0);
  steady.sinkage.value = end.sinkage, steady.torque.value = end.torque, steady.forward.value = end.forward;
  steady.steady = true;
  return steady;
}

/// Adds the errors of uncertain values, from the drives with one of them moved that have a steady state. Gives the
/// titles of those that are left out, where neither side has one.
std::vector<std::string> add_errors(dem::SteadyDrive& steady, const AnalyticDrive& part) {
  const std::vector<MovedDrive>& moved = part.errors.moved;
  std::vector<std::string> left_out;
  Eigen::MatrixXd changes = Eigen::MatrixXd::Zero(static_cast<Eigen::Index>(moved.size()),
                                                  static_cast<Eigen::Index>(std::size(steady_values)));
  for (std::size_t i = 0; i < moved.size(); ++i)
    for (std::size_t k = 0; k < std::size(steady_values); ++k) {
      const auto member = steady_values[k].value;
      const auto by = change(moved[i], (steady.*member).value, [&](const DriveRecord& record) -> std::optional<double> {
        if (!unsteady(record, *part.question.drive).empty()) return std::nullopt;
        return (values_at(record.samples.back()).*member).value;
      });
      if (by)
        changes(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(k)) = *by;
      else if (k == 0)  // it has a steady state or not, for all values
        left_out.push_back(moved[i].title);
    }
  for (std::size_t k = 0; k < std::size(steady_values); ++k)
    (steady.*steady_values[k].value).std_error = part.errors.standard_error(changes.col(static_cast<Eigen::Index>(k)));
  return left_out;
}

DriveSideSample side_sample(const auto& sample, double soil) {
  DriveSideSample out{static_cast<const DriveState&>(sample), {}, soil};
  out.energy = sample.energy;
  return out;
}

std::vector<Estimate> on_each_packing(const std::vector<const DriveSide*>& grains, const auto& value) {
  std::vector<Estimate> values;
  for (const DriveSide* side : grains) values.push_back(value(*side));
  return values;
}

std::vector<DriveDifference> differences_of(const Steady& analytic, const DriveSides& drive) {
  constexpr double known = std::numeric_limits<double>::infinity();
  std::vector<DriveDifference> rows;
  const Steady grains = steady_of_grains(drive);
  if (!analytic || !grains) return rows;
  const auto packings = grain_sides(drive);
  for (const SteadyValue& value : steady_values) {
    DriveDifference row{value.name, value.unit, value.per_si, (*analytic).*value.value, (*grains).*value.value};
    row.difference = row.analytic.value - row.grains.value;
    row.std_error = std::hypot(row.analytic.std_error, row.grains.std_error);
    const auto values = on_each_packing(packings, [&](const DriveSide& side) { return (*side.steady).*value.value; });
    row.finding =
        finding_of(row.difference, row.std_error, row.grains.std_error,
                   joined_freedom(row.analytic.std_error, known, row.grains.std_error, freedom_over_packings(values)));
    rows.push_back(row);
  }
  return rows;
}

Estimate over_packings_of(const std::vector<const DriveSide*>& grains, const auto& value) {
  return mean_over_packings(on_each_packing(grains, value));
}

Steady steady_over_packings(const std::vector<const DriveSide*>& grains) {
  if (!std::ranges::all_of(grains, [](const DriveSide* side) { return side->steady.has_value(); })) return std::nullopt;
  dem::SteadyDrive mean = *grains.front()->steady;
  for (const DriveSide* side : grains) {
    const dem::SteadyDrive& one = *side->steady;
    mean.from = std::min(mean.from, one.from), mean.to = std::max(mean.to, one.to);
    mean.drift = std::max(mean.drift, one.drift), mean.steady = mean.steady && one.steady;
  }
  for (Estimate dem::SteadyDrive::*value :
       {&dem::SteadyDrive::speed, &dem::SteadyDrive::rim_speed, &dem::SteadyDrive::slip, &dem::SteadyDrive::sinkage,
        &dem::SteadyDrive::torque, &dem::SteadyDrive::forward})
    mean.*value = over_packings_of(grains, [&](const DriveSide& side) { return (*side.steady).*value; });
  return mean;
}

DriveOverPackings as_one(const std::vector<const DriveSide*>& grains) {
  DriveOverPackings one;
  for (const DriveSide* side : grains) one.ends.push_back(side->end);
  one.end_time = over_packings_of(grains, [](const DriveSide& side) { return Estimate{side.end_time}; });
  one.travelled =
      over_packings_of(grains, [](const DriveSide& side) { return Estimate{side.samples.back().travelled}; });
  one.steady = steady_over_packings(grains);
  return one;
}

}  // namespace

std::vector<const DriveSide*> grain_sides(const DriveSides& drive) {
  std::vector<const DriveSide*> grains;
  for (const DriveSide& side : drive.sides)
    if (side.kind == SideKind::grains) grains.push_back(&side);
  return grains;
}

DriveSide analytic_side(const AnalyticDrive& part) {
  const DriveRecord& record = part.record;
  DriveSide side{SideKind::analytic, "bekker_wong", {}, record.end, record.end_time, {}, record.happenings};
  for (const bekker_wong::DriveSample& s : record.samples)
    side.samples.push_back(
        side_sample(s, s.energy.compaction + s.energy.shear + s.energy.added + s.energy.carcass + s.energy.damping));
  const bekker_wong::EnergyLedger& end = record.samples.back().energy;
  side.soil_parts = {{"shears the soil", end.shear},
                     {"presses the soil", end.compaction},
                     {"added forces of effects", end.added},
                     {"damps the heave", end.damping}};
  if (end.carcass != 0.0) side.soil_parts.push_back({"is in the tire's carcass", end.carcass});
  side.not_steady = unsteady(record, *part.question.drive);
  if (!side.not_steady.empty()) return side;
  side.steady = values_at(record.samples.back());
  side.errors_leave_out = add_errors(*side.steady, part);
  return side;
}

DriveSide grain_side(const dem::GrainDriveRecord& record, std::optional<std::uint64_t> packing) {
  const std::string label = packing ? fmt::format("dem packing {}", *packing) : "dem";
  DriveSide side{SideKind::grains, label, packing, record.end, record.end_time, {}, record.happenings};
  for (const dem::GrainDriveSample& s : record.samples) side.samples.push_back(side_sample(s, s.energy.soil));
  const dem::GrainDriveEnergy& end = record.samples.back().energy;
  if (end.known)
    side.soil_parts = {{"grains slide", end.sliding},
                       {"grains roll", end.rolling},
                       {"grains hit each other", end.damping},
                       {"grains keep", end.stored},
                       {"left over by the time step", end.soil_unaccounted()}};
  side.steady = record.steady;
  side.not_steady = record.not_steady;
  return side;
}

DriveSides side_by_side(const Case& question, std::vector<DriveSide> sides, std::vector<std::string> notes) {
  DriveSides drive{question, std::move(sides), {}, {}, std::move(notes)};
  const std::vector<const DriveSide*> grains = grain_sides(drive);
  if (grains.size() > 1) drive.over_packings = as_one(grains);
  for (const DriveSide& side : drive.sides)
    if (side.kind == SideKind::analytic) drive.differences = differences_of(side.steady, drive);
  return drive;
}

std::optional<dem::SteadyDrive> steady_of_grains(const DriveSides& drive) {
  if (drive.over_packings) return drive.over_packings->steady;
  const std::vector<const DriveSide*> grains = grain_sides(drive);
  return grains.empty() ? std::nullopt : grains.front()->steady;
}

std::vector<DriveWorkRow> work_rows(const DriveSides& drive) {
  std::vector<DriveWorkRow> rows;
  const auto add = [&](const std::string& name, const auto& of) {
    DriveWorkRow row{name, {}};
    for (const DriveSide& side : drive.sides) row.joules.push_back(of(side.samples.back()));
    rows.push_back(std::move(row));
  };
  add("lifts the load", [](const DriveSideSample& s) { return s.energy.height; });
  add("pulls the drawbar", [](const DriveSideSample& s) { return s.energy.drawbar; });
  add("is in motion", [](const DriveSideSample& s) { return s.energy.kinetic; });
  add("is given to the soil", [](const DriveSideSample& s) { return s.soil; });
  for (std::size_t i = 0; i < drive.sides.size(); ++i)
    for (const auto& [name, joules] : drive.sides[i].soil_parts) {
      DriveWorkRow row{"  of that: " + name, std::vector<std::optional<double>>(drive.sides.size())};
      row.joules[i] = joules;
      rows.push_back(std::move(row));
    }
  add("unaccounted for", [](const DriveSideSample& s) { return s.energy.left() - s.soil; });
  return rows;
}

// A drive's samples as answers, to be doubted as any others.

namespace {

/// How deep the wheel stood; a drive has no balance of which the rest could be told.
template <class Sample>
ModelAnswers answers_of(const ModelChoice& choice, const Drive& drive, const std::vector<Sample>& samples) {
  ModelAnswers answers{choice, {}};
  const Way way = angles_along(drive.profile);
  for (const Sample& sample : samples) {
    OperatingCondition at;
    at.load = drive.load, at.pass = drive.pass, at.speed = sample.speed;
    at.slip = sample.slip.value_or(0.0), at.longitudinal_incline = sample.longitudinal_incline;
    at.transverse_incline = way.at(sample.travelled).transverse_incline;
    TractionResult result;
    result.at = at;
    result.sinkage.value = sample.sinkage;
    result.tractive_efficiency = result.entry_angle = result.exit_angle = result.max_stress_angle = not_a_number;
    answers.answers.push_back({at, result, ""});
  }
  return answers;
}

Doubts doubts_of(Case question, const std::vector<ModelAnswers>& study) {
  question.study.models.clear(), question.study.conditions.clear();
  for (const ModelAnswers& model : study) {
    question.study.models.push_back(model.choice);
    for (const Answer& answer : model.answers) question.study.conditions.push_back(answer.at);
  }
  return doubts(question, study);
}

/// A law of shear that goes back as it came, under a pressure that has grown since: the soil gives more than it took.
Doubts gives_back(const std::vector<bekker_wong::DriveSample>& samples) {
  constexpr double hardly = 1e-3;  // of what the soil takes
  double most = 0.0, back = 0.0;
  for (const bekker_wong::DriveSample& sample : samples) {
    most = std::max(most, sample.energy.shear);
    back = std::max(back, most - sample.energy.shear);
  }
  const double taken = samples.empty() ? 0.0 : samples.back().energy.compaction;
  if (!(back > hardly * taken)) return {};
  return {Doubt{DoubtKind::shear_gives_back, {back, 100 * back / taken}}};
}

}  // namespace

Doubts doubts(const AnalyticDrive& part) {
  const ModelChoice wheel{ModelKind::bekker_wong, part.question.drive->effects, ""};
  Doubts all = doubts_of(part.question, {answers_of(wheel, *part.question.drive, part.record.samples)});
  append(all, gives_back(part.record.samples));
  return all;
}

Doubts doubts(const DriveSides& drive) {
  std::vector<ModelAnswers> study;
  for (const DriveSide& side : drive.sides) {
    const bool grains = side.kind == SideKind::grains;
    const ModelChoice choice{grains ? ModelKind::dem : ModelKind::bekker_wong,
                             grains ? std::vector<EffectChoice>{} : drive.question.drive->effects, side.label};
    study.push_back(answers_of(choice, *drive.question.drive, side.samples));
  }
  return doubts_of(drive.question, study);
}

}  // namespace soilbin::compare
