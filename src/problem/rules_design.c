/* Rules of limits and design variables. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/error.h"
#include "base/increment.h"
#include "base/number.h"
#include "problem/rules.h"
#include "problem/strokes.h"

/* ---- limits ---- */

void cz_rules_check_scenario_names(const CzRules *rules, const CzTexts *names) {
    for (int i = 0; i < names->n_text; i++) {
        CzSuggestion suggestion = {0};
        if (cz_input_find_scenario(rules->input, names->text[i], &suggestion) >= 0)
            continue;
        cz_rule_broken(rules, &names->text[i], "there is no scenario '%.48s'", names->text[i]);
        cz_mistake_suggest(rules->mistakes, &suggestion);
    }
}

static void check_limits(const CzRules *rules, const CzLimit *limits, int n_limit,
                         bool is_profile) {
    for (int i = 0; i < n_limit; i++) {
        const CzLimit *limit = &limits[i];
        const bool has_min = cz_rule_is_written(rules, &limit->min);
        const bool has_max = cz_rule_is_written(rules, &limit->max);
        if (limit->given && has_min == has_max)
            cz_rule_broken(rules, has_min ? (const void *)&limit->min : limit,
                           "a limit needs exactly one of 'max' and 'min'");
        cz_rules_check_confidence(rules, &limit->confidence);
        if (!is_profile)
            cz_rules_check_scenario_names(rules, &limit->scenarios);
    }
}

/* Scenarios that limits of the profile name are those of the profile, in any category, or of the
 * problem. */
static void check_profile_names(const CzRules *rules) {
    const CzProfile *whole = rules->problem->whole_profile;
    for (int i = 0; whole != NULL && i < whole->n_limits; i++)
        for (int k = 0; k < whole->limits[i].scenarios.n_text; k++) {
            const char *const *name = &whole->limits[i].scenarios.text[k];
            CzSuggestion nearest = {0};
            if (cz_profile_has_scenario(whole, *name, &nearest) ||
                cz_input_find_scenario(rules->input, *name, &nearest) >= 0)
                continue;
            cz_rule_broken(rules, name, "there is no scenario '%.48s'", *name);
            cz_mistake_suggest(rules->mistakes, &nearest);
        }
}

/* ---- variables ---- */

static bool is_fit(const CzRules *rules) {
    return rules->input->optimise.n_match > 0;
}

/* Bounds of a variable, of a list its first and its last size. */
static void find_bounds(const CzVariable *variable, double bounds[2]) {
    const CzTexts *values = &variable->values;
    bounds[0] = variable->min;
    bounds[1] = variable->max;
    for (int side = 0; side < 2 && values->n_text > 0; side++)
        if (cz_number_parse(values->text[side == 0 ? 0 : values->n_text - 1], &bounds[side]) !=
            NULL)
            bounds[side] = NAN; /* reported elsewhere */
}

/* Range of a variable against the range of the key that its path ends in. Bounds are in the unit of
 * the variable's first path, `first`. */
static void check_target(const CzRules *rules, const CzVariable *variable, const char *const *path,
                         const CzTarget *target, const CzTarget *first) {
    if (!target->may_vary && !(target->may_fit && is_fit(rules))) {
        cz_rule_broken(
            rules, path, "'%.120s' is fixed data and cannot be a %s" CZ_HELP "%s%s", *path,
            is_fit(rules) ? "parameter of a fit" : "design variable",
            is_fit(rules)
                ? "`crushzone help keys` lists what may be fitted"
                : "stage forces and strokes, trigger and shear-off forces, and gaps may vary",
            !is_fit(rules) && target->may_fit ? "; in a fit with `match` this value may vary, too"
                                              : "");
        return;
    }
    if (cz_strokes_depend_on(rules->input, target->field))
        cz_rule_broken(rules, path,
                       "'%.120s' cannot vary: the strokes of the curve depend on it; give the "
                       "curve over plastic strokes for a device, over total strokes for an end",
                       *path);
    const CzPlace *place = cz_places_find(&rules->problem->places, target->field);
    if (place == NULL || place->address != target->field || place->key == NULL)
        return;
    const double lo = place->key->lo / first->unit, hi = place->key->hi / first->unit;
    const bool is_list = variable->values.n_text > 0;
    double bounds[2];
    find_bounds(variable, bounds);
    if (bounds[0] < lo)
        cz_rule_broken(rules, is_list ? (const void *)&variable->values : &variable->min,
                       "%s must not be smaller than %s %s", place->key->stem, CZ_SHORT(lo),
                       first->suffix);
    if (bounds[1] > hi)
        cz_rule_broken(rules, is_list ? (const void *)&variable->values : &variable->max,
                       "%s must not be larger than %s %s", place->key->stem, CZ_SHORT(hi),
                       first->suffix);
}

