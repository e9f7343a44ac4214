/* Design map: variables to places in the vehicle records.
 *
 *   value of a place [SI] = variable [unit of its key] x SI value of one unit
 *
 * One variable may drive many places. What may vary is settled by the list of keys; a partner that
 * is the same train shares every variable, so that an opponent cannot be softened.
 */
#ifndef CZ_EVALUATE_DESIGN_H
#define CZ_EVALUATE_DESIGN_H

#include "base/arena.h"
#include "crushzone/evaluate.h"
#include "evaluate/scene.h"

typedef struct CzDesignPlace {
    int vehicle;   /* index into the vehicle array; -1 for a number elsewhere, in a fit */
    size_t offset; /* of the double, or of the buffer that is chosen, in CzVehicle [byte]; elsewhere
                      what distinguishes it from others */
    double scale;  /* SI value of one unit of the variable */
} CzDesignPlace;

typedef struct CzDesignVariable {
    CzVariableInfo info;
    const void *start_field; /* of the input: where its start is written, else its bounds */
    int n_place;
    CzDesignPlace *place; /* (n_place) */
    int n_shown;
    CzVariablePlace *shown; /* paths that a person would write for them (n_shown) */
} CzDesignVariable;

typedef struct CzDesign {
    int n_variable;
    CzDesignVariable *variable; /* (n_variable) */
    bool
        is_fit; /* every design is read again: its variables may be any number that may be fitted */
} CzDesign;

/* Builds the map of a problem; no variables without `optimise:`. Memory comes from the arena.
 * Statuses: CZ_OK, CZ_STATUS_INPUT naming the variable that is no design, CZ_STATUS_NO_MEMORY. */
CZ_MUST_CHECK CzStatus cz_design_build(const CzProblem *problem, int n_scene, const CzScene *scene,
                                       CzArena *arena, CzDesign *design, CzError *error);

/* Whether every variable starts within its bounds, as a search needs. Statuses: CZ_OK,
 * CZ_STATUS_INPUT with the place. */
CZ_MUST_CHECK CzStatus cz_design_check_start(const CzProblem *problem, const CzDesign *design,
                                             CzError *error);

/* Writes the numbers of a design into a copy of the vehicle array of its choices; x is
 * (n_variable).
 */
void cz_design_apply(const CzDesign *design, const double *x, CzVehicle *vehicles);

#endif
