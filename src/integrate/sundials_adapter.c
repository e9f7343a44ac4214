/* Adapter of SUNDIALS: the only file that includes it.
 *
 * Written against what versions 6.4 and 7 have in common. Table and step controller of the
 * Runge-Kutta method are set by hand, because their defaults changed between versions. Vectors are
 * SUNDIALS' serial ones with kernels of our own in their table of functions: a library that was
 * built without optimisation would otherwise spend most of the time there.
 */
#include "integrate/integrator.h"

#include <math.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <arkode/arkode_erkstep.h>
#include <cvode/cvode.h>
#include <kinsol/kinsol.h>
#include <nvector/nvector_serial.h>
#include <sundials/sundials_version.h>
#include <sunlinsol/sunlinsol_dense.h>
#include <sunmatrix/sunmatrix_dense.h>
#include <sunnonlinsol/sunnonlinsol_fixedpoint.h>

#include "base/error.h"

#define FIRST_STEP 1e-3 /* of the longest step: the first step (ours) */
enum {
    FIXED_POINT_ITERATIONS = 4, /* per step, then it is halved (ours) */
    NEWTON_ITERATIONS = 200     /* (ours) */
};

/* The last message of SUNDIALS, which is not printed. */
typedef struct Message {
    char text[256];
} Message;

/* ---- versions -------------------------------------------------------------------------------- */

#if SUNDIALS_VERSION_MAJOR >= 7
static void keep_message(int line, const char *function, const char *file, const char *text,
                         SUNErrCode code, void *data, SUNContext context) {
    Message *message = data;
    (void)line, (void)file, (void)code, (void)context;
    snprintf(message->text, sizeof message->text, "%s: %s", function, text != NULL ? text : "");
}
static int create_context(Message *message, SUNContext *context) {
    const int flag = SUNContext_Create(SUN_COMM_NULL, context);
    if (flag != 0)
        return flag;
    SUNContext_ClearErrHandlers(*context);
    return SUNContext_PushErrHandler(*context, keep_message, message);
}
#define LISTEN(package, memory, message) 0
#else
static void keep_message(int code, const char *module, const char *function, char *text,
                         void *data) {
    Message *message = data;
    (void)code, (void)module;
    snprintf(message->text, sizeof message->text, "%s: %s", function, text != NULL ? text : "");
}
static int create_context(Message *message, SUNContext *context) {
    (void)message;
    return SUNContext_Create(NULL, context);
}
#define LISTEN(package, memory, message) package##SetErrHandlerFn(memory, keep_message, message)
#endif

void cz_solver_version(char *text, size_t n) {
    if (SUNDIALSGetVersion(text, (int)n) != 0)
        snprintf(text, n, "unknown");
}

/* ---- vectors --------------------------------------------------------------------------------- */

static size_t length_of(N_Vector v) {
    return (size_t)N_VGetLength(v);
}

static void linear_sum(sunrealtype a, N_Vector x, sunrealtype b, N_Vector y, N_Vector z) {
    const double *p = N_VGetArrayPointer(x), *q = N_VGetArrayPointer(y);
    double *sum = N_VGetArrayPointer(z); /* may be x or y */
    const size_t n = length_of(z);
    for (size_t i = 0; i < n; i++)
        sum[i] = a * p[i] + b * q[i];
}

static void set_constant(sunrealtype c, N_Vector z) {
    double *value = N_VGetArrayPointer(z);
    const size_t n = length_of(z);
    for (size_t i = 0; i < n; i++)
        value[i] = c;
}

static void scale(sunrealtype c, N_Vector x, N_Vector z) {
    const double *p = N_VGetArrayPointer(x);
    double *scaled = N_VGetArrayPointer(z);
    const size_t n = length_of(z);
    if (c == 1.0) {
        memmove(scaled, p, n * sizeof *p);
        return;
    }
    for (size_t i = 0; i < n; i++)
        scaled[i] = c * p[i];
}

static void take_sizes(N_Vector x, N_Vector z) {
    const double *p = N_VGetArrayPointer(x);
    double *size = N_VGetArrayPointer(z);
    const size_t n = length_of(z);
    for (size_t i = 0; i < n; i++)
        size[i] = fabs(p[i]);
}

