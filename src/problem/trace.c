/* Converts measured points to a force-stroke curve. */
#include "problem/trace.h"

#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>

#include "base/number.h"

#define STROKE_NOISE 0.01 /* of the largest stroke: noise while loading (ours) */
#define FORCE_NOISE 0.02  /* of the largest force: a smaller one counts as zero (ours) */
#define MAX_TURNS                                                                                  \
    3 /* of strokes in some order: a wiggle before the load, and the unloading (ours) */
#define CONTACT 0.01     /* of the largest force: contact begins there (ours) */
#define FREE_TRAVEL 0.05 /* of the stroke: more without force is reported (ours) */
#define UNLOADED 0.8     /* an unloading ends below this share of the force (ours) */
#define UNLOADING 1e-3   /* of the stroke: a smaller decrease is not an unloading (ours) */

CzTraceShape cz_trace_shape_default(void) {
    return (CzTraceShape){.scale = 1.0, .from = NAN, .to = NAN};
}

/* A trace while it is converted. */
typedef struct Making {
    CzMistakes *mistakes;
    const CzSource *source;
    const CzTraceShape *shape;
    double unit;
    CzTrace *trace;
} Making;

__attribute__((format(printf, 2, 3))) static void note(CzTrace *trace, const char *format, ...) {
    va_list arguments;
    if (trace->n_note == CZ_TRACE_MAX_NOTES)
        return;
    va_start(arguments, format);
    vsnprintf(trace->note[trace->n_note++], sizeof trace->note[0], format, arguments);
    va_end(arguments);
}

__attribute__((format(printf, 3, 4))) static bool refuse(const Making *making, int point,
                                                         const char *format, ...) {
    const CzNode place = {
        .source = making->source, .line = making->trace->line[point], .column = 1};
    va_list arguments;
    va_start(arguments, format);
    cz_mistake_list(making->mistakes, &place, NULL, format, arguments);
    va_end(arguments);
    return false;
}

/* Numbers of a sentence. */
#define MM(stroke) CZ_SHORT(1e3 * (stroke))
#define KN(force) CZ_SHORT(1e-3 * (force))

/* Least and largest value. */
typedef struct Range {
    double least, largest;
} Range;

static Range range_of(const double *value, int n) {
    Range range = {value[0], value[0]};
    for (int i = 1; i < n; i++) {
        range.least = fmin(range.least, value[i]);
        range.largest = fmax(range.largest, value[i]);
    }
    return range;
}

/* ---- signs ---- */

static void flip(double *value, int n) {
    for (int i = 0; i < n; i++)
        value[i] = 0.0 - value[i];
}

static bool set_indicators(Making *making) {
    CzTrace *trace = making->trace;
    const CzTraceShape *shape = making->shape;
    for (int i = 0; i < trace->n; i++)
        if (!isfinite(trace->x[i]) || !isfinite(trace->f[i]))
            return refuse(making, i, "a point is not finite");
    for (int i = 0; i < trace->n; i++)
        trace->f[i] *= shape->scale;
    if (shape->flips[0])
        flip(trace->x, trace->n);
    if (shape->flips[1])
        flip(trace->f, trace->n);
    const Range x = range_of(trace->x, trace->n), f = range_of(trace->f, trace->n);
    const double down = trace->x[0] - x.least, up = x.largest - trace->x[0];
    const bool stroke_falls = down > 0.0 && up <= STROKE_NOISE * down;
    const bool force_is_below = f.least < 0.0 && f.largest <= FORCE_NOISE * -f.least;
    if (shape->flips[0] || shape->flips[1] || stroke_falls == force_is_below) {
        if (stroke_falls && force_is_below && !shape->flips[0] && !shape->flips[1]) {
            flip(trace->x, trace->n);
            flip(trace->f, trace->n);
            note(trace, "compression is negative in the file: the signs of strokes and forces were "
                        "changed");
        }
        return true;
    }
    const char *help = shape->flip_help != NULL ? shape->flip_help : "";
    if (stroke_falls)
        return refuse(
            making, 0,
            "the stroke falls from %s to %s mm while the force is positive: either its "
            "sign is that of an opening, or the points are in the reverse order" CZ_HELP "%s%s",
            MM(trace->x[0]), MM(x.least), help,
            help[0] != '\0' ? "; lines in the reverse order have to be sorted by the stroke" : "");
    return refuse(making, 0,
                  "the forces are negative, down to %s kN, while the stroke grows: either tension "
                  "is positive, or this is a test in tension" CZ_HELP "%s",
                  KN(f.least), help);
}

