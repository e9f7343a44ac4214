/* A front as a page and as a figure: the second objective over the first. */
#include "report/page_pareto.h"

#include "base/error.h"
#include "crushzone/report.h"
#include "report/figure.h"
#include "report/page.h"
#include "report/plot.h"
#include "report/verdict_words.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Groups of points, each with a mark of its own. */
typedef enum Group { ON_FRONT, DOMINATED, DOUBTFUL, VIOLATING, N_GROUP } Group;

static Group group_of(const CzParetoPoint *point) {
    if (cz_pareto_is_on_front(point))
        return ON_FRONT;
    if (point->state == CZ_PARETO_VERIFIED)
        return DOMINATED;
    return point->state == CZ_PARETO_NOT_VERIFIED ? DOUBTFUL : VIOLATING;
}

/* Points as they are drawn; arrays are parts of one allocation. */
typedef struct Drawn {
    double *x[N_GROUP], *y[N_GROUP]; /* (n) */
    int *number[N_GROUP];            /* (n) */
    int n[N_GROUP];
    char missing[200]; /* of points without a design; empty when there are none */
} Drawn;

/* A value in the unit of the axis: margins in percent. */
static double drawn_value(const CzPareto *pareto, const CzParetoPoint *point, int objective) {
    return point->value[objective] * (pareto->objective[objective].is_margin ? 100 : 1);
}

/* Adds a point to a group; the line of the front is ordered by its first objective. */
static void add_point(Drawn *drawn, Group group, double x, double y, int number) {
    int at = drawn->n[group]++;
    for (; at > 0 && drawn->x[group][at - 1] > x; at--) {
        drawn->x[group][at] = drawn->x[group][at - 1];
        drawn->y[group][at] = drawn->y[group][at - 1];
        drawn->number[group][at] = drawn->number[group][at - 1];
    }
    drawn->x[group][at] = x;
    drawn->y[group][at] = y;
    drawn->number[group][at] = number;
}

/* Whether a point is at the place of the one that dominates it, so that their numbers would cover
 * each other. */
static bool is_covered(const CzPareto *pareto, const CzParetoPoint *point) {
    if (point->dominated_by < 0)
        return false;
    const CzParetoPoint *other = &pareto->point[point->dominated_by];
    return other->value[0] == point->value[0] && other->value[1] == point->value[1];
}

static void collect(const CzPareto *pareto, double *numbers, int *whole, Drawn *drawn) {
    *drawn = (Drawn){0};
    for (int group = 0; group < N_GROUP; group++) {
        drawn->x[group] = numbers + 2 * group * pareto->n_point;
        drawn->y[group] = drawn->x[group] + pareto->n_point;
        drawn->number[group] = whole + group * pareto->n_point;
    }
    for (int i = 0; i < pareto->n_point; i++) {
        const CzParetoPoint *point = &pareto->point[i];
        const double x = drawn_value(pareto, point, 0), y = drawn_value(pareto, point, 1);
        const size_t n = strlen(drawn->missing);
        if (isfinite(x) && isfinite(y))
            add_point(drawn, group_of(point), x, y, is_covered(pareto, point) ? 0 : i + 1);
        else if (point->state != CZ_PARETO_NOT_NEEDED && n < sizeof drawn->missing)
            snprintf(drawn->missing + n, sizeof drawn->missing - n, "%s%d",
                     n == 0 ? "without a design, not drawn: " : ", ", i + 1);
    }
}

static void write_front(const CzPareto *pareto, const Drawn *drawn, bool is_figure,
                        CzMarkup *markup) {
    static const struct {
        const char *name;
        int colour;
        CzSeriesForm form;
    } look[N_GROUP] = {[ON_FRONT] = {"verified", 0, CZ_SERIES_DOTS},
                       [DOMINATED] = {"no better than another point", 0, CZ_SERIES_RINGS},
                       [DOUBTFUL] = {"not verified", 4, CZ_SERIES_RINGS},
                       [VIOLATING] = {"violates a limit", 1, CZ_SERIES_CROSSES}};
    CzSeries series[N_GROUP + 2];
    char label[2][CZ_SENTENCE_SIZE];
    int n = 0;
    series[n++] = (CzSeries){.n = drawn->n[ON_FRONT],
                             .x = drawn->x[ON_FRONT],
                             .y = drawn->y[ON_FRONT],
                             .colour = CZ_PLOT_QUIET};
    for (int group = 0; group < N_GROUP; group++)
        if (drawn->n[group] > 0)
            series[n++] = (CzSeries){.name = look[group].name,
                                     .n = drawn->n[group],
                                     .x = drawn->x[group],
                                     .y = drawn->y[group],
                                     .colour = look[group].colour,
                                     .form = look[group].form,
                                     .number = drawn->number[group]};
    if (drawn->missing[0] != '\0')
        series[n++] =
            (CzSeries){.name = drawn->missing, .colour = CZ_PLOT_QUIET, .form = CZ_SERIES_CROSSES};
    for (int k = 0; k < 2; k++)
        snprintf(label[k], sizeof label[k], "%s",
                 pareto->objective[k].is_margin ? "smallest margin [%]"
                                                : pareto->objective[k].name);
    const CzPlot plot = {.title = "Front of the two objectives, points by number",
                         .x_label = label[0],
                         .y_label = label[1],
                         .n_series = n,
                         .series = series,
                         .height = 280};
    if (is_figure)
        cz_plot_write_figure(&plot, markup);
    else
        cz_plot_write(&plot, markup);
}

