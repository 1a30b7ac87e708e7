// sensor_offset: a channel's zero is off, by the same in every run; or that of the cell that tells the load.
//
// The load is told, not predicted: where its cell is off the wheel carries W + a, and every channel shows it. On a
// slope the difference weighs along it too.
#include <cmath>

#include "bekker_wong/effects/forms.hpp"
#include "bekker_wong/effects/instrument_channels.hpp"

namespace soilbin::bekker_wong {
namespace {

class Offset final : public Effect {
 public:
  Offset(double Reading::*channel, double offset) : channel_(channel), offset_(offset) {}
  void sensor(Reading& reading, const Surroundings&) const override { reading.*channel_ += offset_; }

 private:
  double Reading::*channel_;
  double offset_;
};

/// The wheel carries so much more than the load that is told.
class LoadOffset final : public Effect {
 public:
  explicit LoadOffset(const std::vector<double>& p) : more_(p[0]) {}
  void added_forces(ForceLedger& ledger, const Rolling& rolling) const override {
    if (more_ == 0.0) return;
    const OperatingCondition& at = rolling.around.at;
    const double uphill = std::cos(at.longitudinal_incline);
    const GroundForce weighs =
        turned({-more_ * std::sin(at.longitudinal_incline), -more_ * uphill * std::sin(at.transverse_incline)}, at.yaw,
               ForceFrame::travel, ForceFrame::wheel);
    ledger.add({.name = "sensor_offset",
                .forward = weighs.forward,
                .lateral = weighs.left,
                .vertical = -more_ * uphill * std::cos(at.transverse_incline)});
  }
  bool lifts() const override { return more_ != 0.0; }

 private:
  double more_;
};

}  // namespace

std::vector<EffectForm> sensor_offset_forms() {
  std::vector<EffectForm> forms;
  for (const Channel& channel : measured_channels)
    forms.push_back({.id = "sensor_offset",
                     .form = std::string(channel.name),
                     .equation = std::string(channel.name) + " + a",
                     .source = "stated here",
                     .parameters = {{"a", std::string(channel.unit), channel.usual, -channel.limit, channel.limit,
                                     "offset of the zero"}},
                     .measurement = true,
                     .form_tolerance = 0.05,
                     .steady_only = of_an_instrument,
                     .make = [value = channel.value](const std::vector<double>& p) {
                       return std::make_unique<const Offset>(value, p[0]);
                     }});
  forms.push_back(
      {.id = "sensor_offset",
       .form = "load",
       .equation = "normal load (W + a) cos(alpha) cos(beta_t); F_DP - a sin(alpha), F_y - a cos(alpha) sin(beta_t)",
       .source = "stated here: statics",
       .parameters = {{"a", "N", 5.0, -1e4, 1e4, "what the wheel carries beyond the load that is told"}},
       .measurement = true,
       .form_tolerance = 0.05,
       .steady_only = of_an_instrument,
       .make = maker<LoadOffset>()});
  return forms;
}

}  // namespace soilbin::bekker_wong
