/* Rules of vehicles, trains and scenarios. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/suggest.h"
#include "crushzone/names.h"
#include "problem/meeting.h"
#include "problem/rules.h"

/* ---- vehicles ---- */

/* Mass of the body without ends and running gear [kg]. */
static double body_mass(const CzVehicle *vehicle) {
    const CzBogie *bogie = &vehicle->bogie;
    double mass = vehicle->mass - 2 * (bogie->mass + 2 * bogie->wheelset_mass);
    mass -= vehicle->front.given ? vehicle->front.mass : 0;
    return mass - (vehicle->rear.given ? vehicle->rear.mass : 0);
}

static void check_full_vehicle(const CzRules *rules, const CzVehicle *vehicle) {
    if (!cz_rule_is_written(rules, &vehicle->length))
        cz_rule_absent(rules, vehicle, "a full vehicle needs its length: length_m or length_mm");
    if (body_mass(vehicle) <= 0)
        cz_rule_broken(rules, &vehicle->mass,
                       "no mass is left for the body: ends, bogies and wheelsets have %s of %s",
                       CZ_IN_UNIT(vehicle->mass - body_mass(vehicle), "t", 1e3),
                       CZ_IN_UNIT(vehicle->mass, "t", 1e3));
    if (vehicle->bogie_spacing + vehicle->bogie.axle_spacing >= vehicle->length)
        cz_rule_broken(
            rules, &vehicle->bogie_spacing, "axles %s apart do not fit under a vehicle of %s",
            CZ_MM(vehicle->bogie_spacing + vehicle->bogie.axle_spacing), CZ_MM(vehicle->length));
    if (vehicle->bogie.axle_spacing >= vehicle->bogie_spacing)
        cz_rule_broken(rules, &vehicle->bogie_spacing,
                       "bogies %s apart with axles %s apart would overlap",
                       CZ_MM(vehicle->bogie_spacing), CZ_MM(vehicle->bogie.axle_spacing));
    if (vehicle->cg_height <= vehicle->bogie.wheel_radius)
        cz_rule_broken(rules, &vehicle->cg_height,
                       "a body with its centre of gravity at %s would be below the axles at %s",
                       CZ_MM(vehicle->cg_height), CZ_MM(vehicle->bogie.wheel_radius));
    if (vehicle->bogie.axle_spacing <= 2 * vehicle->bogie.wheel_radius)
        cz_rule_broken(rules, &vehicle->bogie.axle_spacing,
                       "wheels with a radius of %s overlap on axles %s apart",
                       CZ_MM(vehicle->bogie.wheel_radius), CZ_MM(vehicle->bogie.axle_spacing));
}

void cz_rules_check_vehicle(const CzRules *rules, const CzVehicle *vehicle) {
    if (vehicle->model != CZ_MODEL_FIXED && !cz_rule_is_written(rules, &vehicle->mass))
        cz_rule_absent(rules, vehicle, "a %s vehicle needs its mass: mass_kg or mass_t",
                       cz_word_sets[CZ_WORDS_MODEL].word[vehicle->model].word);
    if (vehicle->model == CZ_MODEL_FULL)
        check_full_vehicle(rules, vehicle);
    const double ends =
        cz_end_mass(vehicle, &vehicle->front) + cz_end_mass(vehicle, &vehicle->rear);
    if (vehicle->model == CZ_MODEL_RIGID && ends >= vehicle->mass)
        cz_rule_broken(rules, &vehicle->mass,
                       "no mass is left for the body: the ends have %s of %s",
                       CZ_IN_UNIT(ends, "t", 1e3), CZ_IN_UNIT(vehicle->mass, "t", 1e3));
}

/* ---- trains ---- */

/* Whether a train has a vehicle of a model. */
static bool has(const CzTrain *train, int model) {
    for (int i = 0; i < train->n_vehicles; i++)
        if (train->vehicles[i].model == model)
            return true;
    return false;
}

