/* The document `crushzone.summary`: everything that a run answers, in the units of its keys. */
#include "report/documents.h"

#include "crushzone/report.h"
#include "problem/problem.h"
#include "report/json.h"
#include "report/runs.h"
#include "report/units.h"

#include <math.h>
#include <stdio.h>

void cz_document_head(CzJson *json, const char *format, const CzProblem *problem) {
    char nlopt[32] = "", sundials[32] = "";
    cz_nlopt_version(nlopt, sizeof nlopt);
    cz_sundials_version(sundials, sizeof sundials);

    cz_json_text(json, "format", format);
    cz_json_whole(json, "version", 1);
    cz_json_open_object(json, "program");
    cz_json_text(json, "version", cz_version());
    cz_json_text(json, "sundials", sundials);
    cz_json_text(json, "nlopt", nlopt);
    cz_json_close(json);
    cz_json_open_object(json, "problem");
    cz_json_text(json, "title", cz_problem_title(problem));
    cz_json_text(json, "file", cz_problem_file(problem));
    cz_json_text(json, "hash", cz_problem_hash(problem));
    cz_json_close(json);
}

void cz_document_run_info(CzJson *json, double wall_s, double setup_s, int n_job) {
    cz_json_open_object(json, "run_info");
    cz_json_exact(json, "wall_s", wall_s);
    cz_json_exact(json, "setup_s", setup_s);
    cz_json_text(json, "isa", cz_isa_name());
    if (n_job > 0)
        cz_json_whole(json, "jobs", n_job);
    else
        cz_json_text(json, "jobs", NULL);
    cz_json_close(json);
}

static void put_warning(CzJson *json, const char *scenario, const char *what) {
    CzError warning = {0};
    snprintf(warning.message, sizeof warning.message, "scenario '%s': %s", scenario, what);
    snprintf(warning.help, sizeof warning.help, "take a smaller time step");
    cz_document_mistake(json, NULL, &warning);
}

void cz_document_warnings(CzJson *json, const CzProblem *problem, const CzEvaluation *evaluation) {
    cz_json_open_list(json, "warnings");
    for (int i = 0; i < cz_problem_n_warning(problem); i++)
        cz_document_mistake(json, NULL, cz_problem_warning(problem, i));
    for (int i = 0; i < evaluation->n_run; i++) {
        const CzRunSummary *run = cz_kept_run(evaluation, i);
        if (run != NULL && cz_run_is_unbalanced(run))
            put_warning(json, run->scenario, "the energy balance is off by more than 0.1 %");
        if (run != NULL && cz_run_misses_laws(run))
            put_warning(json, run->scenario,
                        "the force of a series chain is more than 0.1 % of the largest force of "
                        "its interface from the law of a member");
    }
    cz_json_close(json);
}

void cz_document_mistake(CzJson *json, const char *key, const CzError *mistake) {
    cz_json_open_object(json, key);
    cz_json_text(json, "file", mistake->file[0] != '\0' ? mistake->file : NULL);
    if (mistake->line > 0)
        cz_json_whole(json, "line", mistake->line);
    else
        cz_json_text(json, "line", NULL);
    if (mistake->column > 0)
        cz_json_whole(json, "column", mistake->column);
    else
        cz_json_text(json, "column", NULL);
    cz_json_text(json, "message", mistake->message);
    cz_json_text(json, "help", mistake->help[0] != '\0' ? mistake->help : NULL);
    cz_json_close(json);
}

void cz_document_verdict(CzJson *json, CzVerdict verdict) {
    const bool provisional = verdict == CZ_VERDICT_PROVISIONAL;
    cz_json_text(json, "verdict", cz_verdict_text(provisional ? CZ_VERDICT_PASS : verdict));
    cz_json_flag(json, "provisional", provisional);
}

