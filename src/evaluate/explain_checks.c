/* Explanation of checks from recorded runs: deciding time and place, carriers of the force, and
 * states of the elements there. */
#include "evaluate/explain_parts.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/error.h"
#include "base/suggest.h"
#include "evaluate/climbing.h"

#define KILO 1e3
#define SMALLEST_SHARE 0.005 /* carriers below it are left out (ours) */
#define SMALLEST_STROKE 1e-3 /* of the usable stroke, below which a device was not used (ours) */

/* ---- the place of a check ---- */

/* Interfaces and vehicle of a check; -1 for none. */
typedef struct Site {
    const CzRun *run;
    const CzRunSummary *summary;
    const CzMetricKind *kind; /* of the check; NULL when it could not be checked */
    int vehicle;
    int interface[2]; /* behind and ahead of a vehicle; else the first one only */
    const CzElementResult *element;
} Site;

static void find_place(Site *site, const char *where, int colliding) {
    const CzWhere found = cz_where_find(site->summary, where);
    site->vehicle = found.vehicle;
    site->element = found.element;
    site->interface[0] = found.interface[0] >= 0 ? found.interface[0] : colliding;
    site->interface[1] = found.interface[1];
}

/* The listed check behind a result. */
static const CzCheck *listed(const CzEvaluator *evaluator, const CzCheckResult *result) {
    for (int i = 0; i < evaluator->list.n_check; i++) {
        const CzCheck *check = &evaluator->list.check[i];
        if (!check->is_target && strcmp(check->name, result->name) == 0 &&
            strcmp(cz_check_scenario(check, evaluator->scene), result->scenario) == 0)
            return check;
    }
    return NULL;
}

/* The site of a check; without a run for a check of the design. */
static Site site_of(const CzEvaluator *evaluator, const CzEvaluation *evaluation,
                    const CzCheckResult *result) {
    Site site = {.vehicle = -1, .interface = {-1, -1}};
    const CzCheck *check = listed(evaluator, result);
    if (check == NULL || check->scenario == CZ_NO_SCENARIO || check->missing != NULL)
        return site;
    int run = 0;
    for (int s = 0; s < check->scenario; s++)
        run += evaluator->model[s] != NULL;
    if (evaluator->model[check->scenario] == NULL || evaluation->run[run] == NULL)
        return site;
    site.run = evaluation->run[run];
    site.summary = cz_run_summary(site.run);
    site.kind = check->metric.kind;
    find_place(&site, result->where, evaluator->scene[check->scenario].colliding);
    return site;
}

/* ---- its time ---- */

/* Time at which a recorded channel is largest in size; NaN when it was not recorded. */
static double time_of_largest(const CzRun *run, CzChannel channel, int place) {
    const double *time = cz_run_channel(run, CZ_CHANNEL_TIME, 0);
    const double *value = cz_run_channel(run, channel, place);
    int largest = -1;
    for (int i = 0; value != NULL && i < cz_run_n_sample(run); i++)
        if (isfinite(value[i]) && (largest < 0 || fabs(value[i]) > fabs(value[largest])))
            largest = i;
    return largest >= 0 ? time[largest] / KILO : NAN;
}

/* Whether an event at a place such as "coupler tube A3" is one of an element such as "coupler A3".
 */
static bool is_of_element(const char *where, const CzElementResult *element) {
    const char *kind = cz_element_text(element->kind), *vehicle = strrchr(where, ' ');
    const size_t n = strlen(kind);
    return vehicle != NULL && strncmp(where, kind, n) == 0 &&
           strcmp(element->name + n, vehicle) == 0;
}

/* Time of the first event of a kind at an element of an interface; NaN when there was none. */
static double event_time(const CzRunSummary *run, CzEventKind what, int interface,
                         const CzElementResult *element) {
    for (int i = 0; i < run->n_event; i++) {
        const CzEvent *event = &run->event[i];
        if (event->what == what && event->interface == interface &&
            is_of_element(event->where, element))
            return event->time;
    }
    return NAN;
}

/* Channel of the load path of an element. */
static CzChannel path_of(CzElementKind kind) {
    return kind == CZ_ELEMENT_COUPLER        ? CZ_CHANNEL_COUPLER_FORCE
           : kind == CZ_ELEMENT_SIDE_BUFFERS ? CZ_CHANNEL_SIDE_BUFFER_FORCE
                                             : CZ_CHANNEL_ANTI_CLIMBER_FORCE;
}

