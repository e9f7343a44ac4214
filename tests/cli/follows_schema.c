/* follows_schema SCHEMA DOCUMENT...: fails with the path when a JSON document violates a schema.
 * Supports the keywords that our schemas use: $ref into $defs, type, enum, properties, required,
 * additionalProperties, items, minItems, maxItems. */
#include <stdbool.h>
#include <stdio.h>
#include <string.h>

#include <jansson.h>

static const json_t *definitions;

static bool follows(const json_t *value, const json_t *schema, const char *path);

static bool fails(const char *path, const char *what) {
    printf("%s: %s\n", path, what);
    return false;
}

static bool is_of_type(const json_t *value, const char *type) {
    return (strcmp(type, "object") == 0 && json_is_object(value)) ||
           (strcmp(type, "array") == 0 && json_is_array(value)) ||
           (strcmp(type, "string") == 0 && json_is_string(value)) ||
           (strcmp(type, "number") == 0 && json_is_number(value)) ||
           (strcmp(type, "integer") == 0 && json_is_integer(value)) ||
           (strcmp(type, "boolean") == 0 && json_is_boolean(value)) ||
           (strcmp(type, "null") == 0 && json_is_null(value));
}

static bool has_type(const json_t *value, const json_t *type) {
    size_t i;
    const json_t *one;
    if (json_is_string(type))
        return is_of_type(value, json_string_value(type));
    json_array_foreach((json_t *)type, i, one) {
        if (is_of_type(value, json_string_value(one)))
            return true;
    }
    return false;
}

static bool is_among(const json_t *value, const json_t *list) {
    size_t i;
    const json_t *one;
    json_array_foreach((json_t *)list, i, one) {
        if (json_equal(value, one))
            return true;
    }
    return false;
}

static bool members_follow(const json_t *object, const json_t *schema, const char *path) {
    const json_t *properties = json_object_get(schema, "properties");
    const json_t *others = json_object_get(schema, "additionalProperties");
    bool all = true;
    const char *key;
    json_t *value, *name;
    size_t i;
    json_array_foreach(json_object_get(schema, "required"), i, name) {
        if (json_object_get(object, json_string_value(name)) == NULL)
            all = fails(path, json_string_value(name)) && all;
    }
    json_object_foreach((json_t *)object, key, value) {
        char below[1024];
        const json_t *own = json_object_get(properties, key);
        snprintf(below, sizeof below, "%.900s.%.100s", path, key);
        if (own == NULL && json_is_false(others))
            all = fails(below, "is no key of the schema");
        else if (own != NULL || others != NULL)
            all = follows(value, own != NULL ? own : others, below) && all;
    }
    return all;
}

static bool items_follow(const json_t *array, const json_t *schema, const char *path) {
    const json_t *least = json_object_get(schema, "minItems"),
                 *most = json_object_get(schema, "maxItems");
    bool all = true;
    size_t i;
    json_t *value;
    if ((least != NULL && json_array_size(array) < (size_t)json_integer_value(least)) ||
        (most != NULL && json_array_size(array) > (size_t)json_integer_value(most)))
        return fails(path, "has too few or too many items");
    json_array_foreach((json_t *)array, i, value) {
        char below[1024];
        snprintf(below, sizeof below, "%.900s.%d", path, (int)i);
        all = follows(value, json_object_get(schema, "items"), below) && all;
    }
    return all;
}

static bool follows(const json_t *value, const json_t *schema, const char *path) {
    const json_t *reference = json_object_get(schema, "$ref");
    const json_t *type = json_object_get(schema, "type"), *list = json_object_get(schema, "enum");
    if (reference != NULL) {
        const char *name = strrchr(json_string_value(reference), '/') + 1;
        const json_t *meant = json_object_get(definitions, name);
        return meant != NULL ? follows(value, meant, path) : fails(path, "the schema lacks it");
    }
    if (type == NULL && list == NULL)
        return fails(path, "the schema says nothing of it");
    if (type != NULL && !has_type(value, type))
        return fails(path, "is of another type");
    if (list != NULL && !is_among(value, list))
        return fails(path, "has another word");
    return json_is_object(value)  ? members_follow(value, schema, path)
           : json_is_array(value) ? items_follow(value, schema, path)
                                  : true;
}

int main(int argc, char **argv) {
    json_error_t error;
    json_t *schema = argc > 2 ? json_load_file(argv[1], 0, &error) : NULL;
    bool all = schema != NULL;
    definitions = json_object_get(schema, "$defs");
    for (int i = 2; i < argc && schema != NULL; i++) {
        json_t *document = json_load_file(argv[i], 0, &error);
        all = document != NULL && follows(document, schema, argv[i]) && all;
        json_decref(document);
    }
    json_decref(schema);
    return all ? 0 : 1;
}
