#include "compare/doubts/plate_doubts.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "compare/measured/outliers.hpp"
#include "compare/report/number_text.hpp"
#include "scenario/source_text.hpp"

namespace soilbin::compare {

std::vector<std::string> doubts(const MeasuredPlatesFit& fit) {
  std::vector<std::string> words;
  for (const PlateTestApart& one : fit.apart) words.push_back(in_words(one));
  std::size_t spikes = 0;
  for (const PlateReadingsAside& one : fit.aside) {
    if (one.readings.why == AsideWhy::stuck)
      words.push_back(fmt::format(
          "test '{}', b = {:g} mm: at a sinkage of {} mm that stands still the pressure rises from {} kPa on; those {} "
          "were set aside: does the depth sensor stick, or stand at its end, or is there hard ground?",
          clipped(one.test), 1000 * one.radius, number(1000 * one.readings.sinkage, 3),
          number(one.readings.pressure / 1000, 3), counted(one.readings.readings.size(), "reading")));
    else if (one.readings.why != AsideWhy::unloading)
      spikes += one.readings.readings.size();
  }
  if (static_cast<double>(spikes) > thresholds::max_outlier_share * static_cast<double>(fit.readings + spikes))
    words.push_back(
        fmt::format("{} of {} readings jump off those around them and were set aside: so many are no chance; "
                    "look at the sensors",
                    spikes, fit.readings + spikes));
  const std::string widths = fmt::format("{:g} to {:g} mm", 2000 * fit.radii.front(), 2000 * fit.radii.back());
  if (fit.one_size())
    words.push_back(
        fmt::format("plates of one size do not part k_c from k_phi: k_c = 0 and k_phi = k hold for wheels of about b = "
                    "{:g} mm alone; press in a second size",
                    1000 * fit.radii.front()));
  else
    for (const auto& [name, value] : {std::pair{"k_phi", &fit.k_phi}, {"k_c", &fit.k_c}})
      if (value->estimate.value < 0.0 && -value->estimate.value > value->estimate.std_error)
        words.push_back(fmt::format(
            "{} is negative: Bekker's form doesn't hold over these plates; the values are good for widths of "
            "{}, and for no other",
            name, widths));
  if (const double n = fit.exponent.estimate.value; n < 0.1 || n > 1.8)
    words.push_back(
        fmt::format("n = {}: most plate tests give 0.1 .. 1.6; do the readings start where the plate touches "
                    "the soil?",
                    number(n, 3)));
  if (fit.test_scatter > 0.35)
    words.push_back(fmt::format(
        "tests of one plate bear pressures that scatter by {} from one to the other: were they on one soil of one "
        "density? --only COLUMN=VALUE takes a part of them",
        percent(std::expm1(fit.test_scatter))));
  if (std::ranges::all_of(fit.tests, [](int count) { return count < 2; }))
    words.emplace_back("no plate was pressed in twice: the errors hold no scatter between tests");
  if (!fit.halves_compared)
    words.emplace_back(
        "low and high pressures can't be compared: some test has too few readings in a half; the errors hold nothing "
        "of "
        "a soil that is no power law");
  if (fit.pressure_error > 0.25)
    words.push_back(fmt::format(
        "Bekker's form misses the pressures by {}: fit over the pressures that your wheel makes (--pressure)",
        percent(fit.pressure_error)));
  return words;
}

}  // namespace soilbin::compare
