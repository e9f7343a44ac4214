/* Profiles: limits and scenarios of a standard as data, and what a problem takes of one.
 *
 *   load       profiles/NAME.yaml -> the profile as written, for all categories, with its rules
 *   category   limits and scenarios of one category, `like` of scenarios written out
 *   expand     partners and scenarios of the category added to the tree of a problem
 *
 * The tree is extended before settings are applied and records are read, so that a partner is a
 * train and a scenario a scenario like any other; settings of `checks` are applied before. */
#ifndef CZ_PROBLEM_PROFILE_H
#define CZ_PROBLEM_PROFILE_H

#include "problem/reading.h"

/* A profile as written. */
typedef struct CzProfileFile {
    const CzNode *top;      /* NULL: there is none */
    const CzProfile *whole; /* of all categories; `like` is not written out */
} CzProfileFile;

/* The profile at a path, with its mistakes in `problem`; `named` is the value that names it, NULL
 * for none. The top is NULL when it cannot be read. */
CzProfileFile cz_profile_load(CzProblem *problem, const char *path, const CzNode *named);

/* The limits and scenarios of a category, NULL where a profile has none; false without memory. */
bool cz_profile_in_category(CzProblem *problem, const CzProfileFile *file, const char *category,
                            CzProfile *profile);

/* The tree of one category: the list of its scenarios as they were bound to a profile; NULL for
 * none. */
const CzNode *cz_profile_scenario_nodes(CzProblem *problem, const CzProfileFile *file,
                                        const char *category);

/* Whether a list of categories includes one; an empty list includes all. */
bool cz_profile_includes(const CzTexts *categories, const char *category);

/* Reads the profile that the problem names, and adds its partners and scenarios to the tree. */
void cz_profile_expand(CzProblem *problem);

/* The speed of a scenario by its rule [m/s]: NaN when the line speed is needed and not known. */
double cz_profile_speed(const CzProfileScenario *scenario, double line_speed);

/* Writes the speed of a scenario or the rule for it, such as "36 km/h" or "line speed less 50 km/h,
 * at most 110 km/h". */
void cz_profile_speed_text(const CzProfileScenario *scenario, char text[120]);

/* The path of a profile by its name: in profiles/ of a folder, then of the share folder (either may
 * be NULL); NULL when there is none, with the nearest names. */
const char *cz_profile_find(CzReader *reader, const char *folder, const char *name,
                            CzSuggestion *nearest);

/* Calls back for each file of a folder's profiles/, with its name without .yaml. */
typedef void CzProfileName(const char *name, void *data);
void cz_profile_each(const char *folder, CzProfileName *visit, void *data);

#endif
