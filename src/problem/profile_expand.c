/* Adds partners and scenarios of the problem's profile to its tree. */
#include <stdarg.h>
#include <stdio.h>
#include <string.h>

#include "base/number.h"
#include "base/text.h"
#include "problem/profile.h"
#include "problem/profile_partners.h"
#include "problem/rules.h"
#include "tree/merge.h"
#include "tree/trains.h"
#include "tree/write_node.h"

typedef struct Expansion {
    CzProblem *problem;
    CzReader *reader;
    CzArena *arena;
    CzTree tree; /* with the settings of `checks` */
    CzPlaces places;
    CzChecks checks;      /* with its places above */
    const CzPlace *named; /* of the profile's name */
    CzProfileFile file;
    CzPartners partners;
    const CzNode *own; /* scenarios of the problem, with their parts inserted; NULL for none */
    CzNode *scenarios; /* those that are added */
} Expansion;

__attribute__((format(printf, 2, 3))) static const char *sentence(Expansion *expansion,
                                                                  const char *format, ...) {
    char text[400];
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(text, sizeof text, format, arguments);
    va_end(arguments);
    return cz_arena_copy_text(expansion->arena, text, strlen(text));
}

/* ---- what the problem says ---- */

/* Reads `checks` of the tree; false when they name no profile. Mistakes are found again when the
 * records are read. */
static bool read_checks(Expansion *expansion) {
    const CzEntry *entry = cz_node_find(expansion->tree.root, "checks");
    if (entry == NULL)
        return false;
    CzBinder binder = cz_problem_binder(expansion->problem, &expansion->tree);
    binder.places = &expansion->places;
    cz_bind_record(binder, &cz_records[CZ_RECORD_CzChecks], entry->value,
                   cz_entry_trail(entry, &cz_no_trail), &expansion->checks);
    expansion->named = cz_places_find(&expansion->places, &expansion->checks.profile);
    return expansion->checks.profile != NULL && !expansion->arena->out_of_memory;
}

/* Where a value of `checks` is written. */
static const CzPlace *place_of(const Expansion *expansion, const void *field) {
    return cz_places_find(&expansion->places, field);
}

/* A category is required where the profile has some, and refused where it has none. */
static bool check_category(Expansion *expansion) {
    CzMistakes *mistakes = &expansion->reader->mistakes;
    const CzChecks *checks = &expansion->checks;
    const CzProfile *whole = expansion->file.whole;
    const CzPlace *named = expansion->named, *place = place_of(expansion, &checks->category);
    CzSuggestion nearest = {0};
    const bool has_any = whole->n_categories > 0;
    if (checks->category == NULL && has_any)
        cz_mistake(mistakes, named->value, named->trail,
                   "profile '%.96s' has categories; 'checks' must name one" CZ_HELP
                   "'crushzone profile show %.96s' lists them",
                   checks->profile, checks->profile);
    else if (checks->category != NULL && !has_any)
        cz_mistake(mistakes, place->value, place->trail,
                   "profile '%.96s' has no categories: remove '%.96s', all of it applies",
                   checks->profile, checks->category);
    else if (checks->category != NULL &&
             CZ_FIND_NAMED(checks->category, CzCategory, whole->categories, whole->n_categories,
                           &nearest) < 0) {
        cz_mistake(mistakes, place->value, place->trail, "profile '%.96s' has no category '%.96s'",
                   checks->profile, checks->category);
        cz_mistake_suggest(mistakes, &nearest);
    } else {
        return true;
    }
    return false;
}

/* Finds and reads the profile, and the part of it that applies to the category. */
static bool read_profile(Expansion *expansion) {
    CzProblem *problem = expansion->problem;
    CzReader *reader = expansion->reader;
    const CzPlace *named = expansion->named;
    const char *name = expansion->checks.profile;
    CzSuggestion nearest = {0};
    const char *path = cz_profile_find(reader, named->value->source->folder, name, &nearest);
    if (path == NULL) {
        cz_mistake(&reader->mistakes, named->value, named->trail,
                   "there is no profile '%.96s': no file profiles/%.96s.yaml", name, name);
        cz_mistake_suggest(&reader->mistakes, &nearest);
        return false;
    }
    expansion->file = cz_profile_load(problem, path, named->value);
    if (expansion->file.top == NULL || !check_category(expansion))
        return false;
    problem->whole_profile = expansion->file.whole;
    return cz_profile_in_category(problem, &expansion->file, expansion->checks.category,
                                  &problem->profile) &&
           !reader->arena.out_of_memory;
}

