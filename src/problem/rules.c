/* What must hold between the values of a problem: going through the records. */
#include "problem/rules.h"

#include <math.h>
#include <stdarg.h>
#include <stdio.h>

#include "base/error.h"
#include "base/number.h"

/* Place of a field; a candidate's values stand where the problem's own were written. */
static const CzPlace *find_place(const CzRules *rules, const void *field) {
    const uintptr_t at = (uintptr_t)field, start = (uintptr_t)rules->vehicle;
    const size_t n_byte = (size_t)rules->problem->n_vehicle * sizeof(CzVehicle);
    const void *own = field;
    if (at >= start && at - start < n_byte)
        own = (const char *)rules->problem->vehicle + (at - start);
    return cz_places_find(&rules->reader->places, own);
}

static void tell(const CzRules *rules, CzMistakes *mistakes, const void *field, const char *format,
                 va_list arguments) {
    char sentence[400];
    const CzPlace *place = find_place(rules, field);
    if (place == NULL || mistakes == NULL)
        return;
    vsnprintf(sentence, sizeof sentence, format, arguments);
    const bool is_value = place->value != NULL && place->value->kind == CZ_NODE_TEXT;
    cz_mistake(mistakes, is_value ? place->value : place->node, place->trail, "%s", sentence);
}

void cz_rule_broken(const CzRules *rules, const void *field, const char *format, ...) {
    va_list arguments;
    va_start(arguments, format);
    tell(rules, rules->mistakes, field, format, arguments);
    va_end(arguments);
}

void cz_rule_warning(const CzRules *rules, const void *field, const char *format, ...) {
    va_list arguments;
    va_start(arguments, format);
    tell(rules, rules->warnings, field, format, arguments);
    va_end(arguments);
}

void cz_rule_absent(const CzRules *rules, const void *field, const char *format, ...) {
    va_list arguments;
    if (rules->reader->has_holes)
        return;
    va_start(arguments, format);
    tell(rules, rules->mistakes, field, format, arguments);
    va_end(arguments);
}

bool cz_rule_is_written(const CzRules *rules, const void *field) {
    const CzPlace *place = find_place(rules, field);
    return place != NULL && place->size == 0;
}

const char *cz_rule_text(char text[48], double si, const char *unit, double unit_si) {
    char number[CZ_NUMBER_TEXT];
    snprintf(text, 48, "%s %s", cz_number_print_short(number, si / unit_si), unit);
    return text;
}

double cz_rule_stroke(const CzStage *stages, int n_stage, const CzTable *curve) {
    if (curve != NULL && curve->given)
        return curve->x[curve->n_point - 1];
    double stroke = 0;
    for (int i = 0; i < n_stage; i++)
        stroke += stages[i].stroke;
    return stroke;
}

const char *cz_value_rule_name(CzValueRule rule) {
    static const char *const names[] = {
#define CZ_VALUE_RULE(constant, name, doc) name,
#include "problem/value_rules.def"
#undef CZ_VALUE_RULE
    };
    return names[rule];
}

const char *cz_value_rule_doc(CzValueRule rule) {
    static const char *const docs[] = {
#define CZ_VALUE_RULE(constant, name, doc) doc,
#include "problem/value_rules.def"
#undef CZ_VALUE_RULE
    };
    return docs[rule];
}

void cz_rule_note(const CzRules *rules, CzValueRule rule, double value, double most) {
    if (rules->ratio == NULL || isnan(value) || isnan(most))
        return;
    const double far_off = 1e3; /* finite, whatever there is to be at most 0 */
    const double ratio = most > 0 ? fmin(value / most, far_off) : value > 0 ? far_off : 0;
    rules->ratio[rule] = fmax(rules->ratio[rule], ratio); /* passes over NaN */
}

/* What a track is made of matters where it is elastic and something rolls on it; friction where
 * something rolls or brakes. */
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
                        rolls ? "simulation: {track: rigid} has no use for a roadbed"
                              : "no vehicle of model: full stands on the track");
    else if (input->track.given && input->simulation.track != CZ_TRACK_FE &&
             cz_rule_is_written(rules, &input->track.nodes_per_bay))
        cz_rule_warning(rules, &input->track.nodes_per_bay,
                        "no effect: only simulation: {track: fe} has nodes");
    if (input->simulation.adhesion.given && !rolls && !brakes)
        cz_rule_warning(rules, &input->simulation.adhesion,
                        "no effect: no vehicle is of model: full, and no train has a brake");
}

/* A step of the simulation cannot be longer than what is written out. */
static void check_simulation(const CzRules *rules) {
    const CzSimulation *simulation = &rules->input->simulation;
    char step[48], output[48];
    if (simulation->time_step > simulation->output_step)
        cz_rule_broken(rules, &simulation->time_step,
                       "a time step of %s is longer than the output step of %s",
                       cz_rule_text(step, simulation->time_step, "ms", 1e-3),
                       cz_rule_text(output, simulation->output_step, "ms", 1e-3));
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

static CzRules rules_of(CzProblem *problem) {
    CzReader *reader = &problem->reader;
    return (CzRules){
        problem,           reader, &problem->input, problem->vehicle, &reader->mistakes,
        &reader->warnings, NULL};
}

void cz_rules_check_collision(CzProblem *problem) {
    const CzRules rules = rules_of(problem);
    check_simulation(&rules);
    check_what_acts(&rules);
    cz_rules_check_names(&rules);
    check_vehicles(&rules);
    cz_rules_check_trains(&rules);
    cz_rules_check_scenarios(&rules);
}

void cz_rules_check(CzProblem *problem) {
    cz_rules_check_collision(problem);
    const CzRules rules = rules_of(problem);
    cz_rules_check_design(&rules);
    cz_rules_check_fit(&rules);
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
    CzStatus status = CZ_OK;
    check_vehicles(&rules);
    if (arena.out_of_memory) {
        status = cz_fail(error, CZ_STATUS_NO_MEMORY, "there is no memory to judge a design");
    } else if (mistakes.n_mistake > 0) {
        status = CZ_STATUS_INPUT;
        if (error != NULL)
            *error = mistakes.mistake[0]->error;
    }
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
