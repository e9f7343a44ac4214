/* Force over closure of the problem's own design. */
#include "simulate/input_curve.h"

#include "base/error.h"
#include "dynamics/slow_closing.h"

CzStatus cz_input_curve(const CzModel *model, int interface, double longest, int n, double *closure,
                        double *force, CzError *error) {
    CzArena arena = {0};
    CzLanes *lanes = cz_model_lanes(model, 1, &arena);
    int n_vehicle;
    CzStatus status = lanes == NULL
                          ? cz_no_memory(error, "the input curve")
                          : cz_model_fill(model, cz_problem_vehicles(model->problem, &n_vehicle), 0,
                                          lanes, error);
    if (status == CZ_OK)
        cz_slow_closing(lanes, interface, longest, n, closure, force);
    cz_arena_free(&arena);
    return status;
}
