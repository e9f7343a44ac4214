/* Runs a problem file of tests/physics/cases, or of problems/, and reads the results. */
#ifndef CZ_TESTS_PHYSICS_COLLISION_H
#define CZ_TESTS_PHYSICS_COLLISION_H

#include "support/check.h"

#include <stdbool.h>

#include "crushzone/simulate.h"
#include "problem/problem.h"
#include "simulate/batch.h"

typedef struct {
    CzProblem *problem;
    CzModel *model;
    CzRun *run;
    const CzRunSummary *summary;
} Collision;

enum { MAX_SET = 16 };

/* Settings, NULL at the end: WITH("trains.A.speed_m_s=5", ...). */
#define WITH(...) ((const char *const[MAX_SET]){__VA_ARGS__})
#define AS_WRITTEN ((const char *const[MAX_SET]){NULL})

/* Reads the file, relative to the project's root, and builds the model of a scenario. */
static inline Collision collision_model(const char *file, const char *const *set, int scenario) {
    char path[512];
    snprintf(path, sizeof path, "%s/%s", CZ_SOURCE_FOLDER, file);
    CzProblemOptions options = cz_problem_options_default();
    options.set = set;
    while (options.n_set < MAX_SET && set[options.n_set] != NULL)
        options.n_set++;
    CzError error = {0};
    Collision collision = {0};
    if (cz_problem_read(path, &options, &collision.problem, &error) != CZ_OK ||
        cz_model_build(collision.problem, scenario, &collision.model, &error) != CZ_OK)
        fail_msg("%s:%d: %s", error.file, error.line, error.message);
    return collision;
}

/* Runs it with the caller's options. */
static inline Collision collide_so(const char *file, const char *const *set, int scenario,
                                   const CzSimulateOptions *options) {
    Collision collision = collision_model(file, set, scenario);
    CzError error = {0};
    if (cz_simulate(collision.model, options, &collision.run, &error) != CZ_OK)
        fail_msg("%s", error.message);
    collision.summary = cz_run_summary(collision.run);
    return collision;
}

/* Runs it with recorded channels. */
static inline Collision collide(const char *file, const char *const *set, int scenario) {
    const CzSimulateOptions options = cz_simulate_options_default();
    return collide_so(file, set, scenario, &options);
}

/* The same with vehicles outside the reader's ranges: `change` is called with each vehicle and a
 * value. The ranges follow from real devices, and closed forms are simplest far beyond them. `step`
 * is the caller's responsibility too [s]. */
typedef void ChangeVehicle(CzVehicle *vehicle, double value);

static inline Collision collide_changed(const char *file, const char *const *set,
                                        ChangeVehicle *change, double value, double step) {
    Collision collision = collision_model(file, set, 0);
    int n_vehicle = 0;
    const CzVehicle *own = cz_problem_vehicles(collision.problem, &n_vehicle);
    CzVehicle *vehicles = malloc((size_t)n_vehicle * sizeof *vehicles);
    assert_non_null(vehicles);
    memcpy(vehicles, own, (size_t)n_vehicle * sizeof *vehicles);
    for (int i = 0; i < n_vehicle; i++)
        change(&vehicles[i], value);
    const CzPlannedRun planned = {collision.model, vehicles};
    CzSimulateOptions options = cz_simulate_options_default();
    options.time_step = step;
    CzError error = {0};
    if (cz_simulate_batch(1, &planned, &options, &collision.run, &error) != CZ_OK)
        fail_msg("%s", error.message);
    collision.summary = cz_run_summary(collision.run);
    free(vehicles);
    return collision;
}

static inline void collision_free(Collision *collision) {
    cz_run_free(collision->run);
    cz_model_free(collision->model);
    cz_problem_free(collision->problem);
    memset(collision, 0, sizeof *collision);
}

/* The run met its end criterion, and reports it. */
static inline void assert_completed(const Collision *collision) {
    const CzRunSummary *summary = collision->summary;
    if (summary->status != CZ_OK || summary->ended == CZ_ENDED_INCOMPLETE)
        fail_msg("%s: status %d, %s after %g s: %s", summary->scenario, (int)summary->status,
                 cz_ended_text(summary->ended), summary->simulated, summary->failure);
}

/* A recorded channel of the vehicle or the interface of that name; "" of the run. */
static inline const double *channel(const Collision *collision, CzChannel channel,
                                    const char *name) {
    for (int i = 0; i < cz_run_n_column(collision->run); i++) {
        const CzColumn column = cz_run_column(collision->run, i);
        const CzChannelAt at = cz_channel_info(channel)->at;
        if (column.channel == channel &&
            strcmp(cz_run_place_name(collision->summary, at, column.place), name) == 0)
            return cz_run_channel(collision->run, channel, column.place);
    }
    fail_msg("no channel %s of '%s'", cz_channel_info(channel)->pattern, name);
    return NULL;
}

static inline int n_sample(const Collision *collision) {
    return cz_run_n_sample(collision->run);
}

/* First time at which a falling line through the samples of a - b reaches zero [s]; `a` or `b` may
 * be NULL for zero. */
static inline double time_of_fall(const Collision *collision, const double *a, const double *b) {
    const double *t = channel(collision, CZ_CHANNEL_TIME, "");
    double last = 1.0;
    for (int i = 0; i < n_sample(collision); i++) {
        const double now = (a != NULL ? a[i] : 0.0) - (b != NULL ? b[i] : 0.0);
        if (i > 0 && now <= 0.0)
            return 1e-3 * (t[i] + (t[i - 1] - t[i]) * now / (now - last));
        last = now;
    }
    return NAN;
}

/* Value of a channel at a time, linear between the samples. */
static inline double value_at(const Collision *collision, const double *values, double time) {
    const double *t = channel(collision, CZ_CHANNEL_TIME, "");
    for (int i = 1; i < n_sample(collision); i++) {
        if (t[i] >= 1e3 * time)
            return values[i] +
                   (values[i - 1] - values[i]) * (t[i] - 1e3 * time) / (t[i] - t[i - 1]);
    }
    return NAN;
}

static inline double last_value(const Collision *collision, const double *values) {
    return values[n_sample(collision) - 1];
}

/* Time at which the straight line through two values of a - b meets zero [s]; `b` may be NULL. */
static inline double time_on_line(const Collision *collision, const double *a, const double *b,
                                  double t0, double t1) {
    const double from = value_at(collision, a, t0) - (b != NULL ? value_at(collision, b, t0) : 0.0);
    const double to = value_at(collision, a, t1) - (b != NULL ? value_at(collision, b, t1) : 0.0);
    return t1 - to * (t1 - t0) / (to - from);
}

/* Time at which a force opens for the last time, on the line of its last two samples [s]. */
static inline double time_of_opening(const Collision *collision, const double *force) {
    const double *t = channel(collision, CZ_CHANNEL_TIME, "");
    for (int i = n_sample(collision) - 1; i > 1; i--) {
        if (force[i] > 0.0)
            return 1e-3 * (t[i] - force[i] * (t[i] - t[i - 1]) / (force[i] - force[i - 1]));
    }
    return NAN;
}

/* Time of an event, the first of its kind whose place begins with `where` [s]. */
static inline double event_time(const Collision *collision, CzEventKind what, const char *where) {
    for (int i = 0; i < collision->summary->n_event; i++) {
        const CzEvent *event = &collision->summary->event[i];
        if (event->what == what && strncmp(event->where, where, strlen(where)) == 0)
            return event->time;
    }
    return NAN;
}

#endif
