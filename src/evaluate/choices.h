/* Variables that choose a part, and variables that are read again: what of a design is more than a
 * number in a vehicle record. */
#ifndef CZ_EVALUATE_CHOICES_H
#define CZ_EVALUATE_CHOICES_H

#include "evaluate/design.h"
#include "evaluate/variant.h"

enum { CZ_MOST_COMBINATIONS = 64 };

/* Which choice the file itself makes, and that any two choices differ. Statuses: CZ_OK,
 * CZ_STATUS_INPUT without a place, CZ_STATUS_NO_MEMORY. */
CZ_MUST_CHECK CzStatus cz_choice_settle(const CzProblem *problem, const CzDesignVariable *variable,
                                        int *own, CzError *error);

/* Combinations of all choices: 1 without any. The first choice of the file counts fastest. */
int cz_design_n_combination(const CzDesign *design);
/* Combination of a design; x is (n_variable). */
int cz_design_combination(const CzDesign *design, const double *x);
/* The choice that a variable makes in a combination. */
int cz_design_choice(const CzDesign *design, int combination, int variable);

/* Settings that make a combination, or with `x` a whole design that is to be read again. Memory
 * comes from the arena. False without memory. */
bool cz_design_settings(const CzDesign *design, int combination, const double *x, CzArena *arena,
                        CzVariantSettings *settings);

#endif
