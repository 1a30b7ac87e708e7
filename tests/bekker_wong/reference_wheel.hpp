// The base model a second time, for the tests: written from docs/reference/conventions.md alone, in extended precision,
// with Boost.Math's tanh-sinh quadrature and TOMS 748 root. Slow and plain; it shares no code with bekker_wong/.
#pragma once

#include "bekker_wong/contact_patch.hpp"
#include "scenario/operating_condition.hpp"
#include "scenario/tire.hpp"

namespace soilbin::reference {

using Real = long double;

/// Stress integrals at one entry angle, in the wheel's axes [N, N m], and what they would be if nothing cancelled.
struct Forces {
  Real forward = 0, side = 0, vertical = 0, torque = 0;
  Real gross_force = 0;   ///< r b Int (sigma sin + |tau_x| cos + |tau_y|) d theta: resistance + thrust + side
  Real gross_torque = 0;  ///< r^2 b Int |tau_x| d theta
};

/// The four results, with the scale against which an error of each is to be judged.
struct Answer {
  Real theta_1 = 0, sinkage = 0, drawbar_pull = 0, torque = 0, lateral_force = 0;
  Real force_scale = 0, torque_scale = 0;
};

class Wheel {
 public:
  Wheel(const Tire& tire, const bekker_wong::SoilValues& soil, const OperatingCondition& at);

  /// The wheel pressed in to entry angle theta_1 [rad], balanced or not; quadrature to rel_tol.
  Forces at(Real theta_1, Real rel_tol = 1e-15L) const;
  Real carried(Real theta_1, Real rel_tol = 1e-15L) const;

  /// d ln(carried)/d ln(theta_1): small where the balance is ill-conditioned.
  Real growth(Real theta_1) const;

  /// Smallest entry angle in 0.01 .. deepest that carries normal_load, from a scan upward in steps of 3 %
  /// (driven: 15 %); 0: none.
  Real entry_angle(Real normal_load, Real deepest) const;

  /// The balanced wheel. Throws std::runtime_error where no sinkage up to 0.9 r carries the load.
  Answer roll() const;

 private:
  struct Point;  // stresses at one angle
  Real integrate(Real theta_1, Real rel_tol, const auto& integrand) const;
  Point stress(Real theta, Real since_entry, Real since_exit, Real theta_1) const;
  Real displacement_x(Real since_entry, Real theta_1) const;
  Real reversal(Real theta_1) const;

  Real r_, b_, k_, n_, cohesion_, friction_, shear_modulus_, theta_m_share_;
  Real load_, yaw_, incline_, cross_slope_;
  Real rate_x_ = 1, rate_y_ = 0;  ///< v_x/(r w), v_y/(r w); of a locked wheel only their ratio counts
  bool locked_ = false;
};

}  // namespace soilbin::reference
