/* Allowed characters of texts and names. */
#include "base/text.h"

#include "crushzone/names.h"

#include <stdio.h>
#include <string.h>

size_t cz_text_character(const char *text, size_t n_byte) {
    const unsigned char *byte = (const unsigned char *)text, first = byte[0];
    const size_t n = first < 0x80 ? 1 : first < 0xc2 ? 0 : first < 0xe0 ? 2 : first < 0xf0 ? 3 : 4;
    if (n == 0 || n > n_byte || first > 0xf4)
        return 0;
    for (size_t i = 1; i < n; i++)
        if ((byte[i] & 0xc0) != 0x80)
            return 0;
    const bool is_overlong = (first == 0xe0 && byte[1] < 0xa0) || (first == 0xf0 && byte[1] < 0x90);
    const bool is_beyond = (first == 0xed && byte[1] >= 0xa0) || (first == 0xf4 && byte[1] >= 0x90);
    return is_overlong || is_beyond ? 0 : n;
}

/* Code point of a character of n bytes. */
static unsigned code_of(const char *text, size_t n) {
    const unsigned char *byte = (const unsigned char *)text;
    unsigned code = n == 1 ? byte[0] : byte[0] & (0xffU >> (n + 1));
    for (size_t i = 1; i < n; i++)
        code = code << 6 | (byte[i] & 0x3fU);
    return code;
}

typedef struct Range {
    unsigned first, last;
    const char *what;
} Range;

/* Characters that no text may contain, by code point. */
static const Range refused[] = {
    {0x0000, 0x001f, "the control character"},     {0x007f, 0x009f, "the control character"},
    {0x00ad, 0x00ad, "the invisible character"},   {0x034f, 0x034f, "the invisible character"},
    {0x061c, 0x061c, "the direction mark"},        {0x115f, 0x1160, "the invisible character"},
    {0x17b4, 0x17b5, "the invisible character"},   {0x180b, 0x180f, "the invisible character"},
    {0x200b, 0x200b, "the invisible character"},   {0x200e, 0x200f, "the direction mark"},
    {0x2028, 0x2029, "the line separator"},        {0x202a, 0x202e, "the direction mark"},
    {0x2060, 0x2065, "the invisible character"},   {0x2066, 0x2069, "the direction mark"},
    {0x206a, 0x206f, "the invisible character"},   {0x3164, 0x3164, "the invisible character"},
    {0xfdd0, 0xfdef, "the noncharacter"},          {0xfeff, 0xfeff, "the byte order mark"},
    {0xffa0, 0xffa0, "the invisible character"},   {0xfff0, 0xfffb, "the invisible character"},
    {0x1bca0, 0x1bca3, "the invisible character"}, {0x1d173, 0x1d17a, "the invisible character"},
    {0xe0000, 0xe00ff, "the invisible character"}, {0xe01f0, 0xe0fff, "the invisible character"},
};

/* Further characters that a name must not contain: symbols, and marks that combine with the letter
 * before. */
static const Range no_letter[] = {
    {0x0080, 0x00bf, "the sign"},
    {0x00d7, 0x00d7, "the sign"},
    {0x00f7, 0x00f7, "the sign"},
    {0x0300, 0x036f, "the combining mark"},
    {0x0483, 0x0489, "the combining mark"},
    {0x1680, 0x1680, "the blank"},
    {0x1ab0, 0x1aff, "the combining mark"},
    {0x1dc0, 0x1dff, "the combining mark"},
    {0x2000, 0x206f, "the sign"},
    {0x20d0, 0x20ff, "the combining mark"},
    {0x2e00, 0x2e7f, "the sign"},
    {0x3000, 0x3004, "the sign"},
    {0xe000, 0xf8ff, "the private-use character"},
    {0xfe00, 0xfe0f, "the variation selector"},
    {0xfe10, 0xfe6f, "the sign"},
    {0xff00, 0xff20, "the sign"},
    {0xe0100, 0xe01ef, "the variation selector"},
    {0xf0000, 0x10ffff, "the private-use character"},
};

static const char *find(int n_range, const Range *range, unsigned code) {
    for (int i = 0; i < n_range; i++)
        if (range[i].first <= code && code <= range[i].last)
            return range[i].what;
    return NULL;
}

static const char *refused_as(unsigned code) {
    if ((code & 0xfffe) == 0xfffe)
        return "the noncharacter";
    return find((int)(sizeof refused / sizeof *refused), refused, code);
}

static bool is_combining(unsigned code) {
    const char *what = find((int)(sizeof no_letter / sizeof *no_letter), no_letter, code);
    return what != NULL && strcmp(what, "the combining mark") == 0;
}

