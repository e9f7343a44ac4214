/* What a caller wants of every evaluation: further metrics, and only some of the scenarios. */
#include "evaluate/evaluator_parts.h"
#include "base/error.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* Reads "METRIC" or "METRIC@SCENARIO". */
static CzStatus read_wanted(const CzEvaluator *evaluator, const char *text, CzWanted *wanted,
                            CzError *error) {
    const char *at = strrchr(text, '@');
    int first;
    snprintf(wanted->name, sizeof wanted->name, "%s", text);
    wanted->scenario[0] = '\0';
    if (at == NULL || strlen(text) >= sizeof wanted->name)
        return cz_metric_parse(text, &wanted->metric, error);
    wanted->name[at - text] = '\0';
    CZ_TRY(cz_metric_parse(wanted->name, &wanted->metric, error));
    CZ_TRY(cz_problem_find_scenario(evaluator->problem, at + 1, &first, error));
    snprintf(wanted->name, sizeof wanted->name, "%s", text);
    snprintf(wanted->scenario, sizeof wanted->scenario, "%s", at + 1);
    return CZ_OK;
}

bool cz_wanted_in_scenario(const CzWanted *wanted, const CzScene *scene) {
    return wanted->scenario[0] == '\0' || cz_scene_is(scene, wanted->scenario);
}

CzStatus cz_evaluator_set_values(CzEvaluator *evaluator, int n_metric, const char *const *metric,
                                 CzError *error) {
    evaluator->n_wanted = 0;
    if (n_metric <= 0)
        return CZ_OK;
    CzWanted *wanted = realloc(evaluator->wanted, (size_t)n_metric * sizeof *wanted);
    if (wanted == NULL)
        return cz_no_memory(error, "the metrics of an evaluation");
    evaluator->wanted = wanted;
    for (int i = 0; i < n_metric; i++)
        CZ_TRY(read_wanted(evaluator, metric[i], &wanted[i], error));
    evaluator->n_wanted = n_metric;
    return CZ_OK;
}

bool cz_evaluator_has_metric(const CzEvaluator *evaluator, int wanted) {
    for (int s = 0; s < evaluator->n_scene; s++)
        if (cz_wanted_in_scenario(&evaluator->wanted[wanted], &evaluator->scene[s]) &&
            cz_metric_picks(&evaluator->wanted[wanted].metric, &evaluator->scene[s]))
            return true;
    return false;
}

CzStatus cz_evaluator_set_scenarios(CzEvaluator *evaluator, int n_scenario,
                                    const char *const *scenario, CzError *error) {
    memset(evaluator->is_left_out, 0, (size_t)evaluator->n_scene * sizeof(bool));
    int first;
    for (int i = 0; i < n_scenario; i++)
        CZ_TRY(cz_problem_find_scenario(evaluator->problem, scenario[i], &first, error));
    for (int s = 0; s < evaluator->n_scene && n_scenario > 0; s++) {
        bool is_wanted = false;
        for (int i = 0; i < n_scenario; i++)
            is_wanted |= cz_scene_is(&evaluator->scene[s], scenario[i]);
        evaluator->is_left_out[s] = !is_wanted;
    }
    return CZ_OK;
}
