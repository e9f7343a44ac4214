/* One search: limit of evaluations, history, best design so far, stop flag. */
#include "optimise/search.h"
#include "base/error.h"
#include "base/increment.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* A search pauses when this many of its latest designs fail (ours). */
enum { WINDOW_OF_FAILURES = 50, MAX_FAILURES = 25 };

void cz_search_init(CzSearch *search, const CzFunction *function,
                    const CzOptimiseOptions *options) {
    *search = (CzSearch){.function = function,
                         .most_evaluations = options->evaluations,
                         .most_in_all = options->evaluations,
                         .width = options->width > 0 ? options->width : CZ_USUAL_WIDTH,
                         .stop = options->stop,
                         .progress = options->progress,
                         .progress_data = options->progress_data,
                         .best = -1,
                         .best_on_grid = -1,
                         .worst_objective = -INFINITY,
                         .worst_constraint = 0};
}

void cz_search_free(CzSearch *search) {
    free(search->record);
    free(search->x);
    free(search->detail);
    search->record = NULL;
    search->x = NULL;
    search->detail = NULL;
}

static void finish(CzSearch *search, CzStatus status, const char *why) {
    search->is_over = true;
    search->status = status;
    snprintf(search->why, sizeof search->why, "%s", why);
}

long cz_search_left(const CzSearch *search) {
    return search->is_over || search->is_paused ? 0 : search->most_evaluations - search->n_record;
}

/* Ends the search when the stop flag is set; returns whether no evaluation is allowed now. */
static bool is_stopped(CzSearch *search) {
    if (!search->is_over && search->stop != NULL && *search->stop != 0)
        finish(search, CZ_STATUS_INTERRUPTED, "interrupted");
    return search->is_over || search->is_paused;
}

void cz_search_resume(CzSearch *search) {
    search->is_paused = false;
    if (!search->is_over)
        search->why[0] = '\0';
    search->n_before_window = search->n_record;
}

const double *cz_search_x(const CzSearch *search, long record) {
    return search->x + record * search->function->n_variable;
}

const double *cz_search_detail(const CzSearch *search, long record) {
    return search->detail + record * cz_search_n_detail(search);
}

void cz_search_unscale(const CzSearch *search, int n, const double *u, double *x) {
    const int n_variable = search->function->n_variable;
    for (int i = 0; i < n * n_variable; i++) {
        const double lo = search->function->min[i % n_variable];
        const double hi = search->function->max[i % n_variable];
        const double value = lo + u[i] * (hi - lo);
        x[i] = value < lo ? lo : value > hi || u[i] >= 1 ? hi : value;
    }
}

void cz_search_scale(const CzSearch *search, const double *x, double *u) {
    const CzFunction *function = search->function;
    for (int i = 0; i < function->n_variable; i++)
        u[i] = (x[i] - function->min[i]) / (function->max[i] - function->min[i]);
}

static double distance(const double *a, const double *b, int n) {
    double sum = 0;
    for (int i = 0; i < n; i++)
        sum += (a[i] - b[i]) * (a[i] - b[i]);
    return sqrt(sum / n);
}

bool cz_search_is_apart(const CzSearch *search, long record, int n_chosen, const double *chosen,
                        double apart, double *u) {
    const int n = search->function->n_variable;
    cz_search_scale(search, cz_search_x(search, record), u);
    for (int i = 0; i < n_chosen; i++)
        if (!(distance(u, chosen + i * n, n) >= apart))
            return false;
    return true;
}

void cz_search_round(const CzSearch *search, const double *x, double *rounded) {
    const CzFunction *function = search->function;
    for (int i = 0; i < function->n_variable; i++) {
        const double step = function->step[i], lo = function->min[i], hi = function->max[i];
        rounded[i] = x[i];
        if (!(step > 0))
            continue;
        double value = round(x[i] / step) * step;
        if (value > hi)
            value = cz_increment_not_above(step, hi);
        if (value < lo)
            value = cz_increment_not_below(step, lo);
        rounded[i] = value < lo || value > hi ? lo : value; /* no increment within the bounds */
    }
}

