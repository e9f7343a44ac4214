/* Design map: assigns variables to places in the vehicle records.
 *
 *   value of a place [SI] = variable [unit of its key] x SI value of one unit
 *
 * One variable may set many places. The list of keys defines which keys may vary; an identical
 * partner shares every variable, so that a search cannot soften it. Variables that choose a part,
 * and those of a fit, are settings of a problem that is reread (choices.c).
 */
#ifndef CZ_EVALUATE_DESIGN_H
#define CZ_EVALUATE_DESIGN_H

#include "base/arena.h"
#include "crushzone/evaluate.h"
#include "evaluate/variant.h"

typedef struct CzDesignPlace {
    int vehicle;   /* index into the vehicle array; -1 for a number elsewhere, in a fit */
    size_t offset; /* of the double, or of the chosen buffer, in CzVehicle [byte]; elsewhere a
                      number that identifies the place */
    double scale;  /* SI value of one unit of the variable */
} CzDesignPlace;

typedef struct CzDesignVariable {
    CzVariableInfo info;
    const void *start_field; /* field of the input with its start, else with its bounds */
    int n_place;
    CzDesignPlace *place; /* (n_place); those of `info` are as a file names them */
} CzDesignVariable;

/* Change of a design variable's place by a variation: of its value in the unit of the place. */
typedef struct CzDesignChange {
    int variation, variable, place;
    CzCaseKind kind;
    double number, unit; /* SI value of one unit of the changed path's key */
} CzDesignChange;

typedef struct CzDesign {
    int n_change;
    CzDesignChange *change; /* in the order of variations (n_change) */
    int n_variable;
    CzDesignVariable *variable; /* (n_variable) */
    bool is_fit; /* designs are reread; variables may be any numbers that may be fitted */
} CzDesign;

/* Builds the map of a problem; no variables without `optimise:`. Memory comes from the arena.
 * Statuses: CZ_OK, CZ_STATUS_INPUT with the variable that is not a design variable,
 * CZ_STATUS_NO_MEMORY. */
CZ_MUST_CHECK CzStatus cz_design_build(const CzProblem *problem, int n_scene, const CzScene *scene,
                                       CzArena *arena, CzDesign *design, CzError *error);

/* Checks that every variable starts within its bounds, as a search requires. Statuses: CZ_OK,
 * CZ_STATUS_INPUT with the place. */
CZ_MUST_CHECK CzStatus cz_design_check_start(const CzProblem *problem, const CzDesign *design,
                                             CzError *error);

/* Finds the changes that scenarios make to the places of variables (variations.c). Statuses as
 * above. */
CZ_MUST_CHECK CzStatus cz_variations_build(const CzProblem *problem, int n_scene,
                                           const CzScene *scene, CzArena *arena, CzDesign *design,
                                           CzError *error);

/* Writes the numbers of a design into a copy of the vehicles of its choices in one variation; x is
 * (n_variable).
 */
void cz_design_apply(const CzDesign *design, int variation, const double *x, CzVehicle *vehicles);

/* ---- choices ---- */

enum { CZ_MAX_COMBINATIONS = 64 };

/* Finds the choice of the file itself; any two choices must differ. Statuses: CZ_OK,
 * CZ_STATUS_INPUT without a place, CZ_STATUS_NO_MEMORY. */
CZ_MUST_CHECK CzStatus cz_choice_find_start(const CzProblem *problem,
                                            const CzDesignVariable *variable, int *own,
                                            CzError *error);

/* Combinations of all choices: 1 without any. The first choice of the file changes fastest. */
int cz_design_n_combination(const CzDesign *design);
/* Combination of a design; x is (n_variable). */
int cz_design_combination(const CzDesign *design, const double *x);
/* The choice of a variable in a combination. */
int cz_design_choice(const CzDesign *design, int combination, int variable);

/* Settings of a combination, or with `x` of a whole design that is reread. Memory comes from the
 * arena. False without memory. */
bool cz_design_settings(const CzDesign *design, int combination, const double *x, CzArena *arena,
                        CzVariantSettings *settings);

#endif