/* Whether a metric is of a force, and not of a stroke. */
static bool is_of_force(const CzMetricKind *kind) {
    return strstr(kind->name, "force") != NULL || strstr(kind->name, "load") != NULL;
}

/* Time at which an element bottomed out or sheared off; else that of its largest force for a check
 * of forces, and of the largest closure for one of strokes. */
static double time_of_element(const Site *site) {
    const double end =
        event_time(site->summary, CZ_EVENT_BOTTOMED_OUT, site->interface[0], site->element);
    const double sheared =
        event_time(site->summary, CZ_EVENT_SHEAR_OFF, site->interface[0], site->element);
    if (!isnan(end) || !isnan(sheared))
        return fmin(end, sheared); /* fmin ignores NaN */
    return time_of_largest(site->run,
                           is_of_force(site->kind) ? path_of(site->element->kind)
                                                   : CZ_CHANNEL_INTERFACE_CLOSURE,
                           site->interface[0]);
}

/* Deciding time: that of the check where it is stored, else that of the largest value of a channel
 * behind it. */
static void find_time(const Site *site, CzExplainedCheck *explained) {
    const CzCheckResult *check = &explained->check;
    double time = NAN;
    explained->time[0] = check->when[0];
    explained->time[1] = check->when[1];
    if (!isnan(check->when[0]) || site->kind == NULL || site->kind->is_total)
        return;
    if (site->element != NULL)
        time = time_of_element(site);
    else if (site->kind->level == CZ_LEVEL_VEHICLE && site->vehicle >= 0)
        time = time_of_largest(site->run, CZ_CHANNEL_BODY_ACCELERATION, site->vehicle);
    else if (site->kind->level == CZ_LEVEL_INTERFACE || site->kind->level == CZ_LEVEL_SECTION)
        time = site->summary->interface[site->interface[0]].peak_time;
    explained->time[0] = explained->time[1] = time;
}

/* ---- carriers ---- */

static void add_carrier(CzExplainedCheck *explained, const char *what, const char *of,
                        double amount) {
    if (explained->n_carrier == CZ_MAX_CARRIERS || !(amount > 0))
        return;
    CzCarrier *carrier = &explained->carrier[explained->n_carrier++];
    snprintf(carrier->what, sizeof carrier->what, "%s of %s", what, of);
    carrier->amount = amount;
}

/* Mean of a channel over the deciding time, or its value there [N]. */
static double mean_force(const CzRun *run, const double window[2], CzChannel channel, int place) {
    const double *time = cz_run_channel(run, CZ_CHANNEL_TIME, 0);
    const double *value = cz_run_channel(run, channel, place);
    const int n_sample = cz_run_n_sample(run);
    double sum = 0, nearest = INFINITY, there = 0;
    int n = 0;
    for (int i = 0; value != NULL && i < n_sample; i++) {
        const double t = time[i] / KILO;
        if (t >= window[0] && t <= window[1]) {
            sum += value[i];
            n++;
        }
        if (fabs(t - window[0]) < nearest) {
            nearest = fabs(t - window[0]);
            there = value[i];
        }
    }
    return KILO * (n > 1 ? sum / n : there);
}

static bool has_element(const CzInterfaceResult *interface, CzElementKind kind) {
    for (int i = 0; i < interface->n_element; i++)
        if (interface->element[i].kind == kind)
            return true;
    return false;
}

/* The load paths of an interface at the deciding time. */
static void add_forces(const Site *site, int index, CzExplainedCheck *explained) {
    const CzInterfaceResult *interface = &site->summary->interface[index];
    const bool has_climbers = has_element(interface, CZ_ELEMENT_ANTI_CLIMBER);
    const double *window = explained->time;
    const double all = mean_force(site->run, window, CZ_CHANNEL_INTERFACE_FORCE, index);
    const double couplers = mean_force(site->run, window, CZ_CHANNEL_COUPLER_FORCE, index);
    const double faces = mean_force(site->run, window, CZ_CHANNEL_ANTI_CLIMBER_FORCE, index);
    const double buffers = mean_force(site->run, window, CZ_CHANNEL_SIDE_BUFFER_FORCE, index);
    add_carrier(explained, "couplers", interface->name, couplers);
    add_carrier(explained, has_climbers ? "anti-climbers and ends" : "ends", interface->name,
                faces);
    add_carrier(explained, "side buffers", interface->name, buffers);
    add_carrier(explained, "superstructures", interface->name,
                all - couplers - faces - buffers - SMALLEST_SHARE * fabs(all));
}

