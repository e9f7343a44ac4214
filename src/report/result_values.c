/* Values of results that are no member of a record: words, places, parts of documents. */
#include "report/result_values.h"

#include "problem/problem.h"
#include "report/runs.h"

#include <math.h>
#include <stdio.h>

/* ---- heads of documents ---- */

const char *cz_value_document_format(CzResultContext *context, const void *record) {
    (void)record;
    return context->format;
}

long cz_value_document_version(CzResultContext *context, const void *record) {
    (void)context, (void)record;
    return 1;
}

const void *cz_value_the_program(CzResultContext *context, const void *record) {
    (void)record;
    return context;
}

const char *cz_value_own_version(CzResultContext *context, const void *record) {
    (void)context, (void)record;
    return cz_version();
}

const char *cz_value_sundials_version(CzResultContext *context, const void *record) {
    (void)record;
    context->text[0] = '\0';
    cz_sundials_version(context->text, sizeof context->text);
    return context->text;
}

const char *cz_value_nlopt_version(CzResultContext *context, const void *record) {
    (void)record;
    context->text[0] = '\0';
    cz_nlopt_version(context->text, sizeof context->text);
    return context->text;
}

const void *cz_value_the_problem(CzResultContext *context, const void *record) {
    (void)record;
    return context->problem;
}

const char *cz_value_problem_title(CzResultContext *context, const void *record) {
    (void)context;
    return cz_problem_title(record);
}

const char *cz_value_problem_file(CzResultContext *context, const void *record) {
    (void)context;
    return cz_problem_file(record);
}

const char *cz_value_problem_hash(CzResultContext *context, const void *record) {
    (void)context;
    return cz_problem_hash(record);
}

const void *cz_value_info_of_document(CzResultContext *context, const void *record) {
    (void)record;
    context->info = (CzRunInfo){.wall_s = context->wall_s,
                                .setup_s = context->options->setup_s,
                                .n_job = context->options->n_job};
    return &context->info;
}

const void *cz_value_info_of_run(CzResultContext *context, const void *record) {
    const CzRunSummary *run = record;
    context->info = (CzRunInfo){
        .wall_s = run->wall_s, .setup_s = run->setup_s, .n_job = context->options->n_job};
    return &context->info;
}

const char *cz_value_instruction_set(CzResultContext *context, const void *record) {
    (void)context, (void)record;
    return cz_isa_name();
}

long cz_value_n_job(CzResultContext *context, const void *record) {
    const CzRunInfo *info = record;
    (void)context;
    return info->n_job > 0 ? info->n_job : -1;
}

/* ---- mistakes and warnings ---- */

long cz_value_mistake_line(CzResultContext *context, const void *record) {
    const CzError *mistake = record;
    (void)context;
    return mistake->line > 0 ? mistake->line : -1;
}

long cz_value_mistake_column(CzResultContext *context, const void *record) {
    const CzError *mistake = record;
    (void)context;
    return mistake->column > 0 ? mistake->column : -1;
}

/* What a run is warned of: of two things the n-th that is true; NULL beyond. */
static const char *warning_of_run(const CzRunSummary *run, int n) {
    if (cz_run_is_unbalanced(run) && n-- == 0)
        return "the error of the energy balance is above 0.1 %";
    if (cz_run_misses_laws(run) && n == 0)
        return "the force error of a series chain is above 0.1 % of the largest force of its "
               "interface, from the law of a member";
    return NULL;
}

/* Those of the problem file, then those of the runs. */
const void *cz_value_warning(CzResultContext *context, const void *record, int index) {
    const CzEvaluation *evaluation = context->evaluation;
    (void)record;
    if (index < cz_problem_n_warning(context->problem))
        return cz_problem_warning(context->problem, index);
    index -= cz_problem_n_warning(context->problem);
    for (int i = 0; i < evaluation->n_run; i++) {
        const CzRunSummary *run = cz_kept_run(evaluation, i);
        for (int n = 0; run != NULL && warning_of_run(run, n) != NULL; n++) {
            if (index-- > 0)
                continue;
            CzError *warning = &context->warning;
            *warning = (CzError){0};
            snprintf(warning->message, sizeof warning->message, "scenario '%s': %s", run->scenario,
                     warning_of_run(run, n));
            snprintf(warning->help, sizeof warning->help, "reduce the time step");
            return warning;
        }
    }
    return NULL;
}

/* ---- evaluation ---- */

