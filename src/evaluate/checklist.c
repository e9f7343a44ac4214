/* Lists the checks of a problem: profile, the user's own limits, design rules, targets. */
#include "base/error.h"
#include "base/suggest.h"
#include "base/text.h"
#include "evaluate/checks.h"
#include "evaluate/devices.h"
#include "evaluate/not_applicable.h"
#include "evaluate/not_covered.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* Closing speeds of the service steps [m/s]. */
static const double buffing_speed = 8 / 3.6;
static const double service_speed = 15 / 3.6;

typedef struct Builder {
    const CzProblem *problem;
    int n_scene;
    const CzScene *scene;
    CzArena *arena;
    CzChecklist *list;
    CzError *error;
} Builder;

static CzStatus append(Builder *builder, const CzCheck *check) {
    CzChecklist *list = builder->list;
    CzCheck *checks = cz_arena_grow(builder->arena, list->check, list->n_check, sizeof *checks);
    if (checks == NULL)
        return cz_no_memory(builder->error, "the checks");
    list->check = checks;
    list->check[list->n_check++] = *check;
    return CZ_OK;
}

/* ---- limits of profile and user ------------------------------------------------------------ */

/* A limit without scenarios applies in all scenarios except overload cases, which are judged for
 * bottoming out only, and scenarios that list other checks in judged_by. */
static bool holds_in(const CzLimit *limit, const CzScene *scene) {
    bool is_named = false;
    for (int i = 0; i < limit->scenarios.n_text; i++)
        is_named |= cz_scene_is_like(scene, limit->scenarios.text[i]);
    return limit->scenarios.n_text > 0
               ? is_named
               : !scene->is_overload && cz_scene_is_judged_by(scene, limit->name);
}

/* Adds a check in each of its scenarios. */
static CzStatus append_in_scenarios(Builder *builder, CzCheck check, const CzLimit *limit) {
    if (cz_level_is_of_design(check.metric.kind->level)) {
        check.scenario = CZ_NO_SCENARIO;
        return append(builder, &check);
    }
    bool picks = false;
    int n_scene = 0;
    for (int s = 0; s < builder->n_scene; s++) {
        if (!holds_in(limit, &builder->scene[s]))
            continue;
        n_scene++;
        picks |= cz_metric_picks(&check.metric, &builder->scene[s]);
        check.scenario = s;
        check.is_bare = !builder->scene[s].has_reserves;
        CZ_TRY(append(builder, &check));
    }
    const bool from_profile = check.profile != NULL;
    if (n_scene == 0 && !from_profile)
        return cz_problem_fail(builder->problem, &limit->scenarios, builder->error,
                               "limit '%s' applies to no scenario of the problem", check.name);
    if (!picks && !from_profile)
        return cz_problem_fail(builder->problem, &limit->metric, builder->error,
                               "'%s' matches no place in any scenario", limit->metric);
    return CZ_OK;
}

/* Whether a limit is unconfirmed: limits read in the primary text, and those of the user, are
 * confirmed. */
static bool is_unconfirmed(const char *confidence) {
    return confidence == NULL || (strcmp(confidence, "S1") != 0 && strcmp(confidence, "user") != 0);
}

/* Adds a limit as one or two checks. `profile` is NULL for the user's own. */
static CzStatus append_limit(Builder *builder, const CzLimit *limit, const char *profile,
                             bool is_target) {
    CzCheck check = {.name = limit->name,
                     .profile = profile,
                     .clause = limit->clause,
                     .source = limit->source,
                     .confidence = limit->confidence,
                     .is_target = is_target};
    if (check.confidence == NULL && profile == NULL)
        check.confidence = "user";
    check.is_provisional = is_unconfirmed(check.confidence);
    CZ_TRY(cz_problem_place_failure(builder->problem, &limit->metric,
                                    cz_metric_parse(limit->metric, &check.metric, builder->error),
                                    builder->error));
    check.scale = isnan(limit->scale) || check.metric.kind->scale == CZ_FLAG_SCALE
                      ? check.metric.kind->scale
                      : limit->scale;
    for (int side = 0; side < 2; side++) {
        check.is_minimum = side == 1;
        check.limit = side == 1 ? limit->min : limit->max;
        if (!isnan(check.limit))
            CZ_TRY(append_in_scenarios(builder, check, limit));
    }
    return CZ_OK;
}

