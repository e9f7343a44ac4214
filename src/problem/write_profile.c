/* Profiles for readers: a list of them, limits and categories of one, its scenarios by category. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/error.h"
#include "base/number.h"
#include "problem/profile.h"
#include "problem/rules.h"

/* A profile that is read by itself. */
typedef struct View {
    CzProblem *holder; /* of memory and mistakes */
    const char *path;
    CzProfileFile file;
} View;

/* Reads a profile by its name; options may be NULL. */
static CzStatus read_view(const char *name, const CzProblemOptions *options, View *view,
                          CzError *error) {
    CzSuggestion nearest = {0};
    *view = (View){.holder = cz_problem_create(options != NULL ? options->share_folder : NULL)};
    if (view->holder == NULL)
        return cz_no_memory(error, "a profile");
    CzReader *reader = &view->holder->reader;
    view->path = cz_profile_find(reader, ".", name, &nearest);
    if (view->path == NULL) {
        cz_fail(error, CZ_STATUS_INPUT,
                "there is no profile '%.96s'" CZ_HELP "'crushzone profile list' lists them", name);
        cz_suggest_help(&nearest, error);
        return CZ_STATUS_INPUT;
    }
    view->file = cz_profile_load(view->holder, view->path, NULL);
    cz_mistakes_finish(&reader->mistakes);
    return cz_mistakes_status(&reader->mistakes, view->path, error);
}

/* ---- the list ---- */

enum { MAX_PROFILES = 200, LONGEST = 96 };

typedef struct Names {
    int n;
    char name[MAX_PROFILES][LONGEST];
} Names;

static void keep_name(const char *name, void *data) {
    Names *names = data;
    for (int i = 0; i < names->n; i++)
        if (strcmp(names->name[i], name) == 0)
            return;
    if (names->n < MAX_PROFILES)
        snprintf(names->name[names->n++], LONGEST, "%s", name);
}

static int compare_names(const void *a, const void *b) {
    return strcmp(a, b);
}

/* Whether one of the first n scenarios of a profile has a name. */
static bool is_among(const char *name, const CzProfile *profile, int n) {
    CzSuggestion nearest = {0};
    return CZ_FIND_NAMED(name, CzProfileScenario, profile->scenarios, n, &nearest) >= 0;
}

/* Number of scenarios of different names. */
static int count_scenarios(const CzProfile *profile) {
    int n = 0;
    for (int i = 0; i < profile->n_scenarios; i++)
        n += !is_among(profile->scenarios[i].name, profile, i);
    return n;
}

static void write_line(const char *name, const CzProblemOptions *options, FILE *stream) {
    View view;
    CzError error = {0};
    fprintf(stream, "  %-17s", name);
    if (read_view(name, options, &view, &error) != CZ_OK) {
        fprintf(stream, "cannot be read: %s:%d: %s\n", error.file, error.line, error.message);
    } else {
        const CzProfile *whole = view.file.whole;
        const int n_scenario = count_scenarios(whole);
        fprintf(stream, "%s; %d limits, ", whole->edition, whole->n_limits);
        fprintf(stream, n_scenario > 0 ? "%d scenarios" : "no scenarios", n_scenario);
        for (int i = 0; i < whole->n_categories; i++)
            fprintf(stream, "%s%s",
                    i == 0 ? "\n"
                             "                   "
                             "categories: "
                           : ", ",
                    whole->categories[i].name);
        fputc('\n', stream);
    }
    cz_problem_free(view.holder);
}

void cz_profiles_write_list(const CzProblemOptions *options, FILE *stream) {
    Names names = {0};
    cz_profile_each(".", keep_name, &names);
    if (options != NULL && options->share_folder != NULL)
        cz_profile_each(options->share_folder, keep_name, &names);
    qsort(names.name, (size_t)names.n, sizeof names.name[0], compare_names);
    for (int i = 0; i < names.n; i++)
        write_line(names.name[i], options, stream);
}

/* ---- limits ---- */

static void write_texts(const char *before, const CzTexts *texts, FILE *stream) {
    for (int i = 0; i < texts->n_text; i++)
        fprintf(stream, "%s%s", i == 0 ? before : ", ", texts->text[i]);
    if (texts->n_text > 0)
        fputc('\n', stream);
}

static void write_limit(const CzLimit *limit, FILE *stream) {
    const bool is_minimum = isnan(limit->max);
    char number[CZ_NUMBER_TEXT];
    fprintf(stream, "  %s\n      %s at %s %s [%s] %s\n", limit->name, limit->metric,
            is_minimum ? "least" : "most",
            cz_number_print(number, is_minimum ? limit->min : limit->max), limit->confidence,
            limit->clause);
    write_texts("      in ", &limit->scenarios, stream);
    write_texts("      for ", &limit->categories, stream);
    fprintf(stream, "      %s\n", limit->source);
}

