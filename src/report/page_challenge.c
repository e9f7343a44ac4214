/* A challenge as a page: the outcome, weak points, margins over the most influential numbers. */
#include "report/page_challenge.h"

#include "base/error.h"
#include "report/challenge_files.h"
#include "report/challenge_table.h"
#include "report/figure.h"
#include "report/page.h"
#include "report/plot.h"
#include "report/sample_table.h"
#include "report/verdict_words.h"
#include "statistics/rank.h"

#include <math.h>
#include <stdlib.h>

enum { MAX_NUMBERS = 4, MAX_FAILURES = 50 };

#define MAX_PERCENT 100.0 /* margins below its negative are drawn at it */

/* Points of a figure, and room for them. */
typedef struct Cloud {
    const CzChallenge *challenge;
    double *x, *y; /* (n_point) */
    int n;
} Cloud;

/* ---- choice of numbers ---- */

/* Size of the rank correlation of a number with the smallest margin, over the points that have
 * one; 0 where there is none. `room` is (4 n_point). */
static double correlation_size(const CzChallenge *challenge, int draw, double *room,
                               bool *has_memory) {
    const long n_point = challenge->n_point;
    double *x = room, *y = x + n_point, *x_rank = y + n_point, *y_rank = x_rank + n_point;
    int n = 0;
    for (int i = 0; i < challenge->n_point; i++)
        if (isfinite(challenge->point[i].margin)) {
            x[n] = cz_challenge_value(challenge, i, draw);
            y[n++] = challenge->point[i].margin;
        }
    if (n < 3)
        return 0;
    *has_memory &= cz_rank(n, x, x_rank) && cz_rank(n, y, y_rank);
    const double found = *has_memory ? cz_rank_correlation(n, x_rank, y_rank) : 0;
    return isnan(found) ? 0 : fabs(found);
}

/* The numbers with the largest correlations; returns how many. */
static int choose_numbers(const CzChallenge *challenge, int *draw, double *room, bool *has_memory) {
    double size[MAX_NUMBERS];
    int n = 0;
    for (int d = 0; d < challenge->n_draw; d++) {
        const double own = correlation_size(challenge, d, room, has_memory);
        int at = n < MAX_NUMBERS ? n++ : MAX_NUMBERS;
        for (; at > 0 && size[at - 1] < own; at--)
            if (at < MAX_NUMBERS) {
                size[at] = size[at - 1];
                draw[at] = draw[at - 1];
            }
        if (at < MAX_NUMBERS) {
            size[at] = own;
            draw[at] = d;
        }
    }
    return n;
}

/* ---- figures ---- */

static double percent(double margin) {
    return fmin(fmax(100 * margin, -MAX_PERCENT), MAX_PERCENT); /* NaN becomes a bound */
}

/* Collects the points that pass or fail, over a number, or over the order for -1. */
static void collect(Cloud *cloud, int draw, bool fails) {
    const CzChallenge *challenge = cloud->challenge;
    cloud->n = 0;
    for (int i = 0; i < challenge->n_point; i++) {
        const CzChallengePoint *point = &challenge->point[i];
        if (isnan(point->margin) || (point->verdict == CZ_VERDICT_FAIL) != fails)
            continue;
        cloud->x[cloud->n] = draw < 0 ? i + 1 : cz_challenge_value(challenge, i, draw);
        cloud->y[cloud->n++] = percent(point->margin);
    }
}

/* The smallest margin so far, over the runs. */
static void collect_progress(Cloud *cloud) {
    double least = INFINITY;
    cloud->n = 0;
    for (int i = 0; i < cloud->challenge->n_point; i++) {
        least = fmin(least, cloud->challenge->point[i].margin); /* fmin ignores NaN */
        if (isinf(least) && least > 0)
            continue;
        cloud->x[cloud->n] = i + 1;
        cloud->y[cloud->n++] = percent(least);
    }
}

static CzSeries series_of(const Cloud *cloud, const char *name, int colour) {
    return (CzSeries){.name = name,
                      .n = cloud->n,
                      .x = cloud->x,
                      .y = cloud->y,
                      .colour = colour,
                      .form = CZ_SERIES_POINTS};
}

/* Margins over a number, or over the order of the runs for -1. */
static void write_figure(CzMarkup *markup, const CzChallenge *challenge, int draw, double *room) {
    const size_t n = (size_t)challenge->n_point;
    Cloud passing = {.challenge = challenge, .x = room, .y = room + n};
    Cloud failing = {.challenge = challenge, .x = room + 2 * n, .y = room + 3 * n};
    Cloud progress = {.challenge = challenge, .x = room + 4 * n, .y = room + 5 * n};
    char label[CZ_SENTENCE_SIZE] = "run",
         title[CZ_SENTENCE_SIZE] = "Progress of the smallest margin";
    collect(&passing, draw, false);
    collect(&failing, draw, true);
    collect_progress(&progress);
    const CzSeries series[] = {series_of(&passing, "passes", 2),
                               series_of(&failing, "fails", 1),
                               {.name = "smallest so far",
                                .n = progress.n,
                                .x = progress.x,
                                .y = progress.y,
                                .colour = 0}};
    const CzPlotLimit limit = {"no margin left", 0};
    if (draw >= 0) {
        const CzDraw *own = &challenge->draw[draw];
        const char *unit = own->effect == CZ_DRAW_FACTOR ? "factor" : own->unit;
        snprintf(label, sizeof label, "%.400s%s%s%s", own->name, unit[0] != '\0' ? " [" : "", unit,
                 unit[0] != '\0' ? "]" : "");
        snprintf(title, sizeof title, "Smallest margin over %.400s", own->name);
    }
    const CzPlot plot = {.title = title,
                         .x_label = label,
                         .y_label = "margin [%]",
                         .n_series = draw < 0 ? 3 : 2,
                         .series = series,
                         .n_limit = 1,
                         .limit = &limit,
                         .from_zero = true};
    cz_plot_write_figure(&plot, markup);
}

