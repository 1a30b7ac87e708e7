#include "bekker_wong/gsl.hpp"

#include <gsl/gsl_cdf.h>
#include <gsl/gsl_errno.h>
#include <gsl/gsl_integration.h>
#include <gsl/gsl_min.h>
#include <gsl/gsl_multimin.h>
#include <gsl/gsl_multiroots.h>
#include <gsl/gsl_roots.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <exception>
#include <limits>
#include <memory>
#include <mutex>
#include <stdexcept>
#include <utility>
#include <vector>

#include "bekker_wong/gsl_systems.hpp"

namespace soilbin::gsl {
namespace {

/// GSL's default handler aborts the program; ours leaves the status to the caller. Set once, before main's work.
const bool handler_off = [] {
  gsl_set_error_handler_off();
  return true;
}();

template <auto Free>
struct Freed {
  template <class T>
  void operator()(T* p) const {
    Free(p);
  }
};
using RootSolver = std::unique_ptr<gsl_root_fsolver, Freed<gsl_root_fsolver_free>>;
using LegendreTable = std::unique_ptr<gsl_integration_glfixed_table, Freed<gsl_integration_glfixed_table_free>>;
using Workspace = std::unique_ptr<gsl_integration_workspace, Freed<gsl_integration_workspace_free>>;

gsl_function as_gsl(FunctionRef& f) {
  return {[](double x, void* o) { return (*static_cast<FunctionRef*>(o))(x); }, &f};
}

/// A thread's solver, lent for one search: a function may itself look for a root.
class LentSolver {
 public:
  LentSolver() {
    if (idle().empty()) idle().emplace_back(gsl_root_fsolver_alloc(gsl_root_fsolver_brent));
    solver_ = std::move(idle().back());
    idle().pop_back();
    if (!solver_) throw std::bad_alloc();
  }
  LentSolver(const LentSolver&) = delete;
  LentSolver& operator=(const LentSolver&) = delete;
  ~LentSolver() { idle().push_back(std::move(solver_)); }
  gsl_root_fsolver* get() const { return solver_.get(); }

