/* Writing and passing on errors. */
#ifndef CZ_BASE_ERROR_H
#define CZ_BASE_ERROR_H

#include <stdarg.h>

#include "crushzone/status.h"

/* In a sentence: the text after it is the hint. */
#define CZ_HELP "\v"

/* Writes status, sentence and hint into *error (NULL is allowed) and returns the status. The place
 * is left empty. */
CzStatus cz_fail(CzError *error, CzStatus status, const char *format, ...)
    __attribute__((format(printf, 3, 4)));

/* Fails for lack of memory; `what` names its purpose, such as "the models". */
CzStatus cz_no_memory(CzError *error, const char *what);

/* Writes sentence and hint alone. */
void cz_error_format(CzError *error, const char *format, va_list arguments);

/* Writes the hint alone. */
void cz_error_help(CzError *error, const char *format, ...) __attribute__((format(printf, 2, 3)));

/* Passes a failure on. */
#define CZ_TRY(call)                                                                               \
    do {                                                                                           \
        const CzStatus cz_try_status = (call);                                                     \
        if (cz_try_status != CZ_OK)                                                                \
            return cz_try_status;                                                                  \
    } while (0)

#endif
