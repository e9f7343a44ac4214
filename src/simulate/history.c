/* Body speeds and interface forces over time, and the mean decelerations that follow from them. */
#include "simulate/run.h"

#include <math.h>
#include <stdlib.h>

#define SHORTEST_CONTACT 0.03 /* shortest contact window that counts [s] (ours) */
#define WINDOW 0.12           /* [s] */
#define FORCE_FLOOR                                                                                \
    0.01 /* of the largest net force: a smaller force counts as no contact (ours)                  \
          */

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

/* Largest |change of speed| / time over the intervals in which the net contact force keeps its sign
 * above the floor. */
static double contact_mean(const double *speed, const double *force, int n_sample, double step,
                           double window[2]) {
    double peak = 0.0;
    for (int i = 0; i < n_sample; ++i)
        peak = fabs(force[i]) > peak ? fabs(force[i]) : peak;
    double largest = 0.0, sign = 0.0;
    int start = -1;
    for (int i = 0; i < n_sample; ++i) {
        const bool pushes = fabs(force[i]) > FORCE_FLOOR * peak;
        const bool goes_on = start >= 0 && pushes && force[i] * sign > 0.0;
        if (goes_on && i < n_sample - 1)
            continue;
        const double length = (i - start) * step;
        const double mean =
            start >= 0 && length >= SHORTEST_CONTACT ? fabs(speed[i] - speed[start]) / length : 0.0;
        if (mean > largest) {
            largest = mean;
            window[0] = start * step;
            window[1] = i * step;
        }
        start = pushes ? i : -1;
        sign = force[i];
    }
    return largest;
}

/* Difference of the largest and the smallest speed of some samples. */
static double range_of(const double *speed, int n_sample) {
    double low = INFINITY, high = -INFINITY;
#pragma omp simd reduction(min : low) reduction(max : high)
    for (int i = 0; i < n_sample; ++i) {
        low = speed[i] < low ? speed[i] : low;
        high = speed[i] > high ? speed[i] : high;
    }
    return high - low;
}

/* Largest |change of speed| over the windows of a length that start at the first samples. */
static double largest_change(const double *speed, int n_start, int length) {
    double change = 0.0;
#pragma omp simd reduction(max : change)
    for (int start = 0; start < n_start; ++start) {
        const double size = fabs(speed[start + length] - speed[start]);
        change = size > change ? size : change;
    }
    return change;
}

/* Largest |change of speed| / time over all windows of at least WINDOW. A longest-mean window is
 * shorter than twice the smallest length, because a longer one splits into two of which one has at
 * least its mean. `speed` holds the samples of one car. Windows in which the speed hardly changes
 * are skipped in groups, because they are most of a run. */
static double window_mean(const double *speed, int n_sample, double step, double window[2]) {
    enum { AT_ONCE = 64 };
    const int shortest = (int)ceil(WINDOW / step - 1e-9);
    double largest = 0.0;
    int longest = 0; /* the window's length [sample], the shortest of equals */
    for (int first = 0; first < n_sample - shortest; first += AT_ONCE) {
        const int left = n_sample - first, reach = AT_ONCE + 2 * shortest;
        const double range = range_of(speed + first, left < reach ? left : reach);
        if (range == 0.0 || range / (shortest * step) < largest)
            continue;
        for (int length = shortest; length <= 2 * shortest && length < left; ++length) {
            const int n_start = left - length < AT_ONCE ? left - length : AT_ONCE;
            const double mean = largest_change(speed + first, n_start, length) / (length * step);
            if (mean > largest || (mean == largest && length < longest))
                longest = length;
            largest = fmax(mean, largest);
        }
    }
    for (int start = 0; longest > 0 && start < n_sample - longest; ++start)
        if (fabs(speed[start + longest] - speed[start]) / (longest * step) == largest) {
            window[0] = start * step;
            window[1] = (start + longest) * step;
            break;
        }
    return largest;
}

CzStatus cz_history_decelerations(const CzBatch *batch, int car, int design,
                                  CzVehicleResult *result) {
    const CzHistory *history = &batch->design[design].history;
    const double step = batch->history_step;
    double *speed = malloc((size_t)history->n_sample * sizeof *speed);
    double *force = malloc((size_t)history->n_sample * sizeof *force);
    const bool fits = speed != NULL && force != NULL;
    for (int i = 0; fits && i < history->n_sample; ++i) {
        speed[i] = sample_of(batch, i, car, design)[0];
        force[i] = net_force(batch, i, car, design);
    }
    if (fits) {
        result->mean_deceleration_contact =
            contact_mean(speed, force, history->n_sample, step, result->contact_window);
        result->mean_deceleration_120ms =
            window_mean(speed, history->n_sample, step, result->window_120ms);
    }
    free(speed);
    free(force);
    return fits ? CZ_OK : CZ_STATUS_NO_MEMORY;
}