bool cz_text_fault(const char *text, size_t n_byte, bool is_file, size_t *at,
                   char what[CZ_FAULT_SIZE]) {
    for (*at = 0; *at < n_byte;) {
        const size_t n = cz_text_character(text + *at, n_byte - *at);
        if (n == 0) {
            snprintf(what, CZ_FAULT_SIZE, "byte 0x%02x, which is not valid UTF-8",
                     (unsigned)(unsigned char)text[*at]);
            return true;
        }
        const unsigned code = code_of(text + *at, n);
        const bool is_layout = code == '\n' || code == '\r' || code == '\t';
        const char *word = is_file && is_layout ? NULL : refused_as(code);
        if (word == NULL && !is_file && *at == 0 && is_combining(code))
            word = "the combining mark without its letter";
        if (word != NULL) {
            snprintf(what, CZ_FAULT_SIZE, "%s U+%04X", word, code);
            return true;
        }
        *at += n;
    }
    return false;
}

bool cz_name_fault(const char *name, const char *further, char what[CZ_FAULT_SIZE]) {
    static const char allowed[] =
        "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-+";
    const size_t n_byte = strlen(name);
    size_t at;
    char word[CZ_FAULT_SIZE - 8];
    if (n_byte > CZ_MAX_NAME) {
        snprintf(what, CZ_FAULT_SIZE, "is longer than %d bytes; a letter beyond ASCII has 2 to 4",
                 (int)CZ_MAX_NAME);
        return true;
    }
    if (cz_text_fault(name, n_byte, false, &at, what)) {
        memcpy(word, what, sizeof word - 1);
        word[sizeof word - 1] = '\0';
        snprintf(what, CZ_FAULT_SIZE, "holds %s", word);
        return true;
    }
    for (at = 0; at < n_byte; at += cz_text_character(name + at, n_byte - at)) {
        const unsigned code = code_of(name + at, cz_text_character(name + at, n_byte - at));
        const char *kind = find((int)(sizeof no_letter / sizeof *no_letter), no_letter, code);
        if (is_combining(code))
            snprintf(what, CZ_FAULT_SIZE,
                     "contains %s U+%04X: write the letter with its mark as one character", kind,
                     code);
        else if (code < 0x80 && strchr(allowed, (int)code) == NULL &&
                 strchr(further, (int)code) == NULL)
            snprintf(what, CZ_FAULT_SIZE, "contains '%c'; a name has letters, digits and _-+%s",
                     (int)code, further);
        else if (kind != NULL)
            snprintf(what, CZ_FAULT_SIZE,
                     "contains %s U+%04X; a name has letters, digits and _-+%s", kind, code,
                     further);
        else
            continue;
        return true;
    }
    return false;
}

size_t cz_text_one_line(char *text, size_t n_byte) {
    size_t n_kept = n_byte;
    while (n_kept > 0 && text[n_kept - 1] != '\0' && strchr("\t\r\n", text[n_kept - 1]) != NULL)
        text[--n_kept] = '\0';
    for (size_t i = 0; i < n_kept; i++)
        if (text[i] != '\0' && strchr("\t\r\n", text[i]) != NULL)
            text[i] = ' ';
    return n_kept;
}

void cz_text_copy(char *to, size_t size, const char *text) {
    size_t n = strlen(text);
    n = n < size ? n : size - 1;
    while (n > 0 && ((unsigned char)text[n] & 0xc0) == 0x80)
        n--;
    memcpy(to, text, n);
    to[n] = '\0';
}

void cz_text_repair(char *text) {
    const size_t n_byte = strlen(text);
    size_t n_kept = 0;
    for (size_t at = 0; at < n_byte;) {
        const size_t n = cz_text_character(text + at, n_byte - at);
        if (n == 0 || refused_as(code_of(text + at, n)) != NULL) {
            text[n_kept++] = '?';
            at += n > 0 ? n : 1;
        } else {
            memmove(text + n_kept, text + at, n);
            n_kept += n;
            at += n;
        }
    }
    text[n_kept] = '\0';
}

bool cz_text_is_among(const char *text, int n, const char *const *list) {
    for (int i = 0; i < n; i++)
        if (strcmp(list[i], text) == 0)
            return true;
    return false;
}

bool cz_text_is_word(const char *text, const char *words) {
    while (*words != '\0') {
        size_t n = 0;
        while (text[n] != '\0' && text[n] != ' ' && text[n] == words[n])
            n++;
        if (text[n] == '\0' && (words[n] == ' ' || words[n] == '\0'))
            return true;
        while (*words != '\0' && *words != ' ')
            words++;
        while (*words == ' ')
            words++;
    }
    return false;
}
