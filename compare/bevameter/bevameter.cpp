#include "compare/bevameter/bevameter.hpp"

#include <algorithm>
#include <cmath>

#include "resistive_force/response.hpp"
#include "scenario/errors.hpp"
#include "scenario/number_check.hpp"

namespace soilbin::compare {
namespace {

/// tau_max and the sum of squares left, at this K.
JanosiFit at_modulus(const ShearCurve& curve, double modulus) {
  double uu = 0, ut = 0, tt = 0;
  for (std::size_t k = 0; k < curve.displacement.size(); ++k) {
    const double u = -std::expm1(-curve.displacement[k] / modulus), t = curve.shear_stress[k];
    uu += u * u, ut += u * t, tt += t * t;
  }
  const double left = std::max(0.0, tt - ut * ut / uu) / static_cast<double>(curve.displacement.size());
  return {.shear_max = ut / uu, .modulus = modulus, .rms = std::sqrt(left)};
}

/// Root mean square of p - (k_c/b + k_phi) z^n over the mean p.
double pressure_error(std::span<const PlateSet> plates, const BevameterFit& fit) {
  double squares = 0, sum = 0, count = 0;
  for (const PlateSet& set : plates)
    for (const bekker_wong::PlateCurve& curve : set)
      for (std::size_t k = 0; k < curve.pressure.size(); ++k) {
        const double modulus = fit.soil.k_c.value / curve.radius + fit.soil.k_phi.value;
        const double miss = curve.pressure[k] - modulus * std::pow(curve.sinkage[k], fit.soil.exponent.value);
        squares += miss * miss, sum += curve.pressure[k], count += 1;
      }
  return std::sqrt(squares / count) / (sum / count);
}

}  // namespace

double xi_n_of(const bekker_wong::PlateCurve& curve) {
  double moment = 0.0, square = 0.0;
  for (std::size_t i = 0; i < curve.pressure.size(); ++i)
    moment += curve.pressure[i] * curve.sinkage[i], square += curve.sinkage[i] * curve.sinkage[i];
  return moment / square / resistive_force::plate_response();
}

ShearStrength strength_of(std::span<const ShearTop> tops) {
  double s = 0, sx = 0, sy = 0, sxx = 0, sxy = 0;
  for (std::size_t k = 0; k < tops.size(); ++k) {
    const double x = tops[k].normal_stress, y = tops[k].shear_max, w = 1 / (x * x);
    s += w, sx += w * x, sy += w * y, sxx += w * x * x, sxy += w * x * y;
  }
  const double determinant = s * sxx - sx * sx;
  if (!(determinant > 1e-9 * s * sxx)) throw InputError("c and phi need shear tests at two normal stresses");
  const double slope = (s * sxy - sx * sy) / determinant, cut = (sy - slope * sx) / s;
  double left = 0;
  for (std::size_t k = 0; k < tops.size(); ++k) {
    const double miss = (tops[k].shear_max - cut - slope * tops[k].normal_stress) / tops[k].normal_stress;
    left += miss * miss;
  }
  const double variance = tops.size() > 2 ? left / static_cast<double>(tops.size() - 2) : 0;
  return {.cohesion = {cut, std::sqrt(variance * sxx / determinant)},
          .friction_angle = {std::atan(slope), std::sqrt(variance * s / determinant) / (1 + slope * slope)}};
}

JanosiFit fit_janosi(const ShearCurve& curve) {
  const std::vector<double>& j = curve.displacement;
  if (j.size() < 4 || curve.shear_stress.size() != j.size())
    throw InputError("a shear test needs four points or more, displacement and stress each");
  if (*std::ranges::min_element(j) <= 0) throw InputError("displacements of a shear test must be above 0");
  // A coarse search over the logarithm of K, then golden section.
  double low = std::log(0.01 * j.front()), high = std::log(10 * *std::ranges::max_element(j));
  constexpr int coarse = 200;
  const double width = (high - low) / coarse;
  double best = low;
  for (int k = 1; k <= coarse; ++k)
    if (at_modulus(curve, std::exp(low + k * width)).rms < at_modulus(curve, std::exp(best)).rms)
      best = low + k * width;
  low = best - width, high = best + width;
  constexpr double golden = 0.6180339887498949;
  for (int k = 0; k < 60; ++k) {
    const double a = high - golden * (high - low), b = low + golden * (high - low);
    (at_modulus(curve, std::exp(a)).rms < at_modulus(curve, std::exp(b)).rms ? high : low) =
        at_modulus(curve, std::exp(a)).rms < at_modulus(curve, std::exp(b)).rms ? b : a;
  }
  return at_modulus(curve, std::exp((low + high) / 2));
}

BevameterFit fit_bevameter(std::span<const PlateSet> plates, std::span<const ShearCurve> shear) {
  if (plates.empty() || shear.empty()) throw InputError("a bevameter needs plates and shear tests");
  BevameterFit fit;
  std::vector<double> n, k_c, k_phi, modulus, xi_n;
  std::vector<bekker_wong::PlateSums> sums;
  for (const PlateSet& set : plates) {
    n.push_back(bekker_wong::fit_plates(set, bekker_wong::PlateExponent::common).exponent);
    for (const bekker_wong::PlateCurve& curve : set)
      sums.push_back(bekker_wong::sums_of(curve)), xi_n.push_back(xi_n_of(curve));
  }
  fit.soil.exponent = mean_of(n);
  fit.soil.reference_sinkage = bekker_wong::reference_sinkage(sums);
  fit.xi_n = {mean_of(xi_n).value, spread_of(xi_n)};
  // k_c and k_phi mean something at one exponent only: all sets at the mean one.
  for (const PlateSet& set : plates) {
    const bekker_wong::PlateFit at = bekker_wong::fit_plates_at(set, fit.soil.exponent.value);
    k_c.push_back(at.k_c), k_phi.push_back(at.k_phi);
  }
  fit.soil.k_c = mean_of(k_c), fit.soil.k_phi = mean_of(k_phi);
  std::vector<ShearTop> tops;
  for (const ShearCurve& curve : shear) {
    fit.shear.push_back(fit_janosi(curve));
    modulus.push_back(fit.shear.back().modulus);
    tops.push_back({curve.normal_stress, fit.shear.back().shear_max});
  }
  fit.soil.shear_modulus = mean_of(modulus);
  const ShearStrength strength = strength_of(tops);
  fit.cohesion_as_fitted = strength.cohesion.value;
  fit.soil.cohesion = {std::max(0.0, strength.cohesion.value), strength.cohesion.std_error};
  fit.soil.friction_angle = strength.friction_angle;
  fit.pressure_error = pressure_error(plates, fit);
  return fit;
}

Soil with_bevameter(Soil soil, const BevameterFit& fit, double density, const std::string& source) {
  const bool known = soil.semi_empirical.has_value();
  SemiEmpiricalSoil out = known ? *soil.semi_empirical : SemiEmpiricalSoil{};
  if (!known) {
    out.stress_angle_c1 = {0.18, 0.1}, out.stress_angle_c2 = {0.32, 0.15};
    for (const char* key : {"stress_angle_c1", "stress_angle_c2"})
      out.sources[key] = "chosen: as Azimi et al. 2013 take for sand; a bevameter does not tell it";
  }
  for (const SoilParameter& p : bevameter_parameters) out.*p.value = fit.soil.*p.value, out.sources[p.name] = source;
  out.density = density, out.sources["density"] = source;
  out.reference_sinkage = fit.soil.reference_sinkage;
  check_numbers(out);
  if (fit.cohesion_as_fitted < 0) out.sources["cohesion"] += "; fitted below 0, taken as 0";
  soil.semi_empirical = out;
  if (!(fit.xi_n.value > 0.0)) throw InputError("the plates bear nothing that grows with their sinkage");
  constexpr double friction_sd = 0.1;
  soil.resistive_force = {.xi_n = fit.xi_n,
                          .surface_friction = {std::tan(2.0 / 3.0 * out.friction_angle.value), friction_sd},
                          .sources = {{"xi_n", source}, {"surface_friction", "chosen: two thirds of friction_angle"}}};
  soil.beds.clear(), soil.bed_density.reset();
  return soil;
}

}  // namespace soilbin::compare
