/* A front on a terminal: a line per point. */
#include "crushzone/report.h"

#include "report/figure.h"
#include "report/page_pareto.h"
#include "report/tables.h"
#include "report/verdict_words.h"

#include <math.h>

bool cz_pareto_is_on_front(const CzParetoPoint *point) {
    return point->state == CZ_PARETO_VERIFIED && point->dominated_by < 0;
}

static CzStyle style_of(const CzParetoPoint *point) {
    if (cz_pareto_is_on_front(point))
        return CZ_STYLE_GOOD;
    if (point->state == CZ_PARETO_VERIFIED || point->state == CZ_PARETO_NOT_NEEDED)
        return CZ_STYLE_PLAIN;
    return point->state == CZ_PARETO_NOT_VERIFIED ? CZ_STYLE_CAREFUL : CZ_STYLE_BAD;
}

/* A value of an objective: a margin with its sign, other numbers with six digits. */
static void put_value(CzReportTable *table, const CzParetoObjective *objective, double value) {
    char text[CZ_FIGURE_SIZE];
    if (objective->is_margin)
        cz_table_put(table, cz_figure_margin(text, value));
    else
        cz_table_put(table, isfinite(value) ? cz_figure_digits(text, 6, value) : "-");
}

static void put_point(CzReportTable *table, const CzPareto *pareto, int i) {
    const CzParetoPoint *point = &pareto->point[i];
    char text[CZ_FIGURE_SIZE];
    cz_table_put_format(table, "%d", i + 1);
    for (int k = 0; k < 2; k++)
        put_value(table, &pareto->objective[k], point->value[k]);
    if (isnan(point->bound))
        cz_table_put(table, "");
    else
        put_value(table, &pareto->objective[pareto->bounded], point->bound);
    cz_table_put_format(table, "%ld", point->n_evaluation);
    cz_table_put_styled(table, cz_pareto_state_text(point->state), style_of(point));
    if (point->dominated_by >= 0)
        cz_table_put_format(table, "no better than point %d", point->dominated_by + 1);
    else if (point->state == CZ_PARETO_INFEASIBLE && isfinite(point->violation))
        cz_table_put_format(table, "violates by %s", cz_figure_percent(text, point->violation));
    else if (point->state == CZ_PARETO_VERIFIED)
        cz_table_put(table, point->between_increments ? "between catalogue increments" : "");
    else
        cz_table_put(table, point->why);
}

void cz_pareto_begin_points(CzReportTable *table, const CzPareto *pareto) {
    char head[CZ_SENTENCE_SIZE];
    cz_table_begin(table, ">point");
    for (int k = 0; k < 2; k++) {
        snprintf(head, sizeof head, ">%s%s", pareto->objective[k].is_margin ? "smallest " : "",
                 pareto->objective[k].name);
        cz_table_head(table, head);
    }
    cz_table_head(table, pareto->objective[pareto->bounded].is_margin ? ">required" : ">limit");
    cz_table_head(table, ">evaluations");
    cz_table_head(table, "state");
    cz_table_head(table, "");
    for (int i = 0; i < pareto->n_point; i++)
        put_point(table, pareto, i);
}

void cz_pareto_describe(const CzPareto *pareto, size_t room, char *text) {
    int n_front = 0, n_dominated = 0, n_bad = 0;
    for (int i = 0; i < pareto->n_point; i++) {
        const CzParetoPoint *point = &pareto->point[i];
        n_front += cz_pareto_is_on_front(point);
        n_dominated += point->dominated_by >= 0;
        n_bad += point->state != CZ_PARETO_VERIFIED && point->state != CZ_PARETO_NOT_NEEDED &&
                 point->dominated_by < 0;
    }
    snprintf(text, room,
             "%d of %d points are on the front, %d are no better than another one, %d are not "
             "verified or have no design that passes.",
             n_front, pareto->n_point, n_dominated, n_bad);
}

void cz_pareto_write_table(const CzReport *report, CzTerminal *terminal) {
    const CzPareto *pareto = report->pareto;
    CzReportTable table;
    char text[CZ_SENTENCE_SIZE];
    cz_terminal_print(terminal, CZ_STYLE_PLAIN, "%s\n\n", cz_problem_title(report->problem));
    cz_pareto_begin_points(&table, pareto);
    cz_table_write_text(&table, terminal);
    cz_pareto_describe(pareto, sizeof text, text);
    fputc('\n', terminal->stream);
    cz_terminal_print(terminal, CZ_STYLE_PLAIN, "%s\n", text);
    cz_screening_print(report->problem, terminal);
    if (pareto->is_interrupted)
        cz_terminal_print(terminal, CZ_STYLE_BAD, "INTERRUPTED: the front is incomplete.\n");
}
