/* Simulates a collision from first contact to its end, for one design or for several side by
 * side. */
#include "simulate/batch.h"

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
        96,             /* lanes of a batch that still fit into the first-level cache (measured) */
    MOST_STEPS = 100000 /* of a reference within one step of the model: more occur only when events
                           follow one another endlessly (ours) */
};
#define SAMPLING 1e-3 /* of the history for mean decelerations [s] (ours) */

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

const char *cz_isa_name(void) {
    return cz_kernel(NULL)->isa;
}

/* Fills all lanes. The run of a design without a valid model has failed at once; its lanes get the
 * values of the file. */
static CzStatus fill_designs(CzBatch *batch, const CzVehicle *own, CzError *error) {
    for (int design = 0; design < batch->n_design; ++design) {
        CzProgressOfDesign *progress = &batch->design[design];
        CzError problem = {0};
        if (cz_model_fill(batch->model, batch->vehicles[design], design, batch->lanes, &problem) ==
            CZ_OK)
            continue;
        snprintf(progress->failure, sizeof progress->failure, "no model was built: %.220s",
                 problem.message);
        progress->over = true;
        progress->ended = CZ_ENDED_INCOMPLETE;
        CZ_TRY(cz_model_fill(batch->model, own, design, batch->lanes, error));
    }
    return CZ_OK;
}

static CzTrack track_of(const CzBatch *batch, CzTrackUse use) {
    const CzTrack own = (CzTrack)batch->model->simulation->track;
    if (own == CZ_TRACK_RIGID || use == CZ_TRACK_USE_OWN)
        return own;
    if (use == CZ_TRACK_USE_SEARCH)
        return batch->model->track->n_receptance > 0 ? CZ_TRACK_RECEPTANCE : own;
    return use == CZ_TRACK_USE_MODAL ? CZ_TRACK_MODAL : CZ_TRACK_FE;
}

/* Stores the equipment of the interfaces, which does not change in a run. */
static bool list_equipment(CzBatch *batch) {
    const size_t n = (size_t)batch->model->n_car * (size_t)batch->n_design;
    batch->equipment = cz_arena_allocate(&batch->arena, n, sizeof *batch->equipment);
    for (size_t lane = 0; batch->equipment != NULL && lane < n; lane++)
        batch->equipment[lane] = cz_interface_equipment(batch->lanes, lane);
    return batch->equipment != NULL;
}

