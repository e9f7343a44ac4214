/* Rules of the uncertain numbers and of the envelope. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/error.h"
#include "base/number.h"
#include "problem/changes.h"

/* Exactly one kind of range, and what it needs. */
static void check_range(const CzRules *rules, const CzScatter *scatter) {
    const bool has_min = cz_rule_is_written(rules, &scatter->min);
    const bool has_max = cz_rule_is_written(rules, &scatter->max);
    const int n_kind = cz_rule_is_written(rules, &scatter->tolerance_percent) +
                       cz_rule_is_written(rules, &scatter->tolerance) + (has_min || has_max) +
                       cz_rule_is_written(rules, &scatter->values);
    if (n_kind != 1 || has_min != has_max)
        cz_rule_broken(rules, scatter,
                       "an uncertain number needs exactly one of 'tolerance_percent', 'tolerance', "
                       "'min' with 'max', and 'values'");
    else if (has_min && scatter->min >= scatter->max)
        cz_rule_broken(rules, &scatter->min, "min %s must be below max %s", CZ_SHORT(scatter->min),
                       CZ_SHORT(scatter->max));
    if (scatter->distribution == CZ_DISTRIBUTION_LOGNORMAL && !isnan(scatter->tolerance))
        cz_rule_broken(rules, &scatter->distribution,
                       "a lognormal distribution needs 'tolerance_percent' or a range above 0");
    if (scatter->distribution == CZ_DISTRIBUTION_LOGNORMAL && scatter->min <= 0)
        cz_rule_broken(rules, &scatter->min, "the range of a lognormal distribution is above 0");
    if (scatter->values.n_text > 0 && scatter->distribution != CZ_DISTRIBUTION_UNIFORM)
        cz_rule_broken(rules, &scatter->distribution, "values have no distribution");
    for (int i = 0; i < scatter->values.n_text; i++) {
        double value;
        const char *wrong = cz_number_parse(scatter->values.text[i], &value);
        if (wrong != NULL)
            cz_rule_broken(rules, &scatter->values, "values: '%.60s' %s", scatter->values.text[i],
                           wrong);
    }
}

/* Finds the numbers that a path names, or reports why there are none. */
static CzTargets find(const CzRules *rules, const char *const *path) {
    CzTargets targets = {0};
    CzError error = {0};
    const CzStatus status = cz_problem_find_changed(rules->problem, 0, *path, &targets, &error);
    if (status == CZ_STATUS_NO_MEMORY)
        rules->mistakes->arena->out_of_memory = true;
    if (status == CZ_STATUS_INPUT)
        cz_rule_broken(rules, path, "%s" CZ_HELP "%s", error.message, error.help);
    return targets;
}

/* Whether a path names numbers that may scatter. */
static void check_path(const CzRules *rules, const CzScatter *scatter, const char *const *path) {
    const CzTargets targets = find(rules, path);
    for (int i = 0; i < targets.n && !isnan(scatter->tolerance_percent); i++)
        if (isnan(targets.target[i].value)) {
            cz_rule_broken(rules, path,
                           "'%.120s' has no value in the file of which %s %% could be "
                           "taken",
                           targets.target[i].place, CZ_SHORT(scatter->tolerance_percent));
            break;
        }
    if (scatter->group == CZ_GROUP_PART && cz_change_is_late(*path))
        cz_rule_broken(rules, path, "only paths of parts have the group 'part'");
    free(targets.target);
}

static void check_scatter(const CzRules *rules, const CzScatter *scatter) {
    const bool has_path = cz_rule_is_written(rules, &scatter->path);
    if (has_path == cz_rule_is_written(rules, &scatter->paths))
        cz_rule_broken(rules, has_path ? (const void *)&scatter->paths : scatter,
                       "an uncertain number needs exactly one of 'path' and 'paths'");
    check_range(rules, scatter);
    if (rules->reader->has_holes || rules->mistakes->n_mistake > 0)
        return;
    if (scatter->path != NULL)
        check_path(rules, scatter, &scatter->path);
    for (int i = 0; i < scatter->paths.n_text; i++)
        check_path(rules, scatter, &scatter->paths.text[i]);
}

static void check_span(const CzRules *rules, const CzSpan *span) {
    if (span->min > span->max)
        cz_rule_broken(rules, &span->min, "min %s is above max %s", CZ_SHORT(span->min),
                       CZ_SHORT(span->max));
    if (span->path != NULL && !cz_change_is_late(span->path))
        cz_rule_broken(rules, &span->path,
                       "the envelope is of operation; parts scatter by 'parameters'");
    if (rules->reader->has_holes || rules->mistakes->n_mistake > 0 || span->path == NULL)
        return;
    free(find(rules, &span->path).target);
}

void cz_rules_check_uncertainty(const CzRules *rules) {
    const CzUncertainty *uncertainty = &rules->input->uncertainty;
    if (!uncertainty->given)
        return;
    cz_rules_check_scenario_names(rules, &uncertainty->scenarios);
    cz_rules_check_scenario_names(rules, &uncertainty->challenged);
    for (int i = 0; i < uncertainty->n_parameters; i++)
        if (uncertainty->parameters[i].given)
            check_scatter(rules, &uncertainty->parameters[i]);
    for (int i = 0; i < uncertainty->n_envelope; i++)
        if (uncertainty->envelope[i].given)
            check_span(rules, &uncertainty->envelope[i]);
}