static const char *track_word(const CzProblem *problem) {
    switch (cz_problem_track(problem)) {
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

/* A total in kilojoules. */
static void put_total(CzJson *json, const CzRunSummary *run, const char *key, double energy) {
    cz_json_real(json, key, cz_run_total(run, energy) / CZ_KILO);
}

static void put_energy(CzJson *json, const CzRunSummary *run) {
    const CzEnergy *energy = &run->energy;
    cz_json_open_object(json, "energy");
    cz_json_real(json, "initial_kJ", energy->initial / CZ_KILO);
    put_total(json, run, "final_kinetic_kJ", energy->final_kinetic);
    put_total(json, run, "dissipated_kJ", energy->dissipated);
    put_total(json, run, "stored_kJ", energy->stored);
    put_total(json, run, "wheel_rail_kJ", energy->wheel_rail);
    put_total(json, run, "running_gear_kJ", energy->running_gear);
    put_total(json, run, "track_kJ", energy->track);
    put_total(json, run, "moving_load_kJ", energy->moving_load);
    put_total(json, run, "absorbers_kJ", energy->absorbers);
    put_total(json, run, "survival_kJ", energy->survival);
    cz_json_exact(json, "balance_error", energy->balance_error);
    cz_json_close(json);
}

static void put_element(CzJson *json, const CzRunSummary *run, const CzElementResult *element) {
    cz_json_open_object(json, NULL);
    cz_json_text(json, "name", element->name);
    cz_json_text(json, "kind", cz_element_text(element->kind));
    put_total(json, run, "energy_kJ", element->energy);
    put_total(json, run, "stored_kJ", element->stored);
    cz_json_real(json, "stroke_mm", element->stroke * CZ_MILLI_PER_UNIT);
    cz_json_real(json, "stroke_used", element->stroke_used);
    cz_json_real(json, "peak_force_kN", element->peak_force / CZ_KILO);
    put_total(json, run, "tube_energy_kJ", element->tube_energy);
    cz_json_flag(json, "sheared", element->sheared);
    cz_json_flag(json, "bottomed_out", element->bottomed_out);
    cz_json_open_object(json, "zone_energy_kJ");
    put_total(json, run, "crush", element->zone_energy[0]);
    put_total(json, run, "temporary", element->zone_energy[1]);
    put_total(json, run, "survival", element->zone_energy[2]);
    cz_json_close(json);
    cz_json_flag(json, "beyond_validity", run->beyond_validity);
    cz_json_close(json);
}

static void put_interface(CzJson *json, const CzRunSummary *run,
                          const CzInterfaceResult *interface) {
    cz_json_open_object(json, NULL);
    cz_json_text(json, "name", interface->name);
    cz_json_real(json, "peak_force_kN", interface->peak_force / CZ_KILO);
    cz_json_real(json, "peak_time_ms", cz_milliseconds(interface->peak_time));
    cz_json_real(json, "shortening_mm", interface->shortening * CZ_MILLI_PER_UNIT);
    put_total(json, run, "energy_kJ", interface->energy);
    cz_json_real(json, "energy_share", cz_run_total(run, interface->energy_share));
    cz_json_flag(json, "bottomed_out", interface->bottomed_out);
    cz_json_open_list(json, "section_force_kN");
    for (int side = 0; side < 2; side++)
        cz_json_real(json, NULL, interface->section_force[side] / CZ_KILO);
    cz_json_close(json);
    cz_json_real(json, "min_overlap_mm", interface->min_overlap * CZ_MILLI_PER_UNIT);
    cz_json_real(json, "vertical_demand_kN", interface->vertical_demand / CZ_KILO);
    cz_json_real(json, "vertical_margin_kN", interface->vertical_margin / CZ_KILO);
    cz_json_real(json, "min_overlap_time_ms", cz_milliseconds(interface->overlap_time));
    cz_json_real(json, "vertical_margin_time_ms", cz_milliseconds(interface->margin_time));
    cz_json_real(json, "ramp", interface->ramp);
    cz_json_real(json, "underframe_rise_mm", interface->underframe_rise * CZ_MILLI_PER_UNIT);
    cz_json_open_list(json, "swing_mrad");
    for (int side = 0; side < 2; side++)
        cz_json_real(json, NULL, interface->swing[side] * CZ_MILLI_PER_UNIT);
    cz_json_close(json);
    cz_json_real(json, "critical_force_kN", interface->critical_force / CZ_KILO);
    cz_json_flag(json, "beyond_validity", run->beyond_validity);
    cz_json_open_list(json, "elements");
    for (int i = 0; i < interface->n_element; i++)
        put_element(json, run, &interface->element[i]);
    cz_json_close(json);
    cz_json_close(json);
}

void cz_document_budget(CzJson *json, const CzVehicleBudget *budget, int n, const int *order) {
    cz_json_text(json, "until", budget->of_lift ? "largest wheel lift" : "largest pitch");
    cz_json_real(json, "until_ms", cz_milliseconds(budget->time));
    cz_json_open_list(json, "sources");
    for (int k = 0; k < (order != NULL ? n : (int)CZ_N_BUDGET); k++) {
        const CzBudgetSource source = (CzBudgetSource)(order != NULL ? order[k] : k);
        cz_json_open_object(json, NULL);
        cz_json_text(json, "name", cz_budget_text(source));
        cz_json_flag(json, "acts_on_body", cz_budget_counts(source));
        cz_json_real(json, "moment_kNms", budget->moment[source] / CZ_KILO);
        cz_json_real(json, "lift_kNs", budget->lift[source] / CZ_KILO);
        cz_json_close(json);
    }
    cz_json_close(json);
}

static void put_vehicle(CzJson *json, const CzRunSummary *run, const CzVehicleResult *vehicle,
                        const CzVehicleBudget *budget) {
    double lift = NAN;
    for (int wheelset = 0; wheelset < 4; wheelset++)
        lift = fmax(lift, vehicle->wheel_lift[wheelset]);

    cz_json_open_object(json, NULL);
    cz_json_text(json, "name", vehicle->name);
    cz_json_real(json, "final_speed_km_h", vehicle->final_speed * CZ_KM_H_PER_M_S);
    cz_json_real(json, "peak_deceleration_g", vehicle->peak_deceleration / CZ_GRAVITY);
    cz_json_real(json, "mean_deceleration_contact_g",
                 vehicle->mean_deceleration_contact / CZ_GRAVITY);
    cz_json_real(json, "mean_deceleration_120ms_g", vehicle->mean_deceleration_120ms / CZ_GRAVITY);
    cz_json_real(json, "max_wheel_lift_mm", lift * CZ_MILLI_PER_UNIT);
    cz_json_real(json, "max_pitch_mrad", vehicle->max_pitch * CZ_MILLI_PER_UNIT);
    cz_json_open_list(json, "wheel_lift_mm");
    for (int wheelset = 0; wheelset < 4; wheelset++)
        cz_json_real(json, NULL, vehicle->wheel_lift[wheelset] * CZ_MILLI_PER_UNIT);
    cz_json_close(json);
    cz_json_open_list(json, "wheel_lift_time_ms");
    for (int wheelset = 0; wheelset < 4; wheelset++)
        cz_json_real(json, NULL, cz_milliseconds(vehicle->wheel_lift_time[wheelset]));
    cz_json_close(json);
    cz_json_real(json, "bogie_lift_mm", vehicle->bogie_lift * CZ_MILLI_PER_UNIT);
    cz_json_text(json, "lifted_bogie",
                 !(vehicle->bogie_lift > 0)   ? NULL
                 : vehicle->lifted_bogie == 0 ? "rear"
                                              : "front");
    cz_json_real(json, "bogie_lift_time_ms", cz_milliseconds(vehicle->bogie_lift_time));
    cz_json_real(json, "link_force_kN", vehicle->link_force / CZ_KILO);
    cz_json_real(json, "link_travel_mm", vehicle->link_travel * CZ_MILLI_PER_UNIT);
    cz_json_real(json, "survival_shortening_mm", vehicle->survival_shortening * CZ_MILLI_PER_UNIT);
    cz_json_flag(json, "checks_override", vehicle->checks_override);
    cz_json_flag(json, "beyond_validity", run->beyond_validity);
    if (budget != NULL && vehicle->checks_override) {
        cz_json_open_object(json, "budget");
        cz_document_budget(json, budget, 0, NULL);
        cz_json_close(json);
    }
    cz_json_close(json);
}

static void put_event(CzJson *json, const CzRunSummary *run, const CzEvent *event) {
    cz_json_open_object(json, NULL);
    cz_json_real(json, "time_ms", cz_milliseconds(event->time));
    cz_json_text(json, "what", cz_event_text(event->what));
    cz_json_text(json, "where", event->where);
    cz_json_text(json, "interface",
                 event->interface >= 0 ? run->interface[event->interface].name : NULL);
    cz_json_flag(json, "beyond_validity", event->time > run->beyond_validity_time);
    cz_json_close(json);
}

static void put_scenario(CzJson *json, const CzProblem *problem, const CzRunSummary *run,
                         int n_job) {
    cz_json_open_object(json, NULL);
    cz_json_text(json, "name", run->scenario);
    cz_document_run_info(json, run->wall_s, run->setup_s, n_job);
    cz_json_text(json, "status", run->status == CZ_OK ? "completed" : "failed");
    cz_json_text(json, "failure", run->failure[0] != '\0' ? run->failure : NULL);
    cz_json_real(json, "simulated_s", cz_seconds(run->simulated));
    cz_json_text(json, "integrator", cz_integrator_text(run->integrator));
    cz_json_exact(json, "time_step_s", run->time_step);
    cz_json_whole(json, "steps", run->n_step);
    cz_json_text(json, "track", track_word(problem));
    cz_json_text(json, "ended", cz_ended_text(run->ended));
    put_energy(json, run);
    cz_json_exact(json, "momentum_error", run->momentum_error);
    cz_json_exact(json, "law_error", run->law_error);
    cz_json_whole(json, "chains_searched", run->n_searched);
    cz_json_exact(json, "rest_residual", run->rest_residual);
    cz_json_real(json, "closing_speed_km_h", run->closing_speed * CZ_KM_H_PER_M_S);
    cz_json_real(json, "plastic_energy_kJ", run->plastic_energy / CZ_KILO);
    cz_json_flag(json, "beyond_validity", run->beyond_validity);
    cz_json_real(json, "beyond_validity_time_ms", cz_milliseconds(run->beyond_validity_time));

    cz_json_open_list(json, "interfaces");
    for (int i = 0; i < run->n_interface; i++)
        put_interface(json, run, &run->interface[i]);
    cz_json_close(json);
    cz_json_open_list(json, "outer_ends");
    for (int i = 0; i < run->n_outer_end; i++)
        put_element(json, run, &run->outer_end[i]);
    cz_json_close(json);
    cz_json_open_list(json, "vehicles");
    for (int i = 0; i < run->n_vehicle; i++)
        put_vehicle(json, run, &run->vehicle[i], run->budget != NULL ? &run->budget[i] : NULL);
    cz_json_close(json);
    cz_json_open_list(json, "events");
    for (int i = 0; i < run->n_event; i++)
        put_event(json, run, &run->event[i]);
    cz_json_close(json);
    cz_json_close(json);
}

static void put_check(CzJson *json, const CzCheckResult *check) {
    cz_json_open_object(json, NULL);
    cz_json_text(json, "name", check->name);
    cz_json_text(json, "scenario", check->scenario);
    if (check->family != NULL)
        cz_json_text(json, "family", check->family);
    cz_json_text(json, "where", check->where);
    if (isfinite(check->when[0])) {
        cz_json_real(json, "from_ms", cz_milliseconds(check->when[0]));
        cz_json_real(json, "to_ms", cz_milliseconds(check->when[1]));
    }
    cz_json_text(json, "kind", check->is_minimum ? "min" : "max");
    cz_json_exact(json, "limit", check->limit);
    cz_json_exact(json, "value", check->value);
    cz_json_text(json, "unit", check->unit);
    cz_json_exact(json, "margin", check->margin);
    cz_document_verdict(json, check->verdict);
    cz_json_text(json, "why", check->why);
    cz_json_flag(json, "beyond_validity", check->beyond_validity);
    cz_json_text(json, "profile", check->profile);
    cz_json_text(json, "clause", check->clause);
    cz_json_text(json, "source", check->source);
    cz_json_text(json, "confidence", check->confidence);
    cz_json_close(json);
}

CzStatus cz_report_write_summary(const CzProblem *problem, const CzEvaluation *evaluation,
                                 const CzReportOptions *options, FILE *stream, CzError *error) {
    const CzReportOptions absent = cz_report_options_default();
    if (options == NULL)
        options = &absent;

    CzJson *json = cz_json_create();
    cz_document_head(json, "crushzone.summary", problem);
    cz_json_text(json, "status", evaluation->status == CZ_OK ? "completed" : "failed");
    cz_document_verdict(json, evaluation->verdict);
    cz_document_run_info(json, options->wall_s, options->setup_s, options->n_job);
    cz_document_warnings(json, problem, evaluation);

    cz_json_open_list(json, "scenarios");
    for (int i = 0; i < evaluation->n_run; i++)
        if (cz_kept_run(evaluation, i) != NULL)
            put_scenario(json, problem, cz_kept_run(evaluation, i), options->n_job);
    cz_json_close(json);
    cz_json_open_list(json, "checks");
    for (int i = 0; i < evaluation->n_check; i++)
        put_check(json, &evaluation->check[i]);
    cz_json_close(json);
    cz_json_open_list(json, "not_judged");
    for (int i = 0; i < evaluation->n_not_judged; i++) {
        cz_json_open_object(json, NULL);
        cz_json_text(json, "train", evaluation->not_judged[i].train);
        cz_json_text(json, "why", evaluation->not_judged[i].why);
        cz_json_flag(json, "inferred", evaluation->not_judged[i].is_inferred);
        cz_json_close(json);
    }
    cz_json_close(json);
    cz_json_open_list(json, "not_covered");
    for (int i = 0; i < evaluation->n_not_covered; i++)
        cz_json_text(json, NULL, evaluation->not_covered[i]);
    cz_json_close(json);
    return cz_json_finish(json, stream, error);
}
