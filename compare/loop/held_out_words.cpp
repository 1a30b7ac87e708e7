#include "compare/loop/held_out_words.hpp"

#include <fmt/core.h>

#include <cmath>

#include "compare/measured/channels.hpp"
#include "compare/report/number_text.hpp"

namespace soilbin::compare {

namespace {

constexpr double third_digit = 1.005;

bool falls(const ErrorPair& error) { return error.before > third_digit * error.after; }

/// "sinkage (20.6 to 7.04 mm), torque (3.1 to 2.2 N m)": the channels of which `moves` holds.
std::string channels_that(bool (*moves)(const ErrorPair&), const CrossValidation& validation) {
  std::string text;
  for (std::size_t c = 0; c < channel_views.size(); ++c) {
    const ErrorPair& e = validation.channels[c];
    const ChannelView& view = channel_views[c];
    if (e.cells > 0 && moves(e))
      text += fmt::format("{}{} ({:.3g} to {:.3g} {})", text.empty() ? "" : ", ", view.title, e.before * view.per_si,
                          e.after * view.per_si, view.unit);
  }
  return text;
}

}  // namespace

bool rises(const ErrorPair& error) { return error.after > third_digit * error.before; }

std::vector<int> worse_channels(const LoopAnswer& answer) {
  std::vector<int> worse;
  if (answer.effects.empty() && answer.stand_in.empty()) return worse;
  for (int c = 0; c < channel_count; ++c)
    if (rises(answer.validation.channels[static_cast<std::size_t>(c)])) worse.push_back(c);
  return worse;
}

std::string held_out_words(const CrossValidation& validation) {
  const std::string better = channels_that(falls, validation), worse = channels_that(rises, validation);
  std::string text =
      fmt::format("held-out error {} by {:.2g} +- {:.2g} sigma^2 a value", validation.gain < 0 ? "rises" : "falls",
                  std::abs(validation.gain), validation.gain_error);
  if (!better.empty()) text += "; predicted better: " + better;
  if (!worse.empty()) text += "; predicted worse: " + worse;
  return text;
}

}  // namespace soilbin::compare
