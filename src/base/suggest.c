/* Did-you-mean by edit distance: insert, delete, replace and swap of neighbours, two each; a change
 * of case costs one. */
#include "base/suggest.h"

#include <stdio.h>
#include <string.h>

enum { LONGEST = CZ_LONGEST_SUGGESTED, EDIT = 2, CASE = 1 };

static int lower(char c) {
    return c >= 'A' && c <= 'Z' ? c - 'A' + 'a' : (unsigned char)c;
}

static int smaller(int a, int b) {
    return a < b ? a : b;
}

static int replace_cost(char a, char b) {
    if (a == b)
        return 0;
    return lower(a) == lower(b) ? CASE : EDIT;
}

/* Edit distance of two words of at most LONGEST letters; three rows of the table are kept. */
static int edit_distance(const char *a, int n_a, const char *b, int n_b) {
    int row[3][LONGEST + 1];
    for (int j = 0; j <= n_b; j++)
        row[0][j] = EDIT * j;
    for (int i = 1; i <= n_a; i++) {
        int *now = row[i % 3], *above = row[(i + 2) % 3], *two_above = row[(i + 1) % 3];
        now[0] = EDIT * i;
        for (int j = 1; j <= n_b; j++) {
            const int replaced = above[j - 1] + replace_cost(a[i - 1], b[j - 1]);
            now[j] = smaller(replaced, smaller(above[j], now[j - 1]) + EDIT);
            if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1])
                now[j] = smaller(now[j], two_above[j - 2] + EDIT);
        }
    }
    return row[n_a % 3][n_b];
}

bool cz_suggest(CzSuggestion *suggestion, const char *typed, const char *known) {
    const size_t n_typed = strlen(typed), n_known = strlen(known);
    if (n_typed == 0 || n_known == 0 || n_typed > LONGEST || n_known > LONGEST)
        return false;
    int allowed = EDIT * (int)(n_known < 4 ? 1 : (n_known + 2) / 3);
    allowed = smaller(allowed, EDIT * (int)n_known - 1);
    if (suggestion->best[0] != '\0')
        allowed = smaller(allowed, suggestion->distance - 1);
    const int n_more =
        (int)n_typed - (int)n_known; /* smallest number of letters to insert or delete */
    if (EDIT * (n_more < 0 ? -n_more : n_more) > allowed)
        return false;
    const int distance = edit_distance(typed, (int)n_typed, known, (int)n_known);
    if (distance > allowed)
        return false;
    memcpy(suggestion->best, known, n_known + 1);
    suggestion->distance = distance;
    return true;
}

int cz_find_name(const char *name, const void *items, int n, size_t size, size_t offset,
                 CzSuggestion *nearest) {
    for (int pass = 0; pass < 2; pass++)
        for (int i = 0; i < n; i++) {
            const char *known;
            memcpy(&known, (const char *)items + (size_t)i * size + offset, sizeof known);
            if (known != NULL && pass == 0 && strcmp(known, name) == 0)
                return i;
            if (known != NULL && pass == 1)
                cz_suggest(nearest, name, known);
        }
    return -1;
}

void cz_suggest_help(const CzSuggestion *suggestion, CzError *error) {
    if (error != NULL && suggestion->best[0] != '\0')
        snprintf(error->help, sizeof error->help, "did you mean '%s'?", suggestion->best);
}
