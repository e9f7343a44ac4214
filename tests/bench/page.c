/* Prints the generated part of docs/performance.md.
 *
 *   bench_page MEASURED.json PROFILE.json SEARCHES.csv   what bench --json, profile.sh and
 *                                                        bench_searches --table have written
 */
#include <math.h>
#include <stdarg.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <jansson.h>

static const json_t *measured, *profile;

/* ---- reading ---- */

static const json_t *read_json(const char *file) {
    json_error_t error;
    const json_t *json = json_load_file(file, 0, &error);
    if (json == NULL) {
        fprintf(stderr, "bench_page: %s:%d: %s\n", file, error.line, error.text);
        exit(1);
    }
    return json;
}

/* The entry of a list with a key; NULL without it. */
static const json_t *entry(const char *list, const char *key) {
    size_t i;
    json_t *item;
    json_array_foreach(json_object_get(measured, list), i, item) {
        if (strcmp(json_string_value(json_object_get(item, "key")), key) == 0)
            return item;
    }
    return NULL;
}

static const char *text_of(const json_t *json, const char *key) {
    const char *text = json_string_value(json_object_get(json, key));
    return text != NULL ? text : "";
}

static double number_of(const json_t *json, const char *key) {
    const json_t *value = json_object_get(json, key);
    return json_is_number(value) ? json_number_value(value) : NAN;
}

/* Smallest time of a case [ms]; NaN where it was not measured. */
static double time_of(const char *key) {
    return number_of(entry("cases", key), "min_ms");
}

__attribute__((format(printf, 1, 2))) static double time_at(const char *format, ...) {
    char key[64];
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(key, sizeof key, format, arguments);
    va_end(arguments);
    return time_of(key);
}

static double figure(const char *key) {
    return number_of(entry("figures", key), "value");
}

/* ---- writing ---- */

/* Three digits, "-" where there is no number. */
static const char *digits(double value, char text[32]) {
    const int size = value > 0.0 ? (int)floor(log10(value)) : 0;
    if (isnan(value))
        snprintf(text, 32, "-");
    else
        snprintf(text, 32, "%.*f", size < 2 ? 2 - size < 4 ? 2 - size : 4 : 0, value);
    return text;
}

static void put_cell(double value) {
    char text[32];
    printf(" %s |", digits(value, text));
}

static void put_head(void) {
    printf("# Performance\n\n"
           "`scripts/write-performance` measures and writes this page, except its last section.\n\n"
           "Measured on one machine: %s, %lld processors, by %lld rounds of `tests/bench/run` with "
           "crushzone %s, compiled by %s, on its kernel for x86-64-%s.\n"
           "In each round every case runs once, so that other work on the machine affects all "
           "alike.\n"
           "Times are the smallest of all rounds: processor time of one core, or time on the wall "
           "where it says so; the latter, and with them the comparison of two threads, mean little "
           "on a "
           "machine that does other work.\n"
           "Times of another machine differ; ratios differ less. `crushzone bench FILE` times your "
           "own problem.\n",
           text_of(measured, "processor"),
           json_integer_value(json_object_get(measured, "processors")),
           json_integer_value(json_object_get(measured, "rounds")), text_of(measured, "version"),
           text_of(measured, "compiler"), text_of(measured, "isa"));
}

/* Figures with a limit first, then the others. */
static void put_figures(void) {
    char value[32], median[32];
    size_t i;
    json_t *item;
    puts("\n## Aims\n\n"
         "| ratio, exponent or time | aim | measured | by medians | |\n|---|---|---|---|---|");
    json_array_foreach(json_object_get(measured, "figures"), i, item) {
        const double limit = number_of(item, "limit"), found = number_of(item, "value");
        const bool is_minimum = strcmp(text_of(item, "asked"), "at least") == 0;
        if (isnan(limit))
            continue;
        printf("| %s | %s %.3g | %s | %s | %s |\n", text_of(item, "what"), text_of(item, "asked"),
               limit, digits(found, value), digits(number_of(item, "median"), median),
               isnan(found)                                     ? "not measured yet"
               : (is_minimum ? found >= limit : found <= limit) ? "met"
                                                                : "not met");
    }
}

