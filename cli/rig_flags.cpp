#include "cli/rig_flags.hpp"

#include <fmt/core.h>

#include <algorithm>

#include "cli/flag_values.hpp"
#include "compare/measured/campaign.hpp"
#include "compare/measured/condition_views.hpp"
#include "scenario/errors.hpp"
#include "scenario/nearest_word.hpp"
#include "scenario/source_text.hpp"

namespace soilbin::cli {

void add_limits_of_the_rig(CLI::App& app, std::vector<std::string>& texts, const std::string& meaning) {
  add_value(app, "--limit", texts, "NAME=LOW..HIGH", meaning);
}

compare::Limits read_limits(const std::vector<std::string>& texts) {
  std::vector<std::string> names;
  for (const compare::ConditionView& view : compare::condition_views)
    if (view.name != "run") names.emplace_back(view.name);
  compare::Limits limits;
  for (const std::string& text : texts) {
    const std::vector<std::string> parts = split(text, "=");
    const std::vector<std::string> texts_of_ends = split(parts.back(), "..");
    if (parts.size() != 2 || texts_of_ends.size() != 2)
      throw InputError(fmt::format("--limit '{}': expected NAME=LOW..HIGH, such as load=50N..200N", clipped(text)));
    if (std::ranges::find(names, parts[0]) == names.end())
      throw InputError(
          fmt::format("--limit: unknown condition '{}'{}", clipped(parts[0]), did_you_mean(parts[0], names)));
    const compare::ConditionView& view = compare::condition_view(parts[0]);
    const Range range = view.name == "speed" ? above_zero : view.range;  // a rig that stands still measures nothing
    const Measure measure{std::string(view.column_unit), range};
    std::vector<double> ends;
    for (const std::string& end : texts_of_ends) ends.push_back(read_flag("--limit " + parts[0], end, measure));
    if (!(ends[0] <= ends[1]))
      throw InputError(fmt::format("--limit '{}': the lower end is above the upper", clipped(text)));
    limits[parts[0]] = {ends[0], ends[1]};
  }
  return limits;
}

compare::ExpectedNoise read_noise(const std::vector<std::string>& texts) {
  std::vector<std::string> names;
  for (const compare::ChannelView& view : compare::channel_views) names.emplace_back(view.name);
  compare::ExpectedNoise noise;
  for (const std::string& text : texts) {
    const std::vector<std::string> parts = split(text, "=");
    if (parts.size() != 2)
      throw InputError(fmt::format("--noise '{}': expected CHANNEL=SD, such as drawbar_pull=1N", clipped(text)));
    const auto place = std::ranges::find(names, parts[0]);
    if (place == names.end())
      throw InputError(fmt::format("--noise: unknown channel '{}'{}\n  hint: channels are {}", clipped(parts[0]),
                                   did_you_mean(parts[0], names), listed(names)));
    const std::size_t c = static_cast<std::size_t>(place - names.begin());
    noise[c] = read_flag("--noise " + parts[0], parts[1], {compare::channel_views[c].si_unit, above_zero});
  }
  return noise;
}

}  // namespace soilbin::cli
