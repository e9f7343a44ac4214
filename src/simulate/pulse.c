/* Values of a collision pulse. */
#include "simulate/pulse.h"

#include <math.h>
#include <stdlib.h>

#include "simulate/filter.h"

#define LISTED_SHARE 0.5 /* of the largest mean: windows with less are not listed (ours) */

/* ---- contact windows ---- */

double cz_pulse_largest_force(const CzPulse *pulse) {
    const double *force = pulse->force;
    double peak = 0.0;
#pragma omp simd reduction(max : peak)
    for (int i = 0; i < pulse->n_step; ++i)
        peak = fabs(force[i]) > peak ? fabs(force[i]) : peak;
    return peak;
}

bool cz_pulse_next_contact(const CzPulse *pulse, double floor, int *next, CzContactWindow *window) {
    const double *force = pulse->force, *speed = pulse->step_speed;
    const int last = pulse->n_step - 1;
    int start = *next;
    while (start < last && !(fabs(force[start]) > floor))
        ++start;
    if (start >= last)
        return false;
    int end = start + 1;
    while (end < last && fabs(force[end]) > floor && force[end] * force[start] > 0.0)
        ++end;
    const double length = (end - start) * pulse->time_step;
    *window = (CzContactWindow){start * pulse->time_step, end * pulse->time_step,
                                fabs(speed[end] - speed[start]) / length};
    *next = end;
    return true;
}

bool cz_pulse_list_windows(CzPulse *pulse, CzArena *arena) {
    const double floor = CZ_PULSE_FLOOR * cz_pulse_largest_force(pulse);
    const double least = LISTED_SHARE * cz_pulse_contact_mean(pulse, CZ_PULSE_FLOOR, 0.0, NULL);
    CzContactWindow next;
    int n = 0, from = 0;
    while (cz_pulse_next_contact(pulse, floor, &from, &next))
        n += next.mean >= least;
    CzContactWindow *list = cz_arena_allocate(arena, (size_t)n + 1, sizeof *list);
    if (list == NULL)
        return false;
    pulse->window = list;
    from = 0;
    while (cz_pulse_next_contact(pulse, floor, &from, &next))
        if (next.mean >= least)
            list[pulse->n_window++] = next;
    return true;
}

double cz_pulse_contact_mean(const CzPulse *pulse, double floor, double shortest,
                             double window[2]) {
    const double force = floor * cz_pulse_largest_force(pulse);
    CzContactWindow next;
    double largest = 0.0;
    int from = 0;
    while (cz_pulse_next_contact(pulse, force, &from, &next)) {
        const double length = round((next.to - next.from) / pulse->time_step) * pulse->time_step;
        if (length < shortest || !(next.mean > largest))
            continue;
        largest = next.mean;
        if (window == NULL)
            continue;
        window[0] = next.from;
        window[1] = next.to;
    }
    return largest;
}

/* ---- sliding windows ---- */

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

/* A longest-mean window is shorter than twice the smallest length, because a longer one splits into
 * two of which one has at least its mean. The largest mean of the shortest windows is found first:
 * groups of windows in which the speed changes less than that requires are skipped. */
double cz_pulse_sliding_mean(const CzPulse *pulse, double shortest_time, double window[2]) {
    enum { AT_ONCE = 64 };
    const double *speed = pulse->speed, step = pulse->step;
    const int n_sample = pulse->n_sample, shortest = (int)ceil(shortest_time / step - 1e-9);
    if (n_sample <= shortest)
        return 0.0;
    double largest = largest_change(speed, n_sample - shortest, shortest) / (shortest * step);
    int longest = largest > 0.0 ? shortest : 0; /* its length [sample], the shortest of equals */
    for (int first = 0; longest > 0 && first < n_sample - shortest; first += AT_ONCE) {
        const int left = n_sample - first, reach = AT_ONCE + 2 * shortest;
        const double range = range_of(speed + first, left < reach ? left : reach);
        if (range / ((shortest + 1) * step) < largest)
            continue;
        for (int length = shortest + 1; length <= 2 * shortest && length < left; ++length) {
            if (range / (length * step) < largest)
                break;
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

/* ---- secondary impact ---- */

/* Within a step the relative speed v changes evenly, by a per second, so that
 * v_impact^2 = v^2 + 2 a (distance - travelled). */
double cz_pulse_secondary_impact(const CzPulse *pulse, double distance, double *time) {
    const double *speed = pulse->speed, step = pulse->step;
    double travelled = 0.0, largest = 0.0, before = 0.0;
    *time = 0.0;
    for (int i = 1; i < pulse->n_sample; ++i) {
        const double after = speed[0] - speed[i];
        const double on = travelled + 0.5 * step * (before + after);
        if (fabs(on) >= distance) {
            const double left = (on > 0.0 ? distance : -distance) - travelled;
            const double square = before * before + 2.0 * (after - before) / step * left;
            const double impact = sqrt(square > 0.0 ? square : 0.0);
            *time = (i - 1) * step + 2.0 * fabs(left) / (fabs(before) + impact);
            return impact;
        }
        if (fabs(after) > largest) {
            largest = fabs(after);
            *time = i * step;
        }
        travelled = on;
        before = after;
    }
    return largest;
}

/* ---- filtered peak ---- */

CzStatus cz_pulse_filtered_peak(const CzPulse *pulse, double class_hz, double *peak) {
    const int n = pulse->n_sample - 1;
    *peak = NAN;
    if (n < 1 || !cz_filter_fits(class_hz, pulse->step))
        return CZ_OK;
    double *mean = malloc((size_t)n * sizeof *mean);
    if (mean == NULL)
        return CZ_STATUS_NO_MEMORY;
    for (int i = 0; i < n; ++i)
        mean[i] = (pulse->speed[i + 1] - pulse->speed[i]) / pulse->step;
    const CzStatus status = cz_filter_cfc(class_hz, pulse->step, n, mean, mean);
    *peak = 0.0;
    for (int i = 0; i < n; ++i)
        *peak = fmax(*peak, fabs(mean[i]));
    free(mean);
    return status;
}
