/* A problem that can be read, written out and read again is the same problem: the second writing
 * has the bytes of the first, comments aside. */
#include "fuzz/fuzz.h"

#include <stdbool.h>
#include <string.h>

static CzStatus read_text(const char *text, size_t n_byte, CzProblem **problem, CzError *error) {
    CzProblemOptions options = cz_problem_options_default();
    options.share_folder = FUZZ_SHARE_FOLDER;
    return cz_problem_read_text(text, n_byte, "input.yaml", FUZZ_SHARE_FOLDER, &options, problem,
                                error);
}

/* Removes comments, and then spaces at the ends of lines and empty lines. A comment begins with a
 * '#' outside quotes at the start of a line or after a space. */
static void strip_comments(char *text) {
    char *to = text, *line = text; /* line: start of the current one */
    bool is_quoted = false;
    for (const char *at = text; *at != '\0'; at++) {
        if (*at == '#' && !is_quoted && (at == text || at[-1] == '\n' || at[-1] == ' '))
            at += strcspn(at, "\n");
        if (*at == '"' && (at == text || at[-1] != '\\'))
            is_quoted = !is_quoted;
        if (*at != '\n') {
            *to++ = *at;
            continue;
        }
        while (to > line && to[-1] == ' ')
            to--;
        if (to > line)
            *to++ = '\n';
        line = to;
    }
    *to = '\0';
}

/* The problem as resolved YAML; allocated with malloc. */
static char *write_out(const CzProblem *problem, size_t *n_byte) {
    char *text = NULL;
    FILE *stream = open_memstream(&text, n_byte);
    FUZZ_DEMAND(stream != NULL);
    cz_problem_write_resolved(problem, stream);
    FUZZ_DEMAND(fclose(stream) == 0);
    return text;
}

static void check_round_trip(const CzProblem *problem) {
    CzProblem *again = NULL;
    CzError error = {0};
    size_t n_first = 0, n_second = 0;
    char *first = write_out(problem, &n_first);
    const CzStatus status = read_text(first, n_first, &again, &error);
    if (status != CZ_OK)
        fprintf(stderr, "%s:%d:%d: %s\n%s", error.file, error.line, error.column, error.message,
                first);
    FUZZ_DEMAND(status == CZ_OK);
    char *second = write_out(again, &n_second);
    strip_comments(first);
    strip_comments(second);
    if (strcmp(first, second) != 0) {
        size_t n_same = 0;
        while (first[n_same] == second[n_same])
            n_same++;
        const size_t from = n_same > 200 ? n_same - 200 : 0;
        fprintf(stderr, "first: %.300s\n\nsecond: %.300s\n", first + from, second + from);
    }
    FUZZ_DEMAND(strcmp(first, second) == 0);
    free(first);
    free(second);
    cz_problem_free(again);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t n_byte) {
    CzProblem *problem = NULL;
    CzError error = {0};
    const CzStatus status = read_text((const char *)data, n_byte, &problem, &error);
    fuzz_check_told(problem, status, &error);
    if (status == CZ_OK)
        check_round_trip(problem);
    cz_problem_free(problem);
    return 0;
}
