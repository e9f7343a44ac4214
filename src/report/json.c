/* JSON documents: punctuation, indents, escaped texts, shortest numbers. */
#include "report/json.h"

#include "base/error.h"
#include "base/number.h"
#include "base/text.h"
#include "report/figure.h"

#include <errno.h>
#include <math.h>
#include <string.h>

static bool is_utf8(const char *text) {
    size_t n = strlen(text);
    for (size_t step; n > 0; text += step, n -= step)
        if ((step = cz_text_character(text, n)) == 0)
            return false;
    return true;
}

static void write_text(FILE *stream, const char *text) {
    static const char signs[] = "\"\\\b\f\n\r\t", letters[] = "\"\\bfnrt";
    const bool is_whole = is_utf8(text);
    fputc('"', stream);
    for (; *text != '\0'; text++) {
        const unsigned char c = (unsigned char)*text;
        const char *sign = strchr(signs, c);
        if (sign != NULL)
            fprintf(stream, "\\%c", letters[sign - signs]);
        else if (c < 0x20)
            fprintf(stream, "\\u%04X", c);
        else
            fputc(c < 0x80 || is_whole ? c : '?', stream);
    }
    fputc('"', stream);
}

static void begin_line(const CzJson *json) {
    if (!json->is_line)
        fprintf(json->stream, "\n%*s", 2 * json->depth, "");
}

static void begin_item(CzJson *json, const char *key) {
    if (json->has_item)
        fputs(json->is_line ? ", " : ",", json->stream);
    if (json->depth > 0)
        begin_line(json);
    json->has_item = true;
    if (key == NULL)
        return;
    write_text(json->stream, key);
    fputs(": ", json->stream);
}

static void open_value(CzJson *json, const char *key, char begin, char end) {
    begin_item(json, key);
    fputc(begin, json->stream);
    json->end[json->depth++] = end;
    json->has_item = false;
}

void cz_json_open_object(CzJson *json, const char *key) {
    open_value(json, key, '{', '}');
}

void cz_json_open_list(CzJson *json, const char *key) {
    open_value(json, key, '[', ']');
}

void cz_json_close(CzJson *json) {
    json->depth--;
    if (json->has_item)
        begin_line(json);
    fputc(json->end[json->depth], json->stream);
    json->has_item = true;
}

void cz_json_text(CzJson *json, const char *key, const char *text) {
    begin_item(json, key);
    if (text != NULL)
        write_text(json->stream, text);
    else
        fputs("null", json->stream);
}

void cz_json_real(CzJson *json, const char *key, double value) {
    cz_json_exact(json, key, cz_figure_quantity(value));
}

void cz_json_exact(CzJson *json, const char *key, double value) {
    char text[CZ_NUMBER_TEXT];
    begin_item(json, key);
    fputs(isfinite(value) ? cz_number_print(text, cz_figure_exact(value)) : "null", json->stream);
    if (isfinite(value) && strpbrk(text, ".e") == NULL)
        fputs(".0", json->stream); /* keeps the number a real */
}

void cz_json_integer(CzJson *json, const char *key, long value) {
    begin_item(json, key);
    fprintf(json->stream, "%ld", value);
}

void cz_json_flag(CzJson *json, const char *key, bool value) {
    begin_item(json, key);
    fputs(value ? "true" : "false", json->stream);
}

CzStatus cz_json_finish(CzJson *json, CzError *error) {
    fputc('\n', json->stream);
    if (fflush(json->stream) != 0 || ferror(json->stream))
        return cz_fail(error, CZ_STATUS_OUTPUT, "the JSON document cannot be written: %s",
                       strerror(errno));
    return CZ_OK;
}