static void put_chains(void) {
    static const char *const programs[] = {"C", "crushzone", "crushzone-batch", "MuJoCo",
                                           "Simbody"};
    puts("\n## The simple chain\n\n"
         "N rigid cars of 50 t run at 36 km/h into N standing ones; each of the 2N-1 couplers "
         "crushes along a curve of six lines and unloads with 100 MN/m; 0.5 s are simulated "
         "(`tests/bench/chain.yaml`).\n"
         "All programs compute the same law of the coupler; the others call the C function of "
         "`tests/bench/chain.c`.\n"
         "The error is the largest difference of a force, a shortening or a final speed from a "
         "reference with a step of 0.1 microseconds, over the largest force or shortening, or the "
         "impact speed.\n\n"
         "| milliseconds (error) | N = 2 | 4 | 8 | 16 |\n|---|---|---|---|---|");
    for (size_t i = 0; i < sizeof programs / sizeof *programs; i++) {
        char key[64], text[32];
        snprintf(key, sizeof key, "chain.%s.8", programs[i]);
        const json_t *first = entry("cases", key);
        if (first == NULL)
            continue;
        printf("| %s |", strchr(text_of(first, "what"), ',') + 2);
        for (int n = 2; n <= 16; n *= 2) {
            snprintf(key, sizeof key, "chain.%s.%d", programs[i], n);
            const json_t *one = entry("cases", key);
            printf(" %s (%.3f %%) |", digits(number_of(one, "min_ms"), text),
                   100.0 * number_of(one, "error"));
        }
        putchar('\n');
    }
    printf("\nMuJoCo %s, Simbody %s.\n", text_of(measured, "MuJoCo"), text_of(measured, "Simbody"));
}

static const char *const tracks[] = {"rigid", "receptance", "modal"};
enum { N_TRACK = sizeof tracks / sizeof *tracks };

static void put_trains(void) {
    puts("\n## Full vehicles\n\n"
         "The same collision with full vehicles of the generic catalogue "
         "(`tests/bench/train.yaml`), 0.5 s simulated, on each track. "
         "The kernel computes eight cars at a time, so that two cars cost nearly as much as eight; "
         "the growth from 8 to 32 cars shows no more than proportion where its exponent is at most "
         "1.\n\n"
         "| milliseconds | 1+1 | 2+2 | 4+4 | 8+8 | 16+16 | exponent from 2 to 32 cars | from 8 to "
         "32 "
         "|\n|---|---|---|---|---|---|---|---|");
    for (int track = 0; track < N_TRACK; track++) {
        char key[64];
        printf("| track `%s` |", tracks[track]);
        for (int n = 1; n <= 16; n *= 2)
            put_cell(time_at("train.%s.%d", tracks[track], n));
        snprintf(key, sizeof key, "growth-%s", tracks[track]);
        put_cell(figure(key));
        snprintf(key, sizeof key, "long-growth-%s", tracks[track]);
        put_cell(figure(key));
        putchar('\n');
    }
}

static void put_batches(void) {
    puts("\n## Batches, threads and gradients\n\n"
         "Designs side by side in one batch, as in a search, on the track `receptance`.\n\n"
         "| milliseconds a design | alone | of 2 | of 4 | of 8 |\n|---|---|---|---|---|");
    for (int n = 1; n <= 8; n *= 8) {
        printf("| %d+%d cars |", n, n);
        for (int designs = 1; designs <= 8; designs *= 2)
            put_cell(time_at("batch.%d.%d", n, designs));
        putchar('\n');
    }
    char one[32], two[32], all[32], ratio[32], gradient[32], single[32];
    printf(
        "\nScenarios side by side, each as in a search and on one thread: %s ms a run for two cars "
        "in 64 scenarios, %s ms for one of them alone; %s ms for one design of the metro in its "
        "seven scenarios, %s ms for twelve.\n",
        digits(time_of("scenarios.pair.64"), all), digits(time_of("scenarios.pair.1"), one),
        digits(time_of("scenarios.metro.1"), single), digits(time_of("scenarios.metro.12"), two));
    printf("\n24 designs of 8+8 cars on the wall: %s ms a design on one thread, %s ms on two. "
           "10,000 designs in three scenarios of 8+8 cars would take %s s on two threads.\n\n"
           "Two cars with twelve variables: the value and twelve differences together take %s ms, "
           "one evaluation %s ms, so that the gradient costs %s of 13 single evaluations.\n",
           digits(time_of("threads.1"), one), digits(time_of("threads.2"), two),
           digits(figure("designs"), all), digits(time_of("gradient.13"), gradient),
           digits(time_of("gradient.1"), single), digits(figure("gradient"), ratio));
}

