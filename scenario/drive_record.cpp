#include "scenario/drive_record.hpp"

#include <algorithm>
#include <cmath>

namespace soilbin {

std::string_view word_of(DriveEvent event) {
  switch (event) {
    case DriveEvent::torque_limit:
      return "the motor reaches its highest torque";
    case DriveEvent::speed_limit:
      return "the motor reaches its highest speed";
    case DriveEvent::free_again:
      return "the motor is within its limit again";
    case DriveEvent::lifts:
      return "the wheel lifts off";
    case DriveEvent::lands:
      return "the wheel lands";
  }
  return "";
}

std::string_view word_of(DriveEnd end) {
  switch (end) {
    case DriveEnd::time_is_up:
      return "time is up";
    case DriveEnd::arrived:
      return "arrived";
    case DriveEnd::stuck:
      return "stuck";
    case DriveEnd::buried:
      return "buried";
    case DriveEnd::rolled_back:
      return "rolled back";
    case DriveEnd::bed_ends:
      return "the bed ends";
    case DriveEnd::tips_over:
      return "tipped over";
  }
  return "";
}

std::optional<double> drive_slip(double rim_speed, double along, std::optional<double> rim) {
  constexpr double standing_share = 1e-3, without = 0.1;
  const double larger = std::max(std::abs(rim_speed), std::abs(along));
  if (!(larger > standing_share * rim.value_or(without))) return {};
  return (rim_speed - along) / larger;
}

}  // namespace soilbin
