/* Values of a JSON document by path. */
#ifndef CZ_TESTS_REPORT_JSON_AT_H
#define CZ_TESTS_REPORT_JSON_AT_H

#include "support/check.h"

#include <jansson.h>

/* The value at a path of keys and indices such as "scenarios.0.name". */
static inline const json_t *at(const json_t *json, const char *path) {
    char key[64];
    while (json != NULL && *path != '\0') {
        const size_t n = strcspn(path, ".");
        snprintf(key, sizeof key, "%.*s", (int)n, path);
        json = json_is_array(json) ? json_array_get(json, (size_t)atoi(key))
                                   : json_object_get(json, key);
        if (json == NULL)
            print_error("no key '%s'\n", key);
        path += n + (path[n] == '.');
    }
    assert_non_null(json);
    return json;
}

#define assert_text_at(json, path, expected)                                                       \
    assert_string_equal(json_string_value(at(json, path)), expected)
#define assert_real_at(json, path, expected)                                                       \
    assert_near(json_number_value(at(json, path)), expected, 1e-15, 0)
#define assert_null_at(json, path) assert_true(json_is_null(at(json, path)))

#endif
