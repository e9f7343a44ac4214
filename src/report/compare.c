/* Runs side by side on a terminal: what differs in checks, interfaces and cars. */
#include "crushzone/report.h"

#include "report/checks_table.h"
#include "report/compare.h"
#include "report/figure.h"
#include "report/grid.h"
#include "report/units.h"

#include <math.h>
#include <string.h>

int cz_compared_scenario(const CzReportRun *run, int i) {
    const int own = run[i].scenario >= 0 ? run[i].scenario : cz_page_deciding(run[i].evaluation);
    if (i == 0)
        return own;
    const CzRunSummary *first = cz_compared_run(run, 0);
    for (int k = 0; first != NULL && k < run[i].evaluation->n_run; k++) {
        const CzRunSummary *kept = cz_kept_run(run[i].evaluation, k);
        if (kept != NULL && strcmp(kept->scenario, first->scenario) == 0)
            return k;
    }
    return own;
}

const CzRunSummary *cz_compared_run(const CzReportRun *run, int i) {
    const int scenario = cz_compared_scenario(run, i);
    return scenario >= 0 && scenario < run[i].evaluation->n_run
               ? cz_kept_run(run[i].evaluation, scenario)
               : NULL;
}

const CzCheckResult *cz_compared_check(const CzReportRun *run, const CzCheckResult *check) {
    for (int i = 0; i < run->evaluation->n_check; i++) {
        const CzCheckResult *other = &run->evaluation->check[i];
        const bool same_scenario = other->scenario == check->scenario ||
                                   (other->scenario != NULL && check->scenario != NULL &&
                                    strcmp(other->scenario, check->scenario) == 0);
        if (same_scenario && strcmp(other->name, check->name) == 0)
            return other;
    }
    return NULL;
}

/* By more than a thousandth of what is allowed, or of what it is exceeded by. A margin knows the
 * scale of its quantity, so that values next to zero do not differ by shares of nothing. */
static bool differs_in_value(const CzCheckResult *check, const CzCheckResult *other) {
    const double share = 1e-3;
    if (check->limit != other->limit || isnan(check->margin) || isnan(other->margin))
        return fabs(other->value - check->value) >
               share * fmax(fabs(check->value), fabs(check->limit));
    return fabs(other->margin - check->margin) > share * fmax(fabs(check->margin), 1);
}

bool cz_compared_differs(int n, const CzReportRun *run, const CzCheckResult *check) {
    for (int i = 1; i < n; i++) {
        const CzCheckResult *other = cz_compared_check(&run[i], check);
        if (other == NULL || other->verdict != check->verdict ||
            isnan(other->value) != isnan(check->value) || differs_in_value(check, other))
            return true;
    }
    return false;
}

/* ---- numbers of interfaces and cars ---- */

static double peak_force(const CzRunSummary *run, int i) {
    return run->interface[i].peak_force / CZ_KILO;
}
static double closure(const CzRunSummary *run, int i) {
    return run->interface[i].shortening * CZ_MILLI_PER_UNIT;
}
static double energy(const CzRunSummary *run, int i) {
    return cz_run_total(run, run->interface[i].energy) / CZ_KILO;
}
static double stroke_used(const CzRunSummary *run, int i) {
    double used = 0;
    for (int k = 0; k < run->interface[i].n_element; k++)
        used = fmax(used, run->interface[i].element[k].stroke_used);
    return 100 * used;
}
static double mean_deceleration(const CzRunSummary *run, int i) {
    return run->vehicle[i].mean_deceleration_120ms / CZ_GRAVITY;
}
static double peak_deceleration(const CzRunSummary *run, int i) {
    return run->vehicle[i].peak_deceleration / CZ_GRAVITY;
}
static double wheel_lift(const CzRunSummary *run, int i) {
    double lift = NAN;
    for (int k = 0; k < 4; k++)
        lift = fmax(lift, run->vehicle[i].wheel_lift[k]);
    return lift * CZ_MILLI_PER_UNIT;
}

const CzComparedNumber cz_compared_numbers[CZ_N_COMPARED_NUMBER] = {
    {"peak force kN", "peak_force_kN", 1, true, peak_force},
    {"closure mm", "shortening_mm", 1, true, closure},
    {"stroke used %", "stroke_used", 0.01, true, stroke_used},
    {"energy kJ", "energy_kJ", 1, true, energy},
    {"mean g, 120 ms", "mean_deceleration_120ms_g", 1, false, mean_deceleration},
    {"peak g", "peak_deceleration_g", 1, false, peak_deceleration},
    {"wheel lift mm", "max_wheel_lift_mm", 1, false, wheel_lift}};

int cz_compared_count(const CzRunSummary *run, const CzComparedNumber *number) {
    return number->of_interface ? run->n_interface : run->n_vehicle;
}

const char *cz_compared_name(const CzRunSummary *run, const CzComparedNumber *number, int i) {
    return number->of_interface ? run->interface[i].name : run->vehicle[i].name;
}

double cz_compared_value(const CzReportRun *run, int i, const CzComparedNumber *number,
                         const char *name) {
    const CzRunSummary *summary = cz_compared_run(run, i);
    for (int k = 0; summary != NULL && k < cz_compared_count(summary, number); k++)
        if (strcmp(cz_compared_name(summary, number, k), name) == 0)
            return number->value(summary, k);
    return NAN;
}