/* Whether the user has a limit of this name, which replaces that of the profile. */
static bool user_sets(const CzChecks *checks, const char *name) {
    for (int i = 0; i < checks->n_limits; i++)
        if (strcmp(checks->limits[i].name, name) == 0)
            return true;
    return false;
}

/* Each scenario that the profile asks for and that is not run is not checked. */
static CzStatus append_not_run(Builder *builder, const CzProfile *profile) {
    int n_asked;
    const CzAskedScenario *asked = cz_problem_profile_scenarios(builder->problem, &n_asked);
    for (int i = 0; i < n_asked; i++) {
        if (asked[i].standing != CZ_STANDING_NOT_SELECTED)
            continue;
        const CzCheck check = {.name = asked[i].scenario->name,
                               .scenario = CZ_NO_SCENARIO,
                               .limit = NAN,
                               .profile = profile->name,
                               .clause = asked[i].scenario->clause,
                               .source = asked[i].scenario->source,
                               .confidence = asked[i].scenario->confidence,
                               .missing = "scenario of the profile that checks: {scenarios: ...} "
                                          "does not select"};
        CZ_TRY(append(builder, &check));
    }
    return CZ_OK;
}

static CzStatus append_profile(Builder *builder) {
    const CzChecks *checks = &cz_problem_input(builder->problem)->checks;
    const CzProfile *profile = cz_problem_profile(builder->problem);
    if (profile == NULL)
        return CZ_OK;
    for (int i = 0; i < profile->n_limits; i++)
        if (!user_sets(checks, profile->limits[i].name))
            CZ_TRY(append_limit(builder, &profile->limits[i], profile->name, false));
    CZ_TRY(append_not_run(builder, profile));
    CZ_TRY(cz_not_applicable_list(builder->problem, builder->arena, builder->list, builder->error));
    builder->list->not_covered = cz_not_covered(builder->problem, &builder->list->n_not_covered);
    return CZ_OK;
}

/* ---- design rules --------------------------------------------------------------------------- */

typedef enum Speeds { DESIGN, EVERY, OVERLOAD, BUFFING, SERVICE, CRASH } Speeds;
typedef enum Needs { NOTHING, TUBE, SHEAR_OFF, FULL, FACE, INNER, N_NEEDS } Needs;

typedef struct Rule {
    const char *name, *metric;
    bool is_minimum;
    double limit;
    double bare; /* limit without a reserve; NaN: the rule then does not apply */
    Speeds speeds;
    Needs needs;
    const char *doc;
} Rule;

#define MAX false
#define MIN true
#define CZ_RULE(name, metric, bound, limit, bare, speeds, needs, doc)                              \
    {name, metric, bound, limit, bare, speeds, needs, doc},
static const Rule rules[] = {
#include "evaluate/design_rules.def"
};
#undef CZ_RULE
#undef MAX
#undef MIN

/* The speed by which a scene is of a class. A scene that is like another one at about its speed,
 * such as a sample, is judged by its rules: a tolerance of the speed does not make a service
 * collision a crash. The tenth is ours. */
static double class_speed(const CzScene *scene) {
    const CzScene *first = scene;
    while (first->like != NULL)
        first = first->like;
    const double change = fabs(scene->closing_speed - first->closing_speed);
    return change <= 0.1 * first->closing_speed ? first->closing_speed : scene->closing_speed;
}

static bool rule_holds_in(Speeds speeds, const CzScene *scene) {
    const double speed = class_speed(scene) * (1 - 1e-9);
    if (scene->is_overload || speeds == OVERLOAD)
        return scene->is_overload && speeds == OVERLOAD;
    switch (speeds) {
    case EVERY:
        return true;
    case BUFFING:
        return speed <= buffing_speed;
    case SERVICE:
        return speed <= service_speed;
    case CRASH:
        return speed > service_speed;
    case DESIGN:
    case OVERLOAD:
        break;
    }
    return false;
}

static void note_end(const CzVehicle *vehicle, const CzEnd *end, bool has[N_NEEDS]) {
    has[TUBE] |= end->coupler.tube.given;
    has[SHEAR_OFF] |= end->coupler.shear_off.given;
    has[FACE] |= end->anti_climber.given && vehicle->model == CZ_MODEL_FULL;
}