static void put_solvers(void) {
    puts("\n## Second solvers\n\n"
         "The adaptive solvers of SUNDIALS, which `crushzone verify` compares with, on rigid "
         "rails.\n\n"
         "| milliseconds | production run | Runge-Kutta | Adams |\n|---|---|---|---|");
    for (int n = 1; n <= 8; n *= 8) {
        printf("| %d+%d cars |", n, n);
        put_cell(time_at("solver.zhai.%d", n));
        put_cell(time_at("solver.erk.%d", n));
        put_cell(time_at("solver.adams.%d", n));
        putchar('\n');
    }
}

static void put_program(void) {
    static const struct {
        const char *key, *what;
    } rows[] = {{"example.run",
                 "published example (`paper-25kmh.yaml`), 0.2 s on the modal track: steps, "
                 "on the wall"},
                {"example.setup", "its reading and set-up, on the wall"},
                {"program.start", "start of the program: `crushzone version`, on the wall"},
                {"program.read", "reading `metro-6-car.yaml` with its catalogue and profile"},
                {"program.build", "set-up of one scenario of the metro"},
                {"program.run", "`two-cars-25kmh.yaml`, not recorded"},
                {"program.record", "the same, recorded"},
                {"program.page", "its report as one page"},
                {"program.folder", "its whole result folder"},
                {"long.search", "`crushzone optimise problems/metro-6-car.yaml`, on the wall"}};
    puts("\n## Around a run\n\n| | milliseconds |\n|---|---|");
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        printf("| %s |", rows[i].what);
        put_cell(time_of(rows[i].key));
        putchar('\n');
    }
}

/* ---- profile ---- */

static const json_t *run_of(int track) {
    return json_object_get(json_object_get(profile, "runs"), tracks[track]);
}

static double share_of(int track, const char *part) {
    const double share = number_of(json_object_get(run_of(track), "shares"), part);
    return isnan(share) ? 0.0 : share;
}

/* Parts of the model in the order of their largest share. */
static int by_share(const void *a, const void *b) {
    double largest[2] = {0.0, 0.0};
    for (int track = 0; track < N_TRACK; track++) {
        largest[0] = fmax(largest[0], share_of(track, *(const char *const *)a));
        largest[1] = fmax(largest[1], share_of(track, *(const char *const *)b));
    }
    return (largest[0] < largest[1]) - (largest[0] > largest[1]);
}

static void put_shares(void) {
    const char *part[64], *key;
    json_t *share, *shares = json_object_get(run_of(N_TRACK - 1), "shares");
    int n = 0;
    json_object_foreach(shares, key, share) {
        if (n < 64)
            part[n++] = key;
    }
    qsort(part, (size_t)n, sizeof *part, by_share);
    printf("\n## Where the time goes\n\n"
           "Shares of the %s of 8+8 full vehicles, by the source of each %s.\n\n"
           "| part | `rigid` | `receptance` | `modal` |\n|---|---|---|---|\n",
           strcmp(text_of(profile, "method"), "perf") == 0 ? "processor time"
                                                           : "executed instructions",
           strcmp(text_of(profile, "method"), "perf") == 0 ? "sample of `perf`"
                                                           : "instruction, counted by callgrind");
    for (int i = 0; i < n; i++) {
        printf("| %s |", part[i]);
        for (int track = 0; track < N_TRACK; track++)
            printf(" %.0f %% |", 100.0 * share_of(track, part[i]));
        putchar('\n');
    }
}

