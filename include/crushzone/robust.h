/* Search for a design that passes in its samples, too, and that an adversary does not break.
 *
 *   search  -->  design  -->  all samples  -->  adversary
 *     ^                           |                 |
 *     +---- further scenarios: ---+-- weak points --+
 *           samples at the statistic
 *
 * A start that passes in the scenarios of the file is judged first, so that no search ends worse
 * than it began. The first search knows these scenarios and those that broke the start. The best
 * design is judged in all samples of `uncertainty:`; for each check whose statistic fails, the
 * sample at that statistic becomes a scenario of the next search, which begins at the best design
 * so far. A design that holds is challenged over the operating envelope, and weak points become
 * scenarios as well. It is called feasible only when all samples and the adversary leave it
 * standing.
 */
#ifndef CRUSHZONE_ROBUST_H
#define CRUSHZONE_ROBUST_H

#include "crushzone/challenge.h"
#include "crushzone/optimise.h"
#include "crushzone/sample.h"

CZ_BEGIN_DECLARATIONS

/* One search with its best design. */
typedef struct CzRobustRound {
    int n_scenario;         /* of its search: those of the file, samples and weak points */
    long n_evaluation;      /* of its search; 0: its design is the start */
    double nominal_margin;  /* smallest margin of the file's scenarios, with their reserves */
    double required_margin; /* smallest of the statistics over all checks; -infinity when a run of a
                               sample failed, NaN after an interruption */
    int n_sample, n_pass;   /* samples that were run, and that passed */
    int n_weak;             /* weak points that the adversary found; -1: it was not asked */
    bool is_best;           /* its design is the result */
} CzRobustRound;

/* Open result, owns its memory. */
typedef struct CzRobust {
    CzOutcome *outcome;     /* of all rounds; feasible only for a design that holds */
    CzProblem *problem;     /* with the scenarios of the last search */
    CzEvaluator *evaluator; /* of that problem; the outcome's */
    CzProblem *designed;    /* the problem with the best design */
    CzSampling *sampling;   /* of the best design */
    CzChallenge *challenge; /* of the best design; NULL when it was not challenged */
    int n_round;
    CzRobustRound *round; /* (n_round) */
    struct CzRobustCases
        *added; /* scenarios of the last search behind those of the file; private */
} CzRobust;

/* Whether a problem asks for this search: it has variables, no matches, and numbers that scatter or
 * an envelope. */
CZ_API bool cz_robust_is_asked(const CzProblem *problem);

/* The problem must outlive the result. Statuses as those of cz_optimise. */
CZ_MUST_CHECK CZ_API CzStatus cz_optimise_robust(const CzProblem *problem,
                                                 const CzEvaluatorOptions *evaluator_options,
                                                 const CzOptimiseOptions *options,
                                                 CzRobust **robust, CzError *error);
CZ_API void cz_robust_free(CzRobust *robust);

CZ_END_DECLARATIONS
#endif
