/* A sampling as a page: the share of passing samples, histograms of margins, rank correlations, and
 * the worst samples. */
#include "report/page_sample.h"

#include "base/error.h"
#include "report/figure.h"
#include "report/page.h"
#include "report/sample_figures.h"
#include "report/sample_replay.h"
#include "report/sample_table.h"
#include "report/verdict_words.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { MAX_HISTOGRAMS = 6, MAX_TORNADOES = 4, MAX_FAILURES = 50 };

static bool has_figures(const CzSampledCheck *check) {
    return !check->is_flag && !isnan(check->margin.quantile[1]);
}

static void write_banner(CzMarkup *markup, const CzSampling *sampling) {
    char text[CZ_SAMPLE_SENTENCE], remark[CZ_SCREENING_SIZE];
    const CzVerdict verdict = sampling->judgement;
    cz_markup_write(markup, "<header><p class='banner %s'>%s%s</p></header>\n",
                    cz_verdict_class(verdict), cz_verdict_title(verdict),
                    cz_screening_remark(verdict, sampling->nominal.n_not_covered, remark));
    cz_sample_share_sentence(sampling, text);
    cz_markup_write(markup, "<p><strong>%s.</strong></p>\n", text);
    if (cz_sample_unjudged_sentence(sampling, text))
        cz_markup_write(markup, "<p class='fail'>%s.</p>\n", text);
    cz_sample_method_sentence(sampling, text);
    cz_markup_write(markup,
                    "<p>%s. The verdict is that of the %s of each check; the nominal design: "
                    "%s.</p>\n",
                    text, sampling->judged_by,
                    cz_verdict_words(sampling->nominal.verdict, sampling->nominal.n_not_covered));
    cz_screening_write(sampling->problem, markup);
    if (sampling->is_interrupted)
        cz_markup_write(markup,
                        "<p class='fail'>The sampling was interrupted: samples are missing.</p>");
}

static void write_nav(CzMarkup *markup) {
    cz_markup_write(markup, "<nav><a href='#checks'>checks</a> <a href='#margins'>margins</a> "
                            "<a href='#drivers'>rank correlations</a> "
                            "<a href='#matrix'>worst check</a> "
                            "<a href='#convergence'>number of samples</a> "
                            "<a href='#worst'>worst samples</a> "
                            "<a href='#numbers'>random numbers</a></nav>\n");
}

static void write_checks(CzMarkup *markup, const CzSampling *sampling, const int *order) {
    CzReportTable table;
    cz_markup_write(
        markup,
        "<section id='checks'>\n<h2>Checks</h2>\n"
        "<p>Nominal is the margin of the design as written, with its reserves; bare is the same by "
        "the limits that hold in samples. Then the quantiles of the margins of the samples, the "
        "smallest "
        "one, the number of samples that fail, and the sample with the smallest margin.</p>");
    (void)cz_sample_begin_checks(&table, sampling, order, false);
    cz_table_write_page(&table, markup);
    cz_markup_write(markup, "</section>\n");
}

typedef void DrawCheck(const CzSampling *sampling, int check, CzMarkup *markup);

/* Whether the i-th check of the order is the first of its name with margins: the worst scenario. */
static bool is_drawn(const CzSampling *sampling, const int *order, int i) {
    const CzSampledCheck *check = &sampling->check[order[i]];
    bool is_first = has_figures(check);
    for (int k = 0; k < i && is_first; k++)
        is_first = !has_figures(&sampling->check[order[k]]) ||
                   strcmp(sampling->check[order[k]].name, check->name) != 0;
    return is_first;
}

/* Figures of the worst checks, one of each name. */
static void write_figures(CzMarkup *markup, const CzSampling *sampling, const int *order, int most,
                          DrawCheck *draw) {
    cz_markup_write(markup, "<div class='figures'>");
    for (int i = 0, n = 0; i < sampling->n_check && n < most; i++)
        if (is_drawn(sampling, order, i)) {
            draw(sampling, order[i], markup);
            n++;
        }
    cz_markup_write(markup, "</div></section>\n");
}

static void write_matrix(CzMarkup *markup, const CzSampling *sampling, const int *order) {
    for (int i = 0; i < sampling->n_check; i++) {
        if (!has_figures(&sampling->check[order[i]]))
            continue;
        cz_markup_write(markup, "<section id='matrix'>\n<h2>The worst check and its strongest "
                                "random numbers</h2>\n<div class='wide'>");
        cz_sample_draw_matrix(sampling, order[i], markup);
        cz_markup_write(markup, "</div></section>\n");
        return;
    }
}

