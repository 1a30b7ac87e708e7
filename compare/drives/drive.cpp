#include "compare/drives/drive.hpp"

#include <algorithm>
#include <cmath>

#include "bekker_wong/effect.hpp"
#include "bekker_wong/limits.hpp"
#include "bekker_wong/model.hpp"
#include "compare/report/number_text.hpp"
#include "scenario/drive_soils.hpp"
#include "scenario/drive_way.hpp"
#include "scenario/errors.hpp"
#include "scenario/fitted_errors.hpp"
#include "scenario/soil_parameters.hpp"

namespace soilbin::compare {
namespace {

using bekker_wong::DriveRecord;
using DriveValue = std::function<std::optional<double>(const DriveRecord&)>;

constexpr int few_samples = 40;  // the end and whether it is steady are all that is asked for

/// A value that is to be moved, and how.
struct Uncertain {
  MovedDrive drive;
  bool of_fit = false;  ///< of the case's soil or of an effect: what drive.errors speaks of
  std::function<void(Case&, double value)> set;
};

void add_soil_values(const Soil& soil, bool of_case, std::vector<Uncertain>& values) {
  for (const SoilParameter& p : soil_parameters) {
    const Estimate of = (*soil.semi_empirical).*p.value;
    if (!(of.std_error > 0.0)) continue;
    const auto [below, above] = neighbours(of.value, of.std_error, p.range);
    values.push_back({{soil.name, p.name, p.title, p.unit, p.per_si, of, {below}, {above}},
                      of_case,
                      [soil, &p](Case& asked, double value) {
                        for (Soil* one : soils_of_way(asked.scenario.soil, asked.drive->profile))
                          if (is_same_soil(*one, soil))
                            move_value(*one->semi_empirical, p, value, soil.semi_empirical->exponent.value);
                      }});
  }
}

void add_effect_values(const Drive& drive, std::vector<Uncertain>& values) {
  for (const FittedError& error : drive.errors) {
    const auto place = find_effect_parameter(error.parameter, drive.effects);
    if (!place || !(error.std_error > 0.0)) continue;
    const EffectChoice& effect = drive.effects[place->effect];
    const auto& described = bekker_wong::find_parameter(bekker_wong::find_form(effect), place->parameter);
    const Estimate of{effect.parameters.at(place->parameter), *error.std_error};
    const auto [below, above] =
        neighbours(of.value, of.std_error, {.lower = described.lower, .upper = described.upper});
    const std::string& unit = described.unit;
    values.push_back({{"", error.parameter, error.parameter, unit, per_unit(unit), of, {below}, {above}},
                      true,
                      [at = *place](Case& asked, double value) {
                        asked.drive->effects[at.effect].parameters[at.parameter] = value;
                      }});
  }
}

std::vector<Uncertain> uncertain_values(Case question) {
  std::vector<Uncertain> values;
  for (const Soil* soil : soils_once(question.scenario.soil, question.drive->profile))
    if (soil->semi_empirical) add_soil_values(*soil, soil == &question.scenario.soil, values);
  add_effect_values(*question.drive, values);
  return values;
}

void drive_side(Case question, const Uncertain& moved, MovedDrive::Side& side, const Pulse& pulse) {
  if (!moved.drive.was_moved(side)) return;
  moved.set(question, side.value);
  try {
    side.record =
        bekker_wong::drive_wheel(question.scenario, *question.drive, few_samples, {}, [&](double, double) { pulse(); });
  } catch (const NoSolution&) {
  } catch (const InputError&) {  // a value that the wheel does not take
  }
}

Eigen::MatrixXd correlations_of(const std::vector<Uncertain>& values, const std::vector<FittedError>& fit) {
  const auto n = static_cast<Eigen::Index>(values.size());
  Eigen::MatrixXd all = Eigen::MatrixXd::Identity(n, n);
  for (Eigen::Index i = 0; i < n; ++i)
    for (Eigen::Index k = 0; k < i; ++k) {
      const Uncertain &one = values[static_cast<std::size_t>(i)], &other = values[static_cast<std::size_t>(k)];
      if (one.of_fit && other.of_fit)
        all(i, k) = all(k, i) = correlation(fit, one.drive.parameter, other.drive.parameter);
    }
  return all;
}

/// None where nothing was moved, or a value has no drive on either side.
std::optional<double> error_of(const DriveErrors& errors, double as_declared, const DriveValue& value) {
  if (errors.moved.empty()) return std::nullopt;
  Eigen::VectorXd changes(static_cast<Eigen::Index>(errors.moved.size()));
  for (std::size_t i = 0; i < errors.moved.size(); ++i) {
    const auto by = change(errors.moved[i], as_declared, value);
    if (!by) return std::nullopt;
    changes[static_cast<Eigen::Index>(i)] = *by;
  }
  return errors.standard_error(changes);
}

}  // namespace

double DriveErrors::standard_error(const Eigen::VectorXd& changes) const {
  return std::sqrt(std::max(0.0, changes.dot(correlations * changes)));
}

std::optional<double> change(const MovedDrive& drive, double as_declared, const DriveValue& value) {
  const auto of = [&](const MovedDrive::Side& side) { return side.record ? value(*side.record) : std::nullopt; };
  const std::optional<double> low = of(drive.lower), high = of(drive.higher);
  if (!low && !high) return std::nullopt;
  const double width = (high ? drive.higher.value : drive.of.value) - (low ? drive.lower.value : drive.of.value);
  return drive.of.std_error * (high.value_or(as_declared) - low.value_or(as_declared)) / width;
}

DriveErrors drive_errors(const Case& question, const DriveRecord& record, const ThreadPool& pool) {
  std::vector<Uncertain> values = uncertain_values(question);
  pool.each(2 * static_cast<int>(values.size()), [&](int i, const Pulse& pulse) {
    Uncertain& one = values[static_cast<std::size_t>(i / 2)];
    drive_side(question, one, i % 2 == 0 ? one.drive.lower : one.drive.higher, pulse);
  });
  DriveErrors errors;
  errors.correlations = correlations_of(values, question.drive->errors);
  for (Uncertain& one : values) errors.moved.push_back(std::move(one.drive));
  if (std::ranges::any_of(errors.moved, [&](const MovedDrive& drive) {
        return drive.ends_otherwise(drive.lower, record.end) || drive.ends_otherwise(drive.higher, record.end);
      }))
    return errors;  // stuck and not stuck: no slope between them
  errors.travelled = error_of(errors, record.samples.back().travelled,
                              [](const DriveRecord& r) { return std::optional(r.samples.back().travelled); });
  errors.end_time = error_of(errors, record.end_time, [](const DriveRecord& r) { return std::optional(r.end_time); });
  return errors;
}

namespace {

std::optional<double> steepest_of(const Case& question) {
  const Drive& drive = *question.drive;
  const Place start = angles_along(drive.profile).at(0.0);
  const bekker_wong::RollingWheel wheel(question.scenario.tire,
                                        bekker_wong::values_of(*question.scenario.soil.semi_empirical),
                                        bekker_wong::make_effects(drive.effects), question.scenario.bin);
  OperatingCondition at;
  at.load = drive.load;
  at.pass = drive.pass;
  at.transverse_incline = start.transverse_incline, at.yaw = start.yaw;
  at.speed = drive.controller.rim_speed.value_or(at.speed);
  try {
    return bekker_wong::steepest_slope(wheel, at);
  } catch (const NoSolution&) {
    return {};
  }
}

}  // namespace

AnalyticDrive run_drive(const Case& question, int samples, const bekker_wong::DriveProgress& progress, int threads) {
  if (!question.drive) throw InputError("case '" + question.name + "' has no section 'drive'");
  const Drive& drive = *question.drive;
  AnalyticDrive part{
      question, bekker_wong::drive_wheel(question.scenario, drive, samples, {}, progress), steepest_of(question), {}};
  const auto pulse = [&] {
    if (progress) progress(part.record.end_time, drive.duration);
  };
  part.errors = drive_errors(question, part.record, {threads, pulse});
  return part;
}

}  // namespace soilbin::compare
