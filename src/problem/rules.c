/* Checks the rules between the values of a problem, record by record. */
#include "problem/rules.h"

#include <math.h>

#include "base/error.h"

/* Properties of a track have an effect where it is elastic and carries wheels; friction where a
 * vehicle rolls or brakes. */
static void check_what_acts(const CzRules *rules) {
    const CzInput *input = rules->input;
    bool rolls = false, brakes = false;
    for (int i = 0; i < rules->problem->n_vehicle; i++)
        rolls |= rules->vehicle[i].model == CZ_MODEL_FULL;
    for (int i = 0; i < input->n_trains; i++)
        brakes |= input->trains[i].brake.given;
    const bool is_elastic = input->simulation.track != CZ_TRACK_RIGID;
    if (input->track.given && !(rolls && is_elastic))
        cz_rule_warning(rules, &input->track, "no effect: %s",
                        rolls ? "simulation: {track: rigid} does not use `track`"
                              : "no vehicle of model: full is on the track");
    else if (input->track.given && input->simulation.track != CZ_TRACK_FE &&
             cz_rule_is_written(rules, &input->track.nodes_per_bay))
        cz_rule_warning(rules, &input->track.nodes_per_bay,
                        "no effect: only simulation: {track: fe} has nodes");
    static const char *const nothing =
        "no effect: no vehicle is of model: full, and no train has a brake";
    if (input->simulation.adhesion.given && !rolls && !brakes)
        cz_rule_warning(rules, &input->simulation.adhesion, nothing);
    for (int i = 0; i < input->n_scenarios && !rolls && !brakes; i++)
        if (!isnan(input->scenarios[i].friction))
            cz_rule_warning(rules, &input->scenarios[i].friction, nothing);
}

/* A payload requires a share of it in a scenario, and a share requires a payload. */
static void check_payload(const CzRules *rules) {
    const CzInput *input = rules->input;
    const double *payload = NULL, *share = NULL;
    for (int i = 0; i < rules->problem->n_vehicle && payload == NULL; i++)
        if (rules->vehicle[i].payload > 0)
            payload = &rules->vehicle[i].payload;
    for (int i = 0; i < input->n_scenarios && share == NULL; i++)
        if (cz_rule_is_written(rules, &input->scenarios[i].payload_share))
            share = &input->scenarios[i].payload_share;
    if (payload != NULL && share == NULL)
        cz_rule_warning(rules, payload,
                        "no effect: no scenario has a 'payload_share', so no payload is on board");
    if (payload == NULL && share != NULL && *share > 0 && !cz_rule_is_general(rules, share))
        cz_rule_warning(rules, share, "no effect: no vehicle has a 'payload'");
}

/* The end criterion and its longest time have an effect in runs without a duration. */
static void check_times(const CzRules *rules) {
    const CzSimulation *simulation = &rules->input->simulation;
    bool all_have = rules->input->n_scenarios > 0;
    for (int i = 0; i < rules->input->n_scenarios; i++)
        all_have &= rules->input->scenarios[i].duration > 0;
    if (all_have && cz_rule_is_written(rules, &simulation->duration))
        cz_rule_warning(rules, &simulation->duration,
                        "no effect: every scenario has a duration of its own");
    if ((all_have || simulation->duration > 0) && cz_rule_is_written(rules, &simulation->longest))
        cz_rule_warning(rules, &simulation->longest,
                        "no effect: every run has a duration at which it ends");
}

/* A time step of the simulation must not be longer than the output step. */
static void check_simulation(const CzRules *rules) {
    const CzSimulation *simulation = &rules->input->simulation;
    if (simulation->time_step > simulation->output_step)
        cz_rule_broken(rules, &simulation->time_step,
                       "a time step of %s is longer than the output step of %s",
                       CZ_IN_UNIT(simulation->time_step, "ms", 1e-3),
                       CZ_IN_UNIT(simulation->output_step, "ms", 1e-3));
    const CzAdhesion *adhesion = &simulation->adhesion;
    if (adhesion->given && adhesion->sliding_friction > adhesion->friction)
        cz_rule_broken(rules, &adhesion->sliding_friction,
                       "sliding_friction %g is above the peak friction %g",
                       adhesion->sliding_friction, adhesion->friction);
}

static void check_vehicles(const CzRules *rules) {
    for (int i = 0; i < rules->problem->n_vehicle; i++) {
        const CzVehicle *vehicle = &rules->vehicle[i];
        if (!vehicle->given)
            continue;
        cz_rules_check_vehicle(rules, vehicle);
        cz_rules_check_end(rules, vehicle, &vehicle->front);
        cz_rules_check_end(rules, vehicle, &vehicle->rear);
    }
}

void cz_rules_check_collision(const CzRules *rules) {
    check_simulation(rules);
    check_what_acts(rules);
    check_payload(rules);
    check_times(rules);
    cz_rules_check_names(rules);
    check_vehicles(rules);
    cz_rules_check_trains(rules);
    cz_rules_check_scenarios(rules);
}

CzStatus cz_rules_check_again(CzProblem *made, CzError *error) {
    CzReader *reader = &made->reader;
    const CzRules rules = cz_rules_of(made);
    if (!reader->arena.out_of_memory)
        cz_rules_check_collision(&rules);
    cz_mistakes_finish(&reader->mistakes);
    return cz_mistakes_status(&reader->mistakes, "the problem with other settings", error);
}

CzStatus cz_problem_check_vehicles(const CzProblem *problem, const CzVehicle *vehicles,
                                   CzError *error) {
    CzArena arena = {0};
    CzMistakes mistakes = {.arena = &arena};
    const CzRules rules = {.problem = problem,
                           .reader = &problem->reader,
                           .input = &problem->input,
                           .vehicle = vehicles,
                           .mistakes = &mistakes};
    check_vehicles(&rules);
    const CzStatus status = cz_mistakes_status(&mistakes, "the rules of a design", error);
    cz_arena_free(&arena);
    return status;
}

void cz_problem_rule_ratios(const CzProblem *problem, const CzVehicle *vehicles,
                            const CzVehicle *vehicle, const CzEnd *end, double *ratio) {
    const CzRules rules = {.problem = problem,
                           .reader = &problem->reader,
                           .input = &problem->input,
                           .vehicle = vehicles,
                           .ratio = ratio};
    for (int i = 0; i < CZ_N_VALUE_RULE; i++)
        ratio[i] = NAN;
    cz_rules_check_end(&rules, vehicle, end);
}
