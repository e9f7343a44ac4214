/* The simple chain: plain C, this program, other programs. */
#include "bench/cases.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "simulate/batch.h"

const ChainPeer *const chain_peers[] = {
#ifdef BENCH_HAS_MUJOCO
    &chain_mujoco,
#endif
#ifdef BENCH_HAS_SIMBODY
    &chain_simbody,
#endif
    NULL};
const int chain_n_peer = sizeof chain_peers / sizeof *chain_peers - 1;

enum { BATCH = 8 };
#define LARGEST_ERROR 0.01
static const double reference_step = 1e-7; /* a tenth of it changes the results by 1e-6 [s] */

/* One program at one length. */
typedef struct Chain {
    int n; /* cars */
    const ChainPeer *peer;
    void *model;
    BenchRun *run;
    ChainResult result;
} Chain;

static Chain *new_chain(int n, const ChainPeer *peer) {
    Chain *chain = calloc(1, sizeof *chain);
    if (chain == NULL)
        bench_stop("no memory");
    chain->n = n;
    chain->peer = peer;
    chain->model = peer != NULL ? peer->create(n) : NULL;
    if (peer != NULL && chain->model == NULL)
        bench_stop("a chain of another program cannot be made");
    return chain;
}

static double run_plain(void *data) {
    Chain *chain = data;
    const double start = cz_processor_clock();
    chain_run(chain->n, CHAIN_STEP, &chain->result);
    return cz_processor_clock() - start;
}

static double run_peer(void *data) {
    Chain *chain = data;
    const double start = cz_processor_clock();
    chain->peer->run(chain->model, &chain->result);
    return cz_processor_clock() - start;
}

/* Results of this program's chain, from a run of its own. */
static void fill_result(const BenchRun *run, ChainResult *result) {
    CzRun *made = NULL;
    CzError error = {0};
    memset(result, 0, sizeof *result);
    if (cz_simulate(run->model, &run->options, &made, &error) != CZ_OK)
        bench_stop(error.message);
    const CzRunSummary *summary = cz_run_summary(made);
    for (int i = 0; i < summary->n_interface; i++) {
        result->force[i] = summary->interface[i].peak_force;
        result->shortening[i] = summary->interface[i].shortening;
    }
    for (int i = 0; i < summary->n_vehicle; i++)
        result->speed[i] = summary->vehicle[i].final_speed;
    cz_run_free(made);
}

/* A program that computes something else is not compared. */
static void set_error(BenchCase *added, double error) {
    if (!(error < LARGEST_ERROR))
        bench_stop("a chain is not the one of the reference");
    added->error = error;
}

static void add_own(Bench *bench, int cars, const ChainResult *reference) {
    char key[48], what[96];
    for (int designs = 1; designs <= BATCH; designs *= BATCH) {
        BenchRun *run = bench_chain(cars);
        ChainResult result;
        run->n_design = designs;
        fill_result(run, &result);
        snprintf(key, sizeof key, "chain.crushzone%s.%d", designs > 1 ? "-batch" : "", cars);
        snprintf(what, sizeof what, "chain %d+%d, crushzone%s", cars, cars,
                 designs > 1 ? ", a design in a batch of 8" : "");
        BenchCase *added = bench_add(bench, key, what, bench_run, run);
        added->per = designs;
        set_error(added, chain_error(2 * cars, &result, reference));
    }
}

static void add_other(Bench *bench, int cars, const ChainPeer *peer, const ChainResult *reference) {
    char key[48], what[96];
    Chain *chain = new_chain(2 * cars, peer);
    double (*const run)(void *) = peer != NULL ? run_peer : run_plain;
    run(chain);
    snprintf(key, sizeof key, "chain.%s.%d", peer != NULL ? peer->name : "C", cars);
    snprintf(what, sizeof what, "chain %d+%d, %s, %s", cars, cars,
             peer != NULL ? peer->name : "plain C",
             peer != NULL ? peer->method : "semi-implicit Euler, 0.1 ms");
    set_error(bench_add(bench, key, what, run, chain),
              chain_error(2 * cars, &chain->result, reference));
}

void bench_add_chains(Bench *bench, bool is_short) {
    for (int cars = 2; cars <= (is_short ? 2 : 16); cars *= 2) {
        ChainResult reference;
        chain_run(2 * cars, reference_step, &reference);
        add_other(bench, cars, NULL, &reference);
        add_own(bench, cars, &reference);
        for (int i = 0; i < chain_n_peer; i++)
            add_other(bench, cars, chain_peers[i], &reference);
    }
}
