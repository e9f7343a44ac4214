/* Finds out whether a scenario sets a value itself that a path names elsewhere in the problem. */
#include <stdlib.h>
#include <string.h>

#include "problem/changes.h"

/* A number of a train or of the simulation, and that of a scenario which replaces it. */
typedef struct Replacement {
    const double *field, *own;
} Replacement;

/* The key of the scenario that sets a number of a train or of the simulation; NULL for none. */
static const char *key_for(const CzProblem *problem, const CzScenario *scenario,
                           const double *field) {
    const CzInput *input = &problem->input;
    const CzTrain *behind = cz_input_train(input, scenario, 0);
    const CzTrain *ahead = cz_input_train(input, scenario, 1);
    if (behind == NULL || ahead == NULL)
        return NULL;
    const Replacement replacements[] = {{&behind->speed, &scenario->speed},
                                        {&ahead->speed, &scenario->partner_speed},
                                        {&ahead->height_offset, &scenario->height_offset},
                                        {&behind->brake.ratio, &scenario->brake_ratio},
                                        {&ahead->brake.ratio, &scenario->partner_brake_ratio},
                                        {&input->simulation.adhesion.friction, &scenario->friction},
                                        {&input->simulation.duration, &scenario->duration}};
    for (size_t i = 0; i < sizeof replacements / sizeof *replacements; i++) {
        const Replacement *replacement = &replacements[i];
        if (replacement->field != field || isnan(*replacement->own))
            continue;
        const CzPlace *place = cz_places_find(&problem->places, replacement->own);
        return place != NULL && place->key != NULL ? place->node->text : "it";
    }
    return NULL;
}

/* The key of the scenario that is also the key of another one whose number a path names; NULL for
 * none, and where the scenario takes the number from that one by `like`. */
static const char *key_beside(const CzProblem *problem, const CzScenario *scenario,
                              const double *field) {
    const CzInput *input = &problem->input;
    for (int i = 0; i < input->n_scenarios; i++) {
        const CzScenario *other = &input->scenarios[i];
        const char *at = (const char *)field, *begin = (const char *)other;
        if (other == scenario || at < begin || at >= (const char *)(other + 1))
            continue;
        const CzPlace *its = cz_places_find(&problem->places, field);
        const CzPlace *own =
            cz_places_find(&problem->places, (const char *)scenario + (at - begin));
        const bool is_set = own != NULL && own->key != NULL;
        const bool is_taken = scenario->like != NULL && is_set && own->value == its->value;
        return is_set && !is_taken ? own->node->text : NULL;
    }
    return NULL;
}

/* Whether a number is one of a train that the scenario does not run. */
static bool is_of_other_train(const CzProblem *problem, const CzScenario *scenario,
                              const CzTarget *target) {
    const CzInput *input = &problem->input;
    const char *at = (const char *)target->field;
    for (int i = 0; i < input->n_trains; i++) {
        const CzTrain *train = &input->trains[i];
        const long first = train->vehicles - problem->vehicle;
        const bool is_its =
            target->vehicle >= 0
                ? target->vehicle >= first && target->vehicle < first + train->n_vehicles
                : at >= (const char *)train && at < (const char *)(train + 1);
        if (is_its)
            return cz_input_train(input, scenario, 0) != train &&
                   cz_input_train(input, scenario, 1) != train;
    }
    return false;
}

/* Whether a change of the scenario puts a value of its own there. */
static bool is_changed(const CzProblem *problem, int scenario, const double *field) {
    const CzScenario *its = &problem->input.scenarios[scenario];
    bool is = false;
    for (int i = 0; i < its->n_changes && !is; i++) {
        CzTargets targets = {0};
        double number;
        if (cz_change_kind(&its->changes[i], &number) == CZ_CASE_VALUE &&
            cz_problem_find_changed(problem, scenario, its->changes[i].path, &targets, NULL) ==
                CZ_OK)
            for (int k = 0; k < targets.n; k++)
                is |= targets.target[k].field == field;
        free(targets.target);
    }
    return is;
}

const char *cz_problem_replaced_by(const CzProblem *problem, int scenario,
                                   const CzTargets *targets) {
    const CzScenario *its = &problem->input.scenarios[scenario];
    const char *by = NULL;
    for (int i = 0; i < targets->n; i++) {
        const CzTarget *target = &targets->target[i];
        const char *key = key_for(problem, its, target->field);
        if (key == NULL)
            key = key_beside(problem, its, target->field);
        by = key != NULL                                    ? key
             : is_of_other_train(problem, its, target)      ? "trains"
             : is_changed(problem, scenario, target->field) ? "changes"
                                                            : NULL;
        if (by == NULL) /* the path reaches this place */
            return NULL;
    }
    return by;
}
