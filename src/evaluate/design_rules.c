/* Lists the design rules as checks of a problem's scenarios. */
#include "evaluate/design_rules.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/error.h"
#include "base/text.h"
#include "evaluate/devices.h"

/* Closing speeds of the service steps [m/s]. */
static const double buffing_speed = 8 / 3.6;
static const double service_speed = 15 / 3.6;

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
enum { N_RULE = sizeof rules / sizeof rules[0] };

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

bool cz_design_rule_is(const char *name, CzSuggestion *nearest) {
    return CZ_FIND_NAMED(name, Rule, rules, N_RULE, nearest) >= 0;
}

/* The number of the problem's override in place of the rule's. The physical limit stays, unless it
 * is the same number or would be the stricter one. */
static CzStatus override_rule(const CzChecklistBuilder *builder, Rule *rule, CzCheck *check) {
    const CzChecks *checks = &cz_problem_input(builder->problem)->checks;
    const int i = CZ_FIND_NAMED(rule->name, CzOverride, checks->override, checks->n_override,
                                &(CzSuggestion){0});
    if (i < 0)
        return CZ_OK;
    const CzOverride *over = &checks->override[i];
    const double *wrong = rule->is_minimum ? &over->max : &over->min;
    const double own = rule->is_minimum ? over->min : over->max;
    if (!isnan(*wrong))
        return cz_problem_fail(builder->problem, wrong, builder->error,
                               "design rule '%s' is %s limit: write '%s'", rule->name,
                               rule->is_minimum ? "a lower" : "an upper",
                               rule->is_minimum ? "min" : "max");
    if (!isnan(own)) {
        const double looser = rule->is_minimum ? fmin(own, rule->bare) : fmax(own, rule->bare);
        rule->bare = rule->bare == rule->limit ? own : isnan(rule->bare) ? NAN : looser;
        rule->limit = check->limit = own;
    }
    if (!isnan(over->scale) && check->scale != CZ_FLAG_SCALE)
        check->scale = over->scale;
    if (over->source != NULL)
        check->source = over->source;
    check->confidence = over->confidence != NULL ? over->confidence : "user";
    check->is_provisional = cz_is_unconfirmed(check->confidence);
    return CZ_OK;
}

static void note_end(const CzVehicle *vehicle, const CzEnd *end, bool has[N_NEEDS]) {
    has[TUBE] |= end->coupler.tube.given;
    has[SHEAR_OFF] |= end->coupler.shear_off.given;
    has[FACE] |= end->anti_climber.given && vehicle->model == CZ_MODEL_FULL;
}

