/* Cases: the problem is read again with scenarios that change its values. */
#include "evaluate/cases.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/error.h"
#include "base/text.h"
#include "evaluate/compose.h"

/* ---- what cases have in common --------------------------------------------------------------- */

static bool is_listed(const CzTexts *names, const CzScenario *scenario) {
    if (names->n_text == 0)
        return scenario->reserves && !(scenario->mass_factor >= CZ_OVERLOAD_FACTOR * (1 - 1e-9));
    return cz_text_is_among(scenario->name, names->n_text, names->text) ||
           (scenario->family != NULL &&
            cz_text_is_among(scenario->family, names->n_text, names->text));
}

CzStatus cz_cases_scenarios(const CzProblem *problem, const CzTexts *names, CzArena *arena,
                            int *n_scenario, const int **scenario, CzError *error) {
    const CzInput *input = cz_problem_input(problem);
    int *list = cz_arena_allocate(arena, (size_t)input->n_scenarios, sizeof *list);
    if (list == NULL)
        return cz_no_memory(error, "the scenarios");
    *n_scenario = 0;
    *scenario = list;
    for (int s = 0; s < input->n_scenarios; s++)
        if (is_listed(names, &input->scenarios[s]))
            list[(*n_scenario)++] = s;
    return *n_scenario > 0 ? CZ_OK
                           : cz_problem_fail(problem, names, error,
                                             "every scenario of the problem is an overload case");
}

int cz_cases_n_change(const CzCases *cases) {
    int n = 0;
    for (int d = 0; d < cases->n_draw; d++)
        n += cases->draw[d].n_path;
    return n;
}

void cz_case_changes(const CzCases *cases, const double *value, CzCaseChange *change) {
    for (int d = 0; d < cases->n_draw; d++)
        for (int i = 0; i < cases->draw[d].n_path; i++)
            *change++ = cz_case_change(&cases->draw[d], i, value[d]);
}

/* ---- the bench ------------------------------------------------------------------------------- */

/* The cases of a bench as the reader takes them, scenario after scenario of each. */
typedef struct Made {
    int n_case;
    CzCase *list;               /* (n_case) */
    CzCaseChange *change;       /* of one case after the other */
    char (*name)[CZ_NAME_SIZE]; /* (n_case) */
} Made;

static void free_made(Made *made) {
    free(made->list);
    free(made->change);
    free(made->name);
}

static bool make(const CzCases *cases, int n, const int *number, const double *value, Made *made) {
    const int n_change = number[0] == CZ_UNCHANGED_CASE ? 0 : cz_cases_n_change(cases);
    *made = (Made){.n_case = n * cases->n_scenario};
    const size_t n_case = (size_t)made->n_case;
    made->list = malloc(n_case * sizeof *made->list);
    made->name = malloc(n_case * sizeof *made->name);
    made->change = malloc(((size_t)n * (size_t)n_change + 1) * sizeof *made->change);
    if (made->list == NULL || made->name == NULL || made->change == NULL)
        return false;
    for (int k = 0; k < n; k++) {
        CzCaseChange *change = made->change + k * n_change;
        if (n_change > 0)
            cz_case_changes(cases, value + (long)number[k] * cases->n_draw, change);
        for (int j = 0; j < cases->n_scenario; j++) {
            const int i = k * cases->n_scenario + j;
            cz_case_name(cases, j, number[k], made->name[i]);
            made->list[i] = (CzCase){.name = made->name[i],
                                     .scenario = cases->scenario[j],
                                     .reserves = false,
                                     .n_change = n_change,
                                     .change = change};
        }
    }
    return true;
}

void cz_case_bench_free(CzCaseBench *bench) {
    cz_evaluator_free(bench->evaluator);
    cz_problem_free(bench->problem);
}