/* A name for a sentence, which may be absent. */
static const char *name_of(const char *name) {
    return name != NULL ? name : "";
}

static bool can_deflect(const CzEnd *end) {
    return end->coupler.given || end->anti_climber.given || end->side_buffers.given ||
           end->n_stages > 0 || end->curve.given;
}

/* An end of a vehicle and the one that it faces. */
typedef struct Facing {
    const CzVehicle *own, *other;
    const CzEnd *end, *opposite;
    double rise; /* of the opposite end over its height in the file; NaN where it does not matter
                    [m] */
} Facing;

/* A part without a counterpart that passes the end opposite carries no force. */
static void warn_of_passing(const CzRules *rules, const Facing *facing, CzPartKind kind) {
    const CzEnd *end = facing->end;
    static const char *const names[] = {"coupler", "anti-climber", "side buffers"};
    const void *const place[] = {&end->coupler, &end->anti_climber, &end->side_buffers};
    if (!cz_end_has(end, kind))
        return;
    const CzMeets meets = cz_part_meets(end, kind, facing->opposite, facing->rise);
    const bool is_over = meets == CZ_PASSES_OVER;
    if (!is_over && meets != CZ_PASSES_UNDER)
        return;
    const CzHeightRange part = cz_part_heights(end, kind);
    const CzHeightRange structure = cz_structure_heights(facing->opposite);
    cz_rule_warning(rules, place[kind],
                    "no force: the %s of '%.48s', %s at %s, %s %s the end structure of '%.48s', "
                    "whose %s is at %s",
                    names[kind], name_of(facing->own->name), is_over ? "lowest" : "highest",
                    CZ_MM(is_over ? part.low : part.high),
                    kind == CZ_PART_SIDE_BUFFERS ? "pass" : "passes", is_over ? "over" : "under",
                    name_of(facing->other->name), is_over ? "top" : "bottom",
                    CZ_MM((is_over ? structure.high : structure.low) + facing->rise));
}

/* Couplers and side buffers meet their kind at any height; the place is that of the lower one. */
static void warn_of_heights_apart(const CzRules *rules, const Facing *facing, CzPartKind kind) {
    const CzEnd *end = facing->end;
    const bool is_coupler = kind == CZ_PART_COUPLER;
    const double own = cz_part_heights(end, kind).low;
    const double other = cz_part_heights(facing->opposite, kind).low + facing->rise;
    if (!cz_parts_may_pass(end, kind, facing->opposite, facing->rise) || other < own)
        return;
    cz_rule_warning(rules,
                    is_coupler ? (const void *)&end->coupler : (const void *)&end->side_buffers,
                    "the %s of '%.48s' meets that of '%.48s', which is %s higher: in reality it "
                    "may pass under it, so that override is NOT CHECKED",
                    is_coupler ? "coupler" : "pair of side buffers", name_of(facing->own->name),
                    name_of(facing->other->name), CZ_MM(other - own));
}

/* Anti-climbers on plates are a member of the chain of the side buffers, beside which there is no
 * damper. */
static void warn_of_damping(const CzRules *rules, const Facing *facing) {
    const CzAntiClimber *device = &facing->end->anti_climber;
    if (cz_end_has(facing->end, CZ_PART_FACE) && device->damping != 0 &&
        cz_part_meets(facing->end, CZ_PART_FACE, facing->opposite, facing->rise) == CZ_MEETS_PLATES)
        cz_rule_warning(rules, &device->damping,
                        "the damping of '%.48s' has no effect on the force of its anti-climber "
                        "on the side buffers of '%.48s'",
                        name_of(facing->own->name), name_of(facing->other->name));
}

/* A crush zone of a rigid vehicle acts on couplers and side buffers through the mass in front of
 * it. */
