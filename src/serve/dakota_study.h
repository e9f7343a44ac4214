/* An evaluation for Dakota: what its file asks for, and what was computed. */
#ifndef CZ_SERVE_DAKOTA_STUDY_H
#define CZ_SERVE_DAKOTA_STUDY_H

#include "crushzone/dakota.h"
#include "serve/dakota_parameters.h"
#include "serve/dakota_responses.h"

enum { CZ_DAKOTA_PATH = -1 };

/* What a variable of Dakota sets. */
typedef struct CzDakotaTarget {
    const CzDakotaEntry *entry;
    const char *meaning; /* its name or path */
    int design;          /* number of the design variable; CZ_DAKOTA_PATH for a path of the file */
    bool is_number;
    double value;
} CzDakotaTarget;

struct CzDakota {
    CzArena arena;
    CzDakotaParameters parameters;
    CzDakotaOptions options;
    const CzProblem *problem;
    CzDakotaTarget *target; /* (n_variable) */
    CzResponse *response;   /* (n_response) */
    int n_metric;
    const char **metric; /* texts of those among the responses (n_metric) */
    double *value;       /* of each response (n_response) */
    double *neighbour;   /* response by response of each neighbour; NaN for one that failed
                            (n_derivative x n_response) */
    double *step;        /* that of each derivative, in the unit of its variable (n_derivative) */
    char failure[512];
};

/* Puts the place of an entry of the file into an error, unless the status is CZ_OK; returns it. */
CzStatus cz_dakota_place(const CzDakota *dakota, const CzDakotaEntry *entry, CzStatus status,
                         CzError *error);

/* Finds what variables, responses and derivatives mean; the metrics become values of the evaluator.
 * Statuses: CZ_OK, CZ_STATUS_INPUT with line and column, CZ_STATUS_NO_MEMORY. */
CZ_MUST_CHECK CzStatus cz_dakota_find(CzDakota *dakota, CzEvaluator *evaluator, CzError *error);

#endif
