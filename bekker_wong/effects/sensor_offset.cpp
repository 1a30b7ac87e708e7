// sensor_offset: a channel's zero is off, by the same in every run.
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
  return forms;
}

}  // namespace soilbin::bekker_wong
