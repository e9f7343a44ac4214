/* What a sweep answers: a line per value, or a map of two variables. */
#include "crushzone/report.h"

#include "report/figure.h"
#include "report/table.h"
#include "report/page_sweep.h"

#include <math.h>
#include <string.h>

CzPointLook cz_point_look(const CzSweepPoint *point) {
    static const CzPointLook of_state[] = {
        [CZ_SWEEP_RUN_FAILED] = {"RUN FAILED", "!", "#5c0010", CZ_STYLE_BAD},
        [CZ_SWEEP_INVALID] = {"invalid", "-", "#9a9a9a", CZ_STYLE_PLAIN},
        [CZ_SWEEP_NOT_RUN] = {"not run", " ", "none", CZ_STYLE_PLAIN}};
    static const CzPointLook of_verdict[] = {
        [CZ_VERDICT_PASS] = {"pass", "+", "#009e73", CZ_STYLE_GOOD},
        [CZ_VERDICT_PROVISIONAL] = {"PROVISIONAL", "~", "#e69f00", CZ_STYLE_CAREFUL},
        [CZ_VERDICT_FAIL] = {"FAIL", "X", "#d0021b", CZ_STYLE_BAD},
        [CZ_VERDICT_NOT_CHECKED] = {"NOT CHECKED", "?", "#9a9a9a", CZ_STYLE_CAREFUL}};
    return point->state == CZ_SWEEP_DONE ? of_verdict[point->verdict] : of_state[point->state];
}

static void put_point(CzReportTable *table, const CzSweep *sweep, const CzSweepPoint *point) {
    char text[CZ_FIGURE_ROOM], value[CZ_FIGURE_ROOM + 16];
    const CzPointLook look = cz_point_look(point);
    for (int k = 0; k < sweep->n_axis; k++)
        cz_table_put(table, cz_figure_digits(text, 6, point->value[k]), CZ_STYLE_PLAIN);
    cz_table_put(table, look.word, look.style);
    cz_table_put(table, cz_figure_margin(text, point->margin), CZ_STYLE_PLAIN);
    for (int k = 0; k < sweep->n_metric; k++) {
        const char *unit = sweep->metric_unit[k];
        cz_figure_plain(text, point->metric[k]);
        snprintf(value, sizeof value, "%s%s%s", cz_figure_mark(text, point->beyond_validity),
                 isfinite(point->metric[k]) && unit[0] != '\0' ? " " : "",
                 isfinite(point->metric[k]) ? unit : "");
        cz_table_put(table, value, CZ_STYLE_PLAIN);
    }
    cz_table_put(table, point->check[0] != '\0' ? point->check : point->message, CZ_STYLE_PLAIN);
    cz_table_put(table, point->where, CZ_STYLE_PLAIN);
    cz_table_put(table, point->scenario, CZ_STYLE_PLAIN);
}

/* A column of numbers; a terminal has no room for a whole path. */
static void add_head(CzReportTable *table, const char *path, bool whole) {
    char head[CZ_PATH_ROOM + 1];
    const char *dot = strrchr(path, '.');
    snprintf(head, sizeof head, ">%s", dot != NULL && !whole ? dot + 1 : path);
    cz_table_head(table, head);
}

void cz_sweep_begin_points(CzReportTable *table, const CzSweep *sweep, bool on_page) {
    cz_table_begin(table, 0, NULL);
    for (int k = 0; k < sweep->n_axis; k++)
        add_head(table, sweep->axis[k].path, on_page);
    cz_table_head(table, on_page ? "verdict" : "");
    cz_table_head(table, ">margin");
    for (int k = 0; k < sweep->n_metric; k++)
        add_head(table, sweep->metric[k], true);
    cz_table_head(table, "smallest margin");
    cz_table_head(table, "where");
    cz_table_head(table, "scenario");
    for (int i = 0; i < sweep->n_point; i++)
        put_point(table, sweep, &sweep->point[i]);
}