/* ---- overrides ---- */

static bool is_one(const char *text, const char *name) {
    return text != NULL && name != NULL && strcmp(text, name) == 0;
}

static void override(Expansion *expansion, const CzOverride *over, CzLimit *limit) {
    const bool is_of_minimum = isnan(limit->max);
    const double *wrong = is_of_minimum ? &over->max : &over->min;
    if (!isnan(*wrong)) {
        const CzPlace *place = place_of(expansion, wrong);
        cz_mistake(&expansion->reader->mistakes, place->node, place->trail,
                   "limit '%.60s' is %s limit: write '%s'", limit->name,
                   is_of_minimum ? "a lower" : "an upper", is_of_minimum ? "min" : "max");
        return;
    }
    if (!isnan(over->max))
        limit->max = over->max;
    if (!isnan(over->min))
        limit->min = over->min;
    if (!isnan(over->scale))
        limit->scale = over->scale;
    if (over->source != NULL)
        limit->source = over->source;
    limit->confidence = over->confidence != NULL ? over->confidence : "user";
}

/* Confirms the numbers of a scenario of the profile; others are given by a scenario of the file. */
static void confirm(Expansion *expansion, const CzOverride *over, CzProfileScenario *scenario) {
    const double *const number[] = {&over->max, &over->min, &over->scale};
    for (int i = 0; i < 3; i++) {
        if (isnan(*number[i]))
            continue;
        const CzPlace *place = place_of(expansion, number[i]);
        cz_mistake(&expansion->reader->mistakes, place->node, place->trail,
                   "'%.60s' is a scenario, which 'override' can only give 'source' and "
                   "'confidence'" CZ_HELP "a scenario of that name in the file replaces it",
                   over->name);
    }
    if (over->source != NULL)
        scenario->source = over->source;
    scenario->confidence = over->confidence != NULL ? over->confidence : "user";
}

/* Gives limits and scenarios of the profile what the problem says of them. */
static void apply_overrides(Expansion *expansion) {
    const CzProfile *profile = &expansion->problem->profile;
    for (int i = 0; i < expansion->checks.n_override; i++) {
        const CzOverride *over = &expansion->checks.override[i];
        for (int k = 0; k < profile->n_limits; k++)
            if (is_one(over->name, profile->limits[k].name))
                override(expansion, over, &profile->limits[k]);
        for (int k = 0; k < profile->n_scenarios; k++)
            if (is_one(over->name, profile->scenarios[k].name) ||
                is_one(over->name, profile->scenarios[k].family))
                confirm(expansion, over, &profile->scenarios[k]);
    }
}

/* ---- scenarios ---- */

/* The scenarios of the problem with their parts inserted; false without memory. */
static bool take_own_scenarios(Expansion *expansion) {
    const CzEntry *written = cz_node_find_list(expansion->tree.root, "scenarios");
    if (written == NULL)
        return true;
    CzNode *own = cz_node_copy(expansion->arena, written->value, 0);
    for (int i = 0; own != NULL && i < own->n_entry; i++) {
        CzEntry *entry = &own->entry[i];
        entry->trail = cz_entry_trail(entry, cz_entry_trail(written, &cz_no_trail));
        entry->value =
            cz_take_part(expansion->reader, &expansion->tree, entry->value, entry->trail);
        if (entry->value == NULL)
            return false;
    }
    expansion->own = own;
    return own != NULL;
}

/* Whether a scenario of the problem stands for one of the profile: by its name, or by its family,
 * which the name of a sweep is, too. */
