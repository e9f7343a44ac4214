/* Scenarios that the values of a sweep do not reach. */
#include "evaluate/sweep_reach.h"

#include <stdlib.h>
#include <string.h>

#include "base/error.h"
#include "problem/problem.h"

/* Whether the scenario is run. */
static bool is_run(const CzScenario *scenario, const char *only) {
    return only == NULL || strcmp(scenario->name, only) == 0 ||
           (scenario->family != NULL && strcmp(scenario->family, only) == 0);
}

/* Adds the scenarios that a value does not reach; a path that names no number reaches all. */
static void add_unreached(CzSweep *sweep, int axis, const char *only) {
    const CzInput *input = cz_problem_input(sweep->problem);
    CzTargets targets = {0};
    if (cz_problem_find(sweep->problem, sweep->axis[axis].path, &targets, NULL) == CZ_OK)
        for (int s = 0; s < input->n_scenarios; s++) {
            const CzScenario *scenario = &input->scenarios[s];
            const char *by =
                is_run(scenario, only) ? cz_problem_replaced_by(sweep->problem, s, &targets) : NULL;
            if (by != NULL)
                sweep->unreached[sweep->n_unreached++] = (CzUnreached){axis, scenario->name, by};
        }
    free(targets.target);
}

CzStatus cz_sweep_find_unreached(CzSweep *sweep, const char *scenario, CzError *error) {
    const int n = cz_problem_n_scenario(sweep->problem);
    sweep->unreached = calloc((size_t)(n * sweep->n_axis) + 1, sizeof *sweep->unreached);
    if (sweep->unreached == NULL)
        return cz_no_memory(error, "the scenarios of a sweep");
    for (int k = 0; k < sweep->n_axis; k++)
        add_unreached(sweep, k, scenario);
    return CZ_OK;
}
