/* Further scenarios of a search against scatter: samples at the required statistics, and weak
 * points that an adversary found. */
#ifndef CZ_OPTIMISE_ROBUST_CASES_H
#define CZ_OPTIMISE_ROBUST_CASES_H

#include <math.h>

#include "base/arena.h"
#include "crushzone/challenge.h"
#include "crushzone/sample.h"
#include "problem/problem.h"

enum {
    CZ_ROBUST_MAX_CASES = 24, /* of a search (ours) */
    CZ_ROBUST_MAX_NEW = 4     /* of them after one round (ours) */
};

/* A statistic this much below the smallest margin that a search has seen shows that it has not seen
 * the samples that decide; a yes or no that fails counts as violated by as much (ours). */
#define CZ_ROBUST_NEAR 0.01

typedef struct CzRobustCases {
    CzArena arena;
    int n;
    CzCase list[CZ_ROBUST_MAX_CASES]; /* (n) */
} CzRobustCases;

/* Violation of the statistic of a check: of its margin, or of a yes or no. */
static inline double cz_robust_violation(const CzSampledCheck *check) {
    if (check->is_flag || isnan(check->required))
        return check->n_fail > 0 ? CZ_ROBUST_NEAR : 0;
    return fmax(-check->required, 0);
}

/* Largest violation of the statistic of a check; 0 when the samples are judged to hold. */
double cz_robust_violation_in(const CzSampling *sampling);

/* Adds the samples at the statistics that are violated or below `limit`: of each check name that in
 * the scenario that is worst, the lowest first. Returns how many are new; without memory the arena
 * says so. */
int cz_robust_add_samples(CzRobustCases *cases, const CzSampling *sampling, double limit);

/* Adds the weak points that fail. Returns how many are new; without memory the arena says so. */
int cz_robust_add_weak_points(CzRobustCases *cases, const CzChallenge *challenge);

#endif
