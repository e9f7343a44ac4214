/* Writing and passing on errors. */
#ifndef CZ_BASE_ERROR_H
#define CZ_BASE_ERROR_H

#include "crushzone/status.h"

/* Writes status and sentence into *error (NULL is allowed) and returns the status. Place and help
 * are left empty. */
CzStatus cz_fail(CzError *error, CzStatus status, const char *format, ...)
    __attribute__((format(printf, 3, 4)));

/* Fails for lack of memory; `what` is what it was for, such as "the models". */
CzStatus cz_no_memory(CzError *error, const char *what);

/* Passes a failure on. */
#define CZ_TRY(call)                                                                               \
    do {                                                                                           \
        const CzStatus cz_try_status = (call);                                                     \
        if (cz_try_status != CZ_OK)                                                                \
            return cz_try_status;                                                                  \
    } while (0)

#endif
