/* Rules of limits and design variables. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/error.h"
#include "base/increment.h"
#include "base/number.h"
#include "problem/rules.h"
#include "problem/strokes.h"

/* ---- limits ---- */

static void check_scenario_named(const CzRules *rules, const char *const *name) {
    CzSuggestion suggestion = {0};
    if (cz_input_find_scenario(rules->input, *name, &suggestion) >= 0)
        return;
    cz_rule_broken(rules, name, "there is no scenario '%.48s'", *name);
    cz_mistake_suggest(rules->mistakes, suggestion.best);
}

static void check_limits(const CzRules *rules, const CzLimit *limits, int n_limit) {
    for (int i = 0; i < n_limit; i++) {
        const CzLimit *limit = &limits[i];
        const bool has_min = cz_rule_is_written(rules, &limit->min);
        const bool has_max = cz_rule_is_written(rules, &limit->max);
        if (limit->given && has_min == has_max)
            cz_rule_broken(rules, has_min ? (const void *)&limit->min : limit,
                           "a limit has 'max' or 'min', and only one of them");
        for (int k = 0; k < limit->scenarios.n_text; k++)
            check_scenario_named(rules, &limit->scenarios.text[k]);
    }
}

/* ---- variables ---- */

static bool is_fit(const CzRules *rules) {
    return rules->input->optimise.n_match > 0;
}

/* Range of a variable against the range of the key that its path ends in. Bounds are in the unit of
 * the variable's first path, `first`. */
static void check_target(const CzRules *rules, const CzVariable *variable, const char *const *path,
                         const CzTarget *target, const CzTarget *first) {
    if (!target->may_vary && !(target->may_fit && is_fit(rules))) {
        cz_rule_broken(rules, path, "'%.120s' is data, not a %s", *path,
                       is_fit(rules) ? "parameter of a fit" : "design variable");
        if (is_fit(rules))
            cz_mistake_help(rules->mistakes, "`crushzone help keys` tells what may be fitted");
        else
            cz_mistake_help(rules->mistakes,
                            target->may_fit
                                ? "stage forces and strokes, trigger and shear-off forces and "
                                  "gaps may vary; this may, too, in a fit to `match`"
                                : "stage forces and strokes, trigger and shear-off forces and "
                                  "gaps may vary");
        return;
    }
    if (cz_strokes_depend_on(rules->input, target->field))
        cz_rule_broken(
            rules, path,
            "'%.120s' cannot vary: the strokes of the curve beside it were made with it; "
            "give the curve in the strokes that its law is over",
            *path);
    const CzPlace *place = cz_places_find(&rules->problem->places, target->field);
    if (place == NULL || place->address != target->field || place->key == NULL)
        return;
    char limit[CZ_NUMBER_TEXT];
    const double lo = place->key->lo / first->unit, hi = place->key->hi / first->unit;
    if (variable->min < lo)
        cz_rule_broken(rules, &variable->min, "%s can be no smaller than %s %s", place->key->stem,
                       cz_number_print_short(limit, lo), first->suffix);
    if (variable->max > hi)
        cz_rule_broken(rules, &variable->max, "%s can be no larger than %s %s", place->key->stem,
                       cz_number_print_short(limit, hi), first->suffix);
}

/* `first` is the first target of the variable once one was found (its unit above 0). */
static void check_path(const CzRules *rules, const CzVariable *variable, const char *const *path,
                       CzTarget *first) {
    CzTarget *target = NULL;
    CzError error = {0};
    int n_target = 0;
    const CzStatus status = cz_problem_find(rules->problem, *path, &target, &n_target, &error);
    if (status == CZ_STATUS_NO_MEMORY)
        rules->mistakes->arena->out_of_memory = true;
    if (status == CZ_STATUS_INPUT) {
        cz_rule_broken(rules, path, "%s", error.message);
        if (error.help[0] != '\0')
            cz_mistake_help(rules->mistakes, "%s", error.help);
    }
    if (n_target > 0 && !(first->unit > 0))
        *first = target[0];
    for (int i = 0; i < n_target; i++)
        if (i == 0 || target[i].match != target[i - 1].match)
            check_target(rules, variable, path, &target[i], first);
    free(target);
}

static void check_bounds(const CzRules *rules, const CzVariable *variable) {
    char first[CZ_NUMBER_TEXT], min[CZ_NUMBER_TEXT], max[CZ_NUMBER_TEXT];
    if (!cz_rule_is_written(rules, &variable->min) || !cz_rule_is_written(rules, &variable->max)) {
        cz_rule_broken(rules, variable, "a variable needs 'min' and 'max', or 'choices'");
        return;
    }
    cz_number_print(min, variable->min);
    cz_number_print(max, variable->max);
    if (variable->min > variable->max)
        cz_rule_broken(rules, &variable->min, "min %s is above max %s", min, max);
    else if (variable->start < variable->min || variable->start > variable->max)
        cz_rule_broken(rules, &variable->start, "start %s must lie within %s to %s",
                       cz_number_print(first, variable->start), min, max);
    else if (variable->min < variable->max && variable->increment > 0 &&
             cz_increment_count(variable->increment, variable->min, variable->max) == 0)
        cz_rule_broken(rules, &variable->increment,
                       "no multiple of the increment %s lies within %s to %s",
                       cz_number_print(first, variable->increment), min, max);
}

