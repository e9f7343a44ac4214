/* read_json FILE PATH: prints the value at a path of keys and indices such as checks.0.name of the
 * one JSON document that a file holds. Exit code 1 when the file is not a JSON document or the path
 * is missing.
 */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <jansson.h>

static const json_t *value_at(const json_t *json, const char *path) {
    char key[128];
    while (json != NULL && *path != '\0') {
        const size_t n = strcspn(path, ".");
        snprintf(key, sizeof key, "%.*s", (int)n, path);
        json = json_is_array(json) ? json_array_get(json, (size_t)strtoul(key, NULL, 10))
                                   : json_object_get(json, key);
        path += n + (path[n] == '.');
    }
    return json;
}

int main(int argc, char **argv) {
    json_error_t error;
    if (argc != 3)
        return 2;
    json_t *json = json_load_file(argv[1], 0, &error);
    if (json == NULL) {
        printf("%s:%d:%d: %s\n", argv[1], error.line, error.column, error.text);
        return 1;
    }
    const json_t *value = value_at(json, argv[2]);
    if (json_is_string(value))
        puts(json_string_value(value));
    else if (value != NULL)
        json_dumpf(value, stdout, JSON_ENCODE_ANY | JSON_REAL_PRECISION(15));
    json_decref(json);
    return value == NULL;
}