static void put_rates(void) {
    static const char *const counts[] = {"instructions", "operations", "bytes"};
    static const char *const words[] = {"instructions a step", "floating-point operations a step",
                                        "bytes read or written a step"};
    const double cars = number_of(profile, "cars"), steps = number_of(profile, "steps");
    puts("\n## Distance from the limits of the machine\n\n"
         "Counted by callgrind over a run of 8+8 cars on the kernel for x86-64-v3: each executed "
         "instruction times its additions, multiplications, divisions, square roots, minima and "
         "maxima in all lanes, and the width of its operand in memory "
         "(`tests/bench/operations.awk`). Divided by the measured time of a step.\n\n"
         "| 8+8 cars | `rigid` | `receptance` | `modal` | limit of one core |\n"
         "|---|---|---|---|---|");
    for (int i = 0; i < 3; i++) {
        printf("| %s |", words[i]);
        for (int track = 0; track < N_TRACK; track++)
            printf(" %.0f |", number_of(run_of(track), counts[i]) / steps);
        puts(" |");
    }
    printf("| operations a step and car |");
    for (int track = 0; track < N_TRACK; track++)
        printf(" %.0f |", number_of(run_of(track), "operations") / steps / cars);
    puts(" |");
    static const char *const rates[] = {"10^9 operations a second", "GB a second"};
    static const char *const limits[] = {"machine.arithmetic", "machine.reading"};
    for (int i = 0; i < 2; i++) {
        const double limit = 1e3 / time_of(limits[i]);
        printf("| %s |", rates[i]);
        for (int track = 0; track < N_TRACK; track++) {
            const double rate = 1e-6 * number_of(run_of(track), counts[i + 1]) /
                                time_at("train.%s.8", tracks[track]);
            printf(" %.0f (%.0f %%) |", rate, 100.0 * rate / limit);
        }
        printf(" %.0f |\n", limit);
    }
    puts(
        "\nOperations on vectors read their operands from memory again and again, because a step "
        "has "
        "many more quantities than a core has registers: reading from the first cache is nearer to "
        "its limit than arithmetic. Lanes without a car, and branches that a lane does not take, "
        "are counted too.\n\n"
        "The limits are measured by loops of nothing else: independent products and sums in "
        "vectors as wide as the kernel's, and reading of 8 kB, which stay in the first cache "
        "(`tests/bench/cases_machine.c`). No operation joins a product and a sum, because results "
        "are the same on every processor.");
}

/* ---- searches ---- */

enum { N_COUNT = 4, MAX_GROUP = 200 };

/* A problem searched by one method; NaN for an empty field. */
typedef struct Searched {
    char problem[64], method[32];
    double passed[N_COUNT], distance[N_COUNT], reached;
} Searched;

static double next_field(char **rest) {
    char *end, *field = *rest;
    const double value = strtod(field, &end);
    *rest = field + strcspn(field, ",\n");
    *rest += **rest != '\0';
    return end == field ? NAN : value;
}

static int read_searches(const char *file, Searched *searched) {
    char line[512];
    int n = 0;
    FILE *csv = fopen(file, "r");
    if (csv == NULL || fgets(line, sizeof line, csv) == NULL) {
        fprintf(stderr, "bench_page: cannot read %s\n", file);
        exit(1);
    }
    while (n < MAX_GROUP && fgets(line, sizeof line, csv) != NULL) {
        Searched *it = &searched[n++];
        char *rest = line;
        sscanf(line, "%63[^,],%31[^,]", it->problem, it->method);
        for (int skipped = 0; skipped < 3; skipped++)
            rest = strchr(rest, ',') + 1;
        for (int k = 0; k < N_COUNT; k++)
            it->passed[k] = next_field(&rest);
        for (int k = 0; k < N_COUNT; k++)
            it->distance[k] = next_field(&rest);
        it->reached = next_field(&rest);
    }
    fclose(csv);
    return n;
}

static bool is_usual(const Searched *it) {
    return strcmp(it->method, "auto") == 0;
}

/* The single algorithm that comes nearest to the best known design of a problem: the first within
 * 1 %, else the nearest after all evaluations. */
