/* Cases of samples: the problem with the scenarios of some samples, ready to run. */
#include "evaluate/sampling.h"

#include <stdlib.h>

#include "base/error.h"

/* The cases of n samples, scenario after scenario of each. */
typedef struct Cases {
    int n_case;
    CzCase *list;               /* (n_case) */
    CzCaseChange *change;       /* of one sample after the other */
    char (*name)[CZ_NAME_ROOM]; /* (n_case) */
} Cases;

static int n_change_of(const CzSampling *sampling) {
    int n = 0;
    for (int d = 0; d < sampling->n_draw; d++)
        n += sampling->draw[d].n_path;
    return n;
}

static void free_cases(Cases *cases) {
    free(cases->list);
    free(cases->change);
    free(cases->name);
}

static void fill_changes(const CzSampling *sampling, int sample, CzCaseChange *change) {
    static const CzCaseKind kinds[] = {[CZ_DRAW_VALUE] = CZ_CASE_VALUE,
                                       [CZ_DRAW_FACTOR] = CZ_CASE_FACTOR,
                                       [CZ_DRAW_ADD] = CZ_CASE_ADD};
    for (int d = 0; d < sampling->n_draw; d++)
        for (int i = 0; i < sampling->draw[d].n_path; i++)
            *change++ = (CzCaseChange){
                .path = sampling->draw[d].path[i],
                .kind = kinds[sampling->draw[d].effect],
                .number = sampling->value[(size_t)sample * (size_t)sampling->n_draw + (size_t)d]};
}

static bool make_cases(const CzSampling *sampling, int n, const int *sample, Cases *cases) {
    const CzSamplingParts *parts = sampling->parts;
    const int n_change = sample[0] == CZ_NOMINAL_SAMPLE ? 0 : n_change_of(sampling);
    *cases = (Cases){.n_case = n * parts->n_scenario};
    const size_t n_case = (size_t)cases->n_case;
    cases->list = malloc(n_case * sizeof *cases->list);
    cases->name = malloc(n_case * sizeof *cases->name);
    cases->change = malloc(((size_t)n * (size_t)n_change + 1) * sizeof *cases->change);
    if (cases->list == NULL || cases->name == NULL || cases->change == NULL)
        return false;
    for (int k = 0; k < n; k++) {
        CzCaseChange *change = cases->change + k * n_change;
        if (n_change > 0)
            fill_changes(sampling, sample[k], change);
        for (int j = 0; j < parts->n_scenario; j++) {
            const int i = k * parts->n_scenario + j;
            cz_sample_case_name(sampling, parts->scenario[j], sample[k], cases->name[i]);
            cases->list[i] = (CzCase){.name = cases->name[i],
                                      .scenario = parts->scenario[j],
                                      .reserves = false,
                                      .n_change = n_change,
                                      .change = change};
        }
    }
    return true;
}

void cz_sample_bench_free(CzSampleBench *bench) {
    cz_evaluator_free(bench->evaluator);
    cz_problem_free(bench->problem);
}

CzStatus cz_sample_bench_build(const CzSampling *sampling, int n, const int *sample,
                               CzSampleBench *bench, CzError *error) {
    Cases cases;
    CzEvaluatorOptions options = cz_evaluator_options_default();
    *bench = (CzSampleBench){0};
    CzStatus status = CZ_STATUS_NO_MEMORY;
    if (make_cases(sampling, n, sample, &cases))
        status = cz_problem_read_cases(sampling->problem, cases.n_case, cases.list, &bench->problem,
                                       error);
    else
        status = cz_no_memory(error, "the cases of a sample");
    free_cases(&cases);
    options.n_job = 1;
    options.first_scenario = cz_problem_n_scenario(sampling->problem);
    if (status == CZ_OK)
        status = cz_evaluator_build(bench->problem, &options, &bench->evaluator, error);
    return status;
}
