/* Runs one algorithm of NLopt on a search. Its source is the only file that includes nlopt.h. */
#ifndef CZ_OPTIMISE_NLOPT_ADAPTER_H
#define CZ_OPTIMISE_NLOPT_ADAPTER_H

#include "optimise/search.h"

/* How constraints are passed to the algorithm. */
typedef enum CzForm {
    CZ_FORM_NATIVE,  /* as constraints where the algorithm accepts them, else by penalty */
    CZ_FORM_PENALTY, /* minimise f + weight * sum of the violations */
    CZ_FORM_ELASTIC  /* minimise f + weight * s with constraints <= s and s >= 0; for a minimax
                        objective minimise s alone */
} CzForm;

typedef struct CzNloptRun {
    const char *algorithm; /* such as "LD_SLSQP" */
    const char *phase;     /* for history and progress */
    CzForm form;
    long evaluations;  /* largest number of designs of this run, those for gradients included */
    double weight;     /* of the penalty */
    double reserve;    /* required distance of constraints below 0 */
    double secant;     /* step of differences, share of the range */
    double first_step; /* share of the range; 0: chosen by the algorithm */
    double tolerance;  /* on scaled variables */
    unsigned long seed;
} CzNloptRun;

/* Default settings of an algorithm. */
CzNloptRun cz_nlopt_run_default(const char *algorithm);

/* Runs from scaled variables u (n_variable). The result is in the search. Statuses: CZ_OK however
 * the algorithm ended, CZ_STATUS_INPUT for an algorithm that does not exist or does not accept this
 * number of variables, CZ_STATUS_NO_MEMORY. */
CZ_MUST_CHECK CzStatus cz_nlopt_run(CzSearch *search, const CzNloptRun *run, const double *u,
                                    CzError *error);

/* Whether an algorithm of this name can run in this build; the error names the nearest one or
 * reports that the library was built without it. */
CZ_MUST_CHECK CzStatus cz_nlopt_check(const char *algorithm, CzError *error);

#endif
