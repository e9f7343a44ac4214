/* Body speeds and interface forces over time. */
#include "simulate/run.h"

#include <stdlib.h>
#include <string.h>

/* Numbers from one quantity of a chunk to the next: a few more than its steps, so that the numbers
 * of one step are not all in the same set of the first cache. */
enum { STRIDE = CZ_CHUNK + CZ_LANE_BLOCK };

CzStatus cz_history_add(const CzBatch *batch, int design) {
    CzHistory *history = &batch->design[design].history;
    const size_t n_car = (size_t)batch->n_car;
    if (history->n_step == history->n_chunk * CZ_CHUNK) {
        double **chunks = realloc(history->chunk, (size_t)(history->n_chunk + 1) * sizeof *chunks);
        if (chunks == NULL)
            return CZ_STATUS_NO_MEMORY;
        history->chunk = chunks;
        chunks[history->n_chunk] = malloc(2 * STRIDE * n_car * sizeof(double));
        if (chunks[history->n_chunk] == NULL)
            return CZ_STATUS_NO_MEMORY;
        ++history->n_chunk;
    }
    double *speed = history->chunk[history->n_chunk - 1] + history->n_step % CZ_CHUNK;
    for (int car = 0; car < batch->n_car; ++car, speed += 2 * STRIDE) {
        const size_t lane = cz_lane(batch, car, design), i = lane % CZ_LANE_BLOCK;
        const CzBlock *block = cz_block_of(batch->dynamics, lane);
        speed[0] = block->velocity.body.x[i];
        speed[STRIDE] = block->published.interface.force[i];
    }
    ++history->n_step;
    return CZ_OK;
}

void cz_history_free(CzHistory *history) {
    for (int i = 0; i < history->n_chunk; ++i)
        free(history->chunk[i]);
    free(history->chunk);
    history->chunk = NULL;
    history->n_chunk = history->n_step = 0;
}

/* Speeds of a car in a chunk, and forces of the interface ahead of it. */
static const double *speeds_in(const CzHistory *history, int chunk, int car) {
    return history->chunk[chunk] + 2 * STRIDE * car;
}

static const double *forces_in(const CzHistory *history, int chunk, int car) {
    return speeds_in(history, chunk, car) + STRIDE;
}

/* Steps that a chunk holds. */
static int n_in_chunk(const CzHistory *history, int chunk) {
    const int left = history->n_step - chunk * CZ_CHUNK;
    return left < CZ_CHUNK ? left : CZ_CHUNK;
}

/* Speeds of a car, and the net contact forces on it: the push from behind less that from ahead. */
static void copy_steps(const CzBatch *batch, int car, int design, double *restrict speed,
                       double *restrict force) {
    static const double none[CZ_CHUNK] = {0.0};
    const CzHistory *history = &batch->design[design].history;
    for (int chunk = 0; chunk < history->n_chunk; ++chunk) {
        const int n = n_in_chunk(history, chunk), first = chunk * CZ_CHUNK;
        const double *restrict behind = car == 0 ? none : forces_in(history, chunk, car - 1);
        const double *restrict ahead =
            car == batch->n_car - 1 ? none : forces_in(history, chunk, car);
        memcpy(speed + first, speeds_in(history, chunk, car), (size_t)n * sizeof *speed);
#pragma omp simd
        for (int k = 0; k < n; ++k)
            force[first + k] = behind[k] - ahead[k];
    }
}

bool cz_history_pulse(const CzBatch *batch, int car, int design, CzArena *arena, CzPulse *pulse) {
    const int n_step = batch->design[design].history.n_step, every = (int)batch->sampling;
    const int n_sample = (n_step + every - 1) / every;
    double *speed = cz_arena_numbers(arena, (size_t)n_sample),
           *step_speed = cz_arena_numbers(arena, (size_t)n_step),
           *force = cz_arena_numbers(arena, (size_t)n_step);
    if (speed == NULL || step_speed == NULL || force == NULL)
        return false;
    copy_steps(batch, car, design, step_speed, force);
    for (int i = 0; i < n_sample; ++i)
        speed[i] = step_speed[i * every];
    *pulse = (CzPulse){.n_sample = n_sample,
                       .n_step = n_step,
                       .step = every * batch->step,
                       .time_step = batch->step,
                       .speed = speed,
                       .step_speed = step_speed,
                       .force = force};
    return true;
}

void cz_history_forces(const CzBatch *batch, int interface, int design, double *force) {
    const CzHistory *history = &batch->design[design].history;
    for (int chunk = 0; chunk < history->n_chunk; ++chunk)
        memcpy(force + chunk * CZ_CHUNK, forces_in(history, chunk, interface),
               (size_t)n_in_chunk(history, chunk) * sizeof *force);
}
