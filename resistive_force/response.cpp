#include "resistive_force/response.hpp"

#include <array>
#include <cmath>

namespace soilbin::resistive_force {
namespace {

constexpr std::size_t terms = 20;
using Coefficients = std::array<double, terms>;

// In the order of the paper's table: 1, x1, x2, x3, x1^2, x2^2, x3^2, x1 x2, x2 x3, x3 x1, x1^3, x2^3, x3^3, x1 x2^2,
// x2 x1^2, x2 x3^2, x3 x2^2, x3 x1^2, x1 x3^2, x1 x2 x3.
constexpr Coefficients c1 = {0.00212,  -0.02320, -0.20890, -0.43083, -0.00259, 0.48872, -0.00415,
                             0.07204,  -0.02750, -0.08772, 0.01992,  -0.45961, 0.40799, -0.10107,
                             -0.06576, 0.05664,  -0.09269, 0.01892,  0.01033,  0.15120};
constexpr Coefficients c2 = {-0.06796, -0.10941, 0.04725, -0.06914, -0.05835, -0.65880, -0.11985,
                             -0.25739, -0.26834, 0.02692, -0.00736, 0.63758,  0.08997,  0.21069,
                             0.04748,  0.20406,  0.18589, 0.04934,  0.13527,  -0.33207};
constexpr Coefficients c3 = {-0.02634, -0.03436, 0.45256, 0.00835,  0.02553, -1.31290, -0.05532,
                             0.06790,  -0.16404, 0.02287, 0.02927,  0.95406, -0.00131, -0.11028,
                             0.01487,  -0.02730, 0.10911, -0.04097, 0.07881, -0.27519};

/// An element that faces less than this down counts as facing up [-].
constexpr double vertical = 1e-9;

}  // namespace

ResponseFits response_fits(double x1, double x2, double x3) {
  const double x11 = x1 * x1, x22 = x2 * x2, x33 = x3 * x3;
  const Coefficients t = {1.0,      x1,       x2,       x3,       x11,      x22,         x33,
                          x1 * x2,  x2 * x3,  x3 * x1,  x1 * x11, x2 * x22, x3 * x33,    x1 * x22,
                          x2 * x11, x2 * x33, x3 * x22, x3 * x11, x1 * x33, x1 * x2 * x3};
  ResponseFits f;
  for (std::size_t k = 0; k < terms; ++k) f.f1 += t[k] * c1[k], f.f2 += t[k] * c2[k], f.f3 += t[k] * c3[k];
  return f;
}

Response response(const Vec3& n, const Vec3& v, const Vec3& up) {
  if (dot(n, v) < -vertical) return {};
  const Vec3 m = dot(n, up) < -vertical ? n : -n;
  const ResponseFits f = response_fits(-dot(v, up), -dot(m, up), dot(m, v));
  const Vec3 generic = f.f1 * m + f.f2 * v - f.f3 * up;
  const double along = dot(generic, n);
  const Vec3 normal = -std::abs(along) * n, tangential = generic - along * n;
  return {normal, dot(tangential, v) > 0.0 ? -tangential : tangential};
}

Vec3 traction(const Response& of, double surface_friction) {
  const double normal = length(of.normal), tangential = length(of.tangential);
  if (tangential <= surface_friction * normal) return of.normal + of.tangential;
  return of.normal + (surface_friction * normal / tangential) * of.tangential;
}

double plate_response() { return length(response({0, 0, -1}, {0, 0, -1}, {0, 0, 1}).normal); }

double estimated_xi_n(double bulk_density, double internal_friction, double gravity) {
  const double mu = internal_friction;
  return bulk_density * gravity * mu * (89.0 + mu * (-386.0 + 894.0 * mu));
}

}  // namespace soilbin::resistive_force
