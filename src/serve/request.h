/* Requests of a design loop, read from a line of JSON. */
#ifndef CZ_SERVE_REQUEST_H
#define CZ_SERVE_REQUEST_H

#include <stdbool.h>
#include <stddef.h>

#include "base/arena.h"
#include "crushzone/status.h"

typedef enum CzOperation {
#define CZ_OPERATION(constant, name, doc) CZ_OPERATION_##constant,
#include "serve/requests.def"
#undef CZ_OPERATION
    CZ_N_OPERATION
} CzOperation;

typedef enum CzRequestKey {
#define CZ_REQUEST_KEY(constant, ...) CZ_REQUEST_##constant,
#include "serve/requests.def"
#undef CZ_REQUEST_KEY
    CZ_N_REQUEST_KEY
} CzRequestKey;

typedef enum CzRequestForm {
    CZ_REQUEST_TEXT,
    CZ_REQUEST_WHOLE,
    CZ_REQUEST_NUMBER,
    CZ_REQUEST_TEXTS,
    CZ_REQUEST_VALUES
} CzRequestForm;

typedef struct CzRequestKeyInfo {
    const char *name;
    CzRequestForm form;
    unsigned operations; /* a sum of 1 << CzOperation */
    const char *doc;
} CzRequestKeyInfo;
extern const CzRequestKeyInfo cz_request_keys[CZ_N_REQUEST_KEY];
extern const char *const cz_operations[CZ_N_OPERATION]; /* their names */

/* Values by name; texts of numbers read back to the same bits. */
typedef struct CzNamedValues {
    int n;
    const char **name, **text; /* (n) */
    double *number;            /* NaN for a text (n) */
} CzNamedValues;

/* Different texts. */
typedef struct CzTextList {
    int n;
    const char **text; /* (n) */
} CzTextList;

/* One request. Texts are of the arena. */
typedef struct CzRequest {
    CzError error; /* of a request that is not one; CZ_OK otherwise */
    CzOperation operation;
    bool has_id;
    long id;
    CzNamedValues set, variables;
    CzTextList scenarios, want;
    double step; /* NaN when not given */
} CzRequest;

typedef struct CzRequests {
    bool is_batch; /* a list of requests, answered by a list */
    int n;
    CzRequest *request; /* (n) */
} CzRequests;

/* Reads a line. What is wrong with a request is in that request; statuses: CZ_OK, CZ_STATUS_INPUT
 * for a line that is no JSON, with its column, CZ_STATUS_NO_MEMORY. */
CZ_MUST_CHECK CzStatus cz_requests_read(const char *line, size_t n_byte, CzArena *arena,
                                        CzRequests *requests, CzError *error);

#endif
