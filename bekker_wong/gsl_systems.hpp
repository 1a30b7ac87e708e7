// Systems of nonlinear equations by GSL; beside gsl.hpp, whose file alone calls the library.
//
//   const gsl::SystemRoot root = gsl::system_root(f, {1.0, 0.0}, 1e-12);
//   if (root.residual < 1e-9) root.x;   // f(root.x) = 0
#pragma once

#include <functional>
#include <span>
#include <vector>

namespace soilbin::gsl {

/// As many equations as unknowns: fills `f` at x. May throw, which ends the search with that exception.
using Equations = std::function<void(std::span<const double> x, std::span<double> f)>;

struct SystemRoot {
  std::vector<double> x;
  double residual = 0.0;  ///< largest |f| there
};

/// Looks for a root from a point nearby by Powell's hybrid method with differences in place of derivatives
/// (gsl_multiroot_fsolver_hybrids), which wants unknowns and equations that are all of the order of 1. Ends where every
/// |f| is at most `tol`, or where no step gets closer: `residual` tells which. A start that is good enough is given
/// back as it is.
SystemRoot system_root(const Equations& equations, std::vector<double> start, double tol);

}  // namespace soilbin::gsl
