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

typedef struct Wish {
    int n_round;
    const char *only, *json;
    bool is_short, is_long;
} Wish;

static Wish read_wish(int argc, char **argv) {
    Wish wish = {.n_round = ROUNDS};
    if (argc < 2)
        bench_stop("the path of crushzone is missing");
    for (int i = 2; i < argc; i++) {
        if (strcmp(argv[i], "--short") == 0)
            wish.is_short = true;
        else if (strcmp(argv[i], "--long") == 0)
            wish.is_long = true;
        else if (i + 1 == argc)
            bench_stop("an option is not known, or lacks its value");
        else if (strcmp(argv[i], "--rounds") == 0)
            wish.n_round = atoi(argv[++i]);
        else if (strcmp(argv[i], "--only") == 0)
            wish.only = argv[++i];
        else if (strcmp(argv[i], "--json") == 0)
            wish.json = argv[++i];
        else
            bench_stop("an option is not known, or lacks its value");
    }
    if (wish.is_short || wish.n_round < 1)
        wish.n_round = 1;
    return wish;
}

int main(int argc, char **argv) {
    static Bench bench;
    const Wish wish = read_wish(argc, argv);
    bench_add_chains(&bench, wish.is_short);
    bench_add_trains(&bench, wish.is_short);
    bench_add_batches(&bench, wish.is_short);
    bench_add_gradient(&bench);
    bench_add_references(&bench, wish.is_short);
    bench_add_example(&bench);
    bench_add_program(&bench, argv[1]);
    bench_add_machine(&bench);
    if (wish.is_long)
        bench_add_search(&bench, argv[1]);
    bench_measure(&bench, wish.n_round, wish.only);
    bench_write_table(&bench, stdout);
    if (wish.json == NULL)
        return 0;
    FILE *stream = fopen(wish.json, "w");
    if (stream == NULL)
        bench_stop("the JSON file cannot be written");
    bench_write_json(&bench, stream);
    return fclose(stream) == 0 ? 0 : 1;
}
