/* Rules of the matches of a fit. */
#include <math.h>

#include "base/suggest.h"
#include "problem/rules.h"

/* A match has either a metric, an event or a channel. */
static void check_kind(const CzRules *rules, const CzMatch *match) {
    const int n_kind = (match->metric != NULL) + (match->event != NULL) + (match->channel != NULL);
    if (n_kind != 1)
        cz_rule_broken(rules, match,
                       "a match needs exactly one of 'metric', 'event' and 'channel'");
    if (match->where != NULL && match->event == NULL)
        cz_rule_broken(rules, &match->where, "'where' belongs to an event");
}

static void check_channel(const CzRules *rules, const CzMatch *match) {
    const bool has_value = cz_rule_is_written(rules, &match->value);
    const bool has_time = cz_rule_is_written(rules, &match->time);
    if (has_value == (match->file != NULL))
        cz_rule_broken(rules, match->file != NULL ? (const void *)&match->value : match,
                       "a channel has a 'value' at a 'time' or follows a 'file'");
    else if (has_value != has_time)
        cz_rule_broken(rules, has_time ? (const void *)&match->time : &match->value,
                       "the 'value' of a channel needs its 'time', such as time_ms, and no file");
    if (match->from >= match->to)
        cz_rule_broken(rules, &match->from, "the window ends before it begins");
}

static void check_window(const CzRules *rules, const CzMatch *match) {
    const struct {
        const void *field;
        const char *name;
    } keys[] = {{&match->file, "file"},
                {&match->column, "column"},
                {&match->from, "from"},
                {&match->to, "to"},
                {&match->time, "time"}};
    const bool is_channel = match->channel != NULL;
    for (int i = 0; i < 5; i++) {
        const bool belongs = is_channel && (i == 0 || i == 4 || match->file != NULL);
        if (!belongs && cz_rule_is_written(rules, keys[i].field))
            cz_rule_broken(rules, keys[i].field, "'%s' belongs to a channel%s", keys[i].name,
                           i == 0 || i == 4 ? "" : " that follows a file");
    }
}

static void check_scenario(const CzRules *rules, const CzMatch *match) {
    CzSuggestion nearest = {0};
    if (match->scenario == NULL) {
        if (rules->input->n_scenarios > 1)
            cz_rule_broken(rules, match, "'scenario' must name one of the %d scenarios",
                           rules->input->n_scenarios);
        return;
    }
    if (CZ_FIND_NAMED(match->scenario, CzScenario, rules->input->scenarios,
                      rules->input->n_scenarios, &nearest) >= 0)
        return;
    cz_rule_broken(rules, &match->scenario, "there is no scenario '%.48s'", match->scenario);
    cz_mistake_suggest(rules->mistakes, &nearest);
}

void cz_rules_check_fit(const CzRules *rules) {
    const CzOptimise *optimise = &rules->input->optimise;
    for (int i = 0; optimise->given && i < optimise->n_match; i++) {
        const CzMatch *match = &optimise->match[i];
        if (!match->given)
            continue;
        check_kind(rules, match);
        if (match->channel != NULL)
            check_channel(rules, match);
        else if (!cz_rule_is_written(rules, &match->value))
            cz_rule_broken(rules, match, "a match needs the measured 'value'");
        check_window(rules, match);
        check_scenario(rules, match);
    }
    if (optimise->given && optimise->n_match > 0 && cz_rule_is_written(rules, &optimise->minimise))
        cz_rule_broken(rules, &optimise->minimise,
                       "a fit minimises the differences of 'match' only");
}
