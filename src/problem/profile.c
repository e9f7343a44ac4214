/* Reads profiles of limits. */
#include "problem/reading.h"

#include <dirent.h>
#include <stdio.h>
#include <string.h>

#include "base/suggest.h"
#include "base/text.h"
#include "tree/load.h"
#include "tree/merge.h"

enum { LONGEST_NAME = 96 };

/* Suggests the names of all profiles in a folder. */
static void suggest_profiles(CzSuggestion *suggestion, const char *folder, const char *name) {
    char path[512], known[LONGEST_NAME];
    snprintf(path, sizeof path, "%s/profiles", folder);
    DIR *directory = opendir(path);
    if (directory == NULL)
        return;
    for (struct dirent *file = readdir(directory); file != NULL; file = readdir(directory)) {
        const char *end = strstr(file->d_name, ".yaml");
        if (end == NULL || end[5] != '\0' || end - file->d_name >= LONGEST_NAME)
            continue;
        snprintf(known, sizeof known, "%.*s", (int)(end - file->d_name), file->d_name);
        cz_suggest(suggestion, name, known);
    }
    closedir(directory);
}

/* Path of the profile that `named` names; NULL with a mistake when there is none. */
static const char *locate(CzReader *reader, const CzPlace *named) {
    const char *name = named->value->text;
    const char *folders[] = {named->value->source->folder, reader->share_folder};
    char file[LONGEST_NAME + 20];
    CzSuggestion suggestion = {0};
    snprintf(file, sizeof file, "profiles/%.*s.yaml", LONGEST_NAME, name);
    for (int i = 0; i < 2; i++) {
        const char *path =
            folders[i] != NULL ? cz_path_join(&reader->arena, folders[i], file) : NULL;
        if (path != NULL && cz_path_exists(path))
            return path;
        if (folders[i] != NULL)
            suggest_profiles(&suggestion, folders[i], name);
    }
    cz_mistake(&reader->mistakes, named->value, named->trail,
               "there is no profile '%.96s': no file profiles/%.96s.yaml", name, name);
    cz_mistake_suggest(&reader->mistakes, &suggestion);
    return NULL;
}

/* ---- categories ---- */

/* The categories of a profile, for did-you-mean. */
static void suggest_categories(CzSuggestion *suggestion, const CzProfile *profile,
                               const char *category, bool *is_known, bool *has_any) {
    if (profile->category != NULL) {
        *has_any = true;
        *is_known |= strcmp(profile->category, category) == 0;
        cz_suggest(suggestion, category, profile->category);
    }
    for (int i = 0; i < profile->n_limits; i++) {
        const CzTexts *categories = &profile->limits[i].categories;
        *has_any |= categories->n_text > 0;
        *is_known |= cz_text_is_among(category, categories->n_text, categories->text);
        for (int k = 0; k < categories->n_text; k++)
            cz_suggest(suggestion, category, categories->text[k]);
    }
}

static bool check_category(CzProblem *problem, const CzProfile *profile, const CzPlace *named) {
    CzReader *reader = &problem->reader;
    const CzChecks *checks = &problem->input.checks;
    CzSuggestion suggestion = {0};
    bool is_known = false, has_any = false;
    const char *category = checks->category != NULL ? checks->category : "";
    suggest_categories(&suggestion, profile, category, &is_known, &has_any);
    const CzPlace *place = cz_places_find(&problem->places, &checks->category);
    if (checks->category == NULL && has_any) {
        cz_mistake(&reader->mistakes, named->value, named->trail,
                   "profile '%.96s' has limits by category; 'checks' must name one",
                   named->value->text);
    } else if (checks->category != NULL && !has_any) {
        cz_mistake(&reader->warnings, place->value, place->trail,
                   "profile '%.96s' has no categories: remove '%.96s', all its limits apply",
                   named->value->text, category);
    } else if (checks->category != NULL && !is_known) {
        cz_mistake(&reader->mistakes, place->value, place->trail,
                   "profile '%.96s' has no category '%.96s'", named->value->text, category);
        cz_mistake_suggest(&reader->mistakes, &suggestion);
    }
    return !has_any || is_known;
}

static bool holds_for(const CzLimit *limit, const char *category) {
    return limit->categories.n_text == 0 ||
           (category != NULL &&
            cz_text_is_among(category, limit->categories.n_text, limit->categories.text));
}

/* The profile's tree without the limits of other categories; NULL without memory. */
static const CzNode *keep_category(CzReader *reader, const CzNode *top, const CzProfile *profile,
                                   const char *category) {
    const CzEntry *limits = cz_node_find(top, "limits");
    if (limits == NULL)
        return top;
    CzNode *list = cz_node_copy(&reader->arena, limits->value, 0);
    if (list == NULL)
        return NULL;
    list->n_entry = 0;
    for (int k = 0; k < profile->n_limits; k++)
        if (holds_for(&profile->limits[k], category))
            list->entry[list->n_entry++] = limits->value->entry[k];
    return cz_node_with(&reader->arena, top, limits, list);
}

static void bind_profile(CzProblem *problem, const CzNode *top, const CzPlace *named) {
    CzReader *reader = &problem->reader;
    const CzTree no_parts = {0};
    const CzBinder binder = cz_problem_binder(problem, &no_parts);
    const CzRecord *record = &cz_records[CZ_RECORD_CzProfile];
    CzProfile all = {0};
    cz_bind_record(binder, record, top, &cz_no_trail, &all);
    if (!check_category(problem, &all, named))
        return;
    const CzNode *kept = keep_category(reader, top, &all, problem->input.checks.category);
    if (kept != NULL)
        cz_bind_record(binder, record, kept, &cz_no_trail, &problem->profile);
}

void cz_profile_read(CzProblem *problem) {
    CzReader *reader = &problem->reader;
    const CzChecks *checks = &problem->input.checks;
    if (!checks->given || checks->profile == NULL)
        return;
    const CzPlace named = *cz_places_find(&problem->places, &checks->profile);
    const char *path = locate(reader, &named);
    const CzNode *top = path != NULL ? cz_load_file(reader, path, named.value) : NULL;
    if (top == NULL)
        return;
    const CzNode *profile = cz_node_without(&reader->arena, top, "schema", 0);
    if (profile != NULL)
        bind_profile(problem, profile, &named);
}