/* One line for a sample that is the worst of a check. */
static void put_worst(CzReportTable *table, const CzReport *report, int k) {
    const CzSampling *sampling = report->sampling;
    const CzSample *sample = &sampling->sample[k];
    char text[CZ_FIGURE_SIZE], file[CZ_REPLAY_SIZE];
    cz_replay_name(k, file);
    cz_table_put(table, cz_figure_digits(text, 9, k + 1));
    cz_table_put(table, sample->check >= 0 ? sampling->check[sample->check].name
                                           : cz_sample_state_text(sample->state));
    cz_table_put(table, sample->check >= 0 ? sampling->check[sample->check].scenario : "");
    cz_table_put(table, isinf(sample->margin) ? "failed" : cz_figure_margin(text, sample->margin));
    cz_table_put_format(table, "crushzone check %s", file);
}

static void write_worst(CzMarkup *markup, const CzReport *report) {
    const CzSampling *sampling = report->sampling;
    CzReportTable table;
    cz_markup_write(markup, "<section id='worst'>\n<h2>Worst samples</h2>\n"
                            "<p>Each is the worst of at least one check. The command judges it "
                            "again, beside the design as written; it is given from the folder of "
                            "this page.</p>");
    cz_table_begin(&table, ">sample;check with the smallest margin;scenario;>margin;command");
    for (int k = 0; k < sampling->n_sample; k++)
        if (cz_replay_is_written(sampling, k))
            put_worst(&table, report, k);
    cz_table_write_page(&table, markup);
    for (int k = 0, n = 0; k < sampling->n_sample && n < MAX_FAILURES; k++)
        if (sampling->sample[k].message != NULL) {
            n++;
            cz_markup_write(markup, "<p class='fail'>Sample %d %s: %s</p>\n", k + 1,
                            cz_sample_state_text(sampling->sample[k].state),
                            sampling->sample[k].message);
        }
    cz_markup_write(markup, "</section>\n");
}

static void write_draws(CzMarkup *markup, const CzSampling *sampling) {
    CzReportTable table;
    cz_markup_write(markup, "<section id='numbers'>\n<h2>Random numbers</h2>\n");
    cz_sample_begin_draws(&table, CZ_DRAW_HEADS("random number"), sampling->n_draw, sampling->draw);
    cz_table_write_page(&table, markup);
    cz_markup_write(markup, "</section>\n");
}

static void write_parts(CzMarkup *markup, const CzReport *report, const int *order) {
    const CzSampling *sampling = report->sampling;
    char text[CZ_FIGURE_SIZE];
    write_nav(markup);
    write_checks(markup, sampling, order);
    cz_markup_write(markup,
                    "<section id='margins'>\n<h2>Margins</h2>\n<p>The checks that fail most often, "
                    "or have the smallest margins, each in its worst scenario. Margins below -100 "
                    "%% and runs that failed are drawn at -100 %%.</p>");
    write_figures(markup, sampling, order, MAX_HISTOGRAMS, cz_sample_draw_histogram);
    cz_markup_write(
        markup,
        "<section id='drivers'>\n<h2>Rank correlations</h2>\n<p>Rank correlation (Spearman) of "
        "each "
        "random number with the margin. Green, to the right: the margin grows with the number; "
        "orange, to the left: it falls. A correlation below %s may be chance.</p>",
        cz_figure_fixed(text, 2, fmin(2 / sqrt(fmax(sampling->n_run - 1, 1)), 1)));
    write_figures(markup, sampling, order, MAX_TORNADOES, cz_sample_draw_tornado);
    write_matrix(markup, sampling, order);
    cz_markup_write(markup, "<section id='convergence'>\n<h2>Number of samples</h2>\n"
                            "<div class='figures'>");
    cz_sample_draw_convergence(sampling, markup);
    cz_markup_write(markup, "</div></section>\n");
    write_worst(markup, report);
}

CzStatus cz_page_write_sample(const CzReport *report, FILE *stream, CzError *error) {
    const CzSampling *sampling = report->sampling;
    CzMarkup markup = {.stream = stream};
    char title[CZ_SENTENCE_SIZE];
    int *order = cz_sample_order(sampling);
    if (order == NULL)
        return cz_fail(error, CZ_STATUS_NO_MEMORY, "no memory for the report");
    snprintf(title, sizeof title, "%s, sampled", cz_problem_title(sampling->problem));
    cz_page_write_head(&markup, title);
    cz_markup_write(&markup, "<h1>%s</h1>", title);
    cz_page_write_document(&markup, sampling->problem);
    write_banner(&markup, sampling);
    if (sampling->n_run > 0)
        write_parts(&markup, report, order);
    write_draws(&markup, sampling);
    cz_page_write_foot(&markup);
    free(order);
    return markup.failed ? cz_fail(error, CZ_STATUS_NO_MEMORY, "no memory for the report") : CZ_OK;
}
