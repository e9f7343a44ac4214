/* The cases of the benchmark, by file. */
#ifndef CZ_BENCH_CASES_H
#define CZ_BENCH_CASES_H

#include "bench/chain.h"
#include "bench/measure.h"
#include "crushzone/crushzone.h"

/* Programs beside this one that were there when the benchmark was built (n_peer). */
extern const ChainPeer *const chain_peers[];
extern const int chain_n_peer;

/* A model that is run: made once, freed by nobody, because the benchmark ends with it. */
typedef struct BenchRun {
    CzProblem *problem;
    CzModel *model;
    CzSimulateOptions options;
    int n_design; /* side by side */
} BenchRun;

/* Reads a file of the project with settings, NULL at the end or for none. */
CzProblem *bench_read(const char *file, const char *const *set);

/* The same, with the model of its first scenario. */
BenchRun *bench_problem(const char *file, const char *const *set);

/* The same problem for trains of n cars each. */
BenchRun *bench_chain(int n);
BenchRun *bench_train(int n, const char *track);

/* Runs all designs once; the processor time [s] of it. */
double bench_run(void *run);

void bench_add_chains(Bench *bench, bool is_short);
void bench_add_trains(Bench *bench, bool is_short);
void bench_add_batches(Bench *bench, bool is_short);
void bench_add_gradient(Bench *bench);
void bench_add_references(Bench *bench, bool is_short);
void bench_add_example(Bench *bench);
void bench_add_machine(Bench *bench);
void bench_add_program(Bench *bench, const char *program);
void bench_add_search(Bench *bench, const char *program);

#endif
