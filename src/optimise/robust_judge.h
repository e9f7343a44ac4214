/* The judgement of one design against scatter: its samples, then the adversary. */
#ifndef CZ_OPTIMISE_ROBUST_JUDGE_H
#define CZ_OPTIMISE_ROBUST_JUDGE_H

#include <signal.h>

#include "crushzone/robust.h"
#include "evaluate/evaluator.h"

/* What judges; all borrowed. */
typedef struct CzRobustJudge {
    const CzEvaluator *plain; /* of the problem as written */
    const CzEvaluatorOptions *evaluator_options;
    const volatile sig_atomic_t *stop;           /* NULL: none */
    void (*show)(const char *phase, void *data); /* tells that samples or the adversary run */
    void *data;
} CzRobustJudge;

/* What was found about a design; owned. */
typedef struct CzRobustJudged {
    CzProblem *designed;
    CzSampling *sampling;
    CzChallenge *challenge; /* NULL when it was not asked */
} CzRobustJudged;
void cz_robust_judged_free(CzRobustJudged *judged);

/* Samples a design; brief runs tell what breaks it, whole ones that it holds. */
CZ_MUST_CHECK CzStatus cz_robust_sample(const CzRobustJudge *judge, const CzProblem *designed,
                                        bool brief, CzSampling **sampling, CzError *error);

/* Samples the design x (n_variable), by whole runs when it holds by brief ones; then challenges it
 * where the problem has an envelope. The caller frees what was found in any case. */
CZ_MUST_CHECK CzStatus cz_robust_judge(const CzRobustJudge *judge, const double *x,
                                       CzRobustJudged *judged, CzError *error);

/* Whether a design passes with its reserves and in its samples, and the adversary, where asked, did
 * not break it. */
bool cz_robust_passes(const CzRobustJudged *judged);

/* Fills the results of a round. */
void cz_robust_fill_round(CzRobustRound *round, const CzRobustJudged *judged);

/* Among the designs of an outcome whose best one is not verified: tries the next best ones that
 * pass in all scenarios, until one is verified and holds. Its judgement goes to `judged`, which has
 * no sampling when there is none; the outcome then keeps its design. Statuses: CZ_OK,
 * CZ_STATUS_INTERRUPTED, CZ_STATUS_NO_MEMORY. */
CZ_MUST_CHECK CzStatus cz_robust_find_verified(const CzRobustJudge *judge, CzEvaluator *evaluator,
                                               const CzOptimiseOptions *options, CzOutcome *outcome,
                                               CzRobustJudged *judged, CzError *error);

#endif
