/* Margins that stand for a yes or no in the search of an adversary.
 *
 *   bottoming out    1 - largest share of a usable stroke
 *   shear-off        1 - largest force of a coupler over its shear-off force
 *   override         the smallest margin of wheel lift, overlap and vertical capacity (climbing.h)
 *
 * They are of the whole run, whatever the place of the check, and a point is judged by the yes or
 * no alone. Where another check of the scenario has such a margin itself, the adversary searches by
 * that one, and none stands for the yes or no.
 */
#include <math.h>
#include <string.h>

#include "base/text.h"
#include "evaluate/climbing.h"
#include "optimise/challenge.h"

/* A yes or no, and the metrics whose margins serve as well. */
typedef struct Flag {
    const char *metric;
    int n;
    const char *graded[6];
} Flag;

static const Flag flags[] = {
    {"interfaces.bottomed_out", 2, {"elements.stroke_used", "elements.stroke_demand"}},
    {"elements.bottomed_out", 2, {"elements.stroke_used", "elements.stroke_demand"}},
    {"elements.sheared", 1, {"elements.shear_load"}},
    {"run.override",
     6,
     {"vehicles.max_wheel_lift_mm", "vehicles.wheel_share", "vehicles.flange_share",
      "interfaces.min_overlap_mm", "interfaces.overlap_ribs", "interfaces.vertical_margin_kN"}}};
enum { N_FLAG = sizeof flags / sizeof *flags };

static const Flag *flag_of(const CzCheckResult *result) {
    for (int i = 0; i < N_FLAG && result->metric != NULL; i++)
        if (strcmp(flags[i].metric, result->metric) == 0)
            return &flags[i];
    return NULL;
}

/* Whether another check of the scenario has a margin that serves. */
static bool has_graded(const CzChallenge *challenge, const CzCheckResult *result, int check,
                       const Flag *flag) {
    const CzCaseCheck *listed = challenge->parts->checks.check;
    for (int i = 0; i < challenge->n_check; i++)
        if (listed[i].scenario == listed[check].scenario && !isnan(result[i].margin) &&
            result[i].metric != NULL && cz_text_is_among(result[i].metric, flag->n, flag->graded))
            return true;
    return false;
}

static double stroke_left(const CzRunSummary *run) {
    double used = 0;
    for (int i = 0; i < run->n_interface; i++)
        for (int e = 0; e < run->interface[i].n_element; e++)
            used = fmax(used, run->interface[i].element[e].stroke_used);
    return 1 - used;
}

/* The weaker shear-off of a vehicle; infinite without one. */
static double shear_force(const CzVehicle *vehicle) {
    const CzShearOff *front = &vehicle->front.coupler.shear_off;
    const CzShearOff *rear = &vehicle->rear.coupler.shear_off;
    return fmin(front->given ? front->force : INFINITY, rear->given ? rear->force : INFINITY);
}

static double shear_left(const CzScene *scene, const CzVehicle *vehicles, const CzRunSummary *run) {
    double load = 0;
    for (int i = 0; i < run->n_interface; i++)
        for (int e = 0; e < run->interface[i].n_element; e++) {
            const CzElementResult *element = &run->interface[i].element[e];
            if (element->kind == CZ_ELEMENT_COUPLER)
                load = fmax(load, element->peak_force /
                                      shear_force(&vehicles[scene->record[element->vehicle]]));
        }
    return 1 - load;
}

double cz_challenge_flag_margin(const CzChallenge *challenge, const CzCaseBench *bench, int scene,
                                const CzRunSummary *run, const CzCheckResult *result, int check) {
    const CzEvaluator *evaluator = bench->evaluator;
    const CzVehicle *vehicles = cz_vehicles_in(evaluator, evaluator->vehicles, scene);
    const CzCheckResult *judged = &result[check];
    const Flag *flag = judged->is_flag ? flag_of(judged) : NULL;
    double margin;
    if (flag == NULL || has_graded(challenge, result, check, flag))
        return NAN;
    if (strcmp(flag->metric, "run.override") == 0) {
        const CzClimbing climbing = cz_climbing_of(evaluator, scene);
        margin = cz_climbing_judge(&climbing, evaluator, vehicles, run).margin;
    } else if (strcmp(flag->metric, "elements.sheared") == 0) {
        margin = shear_left(&evaluator->scene[scene], vehicles, run);
    } else {
        margin = stroke_left(run);
    }
    margin = judged->is_minimum ? -margin : margin;
    return judged->verdict == CZ_VERDICT_FAIL ? fmin(margin, -1e-3) : fmax(margin, 0);
}
