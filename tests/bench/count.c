/* One fixed run, of which count.sh counts the instructions.
 *
 *   bench_count two-cars|metro|modal     from the project's root
 *   bench_count compiler                 prints the compiler, on which the counts depend
 *
 * The copy of the kernel is that for x86-64-v3, which valgrind runs. Exit code 3 where this
 * processor cannot run it.
 */
#include <stdio.h>
#include <string.h>

#include "bench/cases.h"
#include "dynamics/dynamics.h"

static const char isa[] = "v3";

/* Two full cars, recorded; the metro to the end of a search's run; trains of 8 cars on the modal
 * track for a short time. */
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
    bench_stop("no such run");
}

int main(int argc, char **argv) {
    if (argc != 2)
        bench_stop("usage: bench_count two-cars|metro|modal|compiler");
    if (strcmp(argv[1], "compiler") == 0) {
        puts(__VERSION__);
        return 0;
    }
    if (cz_kernel(isa) == NULL)
        return 3;
    BenchRun *run = run_named(argv[1]);
    run->options.isa = isa;
    bench_run(run);
    return 0;
}