/* Finds the equipment of the vehicles of the problem. */
static void note_needs(const Builder *builder, bool has[N_NEEDS]) {
    has[NOTHING] = true;
    for (int s = 0; s < builder->n_scene; s++) {
        const CzScene *scene = &builder->scene[s];
        for (int i = 0; i < scene->n_vehicle; i++) {
            note_end(scene->vehicle[i], &scene->vehicle[i]->front, has);
            note_end(scene->vehicle[i], &scene->vehicle[i]->rear, has);
            has[FULL] |= scene->vehicle[i]->model == CZ_MODEL_FULL;
            has[INNER] |=
                i > 0 && i - 1 != scene->colliding && scene->vehicle[i]->model == CZ_MODEL_FULL;
        }
    }
}

static CzStatus append_missing(Builder *builder, const char *name, const char *missing) {
    const CzCheck check = {
        .name = name, .scenario = CZ_NO_SCENARIO, .limit = NAN, .missing = missing};
    return append(builder, &check);
}

/* Limit of a rule in a scene: its physical limit where no reserves are required, unless the rule is
 * among those that require theirs there, too. NaN where it does not apply. */
static double limit_in(const Builder *builder, const Rule *rule, const CzScene *scene) {
    const CzTexts *kept = &cz_problem_input(builder->problem)->uncertainty.reserves;
    return scene->has_reserves || cz_text_is_among(rule->name, kept->n_text, kept->text)
               ? rule->limit
               : rule->bare;
}

/* A rule of the design itself, also for the vehicles of each variation without reserves, whose
 * values a search does not see otherwise. */
static CzStatus append_design_rule(Builder *builder, const Rule *rule, CzCheck check) {
    check.scenario = CZ_NO_SCENARIO;
    CZ_TRY(append(builder, &check));
    int last = 0;
    for (int s = 0; s < builder->n_scene; s++) {
        const CzScene *scene = &builder->scene[s];
        check.limit = limit_in(builder, rule, scene);
        if (scene->variation <= last || scene->has_reserves || isnan(check.limit))
            continue;
        last = scene->variation;
        check.scene_of_vehicles = s;
        check.is_bare = true;
        CZ_TRY(append(builder, &check));
    }
    return CZ_OK;
}

static CzStatus append_rule(Builder *builder, const Rule *rule) {
    CzCheck check = {.name = rule->name,
                     .limit = rule->limit,
                     .is_minimum = rule->is_minimum,
                     .source = rule->doc};
    CZ_TRY(cz_metric_parse(rule->metric, &check.metric, builder->error));
    check.scale = check.metric.kind->scale;
    if (rule->speeds == DESIGN)
        return append_design_rule(builder, rule, check);
    bool is_judged = false, is_left_out = false;
    for (int s = 0; s < builder->n_scene; s++) {
        check.scenario = s;
        check.limit = limit_in(builder, rule, &builder->scene[s]);
        check.is_bare = !builder->scene[s].has_reserves;
        if (isnan(check.limit) || !rule_holds_in(rule->speeds, &builder->scene[s]))
            continue;
        const bool judges = cz_scene_is_judged_by(&builder->scene[s], rule->name);
        if (judges)
            CZ_TRY(append(builder, &check));
        is_judged |= judges;
        is_left_out |= !judges;
    }
    if (is_left_out && !is_judged)
        return append_missing(builder, rule->name, "no scenario lists it in judged_by");
    return CZ_OK;
}

static bool has_obstacle(const CzScene *scene) {
    return scene->is_obstacle[0] || scene->is_obstacle[1];
}

static bool has_obstacles_only(const Builder *builder) {
    for (int s = 0; s < builder->n_scene; s++)
        if (!has_obstacle(&builder->scene[s]))
            return false;
    return true;
}

/* Largest closing speed up to a bound among the scenarios to which all checks apply, 0 when there
 * is none [m/s]. Where the problem has two trains that collide, obstacles do not count: mass and
 * speed of a collision with one are given. */
static double fastest_up_to(const Builder *builder, double bound) {
    const bool any_partner = has_obstacles_only(builder);
    double fastest = 0;
    for (int s = 0; s < builder->n_scene; s++) {
        const CzScene *scene = &builder->scene[s];
        if (!scene->is_overload && scene->has_reserves && scene->judged_by == NULL &&
            (any_partner || !has_obstacle(scene)) && scene->closing_speed * (1 - 1e-9) <= bound)
            fastest = fmax(fastest, scene->closing_speed);
    }
    return fastest;
}

