// The one place where GSL is called: owners that free themselves, errors that become exceptions with context.
#pragma once

#include <functional>
#include <span>
#include <string>

namespace soilbin::gsl {

/// Non-owning reference to a callable double(double); lives no longer than the call it is passed to.
class FunctionRef {
 public:
  template <class F>
  FunctionRef(const F& f)  // NOLINT(google-explicit-constructor): a parameter type
      : object_(&f), call_([](const void* o, double x) { return (*static_cast<const F*>(o))(x); }) {}
  double operator()(double x) const { return call_(object_, x); }

 private:
  const void* object_;
  double (*call_)(const void*, double);
};

/// Nodes and weights of the n-point Gauss-Legendre rule on [0, 1] (gsl_integration_glfixed).
/// Built once per n and kept for the life of the program; n from 2 to 128.
struct LegendreRule {
  std::span<const double> nodes;
  std::span<const double> weights;
};
LegendreRule legendre_rule(int n);

/// A point of a curve.
struct Sample {
  double x = 0.0, f = 0.0;
};

/// Root of a continuous f bracketed by f(lower) <= 0 <= f(upper) or the reverse, by Brent's method
/// (gsl_root_fsolver_brent): done where |f| <= f_tol or the bracket is narrower than rel_tol of the root. Throws
/// std::domain_error with `what` where the bracket holds no change of sign or f is not finite.
double bracketed_root(FunctionRef f, double lower, double upper, double rel_tol, double f_tol, const std::string& what);
/// Where f is known at both ends, in either order: it is not asked there again.
double bracketed_root(FunctionRef f, const Sample& end, const Sample& other, double rel_tol, double f_tol,
                      const std::string& what);

/// Three points of a curve from left to right, between which its highest one lies where `top` is higher than the
/// others.
struct MaximumBracket {
  Sample before, top, after;
};

/// Highest point of a continuous f within a bracket, by Brent's method (gsl_min_fminimizer_brent): done where x is
/// known to x_tol or 6e-8 |x|, or f reaches `enough`; `top` itself where it is not higher than both. Throws
/// std::domain_error with `what` where f is not finite.
Sample bracketed_maximum(FunctionRef f, const MaximumBracket& within, double x_tol, double enough,
                         const std::string& what);

/// Integral over [a, b] by QAGS to rel_tol. Throws std::runtime_error with `what` where it does not converge.
double integrate(FunctionRef f, double a, double b, double rel_tol, const std::string& what);

/// Chance of a larger value: of F with these degrees of freedom, of chi square, of a standard normal variable.
double f_tail(double f, double freedom, double error_freedom);
double chi_square_tail(double chi_square, double freedom);
double normal_tail(double z);
/// By how much wider than a known standard deviation one is that so many degrees of freedom tell, such that it covers
/// as often (68.27 %): 1.84 of one degree, 1.14 of four (gsl_cdf_tdist_Pinv).
double student_factor(double freedom);

/// A function of many variables with its gradient: fills `gradient`, gives the value; may give infinity.
using Slope = std::function<double(std::span<const double> x, std::span<double> gradient)>;

/// Goes downhill from x by BFGS (gsl_multimin_fdfminimizer_vector_bfgs2) until the gradient's norm is below
/// gradient_tol, no step gets lower, or after `steps`. x ends at the lowest point found; gives the value there.
double minimise(const Slope& f, std::span<double> x, double gradient_tol, int steps);

}  // namespace soilbin::gsl
