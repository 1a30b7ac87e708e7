// sensor_offset: a channel's zero or scale is off, alike in every run; or the zero of the load's cell or of the slip.
//
// The load is told, not predicted: where its cell is off the wheel carries W + a, and every channel shows it. On a
// slope the difference weighs along it too.
//
// The slip is told by a rolling radius, that of the zero-slip condition. Where it is (1 + a) r, every speed over the
// rim's is 1 + a times the one told.
#include <fmt/core.h>

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

class Gain final : public Effect {
 public:
  Gain(double Reading::*channel, double gain) : channel_(channel), gain_(gain) {}
  void sensor(Reading& reading, const Surroundings&) const override { reading.*channel_ *= 1 + gain_; }

 private:
  double Reading::*channel_;
  double gain_;
};

class SlipZero final : public Effect {
 public:
  explicit SlipZero(const std::vector<double>& p) : larger_(p[0]) {}
  void motion(Kinematics& motion) const override {
    if (larger_ == 0.0 || motion.locked) return;
    for (double* ratio : {&motion.forward, &motion.lateral, &motion.travel_ratio}) *ratio *= 1 + larger_;
    motion.slip = slip_of_ratio(motion.forward);
  }

 private:
  double larger_;
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
  const std::string id = "sensor_offset";
  std::vector<EffectForm> forms;
  for (const Channel& channel : measured_channels)
    forms.push_back({.id = id,
                     .form = std::string(channel.name),
                     .equation = std::string(channel.name) + " + a",
                     .source = "stated here",
                     .meaning = fmt::format("the zero of the {} is off", channel.title),
                     .parameters = {{"a", std::string(channel.unit), channel.usual, -channel.limit, channel.limit,
                                     "offset of the zero"}},
                     .make = [value = channel.value](const std::vector<double>& p) {
                       return std::make_unique<const Offset>(value, p[0]);
                     }});
  forms.push_back(
      {.id = id,
       .form = "load",
       .equation = "normal load (W + a) cos(alpha) cos(beta_t); F_DP - a sin(alpha), F_y - a cos(alpha) sin(beta_t)",
       .source = "stated here: statics",
       .meaning = "the zero of the load is off",
       .parameters = {{"a", "N", 5.0, -1e4, 1e4, "what the wheel carries beyond the load that is told"}},
       .make = maker<LoadOffset>()});
  forms.push_back(
      {.id = id,
       .form = "slip",
       .equation = "v/(r w) = (1 + a) times the one that the slip tells",
       .source = "stated here: kinematics",
       .meaning = "the slip is told by another rolling radius",
       .parameters = {{"a", "-", 0.02, -0.3, 0.3, "rolling radius by which the slip is told, over r, less 1"}},
       .make = maker<SlipZero>()});
  for (const Channel& channel : measured_channels)
    forms.push_back({.id = id,
                     .form = std::string(channel.name) + "_gain",
                     .equation = std::string(channel.name) + " times 1 + a",
                     .source = "stated here",
                     .meaning = fmt::format("the scale of the {} is off", channel.title),
                     .parameters = {{"a", "-", 0.03, -0.5, 0.5, "share by which the scale is off"}},
                     .make = [value = channel.value](const std::vector<double>& p) {
                       return std::make_unique<const Gain>(value, p[0]);
                     }});
  for (EffectForm& form : forms)
    form.measurement = true, form.form_tolerance = 0.05, form.steady_only = of_an_instrument;
  return forms;
}

}  // namespace soilbin::bekker_wong