static bool covers_overload(const Builder *builder) {
    const bool any_partner = has_obstacles_only(builder);
    const double needed = CZ_OVERLOAD_FACTOR * fastest_up_to(builder, INFINITY) * (1 - 1e-9);
    for (int s = 0; s < builder->n_scene; s++)
        if (builder->scene[s].is_overload && builder->scene[s].judged_by == NULL &&
            (any_partner || !has_obstacle(&builder->scene[s])) &&
            builder->scene[s].closing_speed >= needed)
            return true;
    return false;
}

/* Whether the speed of a scenario is clearly between the service speed and the fastest. */
static bool covers_between(const Builder *builder) {
    const double fastest = fastest_up_to(builder, INFINITY);
    const double between = fastest_up_to(builder, 0.95 * fastest);
    return fastest <= 1.1 * service_speed || between > 1.05 * service_speed;
}

/* Lists rules without their required scenario as not checked. */
static CzStatus append_missing_scenarios(Builder *builder, const bool has[N_NEEDS]) {
    if (!covers_overload(builder))
        CZ_TRY(append_missing(builder, "bottoming out under overload",
                              "no scenario has mass_factor 1.1 and 1.1 times the largest speed"));
    if (has[TUBE] && fastest_up_to(builder, buffing_speed) < 0.95 * buffing_speed)
        CZ_TRY(append_missing(builder, "collapse tubes inactive at 8 km/h (buffing)",
                              "no scenario closes at 8 km/h"));
    if (!has[SHEAR_OFF])
        return CZ_OK;
    if (fastest_up_to(builder, service_speed) < 0.95 * service_speed)
        CZ_TRY(append_missing(builder, "no shear-off at 15 km/h (service)",
                              "no scenario closes at 15 km/h"));
    if (!covers_between(builder))
        CZ_TRY(append_missing(builder, "scenario between 15 km/h and the design speed",
                              "no scenario is between 15 km/h and the largest speed"));
    return CZ_OK;
}

static CzStatus append_design_rules(Builder *builder) {
    bool has[N_NEEDS] = {false};
    note_needs(builder, has);
    for (size_t i = 0; i < sizeof rules / sizeof rules[0]; i++)
        if (has[rules[i].needs])
            CZ_TRY(append_rule(builder, &rules[i]));
    return append_missing_scenarios(builder, has);
}

static CzStatus append_rule_of_files(Builder *builder, const char *name, const CzMetric *metric,
                                     double limit, const char *source) {
    const CzCheck check = {.name = name,
                           .scenario = CZ_NO_SCENARIO,
                           .metric = *metric,
                           .limit = limit,
                           .scale = metric->kind->scale,
                           .source = source,
                           .is_target = true,
                           .is_rule = true};
    return append(builder, &check);
}

/* Every design must be valid in a problem file. The file's own values are, so these checks are not
 * listed. Each rule that a variable can violate has a name; the last check is for all rules of the
 * reader. */
static CzStatus append_rules_of_files(Builder *builder) {
    CzMetric metric = {.selector = "*"};
    for (int rule = 0; rule < CZ_N_VALUE_RULE; rule++) {
        metric.kind = cz_metric_of_rule((CzValueRule)rule);
        CZ_TRY(append_rule_of_files(builder, metric.kind->name, &metric, 1, metric.kind->doc));
    }
    CZ_TRY(cz_metric_parse("design.rules_broken", &metric, builder->error));
    return append_rule_of_files(builder, "rules between values", &metric, 0,
                                "a design must be valid when it is read from a file");
}

/* ---- names ----------------------------------------------------------------------------------- */

static bool is_check(const CzChecklist *list, const char *name, CzSuggestion *nearest) {
    return CZ_FIND_NAMED(name, CzCheck, list->check, list->n_check, nearest) >= 0;
}

static CzStatus fail_name(const Builder *builder, const void *field, const char *name,
                          const char *key, const CzSuggestion *nearest) {
    cz_fail(builder->error, CZ_STATUS_INPUT, "%s: there is no check '%s'", key, name);
    cz_suggest_help(nearest, builder->error);
    return cz_problem_place_failure(builder->problem, field, CZ_STATUS_INPUT, builder->error);
}

