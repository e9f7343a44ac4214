/* What a sweep answers: a line per value, or a map of two variables; the document
 * `crushzone.sweep`; a folder. */
#include "crushzone/report.h"

#include "report/csv.h"
#include "report/documents.h"
#include "report/figure.h"
#include "report/folder.h"
#include "report/grid.h"
#include "report/page_sweep.h"

#include <math.h>
#include <string.h>

enum { MOST_COLUMNS = 12, FIRST_METRIC = 3 };

/* ---- terminal -------------------------------------------------------------------------------- */

/* How a point is told: as a word, as one sign of a map, in which style. */
typedef struct Telling {
    const char *word;
    char sign;
    CzStyle style;
} Telling;

static Telling telling_of(const CzSweepPoint *point) {
    static const Telling of_state[] = {[CZ_SWEEP_RUN_FAILED] = {"RUN FAILED", '!', CZ_STYLE_BAD},
                                       [CZ_SWEEP_INVALID] = {"invalid", '-', CZ_STYLE_PLAIN},
                                       [CZ_SWEEP_NOT_RUN] = {"not run", ' ', CZ_STYLE_PLAIN}};
    static const Telling of_verdict[] = {
        [CZ_VERDICT_PASS] = {"pass", '+', CZ_STYLE_GOOD},
        [CZ_VERDICT_PROVISIONAL] = {"PROVISIONAL", '~', CZ_STYLE_CAREFUL},
        [CZ_VERDICT_FAIL] = {"FAIL", 'X', CZ_STYLE_BAD},
        [CZ_VERDICT_NOT_CHECKED] = {"NOT CHECKED", '?', CZ_STYLE_CAREFUL}};
    return point->state == CZ_SWEEP_DONE ? of_verdict[point->verdict] : of_state[point->state];
}

static const char *value_text(char text[CZ_FIGURE_ROOM], double value) {
    return cz_figure_digits(text, 6, value == 0 ? 0 : value);
}

static void put_point(CzGrid *grid, const CzSweep *sweep, const CzSweepPoint *point) {
    char text[CZ_FIGURE_ROOM], value[CZ_FIGURE_ROOM + 16];
    const Telling telling = telling_of(point);
    cz_grid_put(grid, value_text(text, point->value[0]), CZ_STYLE_PLAIN);
    cz_grid_put(grid, telling.word, telling.style);
    cz_grid_put(grid, cz_figure_margin(text, point->margin), CZ_STYLE_PLAIN);
    for (int k = 0; k < sweep->n_metric; k++) {
        const char *unit = sweep->metric_unit[k];
        cz_figure_plain(text, point->metric[k]);
        snprintf(value, sizeof value, "%s%s%s", cz_figure_mark(text, point->beyond_validity),
                 isfinite(point->metric[k]) && unit[0] != '\0' ? " " : "",
                 isfinite(point->metric[k]) ? unit : "");
        cz_grid_put(grid, value, CZ_STYLE_PLAIN);
    }
    const bool has_check = point->check[0] != '\0';
    cz_grid_put(grid, has_check ? point->check : point->message, CZ_STYLE_PLAIN);
    cz_grid_put(grid, point->where, CZ_STYLE_PLAIN);
    cz_grid_put(grid, point->scenario, CZ_STYLE_PLAIN);
}

static bool write_line_per_value(const CzSweep *sweep, bool colour, FILE *stream) {
    bool is_whole = true;
    char alignment[MOST_COLUMNS + CZ_MOST_SWEPT_METRICS] = "rlr";
    for (int k = 0; k < sweep->n_metric; k++)
        alignment[FIRST_METRIC + k] = 'r';
    memcpy(alignment + FIRST_METRIC + sweep->n_metric, "lll", 4);
    const char *dot = strrchr(sweep->axis[0].path, '.');
    CzGrid grid;
    cz_grid_begin(&grid, alignment);
    cz_grid_put(&grid, dot != NULL ? dot + 1 : sweep->axis[0].path, CZ_STYLE_PLAIN);
    cz_grid_put(&grid, "", CZ_STYLE_PLAIN);
    cz_grid_put(&grid, "margin", CZ_STYLE_PLAIN);
    for (int k = 0; k < sweep->n_metric; k++)
        cz_grid_put(&grid, sweep->metric[k], CZ_STYLE_PLAIN);
    cz_grid_put(&grid, "smallest margin", CZ_STYLE_PLAIN);
    cz_grid_put(&grid, "where", CZ_STYLE_PLAIN);
    cz_grid_put(&grid, "scenario", CZ_STYLE_PLAIN);
    for (int i = 0; i < sweep->n_point; i++)
        put_point(&grid, sweep, &sweep->point[i]);
    is_whole &= cz_grid_write(&grid, colour, stream);
    return is_whole;
}