static void add_energies(const Site *site, CzExplainedCheck *explained) {
    for (int i = 0; i < site->summary->n_interface; i++) {
        const CzInterfaceResult *interface = &site->summary->interface[i];
        for (int kind = 0; kind < CZ_N_ELEMENT_KIND; kind++) {
            double energy = 0;
            for (int k = 0; k < interface->n_element; k++)
                if (interface->element[k].kind == (CzElementKind)kind)
                    energy += interface->element[k].energy;
            if (energy > SMALLEST_SHARE * site->summary->energy.dissipated)
                add_carrier(explained, cz_element_text((CzElementKind)kind), interface->name,
                            energy);
        }
    }
}

/* Impulses that pitched the body of a vehicle whose wheels lift. */
static void add_impulses(const Site *site, CzExplainedCheck *explained) {
    const CzVehicleBudget *budget = &site->summary->budget[site->vehicle];
    int order[CZ_N_BUDGET];
    const int n = cz_budget_order(budget, order);
    for (int i = 0; i < n; i++)
        if (cz_budget_counts((CzBudgetSource)order[i]))
            add_carrier(explained, cz_budget_text((CzBudgetSource)order[i]),
                        site->summary->vehicle[site->vehicle].name, fabs(budget->moment[order[i]]));
}

static int compare_carriers(const void *a, const void *b) {
    const double first = ((const CzCarrier *)a)->amount, second = ((const CzCarrier *)b)->amount;
    return (first < second) - (first > second);
}

static void find_carriers(const Site *site, CzExplainedCheck *explained) {
    double sum = 0;
    if (site->kind->is_total) {
        explained->carried = CZ_CARRIED_ENERGY;
        add_energies(site, explained);
    } else if (site->vehicle >= 0 && site->summary->budget != NULL &&
               cz_climbing_judges(site->kind)) {
        explained->carried = CZ_CARRIED_MOMENT;
        add_impulses(site, explained);
    } else if (!isnan(explained->time[0])) {
        explained->carried = CZ_CARRIED_FORCE;
        for (int side = 0; side < 2; side++)
            if (site->interface[side] >= 0)
                add_forces(site, site->interface[side], explained);
    }
    for (int i = 0; i < explained->n_carrier; i++)
        sum += explained->carrier[i].amount;
    for (int i = 0; i < explained->n_carrier; i++)
        explained->carrier[i].share = explained->carrier[i].amount / sum;
    qsort(explained->carrier, (size_t)explained->n_carrier, sizeof *explained->carrier,
          compare_carriers);
    while (explained->n_carrier > 0 &&
           explained->carrier[explained->n_carrier - 1].share < SMALLEST_SHARE)
        explained->n_carrier--;
}

/* ---- states of the elements ---- */

/* What happened to an element up to a time, NaN for the whole run. */
static CzElementState state_of(const CzRunSummary *run, int interface,
                               const CzElementResult *element, double until) {
    static const struct {
        CzEventKind what;
        const char *state;
    } events[] = {{CZ_EVENT_BOTTOMED_OUT, "bottomed out"},
                  {CZ_EVENT_SHEAR_OFF, "sheared off"},
                  {CZ_EVENT_TUBE_EXHAUSTED, "tube exhausted"}};
    CzElementState state = {.time = NAN, .stroke_used = element->stroke_used};
    state.state = element->stroke_used > SMALLEST_STROKE ? "stroke left" : "not used";
    snprintf(state.interface, sizeof state.interface, "%s", run->interface[interface].name);
    snprintf(state.element, sizeof state.element, "%s", element->name);
    for (size_t i = 0; i < sizeof events / sizeof *events && isnan(state.time); i++) {
        const double time = event_time(run, events[i].what, interface, element);
        if (isnan(time) || (!isnan(until) && time > until))
            continue;
        state.state = events[i].state;
        state.time = time;
    }
    return state;
}