static void write_limits(const View *view, FILE *stream) {
    const CzProfile *whole = view->file.whole;
    fprintf(stream, "%s: %s\n%s\n", whole->name, whole->edition, view->path);
    if (whole->n_categories > 0)
        fputs("\nCategories:\n", stream);
    for (int i = 0; i < whole->n_categories; i++)
        fprintf(stream, "  %-17s %s\n", whole->categories[i].name, whole->categories[i].title);
    fputs("\nLimits, with confidence, clause and source:\n", stream);
    for (int i = 0; i < whole->n_limits; i++)
        write_limit(&whole->limits[i], stream);
    if (whole->n_scenarios > 0)
        fprintf(stream, "\nScenarios: 'crushzone profile scenarios %s' lists them.\n", whole->name);
    if (whole->not_checked.n_text > 0)
        fputs("\nNot covered by this program, to be shown by other means:\n", stream);
    for (int i = 0; i < whole->not_checked.n_text; i++)
        fprintf(stream, "  %s\n", whole->not_checked.text[i]);
}

/* ---- scenarios ---- */

/* Writes what differs from two undamaged trains on level track. */
static void write_conditions(const CzProfileScenario *scenario, FILE *stream) {
    if (!isnan(scenario->height_offset) && scenario->height_offset != 0)
        fprintf(stream, ", partner %s %s", CZ_MM(fabs(scenario->height_offset)),
                scenario->height_offset < 0 ? "lower" : "higher");
    if (!isnan(scenario->perturbation) && scenario->perturbed_interface != NULL)
        fprintf(stream, ", %s offset by %s", scenario->perturbed_interface,
                CZ_MM(scenario->perturbation));
    if (!isnan(scenario->partner_brake_ratio))
        fprintf(stream, ", partner's brake ratio %s", CZ_SHORT(scenario->partner_brake_ratio));
    if (!isnan(scenario->mass_factor))
        fprintf(stream, ", masses times %s", CZ_SHORT(scenario->mass_factor));
    if (!isnan(scenario->payload_share))
        fprintf(stream, ", payload share %s", CZ_SHORT(scenario->payload_share));
}

/* The scenarios that do not apply in a category, each once. */
static void write_others(const CzProfile *whole, const CzProfile *profile, FILE *stream) {
    bool is_first = true;
    for (int i = 0; i < whole->n_scenarios; i++) {
        const CzProfileScenario *scenario = &whole->scenarios[i];
        if (is_among(scenario->name, profile, profile->n_scenarios) ||
            is_among(scenario->name, whole, i))
            continue;
        fputs(is_first ? "  do not apply:\n" : "", stream);
        is_first = false;
        fprintf(stream, "    %-28s ", scenario->name);
        if (scenario->elsewhere != NULL)
            fprintf(stream, "%s\n", scenario->elsewhere);
        else
            write_texts("it is for ", &scenario->categories, stream);
    }
}

static void write_category(const View *view, const CzCategory *category, FILE *stream) {
    CzProfile profile = {0};
    const char *name = category != NULL ? category->name : NULL;
    if (!cz_profile_in_category(view->holder, &view->file, name, &profile) ||
        cz_problem_n_mistake(view->holder) > 0)
        return;
    if (category != NULL)
        fprintf(stream, "\n%s: %s\n", category->name, category->title);
    for (int i = 0; i < profile.n_scenarios; i++) {
        const CzProfileScenario *scenario = &profile.scenarios[i];
        char speed[120];
        cz_profile_speed_text(scenario, speed);
        fprintf(stream, "  %s\n      onto %s at %s", scenario->name,
                strcmp(scenario->partner, "identical") == 0 ? "an identical train"
                                                            : scenario->partner,
                speed);
        write_conditions(scenario, stream);
        fprintf(stream, "\n      [%s] %s; %s\n", scenario->confidence, scenario->clause,
                scenario->source);
    }
    if (profile.n_scenarios == 0)
        fputs("  no scenarios: those of the problem\n", stream);
    write_others(view->file.whole, &profile, stream);
}

/* The scenarios of one category, or of all. */
static CzStatus write_scenarios(const View *view, const char *category, FILE *stream,
                                CzError *error) {
    const CzProfile *whole = view->file.whole;
    CzSuggestion nearest = {0};
    const int only = category != NULL ? CZ_FIND_NAMED(category, CzCategory, whole->categories,
                                                      whole->n_categories, &nearest)
                                      : 0;
    if (only < 0) {
        cz_fail(error, CZ_STATUS_INPUT, "profile '%.96s' has no category '%.96s'", whole->name,
                category);
        cz_suggest_help(&nearest, error);
        return CZ_STATUS_INPUT;
    }
    fprintf(stream, "%s: %s\n", whole->name, whole->edition);
    if (whole->n_categories == 0)
        write_category(view, NULL, stream);
    for (int i = 0; i < whole->n_categories; i++)
        if (category == NULL || i == only)
            write_category(view, &whole->categories[i], stream);
    CzMistakes *mistakes = &view->holder->reader.mistakes;
    return cz_mistakes_status(mistakes, view->path, error);
}

CzStatus cz_profile_write(const char *name, CzProfileContent content, const char *category,
                          const CzProblemOptions *options, FILE *stream, CzError *error) {
    View view;
    CzStatus status = read_view(name, options, &view, error);
    if (status == CZ_OK && content == CZ_PROFILE_LIMITS)
        write_limits(&view, stream);
    else if (status == CZ_OK)
        status = write_scenarios(&view, category, stream, error);
    cz_problem_free(view.holder);
    return status;
}
