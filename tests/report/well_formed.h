/* Whether a text is well-formed: tags balance, attributes are quoted, special characters are
 * escaped. */
#ifndef CZ_TESTS_WELL_FORMED_H
#define CZ_TESTS_WELL_FORMED_H

#include <ctype.h>
#include <stdbool.h>
#include <string.h>

static inline bool is_entity(const char *c) {
    static const char *const entities[] = {"&amp;", "&lt;", "&gt;", "&quot;"};
    for (int i = 0; i < 4; i++)
        if (strncmp(c, entities[i], strlen(entities[i])) == 0)
            return true;
    return false;
}

/* Reads a tag from its '<'; returns the place behind it, NULL for an invalid tag. */
static inline const char *read_tag(const char *c, char name[32], bool *closes, bool *is_empty) {
    *closes = c[1] == '/';
    c += *closes ? 2 : 1;
    size_t n = 0;
    while (isalnum((unsigned char)*c) && n < 31)
        name[n++] = *c++;
    name[n] = '\0';
    while (n > 0 && *c == ' ') {
        c += strcspn(c, "=<>\"");
        if (c[0] != '=' || c[1] != '"')
            return NULL;
        for (c += 2; *c != '"'; c++)
            if (*c == '\0' || *c == '<' || (*c == '&' && !is_entity(c)))
                return NULL;
        c++;
    }
    *is_empty = *c == '/';
    c += *is_empty ? 1 : 0;
    return n > 0 && *c == '>' ? c + 1 : NULL;
}

static inline bool is_well_formed(const char *c) {
    char open[64][32];
    int depth = 0;
    while (*c != '\0') {
        char name[32];
        bool closes, is_empty;
        if (*c == '&' && !is_entity(c))
            return false;
        if (*c != '<') {
            c++;
            continue;
        }
        c = read_tag(c, name, &closes, &is_empty);
        if (c == NULL || depth == 64)
            return false;
        if (closes && (depth == 0 || strcmp(open[--depth], name) != 0))
            return false;
        if (!closes && !is_empty)
            strcpy(open[depth++], name);
    }
    return depth == 0;
}

/* How often a part is in a text. */
static inline int count_of(const char *text, const char *part) {
    int n = 0;
    for (text = strstr(text, part); text != NULL; text = strstr(text + 1, part))
        n++;
    return n;
}

#endif
