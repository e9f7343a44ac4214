/* Verdict over several checks: the same rule for a scenario, a problem, a point of a sweep, a
 * design of a search, and runs that are compared.
 *
 *   FAIL         a check fails, or a vehicle climbed, so that later results are not valid
 *   NOT CHECKED  else: a run failed or is incomplete, a check could not be made, or there is none
 *   PROVISIONAL  else: a limit that a check satisfies has not been confirmed
 *   pass         else
 *
 * The exit code of a judging command is 0 for the last two, 3 when a run failed, else 1.
 */
#include <math.h>

#include "base/text.h"
#include "crushzone/evaluate.h"

const char *cz_verdict_text(CzVerdict verdict) {
    static const char *const texts[] = {[CZ_VERDICT_PASS] = "pass",
                                        [CZ_VERDICT_PROVISIONAL] = "provisional",
                                        [CZ_VERDICT_FAIL] = "fail",
                                        [CZ_VERDICT_NOT_CHECKED] = "not checked"};
    return texts[verdict];
}

bool cz_verdict_passes(CzVerdict verdict) {
    return verdict == CZ_VERDICT_PASS || verdict == CZ_VERDICT_PROVISIONAL;
}

CzVerdict cz_verdict_over(const CzEvaluation *evaluation, int n_name, const char *const *name) {
    bool any[4] = {false};
    int n_counted = 0;
    for (int i = 0; i < evaluation->n_check; i++) {
        if (n_name > 0 && !cz_text_is_among(evaluation->check[i].name, n_name, name))
            continue;
        any[evaluation->check[i].verdict] = true;
        n_counted++;
    }
    if (any[CZ_VERDICT_FAIL] || evaluation->beyond_validity)
        return CZ_VERDICT_FAIL;
    if (any[CZ_VERDICT_NOT_CHECKED] || n_counted == 0 || evaluation->status != CZ_OK)
        return CZ_VERDICT_NOT_CHECKED;
    return any[CZ_VERDICT_PROVISIONAL] ? CZ_VERDICT_PROVISIONAL : CZ_VERDICT_PASS;
}

/* Sort key: failed checks by margin, failed yes-or-no checks, checks that were not made, passes by
 * margin, checks that do not apply. */
static double order_of(const CzCheckResult *check) {
    const double most = 1e9, margin = fmin(fmax(check->margin, -most), most);
    if (check->verdict == CZ_VERDICT_FAIL)
        return -2 * most + (isnan(check->margin) ? 0 : margin);
    if (check->verdict == CZ_VERDICT_NOT_CHECKED)
        return 0;
    if (isnan(check->value))
        return 4 * most;
    return 2 * most + (isnan(check->margin) ? 1 : margin);
}

bool cz_check_is_worse(const CzCheckResult *check, const CzCheckResult *other) {
    return order_of(check) < order_of(other);
}