static void invert(N_Vector x, N_Vector z) {
    const double *p = N_VGetArrayPointer(x);
    double *inverse = N_VGetArrayPointer(z);
    const size_t n = length_of(z);
    for (size_t i = 0; i < n; i++)
        inverse[i] = 1.0 / p[i];
}

/* Four sums in a fixed order, so that the bits are the same on every machine. */
static sunrealtype weighted_norm(N_Vector x, N_Vector w) {
    const double *p = N_VGetArrayPointer(x), *weight = N_VGetArrayPointer(w);
    const size_t n = length_of(x);
    double sum[4] = {0.0, 0.0, 0.0, 0.0};
    size_t i = 0;
    for (; i + 4 <= n; i += 4)
        for (size_t k = 0; k < 4; k++) {
            const double weighted = p[i + k] * weight[i + k];
            sum[k] += weighted * weighted;
        }
    for (; i < n; i++)
        sum[0] += p[i] * weight[i] * (p[i] * weight[i]);
    return sqrt(((sum[0] + sum[1]) + (sum[2] + sum[3])) / (double)n);
}

/* Up to four terms of a sum, of which absent ones have the factor 0. */
enum { AT_ONCE = 4 };
typedef struct Terms {
    int n;
    double factor[AT_ONCE];
    const double *vector[AT_ONCE];
} Terms;

/* Sets or increases the sum by the terms; two of them read half as much memory as four. */
static void add_terms(const Terms *terms, bool is_first, double *sum, size_t n) {
    const double *const *x = terms->vector, *c = terms->factor;
    if (terms->n <= 2)
        for (size_t i = 0; i < n; i++)
            sum[i] = (is_first ? 0.0 : sum[i]) + (c[0] * x[0][i] + c[1] * x[1][i]);
    else
        for (size_t i = 0; i < n; i++)
            sum[i] = (is_first ? 0.0 : sum[i]) + (c[0] * x[0][i] + c[1] * x[1][i]) +
                     (c[2] * x[2][i] + c[3] * x[3][i]);
}

/* Four vectors at a time, so that the sum passes through memory once per four; vectors with the
 * factor 0, of which a Runge-Kutta method has several, are left out. */
static int linear_combination(int n_vector, sunrealtype *c, N_Vector *x, N_Vector z) {
    double *sum = N_VGetArrayPointer(z); /* may be x[0] */
    const size_t n = length_of(z);
    int k = 0;
    bool is_first = true;
    do {
        Terms terms = {.n = 0};
        for (int i = 0; i < AT_ONCE; i++)
            terms.vector[i] = sum;
        for (; k < n_vector && terms.n < AT_ONCE; k++)
            if (c[k] != 0.0) {
                terms.factor[terms.n] = c[k];
                terms.vector[terms.n++] = N_VGetArrayPointer(x[k]);
            }
        add_terms(&terms, is_first, sum, n);
        is_first = false;
    } while (k < n_vector);
    return 0;
}

/* A vector with a copy of the values, NULL when there is no memory. Clones keep the kernels. */
static N_Vector vector_of(size_t n, const double *value, SUNContext context) {
    N_Vector v = N_VNew_Serial((sunindextype)n, context);
    if (v == NULL)
        return NULL;
    v->ops->nvlinearsum = linear_sum;
    v->ops->nvconst = set_constant;
    v->ops->nvscale = scale;
    v->ops->nvabs = take_sizes;
    v->ops->nvinv = invert;
    v->ops->nvwrmsnorm = weighted_norm;
    v->ops->nvlinearcombination = linear_combination;
    memcpy(N_VGetArrayPointer(v), value, n * sizeof *value);
    return v;
}

/* ---- differential equations ------------------------------------------------------------------ */

struct CzSolver {
    CzMethod method;
    CzOde *ode;
    SUNContext context;
    void *memory;                 /* of ERKStep or CVODE */
    N_Vector state, weight;       /* the weights are 1 / allowed */
    SUNNonlinearSolver iteration; /* of CVODE */
    double time, first_step;
    bool is_refused; /* a trial state had no rates */
    Message message;
};

