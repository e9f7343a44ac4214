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

void cz_error_format(CzError *error, const char *format, va_list arguments) {
    char sentence[2 * sizeof error->message];
    vsnprintf(sentence, sizeof sentence, format, arguments);
    char *help = strstr(sentence, CZ_HELP);
    if (help != NULL)
        *help++ = '\0';
    cz_text_repair(sentence);
    cz_text_copy(error->message, sizeof error->message, sentence);
    cz_error_help(error, "%s", help != NULL ? help : "");
}

void cz_error_help(CzError *error, const char *format, ...) {
    char sentence[2 * sizeof error->help];
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(sentence, sizeof sentence, format, arguments);
    va_end(arguments);
    cz_text_repair(sentence);
    cz_text_copy(error->help, sizeof error->help, sentence);
}

CzStatus cz_fail(CzError *error, CzStatus status, const char *format, ...) {
    if (error == NULL)
        return status;
    memset(error, 0, sizeof *error);
    error->status = status;
    va_list arguments;
    va_start(arguments, format);
    cz_error_format(error, format, arguments);
    va_end(arguments);
    return status;
}

CzStatus cz_no_memory(CzError *error, const char *what) {
    return cz_fail(error, CZ_STATUS_NO_MEMORY, "no memory for %s", what);
}