const void *cz_value_kept_run(CzResultContext *context, const void *record, int index) {
    const CzEvaluation *evaluation = record;
    (void)context;
    for (int i = 0; i < evaluation->n_run; i++)
        if (cz_kept_run(evaluation, i) != NULL && index-- == 0)
            return cz_kept_run(evaluation, i);
    return NULL;
}

const char *cz_value_not_covered(CzResultContext *context, const void *record, int index) {
    const CzEvaluation *evaluation = record;
    (void)context;
    return index < evaluation->n_not_covered ? evaluation->not_covered[index] : NULL;
}

const char *cz_value_check_kind(CzResultContext *context, const void *record) {
    (void)context;
    return ((const CzCheckResult *)record)->is_minimum ? "min" : "max";
}

double cz_value_check_from(CzResultContext *context, const void *record) {
    const CzCheckResult *check = record;
    (void)context;
    return isfinite(check->when[0]) ? check->when[0] : NAN;
}

double cz_value_check_to(CzResultContext *context, const void *record) {
    const CzCheckResult *check = record;
    (void)context;
    return isfinite(check->when[0]) ? check->when[1] : NAN;
}

/* ---- runs ---- */

const char *cz_value_track_word(CzResultContext *context, const void *record) {
    (void)record;
    switch (cz_problem_track(context->problem)) {
    case CZ_TRACK_MODAL:
        return "modal";
    case CZ_TRACK_FE:
        return "fe";
    case CZ_TRACK_CO_RUNNING:
        return "co-running";
    case CZ_TRACK_RIGID:
        return "rigid";
    }
    return NULL;
}

bool cz_value_run_is_beyond(CzResultContext *context, const void *record) {
    (void)record;
    return context->run->beyond_validity;
}

const void *cz_value_run_energy(CzResultContext *context, const void *record) {
    (void)context;
    return &((const CzRunSummary *)record)->energy;
}

const char *cz_value_event_interface(CzResultContext *context, const void *record) {
    const CzEvent *event = record;
    return event->interface >= 0 ? context->run->interface[event->interface].name : NULL;
}

bool cz_value_event_is_beyond(CzResultContext *context, const void *record) {
    return ((const CzEvent *)record)->time > context->run->beyond_validity_time;
}

/* ---- interfaces and elements ---- */

double cz_value_largest_stroke_used(CzResultContext *context, const void *record) {
    const CzInterfaceResult *interface = record;
    double used = 0;
    (void)context;
    for (int i = 0; i < interface->n_element; i++)
        used = fmax(used, interface->element[i].stroke_used);
    return used;
}

const void *cz_value_element_zones(CzResultContext *context, const void *record) {
    (void)context;
    return record;
}

/* ---- vehicles ---- */

double cz_value_largest_wheel_lift(CzResultContext *context, const void *record) {
    const CzVehicleResult *vehicle = record;
    double lift = NAN;
    (void)context;
    for (int i = 0; i < 4; i++)
        lift = fmax(lift, vehicle->wheel_lift[i]);
    return lift;
}

const char *cz_value_lifted_bogie(CzResultContext *context, const void *record) {
    const CzVehicleResult *vehicle = record;
    (void)context;
    if (!(vehicle->bogie_lift > 0))
        return NULL;
    return vehicle->lifted_bogie == 0 ? "rear" : "front";
}

const void *cz_value_vehicle_budget(CzResultContext *context, const void *record) {
    const CzVehicleResult *vehicle = record;
    const CzRunSummary *run = context->run;
    return run->budget != NULL && vehicle->checks_override ? &run->budget[vehicle - run->vehicle]
                                                           : NULL;
}

const char *cz_value_budget_end(CzResultContext *context, const void *record) {
    (void)context;
    return ((const CzVehicleBudget *)record)->of_lift ? "largest wheel lift" : "largest pitch";
}

const void *cz_value_budget_source(CzResultContext *context, const void *record, int index) {
    const CzVehicleBudget *budget = record;
    if (index >= (context->order != NULL ? context->n_order : (int)CZ_N_BUDGET))
        return NULL;
    const CzBudgetSource source =
        (CzBudgetSource)(context->order != NULL ? context->order[index] : index);
    context->impulse = (CzImpulse){source, budget->moment[source], budget->lift[source]};
    return &context->impulse;
}

bool cz_value_source_acts(CzResultContext *context, const void *record) {
    (void)context;
    return cz_budget_counts(((const CzImpulse *)record)->source);
}
