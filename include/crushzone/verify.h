/* Verification: the judged results of a design, computed again by independent methods.
 *
 * It shows the influence of steps and solvers on the results, not that of parameters and physics,
 * because the laws are the same.
 */
#ifndef CRUSHZONE_VERIFY_H
#define CRUSHZONE_VERIFY_H

#include <signal.h>

#include "crushzone/evaluate.h"

CZ_BEGIN_DECLARATIONS

typedef enum CzVerifyMethod {
#define CZ_VERIFY_METHOD(constant, key, text, doc) constant,
#include "crushzone/verify_methods.def"
#undef CZ_VERIFY_METHOD
    CZ_N_VERIFY_METHOD
} CzVerifyMethod;
CZ_API const char *cz_verify_method_key(CzVerifyMethod method);  /* such as "half_step" */
CZ_API const char *cz_verify_method_text(CzVerifyMethod method); /* such as "halved time step" */

typedef struct CzVerifyOptions {
    unsigned methods; /* which ones, bit 1 << CzVerifyMethod each; all by default */
    double limit;     /* largest change that passes [-]; 0.01 by default */
    const volatile sig_atomic_t
        *stop;          /* a flag that ends the computation when not 0; NULL when none */
    double solver_step; /* longest step of the solvers, in half steps of the production run; 1 by
                           default; 2, the value in a search, halves their time; from 3 their own
                           error exceeds the limit [-] */
    bool until_settled; /* compares runs that end once they have settled, as those of a search do,
                           where the production run has the same checks then; false by default */
} CzVerifyOptions;
CZ_API CzVerifyOptions cz_verify_options_default(void);

/* One number: the objective, a check or target, or a total of a scenario (largest interface force,
 * largest closure, dissipated energy). Texts are borrowed from the evaluator. */
typedef struct CzVerifiedValue {
    const char *name;
    char scenario[CZ_NAME_SIZE]; /* empty for the objective and for the design itself */
    char where[CZ_WHERE_SIZE];   /* of the production run; empty when it has no place */
    const char *unit;
    double production;    /* value of the production run, or of that up to where it settled */
    bool beyond_validity; /* the production run's value may be of the time after an override */
    double value[CZ_N_VERIFY_METHOD];  /* NaN when not computed */
    double change[CZ_N_VERIFY_METHOD]; /* for a check or target the change of its margin, where a
                                          margin above 1 counts as 1, and the change of one below -1
                                          is relative to its size; otherwise |value - production|
                                          over production, or over the scale of its quantity where
                                          production is near zero, or over 1 for a smallest margin;
                                          NaN for a yes-or-no check and when not computed */
    bool flips[CZ_N_VERIFY_METHOD];    /* another verdict than that of the production run */
} CzVerifiedValue;

/* Open result, owns its memory. */
typedef struct CzVerification {
    CzStatus status;    /* CZ_OK, or CZ_STATUS_RUN_FAILED when a run of any method failed or is
                           incomplete */
    char failure[320];  /* which method, scenario and why; empty otherwise */
    double solver_step; /* as it was requested */
    bool until_settled; /* as it was requested, and the production run has the same checks */
    double limit;
    unsigned methods; /* that were requested and apply here: bit 1 << CzVerifyMethod each */
    int n_value;
    CzVerifiedValue *value;                    /* (n_value) */
    bool is_done[CZ_N_VERIFY_METHOD];          /* the method was completed */
    double largest_change[CZ_N_VERIFY_METHOD]; /* over all values; NaN when not done */
    int worst[CZ_N_VERIFY_METHOD];             /* value with that change; -1 when none */
    int n_flip[CZ_N_VERIFY_METHOD];            /* changed verdicts */
    double run_s[CZ_N_VERIFY_METHOD];          /* computing times of the runs, added up */
    double wall_s;                             /* for run_info only */
    CzVerdict verdict; /* pass: every requested method is done, changes results by at most the limit
                          and reverses no verdict */
} CzVerification;

/* Computes a design again. x as in cz_evaluate; `record` is its evaluation with runs kept, NULL
 * when it has to be made first. Statuses: CZ_OK (look at the verdict), CZ_STATUS_INTERRUPTED,
 * CZ_STATUS_NO_MEMORY. */
CZ_MUST_CHECK CZ_API CzStatus cz_verify(CzEvaluator *evaluator, const double *x,
                                        const CzEvaluation *record, const CzVerifyOptions *options,
                                        CzVerification **verification, CzError *error);
CZ_API void cz_verification_free(CzVerification *verification);

CZ_END_DECLARATIONS
#endif
