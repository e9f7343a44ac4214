/* Simulates a collision from first contact to its end, for one design or for several side by
 * side, in the same scenario or in several. */
#include "simulate/batch.h"

#include <limits.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/clock.h"
#include "base/error.h"
#include "simulate/reference.h"
#include "simulate/run.h"

enum {
    STEPS_BETWEEN_LOOKS =
        32, /* time steps of the model between two examinations of energy and end criterion, so that
               a run with a halved time step ends at the same time (ours) */
    LANES_THAT_FILL =
        96,            /* lanes of a batch that still fit into the first-level cache (measured) */
    MAX_STEPS = 100000 /* of a reference within one step of the model: more occur only when events
                           follow one another endlessly (ours) */
};
#define SAMPLING 1e-3 /* of speeds for means over sliding windows [s] (ours) */

CzSimulateOptions cz_simulate_options_default(void) {
    return (CzSimulateOptions){.time_step = 0.0,
                               .record = true,
                               .isa = "auto",
                               .brief = false,
                               .integrator = CZ_INTEGRATOR_ZHAI,
                               .tolerance = 1e-6};
}

int cz_simulate_batch_width(const CzModel *model) {
    const int width = LANES_THAT_FILL / model->n_car;
    return width > 1 ? width : 1;
}

int cz_simulate_n_block(const CzModel *model, int n) {
    return (model->n_car * n + CZ_LANE_BLOCK - 1) / CZ_LANE_BLOCK;
}

const char *cz_isa_name(void) {
    return cz_kernel(NULL)->isa;
}

static CzTrack track_of(const CzModel *model, CzTrackUse use) {
    const CzTrack own = (CzTrack)model->simulation->track;
    if (own == CZ_TRACK_RIGID || use == CZ_TRACK_USE_OWN)
        return own;
    if (use == CZ_TRACK_USE_SEARCH)
        return model->track != NULL && model->track->n_receptance > 0 ? CZ_TRACK_RECEPTANCE : own;
    return use == CZ_TRACK_USE_MODAL ? CZ_TRACK_MODAL : CZ_TRACK_FE;
}

static bool has_same_parts(const CzLanesHave *a, const CzLanesHave *b) {
    return a->side_buffers == b->side_buffers && a->superstructures == b->superstructures &&
           a->draw_gears == b->draw_gears && a->couplers == b->couplers &&
           a->full_cars == b->full_cars && a->rolling == b->rolling && a->drag == b->drag;
}

bool cz_simulate_fits(const CzModel *a, const CzModel *b, const CzSimulateOptions *options) {
    const CzTrack track = track_of(a, options->track);
    const bool is_any_track = track == CZ_TRACK_RIGID || track == CZ_TRACK_RECEPTANCE;
    return a->n_car == b->n_car && a->time_step == b->time_step &&
           has_same_parts(&a->has, &b->has) && track_of(b, options->track) == track &&
           (a->track == NULL) == (b->track == NULL) && (is_any_track || a->track == b->track);
}

/* Fills all lanes. The run of a design without a valid model has failed at once; its lanes get the
 * values of the file. */
static CzStatus fill_designs(CzBatch *batch, CzError *error) {
    for (int design = 0; design < batch->n_design; ++design) {
        CzProgressOfDesign *progress = &batch->design[design];
        const CzModel *model = progress->model;
        CzError problem = {0};
        int n_vehicle;
        if (cz_model_fill(model, progress->vehicles, design, batch->lanes, &problem) == CZ_OK)
            continue;
        snprintf(progress->failure, sizeof progress->failure, "no model was built: %.220s",
                 problem.message);
        progress->over = true;
        progress->ended = CZ_ENDED_INCOMPLETE;
        CZ_TRY(cz_model_fill(model, cz_problem_vehicles(model->problem, &n_vehicle), design,
                             batch->lanes, error));
    }
    return CZ_OK;
}

/* Lanes with as many breakpoints as some design's model needs; NULL when there is no memory. */
static CzLanes *create_lanes(CzBatch *batch) {
    int n_breakpoint[CZ_N_CURVE] = {0};
    for (int design = 0; design < batch->n_design; ++design)
        for (int id = 0; id < CZ_N_CURVE; ++id) {
            const int n = batch->design[design].model->n_breakpoint[id];
            n_breakpoint[id] = n > n_breakpoint[id] ? n : n_breakpoint[id];
        }
    return cz_lanes_create(batch->n_car, batch->n_design, n_breakpoint, &batch->laid);
}

