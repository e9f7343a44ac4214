/* Times cases in turn, so that other work on the machine hits all alike. */
#include "bench/measure.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "bench/cases.h"
#include "crushzone/crushzone.h"

void bench_stop(const char *message) {
    fprintf(stderr, "bench: %s\n", message);
    exit(1);
}

BenchCase *bench_add(Bench *bench, const char *key, const char *what, double (*run)(void *data),
                     void *data) {
    if (bench->n_case == BENCH_MAX_CASES)
        bench_stop("too many cases");
    BenchCase *added = &bench->cases[bench->n_case++];
    *added =
        (BenchCase){.run = run, .data = data, .per = 1.0, .most = BENCH_MAX_ROUNDS, .error = NAN};
    snprintf(added->key, sizeof added->key, "%s", key);
    snprintf(added->what, sizeof added->what, "%s", what);
    return added;
}

static const BenchCase *find(const Bench *bench, const char *key) {
    for (int i = 0; i < bench->n_case; i++)
        if (strcmp(bench->cases[i].key, key) == 0 && bench->cases[i].n > 0)
            return &bench->cases[i];
    return NULL;
}

/* ---- figures ---- */

typedef enum BenchForm { RATIO, EXPONENT, TIME } BenchForm;
typedef enum BenchSense { AT_MOST, AT_LEAST, MERELY } BenchSense;

static const struct {
    const char *key, *what;
    BenchForm form;
    const char *a, *b;
    double factor, limit;
    BenchSense sense;
} figures[BENCH_N_FIGURE] = {
#define BENCH_FIGURE(key, form, a, b, factor, sense, limit, what)                                  \
    {key, what, form, a, b, factor, limit, sense},
#include "bench/figures.def"
#undef BENCH_FIGURE
};
static const char *const senses[] = {"at most", "at least", "-"};

static double figure_of(int index, double a, double b) {
    switch (figures[index].form) {
    case RATIO:
        return figures[index].factor * a / b;
    case EXPONENT:
        return log(a / b) / log(figures[index].factor);
    default:
        return figures[index].factor * a;
    }
}

static void fill_figure(Bench *bench, int index) {
    const BenchCase *a = find(bench, figures[index].a), *b = find(bench, figures[index].b);
    BenchFigure *figure = &bench->figure[index];
    figure->value = figure->median = NAN;
    if (a == NULL || (b == NULL && figures[index].form != TIME))
        return;
    figure->value = figure_of(index, a->least, b != NULL ? b->least : 1.0);
    figure->median = figure_of(index, a->median, b != NULL ? b->median : 1.0);
}

/* ---- measuring ---- */

