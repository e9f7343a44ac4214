/* The paths and values of a sweep. */
#include "crushzone/sweep.h"

#include <stdio.h>
#include <string.h>

#include "base/error.h"
#include "text/range.h"

CzSweepOptions cz_sweep_options_default(void) {
    return (CzSweepOptions){.shard = 1, .n_shard = 1};
}

const char *cz_sweep_state_text(CzSweepState state) {
    static const char *const text[] = {"done", "failed", "invalid", "not run"};
    return text[state];
}

CzStatus cz_sweep_axis_parse(const char *text, CzSweepAxis *axis, CzError *error) {
    const char *equals = strrchr(text, '=');
    CzRange range;
    if (equals == NULL || equals == text || (size_t)(equals - text) >= sizeof axis->path ||
        !cz_range_parse(equals + 1, &range)) {
        cz_fail(error, CZ_STATUS_INPUT, "'%.160s' is not of the form PATH=from:to:n", text);
        if (error != NULL)
            snprintf(error->help, sizeof error->help,
                     "such as trains.A.speed_km_h=5:40:8, with 2 to %d values",
                     (int)CZ_MOST_IN_RANGE);
        return CZ_STATUS_INPUT;
    }
    snprintf(axis->path, sizeof axis->path, "%.*s", (int)(equals - text), text);
    axis->from = range.from;
    axis->to = range.to;
    axis->n = range.n;
    return CZ_OK;
}

double cz_sweep_axis_value(const CzSweepAxis *axis, int index) {
    return cz_range_value(&(CzRange){axis->from, axis->to, axis->n}, index);
}
