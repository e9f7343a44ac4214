/* Functions that all fuzz targets use. */
#include "fuzz/fuzz.h"

#include <string.h>

#include "base/text.h"

static bool is_text(const char *text) {
    char what[CZ_FAULT_SIZE];
    size_t at;
    return !cz_text_fault(text, strlen(text), false, &at, what);
}

static void check_error(const CzProblem *problem, const CzError *error) {
    FUZZ_DEMAND(error->status == CZ_STATUS_INPUT);
    FUZZ_DEMAND(error->message[0] != '\0' && error->file[0] != '\0');
    FUZZ_DEMAND(is_text(error->message) && is_text(error->help));
    FUZZ_DEMAND(error->line >= 0 && error->column >= 0);
    const char *line = cz_problem_source_line(problem, error);
    FUZZ_DEMAND(line == NULL || error->column <= (int)strlen(line) + 1);
}

void fuzz_check_told(const CzProblem *problem, CzStatus status, const CzError *error) {
    FUZZ_DEMAND(problem != NULL);
    FUZZ_DEMAND(status == CZ_OK || status == CZ_STATUS_INPUT);
    FUZZ_DEMAND((status == CZ_OK) == (cz_problem_n_mistake(problem) == 0));
    if (status != CZ_OK)
        check_error(problem, error);
    for (int i = 0; i < cz_problem_n_mistake(problem); i++)
        check_error(problem, cz_problem_mistake(problem, i));
    for (int i = 0; i < cz_problem_n_warning(problem); i++)
        check_error(problem, cz_problem_warning(problem, i));
}

const char *fuzz_write_file(const char *name, const uint8_t *data, size_t n_byte) {
    FILE *file = fopen(name, "wb");
    FUZZ_DEMAND(file != NULL);
    FUZZ_DEMAND(fwrite(data, 1, n_byte, file) == n_byte);
    FUZZ_DEMAND(fclose(file) == 0);
    return name;
}