/* ---- the part that counts, and its zero ---- */

/* Drops the points before one. */
static void drop_before(CzTrace *trace, int first) {
    if (first == 0)
        return;
    trace->n -= first;
    memmove(trace->x, trace->x + first, (size_t)trace->n * sizeof *trace->x);
    memmove(trace->f, trace->f + first, (size_t)trace->n * sizeof *trace->f);
    memmove(trace->line, trace->line + first, (size_t)trace->n * sizeof *trace->line);
}

/* Begins a curve where the stroke first reaches a value, by interpolation. */
static void begin_at(CzTrace *trace, double at) {
    int first = 0;
    while (first < trace->n && trace->x[first] < at)
        first++;
    if (first == 0 || first == trace->n)
        return;
    if (trace->x[first] > at) {
        first--;
        const double share = (at - trace->x[first]) / (trace->x[first + 1] - trace->x[first]);
        trace->f[first] += share * (trace->f[first + 1] - trace->f[first]);
        trace->x[first] = at;
    }
    drop_before(trace, first);
}

/* Ends a curve where the stroke first reaches a value, by interpolation. */
static void end_at(CzTrace *trace, double at) {
    int end = 0;
    while (end < trace->n && trace->x[end] < at)
        end++;
    if (end == trace->n)
        return;
    if (end > 0) {
        const double share = (at - trace->x[end - 1]) / (trace->x[end] - trace->x[end - 1]);
        trace->f[end] = trace->f[end - 1] + share * (trace->f[end] - trace->f[end - 1]);
        trace->x[end] = at;
    }
    trace->n = end + 1;
}

static bool cut_part(Making *making) {
    CzTrace *trace = making->trace;
    const double low = making->shape->from * making->unit, high = making->shape->to * making->unit;
    const Range x = range_of(trace->x, trace->n);
    if (low >= x.largest || high <= x.least || low >= high)
        return refuse(making, 0, "no stroke is left: those of the file go from %s to %s mm",
                      MM(x.least), MM(x.largest));
    if (!isnan(high))
        end_at(trace, high);
    if (!isnan(low))
        begin_at(trace, low);
    return true;
}

/* Rejects strokes that reverse, by more than noise, as often as unordered points or many cycles do,
 * since a message about their beginning would mislead. */
static bool check_turns(const Making *making) {
    const CzTrace *trace = making->trace;
    const Range x = range_of(trace->x, trace->n);
    const double noise = STROKE_NOISE * (x.largest - x.least);
    int n_turn = 0, direction = 0, first = 0;
    double extreme = trace->x[0], turned_at = extreme;
    for (int i = 1; i < trace->n; i++) {
        const double move = trace->x[i] - extreme;
        if (direction != 0 && move * direction < -noise && n_turn++ == 0) {
            first = i;
            turned_at = extreme;
        }
        if (fabs(move) > noise || move * direction > 0.0) {
            direction = move > 0.0 ? 1 : -1;
            extreme = trace->x[i];
        }
    }
    if (n_turn <= MAX_TURNS)
        return true;
    return refuse(making, first,
                  "the strokes turn %d times, first from %s to %s mm" CZ_HELP
                  "a curve has one loading in the order of the strokes, and at most one unloading; "
                  "sort the lines, or remove cycles",
                  n_turn, MM(turned_at), MM(trace->x[first]));
}