static void find_states(const Site *site, CzExplainedCheck *explained) {
    for (int side = 0; side < 2; side++) {
        const int index = site->interface[side];
        if (index < 0)
            continue;
        const CzInterfaceResult *interface = &site->summary->interface[index];
        for (int i = 0; i < interface->n_element; i++) {
            if (interface->element[i].kind == CZ_ELEMENT_DRAW_GEAR ||
                explained->n_state == CZ_MAX_STATES)
                continue;
            explained->state[explained->n_state++] =
                state_of(site->summary, index, &interface->element[i], explained->time[1]);
        }
    }
}

/* ---- all checks ---- */

static void describe(const CzEvaluator *evaluator, const CzEvaluation *evaluation,
                     CzExplainedCheck *explained) {
    const Site site = site_of(evaluator, evaluation, &explained->check);
    explained->time[0] = explained->time[1] = explained->margin = NAN;
    if (site.run == NULL || isnan(explained->check.value))
        return;
    find_time(&site, explained);
    snprintf(explained->interface, sizeof explained->interface, "%s",
             site.summary->interface[site.interface[0]].name);
    find_carriers(&site, explained);
    find_states(&site, explained);
}

/* Adds a check, or replaces that of its name where it is worse. */
static void keep(CzExplanation *explanation, const CzCheckResult *check) {
    for (int i = 0; i < explanation->n_check; i++) {
        CzCheckResult *kept = &explanation->check[i].check;
        if (strcmp(kept->name, check->name) != 0)
            continue;
        if (cz_check_is_worse(check, kept))
            *kept = *check;
        return;
    }
    if (explanation->n_check < CZ_MAX_EXPLAINED)
        explanation->check[explanation->n_check++].check = *check;
}

/* The check with the smallest margin. */
static void keep_nearest(CzExplanation *explanation, const CzEvaluation *evaluation) {
    const CzCheckResult *nearest = NULL;
    for (int i = 0; i < evaluation->n_check; i++) {
        const CzCheckResult *check = &evaluation->check[i];
        if (!isnan(check->margin) && (nearest == NULL || check->margin < nearest->margin))
            nearest = check;
    }
    if (nearest != NULL)
        keep(explanation, nearest);
}

/* Whether a check is not of a scenario that was left out. */
static bool is_of_a_run(const CzEvaluator *evaluator, const CzCheckResult *result) {
    const CzCheck *check = listed(evaluator, result);
    return check == NULL || check->scenario == CZ_NO_SCENARIO ||
           evaluator->model[check->scenario] != NULL;
}

/* The worst check of a name; that of a scenario that was left out only without another. */
static CzStatus keep_named(CzExplanation *explanation, const CzEvaluator *evaluator,
                           const CzEvaluation *evaluation, const char *name, CzError *error) {
    CzSuggestion nearest = {0};
    const CzCheckResult *left_out = NULL;
    bool found = false;
    for (int i = 0; i < evaluation->n_check; i++) {
        const CzCheckResult *check = &evaluation->check[i];
        cz_suggest(&nearest, name, check->name);
        if (strcmp(check->name, name) != 0)
            continue;
        if (!is_of_a_run(evaluator, check)) {
            left_out = check;
            continue;
        }
        found = true;
        keep(explanation, check);
    }
    if (!found && left_out != NULL)
        keep(explanation, left_out);
    if (found || left_out != NULL)
        return CZ_OK;
    cz_fail(error, CZ_STATUS_INPUT, "the problem has no check '%.200s'", name);
    cz_suggest_help(&nearest, error);
    return CZ_STATUS_INPUT;
}

CzStatus cz_explain_checks(const CzEvaluator *evaluator, const CzEvaluation *evaluation,
                           const CzExplainOptions *options, CzExplanation *explanation,
                           CzError *error) {
    explanation->check = calloc(CZ_MAX_EXPLAINED, sizeof *explanation->check);
    if (explanation->check == NULL)
        return cz_no_memory(error, "an explanation");
    for (int i = 0; i < options->n_check; i++)
        CZ_TRY(keep_named(explanation, evaluator, evaluation, options->check[i], error));
    for (int i = 0; i < evaluation->n_check && options->n_check == 0; i++)
        if (evaluation->check[i].verdict == CZ_VERDICT_FAIL)
            keep(explanation, &evaluation->check[i]);
    if (explanation->n_check == 0)
        keep_nearest(explanation, evaluation);
    for (int i = 0; i < explanation->n_check; i++)
        describe(evaluator, evaluation, &explanation->check[i]);
    return CZ_OK;
}
