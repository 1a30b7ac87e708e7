#include "compare/doubts/grain_resolution.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>
#include <vector>

#include "bekker_wong/closed_forms.hpp"
#include "compare/report/number_text.hpp"

namespace soilbin::compare {

using bekker_wong::contact_length;

namespace {

/// bench/grain_size/recorded, as tests/compare/grain_resolution_test.cpp reads it: slip, m, N, N m, m.
constexpr std::array<StudiedAnswer, 3> with_lugs = {{
    {0.2, 0.040, {919, 18}, {755, 10}, {0.0111, 0.0003}},
    {0.2, 0.028, {737, 26}, {665, 13}, {0.0176, 0.0002}},
    {0.2, 0.020, {584, 37}, {606, 18}, {0.0232, 0.0003}},
}};

constexpr std::array<StudiedAnswer, 3> without_lugs = {{
    {0.2, 0.040, {812, 21}, {673, 11}, {0.0151, 0.0004}},
    {0.2, 0.028, {694, 26}, {620, 14}, {0.0222, 0.0003}},
    {0.2, 0.020, {575, 37}, {569, 20}, {0.0264, 0.0004}},
}};

/// What grains of a size change at one slip.
struct Slopes {
  double slip;
  Estimate drawbar_pull, torque, sinkage;  ///< per metre of d
  double contact;                          ///< for d -> 0 [m]
};

std::vector<Slopes> slopes_of(StudiedWheel wheel) {
  const std::span<const StudiedAnswer> studied = studied_answers(wheel);
  std::vector<Slopes> all;
  for (auto row = studied.begin(); row != studied.end();) {
    const double slip = row->slip;
    std::vector<double> diameters;
    std::array<std::vector<Estimate>, 3> values;
    for (; row != studied.end() && row->slip == slip; ++row) {
      diameters.push_back(row->diameter);
      values[0].push_back(row->drawbar_pull), values[1].push_back(row->torque), values[2].push_back(row->sinkage);
    }
    const auto fit = [&](std::size_t channel) { return fit_against_size(diameters, values[channel]); };
    all.push_back(
        {slip, fit(0).slope, fit(1).slope, fit(2).slope, contact_length(fit(2).at_zero.value, studied_radius)});
  }
  return all;
}

Estimate between(const Estimate& a, const Estimate& b, double share) {
  return {a.value + share * (b.value - a.value), std::hypot((1 - share) * a.std_error, share * b.std_error)};
}

/// The slopes at a slip, interpolated between the studied ones; beyond them those of the nearest.
Slopes slopes_at(double slip, const std::vector<Slopes>& all) {
  const auto above = std::find_if(all.begin(), all.end(), [&](const Slopes& one) { return one.slip >= slip; });
  if (above == all.end()) return all.back();
  if (above == all.begin()) return all.front();
  const Slopes &a = *(above - 1), &b = *above;
  const double share = (slip - a.slip) / (b.slip - a.slip);
  return {slip, between(a.drawbar_pull, b.drawbar_pull, share), between(a.torque, b.torque, share),
          between(a.sinkage, b.sinkage, share), std::lerp(a.contact, b.contact, share)};
}

Estimate times(const Estimate& estimate, double factor) {
  return {estimate.value * factor, estimate.std_error * std::abs(factor)};
}

bool near(double value, double studied) { return std::abs(value - studied) <= 0.02 * studied; }

bool is_studied(const Tire& tire) {
  return near(tire.radius, studied_radius) && near(tire.width, studied_width) &&
         (!is_lugged(tire) || near(tire.lugs.height, studied_lugs));
}

bool is_studied(const GranularSoil& sand) {
  const auto& contacts = studied_contacts;
  return near(sand.youngs_modulus, contacts.modulus) && near(sand.grain_grain.sliding_friction, contacts.sliding) &&
         near(sand.grain_grain.rolling_friction, contacts.rolling) &&
         near(sand.grain_grain.cohesion, contacts.cohesion) && near(sand.grain_tire.sliding_friction, contacts.on_tire);
}

/// In how many ways a question leaves what was studied: a wheel, load or sand of its own counts once, for they were
/// tried together.
int departures(const Scenario& scenario, const OperatingCondition& at, double void_ratio) {
  constexpr double same_void_ratio = 0.03;  // (chosen: a tenth of the way from dense to loose)
  const bool another =
      !is_studied(scenario.tire) || !near(at.load, studied_load) || !is_studied(grains_of(scenario.soil));
  return another + !near(at.slip, with_lugs.front().slip) +
         (at.longitudinal_incline != 0 || at.transverse_incline != 0) + (at.yaw != 0) + (at.pass > 1) +
         (std::abs(void_ratio - studied_void_ratio) > same_void_ratio);  // none where it is not known
}

void widen(Estimate& error, double share) { error.std_error = std::hypot(error.std_error, share * error.value); }

/// Why the study does not reach to grains this large beside that length; "" where it does.
std::string coarser(const char* length, double grains, double most) {
  if (!(grains > most * size_reach)) return "";
  return fmt::format("a grain is {:.2g} {} (studied: at most {:.2g})", grains, length, most);
}

ResolutionError leaves_it(std::string beyond) { return {{}, {}, {}, std::move(beyond)}; }

std::string signed_number(const Estimate& estimate, double per_si) {
  const std::string text = number(estimate, per_si);
  return text.starts_with('-') ? text : "+" + text;
}

}  // namespace

std::span<const StudiedAnswer> studied_answers(StudiedWheel wheel) {
  if (wheel == StudiedWheel::bare) return without_lugs;
  return with_lugs;
}

SizeFit fit_against_size(std::span<const double> diameters, std::span<const Estimate> values) {
  if (values.size() < 2 || diameters.size() != values.size())
    throw std::logic_error("a fit against size needs two sizes");
  double n = 0, x = 0, y = 0;
  for (std::size_t i = 0; i < values.size(); ++i) {
    const double weight = 1 / std::pow(values[i].std_error, 2);
    n += weight, x += weight * diameters[i], y += weight * values[i].value;
  }
  x /= n, y /= n;
  double xx = 0, xy = 0, misfit = 0;
  for (std::size_t i = 0; i < values.size(); ++i) {
    const double weight = 1 / std::pow(values[i].std_error, 2);
    xx += weight * std::pow(diameters[i] - x, 2), xy += weight * (diameters[i] - x) * (values[i].value - y);
  }
  const double slope = xy / xx;
  for (std::size_t i = 0; i < values.size(); ++i)
    misfit += std::pow((values[i].value - y - slope * (diameters[i] - x)) / values[i].std_error, 2);
  const double freedom = static_cast<double>(values.size()) - 2;
  const double widened = freedom > 0 ? std::sqrt(std::max(1.0, misfit / freedom)) : 1.0;
  return {{y - slope * x, widened * std::sqrt(1 / n + x * x / xx)}, {slope, widened / std::sqrt(xx)}};
}

ResolutionError resolution_error(const Scenario& scenario, const OperatingCondition& at, double sinkage,
                                 SinkageOf whose, double void_ratio) {
  const Tire& tire = scenario.tire;
  const double d = mean_diameter(grains_of(scenario.soil));
  static const std::vector<Slopes> lugged = slopes_of(StudiedWheel::lugged), bare = slopes_of(StudiedWheel::bare);
  const std::vector<Slopes>& studied = is_lugged(tire) ? lugged : bare;
  const double coarsest = with_lugs.front().diameter;
  const double lowest = studied.front().slip - slip_reach, highest = studied.back().slip + slip_reach;
  if (!(at.slip >= lowest - 1e-9 && at.slip <= highest + 1e-9))
    return leaves_it(fmt::format("slip {:.3g} % lies outside the {:.0f} .. {:.0f} % that were studied{}", 100 * at.slip,
                                 100 * lowest, 100 * highest, is_lugged(tire) ? "" : " without lugs"));
  if (std::string lug = is_lugged(tire) ? coarser("lug heights", d / tire.lugs.height, coarsest / studied_lugs) : "";
      !lug.empty())
    return leaves_it(std::move(lug));
  const Slopes slopes = slopes_at(at.slip, studied);
  ResolutionError error;
  error.sinkage = times(slopes.sinkage, d);
  const double contact =
      contact_length(sinkage - (whose == SinkageOf::grains ? error.sinkage.value : 0.0), tire.radius);
  error.beyond = coarser("contact lengths", d / contact, coarsest / slopes.contact);
  if (!error.known()) return leaves_it(error.beyond);
  const double share = d / contact * slopes.contact * at.load / studied_load;
  error.drawbar_pull = times(slopes.drawbar_pull, share);
  error.torque = times(slopes.torque, share * tire.radius / studied_radius);
  const double more = std::sqrt(departures(scenario, at, void_ratio));
  widen(error.drawbar_pull, more * carried_over.drawbar_pull), widen(error.torque, more * carried_over.torque);
  widen(error.sinkage, more * carried_over.sinkage);
  return error;
}

Estimate error_by_twin(const Estimate& answer, const Estimate& twin, double ratio) {
  return {(twin.value - answer.value) / (ratio - 1), std::hypot(twin.std_error, answer.std_error) / (ratio - 1)};
}

ResolutionError error_by_twin(const TractionResult& answer, const TractionResult& twin, double ratio) {
  const auto of = [&](Estimate TractionResult::*channel) {
    return error_by_twin(answer.*channel, twin.*channel, ratio);
  };
  ResolutionError error{of(&TractionResult::drawbar_pull), of(&TractionResult::torque), of(&TractionResult::sinkage),
                        ""};
  error.by_twin = true;
  return error;
}

std::string in_words(const ResolutionError& error) {
  return fmt::format("drawbar pull {} N, torque {} N m, sinkage {} mm", signed_number(error.drawbar_pull, 1),
                     signed_number(error.torque, 1), signed_number(error.sinkage, 1000));
}

Json to_json(const ResolutionError& error) {
  if (!error.known())
    return {{"drawbar_pull", nullptr}, {"torque", nullptr}, {"sinkage", nullptr}, {"beyond", error.beyond}};
  return {{"drawbar_pull", estimate_json(error.drawbar_pull)},
          {"torque", estimate_json(error.torque)},
          {"sinkage", estimate_json(error.sinkage)},
          {"from", error.by_twin ? "twin" : "study"}};
}

}  // namespace soilbin::compare