CzStatus cz_case_bench_build(const CzCases *cases, int n, const int *number, const double *value,
                             CzCaseBench *bench, CzError *error) {
    Made made;
    CzEvaluatorOptions options = cz_evaluator_options_default();
    *bench = (CzCaseBench){0};
    CzStatus status =
        make(cases, n, number, value, &made)
            ? cz_problem_read_cases(cases->problem, made.n_case, made.list, &bench->problem, error)
            : cz_no_memory(error, "the cases");
    free_made(&made);
    options.n_job = 1;
    options.beside = cases->beside;
    options.first_scenario = cz_problem_n_scenario(cases->problem);
    if (status == CZ_OK)
        status = cz_evaluator_build(bench->problem, &options, &bench->evaluator, error);
    return status;
}

/* ---- checks ---------------------------------------------------------------------------------- */

/* The n-th check of a name, from 0, of a scenario of the list; -1 when there is none. */
static int find_check(const CzCaseChecks *checks, int scenario, const char *name, int n) {
    for (int i = 0; i < checks->n; i++)
        if (checks->check[i].scenario == scenario && strcmp(checks->check[i].name, name) == 0 &&
            n-- == 0)
            return i;
    return -1;
}

/* Scenario of the list of a check of an evaluator whose cases begin with scene `first`; -1 for
 * none. */
static int scenario_of(const CzEvaluator *evaluator, int check, int first, int n_scenario) {
    const char *name = cz_check_scenario(&evaluator->list.check[check], evaluator->scene);
    for (int j = 0; j < n_scenario; j++)
        if (strcmp(name, evaluator->scene[first + j].name) == 0)
            return j;
    return -1;
}

/* Number of checks before this one that have its name and scenario. */
static int n_before(const CzEvaluator *evaluator, int check) {
    const CzCheck *list = evaluator->list.check;
    const char *scenario = cz_check_scenario(&list[check], evaluator->scene);
    int n = 0;
    for (int i = 0; i < check; i++)
        n += !list[i].is_target && strcmp(list[i].name, list[check].name) == 0 &&
             strcmp(cz_check_scenario(&list[i], evaluator->scene), scenario) == 0;
    return n;
}

CzStatus cz_case_checks_add(const CzCases *cases, const CzCaseBench *bench, CzArena *arena,
                            CzCaseChecks *checks, CzError *error) {
    const CzEvaluator *evaluator = bench->evaluator;
    const int first = cz_problem_n_scenario(cases->problem);
    for (int i = 0; i < evaluator->list.n_check; i++) {
        const CzCheck *listed = &evaluator->list.check[i];
        const int j = listed->is_target ? -1 : scenario_of(evaluator, i, first, cases->n_scenario);
        if (j < 0 || find_check(checks, j, listed->name, n_before(evaluator, i)) >= 0)
            continue;
        CzCaseCheck *check = cz_arena_grow(arena, checks->check, checks->n, sizeof *check);
        const char *name = cz_arena_copy_text(arena, listed->name, strlen(listed->name));
        if (check == NULL || name == NULL)
            return cz_no_memory(error, "the checks of the cases");
        check[checks->n++] =
            (CzCaseCheck){.name = name, .scenario = j, .is_flag = listed->scale == CZ_FLAG_SCALE};
        checks->check = check;
    }
    return CZ_OK;
}

int cz_case_check_of(const CzCaseChecks *checks, const CzEvaluation *evaluation, int i,
                     int scenario, const char *scenario_name) {
    const CzCheckResult *result = &evaluation->check[i];
    int n = 0; /* results of this name before */
    if (strcmp(result->scenario, scenario_name) != 0)
        return -1;
    for (int k = 0; k < i; k++)
        n += strcmp(evaluation->check[k].scenario, scenario_name) == 0 &&
             strcmp(evaluation->check[k].name, result->name) == 0;
    return find_check(checks, scenario, result->name, n);
}

char *cz_case_failure(const CzRunSummary *run, const char *scenario) {
    char reason[400];
    cz_failure_text(run, sizeof reason, reason);
    const size_t room = strlen(reason) + strlen(scenario) + 3;
    char *text = malloc(room);
    if (text != NULL)
        snprintf(text, room, "%s: %s", scenario, reason);
    return text;
}