/* Adams' iteration treats a refusal as slow convergence, so the refusal is stored. */
static int rates_of(sunrealtype time, N_Vector state, N_Vector rate, void *data) {
    CzSolver *solver = data;
    const double *y = N_VGetArrayPointer(state);
    if (solver->ode->rates(solver->ode, time, y, N_VGetArrayPointer(rate)))
        return 0;
    solver->is_refused = true;
    snprintf(solver->message.text, sizeof solver->message.text,
             "the laws give rates that are not finite at %.3f ms", 1e3 * time);
    return -1;
}

/* The same at every state. */
static int weigh(N_Vector state, N_Vector weight, void *data) {
    (void)state;
    memcpy(N_VGetArrayPointer(weight), N_VGetArrayPointer(((CzSolver *)data)->weight),
           length_of(weight) * sizeof(double));
    return 0;
}

static int drops_of(sunrealtype time, N_Vector state, sunrealtype *value, void *data) {
    CzOde *ode = ((CzSolver *)data)->ode;
    ode->drops(ode, time, N_VGetArrayPointer(state), value);
    return 0;
}

static CzStatus status_of_flag(const CzSolver *solver, int flag, CzError *error) {
    if (flag == ARK_MEM_FAIL || flag == CV_MEM_FAIL)
        return cz_fail(error, CZ_STATUS_NO_MEMORY, "no memory for the second solver");
    return cz_fail(error, CZ_STATUS_RUN_FAILED, "the second solver failed at %.3f ms: %s",
                   1e3 * solver->time, solver->message.text);
}

/* Bogacki and Shampine 3(2) with an I controller: the next step is 0.9 (1 / error)^(1/3) of the
 * last, between a tenth and five times (Hairer, Norsett and Wanner, Solving Ordinary Differential
 * Equations I, section II.4, with wide limits). */
static int settle_erk(CzSolver *solver, double longest) {
    void *memory = solver->memory;
    sunrealtype integral[3] = {1.0, 0.0, 0.0};
    int flag = LISTEN(ERKStep, memory, &solver->message);
    flag |= ERKStepSetUserData(memory, solver);
    flag |= ERKStepWFtolerances(memory, weigh);
    flag |= ERKStepSetTableNum(memory, ARKODE_BOGACKI_SHAMPINE_4_2_3);
    flag |= ERKStepSetAdaptivityMethod(memory, ARK_ADAPT_I, 0, 0, integral);
    flag |= ERKStepSetErrorBias(memory, 1.0);
    flag |= ERKStepSetSafetyFactor(memory, 0.9);
    flag |= ERKStepSetMaxGrowth(memory, 5.0);
    flag |= ERKStepSetMaxFirstGrowth(memory, 5.0);
    flag |= ERKStepSetMinReduction(memory, 0.1);
    flag |= ERKStepSetMaxEFailGrowth(memory, 0.5);
    flag |= ERKStepSetSmallNumEFails(memory, 2);
    flag |= ERKStepSetFixedStepBounds(memory, 1.0, 1.2);
    flag |= ERKStepSetMaxErrTestFails(memory, 40);
    flag |= ERKStepSetMaxStep(memory, longest);
    flag |= ERKStepSetInitStep(memory, solver->first_step);
    if (solver->ode->n_drop > 0) {
        flag |= ERKStepRootInit(memory, solver->ode->n_drop, drops_of);
        flag |= ERKStepSetNoInactiveRootWarn(memory);
    }
    return flag;
}

static int settle_adams(CzSolver *solver, double longest) {
    void *memory = solver->memory;
    int flag = LISTEN(CVode, memory, &solver->message);
    flag |= CVodeInit(memory, rates_of, solver->time, solver->state);
    flag |= CVodeSetUserData(memory, solver);
    flag |= CVodeWFtolerances(memory, weigh);
    flag |= CVodeSetNonlinearSolver(memory, solver->iteration);
    flag |= CVodeSetMaxNonlinIters(memory, FIXED_POINT_ITERATIONS);
    flag |= CVodeSetMaxErrTestFails(memory, 40);
    flag |= CVodeSetMaxConvFails(memory, 40);
    flag |= CVodeSetMaxStep(memory, longest);
    flag |= CVodeSetInitStep(memory, solver->first_step);
    if (solver->ode->n_drop > 0) {
        flag |= CVodeRootInit(memory, solver->ode->n_drop, drops_of);
        flag |= CVodeSetNoInactiveRootWarn(memory);
    }
    return flag;
}