static void warn_of_no_face_mass(const CzRules *rules, const Facing *facing) {
    const CzEnd *end = facing->end;
    if (end->given && facing->own->model == CZ_MODEL_RIGID &&
        (end->n_stages > 0 || end->curve.given) && isnan(end->face_mass) &&
        cz_end_is_struck(end, facing->opposite, -facing->rise))
        cz_rule_warning(rules, end,
                        "the crush zone of '%.48s' does not act on coupler and side buffers of "
                        "'%.48s', because its end has no mass: face_mass_kg or face_mass_t",
                        name_of(facing->own->name), name_of(facing->other->name));
}

/* The coupler of a rigid vehicle that meets a full one is part of a strut between two pivots. */
static void check_strut(const CzRules *rules, const Facing *facing) {
    const CzCoupler *coupler = &facing->end->coupler;
    if (!coupler->given || coupler->length > 0 || facing->own->model != CZ_MODEL_RIGID ||
        facing->other->model != CZ_MODEL_FULL)
        return;
    const char *own = name_of(facing->own->name), *other = name_of(facing->other->name);
    if (facing->opposite->coupler.given)
        cz_rule_absent(rules, coupler,
                       "the coupler of rigid '%.48s' meets that of full '%.48s', and the line "
                       "between their pivots requires the length of both: length_m or length_mm",
                       own, other);
    else if (cz_part_strikes(facing->end, CZ_PART_COUPLER, facing->opposite, facing->rise))
        cz_rule_absent(rules, coupler,
                       "the coupler of rigid '%.48s' strikes full '%.48s', and the line of its "
                       "force requires its length: length_m or length_mm",
                       own, other);
}

static bool has_full(const CzVehicle *behind, const CzVehicle *ahead) {
    return behind->model == CZ_MODEL_FULL || ahead->model == CZ_MODEL_FULL;
}

static bool has_fixed(const CzVehicle *behind, const CzVehicle *ahead) {
    return behind->model == CZ_MODEL_FIXED || ahead->model == CZ_MODEL_FIXED;
}

/* The car ahead is higher by `rise` than in its file, compared with the one behind. */
static void check_neighbours(const CzRules *rules, const CzVehicle *behind, const CzVehicle *ahead,
                             double rise) {
    const bool has_levels = has_full(behind, ahead) && !has_fixed(behind, ahead);
    const double ahead_rise = has_levels ? rise : NAN;
    const Facing ends[2] = {{behind, ahead, &behind->front, &ahead->rear, ahead_rise},
                            {ahead, behind, &ahead->rear, &behind->front, -ahead_rise}};
    if (!behind->given || !ahead->given)
        return;
    if (!can_deflect(&behind->front) && !can_deflect(&ahead->rear))
        cz_rule_absent(rules, ahead,
                       "no device can deflect between '%.48s' and '%.48s': neither end has one",
                       name_of(behind->name), name_of(ahead->name));
    for (int i = 0; i < 2; i++) {
        for (int kind = 0; kind < CZ_N_PART; kind++) {
            warn_of_passing(rules, &ends[i], (CzPartKind)kind);
            warn_of_heights_apart(rules, &ends[i], (CzPartKind)kind);
        }
        warn_of_no_face_mass(rules, &ends[i]);
        warn_of_damping(rules, &ends[i]);
        check_strut(rules, &ends[i]);
    }
}

/* A wall or buffer stop has no speed; NaN means that none is given. */
static void check_standing(const CzRules *rules, const CzTrain *train, const double *speed) {
    if (has(train, CZ_MODEL_FIXED) && *speed != 0 && !isnan(*speed))
        cz_rule_broken(rules, speed, "a train with a fixed vehicle must have speed 0");
}

static bool can_brake(const CzRules *rules, const CzTrain *train) {
    bool brakes = train->brake.given && train->brake.ratio > 0;
    for (int i = 0; i < rules->input->n_scenarios && train->brake.given; i++)
        brakes |= rules->input->scenarios[i].brake_ratio > 0 ||
                  rules->input->scenarios[i].partner_brake_ratio > 0;
    return brakes && !has(train, CZ_MODEL_FIXED);
}

