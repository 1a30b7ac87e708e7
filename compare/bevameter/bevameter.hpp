// The bevameter: from plates and sheared rings, measured or simulated, to the values of the Bekker / Wong-Reece model.
//
//   const BevameterFit fit = fit_bevameter(plates, rings);
//   fit.soil.k_phi.value, fit.soil.friction_angle.std_error  // [SI]
#pragma once

#include <span>
#include <vector>

#include "bekker_wong/plate_fit.hpp"
#include "scenario/soil_parameters.hpp"

namespace soilbin::compare {

/// One set of plates on one specimen of the soil: curves of two radii or more.
using PlateSet = std::vector<bekker_wong::PlateCurve>;

/// xi_n of resistive force theory [N/m^3] by one plate: the slope through the origin that its pressures have over
/// sinkage, by least squares, over plate_response().
double xi_n_of(const bekker_wong::PlateCurve& curve);

/// A ring or plate sheared under one normal stress.
struct ShearCurve {
  double normal_stress = 0;          ///< [Pa]
  std::vector<double> displacement;  ///< j [m], above 0
  std::vector<double> shear_stress;  ///< [Pa], as many
};

/// tau = tau_max (1 - exp(-j/K)) (Janosi and Hanamoto 1961).
struct JanosiFit {
  double shear_max = 0;  ///< tau_max [Pa]
  double modulus = 0;    ///< K [m]
  double rms = 0;        ///< of what is left [Pa]
};

/// Least squares in tau; K is searched between a hundredth of the first displacement and ten times the last. Throws
/// InputError for fewer than four points or displacements that are not above 0.
JanosiFit fit_janosi(const ShearCurve& curve);

/// What a soil bears in shear under a normal stress [Pa].
struct ShearTop {
  double normal_stress = 0.0, shear_max = 0.0;
};

struct ShearStrength {
  Estimate cohesion, friction_angle;  ///< [Pa], [rad]
};

/// The line through tau_max over the normal stress, every test of equal relative weight (1/sigma^2: errors of strength
/// grow with it); errors by the scatter about it, 0 for two tests. Throws InputError for tests of one normal stress.
ShearStrength strength_of(std::span<const ShearTop> tops);

struct BevameterFit {
  SemiEmpiricalSoil soil;         ///< bevameter_parameters of it alone
  double cohesion_as_fitted = 0;  ///< c before it was cut off at 0 [Pa]
  double pressure_error = 0;      ///< root mean square of Bekker's form against all plates' points, over their mean
  std::vector<JanosiFit> shear;   ///< of each curve
  Estimate xi_n;  ///< mean over all plates [N/m^3], and their standard deviation: the theory's plates are all alike
};

/// n, k_c and k_phi: means over the sets, each fitted by fit_plates with a common exponent, with the standard errors of
/// these means; so two sets or more, or their errors are 0. c and phi: a line through tau_max over the normal stress,
/// every curve of equal relative weight, errors by the scatter about it. K: mean over the curves, with its error.
/// A cohesion below 0 is given as 0, since the model takes no other. Throws InputError.
BevameterFit fit_bevameter(std::span<const PlateSet> plates, std::span<const ShearCurve> shear);

/// The soil with these values as its semi-empirical part and, for resistive force theory, xi_n with a surface friction
/// of the tangent of two thirds of phi, +- 0.1. What a bevameter does not tell (c1, c2) stays as it was, or is Azimi's
/// choice for sand where there was nothing; `source` is noted at each number that comes from the fit. Throws InputError
/// for a value that no soil's file may hold, such as a friction angle below 0.
Soil with_bevameter(Soil soil, const BevameterFit& fit, double density, const std::string& source);

}  // namespace soilbin::compare