static int by_size(const void *a, const void *b) {
    const double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

void bench_measure(Bench *bench, int n_round, const char *only) {
    bench->n_round = n_round < BENCH_MAX_ROUNDS ? n_round : BENCH_MAX_ROUNDS;
    for (int round = 0; round < bench->n_round; round++)
        for (int i = 0; i < bench->n_case; i++) {
            BenchCase *timed = &bench->cases[i];
            if (round < timed->most &&
                (only == NULL || strncmp(timed->key, only, strlen(only)) == 0))
                timed->time[timed->n++] = timed->run(timed->data) / timed->per;
        }
    for (int i = 0; i < bench->n_case; i++) {
        BenchCase *timed = &bench->cases[i];
        qsort(timed->time, (size_t)timed->n, sizeof *timed->time, by_size);
        timed->least = timed->time[0];
        timed->median = timed->time[timed->n / 2];
    }
    for (int i = 0; i < BENCH_N_FIGURE; i++)
        fill_figure(bench, i);
}

/* ---- writing ---- */

#ifdef __clang__
static const char compiler[] = __VERSION__; /* begins with its name */
#else
static const char compiler[] = "gcc " __VERSION__;
#endif

static void write_number(FILE *stream, const char *key, double value) {
    if (isfinite(value))
        fprintf(stream, ", \"%s\": %.5g", key, value);
    else
        fprintf(stream, ", \"%s\": null", key);
}

/* The first line of /proc/cpuinfo that gives the processor's name. */
static void processor_name(char name[128]) {
    FILE *stream = fopen("/proc/cpuinfo", "r");
    char line[256];
    snprintf(name, 128, "unknown");
    while (stream != NULL && fgets(line, sizeof line, stream) != NULL)
        if (strncmp(line, "model name", 10) == 0 && strchr(line, ':') != NULL) {
            snprintf(name, 128, "%.127s", strchr(line, ':') + 2);
            name[strcspn(name, "\n\"\\")] = '\0';
            break;
        }
    if (stream != NULL)
        fclose(stream);
}

static void write_machine(const Bench *bench, FILE *stream) {
    char name[128], sundials[32] = "";
    processor_name(name);
    cz_sundials_version(sundials, sizeof sundials);
    fprintf(stream,
            "{\"version\": \"%s\", \"isa\": \"%s\", \"processor\": \"%s\", \"processors\": %ld, "
            "\"compiler\": \"%s\",\n \"sundials\": \"%s\", \"rounds\": %d",
            cz_version(), cz_isa_name(), name, sysconf(_SC_NPROCESSORS_ONLN), compiler, sundials,
            bench->n_round);
    for (int i = 0; i < chain_n_peer; i++)
        fprintf(stream, ", \"%s\": \"%s\"", chain_peers[i]->name, chain_peers[i]->version());
}

void bench_write_json(const Bench *bench, FILE *stream) {
    const char *separator = "";
    write_machine(bench, stream);
    fputs(",\n \"cases\": [", stream);
    for (int i = 0; i < bench->n_case; i++) {
        const BenchCase *timed = &bench->cases[i];
        if (timed->n == 0)
            continue;
        fprintf(stream, "%s\n  {\"key\": \"%s\", \"what\": \"%s\", \"clock\": \"%s\"", separator,
                timed->key, timed->what, timed->is_wall ? "wall" : "processor");
        write_number(stream, "min_ms", 1e3 * timed->least);
        write_number(stream, "median_ms", 1e3 * timed->median);
        fprintf(stream, ", \"n\": %d", timed->n);
        write_number(stream, "error", timed->error);
        fputc('}', stream);
        separator = ",";
    }
    fputs("\n ],\n \"figures\": [", stream);
    separator = "";
    for (int i = 0; i < BENCH_N_FIGURE; i++) {
        const BenchFigure *figure = &bench->figure[i];
        if (isnan(figure->value))
            continue;
        fprintf(stream, "%s\n  {\"key\": \"%s\", \"what\": \"%s\", \"asked\": \"%s\"", separator,
                figures[i].key, figures[i].what, senses[figures[i].sense]);
        write_number(stream, "limit", figures[i].sense != MERELY ? figures[i].limit : NAN);
        write_number(stream, "value", figure->value);
        write_number(stream, "median", figure->median);
        fputc('}', stream);
        separator = ",";
    }
    fputs("\n ]}\n", stream);
}

void bench_write_table(const Bench *bench, FILE *stream) {
    fprintf(stream, "%-28s %10s %10s %4s %9s  %s\n", "case", "min ms", "median ms", "n", "error",
            "what");
    for (int i = 0; i < bench->n_case; i++) {
        const BenchCase *timed = &bench->cases[i];
        char error[16] = "";
        if (isfinite(timed->error))
            snprintf(error, sizeof error, "%.3f %%", 100.0 * timed->error);
        if (timed->n > 0)
            fprintf(stream, "%-28s %10.3f %10.3f %4d %9s  %s\n", timed->key, 1e3 * timed->least,
                    1e3 * timed->median, timed->n, error, timed->what);
    }
    fprintf(stream, "\n%-13s %9s %9s  %s\n", "asked", "measured", "medians", "figure");
    for (int i = 0; i < BENCH_N_FIGURE; i++) {
        const BenchFigure *figure = &bench->figure[i];
        char asked[24] = "-";
        if (figures[i].sense != MERELY)
            snprintf(asked, sizeof asked, "%s %.3g", senses[figures[i].sense], figures[i].limit);
        if (isfinite(figure->value))
            fprintf(stream, "%-13s %9.3g %9.3g  %s\n", asked, figure->value, figure->median,
                    figures[i].what);
    }
}