bool cz_search_is_on_grid(const CzSearch *search, const double *x) {
    bool is_on_grid = true;
    for (int i = 0; i < search->function->n_variable; i++) {
        const double step = search->function->step[i];
        is_on_grid &= !(step > 0) || round(x[i] / step) * step == x[i];
    }
    return is_on_grid;
}

bool cz_search_has_steps(const CzSearch *search) {
    for (int i = 0; i < search->function->n_variable; i++)
        if (search->function->step[i] > 0)
            return true;
    return false;
}

/* ---- history and best design ----------------------------------------------------------------- */

bool cz_record_is_better(const CzRecord *record, const CzRecord *other) {
    if (record->is_barred != other->is_barred)
        return other->is_barred;
    if (record->penalty != other->penalty)
        return record->penalty < other->penalty;
    for (int i = 0; record->objective == other->objective && i < CZ_N_LARGEST; i++)
        if (record->largest[i] != other->largest[i])
            return record->largest[i] < other->largest[i];
    return record->objective < other->objective; /* false for NaN */
}

bool cz_search_is_better(const CzSearch *search, long record, long other) {
    if (other < 0 || record < 0)
        return record >= 0;
    return cz_record_is_better(&search->record[record], &search->record[other]);
}

long cz_search_find(const CzSearch *search, const double *x) {
    const size_t size = (size_t)search->function->n_variable * sizeof *x;
    for (long record = search->n_record - 1; record >= 0; record--)
        if (memcmp(cz_search_x(search, record), x, size) == 0)
            return record;
    return -1;
}

void cz_search_end_without_memory(CzSearch *search) {
    if (search->status == CZ_OK)
        finish(search, cz_no_memory(&search->error, "the designs of a search"), "no memory");
}

double *cz_search_numbers(CzSearch *search, size_t n) {
    double *number = calloc(n + 1, sizeof *number);
    if (number == NULL)
        cz_search_end_without_memory(search);
    return number;
}

static bool make_room(CzSearch *search, long n) {
    if (search->n_record + n <= search->room)
        return true;
    const long room = 2 * (search->n_record + n) + 64;
    const size_t n_variable = (size_t)search->function->n_variable;
    CzRecord *record = realloc(search->record, (size_t)room * sizeof *record);
    if (record != NULL)
        search->record = record;
    double *x = realloc(search->x, ((size_t)room * n_variable + 1) * sizeof *x);
    if (x != NULL)
        search->x = x;
    const size_t n_detail = (size_t)cz_search_n_detail(search);
    double *detail = realloc(search->detail, ((size_t)room * n_detail + 1) * sizeof *detail);
    if (detail != NULL)
        search->detail = detail;
    if (record == NULL || x == NULL || detail == NULL)
        return false;
    search->room = room;
    return true;
}

bool cz_search_is_gain(const CzSearch *search, long record, long other) {
    if (other < 0)
        return true;
    const CzRecord *a = &search->record[record], *b = &search->record[other];
    if (a->is_barred != b->is_barred)
        return b->is_barred;
    if (b->penalty > 0)
        return a->penalty < 0.99 * b->penalty;
    const double scale = search->function->is_minimax ? 1 : fabs(b->objective); /* a margin is 1 */
    for (int i = 0; a->objective == b->objective && i < CZ_N_LARGEST; i++)
        if (a->largest[i] != b->largest[i])
            return a->largest[i] < b->largest[i] - 1e-3;
    return a->objective < b->objective - 1e-3 * scale;
}

static void add_record(CzSearch *search, const double *x, const CzRecord *given) {
    const int n = search->function->n_variable;
    double *kept = search->x + search->n_record * n;
    memcpy(kept, x, (size_t)n * sizeof *x);
    const long record = search->n_record++;
    CzRecord *written = &search->record[record];
    *written = *given;
    written->on_grid = cz_search_is_on_grid(search, x);
    if (isnan(written->objective))
        return;
    if (cz_search_is_better(search, record, search->best)) {
        if (cz_search_is_gain(search, record, search->best))
            search->last_gain = search->n_record;
        search->best = record;
    }
    if (written->on_grid && cz_search_is_better(search, record, search->best_on_grid))
        search->best_on_grid = record;
}