static bool replaces(const CzNode *own, const CzProfileScenario *scenario) {
    const char *name = cz_node_find_text(own, "name"), *family = cz_node_find_text(own, "family");
    if (family == NULL && cz_node_find(own, "sweep") != NULL)
        family = name;
    return is_one(name, scenario->name) || is_one(family, scenario->name) ||
           is_one(family, scenario->family);
}

static const char *find_replacement(const Expansion *expansion, const CzProfileScenario *scenario) {
    for (int i = 0; expansion->own != NULL && i < expansion->own->n_entry; i++)
        if (replaces(expansion->own->entry[i].value, scenario))
            return cz_node_find_text(expansion->own->entry[i].value, "name");
    return NULL;
}

static bool is_selected(const Expansion *expansion, const CzProfileScenario *scenario) {
    const CzTexts *selected = &expansion->checks.scenarios;
    const CzPlace *place = place_of(expansion, selected);
    if (place == NULL || place->address != selected)
        return true;
    for (int i = 0; i < selected->n_text; i++)
        if (is_one(selected->text[i], scenario->name) ||
            is_one(selected->text[i], scenario->family))
            return true;
    return false;
}

static void check_selection(Expansion *expansion) {
    const CzTexts *selected = &expansion->checks.scenarios;
    for (int i = 0; i < selected->n_text; i++) {
        CzSuggestion nearest = {0};
        if (cz_profile_has_scenario(&expansion->problem->profile, selected->text[i], &nearest))
            continue;
        const CzPlace *place = place_of(expansion, &selected->text[i]);
        cz_mistake(&expansion->reader->mistakes, place->value, place->trail,
                   "the profile has no scenario '%.48s' for this category", selected->text[i]);
        cz_mistake_suggest(&expansion->reader->mistakes, &nearest);
    }
}

/* The line speed decides the speed of a scenario. */
static void need_line_speed(Expansion *expansion, const CzProfileScenario *scenario) {
    const CzPlace *named = expansion->named;
    char rule[120];
    cz_profile_speed_text(scenario, rule);
    cz_mistake(&expansion->reader->mistakes, named->value, named->trail,
               "scenario '%.48s' of the profile runs at the %s; 'checks' lacks 'line_speed'" CZ_HELP
               "write line_speed_km_h, the largest speed of the train on its line",
               scenario->name, rule);
}

/* A mapping's entry that is also one of a scenario of a problem. Speed and train are set. */
static bool is_kept(const CzEntry *entry, const CzNode *partner) {
    const CzUnit *unit = NULL;
    const CzKey *key = cz_record_match(&cz_records[CZ_RECORD_CzScenario], entry->key->text, &unit);
    if (key == NULL || cz_text_is_word(key->stem, "like speed trains"))
        return false;
    double ratio;
    const bool rolls = strcmp(key->stem, "partner_brake_ratio") == 0 &&
                       entry->value->kind == CZ_NODE_TEXT &&
                       cz_number_parse(entry->value->text, &ratio) == NULL && ratio == 0;
    return !rolls || cz_node_find(partner, "brake") != NULL;
}

/* The names of the two trains that collide; NULL without memory. */
static const CzNode *make_pair(Expansion *expansion, const char *partner, const CzNode *place) {
    const CzNodeWriter writer = {.arena = expansion->arena, .place = *place};
    CzNode *list = cz_write_node(&writer, CZ_NODE_LIST, 2);
    const bool is_made = list != NULL &&
                         cz_write_item(list, cz_write_name(&writer, expansion->partners.moving)) &&
                         cz_write_item(list, cz_write_name(&writer, partner));
    return is_made ? list : NULL;
}

/* The key that decides the speed of a scenario. */
static const CzNode *speed_key(const Expansion *expansion, const CzProfileScenario *scenario) {
    const double *field = isnan(scenario->speed) ? &scenario->below_line_speed : &scenario->speed;
    return cz_places_find(&expansion->problem->places, field)->node;
}

