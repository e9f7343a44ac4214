/* What a verification answers: a table of the numbers that change most, and the document
 * `crushzone.verification`. */
#include "crushzone/report.h"

#include "report/documents.h"
#include "report/figure.h"
#include "report/grid.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { MOST_ROWS = 12 }; /* of the table: the rest changes less and stands in the document */

/* ---- terminal -------------------------------------------------------------------------------- */

static double largest_of(const CzVerifiedValue *value) {
    double largest = 0.0;
    for (int way = 0; way < CZ_N_VERIFY_WAY; way++) {
        largest = fmax(largest, value->change[way]);
        largest = value->flips[way] ? INFINITY : largest;
    }
    return largest;
}

/* Verdicts that flip first, then the largest change; the order of the list where they are equal. */
static int by_change(const void *a, const void *b) {
    const CzVerifiedValue *const *p = a, *const *q = b;
    const double first = largest_of(*p), second = largest_of(*q);
    if (first != second)
        return first > second ? -1 : 1;
    return *p < *q ? -1 : *p > *q;
}

static void put_row(CzGrid *grid, const CzVerification *verification,
                    const CzVerifiedValue *value) {
    char text[CZ_FIGURE_ROOM], record[CZ_FIGURE_ROOM + 16];
    const char *unit = value->unit != NULL ? value->unit : "";
    cz_grid_put(grid, value->name, CZ_STYLE_PLAIN);
    cz_grid_put(grid, value->where, CZ_STYLE_PLAIN);
    cz_grid_put(grid, value->scenario, CZ_STYLE_PLAIN);
    cz_figure_plain(text, value->record);
    snprintf(record, sizeof record, "%s%s%s", cz_figure_mark(text, value->beyond_validity),
             unit[0] != '\0' ? " " : "", unit);
    cz_grid_put(grid, record, CZ_STYLE_PLAIN);
    for (int way = 0; way < CZ_N_VERIFY_WAY; way++) {
        if ((verification->ways & (1u << way)) == 0)
            continue;
        const bool bad = value->flips[way] || value->change[way] > verification->limit;
        cz_grid_put(grid, value->flips[way] ? "FLIPS" : cz_figure_change(text, value->change[way]),
                    bad ? CZ_STYLE_BAD : CZ_STYLE_PLAIN);
    }
}

static bool write_values(const CzVerification *verification, bool colour, FILE *stream) {
    bool is_whole = true;
    const size_t n = (size_t)verification->n_value;
    const CzVerifiedValue **value = calloc(n + 1, sizeof *value);
    if (value == NULL)
        return false;
    for (size_t i = 0; i < n; i++)
        value[i] = &verification->value[i];
    qsort(value, n, sizeof *value, by_change);
    char columns[5 + CZ_N_VERIFY_WAY] = "lllr";
    for (int way = 0; way < CZ_N_VERIFY_WAY; way++)
        if ((verification->ways & (1u << way)) != 0)
            columns[strlen(columns)] = 'r';
    CzGrid grid;
    cz_grid_begin(&grid, columns);
    static const char *const names[] = {"changes most", "where", "scenario", "record"};
    for (int i = 0; i < 4; i++)
        cz_grid_put(&grid, names[i], CZ_STYLE_PLAIN);
    for (int way = 0; way < CZ_N_VERIFY_WAY; way++)
        if ((verification->ways & (1u << way)) != 0)
            cz_grid_put(&grid, cz_verify_way_text((CzVerifyWay)way), CZ_STYLE_PLAIN);
    for (size_t i = 0; i < n && i < MOST_ROWS; i++)
        put_row(&grid, verification, value[i]);
    is_whole &= cz_grid_write(&grid, colour, stream);
    free(value);
    return is_whole;
}

static bool write_ways(const CzVerification *verification, bool colour, FILE *stream) {
    bool is_whole = true;
    static const char *const names[] = {"by", "largest change", "verdicts that flip"};
    char text[CZ_FIGURE_ROOM];
    CzGrid grid;
    cz_grid_begin(&grid, "lrr");
    for (int i = 0; i < 3; i++)
        cz_grid_put(&grid, names[i], CZ_STYLE_PLAIN);
    for (int way = 0; way < CZ_N_VERIFY_WAY; way++) {
        const double change = verification->largest_change[way];
        if ((verification->ways & (1u << way)) == 0)
            continue;
        const bool bad = !verification->is_done[way] || !(change <= verification->limit) ||
                         verification->n_flip[way] > 0;
        cz_grid_put(&grid, cz_verify_way_text((CzVerifyWay)way), CZ_STYLE_PLAIN);
        cz_grid_put(&grid, verification->is_done[way] ? cz_figure_change(text, change) : "not done",
                    bad ? CZ_STYLE_BAD : CZ_STYLE_PLAIN);
        snprintf(text, sizeof text, "%d", verification->n_flip[way]);
        cz_grid_put(&grid, text, verification->n_flip[way] > 0 ? CZ_STYLE_BAD : CZ_STYLE_PLAIN);
    }
    is_whole &= cz_grid_write(&grid, colour, stream);
    return is_whole;
}

static bool changes_too_much(const CzVerification *verification, const CzVerifiedValue *value) {
    for (int way = 0; way < CZ_N_VERIFY_WAY; way++)
        if (value->change[way] > verification->limit)
            return true;
    return false;
}

/* How many of the numbers that change too much scatter as much by themselves, so that nothing would
 * pin them down. */