/* Finds the equipment of the vehicles of the problem. */
static void note_needs(const CzChecklistBuilder *builder, bool has[N_NEEDS]) {
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

static CzStatus append_missing(CzChecklistBuilder *builder, const char *name, const char *missing) {
    const CzCheck check = {
        .name = name, .scenario = CZ_NO_SCENARIO, .limit = NAN, .missing = missing};
    return cz_checklist_append(builder, &check);
}

/* Limit of a rule in a scene: its physical limit where no reserves are required, unless the rule is
 * among those that require theirs there, too. NaN where it does not apply. */
static double limit_in(const CzChecklistBuilder *builder, const Rule *rule, const CzScene *scene) {
    const CzTexts *kept = &cz_problem_input(builder->problem)->uncertainty.reserves;
    return scene->has_reserves || cz_text_is_among(rule->name, kept->n_text, kept->text)
               ? rule->limit
               : rule->bare;
}

/* A rule of the design itself, also for the vehicles of each variation without reserves, whose
 * values a search does not see otherwise. */
static CzStatus append_design_rule(CzChecklistBuilder *builder, const Rule *rule, CzCheck check) {
    check.scenario = CZ_NO_SCENARIO;
    CZ_TRY(cz_checklist_append(builder, &check));
    int last = 0;
    for (int s = 0; s < builder->n_scene; s++) {
        const CzScene *scene = &builder->scene[s];
        check.limit = limit_in(builder, rule, scene);
        if (scene->variation <= last || scene->has_reserves || isnan(check.limit))
            continue;
        last = scene->variation;
        check.scene_of_vehicles = s;
        check.is_bare = true;
        CZ_TRY(cz_checklist_append(builder, &check));
    }
    return CZ_OK;
}

static CzStatus append_rule(CzChecklistBuilder *builder, const Rule *listed) {
    Rule own = *listed;
    const Rule *const rule = &own;
    CzCheck check = {.name = rule->name,
                     .limit = rule->limit,
                     .is_minimum = rule->is_minimum,
                     .source = rule->doc};
    CZ_TRY(cz_metric_parse(rule->metric, &check.metric, builder->error));
    check.scale = check.metric.kind->scale;
    CZ_TRY(override_rule(builder, &own, &check));
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
            CZ_TRY(cz_checklist_append(builder, &check));
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

static bool has_obstacles_only(const CzChecklistBuilder *builder) {
    for (int s = 0; s < builder->n_scene; s++)
        if (!has_obstacle(&builder->scene[s]))
            return false;
    return true;
}

/* Largest closing speed up to a bound among the scenarios to which all checks apply, 0 when there
 * is none [m/s]. Where the problem has two trains that collide, obstacles do not count: mass and
 * speed of a collision with one are given. */
static double fastest_up_to(const CzChecklistBuilder *builder, double bound) {
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

static bool covers_overload(const CzChecklistBuilder *builder) {
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
static bool covers_between(const CzChecklistBuilder *builder) {
    const double fastest = fastest_up_to(builder, INFINITY);
    const double between = fastest_up_to(builder, 0.95 * fastest);
    return fastest <= 1.1 * service_speed || between > 1.05 * service_speed;
}

/* Closing speeds of the scenarios that a rule without a scenario needs [m/s]; all overload cases
 * where `from` is NaN. */
typedef struct Needed {
    const char *rule, *missing;
    double from, to;
} Needed;

/* The check that reports a scenario of the profile as not selected, for one that would have judged
 * the rule; NULL for none. */
static CzCheck *find_left_out(const CzChecklistBuilder *builder, const Needed *needed) {
    int n_asked;
    const CzAskedScenario *asked = cz_problem_profile_scenarios(builder->problem, &n_asked);
    for (int i = 0; i < n_asked; i++) {
        const double speed = asked[i].speed * (1 - 1e-9);
        const bool is_overload = asked[i].scenario->mass_factor >= CZ_OVERLOAD_FACTOR * (1 - 1e-9);
        const bool fits = isnan(needed->from)
                              ? is_overload
                              : !is_overload && speed >= needed->from && speed <= needed->to;
        if (asked[i].standing != CZ_STANDING_NOT_SELECTED || !fits)
            continue;
        const int k = CZ_FIND_NAMED(asked[i].scenario->name, CzCheck, builder->list->check,
                                    builder->list->n_check, &(CzSuggestion){0});
        if (k >= 0 && builder->list->check[k].missing != NULL)
            return &builder->list->check[k];
    }
    return NULL;
}

/* Lists a rule without its required scenario as not checked: in a line of its own, or in that of
 * the scenario which the problem does not select. */
static CzStatus append_needed(CzChecklistBuilder *builder, const Needed *needed) {
    CzCheck *left_out = find_left_out(builder, needed);
    if (left_out == NULL)
        return append_missing(builder, needed->rule, needed->missing);
    char text[400];
    const int n = snprintf(text, sizeof text, "%.250s; without it, '%.100s' is not judged",
                           left_out->missing, needed->rule);
    left_out->missing = cz_arena_copy_text(builder->arena, text, (size_t)n);
    return left_out->missing != NULL ? CZ_OK : cz_no_memory(builder->error, "the checks");
}

static CzStatus append_missing_scenarios(CzChecklistBuilder *builder, const bool has[N_NEEDS]) {
    if (!covers_overload(builder))
        CZ_TRY(append_needed(builder, &(Needed){"bottoming out under overload",
                                                "no scenario has mass_factor 1.1 and 1.1 times "
                                                "the largest speed",
                                                NAN, NAN}));
    if (has[TUBE] && fastest_up_to(builder, buffing_speed) < 0.95 * buffing_speed)
        CZ_TRY(append_needed(builder, &(Needed){"collapse tubes inactive at 8 km/h (buffing)",
                                                "no scenario closes at 8 km/h",
                                                0.95 * buffing_speed, buffing_speed}));
    if (!has[SHEAR_OFF])
        return CZ_OK;
    if (fastest_up_to(builder, service_speed) < 0.95 * service_speed)
        CZ_TRY(append_needed(builder, &(Needed){"no shear-off at 15 km/h (service)",
                                                "no scenario closes at 15 km/h",
                                                0.95 * service_speed, service_speed}));
    if (!covers_between(builder))
        CZ_TRY(append_needed(
            builder, &(Needed){"scenario between 15 km/h and the design speed",
                               "no scenario is between 15 km/h and the largest speed",
                               1.05 * service_speed, 0.95 * fastest_up_to(builder, INFINITY)}));
    return CZ_OK;
}

CzStatus cz_design_rules_append(CzChecklistBuilder *builder) {
    bool has[N_NEEDS] = {false};
    note_needs(builder, has);
    for (int i = 0; i < N_RULE; i++)
        if (has[rules[i].needs])
            CZ_TRY(append_rule(builder, &rules[i]));
    return append_missing_scenarios(builder, has);
}
