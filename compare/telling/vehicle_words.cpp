#include "compare/telling/vehicle_words.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <cstddef>

namespace soilbin::compare {

double told_error(double error) {
  constexpr double exact = 0.0;
  return std::isfinite(error) ? error : exact;
}

namespace {

std::string wheel_called(const std::vector<VehicleWheel>& wheels, const VehicleFailure& failure) {
  return failure.wheel ? wheels[*failure.wheel].name : "";
}

const char* failure_word(GaveOut why) {
  constexpr std::array words = {"wheel",     "pull",   "torque",   "hold",
                                "tips_over", "slides", "backward", "soil_slides"};  // in the order of its values
  return words[static_cast<std::size_t>(why)];
}

}  // namespace

std::string failure_in_words(const std::vector<VehicleWheel>& wheels, const VehicleFailure& failure) {
  const std::string wheel = wheel_called(wheels, failure);
  switch (failure.why) {
    case GaveOut::wheel:
      return fmt::format("the wheel '{}' gives out: {}", wheel, failure.words);
    case GaveOut::pull:
      return fmt::format("its wheels pull too little at any slip; '{}' pulls the least for its load", wheel);
    case GaveOut::torque:
      return fmt::format("its motors give too little torque at any slip; '{}' pulls the least for its load", wheel);
    case GaveOut::hold:
      return fmt::format("braked by its drive line it runs away at any slip; '{}' holds the least for its load", wheel);
    case GaveOut::tips_over:
      return "it tips over";
    case GaveOut::slides:
      return "nothing balances the forces across its travel: it slides sideways";
    case GaveOut::backward:
      return failure.wheel ? fmt::format("the wheel '{}' would have to roll backward or straight across", wheel)
                           : "the centre of the turn would lie between its wheels";
    case GaveOut::soil_slides:
      return "from there on the soil slides by itself (c, phi, at a depth of a wheel's radius)";
  }
  return "";
}

Json failure_json(const std::vector<VehicleWheel>& wheels, const VehicleFailure& failure) {
  return {{"why", failure_word(failure.why)},
          {"wheel", failure.wheel ? Json(wheel_called(wheels, failure)) : Json()},
          {"text", failure_in_words(wheels, failure)}};
}

const char* travel_limit_word(TravelLimit limit) {
  constexpr std::array<const char*, 4> words = {"soil", "torque", "power", "speed"};  // in the order of its values
  return words[static_cast<std::size_t>(limit)];
}

std::string travel_limit_in_words(TravelLimit limit) {
  constexpr std::array<const char*, 4> words = {"the soil gives no more", "the motors give no more torque",
                                                "the power is used up", "the motors turn no faster"};
  return words[static_cast<std::size_t>(limit)];
}

}  // namespace soilbin::compare