static const Searched *best_single(int n, const Searched *searched, const char *problem) {
    const Searched *best = NULL;
    for (int i = 0; i < n; i++) {
        const Searched *it = &searched[i];
        if (is_usual(it) || strcmp(it->problem, problem) != 0)
            continue;
        const double a = isnan(it->reached) ? INFINITY : it->reached;
        const double b = best == NULL || isnan(best->reached) ? INFINITY : best->reached;
        const double near = isnan(it->distance[N_COUNT - 1]) ? INFINITY : it->distance[N_COUNT - 1];
        const double nearest = best == NULL || isnan(best->distance[N_COUNT - 1])
                                   ? INFINITY
                                   : best->distance[N_COUNT - 1];
        if (best == NULL || a < b || (a == b && near < nearest))
            best = it;
    }
    return best;
}

static void put_percent(double share) {
    if (isnan(share))
        printf(" - |");
    else
        printf(" %.1f %% |", fabs(100 * share));
}

static void put_methods(int n, const Searched *searched) {
    puts("| method | passes after 50 | 100 | 200 | 400 | problems within 1 % after 400 |\n"
         "|---|---|---|---|---|---|");
    for (int first = 0; first < n; first++) {
        if (first > 0 && strcmp(searched[first].method, searched[first - 1].method) == 0)
            continue;
        double passed[N_COUNT] = {0};
        int n_problem = 0, n_near = 0;
        for (int i = 0; i < n; i++) {
            if (strcmp(searched[i].method, searched[first].method) != 0)
                continue;
            n_near += searched[i].distance[N_COUNT - 1] <= 0.01; /* false for NaN */
            if (strcmp(searched[i].problem, "impossible-stop") == 0)
                continue;
            n_problem++;
            for (int k = 0; k < N_COUNT; k++)
                passed[k] += searched[i].passed[k];
        }
        printf("| `%s` |", searched[first].method);
        for (int k = 0; k < N_COUNT; k++)
            printf(" %.0f %% |", 100 * passed[k] / n_problem);
        printf(" %d of %d |\n", n_near, n_problem + 1);
    }
}

static void put_problems(int n, const Searched *searched) {
    puts("\n| problem | evaluations to 1 %: `auto` | single | ratio | distance after 100: `auto` | "
         "single | after 400: `auto` | single | best single algorithm |\n"
         "|---|---|---|---|---|---|---|---|---|");
    for (int i = 0; i < n && is_usual(&searched[i]); i++) {
        const Searched *it = &searched[i], *single = best_single(n, searched, it->problem);
        printf("| `%s` |", it->problem);
        put_cell(it->reached);
        put_cell(single->reached);
        put_cell(it->reached / single->reached);
        for (int k = 1; k < N_COUNT; k += 2) {
            put_percent(it->distance[k]);
            put_percent(single->distance[k]);
        }
        printf(" `%s` |\n", single->method);
    }
}

static void put_searches(const char *file) {
    Searched searched[MAX_GROUP];
    const int n = read_searches(file, searched);
    puts("\n## Searches\n\n"
         "The usual search (`algorithm: auto`) and single algorithms of NLopt on the ten problems "
         "of `problems/bench-designs`, each with 400 evaluations and ten seeds; algorithms without "
         "random numbers ran once.\n"
         "Single algorithms begin at the file's own design, begin again at their best one, and are "
         "moved to the catalogue increments at the end, as `optimise` does with them.\n"
         "The distance is that of the best design so far from the best known one "
         "(`best-known.csv`), a share of the objective, of a margin its difference; medians over "
         "the seeds. Where variables have increments, only designs on them count. No design of "
         "`impossible-stop` passes: its largest margin counts, and it is left out of the shares "
         "that pass.\n"
         "These numbers are the same on every machine; `tests/bench/searches.c` has the "
         "commands.\n");
    put_methods(n, searched);
    put_problems(n, searched);
}

int main(int argc, char **argv) {
    if (argc != 4)
        return 2;
    measured = read_json(argv[1]);
    profile = read_json(argv[2]);
    put_head();
    put_figures();
    put_chains();
    put_trains();
    put_batches();
    put_solvers();
    put_program();
    put_searches(argv[3]);
    put_shares();
    put_rates();
    return 0;
}
