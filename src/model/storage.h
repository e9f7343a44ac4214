/* Energy that a passive linear system can still return. */
#ifndef CZ_MODEL_STORAGE_H
#define CZ_MODEL_STORAGE_H

#include <stdbool.h>

#include "base/arena.h"

/* Available storage x' H x of a system in steps, x <- A x + b f, whose deflection c' x receives the
 * work f c' (x after - x before) in a step: the largest energy that forces can extract. Fills h (n
 * x n, symmetric) for A (n x n, by rows), b and c (n). The scratch arena holds the intermediate
 * matrices. False when there is no memory, or the system is not passive. */
bool cz_available_storage(int n, const double *a, const double *b, const double *c, double *h,
                          CzArena *scratch);

#endif
