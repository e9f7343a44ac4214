/* JSON documents: the only file that includes jansson. */
#include "report/json.h"

#include "base/error.h"
#include "base/memory_text.h"
#include "base/number.h"
#include "report/figure.h"

#include <errno.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include <jansson.h>

enum { MAX_DEPTH = 16 };

struct CzJson {
    json_t *open[MAX_DEPTH]; /* records and lists that are open, outermost first */
    int depth;               /* how many */
    bool failed;             /* an allocation failed */
};

CzJson *cz_json_create(void) {
    CzJson *json = calloc(1, sizeof *json);
    if (json == NULL)
        return NULL;
    json->open[0] = json_object();
    json->depth = 1;
    json->failed = json->open[0] == NULL;
    return json;
}

/* Adds a new value to the open record or list; takes the reference. */
static void put(CzJson *json, const char *key, json_t *value) {
    json_t *parent = json->open[json->depth - 1];
    const int failed = key != NULL ? json_object_set_new(parent, key, value)
                                   : json_array_append_new(parent, value);
    json->failed = json->failed || failed != 0;
}

static void open_value(CzJson *json, const char *key, json_t *value) {
    if (json == NULL || json->failed || json->depth == MAX_DEPTH) {
        json_decref(value);
        return;
    }
    put(json, key, value);
    if (!json->failed)
        json->open[json->depth++] = value;
}

void cz_json_open_object(CzJson *json, const char *key) {
    open_value(json, key, json_object());
}

void cz_json_open_list(CzJson *json, const char *key) {
    open_value(json, key, json_array());
}

void cz_json_close(CzJson *json) {
    if (json != NULL && !json->failed && json->depth > 1)
        json->depth--;
}

/* A text that is not valid UTF-8, with question marks for bytes beyond ASCII. */
static json_t *ascii_text(const char *text) {
    const size_t n = strlen(text);
    char *copy = malloc(n + 1);
    if (copy == NULL)
        return NULL;
    for (size_t i = 0; i <= n; i++)
        copy[i] = (unsigned char)text[i] < 0x80 ? text[i] : '?';
    json_t *value = json_string(copy);
    free(copy);
    return value;
}

void cz_json_text(CzJson *json, const char *key, const char *text) {
    if (json == NULL || json->failed)
        return;
    json_t *value = text == NULL ? json_null() : json_string(text);
    if (value == NULL && text != NULL) /* invalid UTF-8, or no memory, so that this fails again */
        value = ascii_text(text);
    put(json, key, value);
}

void cz_json_real(CzJson *json, const char *key, double value) {
    cz_json_exact(json, key, cz_figure_quantity(value));
}

void cz_json_exact(CzJson *json, const char *key, double value) {
    if (json != NULL && !json->failed)
        put(json, key, isfinite(value) ? json_real(cz_figure_exact(value)) : json_null());
}

void cz_json_whole(CzJson *json, const char *key, long value) {
    if (json != NULL && !json->failed)
        put(json, key, json_integer(value));
}

void cz_json_flag(CzJson *json, const char *key, bool value) {
    if (json != NULL && !json->failed)
        put(json, key, json_boolean(value));
}

/* Writes a number; a real gets the fewest digits that read back to the same value. */
static void write_number(const char *number, size_t n, FILE *stream) {
    char text[48], shortest[CZ_NUMBER_TEXT];
    double value;
    snprintf(text, sizeof text, "%.*s", (int)n, number);
    const bool whole = strpbrk(text, ".eE") == NULL;
    if (n >= sizeof text || whole || cz_number_parse(text, &value) != NULL) {
        fwrite(number, 1, n, stream);
        return;
    }
    fputs(cz_number_print(shortest, value), stream);
    if (strpbrk(shortest, ".e") == NULL)
        fputs(".0", stream); /* a real stays one */
}

static void write_document(const char *text, FILE *stream) {
    bool in_string = false;
    while (*text != '\0') {
        const size_t n_number = in_string ? 0 : strspn(text, "+-.0123456789eE");
        if (n_number > 0 && strchr("-0123456789", *text) != NULL) {
            write_number(text, n_number, stream);
            text += n_number;
            continue;
        }
        if (in_string && *text == '\\')
            fputc(*text++, stream);
        else if (*text == '"')
            in_string = !in_string;
        fputc(*text++, stream);
    }
    fputc('\n', stream);
}

static int take_text(const char *bytes, size_t n, void *memory) {
    return cz_memory_text_add(memory, bytes, n) ? 0 : -1;
}

CzStatus cz_json_finish(CzJson *json, FILE *stream, CzError *error) {
    CzMemoryText memory = {0};
    const bool is_whole = json != NULL && !json->failed &&
                          json_dump_callback(json->open[0], take_text, &memory,
                                             JSON_INDENT(2) | JSON_REAL_PRECISION(17)) == 0 &&
                          !memory.failed; /* a failure of take_text() may not stop jansson */
    if (json != NULL)
        json_decref(json->open[0]);
    free(json);
    if (is_whole)
        write_document(memory.text, stream);
    cz_memory_text_free(&memory);
    if (!is_whole)
        return cz_fail(error, CZ_STATUS_NO_MEMORY, "no memory for a JSON document");
    if (fflush(stream) != 0 || ferror(stream))
        return cz_fail(error, CZ_STATUS_OUTPUT, "the JSON document cannot be written: %s",
                       strerror(errno));
    return CZ_OK;
}