/* Memory, lanes and state at t = 0. */
static CzStatus begin(CzBatch *batch, const CzModel *model, int n_design,
                      const CzVehicle *const *vehicles, const CzSimulateOptions *options,
                      CzError *error) {
    memset(batch, 0, sizeof *batch);
    batch->model = model;
    batch->kernel = cz_kernel(options->isa);
    if (batch->kernel == NULL)
        return cz_fail(error, CZ_STATUS_INPUT, "no kernel for instruction set '%s' here",
                       options->isa);
    batch->n_design = n_design;
    batch->brief = options->brief;
    batch->integrator = options->integrator;
    batch->step = options->time_step > 0.0 ? options->time_step : model->time_step;
    int n_vehicle;
    const CzVehicle *own = cz_problem_vehicles(model->problem, &n_vehicle);
    const CzVehicle **used = cz_arena_allocate(&batch->arena, (size_t)n_design, sizeof *used);
    batch->design = cz_arena_allocate(&batch->arena, (size_t)n_design, sizeof *batch->design);
    batch->stored = cz_arena_allocate(&batch->arena, (size_t)model->n_car * (size_t)n_design,
                                      sizeof *batch->stored);
    batch->load = cz_interface_loads_begin(batch, &batch->arena);
    batch->lanes = cz_model_lanes(model, n_design, &batch->arena);
    if (batch->lanes != NULL)
        batch->in_track = cz_arena_allocate(&batch->arena, batch->lanes->n_lane / CZ_LANE_BLOCK,
                                            sizeof *batch->in_track);
    if (used == NULL || batch->design == NULL || batch->stored == NULL || batch->load == NULL ||
        batch->in_track == NULL)
        return cz_no_memory(error, "the designs");
    for (int design = 0; design < n_design; ++design) {
        used[design] = vehicles != NULL && vehicles[design] != NULL ? vehicles[design] : own;
        batch->design[design].override_time = NAN;
        batch->design[design].wheel_rail = NAN;
        batch->design[design].quiet_since = NAN;
        batch->design[design].settled_since = NAN;
    }
    batch->vehicles = used;
    CZ_TRY(fill_designs(batch, own, error));
    batch->dynamics = cz_dynamics_create(batch->lanes, &batch->arena);
    if (batch->dynamics == NULL || !list_equipment(batch))
        return cz_no_memory(error, "the designs");
    const double track_step = batch->integrator == CZ_INTEGRATOR_ZHAI ? batch->step : 0.0;
    if (model->track != NULL &&
        !cz_dynamics_lay_track(batch->dynamics, model->track, track_of(batch, options->track),
                               track_step, &batch->arena))
        return cz_no_memory(error, "the track");
    batch->closing_speed = cz_closing_speed(batch, model->colliding, 0);
    const double samples = fmax(1.0, round(SAMPLING / batch->step));
    batch->history.stride = batch->lanes->n_lane;
    batch->history.step = samples * batch->step;
    for (int design = 0; design < n_design; ++design)
        batch->design[design].initial_energy = cz_kinetic_energy(batch, design);
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
    const int n_car = batch->model->n_car;
    CzRest *rest = cz_arena_allocate(&batch->arena, (size_t)n_car, sizeof *rest);
    *residual = NAN;
    if (rest == NULL)
        return cz_no_memory(error, "the vehicles at rest");
    CZ_TRY(cz_rest_of_cars(batch->model, batch->lanes, rest, error));
    for (int car = 0; car < n_car; ++car)
        *residual = fmax(*residual, rest[car].residual);
    return CZ_OK;
}

