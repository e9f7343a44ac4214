/* Splits curve files into lines and fields. */
#include "text/curve_fields.h"

#include <stdint.h>
#include <stdio.h>
#include <string.h>

#include "text/curve_number.h"

/* ---- text ---- */

/* Writes a character of the basic plane as UTF-8; returns its bytes. */
static size_t write_character(char *text, unsigned character) {
    if (character < 0x80) {
        text[0] = (char)character;
        return 1;
    }
    if (character < 0x800) {
        text[0] = (char)(0xc0 | (character >> 6));
        text[1] = (char)(0x80 | (character & 0x3f));
        return 2;
    }
    text[0] = (char)(0xe0 | (character >> 12));
    text[1] = (char)(0x80 | ((character >> 6) & 0x3f));
    text[2] = (char)(0x80 | (character & 0x3f));
    return 3;
}

/* UTF-16 as UTF-8; surrogates become question marks, since numbers do not contain them. */
static size_t decode_wide(const unsigned char *wide, size_t n_byte, bool low_first, char *text) {
    size_t n = 0;
    for (size_t i = 0; i + 1 < n_byte; i += 2) {
        const unsigned low = wide[i + (low_first ? 0 : 1)], high = wide[i + (low_first ? 1 : 0)];
        const unsigned character = high << 8 | low;
        const bool is_half = character >= 0xd800 && character < 0xe000;
        n += write_character(text + n, is_half ? '?' : character);
    }
    return n;
}

/* Bytes of the older Western code page as UTF-8. */
static size_t decode_western(const unsigned char *bytes, size_t n_byte, char *text) {
    size_t n = 0;
    for (size_t i = 0; i < n_byte; i++)
        n += write_character(text + n, bytes[i] >= 0x80 && bytes[i] < 0xa0 ? '?' : bytes[i]);
    return n;
}

/* Converts the text to UTF-8 without a mark, in place or in new memory; NULL without memory. */
static char *decode(CzArena *arena, const char *text, size_t n_byte, size_t *n) {
    const unsigned char *bytes = (const unsigned char *)text;
    const bool low_first = n_byte >= 2 && bytes[0] == 0xff && bytes[1] == 0xfe;
    const bool high_first = n_byte >= 2 && bytes[0] == 0xfe && bytes[1] == 0xff;
    const size_t n_mark = cz_source_mark(text, n_byte);
    char *decoded = cz_arena_allocate(arena, 2 * n_byte + 1, 1);
    if (decoded == NULL)
        return NULL;
    if (low_first || high_first) {
        *n = decode_wide(bytes + 2, n_byte - 2, low_first, decoded);
    } else if (cz_source_is_utf8(text, n_byte)) {
        *n = n_byte - n_mark;
        memcpy(decoded, text + n_mark, *n);
    } else {
        *n = decode_western(bytes, n_byte, decoded);
    }
    while (*n > 0 && decoded[*n - 1] == 0x1a) /* the end of file of older systems */
        --*n;
    decoded[*n] = '\0';
    return decoded;
}

bool cz_curve_lines(CzArena *arena, CzMistakes *mistakes, const char *text, size_t n_byte,
                    CzSource *source) {
    size_t n = 0;
    char *decoded = decode(arena, text, n_byte, &n);
    return decoded != NULL && cz_source_is_text(mistakes, source, decoded, n) &&
           cz_source_cut(arena, source, decoded, n, false);
}

/* ---- fields ---- */

static bool is_blank(char c) {
    return c == ' ' || c == '\t';
}

static const char *skip_blanks(const char *at) {
    while (is_blank(*at))
        at++;
    return at;
}

CzFieldWalk cz_fields_begin(const char *line, char separator) {
    const char *at = separator == ' ' ? skip_blanks(line) : line;
    return (CzFieldWalk){.at = at, .separator = separator, .counted = line};
}

static bool is_bracket(char c) {
    return c == '[' || c == '(';
}

/* Whether a blank separates two fields. A blank before a bracket is between a title and its unit,
 * unless the field itself is a unit in brackets. */
static bool blank_parts(const char *start, const char *at) {
    const char *next = skip_blanks(at);
    return is_bracket(*start) || !is_bracket(*next);
}

/* The next separator outside quotes, or the end. */
static const char *find_end(const char *start, char separator) {
    const char *at = start;
    bool in_quotes = false;
    for (; *at != '\0'; at++) {
        in_quotes ^= *at == '"';
        if (in_quotes)
            continue;
        if (separator != ' ' && *at == separator)
            break;
        if (separator == ' ' && is_blank(*at)) {
            if (blank_parts(start, at))
                break;
            at = skip_blanks(at) - 1;
        }
    }
    return at;
}

