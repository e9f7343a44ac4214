/* The paths and values of a sweep. */
#include "crushzone/sweep.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/error.h"
#include "base/number.h"
#include "text/range.h"

CzSweepOptions cz_sweep_options_default(void) {
    return (CzSweepOptions){.shard = 1, .n_shard = 1};
}

const char *cz_sweep_state_text(CzSweepState state) {
    static const char *const text[] = {"done", "failed", "invalid", "not run"};
    return text[state];
}

static int compare_numbers(const void *a, const void *b) {
    const double first = *(const double *)a, second = *(const double *)b;
    return (first > second) - (first < second);
}

/* Reads a list such as "8,15,25"; false when it is none, or has a value twice. */
static bool read_list(const char *text, CzSweepAxis *axis) {
    axis->n = 0;
    for (const char *from = text; from != NULL && axis->n < CZ_MAX_LISTED;) {
        char number[2 * CZ_NUMBER_TEXT];
        const size_t length = strcspn(from, ",");
        if (length >= sizeof number)
            return false;
        snprintf(number, sizeof number, "%.*s", (int)length, from);
        if (cz_number_parse(number, &axis->listed[axis->n]) != NULL)
            return false;
        axis->n++;
        from = from[length] == ',' ? from + length + 1 : NULL;
        if (from != NULL && axis->n == CZ_MAX_LISTED)
            return false;
    }
    qsort(axis->listed, (size_t)axis->n, sizeof *axis->listed, compare_numbers);
    for (int i = 1; i < axis->n; i++)
        if (axis->listed[i] == axis->listed[i - 1])
            return false;
    axis->is_list = true;
    axis->from = axis->listed[0];
    axis->to = axis->listed[axis->n - 1];
    return axis->n >= 2;
}

/* Reads values; false when they are neither a range nor a list. */
static bool read_values(const char *text, CzSweepAxis *axis) {
    CzRange range;
    if (!cz_range_parse(text, &range))
        return read_list(text, axis);
    axis->from = range.from;
    axis->to = range.to;
    axis->n = range.n;
    return true;
}

CzStatus cz_sweep_axis_parse(const char *text, CzSweepAxis *axis, CzError *error) {
    const char *equals = strrchr(text, '=');
    memset(axis, 0, sizeof *axis);
    if (equals == NULL || equals == text || (size_t)(equals - text) >= sizeof axis->path ||
        !read_values(equals + 1, axis)) {
        cz_fail(error, CZ_STATUS_INPUT, "'%.160s' is not of the form PATH=from:to:n or PATH=a,b,c",
                text);
        if (error != NULL)
            snprintf(error->help, sizeof error->help,
                     "such as trains.A.speed_km_h=5:40:8, with 2 to %d values, or "
                     "trains.A.speed_km_h=8,15,25, with 2 to %d different values",
                     (int)CZ_MAX_IN_RANGE, (int)CZ_MAX_LISTED);
        return CZ_STATUS_INPUT;
    }
    snprintf(axis->path, sizeof axis->path, "%.*s", (int)(equals - text), text);
    return CZ_OK;
}

double cz_sweep_axis_value(const CzSweepAxis *axis, int index) {
    return axis->is_list ? axis->listed[index]
                         : cz_range_value(&(CzRange){axis->from, axis->to, axis->n}, index);
}