 private:
  static std::vector<RootSolver>& idle() {
    thread_local std::vector<RootSolver> solvers;
    return solvers;
  }
  RootSolver solver_;
};

constexpr int max_rule = 128;
struct StoredRule {
  std::once_flag once;
  std::vector<double> nodes, weights;
};

void build(StoredRule& rule, int n) {
  const LegendreTable table(gsl_integration_glfixed_table_alloc(static_cast<size_t>(n)));
  if (!table) throw std::bad_alloc();
  for (int i = 0; i < n; ++i) {
    double node = 0.0, weight = 0.0;
    gsl_integration_glfixed_point(0.0, 1.0, static_cast<size_t>(i), &node, &weight, table.get());
    rule.nodes.push_back(node);
    rule.weights.push_back(weight);
  }
}

}  // namespace

LegendreRule legendre_rule(int n) {
  static std::array<StoredRule, max_rule + 1> rules;
  if (n < 2 || n > max_rule) throw std::invalid_argument("legendre_rule: n must be 2 .. 128");
  StoredRule& rule = rules[static_cast<size_t>(n)];
  std::call_once(rule.once, build, rule, n);
  return {rule.nodes, rule.weights};
}

double bracketed_root(FunctionRef f, double lower, double upper, double rel_tol, double f_tol,
                      const std::string& what) {
  const LentSolver solver;
  double best = lower, best_f = std::numeric_limits<double>::infinity();
  const auto noted = [&](double x) {
    const double y = f(x);
    if (std::abs(y) < best_f) best = x, best_f = std::abs(y);
    return y;
  };
  FunctionRef watched(noted);
  gsl_function g = as_gsl(watched);
  if (const int status = gsl_root_fsolver_set(solver.get(), &g, lower, upper); status != GSL_SUCCESS)
    throw std::domain_error(what + ": " + gsl_strerror(status));
  constexpr int max_iterations = 200;
  for (int i = 0; i < max_iterations; ++i) {
    if (best_f <= f_tol) return best;
    if (const int status = gsl_root_fsolver_iterate(solver.get()); status != GSL_SUCCESS)
      throw std::domain_error(what + ": " + gsl_strerror(status));
    const double a = gsl_root_fsolver_x_lower(solver.get()), b = gsl_root_fsolver_x_upper(solver.get());
    if (gsl_root_test_interval(a, b, 0.0, rel_tol) == GSL_SUCCESS) return gsl_root_fsolver_root(solver.get());
  }
  throw std::domain_error(what + ": no convergence in 200 iterations");
}

double bracketed_root(FunctionRef f, const Sample& end, const Sample& other, double rel_tol, double f_tol,
                      const std::string& what) {
  const auto known = [&](double x) { return x == end.x ? end.f : x == other.x ? other.f : f(x); };
  return bracketed_root(known, std::min(end.x, other.x), std::max(end.x, other.x), rel_tol, f_tol, what);
}

Sample bracketed_maximum(FunctionRef f, const MaximumBracket& within, double x_tol, double enough,
                         const std::string& what) {
  const auto& [before, highest, after] = within;
  Sample top = highest;
  for (const Sample& side : {before, after}) {
    if (top.f != side.f) continue;  // as high: higher between the two, or nowhere
    const double between = 0.5 * (top.x + side.x), value = f(between);
    if (value > top.f) top = {between, value};
  }
  if (!(top.f > before.f && top.f > after.f)) return top;
  using Minimiser = std::unique_ptr<gsl_min_fminimizer, Freed<gsl_min_fminimizer_free>>;
  const Minimiser minimiser(gsl_min_fminimizer_alloc(gsl_min_fminimizer_brent));
  if (!minimiser) throw std::bad_alloc();
  const auto turned = [&](double x) { return -f(x); };
  FunctionRef down(turned);
  gsl_function g = as_gsl(down);
  if (const int status = gsl_min_fminimizer_set_with_values(minimiser.get(), &g, top.x, -top.f, before.x, -before.f,
                                                            after.x, -after.f);
      status != GSL_SUCCESS)
    throw std::domain_error(what + ": " + gsl_strerror(status));
  constexpr double rel_tol = 4 * GSL_SQRT_DBL_EPSILON;  // its steps are not shorter than a quarter of that
  constexpr int max_iterations = 100;
  for (int i = 0; i < max_iterations && top.f < enough; ++i) {
    if (const int status = gsl_min_fminimizer_iterate(minimiser.get()); status != GSL_SUCCESS)
      throw std::domain_error(what + ": " + gsl_strerror(status));
    top = {gsl_min_fminimizer_x_minimum(minimiser.get()), -gsl_min_fminimizer_f_minimum(minimiser.get())};
    const double a = gsl_min_fminimizer_x_lower(minimiser.get()), b = gsl_min_fminimizer_x_upper(minimiser.get());
    if (gsl_min_test_interval(a, b, x_tol, rel_tol) == GSL_SUCCESS) break;
  }
  return top;
}

double integrate(FunctionRef f, double a, double b, double rel_tol, const std::string& what) {
  constexpr size_t intervals = 1000;
  thread_local const Workspace workspace(gsl_integration_workspace_alloc(intervals));
  gsl_function g = as_gsl(f);
  double value = 0.0, error = 0.0;
  const int status = gsl_integration_qags(&g, a, b, 0.0, rel_tol, intervals, workspace.get(), &value, &error);
  if (status != GSL_SUCCESS) throw std::runtime_error(what + ": " + gsl_strerror(status));
  return value;
}

double f_tail(double f, double freedom, double error_freedom) { return gsl_cdf_fdist_Q(f, freedom, error_freedom); }
double chi_square_tail(double chi_square, double freedom) { return gsl_cdf_chisq_Q(chi_square, freedom); }
double normal_tail(double z) { return gsl_cdf_ugaussian_Q(z); }

double student_factor(double freedom) { return gsl_cdf_tdist_Pinv(gsl_cdf_ugaussian_P(1.0), freedom); }

double minimise(const Slope& f, std::span<double> x, double gradient_tol, int steps) {
  using Minimiser = std::unique_ptr<gsl_multimin_fdfminimizer, Freed<gsl_multimin_fdfminimizer_free>>;
  struct Called {
    const Slope& f;
    std::vector<double> unused;
    static double both(const gsl_vector* at, void* o, gsl_vector* gradient) {
      Called& called = *static_cast<Called*>(o);
      double* into = gradient != nullptr ? gradient->data : called.unused.data();
      return called.f({at->data, at->size}, {into, at->size});
    }
  } called{f, std::vector<double>(x.size())};
  gsl_multimin_function_fdf function{
      [](const gsl_vector* at, void* o) { return Called::both(at, o, nullptr); },
      [](const gsl_vector* at, void* o, gsl_vector* g) { Called::both(at, o, g); },
      [](const gsl_vector* at, void* o, double* value, gsl_vector* g) { *value = Called::both(at, o, g); }, x.size(),
      &called};
  const Minimiser minimiser(gsl_multimin_fdfminimizer_alloc(gsl_multimin_fdfminimizer_vector_bfgs2, x.size()));
  const gsl_vector_view start = gsl_vector_view_array(x.data(), x.size());
  gsl_multimin_fdfminimizer_set(minimiser.get(), &function, &start.vector, 0.1, 0.1);
  for (int step = 0; step < steps; ++step) {
    if (gsl_multimin_fdfminimizer_iterate(minimiser.get()) != GSL_SUCCESS) break;
    if (gsl_multimin_test_gradient(minimiser->gradient, gradient_tol) == GSL_SUCCESS) break;
  }
  std::copy_n(minimiser->x->data, x.size(), x.begin());
  return minimiser->f;
}

SystemRoot system_root(const Equations& equations, std::vector<double> start, double tol) {
  using Solver = std::unique_ptr<gsl_multiroot_fsolver, Freed<gsl_multiroot_fsolver_free>>;
  const std::size_t n = start.size();
  const auto residual_of = [](std::span<const double> f) {
    double largest = 0.0;
    for (const double one : f) largest = std::isfinite(one) ? std::max(largest, std::abs(one)) : HUGE_VAL;
    return largest;
  };
  std::vector<double> f(n);
  equations(start, f);
  if (residual_of(f) <= tol) return {std::move(start), residual_of(f)};
  struct Called {
    const Equations& equations;
    const std::vector<double>*at_start, *start;
    std::exception_ptr thrown{};
  } called{equations, &f, &start};
  gsl_multiroot_function function{[](const gsl_vector* x, void* o, gsl_vector* into) -> int {
                                    Called& call = *static_cast<Called*>(o);
                                    if (const auto* known = std::exchange(call.at_start, nullptr);
                                        known && std::equal(call.start->begin(), call.start->end(), x->data)) {
                                      std::ranges::copy(*known, into->data);
                                      return GSL_SUCCESS;
                                    }
                                    try {
                                      call.equations({x->data, x->size}, {into->data, into->size});
                                      return GSL_SUCCESS;
                                    } catch (...) {  // no exception passes through C
                                      call.thrown = std::current_exception();
                                      return GSL_EBADFUNC;
                                    }
                                  },
                                  n, &called};
  const Solver solver(gsl_multiroot_fsolver_alloc(gsl_multiroot_fsolver_hybrids, n));
  const gsl_vector_view from = gsl_vector_view_array(start.data(), n);
  int status = gsl_multiroot_fsolver_set(solver.get(), &function, &from.vector);
  SystemRoot best{start, residual_of(f)};
  constexpr int most_steps = 100;
  for (int step = 0; step < most_steps && status == GSL_SUCCESS && best.residual > tol; ++step) {
    status = gsl_multiroot_fsolver_iterate(solver.get());
    if (called.thrown) break;
    if (const double residual = residual_of({solver->f->data, n}); residual < best.residual) {
      best.residual = residual;
      best.x.assign(solver->x->data, solver->x->data + n);
    }
  }
  if (called.thrown) std::rethrow_exception(called.thrown);
  return best;
}

}  // namespace soilbin::gsl
