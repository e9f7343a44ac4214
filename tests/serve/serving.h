/* Servers of problems in memory, and the parts of their answers. */
#ifndef CZ_TESTS_SERVING_H
#define CZ_TESTS_SERVING_H

#include "crushzone/serve.h"
#include "support/check.h"

#include <jansson.h>

/* A problem and its server. */
typedef struct Serving {
    CzProblem *problem;
    CzServer *server;
} Serving;

/* Takes the problem over. */
static inline Serving serve(CzProblem *problem, int n_job) {
    Serving serving = {.problem = problem};
    const CzServerOptions options = {.n_job = n_job};
    CzError error = {0};
    const CzStatus status = cz_server_build(problem, &options, &serving.server, &error);
    if (status != CZ_OK)
        print_error("%s\n", error.message);
    assert_int_equal(status, CZ_OK);
    return serving;
}

static inline void end_serving(Serving *serving) {
    cz_server_free(serving->server);
    cz_problem_free(serving->problem);
}

/* The answer to n bytes without its end of line; freed by the caller. */
static inline char *ask_bytes(const Serving *serving, const char *line, size_t n_byte) {
    char *text = NULL;
    size_t n = 0;
    CzError error = {0};
    FILE *stream = open_memstream(&text, &n);
    assert_non_null(stream);
    assert_int_equal(cz_server_answer(serving->server, line, n_byte, stream, &error), CZ_OK);
    fclose(stream);
    assert_true(n > 0 && text[n - 1] == '\n' && strchr(text, '\n') == &text[n - 1]);
    text[n - 1] = '\0';
    return text;
}

static inline char *ask(const Serving *serving, const char *line) {
    return ask_bytes(serving, line, strlen(line));
}

/* The same as JSON, freed by json_decref. */
static inline json_t *ask_json(const Serving *serving, const char *line) {
    char *text = ask(serving, line);
    json_error_t error;
    json_t *json = json_loads(text, JSON_REJECT_DUPLICATES, &error);
    if (json == NULL)
        print_error("%s: %s\n", error.text, text);
    assert_non_null(json);
    free(text);
    return json;
}

static inline double number_at(const json_t *json, const char *key) {
    const json_t *value = json_object_get(json, key);
    if (value == NULL)
        print_error("no %s\n", key);
    assert_true(json_is_number(value));
    return json_number_value(value);
}

static inline const char *text_at(const json_t *json, const char *key) {
    const char *text = json_string_value(json_object_get(json, key));
    return text != NULL ? text : "";
}

#endif
