#include "bekker_wong/transient/cvodes.hpp"

#include <cvodes/cvodes.h>
#include <fmt/core.h>
#include <nvector/nvector_serial.h>
#include <sundials/sundials_context.h>
#include <sunlinsol/sunlinsol_dense.h>
#include <sunmatrix/sunmatrix_dense.h>

#include <algorithm>
#include <exception>
#include <new>
#include <stdexcept>
#include <utility>

namespace soilbin::sundials {
namespace {

// What SUNDIALS 6 (Debian 12) and 7 (Debian 13) have by different names. Errors come back as statuses and as the
// callbacks' exceptions, so neither prints any.
#if SUNDIALS_VERSION_MAJOR >= 7
SUNErrCode create(SUNContext* context) {
  const SUNErrCode status = SUNContext_Create(SUN_COMM_NULL, context);
  return status == SUN_SUCCESS ? SUNContext_ClearErrHandlers(*context) : status;
}
int print_nothing(void*) { return CV_SUCCESS; }
#else
int create(SUNContext* context) { return SUNContext_Create(nullptr, context); }
int print_nothing(void* cvodes) {
  return CVodeSetErrHandlerFn(
      cvodes, [](int, const char*, const char*, char*, void*) {}, nullptr);
}
#endif

struct Context {
  Context() {
    if (create(&handle) != 0) throw std::runtime_error("SUNDIALS gives no context");
  }
  Context(const Context&) = delete;
  Context& operator=(const Context&) = delete;
  ~Context() { SUNContext_Free(&handle); }
  SUNContext handle = nullptr;
};

template <auto Free>
struct Freed {
  template <class T>
  void operator()(T* p) const {
    Free(p);
  }
};
void free_memory(void* memory) { CVodeFree(&memory); }

using Vector = std::unique_ptr<_generic_N_Vector, Freed<N_VDestroy>>;
using Matrix = std::unique_ptr<_generic_SUNMatrix, Freed<SUNMatDestroy>>;
using LinearSolver = std::unique_ptr<_generic_SUNLinearSolver, Freed<SUNLinSolFree>>;
struct Memory {
  explicit Memory(void* p) : handle(p) {}
  Memory(const Memory&) = delete;
  Memory& operator=(const Memory&) = delete;
  ~Memory() { free_memory(handle); }
  void* handle;
};

template <class T>
T* made(T* p) {
  if (p == nullptr) throw std::bad_alloc();
  return p;
}

Vector vector_of(const std::vector<double>& values, SUNContext context) {
  Vector v(made(N_VNew_Serial(static_cast<sunindextype>(values.size()), context)));
  std::copy(values.begin(), values.end(), N_VGetArrayPointer(v.get()));
  return v;
}

std::span<double> all_of(N_Vector v) {
  return {N_VGetArrayPointer(v), static_cast<std::size_t>(N_VGetLength_Serial(v))};
}

void check(int status, const char* what) {
  if (status < 0) throw std::runtime_error(fmt::format("CVODES: {} gives status {}", what, status));
}

}  // namespace

struct Integrator::Body {
  Body(Problem given, double start, std::vector<double> y);
  /// Runs a callback; an exception is kept for advance and ends the integration.
  template <class Call>
  int guarded(const Call& call) {
    try {
      call();
      return 0;
    } catch (...) {
      thrown = std::current_exception();
      return -1;
    }
  }

  static int rate(sunrealtype t, N_Vector y, N_Vector ydot, void* self) {
    Body& b = *static_cast<Body*>(self);
    return b.guarded([&] { b.problem.rate(t, all_of(y), all_of(ydot)); });
  }
  static int roots(sunrealtype t, N_Vector y, sunrealtype* out, void* self) {
    Body& b = *static_cast<Body*>(self);
    return b.guarded([&] { b.problem.roots(t, all_of(y), {out, static_cast<std::size_t>(b.problem.root_count)}); });
  }
  static int summands(sunrealtype t, N_Vector y, N_Vector out, void* self) {
    Body& b = *static_cast<Body*>(self);
    return b.guarded([&] { b.problem.summands(t, all_of(y), all_of(out)); });
  }

