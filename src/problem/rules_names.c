/* Rules of names: their characters (base/text.h), and that they are unique. */
#include <stdio.h>
#include <string.h>

#include "base/index.h"
#include "base/text.h"
#include "crushzone/channel.h"
#include "problem/rules.h"

/* ---- characters ---- */

/* Names are in paths, columns, files and folders. */
static void check_name(const CzRules *rules, const char *const *name, const char *what,
                       const char *further) {
    char fault[CZ_FAULT_SIZE];
    if (*name != NULL && cz_name_fault(*name, further, fault))
        cz_rule_broken(rules, name, "the name of a %s, '%.60s', %s", what, *name, fault);
}

static void check_label(const CzRules *rules, const char *const *label, const char *what) {
    if (*label != NULL && strlen(*label) > CZ_MAX_LABEL)
        cz_rule_broken(rules, label, "the name of a %s has more than %d bytes", what,
                       (int)CZ_MAX_LABEL);
}

/* ---- uniqueness ---- */

/* The names of one kind so far. */
typedef struct Names {
    const CzRules *rules;
    CzIndex index;
} Names;

static Names names_of(const CzRules *rules) {
    return (Names){rules, {.arena = rules->mistakes->arena}};
}

/* Adds the name of a numbered record; returns the number of the first record with that name, which
 * is this one if the name is new. */
static int add(Names *names, const char *name, int number) {
    const size_t n = strlen(name);
    const int first = cz_index_find(&names->index, name, n);
    if (first >= 0)
        return first;
    (void)cz_index_add(&names->index, name, n, number); /* the arena reports a lack of memory */
    return number;
}

/* Reports a name that two records have. Where both have it from one part, the places are those of
 * the records and not of the part. */
static void refuse_second(const CzRules *rules, const char *what, const char *const *first_name,
                          const void *first, const char *const *name, const void *second) {
    CzError at = {0}, first_at = {0};
    cz_problem_place(rules->problem, name, &at);
    cz_problem_place(rules->problem, first_name, &first_at);
    const bool is_one_place = first_at.line == at.line && first_at.column == at.column &&
                              strcmp(first_at.file, at.file) == 0;
    if (is_one_place)
        cz_problem_place(rules->problem, first, &first_at);
    const bool is_elsewhere = strcmp(first_at.file, at.file) != 0;
    cz_rule_broken(rules, is_one_place ? second : (const void *)name,
                   "there are two %s '%.48s'; the first is at %s%s%d", what, *name,
                   is_elsewhere ? first_at.file : "line", is_elsewhere ? ":" : " ", first_at.line);
}

static bool check_vehicles(const CzRules *rules) {
    bool are_different = true;
    const CzVehicle *vehicle = rules->problem->vehicle;
    Names names = names_of(rules);
    for (int i = 0; i < rules->problem->n_vehicle; i++) {
        const char *const *name = &vehicle[i].name;
        check_name(rules, name, "vehicle", "");
        const int first = *name != NULL ? add(&names, *name, i) : i;
        if (first == i)
            continue;
        are_different = false;
        refuse_second(rules, "vehicles", &vehicle[first].name, &vehicle[first], name, &vehicle[i]);
    }
    return are_different;
}

static void check_trains(const CzRules *rules) {
    const CzInput *input = rules->input;
    Names names = names_of(rules);
    for (int i = 0; i < input->n_trains; i++) {
        const char *const *name = &input->trains[i].name;
        check_name(rules, name, "train", "");
        const int first = *name != NULL ? add(&names, *name, i) : i;
        if (first != i)
            refuse_second(rules, "trains", &input->trains[first].name, &input->trains[first], name,
                          &input->trains[i]);
    }
}

/* ---- columns ---- */

/* Adds the columns of channels of a vehicle (0), or of an interface (1), up to the first that is
 * there already. */
static void add_columns(Names *names, bool of_interface, const char *name,
                        const char *const *field) {
    CzArena *arena = names->rules->mistakes->arena;
    for (CzChannel channel = 0; channel < CZ_N_CHANNEL; channel++) {
        const CzChannelInfo *info = cz_channel_info(channel);
        const bool fits = of_interface ? info->at == CZ_AT_INTERFACE
                                       : info->at != CZ_AT_INTERFACE && info->at != CZ_AT_RUN;
        for (int place = 0; fits && cz_place_index(info->at, place) == 0; place++) {
            char text[CZ_CHANNEL_SIZE];
            cz_channel_name(info, place, name, text);
            const char *kept = cz_arena_copy_text(arena, text, strlen(text));
            const int number = names->index.n_entry;
            if (kept == NULL || add(names, kept, number) == number)
                continue;
            cz_rule_broken(
                names->rules, field,
                "the name '%.48s' makes two columns of the results have the same name: %.127s",
                *field, text);
            return;
        }
    }
}