static CzProgressOfDesign progress_at_start(const CzPlannedRun *planned, CzRun *run) {
    int n_vehicle;
    return (CzProgressOfDesign){.model = planned->model,
                                .vehicles =
                                    planned->vehicles != NULL
                                        ? planned->vehicles
                                        : cz_problem_vehicles(planned->model->problem, &n_vehicle),
                                .run = run,
                                .override_time = NAN,
                                .wheel_rail = NAN,
                                .quiet_since = NAN,
                                .settled_since = NAN};
}

/* Settings of a batch; the models have the same values. */
static CzStatus choose(CzBatch *batch, const CzModel *model, int n_design,
                       const CzSimulateOptions *options, CzError *error) {
    batch->kernel = cz_kernel(options->isa);
    if (batch->kernel == NULL)
        return cz_fail(error, CZ_STATUS_INPUT, "no kernel for instruction set '%s' here",
                       options->isa);
    batch->n_car = model->n_car;
    batch->n_design = n_design;
    batch->brief = options->brief;
    batch->keeps_pulses = options->keep_pulses || options->record;
    batch->integrator = options->integrator;
    batch->track = track_of(model, options->track);
    batch->step = options->time_step > 0.0 ? options->time_step : model->time_step;
    batch->sampling = (long)fmax(1.0, round(SAMPLING / batch->step));
    return CZ_OK;
}

/* Memory, lanes and state at t = 0. */
static CzStatus begin(CzBatch *batch, int n_design, const CzPlannedRun *planned,
                      const CzSimulateOptions *options, CzRun **run, CzError *error) {
    CZ_TRY(choose(batch, planned[0].model, n_design, options, error));
    batch->design = cz_arena_allocate(&batch->arena, (size_t)n_design, sizeof *batch->design);
    if (batch->design == NULL)
        return cz_no_memory(error, "the designs");
    for (int design = 0; design < n_design; ++design)
        batch->design[design] = progress_at_start(&planned[design], run[design]);
    batch->lanes = create_lanes(batch);
    if (batch->lanes == NULL)
        return cz_no_memory(error, "the designs");
    CZ_TRY(fill_designs(batch, error));
    CZ_TRY(cz_batch_set_up(batch, error));
    for (int design = 0; design < n_design; ++design) {
        CzProgressOfDesign *progress = &batch->design[design];
        if (!isnan(progress->model->duration))
            progress->last = lround(progress->model->duration / batch->step);
        progress->closing_speed = cz_closing_speed(batch, progress->model->colliding, design);
        progress->initial_energy = cz_kinetic_energy(batch, design);
    }
    batch->kernel->evaluate(batch->dynamics, batch->step);
    batch->kernel->commit(batch->dynamics, 0.0, 0.0);
    if (batch->integrator == CZ_INTEGRATOR_ZHAI || batch->design[0].over)
        return CZ_OK;
    const bool is_erk = batch->integrator == CZ_INTEGRATOR_ERK;
    return cz_reference_create(batch, is_erk ? CZ_METHOD_ERK : CZ_METHOD_ADAMS, options->tolerance,
                               &batch->reference, error);
}

/* Recording of a single design: channels at the output step, events at every step. */
typedef struct {
    CzRun *run;
    CzWatch *watch;
    CzBudget *budget; /* NULL for a reference */
    long every;       /* steps between samples */
    double rest_residual;
} Recording;

/* Largest residual of the vehicles at rest; NaN when none has running gear. */
static CzStatus find_rest_residual(CzBatch *batch, double *residual, CzError *error) {
    const int n_car = batch->n_car;
    CzRest *rest = cz_arena_allocate(&batch->arena, (size_t)n_car, sizeof *rest);
    *residual = NAN;
    if (rest == NULL)
        return cz_no_memory(error, "the vehicles at rest");
    CZ_TRY(cz_rest_of_cars(batch->design[0].model, batch->lanes, rest, error));
    for (int car = 0; car < n_car; ++car)
        *residual = fmax(*residual, rest[car].residual);
    return CZ_OK;
}

