/* Which scenarios a search runs.
 *
 * Of many scenarios only a few limit a design. A design is run in a working set of scenarios first,
 * and in all others only when it would be the best so far. Its values in the working set are bounds
 * of those in all scenarios, so that the best of the designs is the same as without a selection. A
 * scenario that turns out to limit a design joins the working set.
 *
 * The choice depends on the values of the designs alone, in the order of the search, and so neither
 * on threads nor on an interruption.
 */
#ifndef CZ_OPTIMISE_SELECTION_H
#define CZ_OPTIMISE_SELECTION_H

#include <math.h>

#include "base/arena.h"
#include "evaluate/evaluator.h"

typedef struct CzSelection {
    const CzEvaluator *evaluator;
    CzArena arena;
    bool is_on; /* some scenarios are left out; otherwise every design is run in all */
    int n_scenario, n_constraint, n_detail;
    int *of_constraint; /* scenario, -1 for none (n_constraint) */
    int *of_detail;     /* (n_detail) */
    bool *has_run;      /* whether a scenario is run at all (n_scenario) */
    bool has_begun;     /* the working set was chosen; all scenarios before */
    bool *works;        /* the working set (n_scenario) */
    double *last;       /* last known value of each constraint (n_constraint) */
    long n_whole;       /* of them in all scenarios */
    long *n_run;        /* of them in each scenario (n_scenario) */
} CzSelection;

/* Begins with all scenarios; memory comes from the selection's arena. Status: CZ_OK,
 * CZ_STATUS_NO_MEMORY. */
CZ_MUST_CHECK CzStatus cz_selection_begin(CzSelection *selection, const CzEvaluator *evaluator,
                                          CzError *error);
void cz_selection_free(CzSelection *selection);

/* Whether all scenarios are in the working set. */
bool cz_selection_is_whole(const CzSelection *selection);

/* Replaces the values (n_constraint, n_detail) of scenarios that are not in the working set by NaN;
 * `detail` may be NULL. */
void cz_selection_blank(const CzSelection *selection, double *constraint, double *detail);

/* Whether the values of a design that did not fail are those of the working set. */
bool cz_selection_is_of_set(const CzSelection *selection, const double *constraint);

/* Counts a design and notes its values; extends the working set by the scenarios that limit one
 * that was run in all. The objective of a design that failed is NaN; it counts as run in the
 * working set. */
void cz_selection_note(CzSelection *selection, bool is_whole, double objective,
                       const double *constraint);

/* A constraint of the search: its value, or the last one known where the scenario was left out. */
static inline double cz_selection_value(const CzSelection *selection, const double *constraint,
                                        int j) {
    return selection->is_on && isnan(constraint[j]) ? selection->last[j] : constraint[j];
}

#endif
