#include "compare/doubts/plate_doubts.hpp"

#include <fmt/core.h>

#include <algorithm>

#include "compare/report/number_text.hpp"

namespace soilbin::compare {

std::vector<std::string> doubts(const MeasuredPlatesFit& fit) {
  std::vector<std::string> words;
  const std::string widths = fmt::format("{:g} to {:g} mm", 2000 * fit.radii.front(), 2000 * fit.radii.back());
  for (const auto& [name, value] : {std::pair{"k_phi", &fit.k_phi}, {"k_c", &fit.k_c}})
    if (value->estimate.value < 0.0 && -value->estimate.value > value->estimate.std_error)
      words.push_back(
          fmt::format("{} is negative: Bekker's form doesn't hold over these plates; the values are good for widths of "
                      "{}, and for no other",
                      name, widths));
  if (std::ranges::all_of(fit.tests, [](int count) { return count < 2; }))
    words.emplace_back("no plate was pressed in twice: the errors hold no scatter between tests");
  if (fit.pressure_error > 0.25)
    words.push_back(fmt::format(
        "Bekker's form misses the pressures by {}: fit over the pressures that your wheel makes (--pressure)",
        percent(fit.pressure_error)));
  return words;
}

}  // namespace soilbin::compare