/* Fails for a check in judged_by that does not exist. */
static CzStatus check_judges_exist(const Builder *builder) {
    for (int s = 0; s < builder->n_scene; s++) {
        const CzTexts *judges = builder->scene[s].judged_by;
        for (int i = 0; judges != NULL && i < judges->n_text; i++) {
            CzSuggestion nearest = {0};
            if (!is_check(builder->list, judges->text[i], &nearest))
                return fail_name(builder, judges, judges->text[i], "judged_by", &nearest);
        }
    }
    return CZ_OK;
}

/* ---- constraints ----------------------------------------------------------------------------- */

/* Marks the checks that are constraints of the optimiser. */
static CzStatus choose_constraints(Builder *builder) {
    const CzOptimise *optimise = &cz_problem_input(builder->problem)->optimise;
    const CzTexts *subject_to = &optimise->subject_to;
    const bool is_fit = optimise->given && optimise->n_match > 0;
    const bool all = (subject_to->n_text == 0 && !is_fit) ||
                     cz_text_is_among("checks", subject_to->n_text, subject_to->text);
    CzChecklist *list = builder->list;
    for (int i = 0; i < subject_to->n_text; i++) {
        CzSuggestion nearest = {0};
        if (strcmp(subject_to->text[i], "checks") != 0 &&
            !is_check(list, subject_to->text[i], &nearest))
            return fail_name(builder, subject_to, subject_to->text[i], "subject_to", &nearest);
    }
    for (int i = 0; i < list->n_check; i++) {
        CzCheck *check = &list->check[i];
        check->is_constraint =
            check->missing == NULL &&
            (check->is_target || all ||
             cz_text_is_among(check->name, subject_to->n_text, subject_to->text));
        list->n_constraint += check->is_constraint;
    }
    list->required_margin = optimise->given ? optimise->margin : 0;
    return CZ_OK;
}

CzStatus cz_checklist_build(const CzProblem *problem, int n_scene, const CzScene *scene,
                            CzArena *arena, CzChecklist *checklist, CzError *error) {
    *checklist = (CzChecklist){0};
    Builder builder = {.problem = problem,
                       .n_scene = n_scene,
                       .scene = scene,
                       .arena = arena,
                       .list = checklist,
                       .error = error};
    const CzInput *input = cz_problem_input(problem);
    CZ_TRY(append_profile(&builder));
    for (int i = 0; i < input->checks.n_limits; i++)
        CZ_TRY(append_limit(&builder, &input->checks.limits[i], NULL, false));
    if (!input->checks.given || input->checks.design_rules)
        CZ_TRY(append_design_rules(&builder));
    for (int i = 0; input->optimise.given && i < input->optimise.n_targets; i++)
        CZ_TRY(append_limit(&builder, &input->optimise.targets[i], NULL, true));
    if (input->optimise.given && input->optimise.n_variables > 0 && input->optimise.n_match == 0)
        CZ_TRY(append_rules_of_files(&builder));
    CZ_TRY(check_judges_exist(&builder));
    return choose_constraints(&builder);
}

CzStatus cz_checklist_aim(const CzProblem *problem, const CzAim *aim, int n_scene,
                          const CzScene *scene, CzArena *arena, CzChecklist *checklist,
                          CzError *error) {
    Builder builder = {.problem = problem,
                       .n_scene = n_scene,
                       .scene = scene,
                       .arena = arena,
                       .list = checklist,
                       .error = error};
    if (!isnan(aim->margin)) {
        checklist->aimed_margin = fmax(0, aim->margin);
        checklist->required_margin = fmax(checklist->required_margin, aim->margin);
    }
    if (aim->bounded == NULL)
        return CZ_OK;
    const int n_before = checklist->n_check;
    const char *name = cz_arena_copy_text(arena, aim->bounded, strlen(aim->bounded));
    if (name == NULL)
        return cz_no_memory(error, "the checks");
    const CzLimit limit = {
        .name = (char *)name, .metric = (char *)name, .max = aim->bound, .min = NAN, .scale = NAN};
    CZ_TRY(append_limit(&builder, &limit, NULL, true));
    for (int i = n_before; i < checklist->n_check; i++) { /* the limit itself, without a margin */
        checklist->check[i].is_constraint = checklist->check[i].is_bound = true;
        checklist->n_constraint++;
    }
    return CZ_OK;
}