/* Adds the targets of a path to those of its variable; returns their number, 0 with the reason in
 * `error`. */
static int find(const CzRules *rules, const char *path, CzTargets *targets, CzError *error) {
    const int n_before = targets->n;
    if (cz_problem_find(rules->problem, path, targets, error) == CZ_STATUS_NO_MEMORY)
        rules->mistakes->arena->out_of_memory = true;
    return targets->n - n_before;
}

/* Reports why a path names nothing, or a choice cannot be made. */
static void list_error(const CzRules *rules, const void *field, const char *before,
                       const CzError *error) {
    cz_rule_broken(rules, field, "%s%s" CZ_HELP "%s", before, error->message, error->help);
}

static void check_path(const CzRules *rules, const CzVariable *variable, const char *const *path,
                       CzTargets *targets) {
    CzError error = {0};
    const int n_found = find(rules, *path, targets, &error);
    if (error.status == CZ_STATUS_INPUT)
        list_error(rules, path, "", &error);
    for (int i = targets->n - n_found; i < targets->n; i++)
        if (i == targets->n - n_found || targets->target[i].match != targets->target[i - 1].match)
            check_target(rules, variable, path, &targets->target[i], targets->target);
}

/* The number of one size of a list, NaN with its reason where it is none or does not follow the one
 * before. */
static double check_value(const CzRules *rules, const CzVariable *variable, int i, double before) {
    const char *text = variable->values.text[i];
    char number[CZ_NUMBER_TEXT];
    double value;
    const char *wrong = cz_number_parse(text, &value);
    if (wrong != NULL)
        cz_rule_broken(rules, &variable->values.text[i], "values: '%.60s' %s", text, wrong);
    else if (value <= before)
        cz_rule_broken(rules, &variable->values.text[i],
                       "values: %.60s does not follow %s: sizes are listed once, the smallest "
                       "first",
                       text, cz_number_print(number, before));
    return wrong != NULL || value <= before ? NAN : value;
}

static void check_values(const CzRules *rules, const CzVariable *variable) {
    const CzTexts *values = &variable->values;
    const struct {
        const double *field;
        const char *name;
    } others[] = {
        {&variable->min, "min"}, {&variable->max, "max"}, {&variable->increment, "increment"}};
    char start[CZ_NUMBER_TEXT];
    double before = -INFINITY, bounds[2];
    for (int i = 0; i < 3; i++)
        if (cz_rule_is_written(rules, others[i].field))
            cz_rule_broken(rules, others[i].field, "a variable with values has no '%s'",
                           others[i].name);
    if (values->n_text == 0)
        cz_rule_broken(rules, values, "a variable needs one value or more");
    if (is_fit(rules))
        cz_rule_broken(rules, values, "a parameter of a fit has no values, but bounds");
    for (int i = 0; i < values->n_text && !isnan(before); i++)
        before = check_value(rules, variable, i, before);
    find_bounds(variable, bounds);
    if (variable->start < bounds[0] || variable->start > bounds[1])
        cz_rule_broken(rules, &variable->start,
                       "start %s must be within the values, %.60s to %.60s",
                       cz_number_print(start, variable->start), values->text[0],
                       values->text[values->n_text - 1]);
}

static void check_bounds(const CzRules *rules, const CzVariable *variable) {
    char first[CZ_NUMBER_TEXT], min[CZ_NUMBER_TEXT], max[CZ_NUMBER_TEXT];
    if (!cz_rule_is_written(rules, &variable->min) || !cz_rule_is_written(rules, &variable->max)) {
        cz_rule_broken(rules, variable, "a variable needs 'min' and 'max', 'values', or 'choices'");
        return;
    }
    cz_number_print(min, variable->min);
    cz_number_print(max, variable->max);
    if (variable->min > variable->max)
        cz_rule_broken(rules, &variable->min, "min %s is above max %s", min, max);
    else if (variable->start < variable->min || variable->start > variable->max)
        cz_rule_broken(rules, &variable->start, "start %s must be within %s to %s",
                       cz_number_print(first, variable->start), min, max);
    else if (variable->min < variable->max && variable->increment > 0 &&
             cz_increment_count(variable->increment, variable->min, variable->max) == 0)
        cz_rule_broken(rules, &variable->increment,
                       "no multiple of the increment %s is within %s to %s",
                       cz_number_print(first, variable->increment), min, max);
}

/* ---- choices ---- */

/* Finds the buffers that a path of a variable with choices names, by a key that only buffers
 * have. */
