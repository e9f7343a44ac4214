/* A problem that answers requests of a design loop: one line of JSON in, one line of JSON out.
 *
 * docs/loops.md describes requests and answers. A request that cannot be answered has an answer
 * that says why.
 */
#ifndef CRUSHZONE_SERVE_H
#define CRUSHZONE_SERVE_H

#include <signal.h>
#include <stddef.h>
#include <stdio.h>

#include "crushzone/problem.h"

CZ_BEGIN_DECLARATIONS

enum { CZ_LONGEST_REQUEST = 16 << 20 }; /* longer lines are refused unread [byte] */

typedef struct CzServer CzServer;

typedef struct CzServerOptions {
    int n_job;            /* threads; 0: one per processor. No answer depends on it */
    const char *scenario; /* requests without scenarios run only this scenario or family; NULL: all
                           */
    const volatile sig_atomic_t *stop; /* a flag that ends an answer; NULL for none */
} CzServerOptions;

/* The problem must outlive the server; options may be NULL. Statuses: CZ_OK, CZ_STATUS_INPUT,
 * CZ_STATUS_NO_MEMORY. */
CZ_MUST_CHECK CZ_API CzStatus cz_server_build(const CzProblem *problem,
                                              const CzServerOptions *options, CzServer **server,
                                              CzError *error);
CZ_API void cz_server_free(CzServer *server);

/* Answers one line, n_byte bytes without its end, by one line on the stream. Statuses: CZ_OK also
 * for a request that cannot be answered; CZ_STATUS_INTERRUPTED, and then the line is not complete;
 * CZ_STATUS_OUTPUT when the stream fails. */
CZ_MUST_CHECK CZ_API CzStatus cz_server_answer(CzServer *server, const char *line, size_t n_byte,
                                               FILE *stream, CzError *error);

/* Answers a line that was not read because it is longer than CZ_LONGEST_REQUEST. Status:
 * CZ_STATUS_OUTPUT. */
CZ_MUST_CHECK CZ_API CzStatus cz_server_refuse_line(FILE *stream, CzError *error);

/* Writes the JSON schema of a request. */
CZ_API void cz_server_write_request_schema(FILE *stream);

CZ_END_DECLARATIONS
#endif
