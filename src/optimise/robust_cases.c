/* Adds samples and weak points to the scenarios of a search. */
#include "optimise/robust_cases.h"

#include <stdio.h>
#include <string.h>

#include "evaluate/sampling.h"

static bool has_case(const CzRobustCases *cases, const char *name) {
    for (int i = 0; i < cases->n; i++)
        if (strcmp(cases->list[i].name, name) == 0)
            return true;
    return false;
}

/* Adds a scenario with values of all draws; true when it is a new one. */
static bool add_case(CzRobustCases *cases, const char *name, int scenario, const CzCases *of,
                     const double *value) {
    if (cases->n == CZ_ROBUST_MAX_CASES || has_case(cases, name))
        return false;
    const int n_change = cz_cases_n_change(of);
    char *own_name = cz_arena_copy_text(&cases->arena, name, strlen(name));
    CzCaseChange *change = cz_arena_allocate(&cases->arena, (size_t)n_change + 1, sizeof *change);
    if (own_name == NULL || change == NULL)
        return false;
    cz_case_changes(of, value, change);
    for (int i = 0; i < n_change; i++) { /* the paths are those of a sampling or challenge */
        change[i].path = cz_arena_copy_text(&cases->arena, change[i].path, strlen(change[i].path));
        if (change[i].path == NULL)
            return false;
    }
    cases->list[cases->n++] =
        (CzCase){.name = own_name, .scenario = scenario, .n_change = n_change, .change = change};
    return true;
}

/* The sample whose margin of a check is nearest to the required statistic, from above: the worst
 * one for `worst`. */
static int sample_at_statistic(const CzSampling *sampling, int c) {
    const CzSampledCheck *check = &sampling->check[c];
    int nearest = check->margin.worst;
    double least = INFINITY;
    for (int k = 0; k < sampling->n_sample && !isnan(check->required); k++) {
        const double margin = sampling->margin[(size_t)k * (size_t)sampling->n_check + (size_t)c];
        if (sampling->sample[k].state == CZ_SAMPLE_DONE && margin >= check->required &&
            margin < least) {
            least = margin;
            nearest = k;
        }
    }
    return nearest;
}

/* How much a check asks for its sample: the lower its statistic the more, a yes or no that fails
 * like a small violation; -infinity for one that has nothing to ask. */
static double urgency_of(const CzSampledCheck *check) {
    const double violation = cz_robust_violation(check);
    return violation > 0 || isnan(check->required) ? (violation > 0 ? violation : -INFINITY)
                                                   : -check->required;
}

double cz_robust_violation_in(const CzSampling *sampling) {
    double worst = CZ_ROBUST_NEAR;
    if (sampling->judgement != CZ_VERDICT_FAIL)
        return 0;
    for (int c = 0; c < sampling->n_check; c++)
        worst = fmax(worst, cz_robust_violation(&sampling->check[c]));
    return worst;
}

int cz_robust_add_samples(CzRobustCases *cases, const CzSampling *sampling, double limit) {
    const CzSamplingParts *parts = sampling->parts;
    bool *is_done =
        cz_arena_allocate(&cases->arena, (size_t)sampling->n_check + 1, sizeof *is_done);
    int n_new = 0;
    while (is_done != NULL && n_new < CZ_ROBUST_MAX_NEW) {
        int first = -1;
        for (int c = 0; c < sampling->n_check; c++)
            if (!is_done[c] && (first < 0 || urgency_of(&sampling->check[c]) >
                                                 urgency_of(&sampling->check[first])))
                first = c;
        if (first < 0 || urgency_of(&sampling->check[first]) <= -limit)
            break;
        for (int c = 0; c < sampling->n_check; c++)
            is_done[c] |= strcmp(sampling->check[c].name, sampling->check[first].name) == 0;
        const int k = sample_at_statistic(sampling, first);
        if (k < 0)
            continue;
        char name[CZ_NAME_SIZE];
        const int scenario = parts->checks.check[first].scenario;
        cz_case_name(&parts->cases, scenario, k, name);
        n_new += add_case(cases, name, parts->cases.scenario[scenario], &parts->cases,
                          sampling->value + (size_t)k * (size_t)sampling->n_draw);
    }
    return n_new;
}

int cz_robust_add_weak_points(CzRobustCases *cases, const CzChallenge *challenge) {
    const CzCases of = {.n_draw = challenge->n_draw, .draw = challenge->draw};
    int n_new = 0;
    for (int i = 0; i < challenge->n_weak && challenge->is_broken; i++) {
        const CzWeakPoint *weak = &challenge->weak[i];
        char name[CZ_NAME_SIZE];
        if (weak->state == CZ_SAMPLE_DONE && cz_verdict_passes(weak->verdict))
            continue;
        snprintf(name, sizeof name, "weak-point-%d", cases->n + 1);
        n_new += add_case(cases, name, weak->scenario, &of,
                          challenge->value + (long)weak->point * challenge->n_draw);
    }
    return n_new;
}
