/* Evaluations for Dakota, by the files with which it asks for them (docs/loops.md). */
#ifndef CRUSHZONE_DAKOTA_H
#define CRUSHZONE_DAKOTA_H

#include <signal.h>
#include <stdio.h>

#include "crushzone/problem.h"

CZ_BEGIN_DECLARATIONS

typedef struct CzDakotaOptions {
    const CzProblemOptions *problem;   /* with which the problem was read; NULL: none */
    int n_job;                         /* threads; 0: one per processor */
    const char *scenario;              /* only this scenario or family; NULL for all */
    const volatile sig_atomic_t *stop; /* a flag that ends the evaluation; NULL for none */
} CzDakotaOptions;

/* The results of one evaluation. Opaque, owns its memory. */
typedef struct CzDakota CzDakota;

/* Evaluates what a parameters file of Dakota asks for, in its standard or its APREPRO format.
 *
 * A descriptor of a variable is the name of a design variable or a path of the file. That of a
 * response is objective, violation, smallest_margin, margin.CHECK, or a metric; a scenario may
 * follow behind @. An analysis component DESCRIPTOR=MEANING gives a descriptor another meaning.
 * Values and gradients are computed as the active set asks; a Hessian, a run that fails, and a
 * design that no file may have are failures of the evaluation. Statuses: CZ_OK, also for a failed
 * evaluation; CZ_STATUS_INPUT with line and column for a file with mistakes, for descriptors
 * without a meaning, and for values outside the bounds of a design variable;
 * CZ_STATUS_INTERRUPTED, CZ_STATUS_NO_MEMORY. */
CZ_MUST_CHECK CZ_API CzStatus cz_dakota_evaluate(const CzProblem *problem, const char *parameters,
                                                 const CzDakotaOptions *options, CzDakota **dakota,
                                                 CzError *error);
CZ_API void cz_dakota_free(CzDakota *dakota);

/* Why the evaluation failed; empty when it did not. */
CZ_API const char *cz_dakota_failure(const CzDakota *dakota);

/* Writes a results file: values and gradients, or `fail` and the reason. */
CZ_API void cz_dakota_write(const CzDakota *dakota, FILE *stream);

/* Writes the results file of an evaluation that could not be made. */
CZ_API void cz_dakota_write_failure(const char *reason, FILE *stream);

CZ_END_DECLARATIONS
#endif