/* Adds a scenario of the profile to those of the problem. */
static void add_scenario(Expansion *expansion, const CzNode *written,
                         const CzProfileScenario *scenario, double speed) {
    const CzNode *place = speed_key(expansion, scenario);
    CzArena *arena = expansion->arena;
    const CzEntry *named = cz_node_find(written, "partner");
    const bool is_named = named != NULL && named->value->kind == CZ_NODE_TEXT;
    const CzNode *train = is_named ? cz_partners_take(&expansion->partners, named->value) : NULL;
    const char *partner = train != NULL ? cz_node_find_text(train, "name") : NULL;
    CzNode *node = partner != NULL ? cz_node_copy(arena, written, 2) : NULL;
    if (node == NULL)
        return;
    node->n_entry = 0;
    for (int i = 0; i < written->n_entry; i++)
        if (is_kept(&written->entry[i], train))
            node->entry[node->n_entry++] = written->entry[i];
    char digits[32]; /* without the rounding of units: 110 and not 110.00000000000001 */
    snprintf(digits, sizeof digits, "%.12g", speed * 3.6);
    if (cz_node_append(arena, node, "trains", written, make_pair(expansion, partner, written),
                       &cz_no_trail) &&
        cz_node_append(arena, node, "speed_km_h", place, cz_node_text(arena, digits, place),
                       &cz_no_trail))
        cz_write_item(expansion->scenarios, node);
}

/* Whether the moving train has the coupled interface that a scenario perturbs. */
static bool has_interface(const Expansion *expansion, const CzProfileScenario *scenario) {
    const CzNode *train = expansion->partners.own->entry[0].value;
    const CzEntry *vehicles = cz_node_find_list(train, "vehicles");
    return !is_one(scenario->perturbed_interface, CZ_FIRST_COUPLED) || vehicles == NULL ||
           vehicles->value->n_entry != 1 || cz_vehicle_repeat(vehicles->value->entry[0].value) > 1;
}

/* Decides on a scenario of the category, and adds it when it is run as the profile has it. */
static CzAskedScenario ask(Expansion *expansion, const CzNode *written,
                           const CzProfileScenario *scenario) {
    const double speed = cz_profile_speed(scenario, expansion->checks.line_speed);
    CzAskedScenario asked = {.scenario = scenario, .speed = speed};
    asked.why = find_replacement(expansion, scenario);
    if (asked.why != NULL) {
        asked.standing = CZ_STANDING_REPLACED;
    } else if (speed <= 0) {
        char rule[120];
        cz_profile_speed_text(scenario, rule);
        asked.standing = CZ_STANDING_NOT_APPLICABLE;
        asked.why =
            sentence(expansion, "its speed, the %s, is not above zero at a line speed of %s", rule,
                     CZ_IN_UNIT(expansion->checks.line_speed, "km/h", 1 / 3.6));
    } else if (!has_interface(expansion, scenario)) {
        asked.standing = CZ_STANDING_NOT_APPLICABLE;
        asked.why = "the moving train has one vehicle and no coupled interface";
    } else if (!is_selected(expansion, scenario)) {
        asked.standing = CZ_STANDING_NOT_SELECTED;
    } else if (isnan(speed)) {
        if (!isnan(scenario->below_line_speed))
            need_line_speed(expansion, scenario);
    } else {
        add_scenario(expansion, written, scenario, speed);
    }
    return asked;
}

/* ---- scenarios of other categories ---- */

static const char *reason(Expansion *expansion, const CzProfileScenario *scenario) {
    char list[200] = "";
    if (scenario->elsewhere != NULL)
        return scenario->elsewhere;
    for (int i = 0; i < scenario->categories.n_text; i++) {
        const size_t n = strlen(list);
        snprintf(list + n, sizeof list - n, "%s%.40s", i > 0 ? ", " : "",
                 scenario->categories.text[i]);
    }
    return sentence(expansion, "it is for %s only", list);
}

static bool is_asked(const CzAskedScenario *asked, int n_asked, const char *name) {
    for (int i = 0; i < n_asked; i++)
        if (is_one(asked[i].scenario->name, name))
            return true;
    return false;
}

