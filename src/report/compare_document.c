/* The document `crushzone.comparison`: runs side by side for scripts. */
#include "crushzone/report.h"

#include "report/compare.h"
#include "report/documents.h"

#include <math.h>

static void put_run(CzJson *json, const CzReportRun *run, const CzRunSummary *summary) {
    cz_json_open_object(json, NULL);
    cz_json_text(json, "label", run->label);
    cz_json_text(json, "title", cz_problem_title(run->problem));
    cz_json_text(json, "hash", cz_problem_hash(run->problem));
    cz_json_text(json, "scenario", summary != NULL ? summary->scenario : NULL);
    cz_document_verdict(json, run->evaluation->verdict);
    cz_json_flag(json, "beyond_validity", summary != NULL && summary->beyond_validity);
    cz_json_close(json);
}

/* A check in each run; null where a run does not have it. */
static void put_check(CzJson *json, int n, const CzReportRun *run, const CzCheckResult *check) {
    cz_json_open_object(json, NULL);
    cz_json_text(json, "name", check->name);
    cz_json_text(json, "scenario", check->scenario);
    cz_json_text(json, "kind", check->is_minimum ? "min" : "max");
    cz_json_exact(json, "limit", check->limit);
    cz_json_text(json, "unit", check->unit);
    cz_json_flag(json, "differs", cz_compared_differs(n, run, check));
    cz_json_open_list(json, "runs");
    for (int i = 0; i < n; i++) {
        const CzCheckResult *other = cz_compared_check(&run[i], check);
        cz_json_open_object(json, NULL);
        cz_json_exact(json, "value", other != NULL ? other->value : NAN);
        cz_json_exact(json, "margin", other != NULL ? other->margin : NAN);
        cz_json_text(json, "where", other != NULL ? other->where : NULL);
        if (other != NULL)
            cz_document_verdict(json, other->verdict);
        else
            cz_json_text(json, "verdict", NULL);
        cz_json_flag(json, "beyond_validity", other != NULL && other->beyond_validity);
        cz_json_close(json);
    }
    cz_json_close(json);
    cz_json_close(json);
}

/* Every number of each interface or car, as a list over the runs. */
static void put_numbers(CzJson *json, int n, const CzReportRun *run, bool of_interface) {
    const CzRunSummary *first = cz_compared_run(run, 0);
    const int n_place = of_interface ? first->n_interface : first->n_vehicle;
    cz_json_open_list(json, of_interface ? "interfaces" : "vehicles");
    for (int place = 0; place < n_place; place++) {
        const char *name = of_interface ? first->interface[place].name : first->vehicle[place].name;
        cz_json_open_object(json, NULL);
        cz_json_text(json, "name", name);
        for (int k = 0; k < CZ_N_COMPARED_NUMBER; k++) {
            const CzComparedNumber *number = &cz_compared_numbers[k];
            if (number->of_interface != of_interface)
                continue;
            cz_json_open_list(json, number->key);
            for (int i = 0; i < n; i++)
                cz_json_real(json, NULL, number->in_key * cz_compared_value(run, i, number, name));
            cz_json_close(json);
        }
        cz_json_close(json);
    }
    cz_json_close(json);
}

CzStatus cz_report_write_comparison_json(int n, const CzReportRun *run, FILE *stream,
                                         CzError *error) {
    CzJson *json = cz_json_create();
    n = n < CZ_MOST_COMPARED ? n : CZ_MOST_COMPARED;
    cz_json_text(json, "format", "crushzone.comparison");
    cz_json_whole(json, "version", 1);
    cz_json_open_list(json, "runs");
    for (int i = 0; i < n; i++)
        put_run(json, &run[i], cz_compared_run(run, i));
    cz_json_close(json);
    cz_json_open_list(json, "checks");
    for (int i = 0; n > 0 && i < run[0].evaluation->n_check; i++)
        put_check(json, n, run, &run[0].evaluation->check[i]);
    cz_json_close(json);
    if (n > 0 && cz_compared_run(run, 0) != NULL) {
        put_numbers(json, n, run, true);
        put_numbers(json, n, run, false);
    }
    return cz_json_finish(json, stream, error);
}