static void write_figures(CzMarkup *markup, const CzChallenge *challenge) {
    int draw[MAX_NUMBERS];
    double *room = malloc((6 * (size_t)challenge->n_point + 1) * sizeof *room);
    bool has_memory = room != NULL;
    const int n = has_memory ? choose_numbers(challenge, draw, room, &has_memory) : 0;
    cz_markup_write(markup,
                    "<section id='figures'>\n<h2>Margins</h2>\n<p>Each dot is a run: the smallest "
                    "margin of all its checks, over the numbers that it depends on most, and in "
                    "the order of the runs. Margins below -100 %% are drawn at -100 %%, above "
                    "+100 %% at +100 %%.</p>\n<div class='figures'>");
    markup->failed |= !has_memory;
    for (int i = 0; room != NULL && i < n; i++)
        write_figure(markup, challenge, draw[i], room);
    if (room != NULL)
        write_figure(markup, challenge, -1, room);
    free(room);
    cz_markup_write(markup, "</div></section>\n");
}

/* ---- tables ---- */

static void write_weak(CzMarkup *markup, const CzReport *report) {
    const CzChallenge *challenge = report->challenge;
    CzReportTable table;
    cz_markup_write(markup, "<section id='weak'>\n<h2>%s</h2>\n<p>Each was run in full%s.</p>",
                    challenge->is_broken ? "Weak points" : "Weakest points that pass",
                    cz_challenge_has_files(report)
                        ? "; <code>crushzone check " CZ_COUNTER_EXAMPLE
                          "</code> in the folder of this page judges the worst one again"
                        : "");
    cz_challenge_begin_weak(&table, challenge, true);
    cz_table_write_page(&table, markup);
    for (int i = 0, n = 0; i < challenge->n_point && n < MAX_FAILURES; i++)
        if (challenge->point[i].message != NULL) {
            n++;
            cz_markup_write(markup, "<p class='fail'>Point %d %s: %s</p>\n", i + 1,
                            cz_sample_state_text(challenge->point[i].state),
                            challenge->point[i].message);
        }
    cz_markup_write(markup, "</section>\n");
}

static void write_checks(CzMarkup *markup, const CzChallenge *challenge) {
    CzReportTable table;
    char text[CZ_FIGURE_SIZE];
    cz_markup_write(markup, "<section id='checks'>\n<h2>Checks</h2>\n<p>Margins of the design "
                            "without changes and the smallest ones of the runs of the search, both "
                            "by the limits that hold at points.</p>");
    cz_table_begin(&table, "check;scenario;>nominal;>smallest;>failing;>point");
    for (int c = 0; c < challenge->n_check; c++) {
        const CzChallengedCheck *check = &challenge->check[c];
        if (isnan(check->least) && check->n_fail == 0)
            continue;
        cz_table_put(&table, check->name);
        cz_table_put(&table, check->scenario);
        cz_table_put(&table, cz_figure_margin(text, check->nominal));
        cz_table_put_styled(&table, cz_figure_margin(text, check->least),
                            check->least < 0 ? CZ_STYLE_BAD : CZ_STYLE_PLAIN);
        cz_table_put(&table, cz_figure_digits(text, 9, check->n_fail));
        cz_table_put(&table, check->worst >= 0 ? cz_figure_digits(text, 9, check->worst + 1) : "-");
    }
    cz_table_write_page(&table, markup);
    cz_markup_write(markup, "</section>\n");
}

static void write_numbers(CzMarkup *markup, const CzChallenge *challenge) {
    CzReportTable table;
    cz_markup_write(markup, "<section id='numbers'>\n<h2>Numbers that the adversary chooses</h2>");
    cz_sample_begin_draws(&table, CZ_DRAW_HEADS("number"), challenge->n_draw, challenge->draw);
    cz_table_write_page(&table, markup);
    cz_markup_write(markup, "</section>\n");
}

CzStatus cz_page_write_challenge(const CzReport *report, FILE *stream, CzError *error) {
    const CzChallenge *challenge = report->challenge;
    CzMarkup markup = {.stream = stream};
    char title[CZ_SENTENCE_SIZE], text[CZ_CHALLENGE_SENTENCE];
    snprintf(title, sizeof title, "%s, challenged", cz_problem_title(challenge->problem));
    cz_page_write_head(&markup, title);
    cz_markup_write(&markup, "<h1>%s</h1>", title);
    cz_page_write_document(&markup, challenge->problem);
    cz_challenge_outcome_sentence(challenge, text);
    cz_markup_write(&markup, "<header><p class='banner %s'>%s</p></header>\n<p>%s.</p>\n",
                    challenge->is_broken                             ? "fail"
                    : challenge->judgement == CZ_VERDICT_NOT_CHECKED ? "careful"
                                                                     : "pass",
                    challenge->is_broken ? "BROKEN" : "NOT BROKEN", text);
    cz_challenge_method_sentence(challenge, text);
    cz_markup_write(&markup, "<p>%s.</p>\n", text);
    cz_screening_write(challenge->problem, &markup);
    if (challenge->is_interrupted)
        cz_markup_write(&markup,
                        "<p class='fail'>The challenge was interrupted: runs are missing.</p>");
    write_weak(&markup, report);
    write_figures(&markup, challenge);
    write_checks(&markup, challenge);
    write_numbers(&markup, challenge);
    cz_page_write_foot(&markup);
    return markup.failed ? cz_fail(error, CZ_STATUS_NO_MEMORY, "no memory for the report") : CZ_OK;
}
