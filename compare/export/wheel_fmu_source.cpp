#include "compare/export/wheel_fmu.hpp"

namespace soilbin::compare {

const char* const wheel_in_c = R"(
/* ---- What FMI 2.0 declares (fmi2TypesPlatform.h, fmi2FunctionTypes.h), as far as a slave needs it. ---- */

typedef void *fmi2Component, *fmi2ComponentEnvironment, *fmi2FMUstate;
typedef unsigned int fmi2ValueReference;
typedef double fmi2Real;
typedef int fmi2Integer, fmi2Boolean;
typedef char fmi2Byte;
typedef const char *fmi2String;
typedef enum { fmi2OK, fmi2Warning, fmi2Discard, fmi2Error, fmi2Fatal, fmi2Pending } fmi2Status;
typedef enum { fmi2ModelExchange, fmi2CoSimulation } fmi2Type;
typedef enum { fmi2DoStepStatus, fmi2PendingStatus, fmi2LastSuccessfulTime, fmi2Terminated } fmi2StatusKind;
typedef struct {
  void (*logger)(fmi2ComponentEnvironment, fmi2String, fmi2Status, fmi2String, fmi2String, ...);
  void *(*allocateMemory)(size_t, size_t);
  void (*freeMemory)(void *);
  void (*stepFinished)(fmi2ComponentEnvironment, fmi2Status);
  fmi2ComponentEnvironment componentEnvironment;
} fmi2CallbackFunctions;

#if defined(_WIN32)
#define FMU_API __declspec(dllexport)
#elif defined(__GNUC__)
#define FMU_API __attribute__((visibility("default")))
#else
#define FMU_API
#endif
/* Linked into a program, several units tell their functions apart by FMI2_FUNCTION_PREFIX. */
#ifdef FMI2_FUNCTION_PREFIX
#define FMU_PASTED(prefix, name) prefix##name
#define FMU_PASTE(prefix, name) FMU_PASTED(prefix, name)
#define FMU(name) FMU_PASTE(FMI2_FUNCTION_PREFIX, name)
#else
#define FMU(name) name
#endif

/* ---- The wheel ---- */

enum { TRAVELLED, SPEED, SPIN, CONTACT_SLIP, ROLLED, STATES };
enum { INSTANTIATED, INITIALISING, RUNNING, TERMINATED };
enum { BACKWARD = AXES }; /* of the flags `outside`: behind those of the axes */

typedef struct {
  double real[REALS];    /* inputs, parameters, outputs */
  double state[STATES];
  double time;
  int spin_is_given;
  int outside;           /* a bit for each axis of the table that was left, and one for rolling backward */
} Values;

typedef struct {
  Values now;
  int phase;
  fmi2CallbackFunctions call;
  char *name;
} Wheel;

static void start_again(Wheel *w) {
  memset(&w->now, 0, sizeof w->now);
  memcpy(w->now.real, starts, sizeof starts);
  w->phase = INSTANTIATED;
}

static void report(Wheel *w, fmi2Status status, const char *text) {
  if (w->call.logger)
    w->call.logger(w->call.componentEnvironment, w->name, status,
                   status == fmi2Warning ? "logStatusWarning" : "logStatusError", "%s", text);
}

static double between(double low, double value, double high) {
  return value < low ? low : value > high ? high : value;
}

/* Of the contact, which is in front of the axle [m]. */
static double contact_length(double sinkage) { return RADIUS * acos(1.0 - between(0.0002, sinkage / RADIUS, 1.0)); }

/* Way of the rim in which the contact takes on a slip: at first its mean shear displacement grows at 2/length [m]. */
static double relaxation_length(double sinkage) { return 0.5 * contact_length(sinkage); }

/* Angular frequency of the stiffest motion [rad/s]: soil sheared along the contact against mass and inertia. */
static double rest_frequency(const Values *now) {
  double squared = STIFFEST_PULL / (SHORTEST_RELAXATION * now->real[V_mass]);
  if (!now->spin_is_given) squared += STIFFEST_TORQUE * RADIUS / (SHORTEST_RELAXATION * now->real[V_inertia]);
  return sqrt(squared);
}

typedef struct {
  double rate[STATES];
  double pull, torque; /* the wheel's, along travel and about its axle */
  double slip;         /* of the rim against the ground, 0 while the wheel all but stands */
  TABLE_answer at;     /* what the table has at the slip of the contact */
  int outside;
} Motion;

/* Which axes a slip of the contact and the inputs leave. */
static int axes_left(const Values *now, double slip) {
  int axis, left = 0;
  for (axis = 0; axis < AXES; ++axis) {
    const double value = axis_values[axis] < 0 ? slip : now->real[axis_values[axis]];
    const double *nodes = TABLE_nodes[axis], last = nodes[TABLE_sizes[axis] - 1], rounding = 1e-9 * (last - nodes[0]);
    if (!(value >= nodes[0] - rounding && value <= last + rounding)) left |= 1 << axis;
  }
  return left;
}

/* 0 where the table has no answer: the wheel buries itself nearby, or an input is not a number. */
static int motion(const Values *now, const double *y, Motion *m) {
  const double rim = RADIUS * y[SPIN], along = y[SPEED] * IN_PLANE(now->real), not_rolled = 1.0 - y[ROLLED];
  const double faster = fmax(fabs(rim), fabs(along)), damping = 0.2, frequency = rest_frequency(now);
  double held;
  TABLE_answer rest, felt;
  if (LOOK_UP(now->real, y[CONTACT_SLIP], &m->at) == TABLE_NO_ANSWER) return 0;
  if (LOOK_UP(now->real, 0.0, &rest) == TABLE_NO_ANSWER) return 0;
  m->outside = axes_left(now, y[CONTACT_SLIP]) | (y[ROLLED] < -0.5 ? 1 << BACKWARD : 0);
  m->slip = faster > 1e-5 ? (rim - along) / faster : 0.0;
  m->rate[CONTACT_SLIP] = (rim - along - faster * y[CONTACT_SLIP]) / relaxation_length(m->at.sinkage);
  if (LOOK_UP(now->real, y[CONTACT_SLIP] + 2.0 * damping / frequency * m->rate[CONTACT_SLIP], &felt) ==
      TABLE_NO_ANSWER)
    felt = m->at;
  held = -(rest.drawbar_pull + LOAD(now->real) * sin(INCLINE(now->real)));
  m->pull = felt.drawbar_pull + not_rolled * held;
  m->torque = felt.torque - not_rolled * rest.torque;
  m->rate[TRAVELLED] = y[SPEED];
  m->rate[SPEED] = (m->pull - now->real[V_drawbar_load]) / now->real[V_mass];
  m->rate[SPIN] = now->spin_is_given ? 0.0 : (now->real[V_motor_torque] - m->torque) / now->real[V_inertia];
  m->rate[ROLLED] = (y[SPEED] - fabs(y[SPEED]) * y[ROLLED]) / (0.2 * contact_length(m->at.sinkage));
  return 1;
}

/* One step by the classical method of Runge and Kutta; 0 as motion(). */
static int advance(Values *now, double h) {
  static const double part[4] = {0.0, 0.5, 0.5, 1.0}, weight[4] = {1.0 / 6, 1.0 / 3, 1.0 / 3, 1.0 / 6};
  double sum[STATES] = {0.0}, y[STATES];
  Motion m;
  int stage, k;
  memset(&m, 0, sizeof m);
  for (stage = 0; stage < 4; ++stage) {
    for (k = 0; k < STATES; ++k) y[k] = now->state[k] + h * part[stage] * m.rate[k];
    if (!motion(now, y, &m)) return 0;
    if (stage == 0) now->outside |= m.outside;
    for (k = 0; k < STATES; ++k) sum[k] += weight[stage] * m.rate[k];
  }
  for (k = 0; k < STATES; ++k) now->state[k] += h * sum[k];
  return 1;
}

static int tell(Values *now) {
  Motion m;
  double *real = now->real;
  if (now->spin_is_given) now->state[SPIN] = real[V_given_spin];
  memset(&m, 0, sizeof m);
  if (!motion(now, now->state, &m)) return 0;
  real[V_travelled] = now->state[TRAVELLED];
  real[V_speed] = now->state[SPEED];
  real[V_spin] = now->state[SPIN];
  real[V_slip] = m.slip;
  real[V_contact_slip] = now->state[CONTACT_SLIP];
  TELL_CHANNELS(real, m.at);
  real[V_drawbar_pull] = m.pull;
  real[V_torque] = m.torque;
  real[V_power] = (now->spin_is_given ? m.torque : real[V_motor_torque]) * now->state[SPIN];
  now->outside |= m.outside;
  return 1;
}

static fmi2Status no_answer(Wheel *w) {
  char text[512];
  int axis, at = snprintf(text, sizeof text, "the table has no answer at t = %g s: the wheel buries itself near", w->now.time);
  for (axis = 0; axis < AXES && at < (int)sizeof text; ++axis)
    at += snprintf(text + at, sizeof text - (size_t)at, "%s %s %g", axis ? "," : "", axis_names[axis],
                   axis_values[axis] < 0 ? w->now.state[CONTACT_SLIP] : w->now.real[axis_values[axis]]);
  report(w, fmi2Error, text);
  return fmi2Error;
}

/* fmi2Warning, and why, where the step left the table. */
static fmi2Status outside_or_ok(Wheel *w) {
  char text[512];
  int axis, at;
  if (w->now.outside == 0) return fmi2OK;
  at = snprintf(text, sizeof text, "t = %g s: outside the table, whose nearest values are used:", w->now.time);
  for (axis = 0; axis < AXES && at < (int)sizeof text; ++axis)
    if (w->now.outside & 1 << axis)
      at += snprintf(text + at, sizeof text - (size_t)at, " %s not within %g .. %g;", axis_names[axis],
                     TABLE_nodes[axis][0], TABLE_nodes[axis][TABLE_sizes[axis] - 1]);
  if (w->now.outside & 1 << BACKWARD && at < (int)sizeof text)
    snprintf(text + at, sizeof text - (size_t)at, " the wheel rolls backward;");
  text[strlen(text) - 1] = '\0';
  report(w, fmi2Warning, text);
  return fmi2Warning;
}

/* ---- The functions of the standard ---- */

static int allowed(Wheel *w, int earliest, int latest, const char *what) {
  char text[128];
  if (w && w->phase >= earliest && w->phase <= latest) return 1;
  snprintf(text, sizeof text, "%s is not allowed now", what);
  if (w) report(w, fmi2Error, text);
  return 0;
}

static fmi2Status refused(Wheel *w, const char *what) {
  report(w, fmi2Error, what);
  return fmi2Error;
}

FMU_API const char *FMU(fmi2GetTypesPlatform)(void) { return "default"; }
FMU_API const char *FMU(fmi2GetVersion)(void) { return "2.0"; }

FMU_API fmi2Status FMU(fmi2SetDebugLogging)(fmi2Component c, fmi2Boolean on, size_t count, const fmi2String categories[]) {
  (void)on, (void)count, (void)categories; /* there are warnings and errors alone */
  return c ? fmi2OK : fmi2Error;
}

FMU_API fmi2Component FMU(fmi2Instantiate)(fmi2String name, fmi2Type type, fmi2String guid, fmi2String resources,
                                           const fmi2CallbackFunctions *functions, fmi2Boolean visible,
                                           fmi2Boolean logging) {
  Wheel *w;
  const char *wrong = NULL;
  (void)resources, (void)visible, (void)logging;
  if (!functions || !name || !*name) return NULL;
  if (type != fmi2CoSimulation) wrong = "this unit is for co-simulation alone";
  if (!guid || strcmp(guid, FMU_GUID) != 0) wrong = "the GUID is not that of this unit: description and binary differ";
  w = (Wheel *)calloc(1, sizeof *w);
  if (!w) return NULL;
  w->call = *functions;
  w->name = (char *)malloc(strlen(name) + 1);
  if (w->name) strcpy(w->name, name);
  if (w->name && wrong) report(w, fmi2Error, wrong);
  if (!w->name || wrong) {
    free(w->name);
    free(w);
    return NULL;
  }
  start_again(w);
  return w;
}

FMU_API void FMU(fmi2FreeInstance)(fmi2Component c) {
  if (!c) return;
  free(((Wheel *)c)->name);
  free(c);
}

FMU_API fmi2Status FMU(fmi2SetupExperiment)(fmi2Component c, fmi2Boolean tolerance_defined, fmi2Real tolerance,
                                            fmi2Real start, fmi2Boolean stop_defined, fmi2Real stop) {
  (void)tolerance_defined, (void)tolerance, (void)stop_defined, (void)stop;
  if (!allowed((Wheel *)c, INSTANTIATED, INSTANTIATED, "fmi2SetupExperiment")) return fmi2Error;
  ((Wheel *)c)->now.time = start;
  return fmi2OK;
}

FMU_API fmi2Status FMU(fmi2EnterInitializationMode)(fmi2Component c) {
  if (!allowed((Wheel *)c, INSTANTIATED, INSTANTIATED, "fmi2EnterInitializationMode")) return fmi2Error;
  ((Wheel *)c)->phase = INITIALISING;
  return fmi2OK;
}

FMU_API fmi2Status FMU(fmi2ExitInitializationMode)(fmi2Component c) {
  Wheel *w = (Wheel *)c;
  if (!allowed(w, INITIALISING, INITIALISING, "fmi2ExitInitializationMode")) return fmi2Error;
  if (!(w->now.real[V_mass] > 0.0 && w->now.real[V_inertia] > 0.0))
    return refused(w, "mass and inertia are above 0");
  w->now.outside = 0;
  if (!tell(&w->now)) return no_answer(w);
  w->phase = RUNNING;
  return outside_or_ok(w);
}

FMU_API fmi2Status FMU(fmi2Terminate)(fmi2Component c) {
  if (!allowed((Wheel *)c, RUNNING, RUNNING, "fmi2Terminate")) return fmi2Error;
  ((Wheel *)c)->phase = TERMINATED;
  return fmi2OK;
}

FMU_API fmi2Status FMU(fmi2Reset)(fmi2Component c) {
  if (!c) return fmi2Error;
  start_again((Wheel *)c);
  return fmi2OK;
}

FMU_API fmi2Status FMU(fmi2GetReal)(fmi2Component c, const fmi2ValueReference vr[], size_t count, fmi2Real value[]) {
  Wheel *w = (Wheel *)c;
  size_t i;
  if (!allowed(w, INSTANTIATED, TERMINATED, "fmi2GetReal")) return fmi2Error;
  if (w->phase == INITIALISING && !tell(&w->now)) return no_answer(w); /* they follow what is set */
  for (i = 0; i < count; ++i) {
    if (vr[i] >= REALS) return refused(w, "fmi2GetReal: there is no such value reference");
    value[i] = w->now.real[vr[i]];
  }
  return fmi2OK;
}

FMU_API fmi2Status FMU(fmi2SetReal)(fmi2Component c, const fmi2ValueReference vr[], size_t count, const fmi2Real value[]) {
  Wheel *w = (Wheel *)c;
  size_t i;
  if (!allowed(w, INSTANTIATED, RUNNING, "fmi2SetReal")) return fmi2Error;
  for (i = 0; i < count; ++i) {
    if (vr[i] >= REALS) return refused(w, "fmi2SetReal: there is no such value reference");
    if (roles[vr[i]] == 'o') return refused(w, "fmi2SetReal: an output can't be set");
    if (roles[vr[i]] == 'p' && w->phase == RUNNING) return refused(w, "fmi2SetReal: a parameter is fixed by now");
    if (!(value[i] - value[i] == 0.0)) return refused(w, "fmi2SetReal: a value is not finite");
    w->now.real[vr[i]] = value[i];
  }
  return fmi2OK;
}

FMU_API fmi2Status FMU(fmi2GetInteger)(fmi2Component c, const fmi2ValueReference vr[], size_t count,
                                       fmi2Integer value[]) {
  size_t i;
  if (!allowed((Wheel *)c, INSTANTIATED, TERMINATED, "fmi2GetInteger")) return fmi2Error;
  for (i = 0; i < count; ++i) {
    if (vr[i] != V_OUTSIDE) return refused((Wheel *)c, "fmi2GetInteger: there is no such value reference");
    value[i] = ((Wheel *)c)->now.outside;
  }
  return fmi2OK;
}

FMU_API fmi2Status FMU(fmi2SetInteger)(fmi2Component c, const fmi2ValueReference vr[], size_t count,
                                       const fmi2Integer value[]) {
  (void)vr, (void)value;
  return c && count == 0 ? fmi2OK : fmi2Error;
}

FMU_API fmi2Status FMU(fmi2GetBoolean)(fmi2Component c, const fmi2ValueReference vr[], size_t count,
                                       fmi2Boolean value[]) {
  size_t i;
  if (!allowed((Wheel *)c, INSTANTIATED, TERMINATED, "fmi2GetBoolean")) return fmi2Error;
  for (i = 0; i < count; ++i) {
    if (vr[i] != V_SPIN_IS_GIVEN) return refused((Wheel *)c, "fmi2GetBoolean: there is no such value reference");
    value[i] = ((Wheel *)c)->now.spin_is_given;
  }
  return fmi2OK;
}

FMU_API fmi2Status FMU(fmi2SetBoolean)(fmi2Component c, const fmi2ValueReference vr[], size_t count,
                                       const fmi2Boolean value[]) {
  size_t i;
  if (count > 0 && !allowed((Wheel *)c, INSTANTIATED, INITIALISING, "fmi2SetBoolean")) return fmi2Error;
  for (i = 0; i < count; ++i) {
    if (vr[i] != V_SPIN_IS_GIVEN) return refused((Wheel *)c, "fmi2SetBoolean: there is no such value reference");
    ((Wheel *)c)->now.spin_is_given = value[i] != 0;
  }
  return c ? fmi2OK : fmi2Error;
}

FMU_API fmi2Status FMU(fmi2GetString)(fmi2Component c, const fmi2ValueReference vr[], size_t count, fmi2String value[]) {
  (void)vr, (void)value;
  return c && count == 0 ? fmi2OK : fmi2Error;
}

FMU_API fmi2Status FMU(fmi2SetString)(fmi2Component c, const fmi2ValueReference vr[], size_t count,
                                      const fmi2String value[]) {
  (void)vr, (void)value;
  return c && count == 0 ? fmi2OK : fmi2Error;
}

/* A state that is kept: all but callbacks and name. */
typedef struct {
  Values now;
  int phase;
} Kept;

FMU_API fmi2Status FMU(fmi2GetFMUstate)(fmi2Component c, fmi2FMUstate *state) {
  Kept *kept;
  if (!c || !state) return fmi2Error;
  if (!*state) *state = calloc(1, sizeof *kept);
  kept = (Kept *)*state;
  if (!kept) return fmi2Error;
  kept->now = ((Wheel *)c)->now;
  kept->phase = ((Wheel *)c)->phase;
  return fmi2OK;
}

FMU_API fmi2Status FMU(fmi2SetFMUstate)(fmi2Component c, fmi2FMUstate state) {
  if (!c || !state) return fmi2Error;
  ((Wheel *)c)->now = ((Kept *)state)->now;
  ((Wheel *)c)->phase = ((Kept *)state)->phase;
  return fmi2OK;
}

FMU_API fmi2Status FMU(fmi2FreeFMUstate)(fmi2Component c, fmi2FMUstate *state) {
  if (!c || !state) return fmi2Error;
  free(*state);
  *state = NULL;
  return fmi2OK;
}

FMU_API fmi2Status FMU(fmi2SerializedFMUstateSize)(fmi2Component c, fmi2FMUstate state, size_t *size) {
  if (!c || !state || !size) return fmi2Error;
  *size = sizeof(Kept);
  return fmi2OK;
}

FMU_API fmi2Status FMU(fmi2SerializeFMUstate)(fmi2Component c, fmi2FMUstate state, fmi2Byte bytes[], size_t size) {
  if (!c || !state || size < sizeof(Kept)) return fmi2Error;
  memcpy(bytes, state, sizeof(Kept));
  return fmi2OK;
}

FMU_API fmi2Status FMU(fmi2DeSerializeFMUstate)(fmi2Component c, const fmi2Byte bytes[], size_t size,
                                                fmi2FMUstate *state) {
  if (!c || !state || size != sizeof(Kept)) return fmi2Error;
  if (!*state) *state = calloc(1, sizeof(Kept));
  if (!*state) return fmi2Error;
  memcpy(*state, bytes, sizeof(Kept));
  return fmi2OK;
}

FMU_API fmi2Status FMU(fmi2GetDirectionalDerivative)(fmi2Component c, const fmi2ValueReference unknown[],
                                                     size_t unknowns, const fmi2ValueReference known[], size_t knowns,
                                                     const fmi2Real seed[], fmi2Real sensitivity[]) {
  (void)unknown, (void)unknowns, (void)known, (void)knowns, (void)seed, (void)sensitivity;
  return c ? refused((Wheel *)c, "there are no directional derivatives") : fmi2Error;
}

FMU_API fmi2Status FMU(fmi2SetRealInputDerivatives)(fmi2Component c, const fmi2ValueReference vr[], size_t count,
                                                    const fmi2Integer order[], const fmi2Real value[]) {
  (void)vr, (void)count, (void)order, (void)value;
  return c ? refused((Wheel *)c, "inputs are held through a step") : fmi2Error;
}

FMU_API fmi2Status FMU(fmi2GetRealOutputDerivatives)(fmi2Component c, const fmi2ValueReference vr[], size_t count,
                                                     const fmi2Integer order[], fmi2Real value[]) {
  (void)vr, (void)count, (void)order, (void)value;
  return c ? refused((Wheel *)c, "outputs have no derivatives") : fmi2Error;
}

/* Inputs are held through the step. A step is taken whole or, where the table has no answer, not at all. */
FMU_API fmi2Status FMU(fmi2DoStep)(fmi2Component c, fmi2Real now, fmi2Real step, fmi2Boolean no_set_state) {
  Wheel *w = (Wheel *)c;
  Values before;
  double left = step;
  int k;
  (void)no_set_state;
  if (!allowed(w, RUNNING, RUNNING, "fmi2DoStep")) return fmi2Error;
  if (!(step >= 0.0 && step - step == 0.0)) return refused(w, "fmi2DoStep: the step is not a time");
  before = w->now;
  w->now.outside = 0;
  if (w->now.spin_is_given) w->now.state[SPIN] = w->now.real[V_given_spin];
  while (left > 0.0) {
    const double *y = w->now.state;
    const double faster = fmax(fabs(RADIUS * y[SPIN]), fabs(y[SPEED]));
    const double parts = ceil(left * (rest_frequency(&w->now) + faster / SHORTEST_RELAXATION) / 0.2);
    double finite = 0.0;
    const int found = parts < 1e7 && advance(&w->now, left / parts);
    for (k = 0; k < STATES; ++k) finite += y[k] - y[k];
    if (!found || finite != 0.0) {
      w->now = before;
      return parts < 1e7 && finite == 0.0 ? no_answer(w) : refused(w, "the wheel is too fast for this step");
    }
    w->now.time += left / parts;
    left = parts > 1.0 ? left - left / parts : 0.0;
  }
  if (!tell(&w->now)) {
    w->now = before;
    return no_answer(w);
  }
  w->now.time = now + step;
  return outside_or_ok(w);
}

FMU_API fmi2Status FMU(fmi2CancelStep)(fmi2Component c) {
  return c ? refused((Wheel *)c, "a step is done when fmi2DoStep returns") : fmi2Error;
}

FMU_API fmi2Status FMU(fmi2GetStatus)(fmi2Component c, const fmi2StatusKind kind, fmi2Status *value) {
  (void)kind, (void)value;
  return c ? fmi2Discard : fmi2Error;
}

FMU_API fmi2Status FMU(fmi2GetRealStatus)(fmi2Component c, const fmi2StatusKind kind, fmi2Real *value) {
  if (!c) return fmi2Error;
  if (kind != fmi2LastSuccessfulTime) return fmi2Discard;
  *value = ((Wheel *)c)->now.time;
  return fmi2OK;
}

FMU_API fmi2Status FMU(fmi2GetIntegerStatus)(fmi2Component c, const fmi2StatusKind kind, fmi2Integer *value) {
  (void)kind, (void)value;
  return c ? fmi2Discard : fmi2Error;
}

FMU_API fmi2Status FMU(fmi2GetBooleanStatus)(fmi2Component c, const fmi2StatusKind kind, fmi2Boolean *value) {
  if (!c) return fmi2Error;
  if (kind != fmi2Terminated) return fmi2Discard;
  *value = ((Wheel *)c)->phase == TERMINATED;
  return fmi2OK;
}

FMU_API fmi2Status FMU(fmi2GetStringStatus)(fmi2Component c, const fmi2StatusKind kind, fmi2String *value) {
  (void)kind, (void)value;
  return c ? fmi2Discard : fmi2Error;
}
)";

}  // namespace soilbin::compare
