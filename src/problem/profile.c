/* Finds and reads the file of a profile. */
#include "problem/profile.h"

#include <dirent.h>
#include <stdio.h>
#include <string.h>

#include "base/text.h"
#include "problem/rules.h"
#include "tree/load.h"
#include "tree/merge.h"

enum { LONGEST_NAME = 96 };

/* ---- finding ---- */

void cz_profile_each(const char *folder, CzProfileName *visit, void *data) {
    char path[512], name[LONGEST_NAME];
    snprintf(path, sizeof path, "%s/profiles", folder);
    DIR *directory = opendir(path);
    if (directory == NULL)
        return;
    for (struct dirent *file = readdir(directory); file != NULL; file = readdir(directory)) {
        const char *end = strstr(file->d_name, ".yaml");
        if (end == NULL || end[5] != '\0' || end - file->d_name >= LONGEST_NAME)
            continue;
        snprintf(name, sizeof name, "%.*s", (int)(end - file->d_name), file->d_name);
        visit(name, data);
    }
    closedir(directory);
}

typedef struct Sought {
    CzSuggestion *nearest;
    const char *name;
} Sought;

static void suggest(const char *name, void *data) {
    const Sought *sought = data;
    cz_suggest(sought->nearest, sought->name, name);
}

const char *cz_profile_find(CzReader *reader, const char *folder, const char *name,
                            CzSuggestion *nearest) {
    const char *folders[] = {folder, reader->share_folder};
    Sought sought = {nearest, name};
    char file[LONGEST_NAME + 20];
    snprintf(file, sizeof file, "profiles/%.*s.yaml", LONGEST_NAME, name);
    for (int i = 0; i < 2; i++) {
        const char *path =
            folders[i] != NULL ? cz_path_join(&reader->arena, folders[i], file) : NULL;
        if (path != NULL && cz_path_exists(path))
            return path;
        if (folders[i] != NULL)
            cz_profile_each(folders[i], suggest, &sought);
    }
    return NULL;
}

/* ---- reading ---- */

/* Binds a profile's tree; its partners are trains of a problem and are read there. */
static void bind(CzProblem *problem, const CzNode *top, CzProfile *profile) {
    const CzTree no_parts = {0};
    const CzNode *bound = cz_node_without(&problem->reader.arena, top, "partners", 0);
    if (bound != NULL)
        cz_bind_record(cz_problem_binder(problem, &no_parts), &cz_records[CZ_RECORD_CzProfile],
                       bound, &cz_no_trail, profile);
}

CzProfileFile cz_profile_load(CzProblem *problem, const char *path, const CzNode *named) {
    CzReader *reader = &problem->reader;
    CzProfileFile file = {0};
    const CzNode *top = cz_load_file(reader, path, named);
    CzProfile *whole = cz_arena_allocate(&reader->arena, 1, sizeof *whole);
    if (top == NULL || whole == NULL)
        return file;
    for (CzSource *source = reader->sources.first; source != NULL; source = source->next)
        source->is_general |= source == top->source;
    file.top = cz_node_without(&reader->arena, top, "schema", 0);
    file.whole = whole;
    if (file.top == NULL)
        return file;
    bind(problem, file.top, whole);
    const CzRules rules = cz_rules_of(problem);
    cz_rules_check_profile(&rules, whole, path);
    return file;
}

/* ---- one category ---- */

bool cz_profile_includes(const CzTexts *categories, const char *category) {
    return categories->n_text == 0 ||
           (category != NULL && cz_text_is_among(category, categories->n_text, categories->text));
}

/* The entry of a profile's tree with those items of its list that are of a category; `categories`
 * returns those of an item. NULL without memory. */
static CzNode *filter(CzReader *reader, const CzEntry *list, const CzProfile *whole,
                      const CzTexts *(*categories)(const CzProfile *, int), const char *category) {
    CzNode *kept = cz_node_copy(&reader->arena, list->value, 0);
    if (kept == NULL)
        return NULL;
    kept->n_entry = 0;
    for (int i = 0; i < list->value->n_entry; i++)
        if (cz_profile_includes(categories(whole, i), category))
            kept->entry[kept->n_entry++] = list->value->entry[i];
    return kept;
}