/* Draws the front on a page or alone. */
static void draw(const CzPareto *pareto, bool is_figure, CzMarkup *markup) {
    const size_t n = (size_t)pareto->n_point * N_GROUP;
    double *numbers = malloc(2 * n * sizeof *numbers);
    int *whole = malloc(n * sizeof *whole);
    Drawn drawn;
    if (numbers != NULL && whole != NULL) {
        collect(pareto, numbers, whole, &drawn);
        write_front(pareto, &drawn, is_figure, markup);
    } else {
        markup->failed = true;
    }
    free(numbers);
    free(whole);
}

static CzStatus end(const CzMarkup *markup, CzError *error) {
    return markup->failed ? cz_fail(error, CZ_STATUS_NO_MEMORY, "no memory for the report") : CZ_OK;
}

CzStatus cz_report_write_front(const CzPareto *pareto, FILE *stream, CzError *error) {
    CzMarkup markup = {.stream = stream};
    cz_svg_begin_document(&markup);
    draw(pareto, false, &markup);
    return end(&markup, error);
}

/* The designs of the points: a row per variable. */
static void write_designs(const CzPareto *pareto, CzMarkup *markup) {
    CzReportTable table;
    char text[CZ_FIGURE_SIZE];
    cz_table_begin(&table, "point");
    for (int i = 0; i < pareto->n_variable && i + 1 < CZ_MAX_COLUMNS; i++) {
        char head[CZ_SENTENCE_SIZE];
        snprintf(head, sizeof head, ">%s", cz_evaluator_variable(pareto->evaluator, i)->name);
        cz_table_head(&table, head);
    }
    table.class_name = "points cards";
    for (int k = 0; k < pareto->n_point; k++) {
        const CzParetoPoint *point = &pareto->point[k];
        if (point->x == NULL)
            continue;
        cz_table_put_format(&table, "%d", k + 1);
        for (int i = 0; i < pareto->n_variable && i + 1 < CZ_MAX_COLUMNS; i++) {
            const CzVariableInfo *info = cz_evaluator_variable(pareto->evaluator, i);
            cz_table_put(&table, info->n_choice > 0 ? info->choice[(int)point->x[i]]
                                                    : cz_figure_digits(text, 6, point->x[i]));
        }
    }
    cz_table_write_page(&table, markup);
}

CzStatus cz_page_write_pareto(const CzPareto *pareto, const CzProblem *problem, FILE *stream,
                              CzError *error) {
    CzMarkup markup = {.stream = stream};
    CzReportTable table;
    char text[CZ_SENTENCE_SIZE];
    snprintf(text, sizeof text, "%s, front", cz_problem_title(problem));
    cz_page_write_head(&markup, text);
    cz_markup_write(&markup, "<h1>%s</h1>", text);
    cz_page_write_document(&markup, problem);
    if (pareto->is_interrupted)
        cz_markup_write(&markup,
                        "<p class='fail'>The search was interrupted: the front is incomplete.</p>");
    cz_pareto_describe(pareto, sizeof text, text);
    cz_markup_write(&markup, "<p>%s</p>\n", text);
    cz_screening_write(problem, &markup);
    cz_markup_write(&markup, "<section id='figures'>\n<h2>Front</h2>\n<div class='figures'>");
    draw(pareto, true, &markup);
    cz_markup_write(&markup, "</div></section>\n<section id='points'>\n<h2>Points</h2>\n");
    cz_pareto_begin_points(&table, pareto);
    table.class_name = "points cards";
    cz_table_write_page(&table, &markup);
    cz_markup_write(&markup, "</section>\n<section id='designs'>\n<h2>Designs</h2>\n");
    write_designs(pareto, &markup);
    cz_markup_write(&markup, "</section>\n");
    cz_page_write_foot(&markup);
    return end(&markup, error);
}
