/* Finds the run that decides the verdict. */
#include "evaluate/deciding_run.h"

#include <math.h>
#include <string.h>

int cz_deciding_run(const CzEvaluation *evaluation) {
    const CzCheckResult *worst = NULL;
    int found = -1;
    for (int i = 0; evaluation->run != NULL && i < evaluation->n_run; i++) {
        if (evaluation->run[i] == NULL)
            continue;
        const CzRunSummary *run = cz_run_summary(evaluation->run[i]);
        if (run->status != CZ_OK)
            return i;
        found = found < 0 ? i : found;
        for (int k = 0; k < evaluation->n_check; k++) {
            const CzCheckResult *check = &evaluation->check[k];
            if (check->scenario != NULL && strcmp(check->scenario, run->scenario) == 0 &&
                !isnan(check->value) && (worst == NULL || cz_check_is_worse(check, worst))) {
                worst = check;
                found = i;
            }
        }
    }
    return found;
}
