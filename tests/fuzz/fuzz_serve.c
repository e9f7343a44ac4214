/* Any bytes as a request to a server, whose runs end at once. */
#include "fuzz/fuzz.h"

#include "crushzone/serve.h"

#include <jansson.h>
#include <stdbool.h>
#include <string.h>

/* Built once, as a server is. */
static CzServer *server(void) {
    static CzServer *served;
    CzProblem *problem = NULL;
    CzError error = {0};
    const CzServerOptions options = {.n_job = 1};
    if (served != NULL)
        return served;
    FUZZ_DEMAND(cz_problem_read(CZ_SOURCE_FOLDER "/tests/fuzz/serve.yaml", NULL, &problem,
                                &error) == CZ_OK);
    FUZZ_DEMAND(cz_server_build(problem, &options, &served, &error) == CZ_OK);
    return served;
}

static bool is_answer(const json_t *json) {
    const char *status = json_string_value(json_object_get(json, "status"));
    const bool is_error = status != NULL && strcmp(status, "error") == 0;
    return status != NULL && is_error == (json_object_get(json, "error") != NULL) &&
           (is_error || strcmp(status, "ok") == 0 || strcmp(status, "failed") == 0);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t n_byte) {
    char *text = NULL;
    size_t n_text = 0;
    CzError error = {0};
    json_error_t mistake;
    FILE *stream = open_memstream(&text, &n_text);
    FUZZ_DEMAND(stream != NULL);
    FUZZ_DEMAND(cz_server_answer(server(), (const char *)data, n_byte, stream, &error) == CZ_OK);
    fclose(stream);
    FUZZ_DEMAND(n_text > 0 && memchr(text, '\n', n_text) == text + n_text - 1);
    json_t *json = json_loadb(text, n_text, JSON_REJECT_DUPLICATES, &mistake);
    FUZZ_DEMAND(json != NULL);
    FUZZ_DEMAND(json_is_array(json) || is_answer(json));
    for (size_t i = 0; i < json_array_size(json); i++)
        FUZZ_DEMAND(is_answer(json_array_get(json, i)));
    json_decref(json);
    free(text);
    return 0;
}