/* Point at which the force begins: the last one before it rises above the noise. */
static int find_contact(const CzTrace *trace, double peak) {
    int first = 0;
    while (first + 1 < trace->n && trace->f[first + 1] <= CONTACT * peak)
        first++;
    return first;
}

/* The zero of a curve for which none is given. */
static bool find_zero(Making *making, double peak, double *zero) {
    CzTrace *trace = making->trace;
    const Range x = range_of(trace->x, trace->n);
    const double first = trace->x[0];
    *zero = 0.0;
    if (first >= 0.0 && first <= STROKE_NOISE * x.largest)
        return true;
    *zero = first;
    if (trace->f[0] <= FORCE_NOISE * peak || !isnan(making->shape->from)) {
        note(trace, "strokes count from %s mm of the file, where it begins", MM(first));
        return true;
    }
    refuse(making, 0,
           "the curve begins at a stroke of %s mm with a force of %s kN: either this is stroke 0, "
           "or earlier points are missing",
           MM(first), KN(trace->f[0]));
    cz_mistake_help(making->mistakes, making->shape->zero_help);
    return false;
}

static bool set_zero(Making *making) {
    CzTrace *trace = making->trace;
    const double peak = range_of(trace->f, trace->n).largest;
    double zero = trace->x[0];
    switch (making->shape->zero) {
    case CZ_ZERO_AT_STROKE:
        zero = making->shape->zero_at * making->unit;
        break;
    case CZ_ZERO_AT_CONTACT:
        drop_before(trace, find_contact(trace, peak));
        zero = trace->x[0];
        note(trace, "strokes count from %s mm of the file, where the force begins", MM(zero));
        break;
    case CZ_ZERO_AT_START:
        break;
    default:
        if (!find_zero(making, peak, &zero))
            return false;
    }
    if (zero == 0.0)
        return true;
    begin_at(trace, zero);
    for (int i = 0; i < trace->n; i++)
        trace->x[i] -= zero;
    return true;
}

/* ---- checks ---- */

/* Strokes and forces a little below zero are the noise of a sensor and become zero. */
static bool check_sizes(Making *making) {
    CzTrace *trace = making->trace;
    const double far = range_of(trace->x, trace->n).largest;
    const double peak = range_of(trace->f, trace->n).largest;
    for (int i = 0; i < trace->n; i++) {
        const double x = trace->x[i], f = trace->f[i];
        if (x < -STROKE_NOISE * fmax(far, 0.0) || (far <= 0.0 && x < 0.0))
            return refuse(
                making, i,
                "a stroke of %s mm is negative; a curve begins at 0, and compression is positive",
                MM(x));
        if (x > CZ_LARGEST_STROKE)
            return refuse(making, i,
                          "a stroke of %s mm is larger than allowed for a stage; check the unit",
                          MM(x));
        if (f > CZ_LARGEST_FORCE)
            return refuse(making, i,
                          "a force of %s kN is larger than allowed for a stage; check the unit",
                          KN(f));
        if (f < -FORCE_NOISE * fmax(peak, 0.0) || (peak <= 0.0 && f < 0.0))
            return refuse(making, i, "a force of %s kN is negative; compression is positive",
                          KN(f));
        trace->x[i] = fmax(x, 0.0);
        trace->f[i] = fmax(f, 0.0);
    }
    return peak > 0.0 || refuse(making, 0, "no point of the curve has a force");
}