static void report_progress(const CzSearch *search, const char *phase) {
    if (search->progress == NULL)
        return;
    CzProgress progress = {.n_evaluation = search->n_earlier + search->n_record,
                           .most_evaluations = search->most_in_all,
                           .best_objective = NAN,
                           .best_violation = INFINITY,
                           .phase = phase};
    if (search->best >= 0) {
        progress.best_objective = search->record[search->best].objective;
        progress.best_violation = search->record[search->best].violation;
        progress.feasible = progress.best_violation <= 0;
        progress.best_fails_a_flag = !progress.feasible && !search->function->is_fit &&
                                     search->record[search->best].missed <= 0;
    }
    search->progress(&progress, search->progress_data);
}

/* Pauses a search when most of its latest designs failed, and ends it when all did. */
static void watch_failures(CzSearch *search) {
    if (search->n_record - search->n_before_window < WINDOW_OF_FAILURES)
        return;
    int n_failed = 0;
    for (long i = search->n_record - WINDOW_OF_FAILURES; i < search->n_record; i++)
        n_failed += isnan(search->record[i].objective);
    if (n_failed <= MAX_FAILURES)
        return;
    snprintf(search->why, sizeof search->why, "%d of the last %d designs failed in simulation",
             n_failed, WINDOW_OF_FAILURES);
    search->is_paused = true;
    if (search->best < 0) {
        search->is_over = true;
        search->status = CZ_STATUS_RUN_FAILED;
    }
}

/* ---- evaluating ------------------------------------------------------------------------------ */

/* Above this a violation counts logarithmically, so that a hundredfold excess over a limit of 0
 * does not mask a strength exceeded by a half. Slopes remain continuous, and the order is kept. */
static const double knee = 0.1;

double cz_search_compressed(double constraint) {
    return constraint <= knee ? constraint : knee * (1 + log(constraint / knee));
}

double cz_search_expanded(double compressed) {
    return compressed <= knee ? compressed : knee * exp(fmin(compressed / knee - 1, 10));
}

double cz_search_compressed_slope(double constraint) {
    return constraint <= knee ? 1 : knee / constraint;
}

double cz_search_residual(double compressed) {
    const double weight = 30, reserve = 0.01; /* ours */
    return weight * fmax(compressed + reserve, 0);
}

/* Distance of a design from the best one, in scaled variables; 0 when there is no best one. */
static double distance_from_best(const CzSearch *search, const double *x) {
    if (search->best < 0)
        return 0;
    const double *best = cz_search_x(search, search->best);
    double sum = 0;
    for (int i = 0; i < search->function->n_variable; i++) {
        const double range = search->function->max[i] - search->function->min[i];
        const double difference = (x[i] - best[i]) / range;
        sum += difference * difference;
    }
    return sqrt(sum);
}

/* Puts a constraint among the largest ones. */
static void note_largest(CzRecord *record, double constraint) {
    for (int i = 0; i < CZ_N_LARGEST; i++)
        if (constraint > record->largest[i]) {
            const double smaller = record->largest[i];
            record->largest[i] = constraint;
            constraint = smaller;
        }
}

CzRecord cz_search_judge(const CzFunction *function, const char *phase, double objective,
                         const double *constraint) {
    CzRecord record = {.objective = objective, .phase = phase};
    bool failed = !isfinite(objective);
    for (int i = 0; i < CZ_N_LARGEST && function->is_minimax; i++)
        record.largest[i] = -INFINITY;
    for (int j = 0; j < function->n_constraint; j++) {
        const CzConstraintKind kind = cz_constraint_kind(function, j);
        failed |= isnan(constraint[j]);
        record.violation = fmax(record.violation, constraint[j]);
        if (kind == CZ_CONSTRAINT_GRADED)
            record.missed = fmax(record.missed, constraint[j]);
        if (kind == CZ_CONSTRAINT_GRADED && function->is_minimax)
            note_largest(&record, constraint[j]);
        record.is_barred |= kind == CZ_CONSTRAINT_RULES && constraint[j] > 0;
        if (!function->is_fit)
            record.penalty += cz_search_compressed(fmax(constraint[j], 0));
        else if (kind == CZ_CONSTRAINT_GRADED)
            record.penalty += pow(cz_search_residual(cz_search_compressed(constraint[j])), 2);
    }
    if (function->is_fit)
        record.penalty += objective;
    return failed ? (CzRecord){.objective = NAN,
                               .violation = INFINITY,
                               .penalty = INFINITY,
                               .phase = phase,
                               .is_barred = true,
                               .missed = INFINITY}
                  : record;
}

