/* A sweep on a terminal: a line per value, or a map of two variables. */
#include "crushzone/report.h"

#include "report/figure.h"
#include "report/table.h"
#include "report/page_sweep.h"
#include "report/tables.h"
#include "report/verdict_words.h"

#include <math.h>
#include <string.h>

CzPointStyle cz_point_style(const CzSweepPoint *point) {
    static const CzPointStyle of_state[] = {
        [CZ_SWEEP_RUN_FAILED] = {"RUN FAILED", "!", "#5c0010", CZ_STYLE_BAD},
        [CZ_SWEEP_INVALID] = {"invalid", "-", "#9a9a9a", CZ_STYLE_PLAIN},
        [CZ_SWEEP_NOT_RUN] = {"not run", " ", "none", CZ_STYLE_PLAIN}};
    static const struct {
        const char *sign, *colour;
    } of_verdict[] = {[CZ_VERDICT_PASS] = {"+", "#009e73"},
                      [CZ_VERDICT_PROVISIONAL] = {"~", "#e69f00"},
                      [CZ_VERDICT_FAIL] = {"X", "#d0021b"},
                      [CZ_VERDICT_NOT_CHECKED] = {"?", "#9a9a9a"}};
    const CzVerdict verdict = point->verdict;
    return point->state != CZ_SWEEP_DONE
               ? of_state[point->state]
               : (CzPointStyle){cz_verdict_word(verdict), of_verdict[verdict].sign,
                                of_verdict[verdict].colour, cz_verdict_style(verdict)};
}

static void put_point(CzReportTable *table, const CzSweep *sweep, const CzSweepPoint *point) {
    char text[CZ_FIGURE_SIZE];
    const CzPointStyle look = cz_point_style(point);
    for (int k = 0; k < sweep->n_axis; k++)
        cz_table_put(table, cz_figure_digits(text, 6, point->value[k]));
    cz_table_put_styled(table, look.word, look.style);
    cz_table_put(table, cz_figure_margin(text, point->margin));
    for (int k = 0; k < sweep->n_metric; k++) {
        const char *unit = isfinite(point->metric[k]) ? sweep->metric_unit[k] : "";
        cz_figure_plain(text, point->metric[k]);
        cz_table_put_format(table, "%s%s%s", cz_figure_mark(text, point->beyond_validity),
                            unit[0] != '\0' ? " " : "", unit);
    }
    cz_table_put(table, point->check[0] != '\0' ? point->check : point->message);
    cz_table_put(table, point->where);
    cz_table_put(table, point->scenario);
}

/* Adds a column of numbers; on a terminal with the last key of the path only. */
static void add_head(CzReportTable *table, const char *path, bool whole) {
    char head[CZ_PATH_SIZE + 1];
    const char *dot = strrchr(path, '.');
    snprintf(head, sizeof head, ">%s", dot != NULL && !whole ? dot + 1 : path);
    cz_table_head(table, head);
}

void cz_sweep_begin_points(CzReportTable *table, const CzSweep *sweep, bool on_page) {
    cz_table_begin(table, NULL);
    for (int k = 0; k < sweep->n_axis; k++)
        add_head(table, sweep->axis[k].path, on_page);
    cz_table_head(table, on_page ? "verdict" : "");
    cz_table_head(table, ">margin");
    for (int k = 0; k < sweep->n_metric; k++)
        add_head(table, sweep->metric[k], true);
    cz_table_head(table, "smallest margin");
    cz_table_head(table, "where");
    cz_table_head(table, "scenario");
    for (int i = sweep->begin; i < sweep->end; i++)
        put_point(table, sweep, &sweep->point[i]);
}

int cz_sweep_unreached_sentence(const CzSweep *sweep, int index, char text[CZ_SENTENCE_SIZE]) {
    enum { MAX_NAMED = 8 };
    const CzUnreached *first = &sweep->unreached[index];
    int n = 1, at;
    while (index + n < sweep->n_unreached && first[n].axis == first->axis &&
           strcmp(first[n].by, first->by) == 0)
        n++;
    at = snprintf(text, CZ_SENTENCE_SIZE, "%s does not reach scenario%s ",
                  sweep->axis[first->axis].path, n > 1 ? "s" : "");
    for (int k = 0; k < n && k < MAX_NAMED; k++)
        at += snprintf(text + at, (size_t)(CZ_SENTENCE_SIZE - at), "%s%.48s", k > 0 ? ", " : "",
                       first[k].scenario);
    if (n > MAX_NAMED)
        at += snprintf(text + at, (size_t)(CZ_SENTENCE_SIZE - at), " and %d more", n - MAX_NAMED);
    snprintf(text + at, (size_t)(CZ_SENTENCE_SIZE - at), ", which set%s %s %s", n > 1 ? "" : "s",
             first->by, n > 1 ? "themselves" : "itself");
    return n;
}

/* The values of an axis: from the first to the last, or the list. */
static void write_values(const CzSweepAxis *axis, CzTerminal *terminal) {
    char from[CZ_FIGURE_SIZE], to[CZ_FIGURE_SIZE];
    if (!axis->is_list)
        fprintf(terminal->stream, "%s to %s", cz_figure_digits(from, 6, axis->from),
                cz_figure_digits(to, 6, axis->to));
    for (int i = 0; i < axis->n && axis->is_list; i++)
        fprintf(terminal->stream, "%s%s", i > 0 ? ", " : "",
                cz_figure_digits(from, 6, axis->listed[i]));
}