/* Strokes may decrease by noise, or once after the largest. */
static bool check_order(const Making *making) {
    const CzTrace *trace = making->trace;
    const double noise = STROKE_NOISE * trace->x[trace->n_loading - 1];
    double furthest = trace->x[0];
    for (int i = 1; i < trace->n; i++) {
        const bool is_loading = i < trace->n_loading;
        const double back = is_loading ? furthest - trace->x[i] : trace->x[i] - furthest;
        if (back > noise)
            return refuse(making, i,
                          "the stroke goes %s from %s to %s mm %s the largest" CZ_HELP
                          "a curve has one loading in the order of the strokes, and at most one "
                          "unloading; remove cycles between",
                          is_loading ? "back" : "on", MM(furthest), MM(trace->x[i]),
                          is_loading ? "before" : "again behind");
        furthest = is_loading ? fmax(furthest, trace->x[i]) : fmin(furthest, trace->x[i]);
    }
    return true;
}

double cz_work(const double *x, const double *f, int from, int to) {
    double work = 0.0;
    for (int i = from + 1; i <= to; i++)
        work += 0.5 * (f[i] + f[i - 1]) * (x[i] - x[i - 1]);
    return work;
}

static bool check_energy(Making *making) {
    CzTrace *trace = making->trace;
    const int top = trace->n_loading - 1, last = trace->n - 1;
    if (top == 0 || !(cz_work(trace->x, trace->f, 0, top) > 0.0))
        return refuse(making, top, "the curve absorbs no energy while its stroke grows");
    trace->unloads = trace->x[top] - trace->x[last] > UNLOADING * trace->x[top] &&
                     trace->f[last] < UNLOADED * trace->f[top];
    return !trace->unloads ||
           -cz_work(trace->x, trace->f, top, last) <= cz_work(trace->x, trace->f, 0, top) ||
           refuse(making, top, "the unloading returns more energy than the loading absorbed");
}

static void note_free_travel(CzTrace *trace) {
    const int first = find_contact(trace, range_of(trace->f, trace->n).largest);
    if (first < trace->n_loading && trace->x[first] > FREE_TRAVEL * trace->x[trace->n_loading - 1])
        note(trace,
             "there is no force up to a stroke of %s mm; a gap should not be part of the law",
             MM(trace->x[first]));
}

bool cz_trace_make(CzMistakes *mistakes, const CzSource *source, const CzTraceShape *shape,
                   double unit, CzTrace *trace) {
    Making making = {mistakes, source, shape, unit, trace};
    if (!set_indicators(&making) || !cut_part(&making) || !check_turns(&making) ||
        !set_zero(&making) || !check_sizes(&making))
        return false;

    /* Of points at the largest stroke the one with the largest force ends the loading. */
    int top = 0;
    for (int i = 1; i < trace->n; i++)
        if (trace->x[i] > trace->x[top] ||
            (trace->x[i] == trace->x[top] && trace->f[i] > trace->f[top]))
            top = i;
    trace->n_loading = top + 1;
    if (!check_order(&making) || !check_energy(&making))
        return false;
    note_free_travel(trace);
    return true;
}

/* Isotonic regression: neighbours that are out of order are pooled at their mean until none is. */
bool cz_trace_raise(CzArena *arena, const double *x, int n, double *raised) {
    double *mean = cz_arena_allocate(arena, (size_t)n, sizeof *mean);
    int *size = cz_arena_allocate(arena, (size_t)n, sizeof *size);
    if (mean == NULL || size == NULL)
        return false;
    int n_pool = 0;
    for (int i = 0; i < n; i++) {
        mean[n_pool] = x[i];
        size[n_pool++] = 1;
        while (n_pool > 1 && mean[n_pool - 1] < mean[n_pool - 2]) {
            const int a = size[n_pool - 2], b = size[n_pool - 1];
            mean[n_pool - 2] = (a * mean[n_pool - 2] + b * mean[n_pool - 1]) / (a + b);
            size[n_pool - 2] = a + b;
            n_pool--;
        }
    }
    for (int pool = 0, i = 0; pool < n_pool; pool++)
        for (int k = 0; k < size[pool]; k++)
            raised[i++] = mean[pool];
    return true;
}