/* The map: a row per value of the first path, a sign per value of the second. */
static void write_map(const CzSweep *sweep, bool colour, FILE *stream) {
    const int n_row = sweep->axis[0].n, n_column = sweep->axis[1].n;
    char text[CZ_FIGURE_ROOM];
    fputs("across: ", stream);
    cz_grid_write_text(sweep->axis[1].path, CZ_STYLE_PLAIN, colour, stream);
    fprintf(stream, ", %s to ", value_text(text, sweep->axis[1].from));
    fprintf(stream, "%s\n", value_text(text, sweep->axis[1].to));
    fputs("down:   ", stream);
    cz_grid_write_text(sweep->axis[0].path, CZ_STYLE_PLAIN, colour, stream);
    fputs("\n\n", stream);
    for (int row = 0; row < n_row; row++) {
        fprintf(stream, "%12s  ", value_text(text, cz_sweep_axis_value(&sweep->axis[0], row)));
        for (int column = 0; column < n_column; column++) {
            const Telling telling = telling_of(&sweep->point[row * n_column + column]);
            const char sign[] = {telling.sign, '\0'};
            cz_grid_write_text(sign, telling.style, colour, stream);
            fputc(column + 1 < n_column ? ' ' : '\n', stream);
        }
    }
    fputs("\n+ pass   ~ provisional   X FAIL   ? not checked   ! run failed   - invalid\n", stream);
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
        cz_grid_write_text(sweep->axis[k].path, CZ_STYLE_PLAIN, colour, stream);
        fprintf(stream, " = %s, ", value_text(text, worst->value[k]));
    }
    const Telling telling = telling_of(worst);
    cz_grid_write_text(telling.word, telling.style, colour, stream);
    if (worst->state == CZ_SWEEP_DONE && worst->check[0] != '\0') {
        fputs(": ", stream);
        cz_grid_write_text(worst->check, CZ_STYLE_PLAIN, colour, stream);
        fprintf(stream, "%s%s in %s", worst->where[0] != '\0' ? " at " : "", worst->where,
                worst->scenario);
        if (!isnan(worst->margin))
            fprintf(stream, ", margin %s", cz_figure_margin(text, worst->margin));
    } else {
        fputs(": ", stream);
        cz_grid_write_text(worst->message, CZ_STYLE_PLAIN, colour, stream);
    }
    fputs(".\n", stream);
}

CzStatus cz_report_write_sweep_table(const CzSweep *sweep, bool colour, FILE *stream) {
    bool is_whole = true;
    cz_grid_write_text(cz_problem_title(sweep->problem), CZ_STYLE_PLAIN, colour, stream);
    fputs("\n\n", stream);
    if (sweep->n_axis == 1)
        is_whole &= write_line_per_value(sweep, colour, stream);
    else
        write_map(sweep, colour, stream);
    if (cz_sweep_is_beyond(sweep)) {
        cz_grid_write_text("Override: some points went beyond model validity (" CZ_FIGURE_MARK_MEANS
                           ").",
                           CZ_STYLE_BAD, colour, stream);
        fputc('\n', stream);
    }
    write_worst(sweep, colour, stream);
    if (sweep->is_interrupted) {
        cz_grid_write_text("INTERRUPTED: not every point was run.", CZ_STYLE_BAD, colour, stream);
        fputc('\n', stream);
    }
    return is_whole ? CZ_OK : CZ_STATUS_NO_MEMORY;
}

/* ---- document -------------------------------------------------------------------------------- */