bool cz_compared_is_beyond(const CzReportRun *run, int i) {
    const CzRunSummary *summary = cz_compared_run(run, i);
    return summary != NULL && summary->beyond_validity;
}

const char *cz_compared_text(char text[CZ_FIGURE_ROOM], const CzReportRun *run, int i,
                             const CzComparedNumber *number, const char *name) {
    cz_figure_plain(text, cz_compared_value(run, i, number, name));
    return cz_figure_mark(text, cz_compared_is_beyond(run, i));
}

const char *cz_compared_caution(int n, const CzReportRun *run) {
    for (int i = 0; i < n; i++)
        if (cz_compared_is_beyond(run, i))
            return "Override: a run went beyond model validity (" CZ_FIGURE_MARK_MEANS ").";
    return "";
}

/* ---- on the terminal ---- */

static bool write_checks(int n, const CzReportRun *run, bool colour, FILE *stream) {
    bool is_whole = true;
    const CzEvaluation *first = run[0].evaluation;
    int n_same = 0;
    char alignment[] = "llrrrrrrrr";
    alignment[2 + n] = '\0';
    CzGrid grid;
    cz_grid_begin(&grid, alignment);
    cz_grid_put(&grid, "check", CZ_STYLE_PLAIN);
    cz_grid_put(&grid, "limit", CZ_STYLE_PLAIN);
    for (int i = 0; i < n; i++)
        cz_grid_put(&grid, run[i].label, CZ_STYLE_PLAIN);
    for (int k = 0; k < first->n_check; k++) {
        const CzCheckResult *check = &first->check[k];
        char name[CZ_LABEL_ROOM + 1 + CZ_NAME_ROOM], text[160], value[96];
        if (!cz_compared_differs(n, run, check)) {
            n_same++;
            continue;
        }
        snprintf(name, sizeof name, "%s, %s", check->name,
                 check->scenario != NULL ? check->scenario : "");
        cz_grid_put(&grid, name, CZ_STYLE_PLAIN);
        cz_checks_format_limit(check, sizeof text, text);
        cz_grid_put(&grid, text, CZ_STYLE_PLAIN);
        for (int i = 0; i < n; i++) {
            const CzCheckResult *other = cz_compared_check(&run[i], check);
            if (other == NULL) {
                cz_grid_put(&grid, "-", CZ_STYLE_PLAIN);
                continue;
            }
            cz_checks_format_value(other, sizeof value, value);
            snprintf(text, sizeof text, "%s %s", value, cz_checks_word(other));
            cz_grid_put(&grid, text,
                        other->verdict == CZ_VERDICT_FAIL ? CZ_STYLE_BAD : CZ_STYLE_PLAIN);
        }
    }
    is_whole &= cz_grid_write(&grid, colour, stream);
    fprintf(stream, "%d check%s the same.\n\n", n_same, n_same == 1 ? " is" : "s are");
    return is_whole;
}

static bool write_numbers(int n, const CzReportRun *run, bool of_interface, bool colour,
                          FILE *stream) {
    bool is_whole = true;
    const CzRunSummary *first = cz_compared_run(run, 0);
    char alignment[] = "llrrrrrrrr";
    alignment[2 + n] = '\0';
    CzGrid grid;
    cz_grid_begin(&grid, alignment);
    cz_grid_put(&grid, of_interface ? "interface" : "car", CZ_STYLE_PLAIN);
    cz_grid_put(&grid, "", CZ_STYLE_PLAIN);
    for (int i = 0; i < n; i++)
        cz_grid_put(&grid, run[i].label, CZ_STYLE_PLAIN);
    for (int k = 0; k < CZ_N_COMPARED_NUMBER; k++) {
        const CzComparedNumber *number = &cz_compared_numbers[k];
        for (int i = 0;
             number->of_interface == of_interface && i < cz_compared_count(first, number); i++) {
            const char *name = cz_compared_name(first, number, i);
            char text[CZ_FIGURE_ROOM];
            cz_grid_put(&grid, name, CZ_STYLE_PLAIN);
            cz_grid_put(&grid, number->name, CZ_STYLE_PLAIN);
            for (int m = 0; m < n; m++)
                cz_grid_put(&grid, cz_compared_text(text, run, m, number, name), CZ_STYLE_PLAIN);
        }
    }
    is_whole &= cz_grid_write(&grid, colour, stream);
    return is_whole;
}

CzStatus cz_report_write_comparison(int n, const CzReportRun *run, bool colour, FILE *stream) {
    bool is_whole = true;
    n = n < CZ_MOST_COMPARED ? n : CZ_MOST_COMPARED;
    if (n < 1 || cz_compared_run(run, 0) == NULL)
        return CZ_OK;
    fprintf(stream, "scenario %s\n\n", cz_compared_run(run, 0)->scenario);
    is_whole &= write_checks(n, run, colour, stream);
    is_whole &= write_numbers(n, run, true, colour, stream);
    fputc('\n', stream);
    is_whole &= write_numbers(n, run, false, colour, stream);
    if (cz_compared_caution(n, run)[0] != '\0') {
        cz_grid_write_text(cz_compared_caution(n, run), CZ_STYLE_BAD, colour, stream);
        fputc('\n', stream);
    }
    return is_whole ? CZ_OK : CZ_STATUS_NO_MEMORY;
}