static void check_train(const CzRules *rules, const CzTrain *train) {
    const CzSimulation *simulation = &rules->input->simulation;
    if (has(train, CZ_MODEL_FULL) && !cz_rule_is_written(rules, &train->brake))
        cz_rule_absent(rules, train,
                       "a train with full vehicles needs 'brake': {ratio, axle_share}");
    if (has(train, CZ_MODEL_FULL) && !cz_rule_is_written(rules, &simulation->adhesion))
        cz_rule_absent(
            rules, rules->input,
            "a problem with full vehicles needs 'simulation: {adhesion: {friction: ...}}'");
    else if (can_brake(rules, train) && !cz_rule_is_written(rules, &simulation->adhesion))
        cz_rule_absent(
            rules, &train->brake,
            "a brake acts through the wheel-rail friction: it needs 'simulation: {adhesion: "
            "{friction: ...}}'");
    check_standing(rules, train, &train->speed);
    for (int i = 1; i < train->n_vehicles; i++)
        check_neighbours(rules, &train->vehicles[i - 1], &train->vehicles[i], 0);
}

/* Whether the partners are missing because the profile that adds them could not be used. */
static bool lacks_profile(const CzRules *rules) {
    return rules->input->checks.profile != NULL && rules->problem->whole_profile == NULL;
}

static void report_one_train(const CzRules *rules) {
    static const char one[] = "a collision needs two trains, but there is one";
    const CzInput *input = rules->input;
    const CzProfile *whole = rules->problem->whole_profile;
    if (whole != NULL)
        cz_rule_broken(rules, &input->trains, "%s, and profile '%.96s' adds no partner: %s", one,
                       input->checks.profile,
                       whole->n_scenarios == 0 ? "it has limits and no scenarios"
                                               : "none of its scenarios is run");
    else
        cz_rule_broken(rules, &input->trains,
                       "%s" CZ_HELP "a profile with scenarios, named in 'checks', adds partners; "
                       "'crushzone profile list' counts them",
                       one);
}

void cz_rules_check_trains(const CzRules *rules) {
    const CzInput *input = rules->input;
    if (input->n_trains == 1 && !lacks_profile(rules))
        report_one_train(rules);
    for (int i = 0; i < input->n_trains; i++)
        check_train(rules, &input->trains[i]);
}

/* ---- scenarios ---- */

/* A train by its name; NULL with a mistake when there is none. */
static const CzTrain *find_train(const CzRules *rules, const char *const *name) {
    CzSuggestion suggestion = {0};
    const CzInput *input = rules->input;
    const int train = CZ_FIND_NAMED(*name, CzTrain, input->trains, input->n_trains, &suggestion);
    if (train >= 0)
        return &input->trains[train];
    cz_rule_broken(rules, name, "there is no train '%.48s'", *name);
    cz_mistake_suggest(rules->mistakes, &suggestion);
    return NULL;
}

/* The two trains of a scenario, the one behind first; false when they are not there. */
static bool find_pair(const CzRules *rules, const CzScenario *scenario, const CzTrain *pair[2]) {
    const CzTexts *names = &scenario->trains;
    if (!cz_rule_is_written(rules, names)) {
        for (int i = 0; i < 2; i++)
            pair[i] = cz_input_train(rules->input, NULL, i);
        return pair[1] != NULL;
    }
    if (names->n_text != 2) {
        cz_rule_broken(rules, names, "a collision needs the names of two trains, but this has %d",
                       names->n_text);
        return false;
    }
    for (int i = 0; i < 2; i++)
        pair[i] = find_train(rules, &names->text[i]);
    if (pair[0] != NULL && pair[0] == pair[1])
        cz_rule_broken(rules, names, "a train cannot collide with itself");
    return pair[0] != NULL && pair[1] != NULL && pair[0] != pair[1];
}

