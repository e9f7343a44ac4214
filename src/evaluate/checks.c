/* Checks: compares values with limits. */
#include "evaluate/checks.h"

#include <stdio.h>
#include <string.h>

/* A margin below this is rounding error and counts as 0. */
static const double rounding = 1e-12;

/* `scale` may be CZ_FLAG_SCALE, whose margin is for a search only. NaN for NaN. */
static double margin_of(double value, double limit, bool is_minimum, double scale) {
    if (isnan(value))
        return NAN;
    const double room = is_minimum ? value - limit : limit - value;
    if (scale == CZ_FLAG_SCALE)
        return room >= 0 ? CZ_SATISFIED_FLAG : CZ_BROKEN_FLAG;
    const double margin = room / fmax(fabs(limit), scale);
    return fabs(margin) < rounding ? 0 : margin;
}

static const char beyond_validity[] = "beyond model validity: a vehicle climbed in this run";

const char *cz_check_scenario(const CzCheck *check, const CzScene *scene) {
    const int s = check->scenario != CZ_NO_SCENARIO ? check->scenario : check->scene_of_vehicles;
    return check->scenario == CZ_NO_SCENARIO && s == 0 ? "design" : scene[s].name;
}

/* The result with everything that does not depend on a run. */
static CzCheckResult blank_result(const CzCheck *check, const CzScene *scene) {
    return (CzCheckResult){.name = check->name,
                           .scenario = scene != NULL ? scene->name : "design",
                           .family = scene != NULL ? scene->family : NULL,
                           .metric = check->missing == NULL ? check->metric.kind->name : NULL,
                           .limit = check->limit,
                           .value = NAN,
                           .when = {NAN, NAN},
                           .unit = check->missing != NULL ? "" : check->metric.kind->unit->text,
                           .margin = NAN,
                           .is_minimum = check->is_minimum,
                           .is_flag = check->missing == NULL && check->scale == CZ_FLAG_SCALE,
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
    result.has_no_run = check->missing == NULL && failure != NULL;
    if (result.why != NULL)
        return result;
    const CzMetricValue value = cz_metric_value(&check->metric, subject, !check->is_minimum);
    result.why = value.why;
    if (value.known == CZ_DOES_NOT_APPLY) {
        result.verdict = passing_verdict(check);
        return result;
    }
    const double margin = margin_of(value.value, check->limit, check->is_minimum, check->scale);
    const bool fails = margin < 0;
    if (value.known == CZ_UNKNOWN && !fails) { /* a failure at another place remains a failure */
        memcpy(result.where, value.unknown_where, sizeof result.where);
        return result;
    }
    memcpy(result.where, value.where, sizeof result.where);
    result.beyond_validity = subject->run != NULL && subject->run->beyond_validity;
    result.why = result.beyond_validity ? beyond_validity : NULL;
    result.value = value.value;
    memcpy(result.when, value.when, sizeof result.when);
    result.margin = result.is_flag ? NAN : margin;
    result.verdict = fails ? CZ_VERDICT_FAIL : passing_verdict(check);
    return result;
}

void cz_check_blank_total(const CzCheck *check, CzCheckResult *result) {
    if (!result->beyond_validity || !check->metric.kind->is_total)
        return;
    result->value = result->margin = result->when[0] = result->when[1] = NAN;
    result->where[0] = '\0';
    result->verdict = CZ_VERDICT_NOT_CHECKED;
}

double cz_check_constraint(const CzCheckResult *result, double required_margin) {
    if (result->verdict == CZ_VERDICT_NOT_CHECKED)
        return NAN;
    if (!isnan(result->margin))
        return required_margin - result->margin;
    const bool fails = result->verdict == CZ_VERDICT_FAIL; /* else satisfied, or not applicable */
    return required_margin - (fails ? CZ_BROKEN_FLAG : CZ_SATISFIED_FLAG);
}

/* Whether a check is satisfied exactly when it is satisfied at each place, as when the worst place
 * counts. */
static bool is_by_place(const CzCheck *check) {
    const CzAggregate aggregate = check->metric.aggregate;
    return check->scenario != CZ_NO_SCENARIO &&
           (aggregate == CZ_AGGREGATE_WORST ||
            aggregate == (check->is_minimum ? CZ_AGGREGATE_MIN : CZ_AGGREGATE_MAX));
}

bool cz_check_is_activation(const CzCheck *check) {
    const double most_scales = 1; /* a larger limit allows an energy, whose margin counts; ours */
    return !check->is_minimum && check->missing == NULL && is_by_place(check) &&
           cz_metric_has_activation(check->metric.kind) &&
           check->limit <= most_scales * check->metric.kind->scale;
}

int cz_check_n_detail(const CzCheck *check, const CzScene *scene) {
    if (check->scale == CZ_FLAG_SCALE || check->is_rule)
        return 0;
    return is_by_place(check)
               ? cz_places_count(scene, check->metric.kind->level, check->metric.selector)
               : 1;
}

/* Constraints place by place. */
typedef struct Details {
    const CzCheck *check;
    double required_margin;
    int n, room;
    double *constraint; /* (room) */
} Details;

static double detail_of(const Details *details, double value) {
    const CzCheck *check = details->check;
    const double margin = margin_of(value, check->limit, check->is_minimum, check->scale);
    return isnan(margin) ? -1 : details->required_margin - margin;
}

/* The constraint at a place, continued where the energy of an idle device is zero. */
static double detail_at(const Details *details, const CzPlace *place) {
    const CzCheck *check = details->check;
    const double value = cz_metric_at(&check->metric, place);
    CzActivation activation;
    if (check->is_minimum || !cz_metric_activation_at(check->metric.kind, place, &activation))
        return detail_of(details, value);
    if (!cz_check_is_activation(check))
        return detail_of(details, value > 0 ? value : -activation.distance * activation.size);
    const double most =
        check->limit - details->required_margin * fmax(fabs(check->limit), check->scale);
    if (most < 0) /* not even zero satisfies it */
        return detail_of(details, value);
    return value > most ? (value - most) / activation.size : -activation.distance;
}

static void add_detail(const CzPlace *place, void *data) {
    Details *details = data;
    if (details->n < details->room)
        details->constraint[details->n++] = detail_at(details, place);
}

int cz_check_details(const CzCheck *check, const CzSubject *subject, double required_margin,
                     double *detail) {
    const int n = cz_check_n_detail(check, subject->scene);
    Details details = {
        .check = check, .required_margin = required_margin, .room = n, .constraint = detail};
    if (n > 0 && subject->scene != NULL && subject->run == NULL)
        details.n = 0; /* this scenario was not run */
    else if (n > 0 && is_by_place(check))
        cz_places_visit(subject, check->metric.kind->level, check->metric.selector, add_detail,
                        &details);
    else if (n > 0)
        detail[details.n++] =
            detail_of(&details, cz_metric_value(&check->metric, subject, !check->is_minimum).value);
    while (details.n < n)
        detail[details.n++] = -1;
    return n;
}