static CzStatus record_begin(Recording *recording, CzBatch *batch, CzRun *run, CzError *error) {
    recording->run = run;
    CZ_TRY(find_rest_residual(batch, &recording->rest_residual, error));
    const double wanted = batch->design[0].model->simulation->output_step / batch->step;
    recording->every = wanted > 1.0 ? lround(wanted) : 1;
    recording->watch = cz_watch_begin(batch, &run->arena);
    if (batch->reference == NULL)
        recording->budget = cz_budget_begin(batch, &run->arena);
    if (recording->watch == NULL || (recording->budget == NULL && batch->reference == NULL) ||
        cz_channels_begin(&run->channels, batch) != CZ_OK ||
        cz_channels_add(&run->channels, batch) != CZ_OK)
        return cz_no_memory(error, "the recording");
    return CZ_OK;
}

static CzStatus record_step(Recording *recording, const CzBatch *batch) {
    if (batch->reference == NULL) {
        cz_watch_update(recording->watch, batch);
        cz_budget_add(recording->budget, batch);
    }
    return batch->n_step % recording->every == 0 ? cz_channels_add(&recording->run->channels, batch)
                                                 : CZ_OK;
}

static void record_end(Recording *recording) {
    CzRunSummary *summary = &recording->run->summary;
    summary->rest_residual = recording->rest_residual;
    if (summary->beyond_validity)
        cz_channels_blank_totals(&recording->run->channels, summary->beyond_validity_time);
    if (recording->budget != NULL)
        summary->budget = cz_budget_result(recording->budget);
    summary->event = cz_watch_events(recording->watch, &summary->n_event);
}

/* Adds a step to the histories of the designs without a summary. */
static CzStatus add_history(const CzBatch *batch) {
    for (int design = 0; design < batch->n_design; ++design) {
        if (batch->design[design].has_summary)
            continue;
        if (cz_history_add(batch, design) != CZ_OK)
            return CZ_STATUS_NO_MEMORY;
        if (batch->keeps_pulses && batch->n_step % batch->sampling == 0)
            cz_sequence_update(batch, design);
    }
    return CZ_OK;
}

/* Writes the summaries of the designs whose run is over and that have none yet. */
static CzStatus finish(const CzBatch *batch, bool is_time) {
    for (int design = 0; design < batch->n_design; ++design) {
        CzProgressOfDesign *progress = &batch->design[design];
        if (!progress->over || progress->has_summary || !cz_ending_is_due(batch, design, is_time))
            continue;
        progress->has_summary = true;
        if (cz_summary_fill(batch, design, progress->run) != CZ_OK)
            return CZ_STATUS_NO_MEMORY;
        cz_history_free(&progress->history);
    }
    return CZ_OK;
}

/* Steps of the adaptive solver up to the end of the model's step. The run fails when the solver
 * does. */
static void step_reference(CzBatch *batch, const Recording *recording, double until) {
    CzProgressOfDesign *progress = &batch->design[0];
    CzError error = {0};
    for (int i = 0; i < MAX_STEPS && batch->time < until; ++i) {
        if (cz_reference_step(batch->reference, until, &error) != CZ_OK) {
            snprintf(progress->failure, sizeof progress->failure, "%.250s", error.message);
            break;
        }
        if (recording != NULL)
            cz_watch_update(recording->watch, batch);
    }
    if (batch->time >= until)
        return;
    if (progress->failure[0] == '\0')
        snprintf(progress->failure, sizeof progress->failure,
                 "the second solver needs more than %d steps within %g s at %.3f ms", MAX_STEPS,
                 batch->step, 1e3 * batch->time);
    progress->ended = CZ_ENDED_INCOMPLETE;
    progress->over = true;
}

/* Advances by one step of the model. */
static void step(CzBatch *batch, const Recording *recording) {
    const int first = batch->n_step == 0;
    const double until = (double)++batch->n_step * batch->step;
    if (batch->reference != NULL) {
        step_reference(batch, recording, until);
        return;
    }
    batch->time = until;
    batch->kernel->step(batch->dynamics, batch->step, first, batch->time);
}

