/* A sampling on a terminal and on its page: the share of passing samples, checks, draws. */
#include "report/sample_table.h"

#include "report/figure.h"
#include "report/sample_replay.h"
#include "report/tables.h"
#include "report/verdict_words.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* ---- order of checks ---- */

/* Sort key: checks that fail in samples first, the most often failing first, then by the margin of
 * the 5 % quantile. */
static double order_of(const CzSampledCheck *check) {
    const double most = 1e9;
    if (check->n_fail > 0)
        return -most * check->n_fail;
    const double margin = check->margin.quantile[0];
    return isnan(margin) ? most : fmin(fmax(margin, -most), most);
}

int *cz_sample_order(const CzSampling *sampling) {
    int *order = malloc(((size_t)sampling->n_check + 1) * sizeof *order);
    for (int i = 0; order != NULL && i < sampling->n_check; i++) {
        int at = i;
        for (; at > 0 && order_of(&sampling->check[i]) < order_of(&sampling->check[order[at - 1]]);
             at--)
            order[at] = order[at - 1];
        order[at] = i;
    }
    return order;
}

/* ---- sentences ---- */

/* Part of a sentence about a number of samples. */
static void append(char text[CZ_SAMPLE_SENTENCE], const char *between, int n, const char *what) {
    const size_t used = strlen(text);
    snprintf(text + used, CZ_SAMPLE_SENTENCE - used, "%s%d %s", between, n, what);
}

void cz_sample_share_sentence(const CzSampling *sampling, char text[CZ_SAMPLE_SENTENCE]) {
    const CzSampledShare *passing = &sampling->passing;
    char share[CZ_FIGURE_SIZE], low[CZ_FIGURE_SIZE], high[CZ_FIGURE_SIZE];
    snprintf(text, CZ_SAMPLE_SENTENCE, "%d of %d samples pass: %s %% (95 %% interval %s to %s %%)",
             passing->n_pass, passing->n, cz_figure_digits(share, 3, 100 * passing->share),
             cz_figure_digits(low, 3, 100 * passing->low),
             cz_figure_digits(high, 3, 100 * passing->high));
    if (sampling->n_failed > 0)
        append(text, "; ", sampling->n_failed,
               sampling->n_failed == 1 ? "of them gave no result and counts as failing"
                                       : "of them gave no result and count as failing");
}

void cz_sample_method_sentence(const CzSampling *sampling, char text[CZ_SAMPLE_SENTENCE]) {
    snprintf(text, CZ_SAMPLE_SENTENCE, "%d samples of %d random numbers, %s, seed %ld",
             sampling->n_sample, sampling->n_draw, sampling->method, sampling->seed);
    if (sampling->n_shard > 1) {
        const size_t used = strlen(text);
        snprintf(text + used, CZ_SAMPLE_SENTENCE - used, "; here shard %d of %d: samples %d to %d",
                 sampling->shard, sampling->n_shard, sampling->begin + 1, sampling->end);
    }
}

/* The first check of a scenario that cannot be made for the nominal design; NULL when all can. */
static const CzCheckResult *first_unchecked(const CzEvaluation *nominal) {
    for (int i = 0; i < nominal->n_check; i++)
        if (nominal->check[i].verdict == CZ_VERDICT_NOT_CHECKED &&
            strcmp(nominal->check[i].scenario, "design") != 0)
            return &nominal->check[i];
    return NULL;
}

bool cz_sample_unjudged_sentence(const CzSampling *sampling, char text[CZ_SAMPLE_SENTENCE]) {
    const CzCheckResult *check = first_unchecked(&sampling->nominal);
    int n = 0;
    for (int k = 0; k < sampling->n_sample; k++)
        n += sampling->sample[k].state == CZ_SAMPLE_DONE &&
             sampling->sample[k].verdict == CZ_VERDICT_NOT_CHECKED;
    snprintf(text, CZ_SAMPLE_SENTENCE, "%d sample%s without a verdict%s%s%s%s", n,
             n == 1 ? " is" : "s are", check != NULL ? "; NOT CHECKED: " : "",
             check != NULL ? check->name : "", check != NULL && check->why != NULL ? ", " : "",
             check != NULL && check->why != NULL ? check->why : "");
    return n > 0;
}

/* ---- checks ---- */

