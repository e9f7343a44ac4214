/* Lists the checks of a problem: profile, the user's own limits, design rules, targets. */
#include "base/error.h"
#include "base/suggest.h"
#include "base/text.h"
#include "evaluate/checklist_parts.h"
#include "evaluate/design_rules.h"
#include "evaluate/unfollowed.h"
#include "evaluate/devices.h"
#include "evaluate/not_applicable.h"
#include "evaluate/not_covered.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

CzStatus cz_checklist_append(CzChecklistBuilder *builder, const CzCheck *check) {
    CzChecklist *list = builder->list;
    CzCheck *checks = cz_arena_grow(builder->arena, list->check, list->n_check, sizeof *checks);
    if (checks == NULL)
        return cz_no_memory(builder->error, "the checks");
    list->check = checks;
    checks[list->n_check] = *check;
    if (check->scenario != CZ_NO_SCENARIO)
        checks[list->n_check].is_provisional |=
            cz_asked_is_unconfirmed(builder->problem, &builder->scene[check->scenario]);
    list->n_check++;
    return CZ_OK;
}

bool cz_is_unconfirmed(const char *confidence) {
    return confidence == NULL || (strcmp(confidence, "S1") != 0 && strcmp(confidence, "user") != 0);
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
static CzStatus append_in_scenarios(CzChecklistBuilder *builder, CzCheck check,
                                    const CzLimit *limit) {
    if (cz_level_is_of_design(check.metric.kind->level)) {
        check.scenario = CZ_NO_SCENARIO;
        return cz_checklist_append(builder, &check);
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
        CZ_TRY(cz_checklist_append(builder, &check));
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

/* A value of an override where it is given. */
static double over_or(double over, double value) {
    return isnan(over) ? value : over;
}

/* Adds a limit as one or two checks, with the numbers of an override. `profile` is NULL for the
 * user's own. */
static CzStatus append_overridden(CzChecklistBuilder *builder, const CzLimit *limit,
                                  const CzOverride *over, const char *profile, bool is_target) {
    CzCheck check = {.name = limit->name,
                     .profile = profile,
                     .clause = limit->clause,
                     .source = over->source != NULL ? over->source : limit->source,
                     .confidence = over->confidence != NULL ? over->confidence : limit->confidence,
                     .is_target = is_target};
    const double scale = over_or(over->scale, limit->scale);
    if (check.confidence == NULL && profile == NULL)
        check.confidence = "user";
    check.is_provisional = cz_is_unconfirmed(check.confidence);
    CZ_TRY(cz_problem_place_failure(builder->problem, &limit->metric,
                                    cz_metric_parse(limit->metric, &check.metric, builder->error),
                                    builder->error));
    check.scale = isnan(scale) || check.metric.kind->scale == CZ_FLAG_SCALE
                      ? check.metric.kind->scale
                      : scale;
    for (int side = 0; side < 2; side++) {
        check.is_minimum = side == 1;
        check.limit = side == 1 ? over_or(over->min, limit->min) : over_or(over->max, limit->max);
        if (!isnan(check.limit))
            CZ_TRY(append_in_scenarios(builder, check, limit));
    }
    return CZ_OK;
}

/* A limit as it is written; those of the profile have their overrides already. */
static CzStatus append_limit(CzChecklistBuilder *builder, const CzLimit *limit, const char *profile,
                             bool is_target) {
    const CzOverride none = {.max = NAN, .min = NAN, .scale = NAN};
    return append_overridden(builder, limit, &none, profile, is_target);
}

/* A limit of the file, with its override. */
static CzStatus append_file_limit(CzChecklistBuilder *builder, const CzLimit *limit) {
    const CzChecks *checks = &cz_problem_input(builder->problem)->checks;
    const int i = CZ_FIND_NAMED(limit->name, CzOverride, checks->override, checks->n_override,
                                &(CzSuggestion){0});
    if (i < 0)
        return append_limit(builder, limit, NULL, false);
    const CzOverride *written = &checks->override[i];
    CzOverride over = *written;
    const bool lacks_max = !isnan(over.max) && isnan(limit->max);
    if (lacks_max || (!isnan(over.min) && isnan(limit->min)))
        return cz_problem_fail(builder->problem, lacks_max ? &written->max : &written->min,
                               builder->error, "limit '%s' is %s limit: write '%s'", limit->name,
                               lacks_max ? "a lower" : "an upper", lacks_max ? "min" : "max");
    if (over.confidence == NULL)
        over.confidence = "user";
    return append_overridden(builder, limit, &over, NULL, false);
}

/* One with the name of a design rule would be a second check of that name. */
static CzStatus append_own_limit(CzChecklistBuilder *builder, const CzLimit *limit,
                                 bool has_rules) {
    if (!has_rules || !cz_design_rule_is(limit->name, &(CzSuggestion){0}))
        return append_file_limit(builder, limit);
    cz_fail(builder->error, CZ_STATUS_INPUT, "there is a design rule '%s'", limit->name);
    cz_error_help(builder->error,
                  "change its number by 'override' in 'checks', or choose another name");
    return cz_problem_place_failure(builder->problem, &limit->name, CZ_STATUS_INPUT,
                                    builder->error);
}

/* Whether the user has a limit of this name, which replaces that of the profile. */
static bool user_sets(const CzChecks *checks, const char *name) {
    for (int i = 0; i < checks->n_limits; i++)
        if (strcmp(checks->limits[i].name, name) == 0)
            return true;
    return false;
}

/* Each scenario that the profile asks for and that is not run is not checked. */
static CzStatus append_not_run(CzChecklistBuilder *builder, const CzProfile *profile) {
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
        CZ_TRY(cz_checklist_append(builder, &check));
    }
    return CZ_OK;
}

static CzStatus append_profile(CzChecklistBuilder *builder) {
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

/* ---- rules of problem files ------------------------------------------------------------------ */

static CzStatus append_rule_of_files(CzChecklistBuilder *builder, const char *name,
                                     const CzMetric *metric, double limit, const char *source) {
    const CzCheck check = {.name = name,
                           .scenario = CZ_NO_SCENARIO,
                           .metric = *metric,
                           .limit = limit,
                           .scale = metric->kind->scale,
                           .source = source,
                           .is_target = true,
                           .is_rule = true};
    return cz_checklist_append(builder, &check);
}

/* Every design must be valid in a problem file. The file's own values are, so these checks are not
 * listed. Each rule that a variable can violate has a name; the last check is for all rules of the
 * reader. */
static CzStatus append_rules_of_files(CzChecklistBuilder *builder) {
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

static CzStatus fail_name(const CzChecklistBuilder *builder, const void *field, const char *name,
                          const char *key, const CzSuggestion *nearest) {
    cz_fail(builder->error, CZ_STATUS_INPUT, "%s: there is no check '%s'", key, name);
    cz_suggest_help(nearest, builder->error);
    return cz_problem_place_failure(builder->problem, field, CZ_STATUS_INPUT, builder->error);
}

/* Fails for a check in judged_by that does not exist. */
static CzStatus check_judges_exist(const CzChecklistBuilder *builder) {
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

/* Fails for an override that is of no limit or scenario of the profile and of no design rule. */
static CzStatus check_overrides_exist(const CzChecklistBuilder *builder, bool has_rules) {
    const CzChecks *checks = &cz_problem_input(builder->problem)->checks;
    const CzProfile *profile = cz_problem_profile(builder->problem);
    for (int i = 0; i < checks->n_override; i++) {
        const char *name = checks->override[i].name;
        CzSuggestion nearest = {0};
        if (CZ_FIND_NAMED(name, CzLimit, checks->limits, checks->n_limits, &nearest) >= 0 ||
            (profile != NULL &&
             (CZ_FIND_NAMED(name, CzLimit, profile->limits, profile->n_limits, &nearest) >= 0 ||
              cz_profile_has_scenario(profile, name, &nearest))) ||
            (has_rules && cz_design_rule_is(name, &nearest)))
            continue;
        cz_fail(builder->error, CZ_STATUS_INPUT,
                "override: there is no limit, scenario or design rule '%s'", name);
        cz_suggest_help(&nearest, builder->error);
        return cz_problem_place_failure(builder->problem, &checks->override[i].name,
                                        CZ_STATUS_INPUT, builder->error);
    }
    return CZ_OK;
}

/* ---- constraints ----------------------------------------------------------------------------- */

/* Marks the checks that are constraints of the optimiser. */
static CzStatus choose_constraints(CzChecklistBuilder *builder) {
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

/* ---- contacts that the model does not follow ------------------------------------------------ */

static bool judges_override(const CzChecklist *list, int scenario) {
    for (int i = 0; i < list->n_check; i++)
        if (list->check[i].scenario == scenario && list->check[i].missing == NULL &&
            strcmp(list->check[i].metric.kind->name, "override") == 0)
            return true;
    return false;
}

/* Without a check of override, a run in which parts pass each other or slide must not pass by the
 * other checks alone. Overload cases are judged for bottoming out only. */
static CzStatus append_contacts(CzChecklistBuilder *builder) {
    CzCheck check = {.name = "contact beyond the model",
                     .source = "the model does not follow parts that pass each other or slide"};
    CZ_TRY(cz_metric_parse("contact_unfollowed", &check.metric, builder->error));
    check.scale = check.metric.kind->scale;
    const int n_before = builder->list->n_check;
    for (int s = 0; n_before > 0 && s < builder->n_scene; s++) {
        check.scenario = s;
        check.is_bare = !builder->scene[s].has_reserves;
        if (!builder->scene[s].is_overload &&
            cz_scene_is_judged_by(&builder->scene[s], check.name) &&
            cz_contact_may_be_unfollowed(&builder->scene[s]) && !judges_override(builder->list, s))
            CZ_TRY(cz_checklist_append(builder, &check));
    }
    return CZ_OK;
}

static CzChecklistBuilder builder_of(const CzProblem *problem, int n_scene, const CzScene *scene,
                                     CzArena *arena, CzChecklist *checklist, CzError *error) {
    return (CzChecklistBuilder){.problem = problem,
                                .n_scene = n_scene,
                                .scene = scene,
                                .arena = arena,
                                .list = checklist,
                                .error = error};
}

CzStatus cz_checklist_build(const CzProblem *problem, int n_scene, const CzScene *scene,
                            CzArena *arena, CzChecklist *checklist, CzError *error) {
    *checklist = (CzChecklist){0};
    CzChecklistBuilder builder = builder_of(problem, n_scene, scene, arena, checklist, error);
    const CzInput *input = cz_problem_input(problem);
    const bool has_rules = !input->checks.given || input->checks.design_rules;
    CZ_TRY(check_overrides_exist(&builder, has_rules));
    CZ_TRY(append_profile(&builder));
    for (int i = 0; i < input->checks.n_limits; i++)
        CZ_TRY(append_own_limit(&builder, &input->checks.limits[i], has_rules));
    if (has_rules)
        CZ_TRY(cz_design_rules_append(&builder));
    CZ_TRY(append_contacts(&builder));
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
    CzChecklistBuilder builder = builder_of(problem, n_scene, scene, arena, checklist, error);
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
