/* Texts of compared runs with the names that the first run has at the same place. */
#include "report/compared_names.h"

#include <stdio.h>
#include <string.h>

/* Whether a name ends before this character, or begins behind it. */
static bool is_border(char c) {
    return c == '\0' || strchr(".,-[] '\"", c) != NULL;
}

/* The longest paired name of a run at the beginning of a text; NULL for none. */
static const CzComparedName *find(const CzComparison *comparison, int run, const char *text) {
    const CzComparedName *found = NULL;
    for (int i = 0; i < comparison->n_name; i++) {
        const CzComparedName *name = &comparison->name[i];
        const size_t n = strlen(name->other);
        if (name->run == run && strncmp(text, name->other, n) == 0 && is_border(text[n]) &&
            (found == NULL || n > strlen(found->other)))
            found = name;
    }
    return found;
}

/* Writes a text with the names of the first run, as far as there is room; returns its length. */
static size_t put(const CzComparison *comparison, int run, const char *text, size_t room,
                  char *out) {
    size_t used = 0;
    for (size_t at = 0; text[at] != '\0';) {
        const bool begins = at == 0 || is_border(text[at - 1]);
        const CzComparedName *name = begins ? find(comparison, run, text + at) : NULL;
        const char *piece = name != NULL ? name->first : text + at;
        const size_t n = name != NULL ? strlen(name->first) : 1;
        if (used + n < room)
            memcpy(out + used, piece, n);
        used += n;
        at += name != NULL ? strlen(name->other) : 1;
    }
    if (used < room)
        out[used] = '\0';
    return used;
}

const char *cz_compared_names_in(const CzComparison *comparison, int run, const char *text,
                                 CzArena *arena) {
    if (comparison == NULL || comparison->n_name == 0 || run == 0)
        return text;
    const size_t n = put(comparison, run, text, 0, NULL) + 1;
    char *copy = cz_arena_allocate(arena, n, 1);
    if (copy != NULL)
        (void)put(comparison, run, text, n, copy);
    return copy;
}

bool cz_compared_names_match(const CzComparison *comparison, int run, const char *own,
                             const char *first) {
    char text[2 * CZ_NAME_SIZE];
    if (comparison == NULL || comparison->n_name == 0 || run == 0)
        return strcmp(own, first) == 0;
    return put(comparison, run, own, sizeof text, text) < sizeof text && strcmp(text, first) == 0;
}

bool cz_compared_names_sentence(const CzReport *report, int run, size_t room, char *text) {
    enum { MAX_NAMES = 12 };
    const CzComparison *comparison = report->comparison;
    int n = 0, used = 0;
    for (int i = 0; comparison != NULL && i < comparison->n_name; i++) {
        const CzComparedName *name = &comparison->name[i];
        if (name->run != run || used >= (int)room || n++ > MAX_NAMES)
            continue;
        if (n == 1)
            used += snprintf(text, room,
                             "Names of %s are paired by place: ", report->compared[run].label);
        if (used < (int)room)
            used += n <= MAX_NAMES ? snprintf(text + used, room - (size_t)used, "%s%s is %s",
                                              n > 1 ? ", " : "", name->other, name->first)
                                   : snprintf(text + used, room - (size_t)used, " and more");
    }
    return n > 0;
}
