/* The best known designs of problems/bench-designs, from best-known.csv beside the problems. */
#ifndef BENCH_BEST_KNOWN_H
#define BENCH_BEST_KNOWN_H

#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "crushzone/crushzone.h"

enum { BEST_KNOWN_SIZE = 32 };

typedef struct BestKnown {
    char problem[64];          /* file without .yaml */
    double objective;          /* as minimised: of a margin its negative */
    bool is_feasible;          /* a design that passes is known */
    int n;                     /* variables */
    double x[BEST_KNOWN_SIZE]; /* in the variables' units (n) */
} BestKnown;

/* Name of a problem: its file without folder and ending; room for 64 bytes. */
static inline void best_known_name(const char *file, char *name) {
    const char *slash = strrchr(file, '/');
    snprintf(name, 64, "%.63s", slash != NULL ? slash + 1 : file);
    char *dot = strrchr(name, '.');
    if (dot != NULL)
        *dot = '\0';
}

static inline bool best_known_read(const char *line, const char *name, BestKnown *best) {
    const size_t n_name = strlen(name);
    char feasible[4], method[32];
    long seed, evaluations;
    int at = 0;
    if (strncmp(line, name, n_name) != 0 || line[n_name] != ',' ||
        sscanf(line + n_name, ",%lf,%3[a-z],%31[^,],%ld,%ld,%n", &best->objective, feasible, method,
               &seed, &evaluations, &at) != 5)
        return false;
    snprintf(best->problem, sizeof best->problem, "%.63s", name);
    best->is_feasible = strcmp(feasible, "yes") == 0;
    char *end = NULL;
    for (const char *next = line + n_name + at; best->n < BEST_KNOWN_SIZE; next = end) {
        const double value = strtod(next, &end);
        if (end == next)
            break;
        best->x[best->n++] = value;
    }
    return true;
}

/* The best known design of a problem; ends the program when there is none. */
static inline BestKnown best_known_of(const char *file) {
    char name[64], path[512], line[2048];
    const char *slash = strrchr(file, '/');
    best_known_name(file, name);
    snprintf(path, sizeof path, "%.*sbest-known.csv", slash != NULL ? (int)(slash + 1 - file) : 0,
             file);
    FILE *csv = fopen(path, "r");
    while (csv != NULL && fgets(line, sizeof line, csv) != NULL) {
        BestKnown best = {.n = 0};
        if (!best_known_read(line, name, &best))
            continue;
        fclose(csv);
        return best;
    }
    fprintf(stderr, "%s: no best known design of %s\n", path, name);
    exit(1);
}

#endif