void cz_sample_put_margin(CzReportTable *table, double margin) {
    char text[CZ_FIGURE_SIZE];
    const bool is_failed = isinf(margin);
    cz_table_put_styled(table, is_failed ? "failed" : cz_figure_margin(text, margin),
                        margin < 0 ? CZ_STYLE_BAD : CZ_STYLE_PLAIN);
}

static void put_check(CzReportTable *table, const CzSampling *sampling,
                      const CzSampledCheck *check) {
    char text[CZ_FIGURE_SIZE];
    cz_table_put(table, check->name);
    cz_table_put(table, check->scenario);
    cz_sample_put_margin(table, check->nominal);
    cz_sample_put_margin(table, check->bare);
    for (int i = 0; i < CZ_N_SAMPLE_QUANTILE; i++)
        cz_sample_put_margin(table, check->margin.quantile[i]);
    cz_sample_put_margin(table, check->margin.least);
    cz_table_put_styled(table, cz_figure_digits(text, 9, check->n_fail),
                        check->n_fail > 0 ? CZ_STYLE_BAD : CZ_STYLE_PLAIN);
    cz_table_put(
        table, check->margin.worst >= 0 ? cz_figure_digits(text, 9, check->margin.worst + 1) : "-");
    if (check->strongest < 0)
        cz_table_put(table, "");
    else
        cz_table_put_format(table, "%s (%s)", sampling->draw[check->strongest].name,
                            cz_figure_fixed(text, 2, check->correlation[check->strongest]));
}

/* Whether a check has results: a margin, or a failure. */
static bool has_results(const CzSampledCheck *check) {
    return check->n_fail > 0 || !isnan(check->margin.quantile[1]);
}

/* Whether one of the first n checks in the order has the name of this one and results. */
static bool is_named_before(const CzSampling *sampling, const int *order, int n, const char *name) {
    for (int i = 0; i < n; i++)
        if (has_results(&sampling->check[order[i]]) &&
            strcmp(sampling->check[order[i]].name, name) == 0)
            return true;
    return false;
}

int cz_sample_begin_checks(CzReportTable *table, const CzSampling *sampling, const int *order,
                           bool each_name_once) {
    int n_more = 0;
    cz_table_begin(table, "check;scenario;>nominal;>bare;>5 %;>50 %;>95 %;>least;>failing;>worst;"
                          "strongest draw (rank correlation)");
    for (int i = 0; i < sampling->n_check; i++) {
        const CzSampledCheck *check = &sampling->check[order[i]];
        if (!has_results(check))
            continue;
        if (each_name_once && is_named_before(sampling, order, i, check->name))
            n_more++;
        else
            put_check(table, sampling, check);
    }
    return n_more;
}

/* ---- draws ---- */

static void put_draw(CzReportTable *table, const CzDraw *draw) {
    char low[CZ_FIGURE_SIZE], high[CZ_FIGURE_SIZE];
    const bool is_factor = draw->effect == CZ_DRAW_FACTOR;
    const double scale = is_factor ? 100 : 1, zero = is_factor ? 1 : 0;
    const char *unit = is_factor ? "%" : draw->unit;
    const bool is_change = draw->effect != CZ_DRAW_VALUE;
    cz_figure_digits(low, 4, scale * (draw->low - zero));
    cz_figure_digits(high, 4, scale * (draw->high - zero));
    cz_table_put(table, draw->name);
    cz_table_put(table, draw->distribution);
    cz_table_put_format(table, "%s to %s%s%s%s", low, is_change ? "+" : "", high,
                        unit[0] != '\0' ? " " : "", unit);
    cz_table_put(table, cz_figure_digits(low, 9, draw->n_place));
}

void cz_sample_begin_draws(CzReportTable *table, const char *heads, int n_draw,
                           const CzDraw *draw) {
    cz_table_begin(table, heads);
    for (int d = 0; d < n_draw; d++)
        put_draw(table, &draw[d]);
}

/* ---- the terminal ---- */

enum { MAX_DRAWS = 24, MAX_FAILURES = 3 };

static void write_failures(const CzSampling *sampling, CzTerminal *terminal) {
    for (int k = 0, n = 0; k < sampling->n_sample && n < MAX_FAILURES; k++) {
        const CzSample *sample = &sampling->sample[k];
        if (sample->message == NULL)
            continue;
        n++;
        cz_terminal_print(terminal, CZ_STYLE_BAD, "Sample %d %s: %s\n", k + 1,
                          cz_sample_state_text(sample->state), sample->message);
    }
    if (sampling->n_failed > MAX_FAILURES)
        cz_terminal_print(terminal, CZ_STYLE_BAD, "and %d more without results.\n",
                          sampling->n_failed - MAX_FAILURES);
}