/* Vehicles whose interfaces would have the same name of a column, such as A-B and C as well as A
 * and B-C. */
static void check_columns(const CzRules *rules) {
    Names names = names_of(rules);
    const CzVehicle *vehicle = rules->problem->vehicle;
    for (int i = 0; i < rules->problem->n_vehicle; i++)
        if (vehicle[i].name != NULL && strlen(vehicle[i].name) <= CZ_MAX_NAME)
            add_columns(&names, false, vehicle[i].name, &vehicle[i].name);
    for (int i = 0; i + 1 < rules->problem->n_vehicle; i++) {
        const char *behind = vehicle[i].name, *ahead = vehicle[i + 1].name;
        char text[CZ_INTERFACE_SIZE];
        if (behind == NULL || ahead == NULL)
            continue;
        snprintf(text, sizeof text, "%.48s-%.48s", behind, ahead);
        add_columns(&names, true, text, &vehicle[i].name);
    }
}

/* ---- scenarios ---- */

/* Names in small letters: some file systems do not distinguish case. */
static const char *small(const CzRules *rules, const char *name) {
    char *copy = cz_arena_copy_text(rules->mistakes->arena, name, strlen(name));
    for (char *c = copy; c != NULL && *c != '\0'; c++)
        if (*c >= 'A' && *c <= 'Z')
            *c = (char)(*c - 'A' + 'a');
    return copy;
}

/* Whether a result folder itself contains a file of that name. */
static bool is_result_file(const char *name) {
    static const char *const files[] = {
#define CZ_RESULT_FILE(constant, name, doc) name,
#include "crushzone/result_files.def"
#undef CZ_RESULT_FILE
    };
    for (size_t i = 0; i < sizeof files / sizeof *files; i++) {
        const size_t n = strcspn(files[i], "/");
        if (strlen(name) == n && strncmp(files[i], name, n) == 0)
            return true;
    }
    return false;
}

static void check_scenario_name(const CzRules *rules, Names *names, int scenario) {
    const CzScenario *all = rules->input->scenarios;
    const char *const *name = &all[scenario].name;
    check_name(rules, name, "scenario", ".");
    if (*name == NULL)
        return;
    const char *lower = small(rules, *name);
    if ((*name)[0] == '.')
        cz_rule_broken(rules, name, "the name of a scenario does not begin with a point");
    else if ((*name)[strlen(*name) - 1] == '.')
        cz_rule_broken(rules, name, "the name of a scenario does not end with a point");
    else if (lower != NULL && is_result_file(lower))
        cz_rule_broken(
            rules, name,
            "a scenario cannot be called '%.48s': a result folder contains a file of that name",
            *name);
    const int first = lower != NULL ? add(names, lower, scenario) : scenario;
    if (first != scenario)
        refuse_second(rules, "scenarios", &all[first].name, &all[first], name, &all[scenario]);
}

static void check_scenarios(const CzRules *rules) {
    const CzInput *input = rules->input;
    Names names = names_of(rules);
    for (int i = 0; i < input->n_scenarios; i++) {
        check_scenario_name(rules, &names, i);
        check_name(rules, &input->scenarios[i].family, "family", ".");
    }
}

/* ---- all ---- */

static void check_labels(const CzRules *rules) {
    const CzInput *input = rules->input;
    for (int i = 0; i < input->checks.n_limits; i++)
        check_label(rules, &input->checks.limits[i].name, "check");
    for (int i = 0; i < rules->problem->profile.n_limits; i++)
        check_label(rules, &rules->problem->profile.limits[i].name, "check");
    for (int i = 0; i < input->optimise.n_variables; i++)
        check_label(rules, &input->optimise.variables[i].name, "variable");
    for (int i = 0; i < input->optimise.n_targets; i++)
        check_label(rules, &input->optimise.targets[i].name, "check");
    for (int i = 0; i < input->optimise.n_match; i++)
        check_label(rules, &input->optimise.match[i].name, "match");
}

void cz_rules_check_names(const CzRules *rules) {
    check_trains(rules);
    if (check_vehicles(rules))
        check_columns(rules);
    check_scenarios(rules);
    check_labels(rules);
}
