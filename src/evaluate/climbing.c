/* Climbing margin of a run. */
#include "evaluate/climbing.h"

#include <string.h>

#include "evaluate/compose.h"

/* Metrics for judging climbing, with the limit that applies when the problem has none on a metric
 * of the group: EN 15227 limits the lift of a wheel to 75 % of its flange, the others are ours, as
 * in the design rules. */
typedef struct Ground {
    int group;
    const char *metric, *name;
    bool is_minimum;
    double limit; /* NaN: another metric of the group has the default limit */
} Ground;

static const Ground grounds[] = {
    {0, "vehicles.flange_share", "wheel lift", false, 0.75},
    {0, "vehicles.bogie_lift_mm", "wheel lift", false, NAN},
    {0, "vehicles.max_wheel_lift_mm", "wheel lift", false, NAN},
    {1, "interfaces.overlap_ribs", "overlap of the anti-climbers", true, 1},
    {1, "interfaces.min_overlap_mm", "overlap of the anti-climbers", true, NAN},
    {3, "vehicles.wheel_share", "wheel lift / flange height", false, 1},
    {2, "interfaces.vertical_margin_kN", "vertical capacity of the anti-climbers", true, 0},
};
enum { N_GROUND = sizeof grounds / sizeof grounds[0], N_GROUP = 4 };

static int group_of(const char *metric) {
    for (int i = 0; i < N_GROUND; i++)
        if (strcmp(grounds[i].metric, metric) == 0)
            return grounds[i].group;
    return -1;
}

bool cz_climbing_judges(const CzMetricKind *kind) {
    return group_of(kind->name) >= 0 || strcmp(kind->name, "override") == 0;
}

CzClimbing cz_climbing_of(const CzEvaluator *evaluator, int scenario) {
    CzClimbing climbing = {.scenario = scenario};
    bool has[N_GROUP] = {false};
    for (int i = 0; i < evaluator->list.n_check; i++) {
        const CzCheck *check = &evaluator->list.check[i];
        const bool counts =
            check->scenario == scenario && check->missing == NULL && check->metric.kind != NULL;
        const int group = counts ? group_of(check->metric.kind->name) : -1;
        if (group < 0 || climbing.n_check == CZ_MAX_CLIMBING_CHECKS)
            continue;
        has[group] = true;
        climbing.check[climbing.n_check++] = *check;
    }
    for (int i = 0; i < N_GROUND; i++) {
        const Ground *ground = &grounds[i];
        CzCheck check = {.name = ground->name,
                         .scenario = scenario,
                         .limit = ground->limit,
                         .is_minimum = ground->is_minimum,
                         .source = "ours"};
        if (has[ground->group] || isnan(ground->limit) ||
            climbing.n_check == CZ_MAX_CLIMBING_CHECKS ||
            cz_metric_parse(ground->metric, &check.metric, NULL) != CZ_OK)
            continue;
        check.scale = check.metric.kind->scale;
        climbing.check[climbing.n_check++] = check;
    }
    return climbing;
}

CzCheckResult cz_climbing_judge(const CzClimbing *climbing, const CzEvaluator *evaluator,
                                const CzVehicle *vehicles, const CzRunSummary *run) {
    CzCheckResult worst = {
        .margin = NAN, .value = NAN, .when = {NAN, NAN}, .verdict = CZ_VERDICT_NOT_CHECKED};
    const bool failed = run->status != CZ_OK || run->ended == CZ_ENDED_INCOMPLETE;
    const char *unknown = NULL;
    for (int i = 0; i < climbing->n_check; i++) {
        const CzSubject subject = cz_subject_of(evaluator, vehicles, climbing->scenario, run);
        const CzCheckResult result =
            cz_check_judge(&climbing->check[i], &subject, failed ? "the run has no result" : NULL);
        if (result.verdict == CZ_VERDICT_NOT_CHECKED)
            unknown = result.why;
        if (i == 0 || isnan(worst.margin) || result.margin < worst.margin)
            worst = result;
    }
    if (unknown != NULL && !(worst.margin < 0)) {
        worst.verdict = CZ_VERDICT_NOT_CHECKED;
        worst.why = unknown;
    }
    return worst;
}
