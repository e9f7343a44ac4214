/* Rules of profiles: their numbers have an origin, and their names are known. */
#include <math.h>
#include <string.h>

#include "problem/rules.h"

/* ---- origin of numbers ---- */

static const char *const confidences[] = {"S1", "S2", "X", "M1", "M2", "M3", "user"};
enum { N_CONFIDENCE = sizeof confidences / sizeof *confidences };

void cz_rules_check_confidence(const CzRules *rules, const char *const *confidence) {
    CzSuggestion nearest = {0};
    if (*confidence == NULL || CZ_FIND_TEXT(*confidence, confidences, N_CONFIDENCE, &nearest) >= 0)
        return;
    cz_rule_warning(rules, confidence,
                    "confidence '%.40s' is not one of S1, S2, X, M1, M2, M3 and user: a pass is "
                    "PROVISIONAL at most",
                    *confidence);
    cz_mistake_suggest(rules->warnings, &nearest);
}

/* Clause, source and confidence of a limit or scenario. */
typedef struct Origin {
    const void *record;
    const char *what, *name;
    const char *clause, *source;
    const char *const *confidence;
} Origin;

/* The numbers of a profile have no default origin. */
static void check_origin(const CzRules *rules, const Origin *origin) {
    const struct {
        const char *text, *key;
    } required[] = {{origin->clause, "clause"},
                    {origin->source, "source"},
                    {*origin->confidence, "confidence"}};
    CzSuggestion nearest = {0};
    for (int i = 0; i < 3; i++)
        if (required[i].text == NULL && origin->name != NULL)
            cz_rule_absent(rules, origin->record, "%s '%.60s' of a profile lacks '%s'",
                           origin->what, origin->name, required[i].key);
    if (*origin->confidence == NULL ||
        CZ_FIND_TEXT(*origin->confidence, confidences, N_CONFIDENCE, &nearest) >= 0)
        return;
    cz_rule_broken(rules, origin->confidence,
                   "confidence '%.40s' is not one of S1, S2, X, M1, M2, M3 and user",
                   *origin->confidence);
    cz_mistake_suggest(rules->mistakes, &nearest);
}

/* ---- a profile as written ---- */

static bool has_category(const CzProfile *profile, const char *name, CzSuggestion *nearest) {
    return CZ_FIND_NAMED(name, CzCategory, profile->categories, profile->n_categories, nearest) >=
           0;
}

static void check_categories(const CzRules *rules, const CzProfile *profile,
                             const CzTexts *categories) {
    for (int i = 0; i < categories->n_text; i++) {
        CzSuggestion nearest = {0};
        if (has_category(profile, categories->text[i], &nearest))
            continue;
        cz_rule_broken(rules, &categories->text[i], "the profile has no category '%.48s'",
                       categories->text[i]);
        cz_mistake_suggest(rules->mistakes, &nearest);
    }
}

static void check_limits(const CzRules *rules, const CzProfile *profile) {
    for (int i = 0; i < profile->n_limits; i++) {
        const CzLimit *limit = &profile->limits[i];
        if (limit->given)
            check_origin(rules, &(Origin){limit, "limit", limit->name, limit->clause, limit->source,
                                          &limit->confidence});
        check_categories(rules, profile, &limit->categories);
    }
}

/* A profile is found by the name of its file, and results name it by its own. */
static void check_name(const CzRules *rules, const CzProfile *profile, const char *path) {
    const char *slash = strrchr(path, '/'), *file = slash != NULL ? slash + 1 : path;
    const char *dot = strrchr(file, '.');
    const int n = dot != NULL ? (int)(dot - file) : (int)strlen(file);
    if (profile->name != NULL &&
        ((int)strlen(profile->name) != n || memcmp(profile->name, file, (size_t)n) != 0))
        cz_rule_broken(rules, &profile->name,
                       "the profile is named '%.96s', but its file %.120s" CZ_HELP
                       "write name: %.*s, or rename the file",
                       profile->name, file, n, file);
}

void cz_rules_check_profile(const CzRules *rules, const CzProfile *profile, const char *path) {
    check_name(rules, profile, path);
    for (int i = 0; i < profile->n_categories; i++)
        for (int k = 0; k < i; k++)
            if (profile->categories[i].name != NULL && profile->categories[k].name != NULL &&
                strcmp(profile->categories[i].name, profile->categories[k].name) == 0)
                cz_rule_broken(rules, &profile->categories[i].name,
                               "there are two categories '%.48s'", profile->categories[i].name);
    for (int i = 0; i < profile->n_scenarios; i++)
        check_categories(rules, profile, &profile->scenarios[i].categories);
    check_limits(rules, profile);
}

/* ---- its scenarios in one category ---- */

void cz_rules_check_profile_scenarios(const CzRules *rules, const CzProfile *profile) {
    for (int i = 0; i < profile->n_scenarios; i++) {
        const CzProfileScenario *scenario = &profile->scenarios[i];
        if (!scenario->given || scenario->name == NULL)
            continue;
        check_origin(rules, &(Origin){scenario, "scenario", scenario->name, scenario->clause,
                                      scenario->source, &scenario->confidence});
        if (scenario->partner == NULL)
            cz_rule_broken(rules, scenario, "scenario '%.48s' lacks 'partner'", scenario->name);
        if (isnan(scenario->speed) && isnan(scenario->below_line_speed))
            cz_rule_broken(rules, scenario,
                           "scenario '%.48s' needs a speed, or a rule 'below_line_speed'",
                           scenario->name);
        for (int k = 0; k < i; k++)
            if (profile->scenarios[k].name != NULL &&
                strcmp(profile->scenarios[k].name, scenario->name) == 0)
                cz_rule_broken(rules, &scenario->name,
                               "there are two scenarios '%.48s' in one category", scenario->name);
    }
}
