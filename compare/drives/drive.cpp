#include "compare/drives/drive.hpp"

#include "bekker_wong/limits.hpp"
#include "bekker_wong/model.hpp"
#include "scenario/drive_way.hpp"
#include "scenario/errors.hpp"

namespace soilbin::compare {
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
