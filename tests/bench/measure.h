/* Cases that are timed in turn, numbers made of their times, and both as a table and as JSON. */
#ifndef CZ_BENCH_MEASURE_H
#define CZ_BENCH_MEASURE_H

#include <stdbool.h>
#include <stdio.h>

#include "base/clock.h"

enum { BENCH_MAX_CASES = 96, BENCH_MAX_ROUNDS = 100 };

/* One thing that is timed. `run` does it once and returns the time that it took [s]. */
typedef struct BenchCase {
    char key[48];  /* such as "train.modal.8" */
    char what[96]; /* in words */
    double (*run)(void *data);
    void *data;
    bool is_wall; /* `run` measures time on the wall; else processor time of one core */
    double per;   /* times are divided by this number of designs or runs */
    int most;     /* rounds that it takes part in; all by default */
    double error; /* difference from a reference; NaN where there is none */
    int n;
    double time[BENCH_MAX_ROUNDS]; /* [s] */
    double least, median;          /* [s] */
} BenchCase;

/* A number made of times (figures.def). */
typedef struct BenchFigure {
    double value, median; /* by the least times and by their medians; NaN without the cases */
} BenchFigure;

enum {
    BENCH_N_FIGURE = 0
#define BENCH_FIGURE(...) +1
#include "bench/figures.def"
#undef BENCH_FIGURE
};

typedef struct Bench {
    int n_case, n_round;
    BenchCase cases[BENCH_MAX_CASES];
    BenchFigure figure[BENCH_N_FIGURE];
} Bench;

/* Ends the program. */
_Noreturn void bench_stop(const char *message);

/* Adds a case; the caller may change what it has by default. */
BenchCase *bench_add(Bench *bench, const char *key, const char *what, double (*run)(void *data),
                     void *data);

/* Times every case once in each round, then fills medians and figures. */
void bench_measure(Bench *bench, int n_round, const char *only);

void bench_write_json(const Bench *bench, FILE *stream);
void bench_write_table(const Bench *bench, FILE *stream);

#endif