/* The map: a row per value of the first path, a sign per value of the second. */
static void write_map(const CzSweep *sweep, bool colour, FILE *stream) {
    const int n_row = sweep->axis[0].n, n_column = sweep->axis[1].n;
    char text[CZ_FIGURE_ROOM];
    fputs("across: ", stream);
    cz_text_write(sweep->axis[1].path, CZ_STYLE_PLAIN, colour, stream);
    fprintf(stream, ", %s to ", cz_figure_digits(text, 6, sweep->axis[1].from));
    fprintf(stream, "%s\n", cz_figure_digits(text, 6, sweep->axis[1].to));
    fputs("down:   ", stream);
    cz_text_write(sweep->axis[0].path, CZ_STYLE_PLAIN, colour, stream);
    fputs("\n\n", stream);
    for (int row = 0; row < n_row; row++) {
        fprintf(stream, "%12s  ",
                cz_figure_digits(text, 6, cz_sweep_axis_value(&sweep->axis[0], row)));
        for (int column = 0; column < n_column; column++) {
            const CzPointLook look = cz_point_look(&sweep->point[row * n_column + column]);
            cz_text_write(look.sign, look.style, colour, stream);
            fputc(column + 1 < n_column ? ' ' : '\n', stream);
        }
    }
    fputs("\n+ pass   ~ provisional   X FAIL   ? not checked   ! run failed   - invalid\n", stream);
}

/* Why points of a map failed or are invalid, each reason once, with the first point that has it. */
static void write_reasons(const CzSweep *sweep, bool colour, FILE *stream) {
    enum { MOST_REASONS = 8 };
    char text[CZ_FIGURE_ROOM];
    for (int i = 0, n = 0; i < sweep->n_point && n < MOST_REASONS; i++) {
        const CzSweepPoint *point = &sweep->point[i];
        bool is_known = point->state == CZ_SWEEP_DONE || point->message[0] == '\0';
        for (int k = 0; k < i && !is_known; k++)
            is_known = sweep->point[k].state == point->state &&
                       strcmp(sweep->point[k].message, point->message) == 0;
        if (is_known)
            continue;
        n++;
        fprintf(stream, "%s at %s", cz_point_look(point).sign,
                cz_figure_digits(text, 6, point->value[0]));
        fprintf(stream, ", %s: ", cz_figure_digits(text, 6, point->value[1]));
        cz_text_write(point->message, CZ_STYLE_PLAIN, colour, stream);
        fputc('\n', stream);
    }
}

static void write_worst(const CzSweep *sweep, bool colour, FILE *stream) {
    if (sweep->worst < 0) {
        fputs("No point has a margin.\n", stream);
        return;
    }
    const CzSweepPoint *worst = &sweep->point[sweep->worst];
    char text[CZ_FIGURE_ROOM];
    fputs("Worst: ", stream);
    for (int k = 0; k < sweep->n_axis; k++) {
        cz_text_write(sweep->axis[k].path, CZ_STYLE_PLAIN, colour, stream);
        fprintf(stream, " = %s, ", cz_figure_digits(text, 6, worst->value[k]));
    }
    cz_text_write(cz_point_look(worst).word, cz_point_look(worst).style, colour, stream);
    if (worst->state == CZ_SWEEP_DONE && worst->check[0] != '\0') {
        fputs(": ", stream);
        cz_text_write(worst->check, CZ_STYLE_PLAIN, colour, stream);
        fprintf(stream, "%s%s in %s", worst->where[0] != '\0' ? " at " : "", worst->where,
                worst->scenario);
        if (!isnan(worst->margin))
            fprintf(stream, ", margin %s", cz_figure_margin(text, worst->margin));
    } else {
        fputs(": ", stream);
        cz_text_write(worst->message, CZ_STYLE_PLAIN, colour, stream);
    }
    fputs(".\n", stream);
}

CzStatus cz_report_write_sweep_table(const CzSweep *sweep, bool colour, FILE *stream) {
    bool is_whole = true;
    CzReportTable table;
    cz_text_write(cz_problem_title(sweep->problem), CZ_STYLE_PLAIN, colour, stream);
    fputs("\n\n", stream);
    if (sweep->n_axis == 1) {
        cz_sweep_begin_points(&table, sweep, false);
        is_whole = cz_table_write_text(&table, colour, stream);
    } else {
        write_map(sweep, colour, stream);
        write_reasons(sweep, colour, stream);
    }
    if (cz_sweep_is_beyond(sweep)) {
        cz_text_write("Override: some points went beyond model validity (" CZ_FIGURE_MARK_MEANS
                      ").",
                      CZ_STYLE_BAD, colour, stream);
        fputc('\n', stream);
    }
    write_worst(sweep, colour, stream);
    if (sweep->is_interrupted) {
        cz_text_write("INTERRUPTED: points are missing.", CZ_STYLE_BAD, colour, stream);
        fputc('\n', stream);
    }
    return is_whole ? CZ_OK : CZ_STATUS_NO_MEMORY;
}