static CzStatus record_begin(Recording *recording, CzBatch *batch, CzRun *run, CzError *error) {
    recording->run = run;
    CZ_TRY(find_rest_residual(batch, &recording->rest_residual, error));
    const double wanted = batch->model->simulation->output_step / batch->step;
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
        cz_watch_look(recording->watch, batch);
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

/* Writes the summaries of the designs whose run is over and that have none yet. */
static CzStatus finish(const CzBatch *batch, CzRun **run, bool *written) {
    for (int design = 0; design < batch->n_design; ++design) {
        if (!batch->design[design].over || written[design])
            continue;
        written[design] = true;
        if (cz_summary_fill(batch, design, run[design]) != CZ_OK)
            return CZ_STATUS_NO_MEMORY;
    }
    return CZ_OK;
}

/* Steps of the adaptive solver up to the end of the model's step. The run fails when the solver
 * does. */
static void step_reference(CzBatch *batch, const Recording *recording, double until) {
    CzProgressOfDesign *progress = &batch->design[0];
    CzError error = {0};
    for (int i = 0; i < MOST_STEPS && batch->time < until; ++i) {
        if (cz_reference_step(batch->reference, until, &error) != CZ_OK) {
            snprintf(progress->failure, sizeof progress->failure, "%.250s", error.message);
            break;
        }
        if (recording != NULL)
            cz_watch_look(recording->watch, batch);
    }
    if (batch->time >= until)
        return;
    if (progress->failure[0] == '\0')
        snprintf(progress->failure, sizeof progress->failure,
                 "the second solver needs more than %d steps within %g s at %.3f ms", MOST_STEPS,
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

/* Steps until the run of every design is over. */
static CzStatus march(CzBatch *batch, CzRun **run, Recording *recording, CzError *error) {
    bool *written = cz_arena_allocate(&batch->arena, (size_t)batch->n_design, sizeof *written);
    if (written == NULL)
        return cz_no_memory(error, "the run");
    const long every = lround(batch->history.step / batch->step);
    const double length = batch->model->duration;
    const long look =
        (long)fmax(1.0, round(STEPS_BETWEEN_LOOKS * batch->model->time_step / batch->step));
    const long last = isnan(length) ? 0 : lround(length / batch->step);
    CzStatus status = cz_history_add(&batch->history, batch);
    bool all_over = false;
    while (status == CZ_OK && !all_over) {
        step(batch, recording);
        if (batch->n_step % every == 0)
            status = cz_history_add(&batch->history, batch);
        if (status == CZ_OK && recording != NULL)
            status = record_step(recording, batch);
        if (status == CZ_OK && (batch->n_step % look == 0 || batch->n_step == last ||
                                (batch->reference != NULL && batch->design[0].over))) {
            all_over = cz_ending_look(batch);
            status = finish(batch, run, written);
        }
    }
    return status == CZ_OK ? CZ_OK : cz_no_memory(error, "the run");
}

static void batch_free(CzBatch *batch) {
    cz_reference_free(batch->reference);
    cz_history_free(&batch->history);
    cz_arena_free(&batch->arena);
}

static void free_runs(int n_design, CzRun **run) {
    for (int design = 0; design < n_design; ++design) {
        cz_run_free(run[design]);
        run[design] = NULL;
    }
}

/* Simulates designs side by side with common time steps. */
static CzStatus simulate_together(const CzModel *model, int n_design,
                                  const CzVehicle *const *vehicles,
                                  const CzSimulateOptions *options, CzRun **run, CzError *error) {
    const double t0 = cz_clock();
    CzStatus status = CZ_OK;
    for (int design = 0; design < n_design; ++design) {
        run[design] = calloc(1, sizeof **run);
        if (run[design] == NULL)
            status = cz_no_memory(error, "the runs");
    }
    CzBatch batch = {0};
    Recording recording = {0};
    const bool records = options->record && n_design == 1;
    if (status == CZ_OK)
        status = begin(&batch, model, n_design, vehicles, options, error);
    if (status == CZ_OK && records)
        status = record_begin(&recording, &batch, run[0], error);
    const double t1 = cz_clock();
    if (status == CZ_OK)
        status = march(&batch, run, records ? &recording : NULL, error);
    if (status == CZ_OK && records)
        record_end(&recording);
    const double t2 = cz_clock();
    batch_free(&batch);
    if (status != CZ_OK)
        free_runs(n_design, run);
    else
        for (int design = 0; design < n_design; ++design) {
            run[design]->summary.setup_s = (t1 - t0) / n_design;
            run[design]->summary.wall_s = (t2 - t1) / n_design;
        }
    return status;
}

CzStatus cz_simulate_batch(const CzModel *model, int n_design, const CzVehicle *const *vehicles,
                           const CzSimulateOptions *options, CzRun **run, CzError *error) {
    const CzSimulateOptions chosen = options != NULL ? *options : cz_simulate_options_default();
    if (chosen.integrator == CZ_INTEGRATOR_ZHAI)
        return simulate_together(model, n_design, vehicles, &chosen, run, error);
    /* With adaptive steps the results of a design would depend on its neighbours. */
    CzStatus status = CZ_OK;
    int n_made = 0;
    for (; n_made < n_design && status == CZ_OK; ++n_made)
        status = simulate_together(model, 1, vehicles != NULL ? &vehicles[n_made] : NULL, &chosen,
                                   &run[n_made], error);
    if (status != CZ_OK)
        free_runs(n_made, run);
    return status;
}

CzStatus cz_simulate(const CzModel *model, const CzSimulateOptions *options, CzRun **run,
                     CzError *error) {
    return cz_simulate_batch(model, 1, NULL, options, run, error);
}

void cz_run_free(CzRun *run) {
    if (run == NULL)
        return;
    cz_channels_free(&run->channels);
    cz_arena_free(&run->arena);
    free(run);
}
