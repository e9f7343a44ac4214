/* Parameters files of Dakota, in its standard and its APREPRO format.
 *
 *   standard                              APREPRO
 *   2 variables                           { DAKOTA_VARS = 2 }
 *   1.5 x1                                { x1 = 1.5 }
 *   tube-b part                           { part = "tube-b" }
 *   1 functions                           { DAKOTA_FNS = 1 }
 *   3 ASV_1:objective                     { ASV_1:objective = 3 }
 *   1 derivative_variables                { DAKOTA_DER_VARS = 1 }
 *   1 DVV_1:x1                            { DVV_1:x1 = 1 }
 *   0 analysis_components                 { DAKOTA_AN_COMPS = 0 }
 *   7 eval_id                             { DAKOTA_EVAL_ID = 7 }
 *   0 metadata                            { DAKOTA_METADATA = 0 }, since Dakota 6.16
 */
#ifndef CZ_SERVE_DAKOTA_PARAMETERS_H
#define CZ_SERVE_DAKOTA_PARAMETERS_H

#include "text/source.h"

/* A line with a value and a label. */
typedef struct CzDakotaEntry {
    const char *label; /* descriptor of a variable or a response; of a component its driver */
    const char *text;  /* the value */
    int number;        /* of a response its request (ASV), of a derivative its variable from 0 */
    int line, column;  /* of the value, counted from 1 */
} CzDakotaEntry;

/* Requests of a response, which are added. */
enum { CZ_DAKOTA_VALUE = 1, CZ_DAKOTA_GRADIENT = 2, CZ_DAKOTA_HESSIAN = 4 };

typedef struct CzDakotaList {
    int n;
    CzDakotaEntry *entry; /* (n) */
} CzDakotaList;

typedef struct CzDakotaParameters {
    const CzSource *source;
    CzDakotaList variable, response, derivative, component;
    const char *evaluation; /* its identifier */
} CzDakotaParameters;

/* Reads a file; memory comes from the arena. Statuses: CZ_OK, CZ_STATUS_INPUT with line and column
 * of the first mistake, CZ_STATUS_NO_MEMORY. */
CZ_MUST_CHECK CzStatus cz_dakota_parameters_read(CzArena *arena, const char *path,
                                                 CzDakotaParameters *parameters, CzError *error);

#endif