static double chosen(double own, double otherwise) {
    return isnan(own) ? otherwise : own;
}

/* The train behind must approach the one ahead. */
static void check_closing(const CzRules *rules, const CzScenario *scenario,
                          const CzTrain *const pair[2]) {
    const double behind = chosen(scenario->speed, pair[0]->speed);
    const double ahead = chosen(scenario->partner_speed, pair[1]->speed);
    const void *place = cz_rule_is_written(rules, &scenario->speed) ? (const void *)&scenario->speed
                        : cz_rule_is_written(rules, &scenario->name)
                            ? (const void *)&scenario->name
                            : (const void *)&pair[0]->speed;
    if (behind <= ahead)
        cz_rule_broken(rules, place,
                       "the trains never meet: '%.40s' runs at %s behind '%.40s' at %s",
                       name_of(pair[0]->name), CZ_IN_UNIT(behind, "km/h", 1 / 3.6),
                       name_of(pair[1]->name), CZ_IN_UNIT(ahead, "km/h", 1 / 3.6));
    check_standing(rules, pair[0], &scenario->speed);
    check_standing(rules, pair[1], &scenario->partner_speed);
}

/* The additional interface with a perturbation must be inside one of the two trains. */
static void check_interface(const CzRules *rules, const CzScenario *scenario,
                            const CzTrain *const pair[2]) {
    CzSuggestion suggestion = {0};
    char known[CZ_INTERFACE_SIZE];
    if (scenario->perturbed_interface == NULL) {
        if (scenario->perturbation != 0 && cz_rule_is_written(rules, &scenario->perturbation))
            cz_rule_broken(rules, &scenario->perturbation,
                           "a perturbation needs 'perturbed_interface', such as A3-A4");
        return;
    }
    if (strcmp(scenario->perturbed_interface, CZ_FIRST_COUPLED) == 0) {
        if (pair[0]->n_vehicles < 2)
            cz_rule_broken(rules, &scenario->perturbed_interface,
                           "train '%.48s' has one vehicle and no coupled interface",
                           name_of(pair[0]->name));
        return;
    }
    for (int t = 0; t < 2; t++)
        for (int i = 1; i < pair[t]->n_vehicles; i++) {
            const char *behind = pair[t]->vehicles[i - 1].name, *ahead = pair[t]->vehicles[i].name;
            if (behind == NULL || ahead == NULL)
                continue;
            snprintf(known, sizeof known, "%.48s-%.48s", behind, ahead);
            if (strcmp(known, scenario->perturbed_interface) == 0)
                return;
            cz_suggest(&suggestion, scenario->perturbed_interface, known);
        }
    cz_rule_broken(rules, &scenario->perturbed_interface, "there is no inner interface '%.96s'",
                   scenario->perturbed_interface);
    cz_mistake_suggest(rules->mistakes, &suggestion);
}

/* A height offset has an effect only on a full vehicle that meets a movable one. */
static void check_offset(const CzRules *rules, const double *offset, const CzVehicle *behind,
                         const CzVehicle *ahead) {
    const bool is_fixed = has_fixed(behind, ahead);
    if (!isnan(*offset) && *offset != 0 && (!has_full(behind, ahead) || is_fixed))
        cz_rule_warning(rules, offset, "no effect: %s",
                        is_fixed ? "a fixed vehicle is a vertical plane"
                                 : "neither of its vehicles is of model: full");
}

/* Offsets of the trains count where the scenario has none. */
static void check_offsets(const CzRules *rules, const CzScenario *scenario,
                          const CzTrain *const pair[2]) {
    if (pair[0]->n_vehicles == 0 || pair[1]->n_vehicles == 0)
        return;
    const CzVehicle *behind = &pair[0]->vehicles[pair[0]->n_vehicles - 1];
    const CzVehicle *ahead = &pair[1]->vehicles[0];
    check_offset(rules, &scenario->height_offset, behind, ahead);
    check_offset(rules, &pair[0]->height_offset, behind, ahead);
    if (isnan(scenario->height_offset))
        check_offset(rules, &pair[1]->height_offset, behind, ahead);
}

