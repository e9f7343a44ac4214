/* The shipped problem files: those of the folder problems/, in the order of their names. */
#ifndef CZ_TESTS_SHIPPED_H
#define CZ_TESTS_SHIPPED_H

#include "support/check.h"

#include <dirent.h>

enum { MAX_SHIPPED = 100, SHIPPED_SIZE = 80, MIN_SHIPPED = 10 };

typedef struct {
    int n;
    char name[MAX_SHIPPED][SHIPPED_SIZE]; /* of the file, in problems/ */
} Shipped;

static inline int compare_names(const void *a, const void *b) {
    return strcmp(a, b);
}

static inline Shipped shipped_problems(void) {
    Shipped shipped = {0};
    DIR *folder = opendir(CZ_SOURCE_FOLDER "/problems");
    assert_non_null(folder);
    for (const struct dirent *entry; (entry = readdir(folder)) != NULL;) {
        const size_t n = strlen(entry->d_name);
        if (n < 5 || strcmp(&entry->d_name[n - 5], ".yaml") != 0)
            continue;
        assert_true(shipped.n < MAX_SHIPPED && n < SHIPPED_SIZE);
        memcpy(shipped.name[shipped.n++], entry->d_name, n + 1);
    }
    closedir(folder);
    assert_true(shipped.n >= MIN_SHIPPED);
    qsort(shipped.name, (size_t)shipped.n, SHIPPED_SIZE, compare_names);
    return shipped;
}

#endif