/* Decides on all scenarios of the profile. */
static void ask_all(Expansion *expansion, const CzNode *nodes) {
    CzProblem *problem = expansion->problem;
    const CzProfile *profile = &problem->profile, *whole = expansion->file.whole;
    CzAskedScenario *asked =
        cz_arena_allocate(expansion->arena, (size_t)whole->n_scenarios + 1, sizeof *asked);
    if (asked == NULL)
        return;
    int n = 0;
    for (int i = 0; i < profile->n_scenarios && i < nodes->n_entry; i++)
        if (profile->scenarios[i].given && profile->scenarios[i].name != NULL)
            asked[n++] = ask(expansion, nodes->entry[i].value, &profile->scenarios[i]);
    for (int i = 0; i < whole->n_scenarios; i++) {
        const CzProfileScenario *scenario = &whole->scenarios[i];
        if (scenario->name != NULL && !is_asked(asked, n, scenario->name))
            asked[n++] = (CzAskedScenario){scenario, CZ_STANDING_NOT_APPLICABLE,
                                           reason(expansion, scenario), NAN};
    }
    problem->asked = asked;
    problem->n_asked = n;
}

/* ---- the tree ---- */

/* The root with a list under a key, which it has or not; NULL without memory. */
static const CzNode *with_list(Expansion *expansion, const CzNode *root, const char *key,
                               const CzNode *list) {
    const CzEntry *entry = cz_node_find(root, key);
    if (entry != NULL)
        return cz_node_with(expansion->arena, root, entry, list);
    CzNode *more = cz_node_copy(expansion->arena, root, 1);
    return more != NULL && cz_node_append(expansion->arena, more, key, list, list, &cz_no_trail)
               ? more
               : NULL;
}

/* Puts scenarios and partners into the problem's tree. */
static void extend_tree(Expansion *expansion) {
    CzNode *scenarios = expansion->scenarios;
    const CzEntry *own = cz_node_find_list(expansion->problem->written.root, "scenarios");
    if (scenarios->n_entry == 0)
        return;
    for (int i = 0; own != NULL && i < own->value->n_entry; i++) {
        CzEntry *entry = &scenarios->entry[scenarios->n_entry++];
        *entry = own->value->entry[i];
        entry->trail = cz_entry_trail(entry, cz_entry_trail(own, &cz_no_trail));
    }
    const CzNode *root = with_list(expansion, expansion->problem->written.root, "trains",
                                   expansion->partners.trains);
    if (root != NULL)
        root = with_list(expansion, root, "scenarios", scenarios);
    if (root != NULL)
        expansion->problem->tree.root = root;
}

static void expand_scenarios(Expansion *expansion) {
    CzProblem *problem = expansion->problem;
    const CzNode *nodes =
        cz_profile_scenario_nodes(problem, &expansion->file, expansion->checks.category);
    if (nodes == NULL || !take_own_scenarios(expansion) ||
        !cz_partners_begin(expansion->reader, &problem->written, expansion->file.top,
                           &expansion->partners))
        return;
    const int n_own = expansion->own != NULL ? expansion->own->n_entry : 0;
    expansion->scenarios = cz_node_copy(expansion->arena, nodes, n_own);
    if (expansion->scenarios == NULL)
        return;
    expansion->scenarios->n_entry = 0;
    ask_all(expansion, nodes);
    extend_tree(expansion);
}

void cz_profile_expand(CzProblem *problem) {
    CzReader *reader = &problem->reader;
    Expansion expansion = {.problem = problem,
                           .reader = reader,
                           .arena = &reader->arena,
                           .places.arena = &reader->arena};
    problem->tree = problem->written;
    expansion.tree = cz_settings_apply_first(reader, &problem->written, problem->setting,
                                             problem->n_setting, "checks.");
    if (expansion.tree.root != NULL && read_checks(&expansion) && read_profile(&expansion)) {
        apply_overrides(&expansion);
        check_selection(&expansion);
        expand_scenarios(&expansion);
    }
    cz_places_free(&expansion.places);
}
