/* Body speeds and interface forces over time. */
#include "simulate/run.h"

#include <stdlib.h>

CzStatus cz_history_add(const CzBatch *batch, int design) {
    CzHistory *history = &batch->design[design].history;
    const size_t n_car = (size_t)batch->n_car;
    if (history->n_step == history->n_chunk * CZ_CHUNK) {
        double **chunks = realloc(history->chunk, (size_t)(history->n_chunk + 1) * sizeof *chunks);
        if (chunks == NULL)
            return CZ_STATUS_NO_MEMORY;
        history->chunk = chunks;
        chunks[history->n_chunk] = malloc(2 * CZ_CHUNK * n_car * sizeof(double));
        if (chunks[history->n_chunk] == NULL)
            return CZ_STATUS_NO_MEMORY;
        ++history->n_chunk;
    }
    double *sample =
        history->chunk[history->n_chunk - 1] + (size_t)(history->n_step % CZ_CHUNK) * 2 * n_car;
    for (int car = 0; car < batch->n_car; ++car, sample += 2) {
        const size_t lane = cz_lane(batch, car, design), i = lane % CZ_LANE_BLOCK;
        const CzBlock *block = cz_block_of(batch->dynamics, lane);
        sample[0] = block->velocity.body.x[i];
        sample[1] = block->published.interface.force[i];
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

/* Values of a car after the first step of a chunk, its speed and the force of the interface ahead
 * of it; those after the next step are two numbers for each car further. */
static const double *values_in(const CzHistory *history, int chunk, int car) {
    return history->chunk[chunk] + 2 * car;
}

/* Steps that a chunk holds. */
static int n_in_chunk(const CzHistory *history, int chunk) {
    const int left = history->n_step - chunk * CZ_CHUNK;
    return left < CZ_CHUNK ? left : CZ_CHUNK;
}

/* Speeds of a car, and the net contact forces on it: the push from behind less that from ahead. */
static void copy_steps(const CzBatch *batch, int car, int design, double *speed, double *force) {
    const CzHistory *history = &batch->design[design].history;
    const int stride = 2 * batch->n_car;
    const bool first = car == 0, last = car == batch->n_car - 1;
    for (int chunk = 0, i = 0; chunk < history->n_chunk; ++chunk) {
        const double *values = values_in(history, chunk, car);
        for (int k = n_in_chunk(history, chunk); k > 0; --k, ++i, values += stride) {
            speed[i] = values[0];
            force[i] = (first ? 0.0 : values[-1]) - (last ? 0.0 : values[1]);
        }
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
    for (int chunk = 0, i = 0; chunk < history->n_chunk; ++chunk) {
        const double *values = values_in(history, chunk, interface);
        for (int k = n_in_chunk(history, chunk); k > 0; --k, values += 2 * batch->n_car)
            force[i++] = values[1];
    }
}
