// The one place where SUNDIALS is called: owners that free themselves, errors that become exceptions with context.
#pragma once

#include <functional>
#include <memory>
#include <span>
#include <vector>

namespace soilbin::sundials {

/// dy/dt = rate(t, y), with what is to be watched and summed on the way. Callbacks may throw: the exception leaves
/// Integrator::advance.
struct Problem {
  using Function = std::function<void(double t, std::span<const double> y, std::span<double> out)>;
  Function rate;
  Function roots;  ///< where one of these changes sign, advance stops
  int root_count = 0;
  Function summands;  ///< integrated beside the state, within the same tolerance
  int sum_count = 0;
  double relative_tolerance = 1e-6;
  std::vector<double> absolute_tolerances;  ///< one a state
  double sum_tolerance = 1e-9;              ///< absolute, of the sums
  double longest_step = 0.0;                ///< [s]; 0: any
};

/// Why advance came back.
struct Stop {
  double time = 0.0;
  std::vector<int> signs;  ///< a root: -1 falling, 1 rising, 0 none; empty where the time asked for was reached
  bool at_root() const { return !signs.empty(); }
};

/// Variable-order BDF with Newton's method and a dense difference-quotient Jacobian: CVODES (Hindmarsh et al. 2005, ACM
/// Trans. Math. Softw. 31:363). Not to be copied.
class Integrator {
 public:
  Integrator(Problem problem, double start, std::vector<double> state);
  ~Integrator();
  Integrator(const Integrator&) = delete;
  Integrator& operator=(const Integrator&) = delete;

  /// Goes on to `until` or the first root before it. Throws std::runtime_error with the time and CVODES' own words
  /// where the step size collapses or the corrector doesn't converge.
  Stop advance(double until);

  /// Begins anew at the present time and state: after the rate's form has changed. Sums go on.
  void restart();
  /// Begins anew at the present time from another state, as behind an impact or where axes turn about. Sums go on.
  void restart(const std::vector<double>& state);

  const std::vector<double>& state() const;
  const std::vector<double>& sums() const;

 private:
  struct Body;
  std::unique_ptr<Body> body_;
};

}  // namespace soilbin::sundials