static const CzTexts *categories_of_limit(const CzProfile *whole, int i) {
    return &whole->limits[i].categories;
}

static const CzTexts *categories_of_scenario(const CzProfile *whole, int i) {
    return &whole->scenarios[i].categories;
}

/* An item of a list of scenarios with the values of the earlier one that it is like. */
static const CzNode *take_like(CzReader *reader, const CzNode *list, int item) {
    const CzNode *scenario = list->entry[item].value;
    const CzEntry *like = cz_node_find(scenario, "like");
    CzSuggestion nearest = {0};
    if (like == NULL || like->value->kind != CZ_NODE_TEXT)
        return scenario;
    for (int i = 0; i < item; i++) {
        const char *name = cz_node_find_text(list->entry[i].value, "name");
        if (name != NULL && strcmp(name, like->value->text) == 0)
            return cz_inherit(&reader->arena, scenario, list->entry[i].value,
                              "name family like categories elsewhere");
        if (name != NULL)
            cz_suggest(&nearest, like->value->text, name);
    }
    cz_mistake(&reader->mistakes, like->value, NULL,
               "there is no earlier scenario '%.48s' in this category", like->value->text);
    cz_mistake_suggest(&reader->mistakes, &nearest);
    return scenario;
}

const CzNode *cz_profile_scenario_nodes(CzProblem *problem, const CzProfileFile *file,
                                        const char *category) {
    CzReader *reader = &problem->reader;
    const CzEntry *written = cz_node_find_list(file->top, "scenarios");
    if (written == NULL || file->whole->n_scenarios == 0)
        return NULL;
    CzNode *list = filter(reader, written, file->whole, categories_of_scenario, category);
    for (int i = 0; list != NULL && i < list->n_entry; i++) {
        list->entry[i].value = take_like(reader, list, i);
        if (list->entry[i].value == NULL)
            return NULL;
    }
    return list;
}

bool cz_profile_in_category(CzProblem *problem, const CzProfileFile *file, const char *category,
                            CzProfile *profile) {
    CzArena *arena = &problem->reader.arena;
    const CzNode *top = file->top, *scenarios = cz_profile_scenario_nodes(problem, file, category);
    const CzEntry *written = cz_node_find_list(top, "limits");
    if (written != NULL && file->whole->n_limits > 0)
        top = cz_node_with(
            arena, top, written,
            filter(&problem->reader, written, file->whole, categories_of_limit, category));
    written = top != NULL ? cz_node_find_list(top, "scenarios") : NULL;
    if (written != NULL && scenarios != NULL)
        top = cz_node_with(arena, top, written, scenarios);
    if (top == NULL)
        return false;
    bind(problem, top, profile);
    const CzRules rules = cz_rules_of(problem);
    cz_rules_check_profile_scenarios(&rules, profile);
    return true;
}

/* ---- speeds ---- */

double cz_profile_speed(const CzProfileScenario *scenario, double line_speed) {
    double speed = scenario->speed;
    if (isnan(speed)) {
        speed = line_speed - scenario->below_line_speed;
        if (scenario->most_speed < speed)
            speed = scenario->most_speed;
    }
    return speed * scenario->speed_factor;
}

void cz_profile_speed_text(const CzProfileScenario *scenario, char text[120]) {
    char most[60] = "", factor[40] = "";
    const double kmh = 1 / 3.6;
    if (!isnan(scenario->speed)) {
        snprintf(text, 120, "%s",
                 CZ_IN_UNIT(scenario->speed * scenario->speed_factor, "km/h", kmh));
        return;
    }
    if (!isnan(scenario->most_speed))
        snprintf(most, sizeof most, ", at most %s", CZ_IN_UNIT(scenario->most_speed, "km/h", kmh));
    if (scenario->speed_factor != 1)
        snprintf(factor, sizeof factor, ", times %g", scenario->speed_factor);
    snprintf(text, 120, "line speed less %s%s%s",
             CZ_IN_UNIT(scenario->below_line_speed, "km/h", kmh), most, factor);
}
