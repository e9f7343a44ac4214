/* Statuses and errors: texts, exit codes, writing a sentence. */
#include "base/error.h"

#include "base/text.h"

#include <stdarg.h>
#include <stdio.h>
#include <string.h>

static const struct {
    const char *text;
    int exit_code;
} statuses[] = {
#define CZ_STATUS(constant, exit_code, text) {text, exit_code},
#include "crushzone/statuses.def"
#undef CZ_STATUS
};

const char *cz_status_text(CzStatus status) {
    return statuses[status].text;
}

int cz_status_exit_code(CzStatus status) {
    return statuses[status].exit_code;
}

CzStatus cz_fail(CzError *error, CzStatus status, const char *format, ...) {
    if (error == NULL)
        return status;
    memset(error, 0, sizeof *error);
    error->status = status;
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(error->message, sizeof error->message, format, arguments);
    va_end(arguments);
    cz_text_repair(error->message);
    return status;
}

CzStatus cz_no_memory(CzError *error, const char *what) {
    return cz_fail(error, CZ_STATUS_NO_MEMORY, "no memory for %s", what);
}
