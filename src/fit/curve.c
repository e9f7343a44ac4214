/* A measured curve of any two quantities, for figures. */
#include <stdlib.h>
#include <string.h>

#include "base/error.h"
#include "fit/trace.h"

CzStatus cz_curve_read(const char *path, const CzCurveColumns *columns, CzCurve **curve,
                       CzError *error) {
    *curve = NULL;
    CzArena arena = {0};
    CzTrace trace = {0};
    CzCurve *made = calloc(1, sizeof *made);
    CzStatus status = made != NULL ? cz_trace_read_columns(&arena, path, columns, &trace, error)
                                   : cz_fail(error, CZ_STATUS_NO_MEMORY, "no memory for a curve");
    if (status == CZ_OK) {
        const size_t size = (size_t)trace.n * sizeof *made->x;
        made->n = trace.n;
        made->x = malloc(size);
        made->y = malloc(size);
        if (made->x == NULL || made->y == NULL) {
            status = cz_fail(error, CZ_STATUS_NO_MEMORY, "no memory for a curve");
        } else {
            memcpy(made->x, trace.x, size);
            memcpy(made->y, trace.f, size);
        }
    }
    cz_arena_free(&arena);
    if (status != CZ_OK) {
        cz_curve_free(made);
        return status;
    }
    *curve = made;
    return CZ_OK;
}

void cz_curve_free(CzCurve *curve) {
    if (curve == NULL)
        return;
    free(curve->x);
    free(curve->y);
    free(curve);
}
