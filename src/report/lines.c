/* Lines of JSON whose keys are written and read in a fixed order. */
#include "report/lines.h"

#include "base/number.h"
#include "base/text.h"

#include <math.h>
#include <string.h>

/* ---- writing ---- */

void cz_line_write_text(const char *text, FILE *stream) {
    fputc('"', stream);
    for (; *text != '\0'; text++) {
        const unsigned char byte = (unsigned char)*text;
        if (byte == '"' || byte == '\\')
            fprintf(stream, "\\%c", byte);
        else if (byte < 0x20)
            fprintf(stream, "\\u%04X", byte);
        else
            fputc(byte, stream);
    }
    fputc('"', stream);
}

void cz_line_write_texts(const char *key, int n, const char *const *text, FILE *stream) {
    fprintf(stream, ", \"%s\": [", key);
    for (int i = 0; i < n; i++) {
        fputs(i > 0 ? ", " : "", stream);
        cz_line_write_text(text[i] != NULL ? text[i] : "", stream);
    }
    fputc(']', stream);
}

/* A number to the last bit. JSON has no infinities, which are texts, and no NaN, which is null. */
void cz_line_write_number(double value, FILE *stream) {
    char text[CZ_NUMBER_TEXT];
    if (isnan(value))
        fputs("null", stream);
    else if (isinf(value))
        fputs(value > 0 ? "\"inf\"" : "\"-inf\"", stream);
    else
        fputs(cz_number_print_exact(text, value), stream);
}

void cz_line_write_numbers(const char *key, int n, const double *value, FILE *stream) {
    fprintf(stream, "\"%s\": [", key);
    for (int i = 0; i < n; i++) {
        fputs(i > 0 ? ", " : "", stream);
        cz_line_write_number(value[i], stream);
    }
    fputs("], ", stream);
}

/* ---- reading ---- */

void cz_line_expect(CzLineCursor *cursor, const char *text) {
    const size_t n = strlen(text);
    cursor->failed = cursor->failed || strncmp(cursor->at, text, n) != 0;
    if (!cursor->failed)
        cursor->at += n;
}

/* Reads the four digits of an escape; false when they are not there. */
static bool read_escape(const char *digits, char *byte) {
    unsigned code;
    if (strspn(digits, "0123456789ABCDEFabcdef") < 4 || sscanf(digits, "%4x", &code) != 1)
        return false;
    *byte = (char)code;
    return true;
}

/* Removes a text with its quotes and undoes its escapes. */
const char *cz_line_text(CzLineCursor *cursor) {
    cz_line_expect(cursor, "\"");
    char *text = cursor->at, *to = text, what[CZ_FAULT_SIZE];
    size_t at;
    while (!cursor->failed && *cursor->at != '"') {
        if (strncmp(cursor->at, "\\u", 2) == 0 && read_escape(cursor->at + 2, to)) {
            to++;
            cursor->at += 6;
        } else {
            cursor->at += *cursor->at == '\\';
            cursor->failed = *cursor->at == '\0';
            if (!cursor->failed)
                *to++ = *cursor->at++;
        }
    }
    cz_line_expect(cursor, "\"");
    const size_t n = (size_t)(to - text);
    cursor->failed = cursor->failed || cz_text_fault(text, n, false, &at, what);
    const char *copy = cursor->failed ? NULL : cz_arena_copy_text(cursor->arena, text, n);
    cursor->failed |= copy == NULL;
    return copy != NULL ? copy : "";
}

/* Removes a number up to the sign that follows it. */
double cz_line_number(CzLineCursor *cursor) {
    const size_t n = strcspn(cursor->at, ",]}");
    char text[CZ_NUMBER_TEXT] = "";
    double value = NAN;
    if (cursor->failed || n >= sizeof text) {
        cursor->failed = true;
        return NAN;
    }
    memcpy(text, cursor->at, n);
    cursor->at += n;
    if (strcmp(text, "\"inf\"") == 0 || strcmp(text, "\"-inf\"") == 0)
        return text[1] == '-' ? -INFINITY : INFINITY;
    cursor->failed = strcmp(text, "null") != 0 && !cz_number_scan(text, &value);
    return value;
}

long cz_line_integer(CzLineCursor *cursor, const char *before) {
    cz_line_expect(cursor, before);
    const double value = cz_line_number(cursor);
    cursor->failed |= !(fabs(value) < 1e15) || value != round(value);
    return cursor->failed ? 0 : (long)value;
}

/* Removes a list of numbers; *n is their number. */
const double *cz_line_numbers(CzLineCursor *cursor, const char *before, int *n) {
    cz_line_expect(cursor, before);
    const size_t n_byte = cursor->failed ? 0 : strcspn(cursor->at, "]");
    *n = n_byte > 0;
    for (size_t i = 0; i < n_byte; i++)
        *n += cursor->at[i] == ',';
    double *value = cz_arena_numbers(cursor->arena, (size_t)*n);
    cursor->failed |= value == NULL;
    for (int i = 0; i < *n && !cursor->failed; i++) {
        value[i] = cz_line_number(cursor);
        cz_line_expect(cursor, i + 1 < *n ? ", " : "");
    }
    cz_line_expect(cursor, "], ");
    return value;
}

const char *const *cz_line_texts(CzLineCursor *cursor, const char *before, int *n) {
    const char **text = NULL;
    cz_line_expect(cursor, before);
    for (*n = 0; !cursor->failed && *cursor->at != ']'; (*n)++) {
        text = cz_arena_grow(cursor->arena, text, *n, sizeof *text);
        if (text == NULL)
            cursor->failed = true;
        else
            text[*n] = cz_line_text(cursor);
        if (!cursor->failed && *cursor->at != ']')
            cz_line_expect(cursor, ", ");
    }
    cz_line_expect(cursor, "]");
    return text;
}