bool cz_fields_next(CzFieldWalk *walk) {
    if (walk->at == NULL)
        return false;
    const char *start = walk->at, *end = find_end(start, walk->separator);
    const char *next = walk->separator == ' ' ? skip_blanks(end) : end + 1;
    const bool is_last = *end == '\0' || (walk->separator == ' ' && *next == '\0');
    walk->at = is_last ? NULL : next;
    while (start < end && (is_blank(*start) || *start == '"'))
        start++;
    while (end > start && (is_blank(end[-1]) || end[-1] == '"'))
        end--;
    for (; walk->counted < start; walk->counted++)
        walk->n_character += ((unsigned char)*walk->counted & 0xc0) != 0x80;
    walk->field = (CzField){start, (size_t)(end - start), walk->n_character + 1};
    walk->n++;
    return true;
}

bool cz_field_take(const char *line, char separator, int index, CzField *field) {
    CzFieldWalk walk = cz_fields_begin(line, separator);
    while (walk.n <= index && cz_fields_next(&walk))
        *field = walk.field;
    return walk.n > index;
}

CzFieldCount cz_fields_count(const char *line, char separator) {
    CzFieldWalk walk = cz_fields_begin(line, separator);
    CzFieldCount count = {0};
    while (cz_fields_next(&walk))
        count.filled = walk.field.n > 0 ? walk.n : count.filled;
    count.all = walk.n;
    return count;
}

bool cz_field_is_number(const CzField *field) {
    return cz_curve_number_sign(field->text, field->n) != CZ_SIGN_NO_NUMBER;
}

const char *cz_field_text(const CzField *field, char text[CZ_MAX_FIELD_TEXT]) {
    snprintf(text, CZ_MAX_FIELD_TEXT, "%.*s",
             (int)(field->n < CZ_MAX_FIELD_TEXT ? field->n : CZ_MAX_FIELD_TEXT - 1), field->text);
    return text;
}

/* ---- lines ---- */

bool cz_line_is_empty(const char *line) {
    return line[strspn(line, " \t;,\"")] == '\0';
}

const char *cz_line_comment(const char *line) {
    line = skip_blanks(line);
    if (line[0] == '#' || line[0] == '%')
        return line + 1;
    return line[0] == '/' && line[1] == '/' ? line + 2 : NULL;
}

char cz_line_announced_separator(const char *line) {
    line += *line == '"';
    const bool is_there = (line[0] == 's' || line[0] == 'S') &&
                          (line[1] == 'e' || line[1] == 'E') &&
                          (line[2] == 'p' || line[2] == 'P') && line[3] == '=';
    return is_there && line[4] != '\0' && strchr(";,\t ", line[4]) != NULL ? line[4] : '\0';
}

/* ---- the separator ---- */

enum { LOOKED_AT = 4000, MAX_FIELDS = 64 };

/* How well a separator splits the lines. */
typedef struct Score {
    int lines; /* with at least two numbers and the most frequent number of fields */
    int texts; /* fields that are not numbers in lines with two numbers */
} Score;

static Score score(const CzSource *source, char separator) {
    int with[MAX_FIELDS + 1] = {0};
    Score found = {0};
    const int n_line = source->n_line < LOOKED_AT ? source->n_line : LOOKED_AT;
    for (int i = 0; i < n_line; i++) {
        if (cz_line_is_empty(source->line[i]) || cz_line_comment(source->line[i]) != NULL)
            continue;
        CzFieldWalk walk = cz_fields_begin(source->line[i], separator);
        int n_text = 0;
        while (walk.n < MAX_FIELDS && cz_fields_next(&walk))
            n_text += walk.field.n > 0 && !cz_field_is_number(&walk.field);
        if (walk.n - n_text < 2)
            continue;
        with[walk.n]++;
        found.texts += n_text;
    }
    for (int n = 2; n <= MAX_FIELDS; n++)
        found.lines = with[n] > found.lines ? with[n] : found.lines;
    return found;
}

char cz_fields_separator(const CzSource *source) {
    static const char separators[] = ";\t, ";
    char best = ',';
    Score most = {0};
    for (const char *separator = separators; *separator != '\0'; separator++) {
        const Score found = score(source, *separator);
        /* Blanks separate the same fields as tabs, and also the words of a preamble. */
        const int least = *separator == ' ' && best == '\t' ? 2 * most.lines : most.lines;
        if (found.lines > least || (found.lines == most.lines && found.texts < most.texts)) {
            most = found;
            best = *separator;
        }
    }
    return best;
}
