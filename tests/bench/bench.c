/* Times this program beside plain C and other simulation programs in one run.
 *
 *   bench PROGRAM [--rounds N] [--only PREFIX] [--json FILE] [--short | --long]
 *
 * from the project's root; PROGRAM is the built crushzone. Prints a table. --only takes the cases
 * whose key begins with PREFIX, --short the smallest cases once; --long adds a whole search of the
 * metro, once, which takes a minute or two.
 */
#include <stdlib.h>
#include <string.h>

#include "bench/cases.h"

enum { ROUNDS = 15 };

int main(int argc, char **argv) {
    static Bench bench;
    int n_round = ROUNDS;
    const char *only = NULL, *json = NULL;
    bool is_short = false, is_long = false;
    if (argc < 2)
        bench_stop("usage: bench PROGRAM [--rounds N] [--only PREFIX] [--json FILE] [--short]");
    for (int i = 2; i < argc; i++) {
        if (strcmp(argv[i], "--short") == 0)
            is_short = true;
        else if (strcmp(argv[i], "--long") == 0)
            is_long = true;
        else if (i + 1 == argc)
            bench_stop("an option without its value");
        else if (strcmp(argv[i], "--rounds") == 0)
            n_round = atoi(argv[++i]);
        else if (strcmp(argv[i], "--only") == 0)
            only = argv[++i];
        else if (strcmp(argv[i], "--json") == 0)
            json = argv[++i];
        else
            bench_stop("an unknown option");
    }
    bench_add_chains(&bench, is_short);
    bench_add_trains(&bench, is_short);
    bench_add_batches(&bench, is_short);
    bench_add_gradient(&bench);
    bench_add_references(&bench, is_short);
    bench_add_example(&bench);
    bench_add_program(&bench, argv[1]);
    bench_add_machine(&bench);
    if (is_long)
        bench_add_search(&bench, argv[1]);
    bench_measure(&bench, is_short || n_round < 1 ? 1 : n_round, only);
    bench_write_table(&bench, stdout);
    if (json == NULL)
        return 0;
    FILE *stream = fopen(json, "w");
    if (stream == NULL)
        bench_stop("the JSON file cannot be written");
    bench_write_json(&bench, stream);
    return fclose(stream) == 0 ? 0 : 1;
}