/* Records the values of one design and makes them finite and smooth for an algorithm. */
static void record_values(CzSearch *search, const char *phase, bool is_partial, const double *x,
                          double *objective, double *constraint, double *detail) {
    const int m = search->function->n_constraint;
    const int n_detail = detail != NULL ? cz_search_n_detail(search) : 0;
    double *kept = search->detail + search->n_record * cz_search_n_detail(search);
    if (search->function->n_detail == 0)
        memcpy(kept, constraint, (size_t)m * sizeof *detail);
    if (n_detail > 0 && search->function->n_detail == 0)
        memcpy(detail, kept, (size_t)m * sizeof *detail);
    CzRecord record = cz_search_judge(search->function, phase, *objective, constraint);
    record.is_partial = is_partial;
    add_record(search, x, &record);
    if (isnan(record.objective)) {
        const double ramp = 1 + distance_from_best(search, x);
        const double top = isfinite(search->worst_objective) ? search->worst_objective : 1;
        *objective = top + fmax(fabs(top), 1) * ramp;
        for (int j = 0; j < m; j++)
            constraint[j] = search->worst_constraint + ramp;
        for (int k = 0; k < n_detail; k++)
            detail[k] = 1 + ramp;
        return;
    }
    search->worst_objective = fmax(search->worst_objective, *objective);
    for (int j = 0; j < m; j++) {
        const bool is_graded = cz_constraint_kind(search->function, j) == CZ_CONSTRAINT_GRADED;
        constraint[j] = is_graded ? cz_search_compressed(constraint[j]) : -1;
        search->worst_constraint = fmax(search->worst_constraint, constraint[j]);
    }
}

int cz_search_n_detail(const CzSearch *search) {
    const CzFunction *function = search->function;
    return function->n_detail > 0 ? function->n_detail : function->n_constraint;
}

bool cz_search_evaluate(CzSearch *search, const char *phase, int n, const double *x,
                        double *objective, double *constraint, double *detail) {
    if (is_stopped(search))
        return false;
    const CzFunction *function = search->function;
    if (cz_search_left(search) < n) {
        finish(search, CZ_OK, "");
        search->is_spent = true;
        return false;
    }
    CzStatus status = CZ_STATUS_NO_MEMORY;
    search->phase = phase;
    if (make_room(search, n))
        status = function->evaluate(
            function->data, n, x, objective, constraint,
            function->n_detail > 0 ? search->detail + search->n_record * function->n_detail : NULL,
            &search->error);
    else
        cz_no_memory(&search->error, "the history");
    if (status != CZ_OK) {
        const bool is_stopped = status == CZ_STATUS_INTERRUPTED;
        finish(search, status, is_stopped ? "interrupted" : "an evaluation could not be made");
        return false;
    }
    if (detail != NULL && function->n_detail > 0)
        memcpy(detail, cz_search_detail(search, search->n_record),
               (size_t)n * (size_t)function->n_detail * sizeof *detail);
    for (int i = 0; i < n; i++) {
        const bool is_partial = function->is_partial != NULL && function->is_partial[i];
        record_values(search, phase, is_partial, x + i * function->n_variable, &objective[i],
                      constraint + i * function->n_constraint,
                      detail != NULL ? detail + i * cz_search_n_detail(search) : NULL);
        report_progress(search, phase);
    }
    watch_failures(search);
    return true;
}

bool cz_search_evaluate_start(CzSearch *search, const char *phase) {
    double objective;
    double *constraint = cz_search_numbers(search, (size_t)search->function->n_constraint);
    const bool done =
        constraint != NULL &&
        cz_search_evaluate(search, phase, 1, search->function->start, &objective, constraint, NULL);
    free(constraint);
    return done;
}
