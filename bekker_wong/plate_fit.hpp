// Bekker's n, k_c and k_phi from plates pressed into the soil: p = (k_c/b + k_phi) z^n, b: the plate's radius or
// the width of a strip. Wong's method: logarithms weighted by p^2, so that the fit is close in pressure (Wong 1980,
// J. Terramechanics 17(1):13; as Oravec 2009, Case Western Reserve University, applied it).
//
//   const std::vector<PlateCurve> plates{{0.05, {20e3, 40e3, 60e3}, {0.0167, 0.0333, 0.05}},  // b [m], p [Pa], z [m]
//                                        {0.10, {20e3, 40e3, 60e3}, {0.0182, 0.0364, 0.0545}}};
//   const PlateFit fit = fit_plates(plates);
//   fit.exponent, fit.k_c, fit.k_phi  // about 1, 10 kN/m^2, 1 MN/m^3 (in SI)
#pragma once

#include <span>
#include <vector>

namespace soilbin::bekker_wong {

/// One plate pressed in once.
struct PlateTest {
  double radius = 0.0;           ///< b [m]
  std::vector<double> pressure;  ///< [Pa], strictly increasing, at least four
  std::vector<double> sinkage;   ///< [m], as many
};

/// Sinkage as a function of pressure for one plate; no zeros.
struct PlateCurve {
  double radius = 0.0;           ///< b [m]
  std::vector<double> pressure;  ///< [Pa]
  std::vector<double> sinkage;   ///< [m]
};

/// Pressures at which repeats are compared: first, first + step, .., last [Pa].
struct PressureGrid {
  double first = 0.0, step = 0.0, last = 0.0;
};

/// Mean of repeats with one plate: each one's sinkage by a not-a-knot cubic spline over its pressure, averaged at the
/// grid's pressures; points where the mean is not above zero are left out. A grid that ends beyond a test continues its
/// last piece. Throws InputError for plates of different radii or for a test the spline cannot take.
PlateCurve mean_curve(std::span<const PlateTest> repeats, const PressureGrid& grid);

/// How one exponent comes from several plates.
enum class PlateExponent {
  mean_of_plates,  ///< each plate's own exponent, averaged (Wong)
  common,          ///< one exponent for all in one regression
};

struct PlateFit {
  double exponent = 0.0;  ///< n [-]
  double k_c = 0.0;       ///< [N/m^(n+1)]
  double k_phi = 0.0;     ///< [N/m^(n+2)]; may come out negative where the plates disagree with Bekker's form
  std::vector<double> plate_exponents;  ///< of each plate by itself
  std::vector<double> plate_moduli;     ///< k of each plate at the exponent above [N/m^(n+2)]
};

/// All that a fit needs of a curve: means of ln z and ln p, and sums about them, with weights p^2.
struct PlateSums {
  double radius = 0.0;            ///< b [m]
  double ln_z = 0.0, ln_p = 0.0;  ///< means of ln(z / 1 m), ln(p / 1 Pa)
  double zz = 0.0, zp = 0.0;      ///< sums of squares of ln z and of products with ln p [Pa^2]
  double pp = 0.0, weight = 0.0;  ///< of squares of ln p, and of the weights [Pa^2]
  double exponent() const { return zp / zz; }
  /// k [N/m^(n+2)] at an exponent.
  double modulus(double exponent) const;
};

/// Throws InputError for a curve of fewer than two points, of sinkages that are all the same, or of numbers that are
/// not above 0.
PlateSums sums_of(const PlateCurve& curve);

/// Geometric mean over the curves of the sinkage at which a curve's pressure tells nothing of its n [m].
double reference_sinkage(std::span<const PlateSums> curves);

/// n of all curves: each one's own, averaged, or one of a common regression.
double exponent_of(std::span<const PlateSums> curves, PlateExponent exponent);

/// Fits n by least squares in logarithms with weights p^2, each plate's modulus at that n, then k_c and k_phi by a
/// plain line through the moduli over 1/b. Throws InputError for fewer than two radii, or as sums_of does.
PlateFit fit_plates(std::span<const PlateCurve> curves, PlateExponent exponent = PlateExponent::mean_of_plates);

/// Fits plates at a given exponent: each plate's modulus, then k_c and k_phi.
PlateFit fit_plates_at(std::span<const PlateCurve> curves, double exponent);
PlateFit fit_plates_at(std::span<const PlateSums> curves, double exponent);

}  // namespace soilbin::bekker_wong
