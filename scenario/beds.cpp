#include "scenario/beds.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <optional>
#include <vector>

#include "scenario/description.hpp"
#include "scenario/soil_parameters.hpp"

namespace soilbin {
namespace {

/// What is interpolated in place of a value: g(value), its inverse, and dg/dvalue.
struct Scale {
  double (*of)(double);
  double (*back)(double);
  double (*slope)(double);
};

constexpr Scale plain_scale{[](double x) { return x; }, [](double x) { return x; }, [](double) { return 1.0; }},
    log_scale{[](double x) { return std::log(x); }, [](double x) { return std::exp(x); },
              [](double x) { return 1.0 / x; }},
    tangent_scale{[](double x) { return std::tan(x); }, [](double x) { return std::atan(x); },
                  [](double x) { return 1.0 + std::tan(x) * std::tan(x); }};

Scale scale_of(const SoilParameter& p) {
  using S = SemiEmpiricalSoil;
  if (p.value == &S::k_phi || p.value == &S::shear_modulus) return log_scale;
  return p.value == &S::friction_angle ? tangent_scale : plain_scale;
}

bool are_one(const std::vector<Estimate>& values) {
  return std::ranges::all_of(values, [&](const Estimate& value) {
    return value.value == values.front().value && value.std_error == values.front().std_error;
  });
}

double square(double x) { return x * x; }

/// Two neighbouring places, in ascending order, and the share of the way from the first one to the second.
struct Between {
  std::size_t below, above;
  double apart, share;
};

/// place: between the first and the last of the places.
Between between(const std::vector<double>& places, double place) {
  const auto above = static_cast<std::size_t>(std::ranges::upper_bound(places, place) - places.begin());
  const double apart = places[above] - places[above - 1];
  return {above - 1, above, apart, (place - places[above - 1]) / apart};
}

/// Values known at places in ascending order, at another place. Formulas: beds.hpp.
Estimate interpolated(const std::vector<double>& places, const std::vector<Estimate>& values, double place,
                      const Scale& scale) {
  if (are_one(values)) return values.front();
  const auto g = [&](std::size_t i) { return scale.of(values[i].value); };
  const auto variance = [&](std::size_t i) { return square(scale.slope(values[i].value) * values[i].std_error); };
  const std::size_t last = places.size() - 1;
  double scatter = 0.0;
  for (std::size_t i = 0; i < last; ++i)
    scatter += square(g(i + 1) - g(i)) / (places[i + 1] - places[i]) / static_cast<double>(last);
  const auto answer = [&](double of, double squared_error) {
    const double value = scale.back(of);
    return Estimate{value, std::sqrt(squared_error) / scale.slope(value)};
  };
  if (place <= places.front()) return answer(g(0), variance(0) + scatter * (places.front() - place));
  if (place >= places.back()) return answer(g(last), variance(last) + scatter * (place - places.back()));
  const auto [below, above, apart, w] = between(places, place);
  return answer((1 - w) * g(below) + w * g(above),
                square(1 - w) * variance(below) + square(w) * variance(above) + scatter * apart * w * (1 - w));
}

std::vector<Estimate> values_of(std::span<const SemiEmpiricalSoil> beds, const SoilParameter& p) {
  std::vector<Estimate> values;
  for (const SemiEmpiricalSoil& bed : beds) values.push_back(bed.*p.value);
  return values;
}

/// The sinkage at which n and the pressure of a bed between others err apart, as they do at theirs [m]: ln z_0 is the
/// mean of theirs, each weighted by what it gives the variance of n. None where no bed declares one.
std::optional<double> reference_between(std::span<const SemiEmpiricalSoil> beds, const std::vector<double>& places,
                                        double place) {
  if (std::ranges::none_of(beds, [](const SemiEmpiricalSoil& bed) { return bed.reference_sinkage.has_value(); }))
    return std::nullopt;
  if (place <= places.front()) return beds.front().reference_sinkage;
  if (place >= places.back()) return beds.back().reference_sinkage;
  const auto [below, above, apart, w] = between(places, place);
  const double a = square((1 - w) * beds[below].exponent.std_error), b = square(w * beds[above].exponent.std_error);
  const double share = a + b > 0.0 ? b / (a + b) : w;
  return std::exp((1 - share) * std::log(beds[below].reference_sinkage.value_or(1.0)) +
                  share * std::log(beds[above].reference_sinkage.value_or(1.0)));
}

/// k_phi z_0^n of a bed [N/m^2], with its error: that of k_phi, and of n where the bed's own reference is another one.
Estimate pressure_at(const SemiEmpiricalSoil& bed, double sinkage) {
  const double pressure = bed.k_phi.value * std::pow(sinkage, bed.exponent.value);
  const double by_n = std::log(sinkage / bed.reference_sinkage.value_or(1.0)) * bed.exponent.std_error;
  return {pressure, pressure * std::hypot(bed.k_phi.std_error / bed.k_phi.value, by_n)};
}

std::string in_kg_per_m3(double density) { return fmt::format("{:.6g} kg/m^3", density); }

std::string range_in_words(const DensityRange& range) {
  return fmt::format("{:.6g} to {}", range.lowest, in_kg_per_m3(range.highest));
}

/// Where a value at this density comes from.
std::string source_at(std::span<const SemiEmpiricalSoil> beds, double density) {
  const DensityRange range = tested(beds);
  if (!range.holds(density))
    return fmt::format("of the bed of {}, the nearest that was tested",
                       in_kg_per_m3(density < range.lowest ? range.lowest : range.highest));
  const auto above =
      std::ranges::find_if(beds, [&](const SemiEmpiricalSoil& bed) { return bulk_density(bed) > density; });
  return fmt::format("between the beds of {:.6g} and {}", bulk_density(*(above - 1)),
                     in_kg_per_m3(bulk_density(*above)));
}

std::string out_of_reach(std::span<const SemiEmpiricalSoil> beds, double density) {
  return fmt::format(
      "{} is out of reach of beds that were tested at {}: their values are taken for {:.0f} to {:.0f} kg/m^3",
      in_kg_per_m3(density), range_in_words(tested(beds)), reached(beds).lowest, reached(beds).highest);
}

/// What is wrong with beds as such, whichever is asked about.
std::string wrong_among(const std::vector<SemiEmpiricalSoil>& beds) {
  if (beds.size() < 2) return "'beds' needs two or more: a single one is 'semi_empirical'";
  for (std::size_t i = 0; i < beds.size(); ++i) {
    const SemiEmpiricalSoil& bed = beds[i];
    if (!bed.density) return "each of the 'beds' needs its 'density'";
    const std::string which = "the bed of " + in_kg_per_m3(*bed.density);
    if (i > 0 && !(std::log(*bed.density) > std::log(*beds[i - 1].density)))
      return which + " stands behind a denser one: loosest first";
    if (!(bed.k_phi.value > 0.0)) return which + " needs a k_phi above 0: its logarithm is interpolated";
    if (bed.assumed_sd) return which + " assumes standard deviations: what grows between beds must be measured";
    if (bed.gravity != beds.front().gravity) return which + " lies under another gravity than the first one";
  }
  return "";
}

}  // namespace

DensityRange tested(std::span<const SemiEmpiricalSoil> beds) {
  return {bulk_density(beds.front()), bulk_density(beds.back())};
}

DensityRange reached(std::span<const SemiEmpiricalSoil> beds) {
  const auto [lowest, highest] = tested(beds);
  return {lowest * lowest / highest, highest * highest / lowest};
}

SemiEmpiricalSoil bed_at(std::span<const SemiEmpiricalSoil> beds, double density) {
  for (const SemiEmpiricalSoil& bed : beds)
    if (bed.density == density) return bed;
  if (!reached(beds).holds(density)) throw InputError(out_of_reach(beds, density));
  std::vector<double> places;
  for (const SemiEmpiricalSoil& bed : beds) places.push_back(std::log(bulk_density(bed)));
  const double place = std::log(density);
  SemiEmpiricalSoil at = beds.front();
  at.density = density, at.sources.erase("density");
  const std::string source = source_at(beds, density);
  const auto interpolate = [&](const SoilParameter& p, const std::vector<Estimate>& values) {
    at.*p.value = interpolated(places, values, place, scale_of(p));
    if (!are_one(values)) at.sources[p.name] = source;
  };
  const SoilParameter &k_c = soil_parameter("k_c"), &k_phi = soil_parameter("k_phi");
  at.reference_sinkage = reference_between(beds, places, place);
  for (const SoilParameter& p : soil_parameters) {
    if (p.value == k_c.value) continue;
    std::vector<Estimate> values = values_of(beds, p);
    const bool by_pressure = p.value == k_phi.value && at.reference_sinkage && !are_one(values);
    if (by_pressure)
      for (std::size_t i = 0; i < beds.size(); ++i) values[i] = pressure_at(beds[i], *at.reference_sinkage);
    interpolate(p, values);
    if (!by_pressure) continue;
    const double per_modulus = std::pow(*at.reference_sinkage, at.exponent.value);
    at.k_phi = {at.k_phi.value / per_modulus, at.k_phi.std_error / per_modulus};
  }
  std::vector<Estimate> shares = values_of(beds, k_c);
  if (are_one(shares)) return at;
  for (std::size_t i = 0; i < beds.size(); ++i)
    shares[i] = {shares[i].value / beds[i].k_phi.value, shares[i].std_error / beds[i].k_phi.value};
  interpolate(k_c, shares);
  at.k_c = {at.k_c.value * at.k_phi.value, at.k_c.std_error * at.k_phi.value};
  return at;
}

void set_density(Soil& soil, double density) {
  if (soil.beds.empty())
    throw InputError(
        fmt::format("soil '{}' has values at one density alone\n  hint: 'beds' in a soil file holds them "
                    "at several, as cullinan-sand has them",
                    soil.name));
  if (const std::string wrong = wrong_among(soil.beds); !wrong.empty()) throw InputError(wrong);
  SemiEmpiricalSoil at = bed_at(soil.beds, density);
  if (soil.bed_density)
    if (const std::string before = " at " + in_kg_per_m3(*soil.bed_density); soil.name.ends_with(before))
      soil.name.resize(soil.name.size() - before.size());
  soil.name += " at " + in_kg_per_m3(density);
  soil.semi_empirical = std::move(at);
  soil.bed_density = density;
}

std::string wrong_in_beds(const Soil& soil) {
  if (soil.beds.empty())
    return soil.bed_density ? "'density' picks among 'beds', and there are none: a single density stands in "
                              "'semi_empirical'"
                            : "";
  if (const std::string wrong = wrong_among(soil.beds); !wrong.empty()) return wrong;
  if (!soil.bed_density) return "'beds' needs 'density' beside it: of the bed that is asked about";
  if (!reached(soil.beds).holds(*soil.bed_density)) return out_of_reach(soil.beds, *soil.bed_density);
  if (soil.semi_empirical && soil.semi_empirical->density != soil.bed_density)
    return "'density' and the density of 'semi_empirical' differ";
  return "";
}

void fill_in(Soil& soil, const std::function<bool(const char*)>&) {
  if (soil.semi_empirical || soil.beds.empty() || !wrong_in_beds(soil).empty()) return;
  soil.semi_empirical = bed_at(soil.beds, *soil.bed_density);
}

}  // namespace soilbin
