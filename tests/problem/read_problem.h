/* Reading good problems in tests. */
#ifndef CZ_TESTS_READ_PROBLEM_H
#define CZ_TESTS_READ_PROBLEM_H

#include "support/check.h"

#include <stdbool.h>

#include "problem/problem.h"

#define GOOD_FOLDER CZ_SOURCE_FOLDER "/tests/problem/good"

/* Prints the mistakes of a problem. */
static inline void print_mistakes(const CzProblem *problem) {
    for (int i = 0; i < cz_problem_n_mistake(problem); i++) {
        const CzError *error = cz_problem_mistake(problem, i);
        print_error("%s:%d:%d: %s (%s)\n", error->file, error->line, error->column, error->message,
                    error->help);
    }
}

/* Of rigid.yaml and what extends it: an anti-climber on an end that meets nothing. */
enum { OWN_WARNINGS = 1 };

/* Reads a file of the folder `good`, which must be valid. */
static inline CzProblem *read_good(const char *name, int n_set, const char *const *set) {
    char path[300];
    CzProblemOptions options = cz_problem_options_default();
    CzProblem *problem = NULL;
    snprintf(path, sizeof path, GOOD_FOLDER "/%s", name);
    options.set = set;
    options.n_set = n_set;
    const CzStatus status = cz_problem_read(path, &options, &problem, NULL);
    if (status != CZ_OK)
        print_mistakes(problem);
    assert_int_equal(status, CZ_OK);
    return problem;
}

/* Reads a text as if it lay in the good folder. */
static inline CzStatus read_text(const char *text, CzProblem **problem) {
    return cz_problem_read_text(text, strlen(text), "text.yaml", GOOD_FOLDER, NULL, problem, NULL);
}

static inline CzProblem *read_good_text(const char *text) {
    CzProblem *problem = NULL;
    const CzStatus status = read_text(text, &problem);
    if (status != CZ_OK)
        print_mistakes(problem);
    assert_int_equal(status, CZ_OK);
    return problem;
}

/* Vehicle by its name. */
static inline const CzVehicle *find_vehicle(const CzProblem *problem, const char *name) {
    int n_vehicle = 0;
    const CzVehicle *vehicle = cz_problem_vehicles(problem, &n_vehicle);
    for (int i = 0; i < n_vehicle; i++)
        if (strcmp(vehicle[i].name, name) == 0)
            return &vehicle[i];
    fail_msg("there is no vehicle %s", name);
    return NULL;
}

/* The resolved problem as text; the caller frees it. */
static inline char *resolved_text(const CzProblem *problem) {
    char *text = NULL;
    size_t n_byte = 0;
    FILE *stream = open_memstream(&text, &n_byte);
    assert_non_null(stream);
    cz_problem_write_resolved(problem, stream);
    fclose(stream);
    return text;
}

#endif
