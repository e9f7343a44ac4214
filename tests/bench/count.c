/* Fixed runs, of which count.sh counts the instructions and profile.sh finds where time goes.
 *
 *   bench_count two-cars|metro|modal|chain    runs of instructions.txt, from the project's root
 *   bench_count train TRACK MS REPEATS ISA    8+8 cars of train.yaml for a simulated time
 *   bench_count compiler                      prints the compiler, on which counts depend
 *
 * The copy of the kernel is that for x86-64-v3, which valgrind runs, or ISA. Exit code 3 where this
 * processor cannot run it.
 */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "bench/cases.h"
#include "dynamics/dynamics.h"

/* Two full cars, recorded; the metro to the end of a search's run; trains of 8 cars on the modal
 * track for a short time; the simple chain. */
static BenchRun *run_named(const char *name) {
    if (strcmp(name, "two-cars") == 0) {
        BenchRun *run = bench_problem("problems/two-cars-25kmh.yaml", NULL);
        run->options.record = true;
        return run;
    }
    if (strcmp(name, "metro") == 0) {
        BenchRun *run = bench_problem("problems/metro-6-car.yaml", NULL);
        run->options.brief = true;
        return run;
    }
    if (strcmp(name, "modal") == 0)
        return bench_problem(
            "tests/bench/train.yaml",
            (const char *const[]){"simulation.track=modal", "simulation.duration_ms=20", NULL});
    if (strcmp(name, "chain") == 0)
        return bench_chain(8);
    bench_stop("no such run");
}

static BenchRun *run_train(const char *track, const char *duration) {
    char on[48], during[48];
    snprintf(on, sizeof on, "simulation.track=%.20s", track);
    snprintf(during, sizeof during, "simulation.duration_ms=%.16s", duration);
    return bench_problem("tests/bench/train.yaml", (const char *const[]){on, during, NULL});
}

int main(int argc, char **argv) {
    const bool is_train = argc == 6 && strcmp(argv[1], "train") == 0;
    if (argc != 2 && !is_train)
        bench_stop("usage: bench_count two-cars|metro|modal|chain|compiler, or train TRACK MS "
                   "REPEATS ISA");
    if (strcmp(argv[1], "compiler") == 0) {
        puts(__VERSION__);
        return 0;
    }
    const char *isa = is_train ? argv[5] : "v3";
    if (cz_kernel(isa) == NULL)
        return 3;
    BenchRun *run = is_train ? run_train(argv[2], argv[3]) : run_named(argv[1]);
    run->options.isa = isa;
    for (int i = is_train ? atoi(argv[4]) : 1; i > 0; i--)
        bench_run(run);
    return 0;
}