/* ---- choices ---- */

/* The buffer that a path of a variable with choices names, by a number that only buffers have. */
static bool is_buffer(const CzRules *rules, const char *const *path) {
    char inside[CZ_PATH_ROOM + 16];
    CzTarget *target = NULL;
    CzError error = {0};
    int n_target = 0;
    snprintf(inside, sizeof inside, "%.*s.preload_N", (int)CZ_PATH_ROOM, *path);
    const CzStatus status = cz_problem_find(rules->problem, inside, &target, &n_target, &error);
    free(target);
    if (status == CZ_STATUS_NO_MEMORY)
        rules->mistakes->arena->out_of_memory = true;
    if (status == CZ_OK)
        return true;
    cz_rule_broken(rules, path, "'%.120s' names no buffer: only buffers may be chosen", *path);
    return false;
}

/* Reads the problem with every choice in turn. */
static void check_each_choice(const CzRules *rules, const CzVariable *variable,
                              const char *const *path) {
    char use[CZ_PATH_ROOM + 16];
    snprintf(use, sizeof use, "%.*s.use", (int)CZ_PATH_ROOM, *path);
    const char *const uses[] = {use};
    for (int i = 0; i < variable->choices.n_text; i++) {
        CzProblem *chosen = NULL;
        CzError error = {0};
        const CzStatus status = cz_problem_read_again(rules->problem, 1, uses,
                                                      &variable->choices.text[i], &chosen, &error);
        cz_problem_free(chosen);
        if (status == CZ_STATUS_NO_MEMORY)
            rules->mistakes->arena->out_of_memory = true;
        if (status != CZ_STATUS_INPUT)
            continue;
        cz_rule_broken(rules, &variable->choices.text[i], "choice '%.60s': %s",
                       variable->choices.text[i], error.message);
        if (error.help[0] != '\0')
            cz_mistake_help(rules->mistakes, "%s", error.help);
    }
}

static void check_choices(const CzRules *rules, const CzVariable *variable) {
    const struct {
        const double *field;
        const char *name;
    } bounds[] = {{&variable->min, "min"},
                  {&variable->max, "max"},
                  {&variable->start, "start"},
                  {&variable->increment, "increment"}};
    for (int i = 0; i < 4; i++)
        if (cz_rule_is_written(rules, bounds[i].field))
            cz_rule_broken(rules, bounds[i].field, "a variable with choices has no '%s'",
                           bounds[i].name);
    if (variable->choices.n_text < 2)
        cz_rule_broken(rules, &variable->choices, "a choice needs two parts or more");
    if (is_fit(rules))
        cz_rule_broken(rules, &variable->choices, "a fit has no choices");
    if (rules->reader->has_holes || rules->mistakes->n_mistake > 0)
        return; /* reading again would tell other mistakes once more */
    if (variable->path != NULL && is_buffer(rules, &variable->path))
        check_each_choice(rules, variable, &variable->path);
    for (int i = 0; i < variable->paths.n_text; i++)
        if (is_buffer(rules, &variable->paths.text[i]))
            check_each_choice(rules, variable, &variable->paths.text[i]);
}

static void check_variable(const CzRules *rules, const CzVariable *variable) {
    const bool has_path = cz_rule_is_written(rules, &variable->path);
    const bool has_paths = cz_rule_is_written(rules, &variable->paths);
    if (has_path == has_paths)
        cz_rule_broken(rules, has_path ? (const void *)&variable->paths : variable,
                       "a variable has 'path' or 'paths', and only one of them");
    if (cz_rule_is_written(rules, &variable->choices)) {
        check_choices(rules, variable);
        return;
    }
    check_bounds(rules, variable);
    if (rules->reader->has_holes)
        return; /* a path may lead into what could not be read */
    CzTarget first = {0};
    if (variable->path != NULL)
        check_path(rules, variable, &variable->path, &first);
    for (int i = 0; i < variable->paths.n_text; i++)
        check_path(rules, variable, &variable->paths.text[i], &first);
}

void cz_rules_check_design(const CzRules *rules) {
    const CzInput *input = rules->input;
    check_limits(rules, input->checks.limits, input->checks.n_limits);
    check_limits(rules, rules->problem->profile.limits, rules->problem->profile.n_limits);
    check_limits(rules, input->optimise.targets, input->optimise.n_targets);
    for (int i = 0; i < input->checks.n_limits; i++)
        if (input->checks.limits[i].categories.n_text > 0)
            cz_rule_broken(rules, &input->checks.limits[i].categories,
                           "categories belong to the limits of a profile");
    for (int i = 0; i < input->optimise.n_variables; i++)
        if (input->optimise.variables[i].given)
            check_variable(rules, &input->optimise.variables[i]);
}
