/* Lists scenarios of the profile that do not apply to a problem, and those that it changes. */
#include "evaluate/not_applicable.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/error.h"
#include "evaluate/checklist_parts.h"

#define ROUNDING 1e-9 /* of a value that was written and read again */

/* Whether a value is that of the profile, where both are given; `usual` stands for an absent one.
 */
static bool is_same(double own, double asked, double usual) {
    const double a = isnan(own) ? usual : own, b = isnan(asked) ? usual : asked;
    return isnan(a) || isnan(b) || fabs(a - b) <= ROUNDING * fmax(1.0, fabs(b));
}

/* Whether the problem has a scenario of the profile with the profile's values: by expansion, or
 * written in the file, as in resolved.yaml. */
static bool has_it(const CzInput *input, const CzProfileScenario *asked, double speed) {
    for (int i = 0; i < input->n_scenarios; i++) {
        const CzScenario *own = &input->scenarios[i];
        if (own->name == NULL || strcmp(own->name, asked->name) != 0)
            continue;
        const bool is_onto_it = strcmp(asked->partner, "identical") == 0 ||
                                own->trains.n_text < 2 ||
                                strcmp(own->trains.text[1], asked->partner) == 0;
        return is_onto_it && !isnan(own->speed) && is_same(own->speed, speed, NAN) &&
               is_same(own->height_offset, asked->height_offset, 0) &&
               is_same(own->perturbation, asked->perturbation, 0) &&
               is_same(own->partner_brake_ratio, asked->partner_brake_ratio, NAN) &&
               is_same(own->mass_factor, asked->mass_factor, 1) &&
               is_same(own->payload_share, asked->payload_share, 0);
    }
    return false;
}

CzStatus cz_not_applicable_list(const CzProblem *problem, CzArena *arena, CzChecklist *list,
                                CzError *error) {
    int n_asked;
    const CzAskedScenario *asked = cz_problem_profile_scenarios(problem, &n_asked);
    const char **text = cz_arena_allocate(arena, (size_t)n_asked + 1, sizeof *text);
    const char **changed = cz_arena_allocate(arena, (size_t)n_asked + 1, sizeof *changed);
    list->not_applicable = text;
    list->changed_scenario = changed;
    for (int i = 0; !arena->out_of_memory && i < n_asked; i++) {
        const CzProfileScenario *scenario = asked[i].scenario;
        char line[400];
        if (asked[i].standing == CZ_STANDING_NOT_APPLICABLE) {
            const int n =
                snprintf(line, sizeof line, "%.60s: %.300s", scenario->name, asked[i].why);
            text[list->n_not_applicable++] = cz_arena_copy_text(arena, line, (size_t)n);
        } else if (asked[i].standing != CZ_STANDING_NOT_SELECTED &&
                   !has_it(cz_problem_input(problem), scenario, asked[i].speed)) {
            changed[list->n_changed_scenario++] =
                cz_arena_copy_text(arena, scenario->name, strlen(scenario->name));
        }
    }
    return arena->out_of_memory ? cz_no_memory(error, "the checks") : CZ_OK;
}

bool cz_asked_is_unconfirmed(const CzProblem *problem, const CzScene *scene) {
    int n_asked;
    const CzAskedScenario *asked = cz_problem_profile_scenarios(problem, &n_asked);
    while (scene->like != NULL)
        scene = scene->like;
    for (int i = 0; i < n_asked; i++)
        if (strcmp(asked[i].scenario->name, scene->name) == 0 &&
            cz_is_unconfirmed(asked[i].scenario->confidence))
            return has_it(cz_problem_input(problem), asked[i].scenario, asked[i].speed);
    return false;
}