static void put_json_point(CzJson *json, const CzSweep *sweep, const CzSweepPoint *point) {
    cz_json_open_object(json, NULL);
    cz_json_open_list(json, "value");
    for (int k = 0; k < sweep->n_axis; k++)
        cz_json_exact(json, NULL, point->value[k]);
    cz_json_close(json);
    cz_json_text(json, "state", cz_sweep_state_text(point->state));
    if (point->state == CZ_SWEEP_DONE)
        cz_document_verdict(json, point->verdict);
    else
        cz_json_text(json, "verdict", NULL);
    cz_json_flag(json, "beyond_validity", point->beyond_validity);
    cz_json_exact(json, "margin", point->margin);
    cz_json_text(json, "check", point->check[0] != '\0' ? point->check : NULL);
    cz_json_text(json, "scenario", point->scenario[0] != '\0' ? point->scenario : NULL);
    cz_json_text(json, "where", point->where[0] != '\0' ? point->where : NULL);
    cz_json_open_list(json, "metrics");
    for (int k = 0; k < sweep->n_metric; k++) {
        cz_json_open_object(json, NULL);
        cz_json_exact(json, "value", point->metric[k]);
        cz_json_text(json, "where", point->metric_where[k]);
        cz_json_close(json);
    }
    cz_json_close(json);
    cz_json_text(json, "message", point->message[0] != '\0' ? point->message : NULL);
    cz_json_close(json);
}

CzStatus cz_report_write_sweep(const CzSweep *sweep, const CzReportOptions *options, FILE *stream,
                               CzError *error) {
    const CzReportOptions absent = cz_report_options_default();
    if (options == NULL)
        options = &absent;
    CzJson *json = cz_json_create();
    cz_document_head(json, "crushzone.sweep", sweep->problem);
    cz_json_text(json, "status", sweep->is_interrupted ? "interrupted" : "completed");
    cz_document_run_info(json, sweep->wall_s, options->setup_s, options->n_job);
    cz_json_open_list(json, "axes");
    for (int k = 0; k < sweep->n_axis; k++) {
        cz_json_open_object(json, NULL);
        cz_json_text(json, "path", sweep->axis[k].path);
        cz_json_exact(json, "from", sweep->axis[k].from);
        cz_json_exact(json, "to", sweep->axis[k].to);
        cz_json_whole(json, "n", sweep->axis[k].n);
        cz_json_close(json);
    }
    cz_json_close(json);
    cz_json_open_list(json, "metrics");
    for (int k = 0; k < sweep->n_metric; k++) {
        cz_json_open_object(json, NULL);
        cz_json_text(json, "name", sweep->metric[k]);
        cz_json_text(json, "unit", sweep->metric_unit[k]);
        cz_json_close(json);
    }
    cz_json_close(json);
    if (sweep->worst >= 0)
        cz_json_whole(json, "worst", sweep->worst);
    else
        cz_json_text(json, "worst", NULL);
    cz_json_open_list(json, "points");
    for (int i = 0; i < sweep->n_point; i++)
        put_json_point(json, sweep, &sweep->point[i]);
    cz_json_close(json);
    return cz_json_finish(json, stream, error);
}

/* ---- folder ---------------------------------------------------------------------------------- */

static CzStatus write_files(CzFolder *folder, const CzSweep *sweep, const CzReportOptions *options,
                            CzError *error) {
    FILE *stream = NULL;
    CzStatus status = cz_folder_open(folder, "sweep.json", &stream, error);
    if (status == CZ_OK)
        status = cz_report_write_sweep(sweep, options, stream, error);
    if (status == CZ_OK)
        status = cz_folder_close(folder, error);
    if (status == CZ_OK)
        status = cz_folder_open(folder, "sweep.csv", &stream, error);
    if (status != CZ_OK)
        return status;
    cz_csv_write_sweep(sweep, options, stream);
    status = cz_folder_close(folder, error); /* a full disk shows here */
    if (status == CZ_OK)
        status = cz_folder_open(folder, "report.html", &stream, error);
    if (status == CZ_OK)
        status = cz_page_write_sweep(sweep, stream, error);
    return status == CZ_OK ? cz_folder_close(folder, error) : status;
}

CzStatus cz_report_write_sweep_folder(const CzSweep *sweep, const CzReportOptions *options,
                                      const char *path, CzError *error) {
    const CzReportOptions absent = cz_report_options_default();
    CzFolder folder;
    options = options != NULL ? options : &absent;
    CzStatus status = cz_folder_begin(&folder, path, options->replaces_search, error);
    if (status != CZ_OK)
        return status;
    status = write_files(&folder, sweep, options, error);
    if (status == CZ_OK)
        return cz_folder_finish(&folder, error);
    cz_folder_abandon(&folder);
    return status;
}