  Problem problem;
  Context context;
  std::vector<double> state, sum_values;
  double time;
  Vector y, tolerances, sums;
  Matrix jacobian;
  LinearSolver solver;
  Memory memory;
  std::exception_ptr thrown;
};

Integrator::Body::Body(Problem given, double start, std::vector<double> initial)
    : problem(std::move(given)),
      state(std::move(initial)),
      sum_values(static_cast<std::size_t>(problem.sum_count), 0.0),
      time(start),
      y(vector_of(state, context.handle)),
      tolerances(vector_of(problem.absolute_tolerances, context.handle)),
      sums(vector_of(sum_values, context.handle)),
      jacobian(made(SUNDenseMatrix(static_cast<sunindextype>(state.size()), static_cast<sunindextype>(state.size()),
                                   context.handle))),
      solver(made(SUNLinSol_Dense(y.get(), jacobian.get(), context.handle))),
      memory(made(CVodeCreate(CV_BDF, context.handle))) {
  void* m = memory.handle;
  check(print_nothing(m), "the error handler");
  check(CVodeInit(m, rate, start, y.get()), "the start");
  check(CVodeSetUserData(m, this), "the user data");
  check(CVodeSVtolerances(m, problem.relative_tolerance, tolerances.get()), "the tolerances");
  check(CVodeSetLinearSolver(m, solver.get(), jacobian.get()), "the linear solver");
  constexpr long most_steps = 200'000;
  check(CVodeSetMaxNumSteps(m, most_steps), "the most steps");
  if (problem.longest_step > 0.0) check(CVodeSetMaxStep(m, problem.longest_step), "the longest step");
  if (problem.root_count > 0) check(CVodeRootInit(m, problem.root_count, roots), "the roots");
  if (problem.sum_count > 0) {
    check(CVodeQuadInit(m, summands, sums.get()), "the sums");
    check(CVodeQuadSStolerances(m, problem.relative_tolerance, problem.sum_tolerance), "the sums' tolerances");
    check(CVodeSetQuadErrCon(m, 1), "the sums' error control");
  }
}

/// In words, for the statuses that an integration ends with.
const char* why_stopped(int status) {
  switch (status) {
    case CV_TOO_MUCH_WORK:
      return "it would take more steps in time than are allowed";
    case CV_TOO_MUCH_ACC:
      return "the accuracy that is asked for is more than its numbers hold";
    case CV_ERR_FAILURE:
    case CV_SRHSFUNC_FAIL:
      return "its steps in time became too short to go on";
    case CV_CONV_FAILURE:
    case CV_LSETUP_FAIL:
    case CV_LSOLVE_FAIL:
      return "the forces change too abruptly there for a step in time to be solved";
    default:
      return "its forces can't be had there";
  }
}

Integrator::Integrator(Problem problem, double start, std::vector<double> state)
    : body_(std::make_unique<Body>(std::move(problem), start, std::move(state))) {}
Integrator::~Integrator() = default;

Stop Integrator::advance(double until) {
  Body& b = *body_;
  sunrealtype reached = b.time;
  const int status = CVode(b.memory.handle, until, b.y.get(), &reached, CV_NORMAL);
  if (b.thrown) std::rethrow_exception(std::exchange(b.thrown, nullptr));
  if (status < 0)
    throw std::runtime_error(
        fmt::format("the motion can't be followed beyond {:.6g} s: {}\n  hint: a gentler motor, way or soil there",
                    reached, why_stopped(status)));
  b.time = reached;
  const std::span<const double> y = all_of(b.y.get());
  b.state.assign(y.begin(), y.end());
  if (b.problem.sum_count > 0) {
    sunrealtype at = 0.0;
    check(CVodeGetQuad(b.memory.handle, &at, b.sums.get()), "reading the sums");
    const std::span<const double> sums = all_of(b.sums.get());
    b.sum_values.assign(sums.begin(), sums.end());
  }
  Stop stop{reached, {}};
  if (status == CV_ROOT_RETURN) {
    stop.signs.resize(static_cast<std::size_t>(b.problem.root_count));
    check(CVodeGetRootInfo(b.memory.handle, stop.signs.data()), "reading the roots");
  }
  return stop;
}

void Integrator::restart() {
  Body& b = *body_;
  check(CVodeReInit(b.memory.handle, b.time, b.y.get()), "the new start");
  if (b.problem.sum_count > 0) check(CVodeQuadReInit(b.memory.handle, b.sums.get()), "the sums' new start");
}

void Integrator::restart(const std::vector<double>& state) {
  Body& b = *body_;
  b.state = state;
  std::ranges::copy(state, all_of(b.y.get()).begin());
  restart();
}

const std::vector<double>& Integrator::state() const { return body_->state; }
const std::vector<double>& Integrator::sums() const { return body_->sum_values; }

}  // namespace soilbin::sundials