/* The step with which the next duration ends; LONG_MAX when there is none. */
static long next_duration(const CzBatch *batch) {
    long next = LONG_MAX;
    for (int design = 0; design < batch->n_design; ++design) {
        const long last = batch->design[design].last;
        next = last > batch->n_step && last < next ? last : next;
    }
    return next;
}

/* Steps until the run of every design is over. */
static CzStatus march(CzBatch *batch, Recording *recording, CzError *error) {
    const double look_step = STEPS_BETWEEN_LOOKS * batch->design[0].model->time_step;
    const long look = (long)fmax(1.0, round(look_step / batch->step));
    CzStatus status = add_history(batch);
    long next = next_duration(batch);
    int n_left = batch->n_design;
    while (status == CZ_OK && n_left > 0) {
        step(batch, recording);
        status = add_history(batch);
        if (status == CZ_OK && recording != NULL)
            status = record_step(recording, batch);
        const bool is_time =
            batch->n_step % look == 0 || (batch->reference != NULL && batch->design[0].over);
        if (status == CZ_OK && (is_time || batch->n_step == next)) {
            n_left = cz_ending_check(batch, is_time);
            status = finish(batch, is_time);
            if (status == CZ_OK && n_left > 0 && n_left < batch->n_design)
                status = cz_batch_compact(batch, n_left, error);
            next = next_duration(batch);
        }
    }
    return status == CZ_OK ? CZ_OK : cz_no_memory(error, "the run");
}

static void batch_free(CzBatch *batch) {
    cz_reference_free(batch->reference);
    for (int design = 0; batch->design != NULL && design < batch->n_design; ++design)
        cz_history_free(&batch->design[design].history);
    cz_arena_free(&batch->laid);
    cz_arena_free(&batch->arena);
}

static void free_runs(int n, CzRun **run) {
    for (int i = 0; i < n; ++i) {
        cz_run_free(run[i]);
        run[i] = NULL;
    }
}

/* Simulates designs side by side with common time steps. */
static CzStatus simulate_together(int n, const CzPlannedRun *planned,
                                  const CzSimulateOptions *options, CzRun **run, CzError *error) {
    const double t0 = cz_clock();
    CzStatus status = CZ_OK;
    for (int i = 0; i < n; ++i) {
        run[i] = calloc(1, sizeof **run);
        if (run[i] == NULL)
            status = cz_no_memory(error, "the runs");
    }
    CzBatch batch = {0};
    Recording recording = {0};
    const bool records = options->record && n == 1;
    if (status == CZ_OK)
        status = begin(&batch, n, planned, options, run, error);
    if (status == CZ_OK && records)
        status = record_begin(&recording, &batch, run[0], error);
    const double t1 = cz_clock();
    if (status == CZ_OK)
        status = march(&batch, records ? &recording : NULL, error);
    if (status == CZ_OK && records)
        record_end(&recording);
    const double t2 = cz_clock();
    batch_free(&batch);
    if (status != CZ_OK)
        free_runs(n, run);
    else
        for (int i = 0; i < n; ++i) {
            run[i]->summary.setup_s = (t1 - t0) / n;
            run[i]->summary.wall_s = (t2 - t1) / n;
        }
    return status;
}

CzStatus cz_simulate_batch(int n, const CzPlannedRun *planned, const CzSimulateOptions *options,
                           CzRun **run, CzError *error) {
    const CzSimulateOptions chosen = options != NULL ? *options : cz_simulate_options_default();
    if (chosen.integrator == CZ_INTEGRATOR_ZHAI)
        return simulate_together(n, planned, &chosen, run, error);
    /* With adaptive steps the results of a design would depend on its neighbours. */
    CzStatus status = CZ_OK;
    int n_made = 0;
    for (; n_made < n && status == CZ_OK; ++n_made)
        status = simulate_together(1, &planned[n_made], &chosen, &run[n_made], error);
    if (status != CZ_OK)
        free_runs(n_made, run);
    return status;
}

CzStatus cz_simulate(const CzModel *model, const CzSimulateOptions *options, CzRun **run,
                     CzError *error) {
    return cz_simulate_batch(1, &(CzPlannedRun){model, NULL}, options, run, error);
}

void cz_run_free(CzRun *run) {
    if (run == NULL)
        return;
    cz_channels_free(&run->channels);
    cz_arena_free(&run->arena);
    free(run);
}
