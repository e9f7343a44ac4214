/* What the parts of the list of checks share while it is built. */
#ifndef CZ_EVALUATE_CHECKLIST_PARTS_H
#define CZ_EVALUATE_CHECKLIST_PARTS_H

#include "evaluate/checks.h"

typedef struct CzChecklistBuilder {
    const CzProblem *problem;
    int n_scene;
    const CzScene *scene;
    CzArena *arena;
    CzChecklist *list;
    CzError *error;
} CzChecklistBuilder;

/* Adds a check. It is provisional, too, where its scenario is one of the profile whose numbers are
 * not confirmed. Status: CZ_STATUS_NO_MEMORY. */
CZ_MUST_CHECK CzStatus cz_checklist_append(CzChecklistBuilder *builder, const CzCheck *check);

/* Whether a number has a confidence that gives a provisional pass: numbers read in the primary
 * text, and those of the user, are confirmed. */
bool cz_is_unconfirmed(const char *confidence);

#endif
