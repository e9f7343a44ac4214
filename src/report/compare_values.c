/* Values of the document `crushzone.comparison`. */
#include "report/compare.h"
#include "report/result_values.h"

#include <math.h>
#include <string.h>

const void *cz_value_compared_run(CzResultContext *context, const void *record, int index) {
    (void)record;
    return index < context->n_compared ? &context->compared[index] : NULL;
}

/* The run of a compared one that is compared; NULL when none was kept. */
static const CzRunSummary *summary_of(const CzResultContext *context, const void *record) {
    return cz_compared_run(context->compared,
                           (int)((const CzReportRun *)record - context->compared));
}

const char *cz_value_compared_title(CzResultContext *context, const void *record) {
    (void)context;
    return cz_problem_title(((const CzReportRun *)record)->problem);
}

const char *cz_value_compared_hash(CzResultContext *context, const void *record) {
    (void)context;
    return cz_problem_hash(((const CzReportRun *)record)->problem);
}

const char *cz_value_compared_scenario(CzResultContext *context, const void *record) {
    const CzRunSummary *summary = summary_of(context, record);
    return summary != NULL ? summary->scenario : NULL;
}

const char *cz_value_compared_verdict(CzResultContext *context, const void *record) {
    (void)context;
    return cz_closed_verdict(((const CzReportRun *)record)->evaluation->verdict);
}

bool cz_value_compared_is_provisional(CzResultContext *context, const void *record) {
    (void)context;
    return ((const CzReportRun *)record)->evaluation->verdict == CZ_VERDICT_PROVISIONAL;
}

bool cz_value_compared_is_beyond(CzResultContext *context, const void *record) {
    const CzRunSummary *summary = summary_of(context, record);
    return summary != NULL && summary->beyond_validity;
}

const void *cz_value_compared_check(CzResultContext *context, const void *record, int index) {
    const CzReportRun *first = context->compared;
    (void)record;
    return context->n_compared > 0 && index < first->evaluation->n_check
               ? &first->evaluation->check[index]
               : NULL;
}

bool cz_value_check_differs(CzResultContext *context, const void *record) {
    return cz_compared_differs(context->n_compared, context->compared, record);
}

const void *cz_value_check_in_run(CzResultContext *context, const void *record, int index) {
    if (index >= context->n_compared)
        return NULL;
    const CzCheckResult *check = cz_compared_check(&context->compared[index], record);
    context->check = (CzCheckInRun){.check = check, .value = NAN, .margin = NAN};
    if (check != NULL)
        context->check = (CzCheckInRun){.check = check,
                                        .value = check->value,
                                        .margin = check->margin,
                                        .where = check->where,
                                        .verdict = cz_closed_verdict(check->verdict),
                                        .beyond_validity = check->beyond_validity};
    return &context->check;
}

long cz_value_check_in_run_is_provisional(CzResultContext *context, const void *record) {
    const CzCheckResult *check = ((const CzCheckInRun *)record)->check;
    (void)context;
    return check != NULL ? check->verdict == CZ_VERDICT_PROVISIONAL : -1;
}

bool cz_value_has_compared_run(CzResultContext *context, const void *record) {
    (void)record;
    return context->n_compared > 0 && cz_compared_run(context->compared, 0) != NULL;
}

const void *cz_value_compared_interface(CzResultContext *context, const void *record, int index) {
    const CzRunSummary *first = cz_compared_run(context->compared, 0);
    (void)record;
    return index < first->n_interface ? &first->interface[index] : NULL;
}

const void *cz_value_compared_vehicle(CzResultContext *context, const void *record, int index) {
    const CzRunSummary *first = cz_compared_run(context->compared, 0);
    (void)record;
    return index < first->n_vehicle ? &first->vehicle[index] : NULL;
}

/* The result of the same key, in each run. */
bool cz_value_compared_number(CzResultContext *context, const void *record, int index,
                              CzNamedNumber *number) {
    const bool of_interface = context->at->record == CZ_RECORD_COMPARED_INTERFACE;
    const char *name = of_interface ? ((const CzInterfaceResult *)record)->name
                                    : ((const CzVehicleResult *)record)->name;
    const CzResult *result;
    for (int k = 0; (result = cz_compared_result(of_interface, k)) != NULL; k++)
        if (strcmp(result->key, context->at->key) == 0)
            break;
    if (index >= context->n_compared || result == NULL)
        return false;
    number->value = cz_compared_value(context->compared, index, result, name);
    return true;
}
