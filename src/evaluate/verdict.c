/* Verdict over several checks: the same rule for a scenario, a problem, a point of a sweep, a
 * design of a search, and runs that are compared.
 *
 *   FAIL         a check fails, or a vehicle climbed, so that later results are not valid
 *   NOT CHECKED  else: a run failed or is incomplete, a check could not be made, or there is none
 *   PROVISIONAL  else: a limit that a check satisfies, or the scenario of the profile in which it
 *                does, has not been confirmed
 *   pass         else
 *
 * The last two are those of a screening while the profile has requirements that this program cannot
 * check: they are listed, counted beside the verdict, and never as passed.
 *
 * The exit code of a judging command is 0 for the last two, 3 when a run failed, else 1.
 */
#include <math.h>
#include <string.h>

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

bool cz_verdict_is_screening(CzVerdict verdict, int n_not_covered) {
    return cz_verdict_passes(verdict) && n_not_covered > 0;
}

const char *cz_verdict_words(CzVerdict verdict, int n_not_covered) {
    if (!cz_verdict_is_screening(verdict, n_not_covered))
        return cz_verdict_text(verdict);
    return verdict == CZ_VERDICT_PASS ? "pass (screening)" : "provisional (screening)";
}

/* The rule: which verdicts there are, of how many checks, and whether a vehicle climbed or a run is
 * missing. */
static CzVerdict add_up(const bool any[4], int n_counted, bool climbed, bool has_failed) {
    if (any[CZ_VERDICT_FAIL] || climbed)
        return CZ_VERDICT_FAIL;
    if (any[CZ_VERDICT_NOT_CHECKED] || n_counted == 0 || has_failed)
        return CZ_VERDICT_NOT_CHECKED;
    return any[CZ_VERDICT_PROVISIONAL] ? CZ_VERDICT_PROVISIONAL : CZ_VERDICT_PASS;
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
    return add_up(any, n_counted, evaluation->beyond_validity, evaluation->status != CZ_OK);
}

CzVerdict cz_verdict_in(const CzEvaluation *evaluation, const char *scenario) {
    bool any[4] = {false}, climbed = false, has_failed = false;
    int n_counted = 0;
    for (int i = 0; i < evaluation->n_check; i++) {
        const CzCheckResult *check = &evaluation->check[i];
        const bool is_of_family = check->family != NULL && strcmp(check->family, scenario) == 0;
        if (!is_of_family && strcmp(check->scenario, scenario) != 0)
            continue;
        any[check->verdict] = true;
        climbed |= check->beyond_validity;
        has_failed |= check->has_no_run;
        n_counted++;
    }
    return add_up(any, n_counted, climbed, has_failed);
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
