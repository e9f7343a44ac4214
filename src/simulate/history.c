/* Body speeds and interface forces over time. */
#include "simulate/run.h"

#include <stdlib.h>

CzStatus cz_history_add(const CzBatch *batch, int design) {
    CzHistory *history = &batch->design[design].history;
    const size_t n_car = (size_t)batch->n_car;
    if (history->n_sample == history->n_chunk * CZ_CHUNK) {
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
        history->chunk[history->n_chunk - 1] + (size_t)(history->n_sample % CZ_CHUNK) * 2 * n_car;
    for (int car = 0; car < batch->n_car; ++car, sample += 2) {
        const size_t lane = cz_lane(batch, car, design), i = lane % CZ_LANE_BLOCK;
        const CzBlock *block = cz_block_of(batch->dynamics, lane);
        sample[0] = block->velocity.body.x[i];
        sample[1] = block->published.interface.force[i];
    }
    ++history->n_sample;
    return CZ_OK;
}

/* Speed of a car, and force of the interface ahead of it. */
static const double *sample_of(const CzBatch *batch, int sample, int car, int design) {
    const double *chunk = batch->design[design].history.chunk[sample / CZ_CHUNK];
    return chunk + 2 * (sample % CZ_CHUNK * batch->n_car + car);
}

void cz_history_free(CzHistory *history) {
    for (int i = 0; i < history->n_chunk; ++i)
        free(history->chunk[i]);
    free(history->chunk);
    history->chunk = NULL;
    history->n_chunk = history->n_sample = 0;
}

/* Net contact force on a car: the push from behind less the push from ahead. */
static double net_force(const CzBatch *batch, int sample, int car, int design) {
    const bool first = car == 0, last = car == batch->n_car - 1;
    const double behind = first ? 0.0 : sample_of(batch, sample, car - 1, design)[1];
    return behind - (last ? 0.0 : sample_of(batch, sample, car, design)[1]);
}

bool cz_history_pulse(const CzBatch *batch, int car, int design, CzArena *arena, CzPulse *pulse) {
    const CzHistory *history = &batch->design[design].history;
    const size_t n = (size_t)history->n_sample;
    double *speed = cz_arena_numbers(arena, n), *force = cz_arena_numbers(arena, n);
    if (speed == NULL || force == NULL)
        return false;
    for (int i = 0; i < history->n_sample; ++i) {
        speed[i] = sample_of(batch, i, car, design)[0];
        force[i] = net_force(batch, i, car, design);
    }
    *pulse = (CzPulse){
        .n_sample = history->n_sample, .step = batch->history_step, .speed = speed, .force = force};
    return true;
}
