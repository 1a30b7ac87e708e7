#include "compare/discrepancy/difference.hpp"

#include <algorithm>
#include <cmath>

#include "bekker_wong/gsl.hpp"
#include "scenario/estimate.hpp"

namespace soilbin::compare {
namespace {

/// For programs and for people, in the order of DifferenceFinding.
constexpr std::pair<std::string_view, std::string_view> finding_words[] = {{"difference", "difference"},
                                                                           {"within_scatter", "within the scatter"},
                                                                           {"within_errors", "within the errors"},
                                                                           {"not_judged", "not tested"}};

bool speaks(const SidePoint& point, std::size_t channel) {
  return point.result && point.has[channel] && std::isfinite(((*point.result).*channel_views[channel].predicted).value);
}

double value_of(const SidePoint& point, std::size_t channel) {
  return ((*point.result).*channel_views[channel].predicted).value;
}

/// Whether an analytic model gives this channel a value other than zero anywhere, or both sides were measured or run.
/// Grains on a flat bed have a lateral force of nothing but noise, and symmetry says what the model's is.
bool asked_of(const Side& side, const Side& reference, std::size_t channel) {
  if (!channel_views[channel].sideways) return true;
  const auto not_zero = [&](const Side& one) {
    return std::ranges::any_of(
        one.points, [&](const SidePoint& p) { return speaks(p, channel) && std::abs(value_of(p, channel)) > 1e-9; });
  };
  return not_zero(side) && not_zero(reference);
}

Difference difference_at(const SidePoint& a, const SidePoint& b, std::size_t channel, double scale) {
  Difference d;
  d.channel = channel;
  d.value = (*a.result).*channel_views[channel].predicted;
  d.reference_value = (*b.result).*channel_views[channel].predicted;
  d.scatter = std::max(a.scatter[channel], b.scatter[channel]);
  d.difference = d.value.value - d.reference_value.value;
  d.std_error = std::hypot(d.value.std_error, d.reference_value.std_error);
  d.freedom = joined_freedom(d.value.std_error, a.freedom[channel], d.reference_value.std_error, b.freedom[channel]);
  d.share = d.difference / scale;
  d.sigma = d.std_error > 0.0 ? d.difference / d.std_error : not_a_number;
  d.finding = finding_of(d.difference, d.std_error, d.scatter, d.freedom);
  return d;
}

/// Two analytic wheels take the same soil values: their doubt moves both alike, and adding it would count it twice.
void share_the_soil(Difference& d) {
  d.std_error = 0.0;
  d.sigma = not_a_number;
  d.finding = DifferenceFinding::not_judged;
}

}  // namespace

std::string_view word(DifferenceFinding finding) { return finding_words[static_cast<std::size_t>(finding)].first; }

std::string_view words(DifferenceFinding finding) { return finding_words[static_cast<std::size_t>(finding)].second; }

double joined_freedom(double a, double freedom_a, double b, double freedom_b) {
  const double scattering = std::pow(a, 4) / freedom_a + std::pow(b, 4) / freedom_b;
  return scattering > 0.0 ? std::pow(a * a + b * b, 2) / scattering : std::numeric_limits<double>::infinity();
}

double counting_errors(double freedom) {
  constexpr double known = 2.0, most = 15.0;  // Student's t asks for 13.97 at one degree of freedom
  constexpr double as_good_as_known = 1e6;
  if (freedom > as_good_as_known) return known;
  const double chance = 2 * gsl::normal_tail(known);
  return gsl::bracketed_root([&](double k) { return gsl::f_tail(k * k, 1, freedom) - chance; }, known, most, 1e-9, 1e-9,
                             "Student's t");
}

DifferenceFinding finding_of(double difference, double std_error, double scatter, double freedom) {
  const double size = std::abs(difference);
  if (std_error == 0.0 && scatter == 0.0) return DifferenceFinding::not_judged;
  if (size <= scatter) return DifferenceFinding::within_scatter;
  return size <= counting_errors(freedom) * std_error ? DifferenceFinding::within_errors
                                                      : DifferenceFinding::difference;
}

std::vector<Difference> differences(const std::vector<Side>& sides, std::size_t side, std::size_t reference,
                                    const std::vector<OperatingCondition>& conditions, const Tire& tire) {
  std::vector<Difference> all;
  for (std::size_t c = 0; c < channel_views.size(); ++c) {
    if (!asked_of(sides[side], sides[reference], c)) continue;
    for (std::size_t i = 0; i < conditions.size(); ++i) {
      const SidePoint &a = sides[side].points[i], &b = sides[reference].points[i];
      if (!speaks(a, c) || !speaks(b, c)) continue;
      all.push_back(difference_at(a, b, c, channel_scale(channel_views[c], conditions[i].load, tire.radius)));
      all.back().side = side, all.back().reference = reference, all.back().condition = i;
      if (sides[reference].choice && is_by(sides[side], sides[reference].choice->model)) share_the_soil(all.back());
    }
  }
  return all;
}

}  // namespace soilbin::compare