static void write_scatter(const CzVerification *verification, FILE *stream) {
    int n = 0, n_scatter = 0;
    for (int i = 0; i < verification->n_value; i++) {
        const CzVerifiedValue *value = &verification->value[i];
        n += changes_too_much(verification, value);
        n_scatter += value->change[CZ_WAY_SCATTER] > verification->limit;
    }
    char text[CZ_FIGURE_ROOM];
    if (n > 0 && verification->is_done[CZ_WAY_SCATTER])
        fprintf(stream, "%d of %d numbers change by more than %s; %d of them scatter by more.\n", n,
                verification->n_value, cz_figure_change(text, verification->limit), n_scatter);
}

CzStatus cz_report_write_verification_table(const CzProblem *problem,
                                            const CzVerification *verification, bool colour,
                                            FILE *stream) {
    bool is_whole = true;
    char text[CZ_FIGURE_ROOM];
    cz_grid_write_text(cz_problem_title(problem), CZ_STYLE_PLAIN, colour, stream);
    fputs("\n\n", stream);
    if (verification->n_value > 0) {
        is_whole &= write_values(verification, colour, stream);
        fputc('\n', stream);
        is_whole &= write_ways(verification, colour, stream);
        fputc('\n', stream);
    }
    if (verification->failure[0] != '\0') {
        cz_grid_write_text(verification->failure, CZ_STYLE_BAD, colour, stream);
        fputc('\n', stream);
    }
    write_scatter(verification, stream);
    const bool passes = verification->verdict == CZ_VERDICT_PASS;
    fputs("Verification: ", stream);
    cz_grid_write_text(passes ? "pass" : "FAIL", passes ? CZ_STYLE_GOOD : CZ_STYLE_BAD, colour,
                       stream);
    fprintf(stream, " (%d numbers, %s allowed)\n", verification->n_value,
            cz_figure_change(text, verification->limit));
    return is_whole ? CZ_OK : CZ_STATUS_NO_MEMORY;
}

/* ---- document -------------------------------------------------------------------------------- */

static void put_value(CzJson *json, const CzVerifiedValue *value) {
    cz_json_open_object(json, NULL);
    cz_json_text(json, "name", value->name);
    cz_json_text(json, "scenario", value->scenario[0] != '\0' ? value->scenario : NULL);
    cz_json_text(json, "where", value->where[0] != '\0' ? value->where : NULL);
    cz_json_text(json, "unit", value->unit);
    cz_json_exact(json, "record", value->record);
    cz_json_flag(json, "beyond_validity", value->beyond_validity);
    for (int way = 0; way < CZ_N_VERIFY_WAY; way++) {
        cz_json_open_object(json, cz_verify_way_key((CzVerifyWay)way));
        cz_json_exact(json, "value", value->value[way]);
        cz_json_exact(json, "change", value->change[way]);
        cz_json_flag(json, "flips", value->flips[way]);
        cz_json_close(json);
    }
    cz_json_close(json);
}

static void put_way(CzJson *json, const CzVerification *verification, CzVerifyWay way) {
    const int worst = verification->worst[way];
    const CzVerifiedValue *value = worst >= 0 ? &verification->value[worst] : NULL;
    cz_json_open_object(json, cz_verify_way_key(way));
    cz_json_flag(json, "done", verification->is_done[way]);
    cz_json_exact(json, "largest_change", verification->largest_change[way]);
    cz_json_text(json, "of", value != NULL ? value->name : NULL);
    cz_json_text(json, "where", value != NULL && value->where[0] != '\0' ? value->where : NULL);
    cz_json_text(json, "scenario",
                 value != NULL && value->scenario[0] != '\0' ? value->scenario : NULL);
    cz_json_whole(json, "flips", verification->n_flip[way]);
    cz_json_close(json);
}

void cz_document_verified_ways(CzJson *json, const CzVerification *verification) {
    cz_json_open_object(json, "ways");
    for (int way = 0; way < CZ_N_VERIFY_WAY; way++)
        put_way(json, verification, (CzVerifyWay)way);
    cz_json_close(json);
}

static void put_times(CzJson *json, const CzVerification *verification,
                      const CzReportOptions *options) {
    double wall_s = 0.0;
    for (int way = 0; way < CZ_N_VERIFY_WAY; way++)
        wall_s += verification->wall_s[way];
    cz_document_run_info(json, wall_s, options->setup_s, options->n_job);
}

CzStatus cz_report_write_verification(const CzProblem *problem, const CzVerification *verification,
                                      const CzReportOptions *options, FILE *stream,
                                      CzError *error) {
    const CzReportOptions absent = cz_report_options_default();
    if (options == NULL)
        options = &absent;
    CzJson *json = cz_json_create();
    cz_document_head(json, "crushzone.verification", problem);
    cz_json_text(json, "status", verification->status == CZ_OK ? "completed" : "failed");
    cz_json_text(json, "failure", verification->failure[0] != '\0' ? verification->failure : NULL);
    cz_json_text(json, "verdict", cz_verdict_text(verification->verdict));
    cz_json_exact(json, "limit", verification->limit);
    put_times(json, verification, options);
    cz_document_verified_ways(json, verification);
    cz_json_open_list(json, "values");
    for (int i = 0; i < verification->n_value; i++)
        put_value(json, &verification->value[i]);
    cz_json_close(json);
    return cz_json_finish(json, stream, error);
}