static void check_brake(const CzRules *rules, const double *ratio, const CzTrain *train) {
    if (!isnan(*ratio) && !cz_rule_is_written(rules, &train->brake))
        cz_rule_broken(rules, ratio, "train '%.48s' has no 'brake'", name_of(train->name));
}

/* At least one of two trains must not be an obstacle. */
static void check_roles(const CzRules *rules, const CzTrain *const pair[2]) {
    bool any_judged = false;
    for (int i = 0; i < 2; i++)
        any_judged |= pair[i]->role != CZ_ROLE_OBSTACLE && !has(pair[i], CZ_MODEL_FIXED);
    if (!any_judged)
        cz_rule_broken(
            rules, pair[0]->role == CZ_ROLE_OBSTACLE ? &pair[0]->role : &pair[1]->role,
            "no vehicle would be judged: neither '%.48s' nor '%.48s' is a train, by role "
            "or because it is fixed",
            name_of(pair[0]->name), name_of(pair[1]->name));
}

/* A train that no scenario uses is probably a mistake: without names the first two trains
 * collide. */
static void check_taken(const CzRules *rules, const CzTrain *train) {
    const CzInput *input = rules->input;
    bool is_taken = train < input->trains + 2 && input->n_scenarios == 0;
    for (int i = 0; i < input->n_scenarios; i++) {
        const CzTexts *names = &input->scenarios[i].trains;
        if (names->n_text == 0)
            is_taken |= train < input->trains + 2;
        for (int k = 0; k < names->n_text && train->name != NULL; k++)
            is_taken |= strcmp(names->text[k], train->name) == 0;
    }
    if (!is_taken)
        cz_rule_warning(
            rules, &train->name,
            "no effect: train '%.48s' is in no scenario; a scenario names its two trains by "
            "'trains: [BEHIND, AHEAD]', otherwise the first two of the file collide",
            name_of(train->name));
}

static void check_changes(const CzRules *rules, const CzScenario *scenario) {
    for (int i = 0; i < scenario->n_changes; i++) {
        const CzChange *change = &scenario->changes[i];
        const int n_kind = cz_rule_is_written(rules, &change->value) +
                           cz_rule_is_written(rules, &change->factor) +
                           cz_rule_is_written(rules, &change->add);
        if (change->given && n_kind != 1)
            cz_rule_broken(rules, change,
                           "a change needs exactly one of 'value', 'factor' and 'add'");
    }
}

void cz_rules_check_scenarios(const CzRules *rules) {
    const CzInput *input = rules->input;
    for (int i = 0; i < input->n_trains; i++)
        check_taken(rules, &input->trains[i]);
    for (int i = 0; i < input->n_scenarios; i++) {
        const CzScenario *scenario = &input->scenarios[i];
        const CzTrain *pair[2];
        check_changes(rules, scenario);
        if (!scenario->given || !find_pair(rules, scenario, pair))
            continue;
        check_closing(rules, scenario, pair);
        check_roles(rules, pair);
        check_interface(rules, scenario, pair);
        check_offsets(rules, scenario, pair);
        check_brake(rules, &scenario->brake_ratio, pair[0]);
        check_brake(rules, &scenario->partner_brake_ratio, pair[1]);
        if (pair[0]->n_vehicles > 0 && pair[1]->n_vehicles > 0)
            check_neighbours(
                rules, &pair[0]->vehicles[pair[0]->n_vehicles - 1], &pair[1]->vehicles[0],
                chosen(scenario->height_offset, pair[1]->height_offset) - pair[0]->height_offset);
    }
    if (input->n_scenarios == 0 && input->n_trains > 1) {
        const CzTrain *const pair[2] = {&input->trains[0], &input->trains[1]};
        check_roles(rules, pair);
    }
}
