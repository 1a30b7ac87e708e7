// What came of a vehicle driven in time, with its errors and what it climbs in a steady state.
//
//   const DrivenAnswers answers = driven_answers(question, wheels, bekker_wong::BekkerWong({false, false}));
//   answers.record->end, answers.travelled_error
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "compare/vehicle/vehicle_answers.hpp"
#include "compare/vehicle/vehicle_drive.hpp"

namespace soilbin::compare {

/// The drive with one value of the soil or of a carcass moved by its standard deviation, or as far as its bound.
struct MovedVehicleDrive {
  struct Side {
    double value = 0.0;             ///< [SI]
    std::optional<DriveEnd> end{};  ///< none: the soil can't hold it at its start
    double end_time = 0.0, travelled = 0.0;
  };
  std::string title;
  double value = 0.0, sd = 0.0;
  Side lower{}, higher{};
};

struct DrivenAnswers {
  VehicleCase question{};
  std::vector<VehicleWheel> wheels{};
  std::optional<VehicleDriveRecord> record{};
  std::optional<VehicleFailure> failure{};  ///< why it does not stand at its start; then there is no record
  VehicleLimit up{};                        ///< what it climbs in a steady state, with the condition's pull
  std::vector<MovedVehicleDrive> moved{};
  std::optional<double> travelled_error{};  ///< standard error of the way to the end [m]; none where some of the drives
                                            ///< end in another way, or do not stand
  std::optional<double> end_time_error{};   ///< [s]; as that
};

/// The drive, and again for its errors: each doubtful value a standard deviation lower and higher, all taken as
/// independent; soils that begin on the way keep their values. Throws what drive_vehicle throws, but for a vehicle that
/// does not stand.
DrivenAnswers driven_answers(const VehicleCase& question, const std::vector<VehicleWheel>& wheels, const Model& model,
                             int samples = 400, const bekker_wong::DriveProgress& progress = {});

}  // namespace soilbin::compare
