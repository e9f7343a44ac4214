/* Checks: judging values against limits. */
#include "evaluate/checks.h"

#include <stdio.h>
#include <string.h>

const char *cz_verdict_text(CzVerdict verdict) {
    static const char *const texts[] = {[CZ_VERDICT_PASS] = "pass",
                                        [CZ_VERDICT_PROVISIONAL] = "provisional",
                                        [CZ_VERDICT_FAIL] = "fail",
                                        [CZ_VERDICT_NOT_CHECKED] = "not checked"};
    return texts[verdict];
}

/* Margin of a broken yes or no. It is a step, which no search can follow; the continuous checks
 * beside it show the way, so it says that it is broken and no more. */
static const double broken_flag_margin = -0.01;

double cz_margin(double value, double limit, bool is_minimum, double scale) {
    if (isnan(value))
        return NAN;
    const double room = is_minimum ? value - limit : limit - value;
    if (scale == CZ_FLAG_SCALE)
        return room >= 0 ? 1 : broken_flag_margin;
    return room / fmax(fabs(limit), scale);
}

/* The result with everything that does not depend on a run. */
static CzCheckResult blank_result(const CzCheck *check, const CzScene *scene) {
    return (CzCheckResult){.name = check->name,
                           .scenario = scene != NULL ? scene->name : "design",
                           .limit = check->limit,
                           .value = NAN,
                           .unit = check->missing != NULL ? "" : check->metric.kind->unit,
                           .margin = NAN,
                           .is_minimum = check->is_minimum,
                           .verdict = CZ_VERDICT_NOT_CHECKED,
                           .profile = check->profile,
                           .clause = check->clause,
                           .source = check->source,
                           .confidence = check->confidence};
}

static CzVerdict passing_verdict(const CzCheck *check) {
    return check->is_provisional ? CZ_VERDICT_PROVISIONAL : CZ_VERDICT_PASS;
}

CzCheckResult cz_check_judge(const CzCheck *check, const CzSubject *subject, const char *failure) {
    CzCheckResult result = blank_result(check, subject->scene);
    result.why = check->missing != NULL ? check->missing : failure;
    if (result.why != NULL)
        return result;
    const CzMetricValue value = cz_metric_value(&check->metric, subject, !check->is_minimum);
    result.why = value.why;
    if (value.known == CZ_DOES_NOT_APPLY) {
        result.verdict = passing_verdict(check);
        return result;
    }
    const double margin = cz_margin(value.value, check->limit, check->is_minimum, check->scale);
    const bool fails = margin < 0;
    if (value.known == CZ_UNKNOWN && !fails) { /* a failure elsewhere stays one */
        memcpy(result.where, value.unknown_where, sizeof result.where);
        return result;
    }
    memcpy(result.where, value.where, sizeof result.where);
    result.why = NULL;
    result.value = value.value;
    result.margin = margin;
    result.verdict = fails ? CZ_VERDICT_FAIL : passing_verdict(check);
    return result;
}

double cz_check_constraint(const CzCheckResult *result, double required_margin) {
    if (result->verdict == CZ_VERDICT_NOT_CHECKED)
        return NAN;
    const double margin = isnan(result->margin) ? 1 : result->margin; /* it does not apply */
    return required_margin - margin;
}

CzVerdict cz_verdict_over(int n_check, const CzCheck *check, const CzCheckResult *result) {
    bool any[4] = {false};
    int n_counted = 0;
    for (int i = 0; i < n_check; i++) {
        if (check[i].is_remark || check[i].is_target)
            continue;
        any[result[i].verdict] = true;
        n_counted++;
    }
    if (any[CZ_VERDICT_FAIL])
        return CZ_VERDICT_FAIL;
    if (any[CZ_VERDICT_NOT_CHECKED] || n_counted == 0)
        return CZ_VERDICT_NOT_CHECKED;
    return any[CZ_VERDICT_PROVISIONAL] ? CZ_VERDICT_PROVISIONAL : CZ_VERDICT_PASS;
}