/* The map: a row per value of the first path, a sign per value of the second. */
static void write_map(const CzSweep *sweep, CzTerminal *terminal) {
    const CzSweepAxis *down = &sweep->axis[0], *across = &sweep->axis[1];
    char from[CZ_FIGURE_SIZE];
    cz_terminal_print(terminal, CZ_STYLE_PLAIN, "across: %s, ", across->path);
    write_values(across, terminal);
    fputc('\n', terminal->stream);
    cz_terminal_print(terminal, CZ_STYLE_PLAIN, "down:   %s\n\n", down->path);
    for (int row = 0; row < down->n; row++) {
        fprintf(terminal->stream, "%12s  ",
                cz_figure_digits(from, 6, cz_sweep_axis_value(down, row)));
        for (int column = 0; column < across->n; column++) {
            const CzPointStyle look = cz_point_style(&sweep->point[row * across->n + column]);
            cz_terminal_print(terminal, look.style, "%s", look.sign);
            fputc(column + 1 < across->n ? ' ' : '\n', terminal->stream);
        }
    }
    fputs("\n" CZ_MAP_SIGNS "\n", terminal->stream);
}

/* Reasons why points of a map failed or are invalid, each reason once, with the first point that
 * has it. */
static void write_reasons(const CzSweep *sweep, CzTerminal *terminal) {
    enum { MAX_REASONS = 8 };
    char down[CZ_FIGURE_SIZE], across[CZ_FIGURE_SIZE];
    for (int i = 0, n = 0; i < sweep->n_point && n < MAX_REASONS; i++) {
        const CzSweepPoint *point = &sweep->point[i];
        bool is_known = point->state == CZ_SWEEP_DONE || point->message[0] == '\0';
        for (int k = 0; k < i && !is_known; k++)
            is_known = sweep->point[k].state == point->state &&
                       strcmp(sweep->point[k].message, point->message) == 0;
        if (is_known)
            continue;
        n++;
        cz_terminal_print(terminal, CZ_STYLE_PLAIN, "%s at %s, %s: %s\n",
                          cz_point_style(point).sign, cz_figure_digits(down, 6, point->value[0]),
                          cz_figure_digits(across, 6, point->value[1]), point->message);
    }
}

static void write_worst(const CzSweep *sweep, CzTerminal *terminal) {
    if (sweep->worst < 0) {
        fputs("No point has a margin.\n", terminal->stream);
        return;
    }
    const CzSweepPoint *worst = &sweep->point[sweep->worst];
    const CzPointStyle look = cz_point_style(worst);
    char text[CZ_FIGURE_SIZE];
    fputs("Worst: ", terminal->stream);
    for (int k = 0; k < sweep->n_axis; k++)
        cz_terminal_print(terminal, CZ_STYLE_PLAIN, "%s = %s, ", sweep->axis[k].path,
                          cz_figure_digits(text, 6, worst->value[k]));
    cz_terminal_print(terminal, look.style, "%s", look.word);
    if (worst->state == CZ_SWEEP_DONE && worst->check[0] != '\0') {
        cz_terminal_print(terminal, CZ_STYLE_PLAIN, ": %s%s%s in %s", worst->check,
                          worst->where[0] != '\0' ? " at " : "", worst->where, worst->scenario);
        if (!isnan(worst->margin))
            fprintf(terminal->stream, ", margin %s", cz_figure_margin(text, worst->margin));
    } else {
        cz_terminal_print(terminal, CZ_STYLE_PLAIN, ": %s", worst->message);
    }
    fputs(".\n", terminal->stream);
}

void cz_sweep_write_table(const CzReport *report, CzTerminal *terminal) {
    const CzSweep *sweep = report->sweep;
    CzReportTable table;
    cz_terminal_print(terminal, CZ_STYLE_PLAIN, "%s\n", cz_problem_title(sweep->problem));
    if (sweep->n_shard > 1)
        cz_terminal_print(terminal, CZ_STYLE_PLAIN, "Shard %d of %d: points %d to %d of %d.\n",
                          sweep->shard, sweep->n_shard, sweep->begin + 1, sweep->end,
                          sweep->n_point);
    char sentence[CZ_SENTENCE_SIZE];
    for (int i = 0; i < sweep->n_unreached;) {
        i += cz_sweep_unreached_sentence(sweep, i, sentence);
        cz_terminal_print(terminal, CZ_STYLE_CAREFUL, "warning");
        cz_terminal_print(terminal, CZ_STYLE_PLAIN, ": %s.\n", sentence);
    }
    fputc('\n', terminal->stream);
    if (sweep->n_axis == 1) {
        cz_sweep_begin_points(&table, sweep, false);
        cz_table_write_text(&table, terminal);
    } else {
        write_map(sweep, terminal);
        write_reasons(sweep, terminal);
    }
    if (cz_sweep_is_beyond(sweep))
        cz_terminal_print(terminal, CZ_STYLE_BAD, CZ_SWEEP_BEYOND "\n");
    write_worst(sweep, terminal);
    cz_screening_print(sweep->problem, terminal);
    if (sweep->is_interrupted)
        cz_terminal_print(terminal, CZ_STYLE_BAD,
                          "INTERRUPTED: points or their curves are missing.\n");
}