static bool allocate(CzSolver *solver, const double *state) {
    const size_t n = solver->ode->n_unknown;
    if (create_context(&solver->message, &solver->context) != 0)
        return false;
    solver->state = vector_of(n, state, solver->context);
    solver->weight = vector_of(n, solver->ode->allowed, solver->context);
    if (solver->state == NULL || solver->weight == NULL)
        return false;
    invert(solver->weight, solver->weight);
    if (solver->method == CZ_METHOD_ERK) {
        solver->memory = ERKStepCreate(rates_of, solver->time, solver->state, solver->context);
    } else {
        solver->memory = CVodeCreate(CV_ADAMS, solver->context);
        solver->iteration = SUNNonlinSol_FixedPoint(solver->state, 0, solver->context);
    }
    return solver->memory != NULL && (solver->method == CZ_METHOD_ERK || solver->iteration != NULL);
}

/* Whether there is enough memory for SUNDIALS: where a request fails it may end the program without
 * a report. */
static bool has_room(size_t n_unknown) {
    enum { MAX_VECTORS = 40, MAX_OTHER = 1 << 18 /* [byte] */ };
    void *room = malloc(MAX_VECTORS * n_unknown * sizeof(double) + MAX_OTHER);
    free(room);
    return room != NULL;
}

CzStatus cz_solver_create(CzMethod method, CzOde *ode, double time, const double *state,
                          double longest, CzSolver **made, CzError *error) {
    CzSolver *solver = calloc(1, sizeof *solver);
    *made = NULL;
    if (solver == NULL)
        return cz_fail(error, CZ_STATUS_NO_MEMORY, "no memory for the second solver");
    solver->method = method;
    solver->ode = ode;
    solver->time = time;
    solver->first_step = FIRST_STEP * longest;
    CzStatus status = CZ_OK; /* the settings are valid, so only memory can be missing */
    if (!has_room(ode->n_unknown) || !allocate(solver, state) ||
        (method == CZ_METHOD_ERK ? settle_erk : settle_adams)(solver, longest) != 0)
        status = cz_fail(error, CZ_STATUS_NO_MEMORY, "no memory for the second solver");
    if (status != CZ_OK)
        cz_solver_free(solver);
    else
        *made = solver;
    return status;
}

void cz_solver_free(CzSolver *solver) {
    if (solver == NULL)
        return;
    if (solver->memory != NULL && solver->method == CZ_METHOD_ERK)
        ERKStepFree(&solver->memory);
    else if (solver->memory != NULL)
        CVodeFree(&solver->memory);
    if (solver->iteration != NULL)
        SUNNonlinSolFree(solver->iteration);
    if (solver->state != NULL)
        N_VDestroy(solver->state);
    if (solver->weight != NULL)
        N_VDestroy(solver->weight);
    if (solver->context != NULL)
        SUNContext_Free(&solver->context);
    free(solver);
}

CzStatus cz_solver_advance(CzSolver *solver, double until, CzSolverStep *step, CzError *error) {
    const bool is_erk = solver->method == CZ_METHOD_ERK;
    void *memory = solver->memory;
    double reached = solver->time;
    int flag = is_erk ? ERKStepSetStopTime(memory, until) : CVodeSetStopTime(memory, until);
    if (flag == 0)
        flag = is_erk ? ERKStepEvolve(memory, until, solver->state, &reached, ARK_ONE_STEP)
                      : CVode(memory, until, solver->state, &reached, CV_ONE_STEP);
    if (flag < 0 || solver->is_refused)
        return status_of_flag(solver, flag, error);
    solver->time = reached;
    *step = (CzSolverStep){.time = reached,
                           .state = N_VGetArrayPointer(solver->state),
                           .at_drop = flag == (is_erk ? ARK_ROOT_RETURN : CV_ROOT_RETURN)};
    return CZ_OK;
}

CzStatus cz_solver_restart(CzSolver *solver, CzError *error) {
    const bool is_erk = solver->method == CZ_METHOD_ERK;
    void *memory = solver->memory;
    int flag = is_erk ? ERKStepReInit(memory, rates_of, solver->time, solver->state)
                      : CVodeReInit(memory, solver->time, solver->state);
    flag |= is_erk ? ERKStepSetInitStep(memory, solver->first_step)
                   : CVodeSetInitStep(memory, solver->first_step);
    return flag == 0 ? CZ_OK : status_of_flag(solver, flag, error);
}