static bool find_buffers(const CzRules *rules, const char *const *path, CzTargets *targets) {
    static const char inside[] = ".preload_N";
    char text[CZ_PATH_SIZE + sizeof inside];
    CzError error = {0};
    snprintf(text, sizeof text, "%.*s%s", (int)CZ_PATH_SIZE, *path, inside);
    const int n_found = find(rules, text, targets, &error);
    for (int i = targets->n - n_found; i < targets->n; i++) {
        CzTarget *found = &targets->target[i];
        char *end = found->place + strlen(found->place) - (sizeof inside - 1);
        snprintf(end, sizeof found->place - (size_t)(end - found->place), ".use");
        found->offset -= offsetof(CzBuffer, preload);
        found->suffix = "";
        found->unit = found->value = 1;
        found->may_vary = true;
    }
    if (error.status == CZ_STATUS_INPUT)
        cz_rule_broken(rules, path, "'%.120s' is not a buffer: only buffers may be chosen", *path);
    return n_found > 0;
}

/* Reads the problem with every choice in turn. */
static void check_each_choice(const CzRules *rules, const CzVariable *variable,
                              const char *const *path) {
    char use[CZ_PATH_SIZE + 16];
    snprintf(use, sizeof use, "%.*s.use", (int)CZ_PATH_SIZE, *path);
    const char *const uses[] = {use};
    for (int i = 0; i < variable->choices.n_text; i++) {
        CzProblem *chosen = NULL;
        CzError error = {0};
        const CzStatus status = cz_problem_read_again(rules->problem, 1, uses,
                                                      &variable->choices.text[i], &chosen, &error);
        cz_problem_free(chosen);
        if (status == CZ_STATUS_NO_MEMORY)
            rules->mistakes->arena->out_of_memory = true;
        char choice[80];
        snprintf(choice, sizeof choice, "choice '%.60s': ", variable->choices.text[i]);
        if (status == CZ_STATUS_INPUT)
            list_error(rules, &variable->choices.text[i], choice, &error);
    }
}

static void check_choices(const CzRules *rules, const CzVariable *variable, CzTargets *targets) {
    const struct {
        const double *field;
        const char *name;
    } bounds[] = {{&variable->min, "min"},
                  {&variable->max, "max"},
                  {&variable->start, "start"},
                  {&variable->increment, "increment"}};
    if (cz_rule_is_written(rules, &variable->values))
        cz_rule_broken(rules, &variable->values, "a variable with choices has no 'values'");
    for (int i = 0; i < 4; i++)
        if (cz_rule_is_written(rules, bounds[i].field))
            cz_rule_broken(rules, bounds[i].field, "a variable with choices has no '%s'",
                           bounds[i].name);
    if (variable->choices.n_text < 2)
        cz_rule_broken(rules, &variable->choices, "a choice needs two parts or more");
    if (is_fit(rules))
        cz_rule_broken(rules, &variable->choices, "a fit has no choices");
    if (rules->reader->has_holes || rules->mistakes->n_mistake > 0)
        return; /* rereading would report other mistakes again */
    if (variable->path != NULL && find_buffers(rules, &variable->path, targets))
        check_each_choice(rules, variable, &variable->path);
    for (int i = 0; i < variable->paths.n_text; i++)
        if (find_buffers(rules, &variable->paths.text[i], targets))
            check_each_choice(rules, variable, &variable->paths.text[i]);
}

static void check_variable(const CzRules *rules, const CzVariable *variable, CzTargets *targets) {
    const bool has_path = cz_rule_is_written(rules, &variable->path);
    const bool has_paths = cz_rule_is_written(rules, &variable->paths);
    if (has_path == has_paths)
        cz_rule_broken(rules, has_path ? (const void *)&variable->paths : variable,
                       "a variable needs exactly one of 'path' and 'paths'");
    if (cz_rule_is_written(rules, &variable->choices)) {
        check_choices(rules, variable, targets);
        return;
    }
    if (cz_rule_is_written(rules, &variable->values))
        check_values(rules, variable);
    else
        check_bounds(rules, variable);
    if (rules->reader->has_holes)
        return; /* a path may lead into a record that could not be read */
    if (variable->path != NULL)
        check_path(rules, variable, &variable->path, targets);
    for (int i = 0; i < variable->paths.n_text; i++)
        check_path(rules, variable, &variable->paths.text[i], targets);
}

void cz_rules_check_design(const CzRules *rules, CzTargets *targets) {
    const CzInput *input = rules->input;
    check_limits(rules, input->checks.limits, input->checks.n_limits, false);
    check_limits(rules, rules->problem->profile.limits, rules->problem->profile.n_limits, true);
    check_limits(rules, input->optimise.targets, input->optimise.n_targets, false);
    check_profile_names(rules);
    for (int i = 0; i < input->checks.n_limits; i++)
        if (input->checks.limits[i].categories.n_text > 0)
            cz_rule_broken(rules, &input->checks.limits[i].categories,
                           "categories belong to the limits of a profile");
    for (int i = 0; i < input->optimise.n_variables; i++)
        if (input->optimise.variables[i].given)
            check_variable(rules, &input->optimise.variables[i], &targets[i]);
}