static void write_checks(const CzSampling *sampling, CzTerminal *terminal) {
    CzReportTable table;
    int *order = cz_sample_order(sampling);
    if (order == NULL) {
        terminal->failed = true;
        return;
    }
    const int n_more = cz_sample_begin_checks(&table, sampling, order, true);
    cz_table_write_text(&table, terminal);
    if (n_more > 0)
        cz_terminal_print(terminal, CZ_STYLE_PLAIN,
                          "%d more checks of other scenarios, each better than the one of its name "
                          "above.\n",
                          n_more);
    free(order);
}

/* The sample with the smallest margin, and the command that runs it where settings can. */
static void write_worst(const CzReport *report, CzTerminal *terminal) {
    const CzSampling *sampling = report->sampling;
    const int worst = sampling->smallest.worst;
    if (worst < 0)
        return;
    const CzSample *sample = &sampling->sample[worst];
    char text[CZ_FIGURE_SIZE];
    cz_terminal_print(terminal, CZ_STYLE_PLAIN, "Worst: sample %d, %s", worst + 1,
                      sample->state != CZ_SAMPLE_DONE ? cz_sample_state_text(sample->state)
                      : isinf(sample->margin)         ? "beyond model validity"
                                                      : cz_figure_margin(text, sample->margin));
    if (sample->check >= 0)
        cz_terminal_print(terminal, CZ_STYLE_PLAIN, ": %s in %s",
                          sampling->check[sample->check].name,
                          sampling->check[sample->check].scenario);
    fputs(".\n", terminal->stream);
    if (cz_replay_is_settings(sampling) && sample->state != CZ_SAMPLE_INVALID) {
        fputs("With the reserves of the design: ", terminal->stream);
        cz_replay_write_command(report, worst, terminal->stream);
        fputc('\n', terminal->stream);
    }
}

static void write_judgement(const CzSampling *sampling, CzTerminal *terminal) {
    const CzVerdict verdict = sampling->judgement;
    const int n_not_covered = sampling->nominal.n_not_covered;
    char text[CZ_SCREENING_SIZE];
    const char *remark = cz_screening_remark(verdict, n_not_covered, text);
    cz_terminal_print(terminal, cz_verdict_style(verdict), "%s", cz_verdict_title(verdict));
    cz_terminal_print(terminal, CZ_STYLE_PLAIN,
                      "%s%s judged by the %s of each check. The nominal design: %s.\n", remark,
                      remark[0] != '\0' ? ";" : ",", sampling->judged_by,
                      cz_verdict_words(sampling->nominal.verdict, n_not_covered));
}

void cz_sample_write_table(const CzReport *report, CzTerminal *terminal) {
    const CzSampling *sampling = report->sampling;
    CzReportTable table;
    char text[CZ_SAMPLE_SENTENCE];
    cz_terminal_print(terminal, CZ_STYLE_PLAIN, "%s\n", cz_problem_title(sampling->problem));
    cz_sample_method_sentence(sampling, text);
    cz_terminal_print(terminal, CZ_STYLE_PLAIN, "%s\n\n", text);
    if (sampling->n_draw <= MAX_DRAWS) {
        cz_sample_begin_draws(&table, CZ_DRAW_HEADS("random number"), sampling->n_draw,
                              sampling->draw);
        cz_table_write_text(&table, terminal);
        fputc('\n', terminal->stream);
    }
    if (sampling->n_run > 0) {
        write_checks(sampling, terminal);
        fputc('\n', terminal->stream);
        write_failures(sampling, terminal);
        cz_sample_share_sentence(sampling, text);
        cz_terminal_print(terminal, CZ_STYLE_PLAIN, "%s.\n", text);
        if (cz_sample_unjudged_sentence(sampling, text))
            cz_terminal_print(terminal, CZ_STYLE_CAREFUL, "%s.\n", text);
        write_worst(report, terminal);
    }
    cz_screening_print(sampling->problem, terminal);
    write_judgement(sampling, terminal);
    if (sampling->is_interrupted)
        cz_terminal_print(terminal, CZ_STYLE_BAD, "INTERRUPTED: samples are missing.\n");
}