/* ---- equations ------------------------------------------------------------------------------- */

static int residuals_of(N_Vector unknown, N_Vector residual, void *data) {
    CzEquations *equations = data;
    equations->residuals(equations, N_VGetArrayPointer(unknown), N_VGetArrayPointer(residual));
    return 0;
}

/* Everything that one solution needs. */
typedef struct {
    SUNContext context;
    void *memory;
    N_Vector unknown, unknown_weight, residual_weight;
    SUNMatrix jacobian;
    SUNLinearSolver linear;
    Message message;
} Newton;

static bool newton_begin(Newton *newton, const CzEquations *equations, const double *unknown) {
    const size_t n = equations->n_unknown;
    if (create_context(&newton->message, &newton->context) != 0)
        return false;
    newton->unknown = vector_of(n, unknown, newton->context);
    newton->unknown_weight = vector_of(n, equations->unknown_scale, newton->context);
    newton->residual_weight = vector_of(n, equations->residual_scale, newton->context);
    newton->memory = KINCreate(newton->context);
    newton->jacobian = SUNDenseMatrix((sunindextype)n, (sunindextype)n, newton->context);
    if (newton->unknown == NULL || newton->unknown_weight == NULL ||
        newton->residual_weight == NULL || newton->memory == NULL || newton->jacobian == NULL)
        return false;
    N_VInv(newton->unknown_weight, newton->unknown_weight);
    N_VInv(newton->residual_weight, newton->residual_weight);
    newton->linear = SUNLinSol_Dense(newton->unknown, newton->jacobian, newton->context);
    return newton->linear != NULL;
}

static void newton_end(Newton *newton) {
    if (newton->memory != NULL)
        KINFree(&newton->memory);
    if (newton->linear != NULL)
        SUNLinSolFree(newton->linear);
    if (newton->jacobian != NULL)
        SUNMatDestroy(newton->jacobian);
    N_Vector vectors[] = {newton->unknown, newton->unknown_weight, newton->residual_weight};
    for (size_t i = 0; i < sizeof vectors / sizeof vectors[0]; i++)
        if (vectors[i] != NULL)
            N_VDestroy(vectors[i]);
    if (newton->context != NULL)
        SUNContext_Free(&newton->context);
}

static int newton_solve(Newton *newton, CzEquations *equations, double tolerance) {
    void *memory = newton->memory;
    int flag = LISTEN(KIN, memory, &newton->message);
    flag |= KINInit(memory, residuals_of, newton->unknown);
    flag |= KINSetUserData(memory, equations);
    flag |= KINSetLinearSolver(memory, newton->linear, newton->jacobian);
    flag |= KINSetFuncNormTol(memory, tolerance);
    flag |= KINSetScaledStepTol(memory, 1e-16);
    flag |= KINSetNumMaxIters(memory, NEWTON_ITERATIONS);
    flag |=
        KINSetMaxSetupCalls(memory, 1); /* a new Jacobian every time: contacts have breakpoints */
    if (flag != 0)
        return flag;
    return KINSol(memory, newton->unknown, KIN_LINESEARCH, newton->unknown_weight,
                  newton->residual_weight);
}

CzStatus cz_equations_solve(CzEquations *equations, double tolerance, double *unknown,
                            CzError *error) {
    Newton newton = {0};
    CzStatus status = CZ_OK;
    if (!newton_begin(&newton, equations, unknown)) {
        status = cz_fail(error, CZ_STATUS_NO_MEMORY, "no memory for the equations");
    } else {
        const int flag = newton_solve(&newton, equations, tolerance);
        memcpy(unknown, N_VGetArrayPointer(newton.unknown), equations->n_unknown * sizeof *unknown);
        if (flag != KIN_SUCCESS && flag != KIN_INITIAL_GUESS_OK)
            status = cz_fail(error, CZ_STATUS_RUN_FAILED, "no equilibrium found: %s",
                             newton.message.text);
    }
    newton_end(&newton);
    return status;
}
